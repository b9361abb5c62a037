"""Where keys stand in a file."""

from __future__ import annotations

from core.program.file.lines import key_lines, line_of

TEXT = """\
format = 1
[parameters]
  max_offset = 1.0   # a comment = none
[[tool]]
number = 1
[[ block ]]   # first
tool = 1
[block.unread]
speed = "x"
[[block.segment]]
kind = "LINE"
[[block.segment]]
"x_end" = 1.0
[block.segment.unread]
y_end = "q"
[[block]]
[[block.segment]]
x_end = 2.0
"""


def test_every_key_has_its_line():
    lines = key_lines(TEXT)
    assert lines["format",] == 1
    assert lines["parameters", "max_offset"] == 3
    assert lines["tool", 0, "number"] == 5
    assert lines["block", 0] == 6
    assert lines["block", 0, "unread", "speed"] == 9
    assert lines["block", 0, "segment", 0, "kind"] == 11
    assert lines["block", 0, "segment", 1, "x_end"] == 13
    assert lines["block", 0, "segment", 1, "unread", "y_end"] == 15
    assert lines["block", 1, "segment", 0, "x_end"] == 18


def test_a_key_that_is_not_there_has_the_line_of_its_table():
    lines = key_lines(TEXT)
    assert line_of(lines, ("block", 1, "segment", 0, "y_end")) == 17
    assert line_of(lines, ("units",)) == 1
    assert line_of(lines, ("block", 7, "tool")) == 1


def test_dotted_keys():
    assert key_lines("setup.name = 'A'\n")["setup", "name"] == 1
