"""Compensation of MILL CONTOUR blocks: the center path under the conversational control's look-ahead.

`compensate` calls the stages: `offset`, `crossings`, `prune`, `blend_moves`.  What goes around an outside corner is
one piece, an arc about the vertex, made in `offset`; `best_path.raw_offset`, `best_path.trim`, `verify.report` and
`importing.offset_back` count on that.  Klartext's M120 uses these stages too.  G41, G42, RL and RR of NC programs are
`controls.compensation`.
"""
