"""Cutter compensation: the center path under the control's look-ahead rule.

`compensate` calls the stages: `offset`, `crossings`, `prune`, `blend_moves`.  What goes around an outside corner is
made in `offset` alone, one piece a corner; `best_path.raw_offset` takes those pieces as arcs about the contour's
vertices, and Klartext's M120 uses these stages too.  NC programs join their corners by `controls.compensation`.
"""
