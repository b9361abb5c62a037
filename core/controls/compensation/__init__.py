"""This package compensates G41, G42, RL and RR block by block: offset elements, corner rules, look-ahead and moves.

`elements` has the elements and their offset points, `corner_rules` the rules that join two of them, `element_queue` the
look-ahead, `recorder` the moves and the compensated stretches.  For a single corner call `corner_rules.join` with two
elements (`elements.line_element`, `elements.arc_element`), the tool radius in millimeters (positive with the tool on
the left) and `CornerRules`; its defaults go around outside corners by an arc and join inside corners where the offsets
meet.
"""
