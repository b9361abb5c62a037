"""A program with a bit of everything."""

from __future__ import annotations

from core.program.model import Number, Unread
from core.units import Unit
from tests.core.program.parts import arc, blend, line, program

PART = program(
    line(x_end=2.0, y_end=0.1, feed=10.0),
    blend(0.25),
    arc("CCW", x_end=2.5, y_end=0.5, radius=0.5, choice=1),
    unit=Unit.IN,
    x=-1.0,
    start={"lookahead": Number(4.0), "z_bottom": Unread("-1/4x", "why")},
)


TEXT = """\
format = 1  # its last line is "# end of program"
units = "IN"  # every length and feed below is in it

[parameters]
path = "CONTROL"

[[tool]]
number = 1
type = "END MILL"
diameter = 0.5

[[block]]
kind = "MILL CONTOUR"
tool = 1
cutter_comp = "LEFT"
finish_tool = 0
x_start = -1.0
y_start = 0.0
z_start = 0.0
plunge_feed = 20.0
speed = 300
peck_depth = 0.0
lookahead = 4

[block.unread]
z_bottom = "-1/4x"

[[block.segment]]
kind = "LINE"
x_end = 2.0
y_end = 0.1
feed = 10.0

[[block.segment]]
kind = "BLEND ARC"
radius = 0.25

[[block.segment]]
kind = "ARC"
direction = "CCW"
x_end = 2.5
y_end = 0.5
radius = 0.5
choice = 1

# end of program
"""
