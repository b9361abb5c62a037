"""The word-address controls by maker: data, and the few functions in which they really differ.

Adding a control: write a module here with its `DIALECT` (codes, syntax, arc radii: `iso.dialect.Dialect`) and a class
over `iso.machine.Control` (its compensation: `compensation.element_queue`, `compensation.corner_rules`); enter both in
`registry.CONTROLS` with the variants, and its names in `control_names`; give each variant an `IsoStyle` in
`write.iso_style.STYLES`, which says how programs are posted for it.  Nothing else in core names controls.  The README
and the tests' statements list them.
"""
