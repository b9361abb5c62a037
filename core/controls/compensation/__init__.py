"""G41, G42, RL and RR block by block: offset elements, the rules at corners, the look-ahead, the moves.

`elements` has the elements and their offset points, `corner_rules` the rules by which two of them are joined,
`element_queue` the look-ahead, `recorder` the moves and the compensated stretches.  One corner by itself:
`corner_rules.join` of two elements (`elements.line_element`, `elements.arc_element`), the tool radius in millimeters,
positive with the tool on the left, and `CornerRules`, whose defaults go around outside corners by an arc and join
inside corners at the meeting of the offsets.
"""
