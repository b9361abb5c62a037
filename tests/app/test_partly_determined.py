"""Of a contour that is not determined to its end, every screen says which segments the verdict is about."""

from __future__ import annotations

from dataclasses import replace

import pytest

from app.documents.files import load
from app.documents.programs import example
from app.painted.widgets.rows import text_of
from app.painted.widgets.strip import strip
from core.pipeline.derive import derive, look_ahead_table
from core.program.edit import FormPlace, Refused, type_field
from core.program.model import ArcSegment, Direction, Number, Program
from tests.app.operator import Operator


def without_end(number: int, part: str = "pocket") -> Program:
    """An example with both ends of a segment blank; with one of them a LINE keeps the other coordinate."""
    outcome = load(example(part))
    for name in ("x_end", "y_end"):
        edited = type_field(outcome, FormPlace(1, number), name, None)
        assert not isinstance(edited, Refused)
        outcome = edited
    return outcome


@pytest.mark.parametrize(
    ("part", "number", "alone"),
    [("overrun-square", 2, "of segment 1 alone"), ("pocket", 6, "of segments 1-5 alone")],
)
def test_the_strip_tells_what_was_judged_and_recommends_nothing(part: str, number: int, alone: str) -> None:
    program = without_end(number, part)
    found = derive(program).blocks[0]
    table = look_ahead_table(found, program)
    assert table is not None
    for known in (table, None):
        told = text_of(strip(found, known, program.unit))
        assert told.endswith(alone)
        assert "best" not in told


def test_what_is_whole_says_nothing_of_it() -> None:
    program = load(example("pocket"))
    found = derive(program).blocks[0]
    assert "alone" not in text_of(strip(found, look_ahead_table(found, program), program.unit))


def test_an_end_that_is_not_known_is_not_told_to_be_open() -> None:
    found = derive(without_end(6)).blocks[0]
    assert not {"OPEN", "NEARLY_CLOSED"} & {one.code for one in found.findings}


def test_what_is_still_to_be_typed_is_asked_for_and_is_no_error() -> None:
    program = without_end(6)
    operator = Operator.at(program)
    operator.desk = operator.desk.knowing(derive(program))
    operator.press("6", "enter", "tab", "tab", "tab", "tab", "tab")
    assert operator.session.field == "angle"
    asked = "Segments 6 and 7 need 2 more values"
    assert asked in operator.part("prompt")
    assert f" ?  segment 6: {asked}" in operator.part("verdict")
    assert "!!" not in "\n".join(operator.screen())


@pytest.mark.parametrize(("answer", "closes"), [("360", True), ("0.0057", False)])
def test_an_arc_that_ends_close_to_its_start_is_decided_on_sweep_angle(answer: str, closes: bool) -> None:
    part = load(example("overrun-square"))
    (block,) = part.blocks
    zero = Number(0.0)
    arc = ArcSegment(Direction.CCW, x_end=Number(2.0), y_end=Number(0.0001), x_center=Number(1.0), y_center=zero)
    program = replace(part, blocks=(replace(block, segments=(block.segments[0], arc)),))
    operator = Operator.at(program)
    operator.desk = operator.desk.knowing(derive(program))
    operator.press("2", "enter")
    while operator.session.field != "sweep":
        operator.press("tab")
    asked = "The end is 0.0001 from the start: full circle or short arc? Type SWEEP ANGLE 360 or 0.006."
    assert operator.said == f"!! {asked}"
    operator.press(*answer, "enter")
    (found,) = derive(operator.session.program).blocks
    piece = found.solved.segments[1].piece
    assert piece is not None
    assert (piece.start == piece.end) is closes
