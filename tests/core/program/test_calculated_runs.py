"""Runs of segments calculated together: the golden cases, and the messages where there is no answer."""

from __future__ import annotations

import json
import random
from collections.abc import Callable
from itertools import product
from math import cos, dist, radians, sin, tan
from pathlib import Path
from typing import Any

import pytest

from core.geometry.piece import Arc
from core.program.edit import FormPlace, Refused, delete_segment, insert_segment, take_solution, type_field
from core.program.file.read import StoreError, loads
from core.program.file.write import dumps
from core.program.model import LineSegment, Number, Program, Unread
from core.program.solve.block import solve_block
from core.program.solve.solved import solution_at, untaken_pieces
from core.units import Unit, sentence
from tests.core.program.parts import postable
from tests.core.program.run_files import (
    codes,
    document,
    every_chain,
    keeps_coordinate,
    plain,
    program_of,
    solved,
    text_of,
)
from tests.random_runs import BruteForce, apart, random_case, walk

GOLDEN = json.loads((Path(__file__).parents[2] / "data/calculated_runs/golden.json").read_text(encoding="utf-8"))
SOLVED = [case for case in GOLDEN if case["solutions"]]
REFUSED = [case for case in GOLDEN if not case["solutions"]]


def name(case: dict[str, Any]) -> str:
    return str(case["name"])


def line(**typed: Any) -> dict[str, Any]:
    return {"kind": "LINE", **typed}


def ccw(**typed: Any) -> dict[str, Any]:
    return {"kind": "ARC", "direction": "CCW", **typed}


def cw(**typed: Any) -> dict[str, Any]:
    return {"kind": "ARC", "direction": "CW", **typed}


def case_of(*segments: dict[str, Any], start: tuple[float, float] = (0.0, 0.0)) -> dict[str, Any]:
    return {"start": list(start), "segments": list(segments)}


def texts_of(case: dict[str, Any]) -> list[str]:
    return [sentence(finding, Unit.MM) for segment in solved(case).segments for finding in segment.findings]


# the golden cases


@pytest.mark.parametrize("case", SOLVED, ids=name)
def test_golden_answers_come_in_their_order(case: dict[str, Any]) -> None:
    answers = [[{}]] if not (runs := document(case)["runs"]) else [run["solutions"] for run in runs]
    count = 1
    for solutions in answers:
        count *= len(solutions)
    assert count == len(case["solutions"])
    for index, expected in enumerate(case["solutions"]):
        choices = {run["first"]: run["solutions"][index]["choice"] for run in runs if len(run["solutions"]) > 1}
        result = document(case, choices)
        assert [run["solution"] for run in result["runs"]] == [0 if len(r["solutions"]) == 1 else index for r in runs]
        for segment, wanted in zip(result["segments"], expected["segments"], strict=True):
            for field in wanted.keys() - {"kind"}:
                assert segment[field]["value"] == pytest.approx(wanted[field], abs=1.5e-6), (segment["segment"], field)


@pytest.mark.parametrize("degrees", [40, 110, 200, 290])
def test_answer_numbers_stay_when_the_drawing_is_rotated(degrees: int) -> None:
    """The number of an answer does not depend on its place on the sheet, so a rotation keeps it."""
    case = next(case for case in SOLVED if case["name"].startswith("c24"))
    picked = {round(answer["total"], 6): answer["choice"] for answer in document(case)["runs"][0]["solutions"]}
    turned = document(_turned(case, radians(degrees)))["runs"][0]["solutions"]
    assert {round(answer["total"], 6): answer["choice"] for answer in turned} == picked


@pytest.mark.parametrize("case", SOLVED, ids=name)
def test_the_answers_of_a_moved_drawing_are_moved(case: dict[str, Any]) -> None:
    apart_by = {"x_end": 300, "y_end": -70, "x_center": 300, "y_center": -70}
    answers, moved = (
        [answer["segments"] for run in document(each)["runs"] for answer in run["solutions"]]
        for each in (case, _placed(case, lambda x, y: (x + 300, y - 70)))
    )
    wanted = [
        [
            {field: value + apart_by.get(field, 0) if field in apart_by else value for field, value in segment.items()}
            for segment in answer
        ]
        for answer in answers
    ]
    assert [len(answer) for answer in moved] == [len(answer) for answer in answers]
    for answer, other in zip(moved, wanted, strict=True):
        for segment, expected in zip(answer, other, strict=True):
            assert segment == pytest.approx(expected, abs=1e-5)


def _turned(case: dict[str, Any], angle: float) -> dict[str, Any]:
    return _placed(case, lambda x, y: (x * cos(angle) - y * sin(angle), x * sin(angle) + y * cos(angle)))


def _placed(case: dict[str, Any], point: Callable[[float, float], tuple[float, float]]) -> dict[str, Any]:
    """A case at another place; where only one coordinate is typed, the other counts as 0."""
    segments = [dict(segment) for segment in case["segments"]]
    for segment in segments:
        for x, y in (("x_center", "y_center"), ("x_end", "y_end"), ("point_x", "point_y")):
            typed = {x, y} & segment.keys()
            place = dict(zip((x, y), point(segment.get(x, 0), segment.get(y, 0)), strict=True))
            segment |= {field: place[field] for field in typed}
    return case_of(*segments, start=point(*case["start"]))


@pytest.mark.parametrize("case", REFUSED, ids=name)
def test_a_golden_case_without_answer_says_why(case: dict[str, Any]) -> None:
    block = solved(case)
    assert case["finding"] in codes(block)
    assert not postable(block)


@pytest.mark.parametrize("case", SOLVED, ids=name)
def test_typed_fields_have_no_tag_and_calculated_fields_have_cal(case: dict[str, Any]) -> None:
    block = document(case)
    if any(run["solution"] is None for run in block["runs"]):
        block = document(case, {run["first"]: run["solutions"][0]["choice"] for run in block["runs"]})
    tags = []
    for segment, typed in zip(block["segments"], case["segments"], strict=True):
        for field in ("x_end", "y_end", "length", "angle", "x_center", "y_center", "radius", "sweep"):
            if field in segment:
                tag = None if field in typed else "INC" if f"{field}_inc" in typed else "CAL"
                assert segment[field]["tag"] == tag, (segment["segment"], field)
                tags.append(tag)
    assert {None, "CAL"} <= set(tags)


# messages


BAD = [
    ("BEHIND", "2 would have to run 50.000 backwards at XY ANGLE 120: enter 300, or correct segment 1.",
     case_of(line(angle=30), line(x_end=100, y_end=0, angle=120))),
    ("BEHIND", "1 would have to run 20.000 backwards at XY ANGLE 0: enter 180, or correct its other fields.",
     case_of(line(angle=0, x_end=-20, point_x=3, point_y=0))),
    ("BEHIND", "2 would have to run 5.000 backwards at XY ANGLE 0: blank TANGENT, or correct its end.",
     case_of(line(x_end=10, y_end=0), line(tangent=True, x_end=5, y_end=0))),
    ("BEHIND", "2 would have to run 7.000 backwards at XY ANGLE 90: correct its relative angle or its end.",
     case_of(line(x_end=10, y_end=0), line(angle_inc=90, x_end=10, y_end=-7))),
    ("NO_MEETING", "Segments 1 and 2 are parallel, 50.000 apart: they never meet.",
     case_of(line(angle=0), line(x_end=100, y_end=50, angle=0))),
    ("NO_MEETING", "Segment 1 passes the circle of segment 2 at 46.961; its RADIUS is 15.000.",
     case_of(line(angle=30), ccw(x_end=75, y_end=-10, x_center=60, y_center=-10 - 9.585, radius=15))),
    ("UNDETERMINED", "Segments 1 and 2 run on one line: their joint may be anywhere. Enter one end.",
     case_of(line(angle=0), line(x_end=100, y_end=0, angle=0))),
    ("UNDETERMINED", "Segments 1 and 2 run on one circle: their joint may be anywhere. Enter one end.",
     case_of(ccw(x_center=0, y_center=0), ccw(x_center=0, y_center=0, x_end=-10, y_end=0), start=(10, 0))),
    ("TOO_SHORT", "XY LENGTH 30.000 and 30.000 do not reach: the points are 100.000 apart.",
     case_of(line(length=30), line(x_end=100, y_end=0, length=30))),
    ("TOO_SMALL", "RADIUS 10.000 cannot touch segment 1 and reach the end: it takes at least 15.000.",
     case_of(line(angle=0), ccw(tangent=True, radius=10, x_end=60, y_end=30))),
    ("TOO_LARGE", "RADIUS 70.000 does not fit between segments 1 and 3: the largest is 39.999.",
     case_of(line(angle=0), ccw(tangent=True, radius=70), line(tangent=True, angle=90, x_end=60, y_end=40))),
    ("INSIDE", "The point 45.000 20.000 lies inside the circle of segment 2: no line from it is tangent.",
     case_of(line(), ccw(tangent=True, x_center=50, y_center=20, radius=15, x_end=65, y_end=20), start=(45, 20))),
    ("NO_TANGENT", "Segments 1 and 3 overlap: no line runs from one to the other with these DIRECTIONS.",
     case_of(ccw(x_center=0, y_center=0, radius=20), line(tangent=True),
             cw(tangent=True, x_center=10, y_center=0, radius=20, x_end=10, y_end=20), start=(0, -20))),
    ("WRONG_SENSE", "DIRECTION CW: a tangent arc to this end turns CCW.",
     case_of(line(x_end=50, y_end=0), cw(tangent=True, x_end=70, y_end=20))),
    ("CONTRADICTION", "XY LENGTH is 49.000, but 50.000 by segments 1 and 2: correct or blank one of them.",
     case_of(line(angle=30), line(x_end=100, y_end=0, angle=300, length=49))),
    ("CONTRADICTION", "XY ANGLE comes to 33.690, but 0.000 by PARALLEL TO: correct the end, or blank PARALLEL TO.",
     case_of(line(x_end=50, y_end=0), line(parallel=1, x_end=80, y_end=20))),
    ("OUT_OF_RANGE", "Segments 1 and 2 are parallel but for 0.001 degrees.",
     case_of(line(angle=30), line(x_end=100, y_end=0, angle=29.999))),
    ("MISSING", "Segments 1 to 3 need 1 more value: RADIUS of 2, or an end (X END or Y END).",
     case_of(line(angle=0), ccw(tangent=True), line(tangent=True, angle=90, x_end=60, y_end=40))),
    ("MISSING", "Segments 1 to 4 need 1 more value: XY LENGTH of 3, or an end (X END or Y END).",
     case_of(line(angle=30), ccw(tangent=True, radius=5),
             line(tangent=True, angle=120, point_dist=20, point_x=0, point_y=0), line(angle=200, x_end=-50))),
    ("PICK_SOLUTION", "Two solutions fit: pick one on SOLUTION.",
     case_of(line(angle=30), line(x_end=70, y_end=10, length=40))),
    ("NOT_YET", "Segments 1 and 2 cannot be calculated from these data yet: enter one end, or a center.",
     case_of(line(length=40), ccw(tangent=True, x_end=60, y_end=20, sweep=90))),
    ("NOT_YET", "cannot be calculated from these data yet: enter one end, a center, or TANGENT YES on 2.",
     case_of(ccw(radius=30, x_center=30, y_center=10), line(x_end=60, y_end=20))),
    ("TANGENT_PLACE", "Segment 1 has no segment before it to which it could be tangent: blank TANGENT.",
     case_of(line(tangent=True, x_end=5, y_end=5))),
    ("TANGENT_PLACE", "TANGENT cannot follow a BLEND ARC, which stands at a corner",
     case_of(line(x_end=5, y_end=5), {"kind": "BLEND ARC", "radius": 1}, line(tangent=True, x_end=9, y_end=0))),
    ("INSIDE", "The point 3.000 4.000 is only 5.000 away: no line passes it at 9.000.",
     case_of(line(point_x=3, point_y=4, point_dist=9), line(x_end=50, y_end=90))),
    ("INSIDE", "The point 3.000 4.000 is only 5.000 away: no line passes it at 9.000.",
     case_of(line(angle=90), line(point_x=3, point_y=4, point_dist=9, x_end=0, y_end=0), start=(-50, 0))),
    ("CONTRADICTION", "The point 20.000 5.000 is 5.000 from segment 1, not 4.000: correct or blank it.",
     case_of(line(x_end=40, y_end=0, point_x=20, point_y=5, point_dist=4))),
    ("CONTRADICTION", "XY ANGLE is I30, but I0.000 by its other fields: correct or blank one of them.",
     case_of(line(x_end=40, y_end=0), line(angle_inc=30, x_end=60, y_end=0))),
    ("CONTRADICTION", "Segment 2 is not tangent to the one before: the corner turns by 2.862 degrees. Blank TANGENT",
     case_of(line(x_end=40, y_end=0), line(tangent=True, x_end=60, y_end=1))),
    ("CONTRADICTION", "XY ANGLE is 10.000, but 0.000 by PARALLEL TO: correct or blank one of them.",
     case_of(line(x_end=40, y_end=0), line(parallel=1, angle=10, length=5))),
    ("CONTRADICTION", "RADIUS is 20.000, but 21.000 by segments 1 and 2: correct or blank one of them.",
     case_of(line(angle=0), ccw(x_center=50, y_center=20, radius=20, x_end=50, y_end=41))),
    ("RADII_DIFFER", "The arc's radius is 40.000 at its start and 41.000 at its end: correct the end or the center.",
     case_of(line(x_end=40, y_end=0), ccw(x_center=0, y_center=0, radius=40, x_end=0, y_end=41))),
    ("PARALLEL_TO", "PARALLEL TO 2: segment 2 is not a LINE. Enter the number of an earlier LINE.",
     case_of(line(x_end=5, y_end=5), ccw(radius=5, x_end=9, y_end=9), line(parallel=2, x_end=20, y_end=0))),
    ("CONTRADICTION", "XY ANGLE comes to 53.130, but 45.000 by PARALLEL TO: correct the end, or blank PARALLEL TO.",
     case_of(line(x_end=50, y_end=50), line(parallel=1, x_end=80, y_end=90))),
    ("CONTRADICTION", "Segment 2 is not tangent to the one before: the corner turns by -2.862 degrees.",
     case_of(line(x_end=40, y_end=0), line(tangent=True, x_end=60, y_end=-1))),
    ("INSIDE", "The point 5.000 0.000 lies inside the circle of segment 1: no line from it is tangent.",
     case_of(ccw(x_center=0, y_center=0, radius=20), line(tangent=True, x_end=5, y_end=0), start=(0, -20))),
    ("TOO_SMALL", "RADIUS 1.000 fits nowhere between the segments before and after segment 1.",
     case_of(ccw(radius=1), line(tangent=True, angle=0, x_end=5, y_end=5))),
    ("MISSING", "Segments 1 to 3 need 1 more value: XY LENGTH of 2, or an end (X END or Y END), or TANGENT YES on 3.",
     case_of(ccw(x_center=10, y_center=0), line(tangent=True), line(angle=90, x_end=60, y_end=50))),
    ("MISSING", "Segments 1 to 3 need 1 more value: RADIUS of 2, or an end (X END or Y END), or TANGENT YES on 2.",
     case_of(line(angle=0), ccw(x_center=20, y_center=5), line(angle=90, x_end=60, y_end=50))),
    ("MISSING", "Segments 1 to 3 need 2 more values: XY ANGLE of 2, or an end (X END or Y END).",
     case_of(ccw(x_center_inc=20, y_center_inc=5), line(), line(angle=90, x_end=60, y_end=50))),
    ("MISSING", "Segments 1 and 2 need 2 more values: SWEEP ANGLE of 1, or an end (X END or Y END), or TANGENT YES on",
     case_of(ccw(radius=1), ccw(radius=1, x_end=50, y_end=5))),
    ("PARALLEL_TO", "PARALLEL TO 2 is not before segment 2: enter the number of an earlier LINE.",
     case_of(line(x_end=5, y_end=5), line(parallel=2, x_end=9, y_end=0))),
]  # fmt: skip


def test_the_largest_radius_that_is_named_works_and_the_next_does_not():
    case = next(case for code, _, case in BAD if code == "TOO_LARGE")
    line_before, arc_between, line_after = case["segments"]
    works, fails = (
        {**case, "segments": [line_before, {**arc_between, "radius": radius}, line_after]} for radius in (39.999, 40)
    )
    assert "TOO_LARGE" not in codes(solved(works))
    assert "TOO_LARGE" in codes(solved(fails))


@pytest.mark.parametrize(("code", "text", "case"), BAD, ids=[f"{code}-{at}" for at, (code, _, _) in enumerate(BAD)])
def test_a_run_without_answer_says_why_with_numbers(code: str, text: str, case: dict[str, Any]) -> None:
    assert code in codes(solved(case))
    assert any(text in each for each in texts_of(case)), texts_of(case)


@pytest.mark.parametrize("blank", ["length", "angle"])
def test_blanking_either_of_two_contradictory_numbers_resolves_the_contradiction(blank: str) -> None:
    last = line(x_end=100, y_end=0, angle=300, length=49)
    del last[blank]
    assert "CONTRADICTION" not in codes(solved(case_of(line(angle=30), last)))


def test_a_contradiction_names_the_value_that_the_other_numbers_give() -> None:
    """The message for a slightly wrong LENGTH or XY ANGLE of a golden case names the value that blanking it gives."""
    tested = 0
    for case in SOLVED:
        runs = document(case)["runs"]
        if len(runs) != 1 or len(runs[0]["solutions"]) != 1:
            continue
        for solution in runs[0]["solutions"][0]["segments"]:
            index = solution["segment"] - 1
            segment = case["segments"][index]
            for field, wrong in (("angle", 1.0), ("length", 0.5)):
                if segment["kind"] != "LINE" or {field, f"{field}_inc"} & segment.keys() or field not in solution:
                    continue
                surplus = {**segment, field: solution[field] + wrong}
                others = case["segments"]
                changed = {**case, "segments": [*others[:index], surplus, *others[index + 1 :]]}
                label = {"angle": "XY ANGLE", "length": "XY LENGTH"}[field]
                # the message may name another number of the case
                begin = f"{label} is {surplus[field]:.3f}, "
                texts = [text for text in texts_of(changed) if text.startswith(begin)]
                tested += len(texts)
                assert all(f"but {solution[field]:.3f} by " in text for text in texts), (case, field, texts)
    assert tested > 10


# corners, choices, relations


def test_each_piece_starts_at_the_end_of_the_piece_before() -> None:
    """This includes a short arc whose end is moved onto its circle."""
    tiny = ccw(x_center=0, y_center=0)
    last = line(angle=90, length=50, x_end=5.001, y_end=50.005)
    first, second = solved(case_of(tiny, last, start=(5, 0))).segments
    assert first.piece is not None
    assert second.piece is not None
    assert dist(first.piece.end, second.piece.start) <= 1e-7


def test_a_blend_in_a_run_is_inserted_at_the_sharp_corner() -> None:
    block = solved(case_of(line(angle=30), {"kind": "BLEND ARC", "radius": 5}, line(x_end=100, y_end=0, angle=300)))
    arc = block.segments[1].piece
    assert isinstance(arc, Arc)
    assert dist(arc.start, (70.669873, 40.801270)) < 1e-6
    assert dist(arc.end, (77.5, 38.971143)) < 1e-6
    assert dist(arc.center, (73.169873, 36.471143)) < 1e-6
    assert arc.turn < 0
    assert [(run.first, run.last) for run in block.runs] == [(1, 3)]


@pytest.mark.parametrize("corner", [{"kind": "BLEND ARC", "radius": 5}, {"kind": "CHAMFER", "length": 5}])
def test_tangent_is_not_offered_after_a_corner_segment(corner: dict[str, Any]) -> None:
    last = line(x_end=100, y_end=0)
    assert any("TANGENT YES on 2" in text for text in texts_of(case_of(line(angle=30), ccw(), last)))
    after_corner = texts_of(case_of(line(angle=30), corner, ccw(), last))
    assert any("more value" in text for text in after_corner)
    assert not any("TANGENT YES on 3" in text for text in after_corner)
    first_of_run = texts_of(case_of(line(x_end=50, y_end=0), corner, ccw(), last))
    assert any("more value" in text for text in first_of_run)
    assert not any("TANGENT YES on 3" in text for text in first_of_run)


def test_parallel_to_that_contradicts_calculated_ends_does_not_ask_to_blank_an_angle() -> None:
    texts = texts_of(case_of(line(x_end=50, y_end=0), line(parallel=1, x_end=80, y_end=20)))
    assert "XY ANGLE comes to 33.690, but 0.000 by PARALLEL TO: correct the end, or blank PARALLEL TO." in texts
    texts = texts_of(case_of(line(x_end=50, y_end=0), line(parallel=1, angle=30, x_end=80)))
    assert "XY ANGLE is 30.000, but 0.000 by PARALLEL TO: correct or blank one of them." in texts
    texts = texts_of(case_of(line(x_end=50, y_end=-50), line(parallel=1, angle=-30, x_end=80)))
    assert "XY ANGLE is -30.000, but -45.000 by PARALLEL TO: correct or blank one of them." in texts


def test_a_chamfer_in_a_run_is_inserted_at_the_sharp_corner() -> None:
    block = solved(case_of(line(angle=30), {"kind": "CHAMFER", "length": 5}, line(x_end=100, y_end=0, angle=300)))
    cut = block.segments[1].piece
    assert cut is not None
    assert dist(cut.start, (75.0, 43.301270)) == pytest.approx(5.0)
    assert dist(cut.end, (75.0, 43.301270)) == pytest.approx(5.0)


def test_a_tangent_next_segment_selects_the_solution() -> None:
    case = case_of(line(angle=30), line(length=40, x_end=70, y_end=10), line(tangent=True, length=10))
    assert [len(run.answers) for run in solved(case).runs] == [2]
    end = solved(case, {1: 0}).segments[1].end
    assert end == (70.0, 10.0)
    heading = next(s for s in document(case, {1: 0})["segments"] if s["segment"] == 2)["angle"]["value"]
    decided = case_of(line(angle=30), line(length=40, x_end=70, y_end=10), line(tangent=True, angle=heading, length=10))
    block = solved(decided)
    assert block.runs[0].taken == 0
    assert block.fully_determined


def test_a_tangent_line_after_an_arc_selects_one_of_two_centers() -> None:
    exact = case_of(ccw(x_end=10, y_end=10, radius=10), line(tangent=True, x_end=10, y_end=30))
    block = solved(exact)
    assert block.fully_determined
    assert block.segments[0].piece is not None
    assert getattr(block.segments[0].piece, "center", None) == pytest.approx((0.0, 10.0))


def test_a_tangent_line_after_an_arc_may_miss_it_by_rounding_only() -> None:
    """The two centers lie sqrt(radius^2 - 10^2) above and below the chord, where an exact half circle has its one."""
    rounded = solved(case_of(ccw(x_end=20, y_end=0, radius=10.0001), line(tangent=True, x_end=20, y_end=30)))
    assert rounded.fully_determined
    assert codes(rounded) == []
    assert getattr(rounded.segments[0].piece, "center", None) == pytest.approx((10.0, 0.0), abs=0.05)
    larger = solved(case_of(ccw(x_end=20, y_end=0, radius=10.1), line(tangent=True, x_end=20, y_end=30)))
    assert codes(larger) == ["PICK_SOLUTION"]


def test_fields_show_the_solution_of_the_run_and_not_of_the_segment_alone() -> None:
    case, truth = random_case(101723)
    chains, _ = every_chain(case)
    assert any(apart(chain, truth) < 1e-6 for chain in chains)
    for choice in (0, 2):
        for segment in solved(case, {1: choice}).segments:
            value = segment.values["y_end"]
            assert segment.end is not None
            assert getattr(value, "value", None) == pytest.approx(segment.end[1], abs=1e-9)


def test_relative_numbers_count_from_the_start_and_from_the_heading_before() -> None:
    block = solved(
        case_of(
            line(x_end=10, y_end=10),
            line(x_end_inc=5, y_end_inc=-2),
            line(angle_inc=90, length=3),
            ccw(tangent=True, x_center_inc=-1, y_center_inc=0.4, sweep=90),
        )
    )
    assert block.segments[1].end == (15.0, 8.0)
    second, third = block.segments[1].piece, block.segments[2].piece
    assert second is not None
    assert third is not None
    (a, b), (c, d) = second.direction_at(second.end), third.direction_at(third.start)
    assert a * c + b * d == pytest.approx(0.0, abs=1e-12)
    assert a * d - b * c > 0.0


def test_a_line_keeps_its_coordinate_inside_a_run() -> None:
    block = solved(case_of(line(angle=30), line(x_end=50), line(x_end=60, y_end=10, angle=300)))
    second = block.segments[1].piece
    assert second is not None
    assert second.start[1] == pytest.approx(second.end[1])
    assert str(getattr(block.segments[1].values["y_end"], "origin", "")) == "SAME"


def test_a_parallel_line_with_an_offset_may_lie_on_either_side() -> None:
    case = case_of(line(x_end=60, y_end=0), line(length=65), line(parallel=1, offset=25, x_end=10))
    heights = [plain(answer)[-1]["y_end"] for answer in solved(case).runs[0].answers]
    assert heights == pytest.approx([25.0, -25.0, 25.0, -25.0])


def test_a_line_at_a_distance_from_a_point_has_both_answers() -> None:
    case = case_of(line(point_x=50, point_y=20, point_dist=10, x_end=-90))
    for answer in solved(case).runs[0].answers:
        assert walk(case, plain(answer)) < 1e-7
    assert len(solved(case).runs[0].answers) == 2


def test_a_tangent_line_along_an_axis_follows_from_the_height_of_both_its_ends() -> None:
    # both tangent lines are 20 long to the corner at 0,0, and the arc turns by 225 degrees between them
    case = case_of(line(length=20, angle=225), cw(tangent=True, y_end=0), line(x_end=0, y_end=0, tangent=True))
    _, arc, last = document(case)["segments"]
    center = -20.0 * tan(radians(22.5))
    assert [arc[name]["value"] for name in ("x_end", "y_end", "y_center")] == pytest.approx(
        [-20.0, 0.0, center], abs=1e-7
    )
    assert (last["angle"]["value"], last["length"]["value"]) == pytest.approx((0.0, 20.0), abs=1e-7)


@pytest.mark.parametrize(("make", "side"), [(ccw, 1.0), (cw, -1.0)])
def test_a_relative_center_gives_radius_and_heading_when_the_start_is_unknown(make: Any, side: float) -> None:
    arc = make(x_center_inc=0, y_center_inc=10 * side, x_end=60, y_end=10 * side)
    # the other answer turns through 270 degrees to the same end
    answer, _ = solved(case_of(line(angle=0), arc)).runs[0].answers
    first, second = plain(answer)
    assert (first["x_end"], first["y_end"]) == pytest.approx((50.0, 0.0))
    assert (second["x_center"], second["y_center"]) == pytest.approx((50.0, 10.0 * side))


def test_tangent_is_offered_only_where_a_heading_is_open() -> None:
    sides = line(x_end=100, y_end=0), line(x_end=100, y_end=60), line(angle=180), line(angle=240)
    texts = texts_of(case_of(*sides, cw(x_center=40, y_center=30, radius=6), line(angle=60)))
    assert any("or TANGENT YES on 5." in text for text in texts), texts


def test_a_radius_that_follows_from_start_and_center_is_not_requested() -> None:
    texts = texts_of(case_of(ccw(x_center=0, y_center=20), cw(radius=30, tangent=True)))
    assert any("2 more values: SWEEP ANGLE of 1, or an end" in text for text in texts), texts


def test_a_center_coordinate_along_the_chord_determines_nothing_if_the_joint_is_rounded() -> None:
    second = cw(x_end=5.6569, y_end=-4.798, x_center=3.5863, y_center=2.9294, start_angle=285.0)
    assert codes(solved(case_of(cw(x_center=5.6569), second, start=(0.0, 5.0)))) == ["NOT_YET"]
    answers = document(case_of(cw(x_center=5.6569, radius=8.0), second, start=(0.0, 5.0)))["runs"][0]["solutions"]
    assert [answer["segments"][0]["y_center"] for answer in answers] == pytest.approx([-0.6568, 10.6568], abs=1e-3)


def test_a_center_coordinate_along_the_radius_at_the_start_determines_nothing_if_the_heading_is_rounded() -> None:
    before = line(length=25.0, angle=40.0), line(x_end=19.1511, y_end=40.0)
    result = solved(case_of(*before, cw(tangent=True, x_end=39.1511, y_center=40.0001)))
    assert codes(result) == ["NOT_YET"]


def test_an_end_coordinate_that_stays_along_the_line_determines_nothing_if_the_heading_is_rounded() -> None:
    before = line(length=25.0, angle=40.0), line(x_end=19.1511, y_end=40.0), cw(tangent=True, radius=10.0, sweep=90.0)
    assert codes(solved(case_of(*before, line(tangent=True, y_end=50.0001)))) == ["NOT_YET"]
    assert codes(solved(case_of(before[0], line(angle=0.0001, y_end=16.07)))) == ["MISSING"]


def test_ends_of_a_line_that_differ_from_its_tangent_arc_by_rounding_are_taken() -> None:
    """The top of the second arc is at Y 11.919; both ends of the line are typed as 11.92."""
    top = line(tangent=True, angle=0.0, y_end=11.92)
    last = cw(tangent=True, x_center=44.236, y_center=9.756, radius=2.163, y_end=7.593)
    block = solved(case_of(line(angle=30.0), cw(tangent=True, radius=5.0, y_end=11.92), top, last))
    assert block.fully_determined


def test_a_full_circle_may_be_tangent() -> None:
    block = solved(case_of(line(x_end=50, y_end=0), ccw(tangent=True, x_end=50, y_end=0, x_center=50, y_center=10)))
    assert block.fully_determined
    assert block.segments[1].piece is not None
    assert block.segments[1].piece.length == pytest.approx(radians(360) * 10)


def test_a_picked_answer_that_vanishes_must_be_picked_again() -> None:
    case = case_of(line(angle=30), line(length=40, x_end=70, y_end=10))
    assert [solved(case, {1: choice}).runs[0].taken for choice in (0, 1)] == [0, 1]
    # only the second answer is left, and it stands in for no other
    case["segments"][1]["x_end"] = 10.0
    kept, gone = solved(case, {1: 1}), solved(case, {1: 0})
    assert [answer.choice for answer in kept.runs[0].answers] == [1]
    assert (kept.runs[0].taken, codes(kept)) == (0, [])
    assert [answer.choice for answer in gone.runs[0].answers] == [1]
    assert (gone.runs[0].taken, codes(gone)) == (None, ["PICK_SOLUTION"])
    grazing = case_of(line(angle=0), line(length=10, x_end=50, y_end=10))
    assert solved(grazing).runs[0].taken == 0
    assert "PICK_SOLUTION" in codes(solved(grazing, {1: 1}))


def test_the_picked_answer_never_jumps_under_small_edits() -> None:
    rng = random.Random(7)
    steps = 0
    for case in (each for each in SOLVED if len(each["solutions"]) > 1):
        for answer in solved(case).runs[0].answers:
            choices = {solved(case).runs[0].first: answer.choice or 0}
            before = solved(case, choices)
            for _ in range(12):
                step = rng.uniform(-0.01, 0.01)
                case = {**case, "start": [case["start"][0] + step, case["start"][1] + step / 2.0]}
                after = solved(case, choices)
                if after.runs[-1].taken is None:
                    assert "PICK_SOLUTION" in codes(after) or not after.runs[-1].answers
                    break
                for old, new in zip(before.segments, after.segments, strict=True):
                    assert old.end is not None
                    assert new.end is not None
                    assert dist(old.end, new.end) <= 100.0 * abs(step) + 1e-9
                steps += 1
                before = after
    assert steps > 200


# what screens and drawings use


def test_the_solution_field_lists_the_shortest_answer_first() -> None:
    case = next(each for each in SOLVED if name(each).startswith("c24"))
    program = program_of(case)
    asked = solution_at(solve_block(program.blocks[0], program), 2)
    assert asked is not None
    assert (asked.number, asked.label, asked.labels) == (1, "? of 2", ("1 of 2", "2 of 2"))
    for index in (-1, 2):
        assert take_solution(program, FormPlace(1, 3), index) == Refused("There is no such solution to pick here.")
    other = take_solution(program, FormPlace(1, 3), 0)
    assert isinstance(other, Program)
    assert solve_block(other.blocks[0], other).segments[0].end == pytest.approx((18.413365, 12.193081), abs=1e-6)
    taken = take_solution(program, FormPlace(1, 3), 1)
    assert isinstance(taken, Program)
    block = solve_block(taken.blocks[0], taken)
    shown = solution_at(block, 1)
    assert shown is not None
    assert shown.label == "2 of 2"
    assert block.segments[0].end == pytest.approx((15.925097, 32.099227), abs=1e-6)
    ((first, *_),) = untaken_pieces(block, 3)
    assert first.end == pytest.approx((18.413365, 12.193081), abs=1e-6)


def test_the_two_arcs_of_a_single_segment_are_solutions_too() -> None:
    """Radius 5 from 0 0 to 6 0, counterclockwise: the center is 4 above or below the chord."""
    program = program_of(case_of(ccw(radius=5, x_end=6, y_end=0)))
    block = solve_block(program.blocks[0], program)
    asked = solution_at(block, 1)
    assert asked is not None
    assert (asked.number, asked.label, untaken_pieces(block, 1)) == (1, "? of 2", ())
    assert [solution_at(block, number) for number in (0, 2)] == [None, None]
    for index in (0, 1):
        taken = take_solution(program, FormPlace(1, 1), index)
        assert isinstance(taken, Program)
        block = solve_block(taken.blocks[0], taken)
        shown = solution_at(block, 1)
        assert shown is not None
        assert (shown.label, block.segments[0].sharp) == (f"{index + 1} of 2", block.segments[0].choices[index])
        ((other,),) = untaken_pieces(block, 1)
        assert other == block.segments[0].choices[1 - index]
    centers = [choice.center for choice in block.segments[0].choices if isinstance(choice, Arc)]
    assert sorted(centers) == [pytest.approx((3.0, -4.0)), pytest.approx((3.0, 4.0))]


def test_the_picked_solution_survives_a_new_number_but_no_new_field() -> None:
    case = case_of(line(angle=30), line(x_end=70, y_end=10, length=40))
    program = program_of(case, {1: 1})
    again = type_field(program, FormPlace(1, 2), "length", Number(41.0))
    assert isinstance(again, Program)
    assert again.blocks[0].segments[0].choice == 1
    other = type_field(program, FormPlace(1, 2), "angle", Number(300.0))
    assert isinstance(other, Program)
    assert other.blocks[0].segments[0].choice is None


def test_parallel_to_follows_its_segment_when_segments_are_inserted_or_deleted() -> None:
    program = program_of(case_of(line(x_end=60, y_end=0), line(angle=70), line(parallel=1, offset=25, x_end=10)))
    longer = insert_segment(program, FormPlace(1, 1), LineSegment(Number(5.0), Number(-5.0)))
    assert isinstance(longer, Program)
    assert longer.blocks[0].segments[3].parallel == Number(2.0)
    shorter = delete_segment(program, FormPlace(1, 1))
    assert isinstance(shorter, Program)
    assert shorter.blocks[0].segments[1].parallel == Unread("1", "Segment 1 was deleted.")


def test_an_incomplete_run_is_sketched_as_far_as_it_is_known() -> None:
    block = solved(case_of(line(angle=0), ccw(tangent=True), line(tangent=True, angle=90, x_end=60, y_end=40)))
    (run,) = block.runs
    assert (run.first, run.last, run.missing, run.taken) == (1, 3, 1, None)
    first, last = block.segments[0].sketch, block.segments[2].sketch
    assert first is not None
    assert last is not None
    assert first.direction_at(first.start) == pytest.approx((1.0, 0.0))
    assert last.end == (60.0, 40.0)
    assert (run.sketch[-1].start, run.sketch[-1].end) == ((0.0, 0.0), (60.0, 40.0))
    assert block.segments[1].missing == ("radius",)


# the pick on the drawing


PICKED = case_of(line(length=40), ccw(tangent=True, x_end=60, y_end=20, sweep=90))


def test_a_pick_takes_the_nearest_answer_of_a_run_that_the_steps_cannot_solve() -> None:
    first = solved(case_of(line(length=40, pick_x=30, pick_y=-10), *PICKED["segments"][1:])).runs[0]
    assert first.taken is not None
    for answer in first.answers:
        assert walk(PICKED, plain(answer)) < 1e-7
    pick = first.answers[first.taken].pick
    assert pick is not None
    again = solved(case_of(line(length=40, pick_x=pick[0], pick_y=pick[1]), *PICKED["segments"][1:])).runs[0]
    assert again.taken is not None
    assert apart(plain(again.answers[again.taken]), plain(first.answers[first.taken])) < 1e-6


def test_taking_the_answer_that_a_far_pick_left_moves_the_pick_to_its_joint() -> None:
    """A line of 40, then a quarter circle from (40, 0) to (60, 20)."""
    program = program_of(case_of(line(length=40, pick_x=100, pick_y=0), *PICKED["segments"][1:]))
    taken = take_solution(program, FormPlace(1, 2), 0)
    assert isinstance(taken, Program)
    first = taken.blocks[0].segments[0]
    assert isinstance(first, LineSegment)
    assert (first.pick_x.value, first.pick_y.value) == pytest.approx((40.0, 0.0))
    assert solve_block(taken.blocks[0], taken).fully_determined
    assert isinstance(take_solution(program, FormPlace(2, 1), 0), Refused)


def test_a_pick_far_from_every_answer_takes_none() -> None:
    block = solved(case_of(line(length=40, pick_x=-500, pick_y=300), *PICKED["segments"][1:]))
    assert block.runs[0].taken is None
    assert set(codes(block)) & {"PICK_SOLUTION", "NOT_YET"}


def test_a_pick_takes_no_answer_that_only_approximates_the_data() -> None:
    case = case_of(
        ccw(x_center=-51.99792541693032, sweep=134.28928966594114),
        cw(y_center=-13.852276233289533, x_end=5.536180196084601),
        cw(
            x_end=-25.497171352993604,
            y_end=-46.94453235844928,
            x_center=-27.534324247541257,
            y_center=-13.928157043256764,
            tangent=True,
        ),
        start=(-48.90262986985844, -23.82333450373656),
    )
    # at this pick a chain misses the last center by 0.0007 mm, and no further step brings it nearer
    chains, _ = every_chain(case, {1: (-40.43723078354757, 12.375201802314528)})
    assert chains
    for chain in chains:
        assert walk(case, chain) < 1e-7


# random runs


@pytest.mark.parametrize("points", [False, True])
def test_random_runs_are_solved_and_every_answer_meets_the_data(points: bool) -> None:
    count = 0
    for seed in range(9000, 9120):
        case, truth = random_case(seed, points=points)
        if keeps_coordinate(case) or BruteForce(case).condition(truth) < 1e-5:
            continue
        runs = solved(case).runs
        if not runs or runs[0].code in ("NOT_YET", "MISSING"):
            continue
        chains, waits = every_chain(case)
        if waits:
            continue
        count += 1
        assert any(apart(chain, truth) < 1e-6 for chain in chains), seed
        for chain in chains:
            assert walk(case, chain) < 1e-7, seed
    assert count > 15


@pytest.mark.parametrize("seed", [9001, 9013, 9030, 9046, 9063, 9078])
def test_brute_force_finds_the_same_answers(seed: int) -> None:
    while True:
        case, truth = random_case(seed, 2, 3)
        if (
            not keeps_coordinate(case)
            and BruteForce(case).condition(truth) > 1e-4
            and len(chains := every_chain(case)[0]) > 1
        ):
            break
        seed += 1000
    expected = BruteForce(case).answers(600)
    assert all(any(apart(chain, other) < 1e-3 for other in expected) for chain in chains), seed
    assert all(any(apart(chain, other) < 1e-3 for chain in chains) for other in expected), seed


# the file


def test_the_new_keys_survive_a_file_and_make_it_format_2() -> None:
    for case, choice in product(GOLDEN, (None, 3)):
        program = program_of(case, None if choice is None else {1: choice})
        assert loads(dumps(program), "again") == program
    assert dumps(program_of(case_of(line(x_end=1, y_end=2)))).startswith("format = 1")
    assert dumps(program_of(case_of(line(x_end=1, y_end_inc=2)))).startswith("format = 2")


@pytest.mark.parametrize(
    ("segment", "text"),
    [
        (line(x_end=1, x_end_inc=2), "x_end appears twice, as x_end and as x_end_inc: remove one."),
        (line(tangent=1), "tangent cannot be 1.0: write true or false."),
        (line(tangent=True, angle_inc=3), "tangent = true says what angle_inc says: remove one."),
        (line(length_inc=3), "length_inc is not a key of"),
    ],
)
def test_invalid_keys_are_refused_by_name(segment: dict[str, Any], text: str) -> None:
    with pytest.raises(StoreError) as refused:
        loads(text_of(case_of(segment)), "x.toml")
    assert text in refused.value.text


def test_inch_and_millimeter_programs_have_the_same_answers() -> None:
    case = next(each for each in SOLVED if name(each).startswith("c24"))
    inches = {
        "start": [number / 25.4 for number in case["start"]],
        "segments": [in_inches(s) for s in case["segments"]],
    }
    program = loads(text_of(inches, {1: 1}, "IN"), "x")
    block = solve_block(program.blocks[0], program)
    expected = solved(case, {1: 1}).segments[1].end
    assert expected is not None
    assert block.segments[1].end == pytest.approx(expected, abs=1e-9)


def in_inches(segment: dict[str, Any]) -> dict[str, Any]:
    lengths = ("x_end", "y_end", "x_center", "y_center", "radius", "length")
    return {key: value / 25.4 if key in lengths else value for key, value in segment.items()}


def test_random_runs_with_relative_numbers_have_the_original_among_their_answers() -> None:
    solved_runs = relative_runs = 0
    for seed in range(300000, 300120):
        case, truth = random_case(seed, 2, 4, relative=True)
        if keeps_coordinate(case):
            continue
        chains, waits = every_chain(case)
        for chain in chains:
            assert walk(case, chain) < 1e-6, seed
        if chains and not waits:
            assert min(apart(chain, truth) for chain in chains) < 1e-5, seed
            solved_runs += 1
            relative_runs += any(name.endswith("_inc") for segment in case["segments"] for name in segment)
    assert solved_runs > 20
    assert relative_runs > 15


def test_an_end_coordinate_that_the_angle_implies_adds_no_value() -> None:
    """From (100, 60) along 180 degrees Y stays 60, typed or not, so the missing data are the same."""
    rest = (cw(radius=6, tangent=True), ccw(radius=15, x_center=50, y_center=60, tangent=True))
    texts = []
    for first in (line(angle=180), line(y_end=60, angle=180)):
        case = case_of(first, *rest, cw(radius=6, tangent=True), line(x_end=0, y_end=60), start=(100.0, 60.0))
        texts.append(texts_of(case))
    assert texts[0] == texts[1]
    assert "2 more values" in texts[0][0]


def test_the_angle_of_a_line_to_the_right_is_0_and_not_360() -> None:
    case = case_of(
        line(angle=0),
        ccw(tangent=True, x_center=30, radius=15),
        line(tangent=True, angle=180),
        ccw(tangent=True, x_center=-30, radius=15),
        line(tangent=True, x_end=0, y_end=-15),
        start=(0, -15),
    )
    assert document(case)["segments"][-1]["angle"]["value"] == pytest.approx(0.0, abs=1e-6)
