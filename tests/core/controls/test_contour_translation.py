"""Programs of one language on the controls of the other, by the contour they describe."""

from __future__ import annotations

from math import hypot

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.controls.compared_controls import Compared, OtherLanguage, compare
from core.controls.contour_translation import run_by_contour, translate_contours
from core.controls.control_run import ControlRun
from core.controls.control_tools import ToolTable
from core.controls.judging.judged_runs import deepest_gouge
from core.controls.moves import Move
from core.controls.registry import run
from core.controls.write.rewritten_stretch import NotTranslated
from core.finding import Severity
from core.geometry.piece import Side
from core.units import Unit, from_mm
from tests.core.controls.klartext.klartext_runs import HEAD
from tests.core.controls.klartext.test_center_path_laws import LEGS, pieces_of, programmed
from tests.properties import exercised, must_exercise
from tests.tool_tables import end_mills

NEAR = pytest.approx
HOOK = ("L X-30 Y-30 R0 FMAX", "L Z-5", "L X+0 Y+0 RL F200", "L Y+50", "L X+40", "L X-30 R0")
"""Up the wall X 0 with the tool on its left, round the corner (0, 50) and along Y 50, straight out."""
GROOVE = ("L X-30 Y-30 R0 FMAX", "L X+0 Y+0 RL F200", "L Y+20", "L X+3", "L Y+24", "L X+0", "L Y+50", "L X-30 R0")
ISO = "G20 G17 G90 F20\nT1 M6\nG0 X-1. Y-1.\nG0 Z-.1\nG41 D1\nG1 X0. Y-.9\nG1 X0. Y2.\nX3.\nG40\nG1 X4. Y3.\nM2\n"


def klartext(*blocks: str) -> bytes:
    """The blocks with a tool of radius 5; the first of them is line 4."""
    return (HEAD.format(radius=5.0) + "\n".join(blocks) + "\nEND PGM P MM\n").encode()


def on(text: bytes, control: str, tools: ToolTable | None = None) -> ControlRun:
    return run(text, control, tools or {})


def rows(text: bytes, tools: ToolTable | None = None) -> dict[str, Compared | OtherLanguage]:
    return {row.control: row for row in compare(text, tools or {})}


def by_contour(source: ControlRun, control: str) -> ControlRun:
    made = run_by_contour(source, control)
    assert not isinstance(made, NotTranslated), made.text
    return made[0]


def flat(move: Move) -> tuple[float, ...]:
    return (*move.point[:2], *move.center[:2], move.turn) if move.turn else move.point[:2]


@pytest.mark.parametrize(
    "control", ["threeblock", "rosettacnc:nist", "rosettacnc:easy", "rosettacnc:normal", "linuxcnc"]
)
def test_a_klartext_contour_on_controls_with_arcs_at_corners(control: str) -> None:
    made = by_contour(on(klartext(*HOOK), "klartext"), control)
    assert made.stopped_at is None
    contour = [(move.line, flat(move)) for move in made.moves if move.line]
    want = [(7, (-5, 50)), (7, (0, 55, 0, 50, -1)), (8, (40, 55))]
    # the arc about the corner belongs to the block before it or to the one behind it, as the control has it
    assert [place for _, place in contour] == [NEAR(place, abs=0.003) for _, place in want]
    assert (contour[0][0], contour[-1][0]) == (7, 8)


@pytest.mark.parametrize("control", ["nine-series:a", "nine-series:b"])
def test_a_control_with_mitres_parts_at_the_corner(control: str) -> None:
    row = rows(klartext(*HOOK))[control]
    assert isinstance(row, Compared)
    assert row.contour_of == "klartext"
    assert row.parting is not None
    assert row.parting.distance == NEAR(5 * (2**0.5 - 1), abs=0.003)
    assert row.parting.line in (7, 8)


def test_an_iso_contour_on_klartext() -> None:
    tools = end_mills({1: 0.5})
    row = rows(ISO.encode(), tools)["klartext"]
    assert isinstance(row, Compared)
    assert (row.run.stopped_at, deepest_gouge(row.results)) == (None, (0.0, None))
    assert row.run.unit is Unit.IN
    contour = [tuple(from_mm(value, Unit.IN) for value in move.point[:2]) for move in row.run.moves if move.line]
    assert contour == [NEAR(want, abs=1e-5) for want in [(-0.25, 2), (0, 2.25), (3, 2.25)]]


def test_alarms_have_the_lines_of_the_program() -> None:
    again = ("L X-30 Y-30 R0 FMAX", "L X+0 Y+0 RL", "L Y+50", "L X-40", "L Y+90", "L X-80 R0")
    made = rows(klartext(*HOOK, *again))
    assert isinstance(made["klartext"], Compared)
    assert made["klartext"].run.stopped_at is None
    for control in ("rosettacnc:nist", "rosettacnc:easy"):
        row = made[control]
        assert isinstance(row, Compared)
        assert row.run.stopped_at == 13  # the block behind the inside corner at (0, 50)
        assert [one.line for one in row.run.findings if one.severity is Severity.ERROR] == [13]


def test_where_the_tool_is_too_large_on_klartext_the_others_still_answer() -> None:
    made = rows(klartext(*GROOVE))
    assert isinstance(made["klartext"], Compared)
    assert made["klartext"].run.stopped_at == 7
    fine, strict = made["threeblock"], made["linuxcnc"]
    assert isinstance(fine, Compared)
    assert isinstance(strict, Compared)
    assert (fine.run.stopped_at, fine.parting) == (None, None)
    assert deepest_gouge(fine.results)[0] == NEAR(5, abs=0.01)
    assert strict.run.stopped_at == 8


@pytest.mark.parametrize(
    ("blocks", "why"),
    [
        (("L X+0 Y+0 R0 FMAX", "L X+9 F100"), "no compensated contour"),
        (("L X-9 Y+0 R0 FMAX", "L X+0 RL F9", "L X+9", "L X+19 Z-3", "L X+40 Y-20 R0"), "tool axis moves under"),
        (("TOOL CALL 1 Y", "L X-9 Z+0 R0 FMAX", "L X+0 RL F9", "L X+9", "L X+40 Z-20 R0"), "another plane than XY"),
        (("L X+0 Y+0 R0 FMAX", "FL X+9"), "no control runs this program to the end"),
    ],
)
def test_what_cannot_be_compared_says_why(blocks: tuple[str, ...], why: str) -> None:
    row = rows(klartext(*blocks))["linuxcnc"]
    assert isinstance(row, OtherLanguage)
    assert why in row.why


def test_tools_of_several_sizes_keep_theirs() -> None:
    text = (*HOOK, "TOOL DEF 2 L+0 R+2", "TOOL CALL 2 Z S500", *HOOK)
    made = by_contour(on(klartext(*text), "klartext"), "linuxcnc")
    assert [stretch.radius for stretch in made.stretches] == [NEAR(5), NEAR(2)]


def test_a_line_that_runs_again_keeps_the_feed_of_each_time() -> None:
    loop = "#1=100\nWHILE[#1 LT 400]DO1\nG91 G1 X40. F#1\nY9.\n#1=#1+100\nEND1\n"
    text = f"G21 G17 G90 G0 X-30. Y-30.\nG1 Z-1. F50\nG42 D1 X0. Y0.\n{loop}G90 G40 X200. Y0.\nM30\n"
    made = by_contour(on(text.encode(), "fanuc:a", end_mills({1: 10.0})), "klartext")
    assert list(dict.fromkeys(move.feed for move in made.moves if move.line == 6)) == [100, 200, 300]


@must_exercise(0.5)
@settings(max_examples=30, deadline=None)
@given(LEGS, st.sampled_from(Side), st.sampled_from(["rosettacnc:normal", "linuxcnc"]))
def test_the_path_is_that_of_klartext(legs: list[tuple[float, float, int, float]], side: Side, control: str) -> None:
    """Arcs at outside corners, meetings at inside ones: such a control makes the very path, or stops."""
    source = programmed(pieces_of(legs), side)
    if source.stopped_at is not None or not source.stretches:
        return
    found = translate_contours(source, control)
    if isinstance(found, NotTranslated):
        assert "no room" in found.text
        return
    made = by_contour(source, control)
    if made.stopped_at is not None:
        return
    exercised()
    ours = source.moves.part(source.stretches[0].first, source.stretches[0].last)
    ends = [move.point[:2] for move in made.moves if move.line]
    near = [min(hypot(x - a, y - b) for a, b in ends) for x, y in ours.points[2:-1, :2].tolist()]
    # LinuxCNC takes corners up to 0.05 radians for none: 0.2 mm at this tool's radius of 4
    assert max(near, default=0.0) <= 0.2 + 0.003
