"""Compensation as controls do it, block by block: the one scalar form of joining offset elements.

`corners` has the elements and the points of a corner, `joint` the corner rules, `chain` the look-ahead, `recorder` the
moves and the compensated stretches.  One corner by itself: `joint.join` of two elements (`corners.line_element`,
`corners.arc_element`), the tool radius in millimeters, positive with the tool on the left, and `joint.CornerRules`,
whose defaults go around outside corners by an arc and join inside corners at the meeting of the offsets.
"""
