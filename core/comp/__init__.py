"""Cutter compensation of MILL CONTOUR blocks: the center path under the conversational control's look-ahead.

`compensate` calls the stages: `offset`, `crossings`, `prune`, and adds blend moves.  `offset` goes around an outside
corner with one piece, an arc about the vertex; `best_path.raw_offset`, `verify.report` and `importing.offset_back` rely
on that.  Klartext's M120 uses these stages too.  G41, G42, RL and RR of NC programs are in `controls.compensation`.
"""
