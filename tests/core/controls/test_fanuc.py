"""Fanuc and Haas mills: compensation and language against cases calculated without cutcomp, and by hand."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Final

import pytest

from core.controls import registry
from core.controls.control_run import ControlRun
from core.controls.control_tools import CutterTool, ToolTable
from core.controls.iso.execute import execute
from core.controls.makers import fanuc
from core.controls.registry import UnknownControl
from core.finding import Severity
from core.units import Unit
from tests.core.controls.hand import DATA, told

GOLDEN: Final[list[dict[str, Any]]] = json.loads((DATA / "fanuc.json").read_text())["cases"]
HEAD: Final = "G21 G17 G90 G1 F100\n"
ENTERED: Final = f"{HEAD}X-20 Y0\nG41 D1 X0\nX50\n"


@dataclass(frozen=True)
class Flat:
    """A move as it is compared: kind, end, an arc's center, feed, line; millimeters."""

    kind: str
    end: tuple[float, float, float]
    center: tuple[float, float] | None
    feed: float
    line: int


def ran(program: str, control: str = "fanuc:a", radii: dict[int, float] | None = None) -> ControlRun:
    """The run of a program in millimeters with offsets of these radii, D1 of radius 5 unless given."""
    table = ToolTable.of(*(CutterTool(number, 2 * radius) for number, radius in (radii or {1: 5.0}).items()))
    done = registry.run(program.encode(), control, table, Unit.MM)
    assert not isinstance(done, UnknownControl)
    return done


def ran_with(program: str, **rules: Any) -> ControlRun:
    """The run on `fanuc:a` with other parameters."""
    changed = replace(fanuc.RULES["a"], **rules)
    table = ToolTable.of(CutterTool(1, 10.0))
    return execute(program.encode(), "fanuc:a", fanuc.DIALECT, table, partial(fanuc.Fanuc, rules=changed))


def flat(done: ControlRun) -> list[Flat]:
    """The moves of a run without those of no length; lines that go on in one direction are one."""
    kinds = {0: "line", 1: "ccw", -1: "cw"}
    moves = []
    for move in list(done.moves)[1:]:
        kind = "rapid" if move.rapid else kinds[move.turn]
        center = (move.center[0], move.center[1]) if move.turn else None
        moves.append(Flat(kind, move.point, center, move.feed, move.line))
    return joined(moves)


def joined(moves: list[Flat]) -> list[Flat]:
    """Moves without those of no length; lines that go on in one direction are one."""
    kept, starts = list[Flat](), [(0.0, 0.0, 0.0)]
    for move in moves:
        straight = move.kind in ("line", "rapid")
        here = kept[-1].end if kept else starts[0]
        if straight and apart(move.end, here) < 1e-9:
            continue
        if straight and kept and kept[-1].kind == move.kind and goes_on(starts[-1], here, move.end):
            kept[-1] = replace(move, line=kept[-1].line)
            continue
        starts.append(here)
        kept.append(move)
    return kept


def apart(first: tuple[float, ...], second: tuple[float, ...]) -> float:
    return max(abs(a - b) for a, b in zip(first, second, strict=True))


def goes_on(start: tuple[float, ...], middle: tuple[float, ...], end: tuple[float, ...]) -> bool:
    first = [b - a for a, b in zip(start, middle, strict=True)]
    second = [b - a for a, b in zip(middle, end, strict=True)]
    sizes = sum(value * value for value in first) ** 0.5, sum(value * value for value in second) ** 0.5
    return all(abs(a / sizes[0] - b / sizes[1]) < 1e-7 for a, b in zip(first, second, strict=True))


def expected(case: dict[str, Any]) -> list[Flat]:
    return joined(
        [
            Flat(
                move["type"],
                (move["x"], move["y"], move["z"]),
                (move["cx"], move["cy"]) if "cx" in move else None,
                move.get("feed", 0.0),
                move["line"],
            )
            for move in case["moves"]
        ]
    )


def ends(done: ControlRun) -> list[tuple[float, float]]:
    """The ends of the joined moves in X and Y, to six decimals."""
    return [(round(move.end[0], 6) + 0.0, round(move.end[1], 6) + 0.0) for move in flat(done)]


def alarms(done: ControlRun) -> list[tuple[str, int | None]]:
    return [(finding.code, finding.line) for finding in done.findings if finding.severity is Severity.ERROR]


def run_of(case: dict[str, Any]) -> ControlRun:
    variant = case["variant"]
    if variant["read"] == 5 or not variant["check"]:
        return ran_with(case["program"], blocks_read=variant["read"], checks=variant["check"])
    return ran(case["program"], case["control"], {int(number): r for number, r in case["offset_radii"].items()})


@pytest.mark.parametrize("case", GOLDEN, ids=[f"{case['id']} {case['what']}" for case in GOLDEN])
def test_moves_alarms_and_variables_are_those_of_the_golden_case(case: dict[str, Any]) -> None:
    done, wanted = run_of(case), expected(case)
    made = flat(done)
    assert [move.kind for move in made] == [move.kind for move in wanted]
    for move, other in zip(made, wanted, strict=True):
        assert apart(move.end, other.end) < 1e-6
        if move.center and other.center:
            assert apart(move.center, other.center) < 1e-6
        if other.feed:
            assert move.feed == pytest.approx(other.feed, abs=1e-5)
    alarm = case["alarm"]
    assert alarms(done) == ([(alarm["code"], alarm["line"])] if alarm else [])
    assert done.stopped_at == (alarm["line"] if alarm else None)
    assert {(code, line) for code, line in case.get("findings", ())} <= {(f.code, f.line) for f in done.findings}
    for name, value in case.get("variables", {}).items():
        assert done.variables[int(name[1:])] == pytest.approx(value)


# start-up, FN-S


@pytest.mark.parametrize(
    ("control", "moves", "wanted"),
    [
        ("fanuc:a", "G41 D1 X50 Y0\nG2 X70 Y-20 I0 J-20\n", (50.0, 5.0)),
        ("fanuc:b", "G41 D1 X50 Y0\nX90 Y-40\n", (52.071068, 5.0)),
    ],
)
def test_the_start_up_ends_where_the_next_element_wants_it(
    control: str, moves: str, wanted: tuple[float, float]
) -> None:
    assert ends(ran(f"{HEAD}{moves}", control))[0] == wanted


def test_a_z_block_behind_the_start_up_runs_at_its_end() -> None:
    done = ran(f"{HEAD}G41 D1 X50 Y0\nZ-5\nY-40\nG40 X90\nM30")
    assert [move.end for move in flat(done)][:3] == [(55.0, 0.0, 0.0), (55.0, 0.0, -5.0), (55.0, -40.0, -5.0)]


def test_the_side_changed_right_behind_the_start_up_is_an_alarm() -> None:
    assert alarms(ran(f"{HEAD}X-20 Y0\nG41 D1 X0\nG42 X50\nM30")) == [("PS0033", 4)]


# corners in the mode, FN-C


def test_a_line_before_an_arc_is_trimmed_where_both_offsets_meet() -> None:
    done = ran(f"{ENTERED}G2 X90 Y0 I20 J0\nG1 X120\nG40 X140\nM30")
    # the arc of 20 about (70, 0) has an offset of 25, which crosses y = 5 at 70 - sqrt(25^2 - 5^2)
    assert ends(done)[2] == (45.505103, 5.0)


def test_two_arcs_meet_inside_as_calculated_by_hand() -> None:
    done = ran(f"{HEAD}X-20 Y20\nG41 D1 X0 Y0\nG2 X40 Y0 I20 J-15\nX80 Y0 I20 J-15\nG1 X90 Y-30\nM30")
    assert ends(done)[2] == (40.0, 7.36068)


@pytest.mark.parametrize(("radius", "alarm"), [(3.9, False), (4.0, False), (4.1, True)])
def test_a_groove_narrower_than_the_tool_is_an_alarm(radius: float, alarm: bool) -> None:
    program = f"{ENTERED}Y-20\nX58\nY0\nX100\nG40 X120\nM30"
    assert alarms(ran(program, radii={1: radius})) == ([("PS0041", 6)] if alarm else [])


def test_a_straight_step_below_the_radius_is_none() -> None:
    assert not alarms(ran(f"{ENTERED}Y-2\nX100\nG40 X120\nM30"))


def test_offsets_that_do_not_meet_are_an_alarm_before_the_corner() -> None:
    # the offset of the arc of 6 is a circle of 1 about (44, 0), 4 short of y = 5
    done = ran(f"{ENTERED}G3 X44 Y6 I-6 J0\nG1 X0\nM30")
    assert alarms(done) == [("PS0033", 5)]
    assert ends(done)[-1] == (0.0, 5.0)


def test_a_new_offset_in_an_arc_stops_because_nobody_knows_it() -> None:
    done = ran(f"{ENTERED}G2 X70 Y-20 I0 J-20 D2\nM30", radii={1: 5.0, 2: 3.0})
    assert alarms(done) == [("FN-DARC", 5)]


def test_g39_alone_rounds_the_corner_with_an_arc() -> None:
    done = ran(f"{ENTERED}G39\nX90 Y-40\nG40 Y-60\nM30")
    arc = next(move for move in flat(done) if move.kind == "cw")
    assert arc.center == (50.0, 0.0)
    assert apart(arc.end, (53.535534, 3.535534, 0.0)) < 1e-6


def test_g39_outside_of_compensation_is_an_alarm() -> None:
    assert alarms(ran(f"{HEAD}G39\nM30")) == [("PS0035", 2)]


# changes in the mode, FN-G


@pytest.mark.parametrize(
    ("block", "code"),
    [
        ("G31 X60", "PS0036"),
        ("G45 D1 X60", "PS0042"),
        ("G68 X0 Y0 R30", "FN-TRANSFORM"),
        ("G51 X0 Y0 P2.", "FN-TRANSFORM"),
        ("G51.1 X0", "FN-TRANSFORM"),
        ("G81 Z-5 R2", "FN-CYCLE"),
        ("G18", "PS0037"),
    ],
)
def test_what_compensation_does_not_allow_stops_at_its_block(block: str, code: str) -> None:
    assert alarms(ran(f"{ENTERED}{block}\nG40 X90\nM30")) == [(code, 5)]


def test_sides_change_from_square_to_square_between_lines() -> None:
    done = ran(f"{ENTERED}G42 X90\nX120\nG40 X140\nM30")
    assert ends(done)[2:5] == [(50.0, 5.0), (50.0, -5.0), (120.0, -5.0)]
    assert told(done, "FN-G1")


def test_a_new_origin_ends_compensation_for_a_while_and_starts_it_again() -> None:
    done = ran(f"{ENTERED}X70\nG52 X0\nX90\nY-40\nG40 Y-60\nM30")
    assert ends(done)[2:5] == [(50.0, 5.0), (70.0, 0.0), (95.0, 0.0)]
    assert told(done, "FN-G5")


def test_a_move_to_the_reference_point_leaves_the_axis_nowhere_known() -> None:
    done = ran(f"{HEAD}G1 X10\nG91 G28 X0\nX5\nM30")
    assert alarms(done) == [("FN-WHERE", 4)]
    assert not alarms(ran(f"{HEAD}G1 X10\nG91 G28 Z0\nG90 X5\nM30"))


# cancel, FN-X


def test_a_vector_of_g40_bends_the_end_without_a_limit() -> None:
    # the offset of the vector (-1, 1) through (50, 0) meets y = 5 at 50 + 5 tan(67.5 - 30)...: calculated as lines
    done = ran(f"{ENTERED}G40 X60 Y30 I10 J1\nM30")
    x, y = ends(done)[2]
    assert y == 5.0
    # distance of the end from the line through (50, 0) along (10, 1) is the radius
    assert abs((x - 50) * 1 - (y - 0) * 10) / (101**0.5) == pytest.approx(5.0)


def test_a_program_that_ends_in_the_mode_ends_square_with_a_warning() -> None:
    done = ran(f"{ENTERED}M30")
    assert ends(done)[-1] == (50.0, 5.0)
    assert told(done, "FN-OPEN")


def test_type_c_shifts_back_at_once_only_where_g40_has_no_move() -> None:
    assert ends(ran(f"{ENTERED}G40 Y-40\nM30", "fanuc:c"))[2:] == [(50.0, 5.0), (50.0, -40.0)]


# offsets, FN-D


def test_an_offset_number_of_a_shared_memory_takes_the_tool() -> None:
    done = ran(f"{HEAD}T1 M6\nG41 D21 X50 Y0\nY-40\nG40 X90\nM30")
    assert ends(done)[0] == (55.0, 0.0)
    assert told(done, "D-AS-T")


def test_a_changed_offset_counts_from_the_next_d() -> None:
    done = ran(f"{ENTERED}G10 L12 P1 R3.\nX70\nX90 D1\nX130\nG40 X150\nM30")
    assert ends(done)[2:5] == [(70.0, 5.0), (90.0, 3.0), (130.0, 3.0)]


def test_a_d_without_use_of_compensation_needs_no_offset() -> None:
    assert not alarms(ran(f"{HEAD}T7 M6 D7 H7\nX10\nM30"))


# Haas


def test_haas_stops_where_it_cannot_look_further() -> None:
    idle = "M8\n" * 79
    assert alarms(ran(f"{ENTERED}{idle}Y40\nG40 X0\nM30", "haas:a")) == [("H350", 83)]
    assert not alarms(ran(f"{ENTERED}{idle[:-3]}Y40\nG40 X0\nM30", "haas:a"))


@pytest.mark.parametrize(
    ("program", "alarm"),
    [
        (f"{HEAD}X50 Y0\nG41 D1 G2 X70 Y-20 I20 J0\nM30", "H340"),
        (f"{ENTERED}G40 G2 X70 Y-20 I20 J0\nM30", "H341"),
        (f"{ENTERED}Y-20\nX58\nY0\nX100\nG40 X120\nM30", "H342"),
    ],
)
def test_haas_has_alarms_of_its_own(program: str, alarm: str) -> None:
    assert alarms(ran(program, "haas:a"))[0][0] == alarm


def test_two_m_blocks_at_an_inside_corner_part_fanuc_from_haas_and_the_nine_series() -> None:
    program = f"{ENTERED}M8\nM9\nY40\nX20\nG40 X0\nM30"
    corner = {control: ends(ran(program, control))[2] for control in ("fanuc:a", "haas:a", "nine-series:a")}
    assert corner == {"fanuc:a": (50.0, 5.0), "haas:a": (45.0, 5.0), "nine-series:a": (45.0, 5.0)}
