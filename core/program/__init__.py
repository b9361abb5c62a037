"""What the operator typed, what follows from it, and how it is edited and stored.

Adding a kind of segment: a class in `model` and its place in `Segment`; its form in `fields`; its rules in a module of
`solve`, called by `solve.segment` (by `solve.corners` where it stands between two others); its keys in `file.read` and
`file.write`, whose `format_of` says which format it needs; how it is typed in `edit`, moved in `transform`, solved in a
run in `solve.stretch`, and made of an imported contour in `importing.segments`.  In the app it is one of `NEW_SEGMENTS`
of `app.screens.contour`; the journal takes it from `model.Segment`.  A segment is one line or one arc, since geometry,
compensation, judge and posting know no other curve: approximate any other by arcs, as `importing.curves` does.
"""
