"""The word-address controls by maker: data, and the few functions in which they really differ.

Adding a control: write a module here with its `DIALECT` (codes, syntax, arc radii: `iso.dialect.Dialect`) and a class
over `iso.machine.Control` (its compensation: `compensation.element_queue`, or `fanuc_vectors` for one after Fanuc's);
enter both in `registry.CONTROLS` with the variants, and its names in `control_names`; give each variant an `IsoStyle`
in `write.iso_style.STYLES`, which says how programs are posted for it; and name it in `iso.elsewhere` with the codes
that not every control has.  Its way around corners is a `compensation.corner_rules.CornerRules`; a way that none has
yet is a new member of `Outside` or `Inside` there.  The README and the tests' statements list the controls.
"""
