"""This package holds the program that the operator typed, and solves, edits and stores it.

A new kind of segment needs a class in `model`, included in `Segment`; a form in `fields`, by which files are read and
written too; rules in a module of `solve`, called by `solve.segment` (by `solve.block` if it lies between two others);
and a line in `file.write`, whose `format_of` tells which format it needs.  Extend `edit` to type it, `block_motion` to
move it, `solve.run_of_segments` to solve it in a run, and `importing.segments` to make it of an imported contour.  In
the app, add it to `NEW_SEGMENTS` of `app.screens.contour`; the journal takes it from `model.Segment`.  A segment is one
line or one arc, since geometry, compensation, judge and posting know no other curve: approximate any other by arcs, as
`importing.curves` does.
"""
