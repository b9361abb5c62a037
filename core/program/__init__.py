"""What the operator typed, what follows from it, and how it is edited and stored.

Adding a kind of segment: a class in `model` and its place in `Segment`; its form in `fields`; its rules in a module of
`solve`, called by `solve.segment` (by `solve.corners` where it stands between two others); its keys in `file.read` and
`file.write`, whose `format_of` says which format it needs.  The app has it in the journal and in the choice of a new
segment.  A segment is one line or one arc: any other curve becomes several, as `importing.curves` makes of ellipses.
"""
