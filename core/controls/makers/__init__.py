"""Each module here holds a maker's word-address controls: data, and the few functions in which they really differ.

To add a control, write a module here with its `DIALECT` (codes, syntax, arc radii: `iso.dialect.Dialect`) and a class
derived from `iso.machine.Control` (its compensation: `compensation.element_queue`, or `fanuc_vectors` if it follows
Fanuc's).  Enter both in `registry.CONTROLS` with the variants, and its names in `control_names`, with a line for each
variant.  Give each variant an `IsoStyle` in `write.iso_style.STYLE_OF_CONTROL`, which says how programs are posted for
it: without one, posting raises KeyError, and `contour_translation` takes the control for a Klartext control.  Name it
in `iso.code_support` with the codes that not every control has.  `Dialect.parameters` selects its macro language
(`iso.iso_run`).  Controls that read neither word addresses nor Klartext do not fit in yet: see `registry.is_klartext`.
Corners follow `compensation.corner_rules.CornerRules`; for a new kind of corner add a member to `Outside` or `Inside`
there.  `app/cli/COMMANDS.md`, `core/output/NC_FILE.md` and the tests' statements list the controls.
"""
