"""The journal of values that connect segments: relative numbers, TANGENT, parallels, picks."""

from __future__ import annotations

import json

from app.documents.contour_journal import altered, difference
from core.program.model import ArcSegment, Direction, LineSegment, Number, Relative


def test_values_that_connect_segments_are_read_back_from_the_journal() -> None:
    line = LineSegment(
        x_end=Relative(1.5),
        tangent=True,
        parallel=Number(1.0),
        offset=Number(2.0),
        point_x=Number(3.0),
        point_y=Number(4.0),
        point_dist=Number(5.0),
        pick_x=Number(6.0),
        pick_y=Number(7.0),
        choice=5,
    )
    arc = ArcSegment(Direction.CCW, x_center=Relative(-2.0), start_angle=Relative(90.0), choice=4096)
    for empty, segment in ((LineSegment(), line), (ArcSegment(), arc)):
        stored = json.loads(json.dumps(difference(empty, segment)))
        assert altered(empty, stored) == segment
