"""Turns drawings and NC programs back into contours and segments.

`dxf` reads a drawing's entities, `contours` makes contours of them (`curves`, `clean_up`, `nodes`, `loops`, `joints`,
`nesting`), `contour` is one of them and how it may be changed (`arc_fitting`), `listing` displays them, `segments`
writes one as a block.  `nc` reads NC programs, with `offset_back` those of the tool center.
"""
