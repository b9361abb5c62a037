"""Word-address controls, a module for each maker: data, and the few functions in which they really differ.

Adding a control: write a module here with its `DIALECT` (codes, syntax, arc radii: `iso.dialect.Dialect`) and a class
over `iso.machine.Control` (its compensation: `compensation.element_queue`, or `fanuc_vectors` for one after Fanuc's);
enter both in `registry.CONTROLS` with the variants, and its names in `control_names`, where each variant needs a line.
Give each variant an `IsoStyle` in `write.iso_style.STYLES`, which says how programs are posted for it: without one
posting raises KeyError, and `contour_translation` takes the control for one of Klartext.  Name it in `iso.code_support`
with the codes that not every control has.  `Dialect.parameters` picks the language of its macros (`iso.execute`).  A
control that reads neither word addresses nor Klartext has no place yet: see `registry.is_klartext`.  Its way around
corners is a `compensation.corner_rules.CornerRules`; a way that none has yet is a new member of `Outside` or `Inside`
there.  `app/cli/COMMANDS.md`, `core/output/NC_FILE.md` and the tests' statements list the controls.
"""
