"""Fanuc and Haas mills: compensation and language against cases calculated independently or by hand."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from math import cos, radians, sin
from typing import Any, Final

import pytest

from core.controls import registry
from core.controls.control_run import ControlRun
from core.controls.control_tools import CutterTool, table_of
from core.controls.iso import macro_b_flow
from core.controls.iso.iso_run import run_iso
from core.controls.makers import fanuc
from core.finding import Severity
from core.geometry.piece import Side
from core.units import Unit
from tests.core.controls.hand import DATA, findings_of, lines_and_ends

GOLDEN: Final[list[dict[str, Any]]] = json.loads((DATA / "fanuc.json").read_text())["cases"]
HEAD: Final = "G21 G17 G90 G1 F100\n"
ENTERED: Final = f"{HEAD}X-20 Y0\nG41 D1 X0\nX50\n"


@dataclass(frozen=True)
class Flat:
    """A move for comparison, in millimeters: kind, end, center of an arc, feed, line."""

    kind: str
    end: tuple[float, float, float]
    center: tuple[float, float] | None
    feed: float
    line: int


def ran(program: str, control: str = "fanuc:a", radii: dict[int, float] | None = None) -> ControlRun:
    """Run a metric program with offsets of these radii, by default D1 with radius 5."""
    table = table_of(*(CutterTool(number, 2 * radius) for number, radius in (radii or {1: 5.0}).items()))
    return registry.run(program.encode(), control, table, Unit.MM)


def ran_with(program: str, **rules: Any) -> ControlRun:
    """Run on `fanuc:a` with other parameters."""
    changed = replace(fanuc.VECTOR_RULES["a"], **rules)
    table = table_of(CutterTool(1, 10.0))
    return run_iso(program.encode(), "fanuc:a", fanuc.DIALECT, table, partial(fanuc.Fanuc, rules=changed))


def flat(run: ControlRun) -> list[Flat]:
    """The moves of a run, without zero-length moves; collinear lines are joined."""
    kinds = {0: "line", 1: "ccw", -1: "cw"}
    moves = []
    for move in list(run.moves)[1:]:
        kind = "rapid" if move.rapid else kinds[move.turn]
        center = (move.center[0], move.center[1]) if move.turn else None
        moves.append(Flat(kind, move.point, center, move.feed, move.line))
    return joined(moves)


def joined(moves: list[Flat]) -> list[Flat]:
    """The moves without those of zero length; collinear lines are joined."""
    kept, starts = list[Flat](), [(0.0, 0.0, 0.0)]
    for move in moves:
        straight = move.kind in ("line", "rapid")
        start = kept[-1].end if kept else starts[0]
        if straight and apart(move.end, start) < 1e-9:
            continue
        if straight and kept and kept[-1].kind == move.kind and goes_on(starts[-1], start, move.end):
            kept[-1] = replace(move, line=kept[-1].line)
            continue
        starts.append(start)
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


def ends(run: ControlRun) -> list[tuple[float, float]]:
    """The ends of the joined moves in X and Y, to six decimals."""
    return [(round(move.end[0], 6) + 0.0, round(move.end[1], 6) + 0.0) for move in flat(run)]


def alarms(run: ControlRun) -> list[tuple[str, int | None]]:
    return [(finding.code, finding.line) for finding in run.findings if finding.severity is Severity.ERROR]


def run_of(case: dict[str, Any]) -> ControlRun:
    variant = case["variant"]
    if variant["read"] == 5 or not variant["check"]:
        return ran_with(case["program"], blocks_read=variant["read"], checks=variant["check"])
    return ran(case["program"], case["control"], {int(number): r for number, r in case["offset_radii"].items()})


@pytest.mark.parametrize("case", GOLDEN, ids=[f"{case['id']} {case['what']}" for case in GOLDEN])
def test_moves_alarms_and_variables_are_those_of_the_golden_case(case: dict[str, Any]) -> None:
    run, wanted = run_of(case), expected(case)
    made = flat(run)
    assert [move.kind for move in made] == [move.kind for move in wanted]
    for move, other in zip(made, wanted, strict=True):
        assert apart(move.end, other.end) < 1e-6
        if move.center and other.center:
            assert apart(move.center, other.center) < 1e-6
        if other.feed:
            assert move.feed == pytest.approx(other.feed, abs=1e-5)
    alarm = case["alarm"]
    assert alarms(run) == ([(alarm["code"], alarm["line"])] if alarm else [])
    assert run.stopped_at == (alarm["line"] if alarm else None)
    assert {(code, line) for code, line in case.get("findings", ())} <= {(f.code, f.line) for f in run.findings}
    for name, value in case.get("variables", {}).items():
        assert run.variables[int(name[1:])] == pytest.approx(value)


# start-up, FN-S


@pytest.mark.parametrize(
    ("control", "moves", "wanted"),
    [
        ("fanuc:a", "G41 D1 X50 Y0\nG2 X70 Y-20 I0 J-20\n", (50.0, 5.0)),
        ("fanuc:b", "G41 D1 X50 Y0\nX90 Y-40\n", (52.071068, 5.0)),
    ],
)
def test_the_start_up_ends_where_the_next_element_requires(
    control: str, moves: str, wanted: tuple[float, float]
) -> None:
    assert ends(ran(f"{HEAD}{moves}", control))[0] == wanted


def test_a_z_block_after_the_start_up_moves_at_the_end_of_the_start_up() -> None:
    run = ran(f"{HEAD}G41 D1 X50 Y0\nZ-5\nY-40\nG40 X90\nM30")
    assert [move.end for move in flat(run)][:3] == [(55.0, 0.0, 0.0), (55.0, 0.0, -5.0), (55.0, -40.0, -5.0)]


def test_a_side_change_right_after_the_start_up_is_an_alarm() -> None:
    assert alarms(ran(f"{HEAD}X-20 Y0\nG41 D1 X0\nG42 X50\nM30")) == [("PS0033", 4)]


# corners under compensation, FN-C


def test_a_line_before_an_arc_is_trimmed_where_both_offsets_meet() -> None:
    run = ran(f"{ENTERED}G2 X90 Y0 I20 J0\nG1 X120\nG40 X140\nM30")
    # the arc of 20 about (70, 0) has an offset of 25, which crosses y = 5 at 70 - sqrt(25^2 - 5^2)
    assert ends(run)[2] == (45.505103, 5.0)


def test_two_arcs_meet_inside_as_calculated_by_hand() -> None:
    run = ran(f"{HEAD}X-20 Y20\nG41 D1 X0 Y0\nG2 X40 Y0 I20 J-15\nX80 Y0 I20 J-15\nG1 X90 Y-30\nM30")
    assert ends(run)[2] == (40.0, 7.36068)


@pytest.mark.parametrize(("radius", "alarm"), [(3.9, False), (4.0, False), (4.1, True)])
def test_a_groove_narrower_than_the_tool_is_an_alarm(radius: float, alarm: bool) -> None:
    program = f"{ENTERED}Y-20\nX58\nY0\nX100\nG40 X120\nM30"
    assert alarms(ran(program, radii={1: radius})) == ([("PS0041", 6)] if alarm else [])


def test_a_straight_step_lower_than_the_radius_is_no_alarm() -> None:
    assert not alarms(ran(f"{ENTERED}Y-2\nX100\nG40 X120\nM30"))


def test_offsets_that_do_not_meet_stop_the_run_before_the_corner() -> None:
    # the offset of the arc of 6 is a circle of 1 about (44, 0), 4 short of y = 5
    run = ran(f"{ENTERED}G3 X44 Y6 I-6 J0\nG1 X0\nM30")
    assert alarms(run) == [("PS0033", 5)]
    assert ends(run)[-1] == (0.0, 5.0)


def test_a_new_offset_in_an_arc_block_stops_the_run() -> None:
    run = ran(f"{ENTERED}G2 X70 Y-20 I0 J-20 D2\nM30", radii={1: 5.0, 2: 3.0})
    assert alarms(run) == [("FN-DARC", 5)]


def test_g39_alone_rounds_the_corner_with_an_arc() -> None:
    run = ran(f"{ENTERED}G39\nX90 Y-40\nG40 Y-60\nM30")
    arc = next(move for move in flat(run) if move.kind == "cw")
    assert arc.center == (50.0, 0.0)
    assert apart(arc.end, (53.535534, 3.535534, 0.0)) < 1e-6


def test_g39_outside_of_compensation_is_an_alarm() -> None:
    assert alarms(ran(f"{HEAD}G39\nM30")) == [("PS0035", 2)]


# changes under compensation, FN-G


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
def test_a_code_that_compensation_forbids_stops_at_its_block(block: str, code: str) -> None:
    assert alarms(ran(f"{ENTERED}{block}\nG40 X90\nM30")) == [(code, 5)]


def test_a_side_change_between_lines_runs_from_square_to_square() -> None:
    run = ran(f"{ENTERED}G42 X90\nX120\nG40 X140\nM30")
    assert ends(run)[2:5] == [(50.0, 5.0), (50.0, -5.0), (120.0, -5.0)]
    assert findings_of(run, "FN-G1")


def test_a_new_origin_suspends_compensation() -> None:
    run = ran(f"{ENTERED}X70\nG52 X0\nX90\nY-40\nG40 Y-60\nM30")
    assert ends(run)[2:5] == [(50.0, 5.0), (70.0, 0.0), (95.0, 0.0)]
    assert findings_of(run, "FN-G5")


@pytest.mark.parametrize("code", ["G28", "G30"])
def test_the_move_to_an_intermediate_point_is_not_compensated(code: str) -> None:
    run = ran(f"{ENTERED}{code} X50 Y10\nG0 X90 Y40\nG1 X120\nG40 Y90\nM30")
    assert [finding.line for finding in findings_of(run, "FN-WHERE")] == [6]
    assert ends(run)[2:4] == [(50.0, 5.0), (50.0, 10.0)]


def test_the_axis_position_is_unknown_after_a_move_to_the_reference_point() -> None:
    run = ran(f"{HEAD}G1 X10\nG91 G28 X0\nX5\nM30")
    assert alarms(run) == [("FN-WHERE", 4)]
    assert not alarms(ran(f"{HEAD}G1 X10\nG91 G28 Z0\nG90 X5\nM30"))


# cancel, FN-X


def test_a_vector_of_g40_bends_the_end_without_a_limit() -> None:
    # the offset of the vector (-1, 1) through (50, 0) meets y = 5 at 50 + 5 tan(67.5 - 30)...: calculated as lines
    run = ran(f"{ENTERED}G40 X60 Y30 I10 J1\nM30")
    x, y = ends(run)[2]
    assert y == 5.0
    # distance of the end from the line through (50, 0) along (10, 1) is the radius
    assert abs((x - 50) * 1 - (y - 0) * 10) / (101**0.5) == pytest.approx(5.0)


def test_a_program_that_ends_under_compensation_ends_square_with_a_warning() -> None:
    run = ran(f"{ENTERED}M30")
    assert ends(run)[-1] == (50.0, 5.0)
    assert findings_of(run, "FN-OPEN")


def test_type_c_does_not_shift_back_at_once_when_g40_has_a_move() -> None:
    assert ends(ran(f"{ENTERED}G40 Y-40\nM30", "fanuc:c"))[2:] == [(50.0, 5.0), (50.0, -40.0)]


# offsets, FN-D


def test_a_shared_offset_number_uses_the_diameter_of_the_tool() -> None:
    run = ran(f"{HEAD}T1 M6\nG41 D21 X50 Y0\nY-40\nG40 X90\nM30")
    assert ends(run)[0] == (55.0, 0.0)
    assert findings_of(run, "D-AS-T")


def test_a_changed_offset_takes_effect_at_the_next_d() -> None:
    run = ran(f"{ENTERED}G10 L12 P1 R3.\nX70\nX90 D1\nX130\nG40 X150\nM30")
    assert ends(run)[2:5] == [(70.0, 5.0), (90.0, 3.0), (130.0, 3.0)]


def test_a_d_without_compensation_needs_no_offset() -> None:
    assert not alarms(ran(f"{HEAD}T7 M6 D7 H7\nX10\nM30"))


# Haas


OFFSET_WALL: Final = "G41 D1 X0\nY40\nG40 X-20\nM30"


@pytest.mark.parametrize(
    "written", ["G10 L12 P1 R6.", "#2401=6.", "#2401=8.\n#2601=-2.", "G10 L12 P1 R4.\nG10 L13 P1 R2."]
)
def test_haas_keeps_d_in_diameters_apart_from_h(written: str) -> None:
    """Setting 40 DIAMETER: 6 is a radius of 3; the values for H do not affect D."""
    run = ran(f"{HEAD}G10 L10 P1 R100.\n#2001=100.\n{written}\n{OFFSET_WALL}", "haas:a")
    assert (-3.0, 40.0) in ends(run)
    (finding,) = findings_of(run, "HAAS-DIAMETER")
    assert (finding.severity, finding.line) == (Severity.WARNING, 4)


def test_haas_reads_the_diameter_of_a_tool_and_its_wear() -> None:
    run = ran(f"{HEAD}#2601=.5\nX#2401 Y#2601\nM30", "haas:a")
    assert ends(run) == [(10.0, 0.5)]


def test_haas_has_work_offsets_g110_to_g129_which_are_g154_p1_to_p20() -> None:
    assert ends(ran("G21\nG10 L20 P14 X20.\nG123 G0 X1.\nM30", "haas:a")) == [(21.0, 0.0)]
    assert alarms(ran("G21\nG123 G0 X1.\nM30")) == [("PS0010", 2)]


@pytest.mark.parametrize(("control", "block"), [("haas:a", "#10001=.5"), ("haas:a", "X#10001"), ("fanuc:a", "X#2401")])
def test_a_memory_that_depends_on_the_model_is_not_followed(control: str, block: str) -> None:
    assert alarms(ran(f"{HEAD}{block}\nM30", control)) == [("BEYOND", 2)]


@pytest.mark.parametrize("code", ["G141", "G101", "G234", "G35"])
def test_an_unsupported_haas_code_stops_the_run_without_a_control_alarm(code: str) -> None:
    assert alarms(ran(f"G21\n{code} X1.\nM30", "haas:a")) == [("BEYOND", 2)]


def test_haas_stops_after_too_many_blocks_without_movement() -> None:
    idle = "M8\n" * 79
    assert alarms(ran(f"{ENTERED}{idle}Y40\nG40 X0\nM30", "haas:a")) == [("H350", 83)]
    assert not alarms(ran(f"{ENTERED}{idle[:-3]}Y40\nG40 X0\nM30", "haas:a"))


@pytest.mark.parametrize("block", ["G1 X0 Y20", "M0", "G28 G91 Z0\nG90"])
def test_a_stop_does_not_hide_the_next_move_from_a_haas(block: str) -> None:
    """A Fanuc does not look past a stop; the Haas manuals do not say."""
    program = f"{ENTERED}X0 Y20\n{block}\nX-40\nG40 Y0\nM30"
    run = ran(program, "haas:a")
    (finding,) = findings_of(run, "HAAS-STOP")
    assert (finding.severity, finding.line) == (Severity.WARNING, 6)
    assert not alarms(run)
    assert findings_of(ran(program), "FN-N2")[0].text.startswith("The control does not look past a stop")


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


def test_two_m_blocks_at_an_inside_corner_gouge_on_fanuc_alone() -> None:
    program = f"{ENTERED}M8\nM9\nY40\nX20\nG40 X0\nM30"
    corner = {control: ends(ran(program, control))[2] for control in ("fanuc:a", "haas:a", "nine-series:a")}
    assert corner == {"fanuc:a": (50.0, 5.0), "haas:a": (45.0, 5.0), "nine-series:a": (45.0, 5.0)}


# language


def values(program: str) -> dict[int, float]:
    """The common variables at the end of a program."""
    run = ran(program)
    assert not alarms(run), alarms(run)
    return dict(run.variables)


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("16./2", 8.0),
        ("2+3*4", 14.0),
        ("2*3AND6", 6.0),
        ("8/2/2", 2.0),
        ("7MOD4", 3.0),
        ("1OR6", 7.0),
        ("5XOR3+1", 7.0),
        ("-#100*3", -6.0),
        ("FIX[-1.7]", -1.0),
        ("FUP[-1.2]", -2.0),
        ("ROUND[-2.5]", -3.0),
        ("RO[2.5]", 3.0),
        ("SQ[16]", 4.0),
        ("ATAN[-1]/[-1]", 225.0),
        ("ATAN[1]/[2]*2", 53.13010235415598),
        ("COS[60]", 0.5),
        ("POW[2,3]", 8.0),
        ("BIN[18]", 12.0),
        ("BCD[12]", 18.0),
        ("[#100EQ2]AND[#100GT1]", 1.0),
        ("#[99+1]", 2.0),
        ("##101", 2.0),
        ("ABS[-3]+#0", 3.0),
        ("+".join(["1"] * 50), 50.0),
    ],
)
def test_an_expression_has_the_value_calculated_by_hand(expression: str, value: float) -> None:
    assert values(f"#100=2\n#101=100\n#102={expression}\nM30")[102] == pytest.approx(value)


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a"])
@pytest.mark.parametrize(("unit", "x", "y"), [("G21", 10.123, -6.667), ("G20", 10.1235, -6.6667)])
def test_a_calculated_length_is_rounded_to_the_least_increment(control: str, unit: str, x: float, y: float) -> None:
    run = ran(f"{unit}\n#1=10.12346\nG0 X#1 Y-[20./3]\nM30", control)
    assert lines_and_ends(run) == [(x, y)]


def test_a_unit_beside_a_calculated_length_gives_the_increment() -> None:
    run = ran("G21\n#1=1.23456\nG20 G0 X#1\nG21 X#1\nM30")
    assert lines_and_ends(run) == [(1.2346, 0.0), (pytest.approx(1.235 / 25.4), 0.0)]


def test_an_argument_of_a_macro_call_is_not_rounded() -> None:
    assert values("O1\n#1=1.23456\nG65 P9 X#1 I[1/8192]\nM30\nO9\n#100=#24\n#101=#4\nM99") == {
        100: 1.23456,
        101: pytest.approx(1 / 8192),
    }


@pytest.mark.parametrize(
    ("row", "code"),
    [
        ("#1=1/0", "PS0112"),
        ("#1=2**3", "PS0114"),
        ("#1=[1+2", "PS0114"),
        ("#0=1", "PS0116"),
        ("#1=#4999", "PS0115"),
        (f"#1={'1+' * 45}{'#' * 45}1", "PS0118"),
        ("#1=#<_x>", "BEYOND"),
        # the bits 0001 1110 0101 are not decimal digits
        ("#1=BIN[485]", "PS0119"),
        ("DO4", "PS0126"),
        ("END1", "PS0124"),
        ("IF[1EQ1]X5", "PS0114"),
        ("#1=2X5", "PS0127"),
        ("#1=#1-#11:", "PS0114"),
        ("X", "PS0005"),
        ("X1.2.3", "PS0009"),
        ("X--10.", "PS0006"),
        ("X-+10.", "PS0006"),
        ("#1=-+2", "PS0006"),
        ("X5\N{NO-BREAK SPACE}0.", "PS0009"),
        ("G123", "PS0010"),
        ("G2 X5 Y5", "PS0022"),
        ("G2 X50 R5", "PS0020"),
        ("M98", "PS0076"),
        ("G10 L12 R5.", "PS0031"),
        ("G10 L12 P1", "PS0032"),
        ("G10 P1 R8.", "BEYOND"),
        ("G10 L50", "FN-PARAMETER"),
        ("G29 X5", "BEYOND"),
        ("G71 P10 Q20 D0.05", "PS0010"),
    ],
)
def test_an_unreadable_block_raises_the_alarm_of_the_control(row: str, code: str) -> None:
    assert alarms(ran(f"{HEAD}{row}\nM30")) == [(code, 2)]


def test_only_eq_and_ne_distinguish_vacant_from_zero() -> None:
    rows = ["IF[#1EQ#0]THEN#100=1", "IF[#1EQ0]THEN#101=1", "IF[#1LT1]THEN#102=1", "#103=#1", "IF[#103NE0]THEN#104=1"]
    run = values("\n".join(["#101=5", *rows, "M30"]))
    assert (run[100], run[101], run[102], run[104]) == (1.0, 5.0, 1.0, 1.0)


def test_a_word_with_a_signed_vacant_variable_is_ignored() -> None:
    assert ends(ran(f"{HEAD}X10 Y-#33\nM30")) == [(10.0, 0.0)]


def test_loops_may_be_nested_and_left_by_a_jump() -> None:
    program = (
        "#100=0\nWHILE[#100LT3]DO1\n#101=0\nWH[#101LT4]DO2\n#101=#101+1\n#102=#102+1\nIF[#102EQ10]GOTO9\n"
        "END2\n#100=#100+1\nN8END1\nN9 M30"
    )
    run = values(program)
    assert (run[100], run[101], run[102]) == (2.0, 2.0, 10.0)


def test_a_jump_searches_forward_first_and_then_from_the_top() -> None:
    program = "#100=1\nN5 #101=#101+1\nIF[#101GT1]GOTO7\nGOTO5\nN7 M30\nN5 #101=99\nM30"
    assert values(program)[101] == 99.0
    assert values("N5 #101=#101+1\nIF[#101GT1]GOTO7\nGOTO5\nN7 M30")[101] == 2.0


@pytest.mark.parametrize(
    ("call", "control", "times"),
    [
        ("M98 P200 L3", "fanuc:a", 3),
        ("M98 P30200", "fanuc:a", 3),
        ("M98 P0200", "fanuc:a", 1),
        ("M98 P200 L3", "haas:a", 3),
        ("M97 P7 L2", "haas:a", 2),
        ("G65 P200 L2", "fanuc:a", 2),
    ],
)
def test_a_call_runs_as_often_as_its_repeat_count_says(call: str, control: str, times: int) -> None:
    program = f"O1\n{HEAD}G91\n{call}\nM30\nN7 X1.\nM99\nO200\nX1.\nM99\n"
    assert ends(ran(program, control)) == [(float(times), 0.0)]


def test_a_call_of_an_eight_digit_program_on_haas_is_not_split() -> None:
    assert alarms(ran("O1\nM98 P30200\nM30\nO200\nM99", "haas:a")) == [("PS0076", 2)]


def test_macro_arguments_may_use_both_kinds_of_letters() -> None:
    macro = "O9\n#100=#1\n#101=#4\n#102=#7\n#103=#10\n#104=#26\n#105=#8\nM99"
    run = values(f"O1\nG65 P9 A1. I2. I3. I4. Z5. E6.\nM30\n{macro}")
    assert [run[number] for number in range(100, 106)] == [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]


def test_a_macro_has_local_variables_and_a_subprogram_has_none() -> None:
    run = values("O1\n#1=5\nG65 P9\n#100=#1\nM98 P9\n#101=#1\nM30\nO9\n#1=7\nM99")
    assert (run[100], run[101]) == (5.0, 7.0)


def test_a_modal_macro_runs_after_every_move_until_g67() -> None:
    run = values("O1\nG90 G0\nG66 P9 A2.\nX1\nX2\nM8\nG67\nX3\nM30\nO9\n#100=#100+#1\nM99")
    assert run[100] == 4.0


def test_more_than_four_calls_deep_is_an_alarm() -> None:
    assert alarms(ran("O1\nM98 P2\nM30\nO2\nM98 P2\nM99"))[0][0] == "PS0077"


def test_m99_with_p_returns_to_that_block_of_the_caller() -> None:
    assert values("O1\nM98 P2\n#100=1\nN9 #101=1\nM30\nO2\nM99 P9").keys() == {101}


@pytest.fixture
def small_limits(monkeypatch: pytest.MonkeyPatch) -> None:
    """A tenth of the rows after which a program counts as endless."""
    for name in ("MAX_ROWS_RUN_AGAIN", "MAX_ROWS_WITHOUT_MOVEMENT", "MAX_ROWS_WITHOUT_PROGRESS"):
        monkeypatch.setattr(macro_b_flow, name, getattr(macro_b_flow, name) // 10)


@pytest.mark.usefixtures("small_limits")
@pytest.mark.parametrize("loop", ["N1 #1=#1+1\nGOTO1", "WHILE[1EQ1]DO1\nEND1", "DO1\nEND1", "M99 P5\nN5 M99 P5"])
def test_an_endless_loop_without_movement_is_stopped(loop: str) -> None:
    assert alarms(ran(loop))[0][0] == "FN-ENDLESS"


@pytest.mark.usefixtures("small_limits")
@pytest.mark.parametrize(
    "loop",
    [
        "N1 G1 X1. F10.\nX2.\nGOTO1",
        "WHILE[1EQ1]DO1\nG91 G1 X1. F10.\nEND1",
        "N1 #1=#1+1\nG1 X#1 F10.\nIF[#1GT0]GOTO1",
        "#1=5\nWHILE[#1NE0]DO1\n#1=#1-2\nG1 X#1 F10.\nEND1",
        "WHILE[#1LT10]DO1\n#2=0\nWHILE[#2LT5]DO2\n#2=#2+1\nG1 X#2 F10.\nEND2\nEND1",
        "N1 M98 P2\nGOTO1\nM30\nO2\nG1 X1. F10.\nX2.\nM99",
        "N1 M98 P2\nM30\nO2\nG1 X1. F10.\nX2.\nM99 P1",
        "N1 M98 P2 L2\nGOTO1\nM30\nO2\n#1=0\nWHILE[#1LT3]DO1\n#1=#1+1\nG1 X#1 F10.\nEND1\nM99",
    ],
)
def test_an_endless_loop_with_movement_is_stopped_when_no_condition_gets_closer_to_its_end(loop: str) -> None:
    run = ran(loop)
    endless = next(finding for finding in run.findings if finding.code == "FN-ENDLESS")
    assert "no condition of a loop or a jump came closer" in endless.text
    assert endless.column == 1
    assert len(run.moves) < 2_000


@pytest.mark.usefixtures("small_limits")
@pytest.mark.parametrize(
    ("loop", "rounds"),
    [
        ("WHILE[#100LT1500]DO1\n#100=#100+1\nEND1\nM30", 1_500),
        ("WHILE[#101LT3]DO1\n#101=#101+1\n#1=800\nWHILE[#1GT0]DO2\n#1=#1-1\n#100=#100+1\nEND2\nEND1\nM30", 2_400),
        ("M98 P2 L900\nM30\nO2\n#100=#100+1\nG4 P1\nM99", 900),
        ("WHILE[#100LT8000]DO1\n#100=#100+1\nG1 X#100 F10.\nEND1\nM30", 8_000),
        ("N1 M98 P2\nGOTO1\nN3 M30\nO2\n#100=#100+1\nIF[#100GE900]GOTO4\nM99\nN4 M99 P3", 900),
    ],
)
def test_a_long_loop_that_gets_closer_to_its_end_runs(loop: str, rounds: int) -> None:
    assert values(f"#100=0\n#101=0\n{loop}")[100] == rounds


LONG_SUBPROGRAMS: Final = {
    "many rows": ("M98 P2\nM98 P2\nM30\nO2\n" + "#100=#100+1\n" * 2_500 + "M99", 5_000),
    "a loop": ("M98 P2\nM98 P2\nM30\nO2\n#1=700\nWHILE[#1GT0]DO1\n#1=#1-1\n#100=#100+1\nEND1\nM99", 1_400),
    "many calls": (
        "M98 P3 L2\nM30\nO3\n" + "G65 P2\n" * 60 + "M99\nO2\nWHILE[#1LT10]DO1\n#1=#1+1\n#100=#100+1\nEND1\nM99",
        1_200,
    ),
}
"""Programs that call long subprograms twice, by what those have, and the value of #100 at their end."""


@pytest.mark.usefixtures("small_limits")
@pytest.mark.parametrize("kind", LONG_SUBPROGRAMS)
def test_a_long_subprogram_that_is_called_again_is_not_endless(kind: str) -> None:
    program, count = LONG_SUBPROGRAMS[kind]
    assert values(f"#100=0\n{program}")[100] == count


def test_a_safety_line_and_common_codes_run() -> None:
    program = (
        "%\nO0001 (PART)\nG00 G17 G20 G40 G49 G80 G90\nT1 M06 (DRILL)\nG54 G90 S1000 M3\nG43 H1 Z1. M8\nG91 G28 Z0.\n"
        "G90 G5.1 Q1\nG98 G83 X1. Y1. Z-.5 R.1 Q.1 F10.\nX2.\nG80\n/M1\nG28 G91 Z0\nM30\n%\nG1 X9 THIS IS NOT READ"
    )
    run = ran(program)
    assert not alarms(run)
    assert [finding.code for finding in run.findings if finding.severity is Severity.WARNING] == ["NOT_RUN"]


def test_a_semicolon_ends_a_block_but_not_in_a_comment() -> None:
    assert ends(ran(f"{HEAD}X1.;Y2.;(A;B);X3.\nM30")) == [(1.0, 0.0), (1.0, 2.0), (3.0, 2.0)]


def test_a_remark_after_a_semicolon_is_skipped_and_reported() -> None:
    run = ran("N1 G21; mm mode\nG1 X5. F9; Rapid move to the side\nG1 Y1.;#100=5;IF[#100EQ5]GOTO9\nX99.\nN9 M30; End")
    assert ends(run) == [(5.0, 0.0), (5.0, 1.0)]
    assert len(findings_of(run, "TEXT")) == 3


def test_the_last_of_two_codes_of_one_group_takes_effect() -> None:
    run = ran(f"{HEAD}G90 G91 X5.\nX5.\nM30")
    assert ends(run)[-1] == (10.0, 0.0)
    assert findings_of(run, "GROUP")


def test_coordinates_without_a_decimal_point_make_one_finding() -> None:
    (finding,) = findings_of(ran("G21 G1 F100.\nX10 Y-5\nX0\nX3.\nM30"), "FN-POINT")
    assert finding.text.startswith("2 lengths")
    assert finding.text.endswith("cutcomp takes X10 as 10 units; at 3401#0 = 0 it is 0.01 mm.")
    assert (finding.line, finding.column) == (2, 1)
    (finding,) = findings_of(ran("G20 G1 F10.\nX1. Y- 5\nM30"), "FN-POINT")
    assert finding.text.endswith("cutcomp takes Y-5 as -5 units; at 3401#0 = 0 it is -0.0005 in.")
    (finding,) = findings_of(ran("G20 G1 F10.\nX1\nM30"), "FN-POINT")
    assert "takes X1 as 1 unit; " in finding.text
    (finding,) = findings_of(ran("G20 G1 F10.\nX1234567\nM30"), "FN-POINT")
    assert finding.text.endswith("cutcomp takes X1234567 as 1234567 units; at 3401#0 = 0 it is 123.4567 in.")


# transforms and roundings before compensation


def test_rotation_mirror_scale_and_polar_points_are_as_calculated() -> None:
    half = 10 * 0.5**0.5
    turned = ends(ran(f"{HEAD}G68 X10. Y20. R90.\nX15. Y20.\nG69\nX1. Y1.\nM30"))
    assert turned[-2:] == [(10.0, 25.0), (1.0, 1.0)]
    assert ends(ran(f"{HEAD}G68 X0 Y0 R45.\nX10. Y0\nG69\nX1. Y1.\nM30")) == [
        (round(half, 6), round(half, 6)),
        (1.0, 1.0),
    ]
    assert ends(ran(f"{HEAD}G51.1 X5.\nX0 Y1.\nM30")) == [(10.0, 1.0)]
    assert ends(ran(f"{HEAD}G51 X0 Y0 P2000\nX5. Y1.\nM30")) == [(10.0, 2.0)]
    assert ends(ran(f"{HEAD}G16\nX10. Y90.\nG15\nM30")) == [(0.0, 10.0)]


@pytest.mark.parametrize("size", ["R10.", "I10. J0."])
def test_a_mirrored_arc_turns_the_other_way(size: str) -> None:
    run = ran(f"{HEAD}G51.1 X0\nG1 X0 Y0 F9\nG2 X10. Y10. {size}\nM30")
    (arc,) = [move for move in run.moves if move.turn]
    assert (*arc.point[:2], *arc.center[:2], arc.turn) == pytest.approx((-10.0, 10.0, -10.0, 0.0, 1))


def test_a_mirror_image_reverses_a_rotation_and_scaling_moves_its_center() -> None:
    # 10 at 30 degrees, mirrored in x = 0
    mirrored = ran(f"{HEAD}G51.1 X0\nG68 X0 Y0 R30.\nX10. Y0\nM30")
    assert ends(mirrored) == [(-8.660254, 5.0)]
    # (20, 0) turned about (10, 0) is (10, 10)
    scaled = ran(f"{HEAD}G51 X0 Y0 P2000\nG68 X10. Y0 R90.\nX20. Y0\nM30")
    assert ends(scaled) == [(20.0, 20.0)]
    assert findings_of(mirrored, "FN-ROTATION")
    assert findings_of(scaled, "FN-ROTATION")


@pytest.mark.parametrize(
    "blocks", ["G68 X0 Y0 R30.\nG51.1 X0", "G68 X0 Y0 R9.\nG51 P2.", "G51 P2.\nG51.1 X0", "G68 X0 Y0"]
)
def test_a_rotation_that_depends_on_the_control_is_not_followed(blocks: str) -> None:
    assert [code for code, _ in alarms(ran(f"{HEAD}{blocks}\nX5. Y1.\nM30"))] == ["BEYOND"]


def test_a_rotation_programmed_incrementally_may_be_added() -> None:
    assert findings_of(ran(f"{HEAD}G91 G68 X0 Y0 R45.\nX5. Y1.\nM30"), "FN-ROTATION")


@pytest.mark.parametrize("scale", ["G51 X#1 Y0 P2.", "G51 X[0] Y0 P2000", "#2=2000\nG51 X0 Y0 P#2"])
def test_a_scale_keeps_its_decimal_point_beside_variables(scale: str) -> None:
    assert ends(ran(f"{HEAD}#1=0\n{scale}\nX5. Y1.\nM30")) == [(10.0, 2.0)]


def test_a_scale_of_thousandths_that_was_meant_as_a_factor_is_refused() -> None:
    for scale in ("G51 X0 Y0 P2", "#2=2.\nG51 X0 Y0 P#2"):
        assert [code for code, _ in alarms(ran(f"{HEAD}{scale}\nX5. Y1.\nM30"))] == ["BEYOND"]


@pytest.mark.parametrize("size", ["R10.", "I10. J0."])
def test_a_negative_scale_is_a_mirror_image_about_its_center(size: str) -> None:
    """In X=5, the points X0 Y0 and X10 Y10 come to X10 Y0 and X0 Y10."""
    run = ran(f"{HEAD}G51 X5. Y0 Z0 I-1000 J1000 K1000\nG1 X0 Y0 F9\nG2 X10. Y10. {size}\nG50\nG1 X1. Y2.\nM30")
    assert not run.findings
    (arc,) = [move for move in run.moves if move.turn]
    assert (*arc.point[:2], *arc.center[:2], arc.turn) == pytest.approx((0.0, 10.0, 0.0, 0.0, 1))
    assert ends(run)[-1] == (1.0, 2.0)


@pytest.mark.parametrize("scale", ["I-1. J1. K1.", "I-1000 J1000", "I-2. J2. K2."])
def test_a_contour_mirrored_by_a_negative_scale_is_compensated_on_the_other_side(scale: str) -> None:
    run = ran(f"{HEAD}G51 X0 Y0 Z0 {scale}\nX-20 Y0\nG41 D1 X0\nX50\nG40 X60\nM30")
    size = 2 if "2" in scale else 1
    assert ends(run)[1:3] == [(0.0, 5.0), (-50.0 * size, 5.0)]
    assert bool(findings_of(run, "FN-SCALE")) is ("K" not in scale)


def test_two_negative_scales_turn_the_contour_and_keep_its_side() -> None:
    run = ran(f"{HEAD}G51 X0 Y0 Z0 I-1. J-1. K1.\nX-20 Y0\nG41 D1 X0\nX50\nG40 X60\nM30")
    assert ends(run)[1:3] == [(0.0, -5.0), (-50.0, -5.0)]


@pytest.mark.parametrize(
    "blocks",
    [
        "G51 X0 Y0 I-1. J2. K1.",
        "G51 X0 Y0 I0 J0 K0",
        "G51 X0 Y0 I-1 J1 K1",
        "G51 X0 Y0 I2. J2.",
        "G51 X0 Y0 P2. I-1.",
        "G51 X0 Y0 I-1. J1. K1.\nG68 X0 Y0 R30.",
        "G51.1 Y0\nG51 X0 Y0 I-1. J1. K1.",
    ],
)
def test_a_scale_by_axes_that_is_not_clear_is_not_followed(blocks: str) -> None:
    assert [code for code, _ in alarms(ran(f"{HEAD}{blocks}\nX5. Y1.\nM30"))] == ["BEYOND"]


def test_a_haas_scales_all_axes_by_one_factor() -> None:
    """Haas mill operator's manual 96-8000, G51: X, Y, Z and P only."""
    assert [code for code, _ in alarms(ran(f"{HEAD}G51 X0 Y0 I-1. J1. K1.\nX5. Y1.\nM30", "haas:a"))] == ["BEYOND"]


def test_a_mirrored_contour_is_compensated_on_the_other_side() -> None:
    # mirrored in x = 0, G41 along +X becomes a path along -X with the tool on its right, above it
    run = ran(f"{HEAD}G51.1 X0\nX-20 Y0\nG41 D1 X0\nX50\nG40 X60\nM30")
    assert ends(run)[1:3] == [(0.0, 5.0), (-50.0, 5.0)]


def test_roundings_and_chamfers_become_moves() -> None:
    program = f"{HEAD}X50.,R10.\nY40.,C5.\nX0\nM30"
    run = ran(program)
    assert [move.kind for move in flat(run)] == ["line", "ccw", "line", "line", "line"]
    assert ends(run) == [(40.0, 0.0), (50.0, 10.0), (50.0, 35.0), (45.0, 40.0), (0.0, 40.0)]
    assert ends(ran(f"{HEAD}G91 X50.,C10.\nY40.\nM30"))[-1] == (50.0, 40.0)


@pytest.mark.parametrize(
    ("before", "variable", "code"),
    [
        *(("", 4001, 1.0), ("", 4002, 17.0), ("", 4003, 90.0), ("", 4005, 94.0), ("", 4006, 21.0), ("", 4007, 40.0)),
        *(("", 4008, 49.0), ("", 4009, 80.0), ("", 4010, 98.0), ("", 4011, 50.0), ("", 4014, 54.0), ("", 4015, 64.0)),
        *(
            ("", 4012, 67.0),
            ("", 4016, 69.0),
            ("", 4017, 15.0),
            ("", 4022, 50.1),
            ("G51.1 Y0\n", 4022, 51.1),
            ("G55\n", 4014, 55.0),
        ),
    ],
)
def test_a_variable_has_the_code_in_force(before: str, variable: int, code: float) -> None:
    assert ends(ran(f"{HEAD}{before}G0 X#{variable}\nM30")) == [(code, 0.0)]


@pytest.mark.usefixtures("small_limits")
def test_many_lines_without_movement_are_no_endless_loop() -> None:
    run = ran(f"{HEAD}" + "#1=1\n" * 10_100 + "X5.\nM30")
    assert (alarms(run), ends(run)) == ([], [(5.0, 0.0)])


def test_a_rounding_between_slanted_moves_is_tangent_to_both() -> None:
    # the moves turn by 106.26 degrees: the rounding begins 5 tan(53.13) = 20/3 before the corner (30, 40)
    run = ran(f"{HEAD}X30. Y40.,R5.\nX60. Y0\nM30")
    line, arc, _ = flat(run)
    assert (line.kind, arc.kind) == ("line", "cw")
    assert line.end[:2] == pytest.approx((26.0, 40.0 - 16.0 / 3.0))
    assert arc.end[:2] == pytest.approx((34.0, 40.0 - 16.0 / 3.0))
    assert arc.center == pytest.approx((30.0, 40.0 - 25.0 / 3.0))


def test_a_polar_block_without_radius_and_angle_moves_the_tool_axis_alone() -> None:
    assert flat(ran(f"{HEAD}G16\nX10. Y90.\nZ-5.\nG15\nM30"))[-1].end == pytest.approx((0.0, 10.0, -5.0))


def test_an_arc_from_a_machine_position_is_not_followed() -> None:
    assert alarms(ran(f"{HEAD}G1 X10\nG91 G28 X0\nG90 G2 X5. Y5. R5.\nM30")) == [("FN-WHERE", 4)]


def test_haas_accepts_work_offsets_g110_to_g129_but_not_g130() -> None:
    for code in ("G110", "G129"):
        assert not alarms(ran(f"{HEAD}{code}\nX5.\nM30", "haas:a"))
    assert alarms(ran(f"{HEAD}G130\nX5.\nM30", "haas:a"))


def test_a_rounding_longer_than_its_move_is_an_alarm() -> None:
    assert alarms(ran(f"{HEAD}X50.,R60.\nY40.\nM30")) == [("PS0055", 2)]


@pytest.mark.parametrize("moves", ["G2 X50. Y-50. R50.,R2.\nG1 Y-80.", "X50.,R2.\nG2 X80. Y-30. R30."])
@pytest.mark.parametrize("control", ["fanuc:a", "haas:a"])
def test_a_rounding_beside_an_arc_is_not_followed(control: str, moves: str) -> None:
    assert [code for code, _ in alarms(ran(f"{HEAD}{moves}\nM30", control))] == ["BEYOND"]


@pytest.mark.parametrize("block", ["G0 X50.,R2.", "M8,R2.", "G4 P1,R2.", "G1,R2."])
def test_a_rounding_without_a_straight_move_is_an_alarm(block: str) -> None:
    assert alarms(ran(f"{HEAD}{block}\nG1 Y40.\nM30")) == [("PS0051", 2)]


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a", "allen-bradley:a", "rosettacnc:normal"])
def test_a_tool_change_under_compensation_is_reported(control: str) -> None:
    program = f"T1 M6\n{HEAD}G54 G0 X-20. Y-20.\nG1 Z-5.\nG41 D1 X0 Y-10.\nY50.\n{{0}}\nX50.\nG40 X60.\nM30"
    changed = ran(program.format("T2 M6"), control, {1: 3.0, 2: 5.0})
    assert [finding.line for finding in changed.findings if finding.code == "OFFSET"] == [7]
    for block in ("T1 M6", "G40 T2 M6", "G0 G40 Z50.\nT2 M6", "G40\nT2 M6"):
        assert not findings_of(ran(program.format(block), control, {1: 3.0, 2: 5.0}), "OFFSET"), block


@pytest.mark.parametrize(
    ("blocks", "column"),
    [
        ("G65 P5 A50 D1\nM30\nO5\nG0 Y#1\nM99", 8),
        ("G54 X10\nM30", 5),
        ("G99 G81 Z-5. R2. F9.\nG91 X10. K3\nM30", 0),
        ("G91 X10. R1. K3\nM30", 0),
        ("G18 G2 X10. Z0. K5\nM30", 17),
        ("M96 P10 Q5\nM30", 0),
        ("M19 R90\nM30", 0),
        ("X7 M19\nM30", 1),
        ("M19 R90 X7\nM30", 9),
    ],
)
def test_lengths_without_a_decimal_point_are_reported_and_counts_are_not(blocks: str, column: int) -> None:
    assert [finding.column for finding in findings_of(ran(HEAD + blocks), "FN-POINT")] == [column] * bool(column)


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a"])
def test_the_angle_of_an_oriented_spindle_is_used(control: str) -> None:
    assert not findings_of(ran(f"{HEAD}M19 R90.\nM19 P270\nM30", control), "UNUSED")


@pytest.mark.parametrize(
    ("blocks", "last"),
    [
        ("#2201=5.\nX#2201 Y#2001", (5.0, 0.0)),
        ("#2001=5.\nX#2001 Y#2201", (5.0, 0.0)),
        ("#2400=5.\nX#2400 Y#2200", (5.0, 0.0)),
        ("G10 L10 P1 R5.\nX#2201 Y#2001", (5.0, 0.0)),
        ("G10 L11 P1 R5.\nX#2001 Y#2201", (5.0, 0.0)),
        ("X#4001 Y#4109", (1.0, 100.0)),
        ("T7\nX#4120 Y#4003", (7.0, 90.0)),
        ("X7.\nX[#5001+1.] Y#5041", (8.0, 7.0)),
        ("G10 L2 P1 X5.\nG91 G10 L2 P1 X2.\nG90 G54 G0 X1.", (8.0, 0.0)),
        ("G51 X0 Y0 P2.\nX5.\nG50\nX6. Y1.", (6.0, 1.0)),
        ("G51 X0 Y0 P2.\nX6. Y1.", (12.0, 2.0)),
        ("G51.1 X0 Y0\nX5. Y3.\nG50.1 X0\nX6. Y3.", (6.0, -3.0)),
        ("G51.1 X0 Y0\nX5. Y3.\nG50.1\nX7. Y4.", (7.0, 4.0)),
    ],
)
def test_memories_modal_values_and_canceled_transforms_are_as_calculated(
    blocks: str, last: tuple[float, float]
) -> None:
    run = ran(f"{HEAD}{blocks}\nM30")
    assert not alarms(run)
    assert ends(run)[-1] == last


def test_a_body_of_a_macro_that_runs_as_a_program_says_so() -> None:
    (finding,) = findings_of(ran(f"{HEAD}G0 X#1\nM99"), "FN-BODY")
    assert (finding.line, finding.severity) == (1, Severity.INFO)
    assert not findings_of(ran(f"{HEAD}G0 X#1\nM30"), "FN-BODY")


def test_common_variables_that_are_read_before_they_are_set_are_reported() -> None:
    used = ("X#500", "X-#500", "IF[#501EQ1]GOTO9", "#1=#502+1", "G#503 X1.", "#1=#502\nX#1", "IF[ABS[#500]LT1]GOTO9")
    for block in (*used, "IF[[#500EQ#0]OR[#510EQ1]]GOTO9", "IF[#501GE#502]GOTO9", "IF[#501EQ#502]GOTO9"):
        assert findings_of(ran(f"{HEAD}{block}\nN9 M30"), "PARAMETER"), block
    for block in ("IF[#501EQ#0]GOTO9", "#1=#502", "#504=1\nX#504", "IF[[#500EQ#0]AND[#24GT0]]GOTO9", "#505=#0\nX#505"):
        assert not findings_of(ran(f"{HEAD}{block}\nN9 M30"), "PARAMETER"), block


def test_a_block_skip_inside_a_block_is_reported() -> None:
    skipped = ran(f"{HEAD}X50. /Y60.\nM30")
    assert [finding.column for finding in findings_of(skipped, "SKIP")] == [6]
    assert ends(skipped) == [(50.0, 60.0)]


def test_haas_sends_all_axes_home_when_g28_names_none() -> None:
    assert [finding.line for finding in findings_of(ran(f"{HEAD}G28\nM30", "haas:a"), "HOME")] == [2]
    assert not findings_of(ran(f"{HEAD}G28\nM30"), "HOME")


def test_calls_on_a_signal_or_to_an_external_program_are_not_followed() -> None:
    for block in ("M96 P10", "M198 P5"):
        assert alarms(ran(f"{HEAD}{block}\nM30")) == [("BEYOND", 2)]
    assert findings_of(ran(f"{HEAD}M97 P10\nM30\nN10 G1 X5.\nM99"), "UNUSED")


def test_a_macro_of_the_machine_is_unsupported_and_an_absent_subprogram_is_an_alarm() -> None:
    assert alarms(ran(f"{HEAD}G65 P9810 Z-5.\nM30")) == [("BEYOND", 2)]
    assert alarms(ran(f"{HEAD}M98 P810\nM30")) == [("PS0076", 2)]


def test_a_comment_inside_a_comment_is_named_as_the_cause() -> None:
    (finding,) = findings_of(ran(f"{HEAD}(A (B) C)\nM30"), "PS0114")
    assert (finding.text, finding.column) == ("A ) has no ( before it: a comment cannot hold another one.", 9)


def holes(program: str, control: str = "fanuc:a") -> list[tuple[float, float, float]]:
    """The bottoms of the holes of a program: the ends of downward feed moves."""
    moves = list(ran(program, control).moves)
    down = [move for before, move in pairwise(moves) if not move.rapid and move.point[2] < before.point[2]]
    return [(round(move.point[0], 3) + 0.0, round(move.point[1], 3) + 0.0, move.point[2]) for move in down]


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a"])
def test_a_cycle_keeps_its_heights_when_its_positions_become_incremental(control: str) -> None:
    program = "G21 G90 G0 X0 Y0 Z50.\nG99 G81 X0 Y0 Z-10. R2. F100\nG91 X10. K3\nG90 G80\nM30"
    assert holes(program, control) == [(x, 0.0, -10.0) for x in (0.0, 10.0, 20.0, 30.0)]
    program = "G21 G90 G0 X0 Y0 Z50.\nG91 G99 G81 X10. Z-12. R-48. K2 F100\nG90 X50. Y20.\nG80\nM30"
    assert holes(program, control) == [(10.0, 0.0, -10.0), (20.0, 0.0, -10.0), (50.0, 20.0, -10.0)]


def test_repeats_of_a_cycle_go_around_the_pole() -> None:
    program = "G21 G90 G0 X0 Y0 Z5.\nG16\nG99 G81 X20. Y0 Z-6. R2. F100\nG91 Y60. K5\nG15 G90 G80\nM30"
    places = [(round(20 * cos(radians(angle)), 3), round(20 * sin(radians(angle)), 3)) for angle in range(0, 360, 60)]
    assert [hole[:2] for hole in holes(program)] == [(x + 0.0, y + 0.0) for x, y in places]


@pytest.mark.parametrize(("control", "letter"), [("fanuc:a", "K"), ("fanuc:a", "L"), ("haas:a", "L")])
def test_a_cycle_with_no_repeats_is_only_stored(control: str, letter: str) -> None:
    program = f"G21 G90 G0 X0 Y0 Z5.\nG99 G81 X9. Z-5. R2. F100 {letter}0\nX20.\nG80\nM30"
    assert holes(program, control) == [(20.0, 0.0, -5.0)]


def test_a_program_message_is_reported_and_does_not_stop_the_run() -> None:
    run = ran("#3006=1(TURN THE PART)\nG21 G1 X5. F9\nM30")
    assert ends(run) == [(5.0, 0.0)]
    assert findings_of(run, "FN-MESSAGE")


def test_an_unset_common_variable_in_a_sum_is_reported() -> None:
    assert [
        finding.line for finding in findings_of(ran("#1=#500+1\n#2=#501\nIF[#502EQ#0]GOTO9\nN9 M30"), "PARAMETER")
    ] == [1]


def test_the_alarm_for_a_machine_builder_code_names_the_macro_call() -> None:
    run = ran("G21\nG105 X5.\nM30")
    assert alarms(run) == [("PS0010", 2)]
    assert "G65" in findings_of(run, "PS0010")[0].text


def test_the_corner_arc_of_a_rapid_is_rapid() -> None:
    run = ran(f"{ENTERED}G0 X10 Y-40\nG40 X0 Y-50\nM30", "fanuc:a-arc")
    assert [(move.rapid, move.turn) for move in list(run.moves) if move.line == 5] == [(True, -1), (True, 0)]


def comparable(case: dict[str, Any]) -> bool:
    variant = case["variant"]
    usual = variant["read"] == 3 and variant["check"] and variant["corner"] == "linear" and variant["startup"] != "c"
    return usual and not variant["haas"] and case["id"][0] != "x"


DIFFERENT: Final = frozenset({"c09", "i04", "i05", "i07", "m19", "m22", "m25", "m28", "s16"})
"""D0, R = r and the blocks before R < r, dropped vectors, a new D, G41 again, blocks without movement, G39."""


def test_the_nine_series_differs_from_fanuc_in_the_listed_cases_only() -> None:
    different = set()
    for case in filter(comparable, GOLDEN):
        radii = {int(number): r for number, r in case["offset_radii"].items()}
        run, nine_series = run_of(case), ran(case["program"], f"nine-series:{case['variant']['startup']}", radii)
        same = len(flat(run)) == len(flat(nine_series)) and run.stopped_at == nine_series.stopped_at
        if not same or any(apart(a.end, b.end) > 1e-6 for a, b in zip(flat(run), flat(nine_series), strict=True)):
            different.add(case["id"])
    assert different == DIFFERENT


def test_a_start_up_from_a_machine_position_is_reported_or_stops_the_run() -> None:
    program = f"{HEAD}G28 X0 Y0\nG90 G1 G41 D1 X50 Y0\nY40\nG40 X0\nM30"
    assert findings_of(ran(program), "FN-WHERE")
    assert ends(ran(program))[0] == (45.0, 0.0)
    assert alarms(ran(program, "fanuc:b")) == [("FN-WHERE", 3)]


def test_the_external_work_offset_shifts_all_work_offsets() -> None:
    assert ends(ran(f"{HEAD}G10 L2 P0 X10.\nG10 L2 P1 X5.\nX1. Y1.\nM30")) == [(16.0, 1.0)]


def test_work_offsets_have_twenty_variables_each() -> None:
    program = "G21\nG10 L2 P2 X20. Z2.\nG10 L20 P2 X30.\nG10 L20 P48 Z48.\n"
    variables = values(f"{program}#100=#5241\n#101=#5243\n#102=#7021\n#103=#7943\n#104=#7001\n#105=#7041\nM30")
    assert [variables[key] for key in range(100, 106)] == [20.0, 2.0, 30.0, 48.0, 0.0, 0.0]


@pytest.mark.parametrize(("control", "value"), [("haas", 7.0), ("fanuc", 4.0)])
def test_the_first_origin_variable_of_a_haas_has_the_shift_of_g52(control: str, value: float) -> None:
    run = ran("G21\nG10 L2 P0 X4.\nG52 X3.\n#100=#5201\nM30", control)
    assert dict(run.variables)[100] == value


def test_each_axis_that_is_not_followed_is_reported_once() -> None:
    assert len(findings_of(ran("G21 G0 X1. A0.\nX2. A5.\nX3. B1.\nM30"), "AXIS")) == 2


def test_the_program_number_may_follow_the_percent_sign() -> None:
    assert ends(ran("%O0012\nG21 G0 X1.\nM98 P12\nM30\n%"))[0] == (1.0, 0.0)


@pytest.mark.parametrize("code", ["7", "7.1", "29", "37", "45", "46", "47", "48", "12.1", "13.1"])
def test_codes_that_change_the_path_in_unsupported_ways_are_refused(code: str) -> None:
    run = ran(f"G21 F10.\nG{code} X1.\nG1 X5.\nM30\n")
    assert alarms(run) == [("BEYOND", 2)]
    assert f"G{code}" in findings_of(run, "BEYOND")[0].text


@pytest.mark.parametrize("letter", ["K", "L"])
def test_a_drilling_cycle_repeats_with_k_or_l(letter: str) -> None:
    run = ran(f"G21 F10.\nG91 G99 G81 X10. Z-2. R-1. {letter}3\nG80\nM30\n")
    depths = [move.end[0] for move in flat(run) if move.end[2] < -2.5]
    assert depths == [10.0, 20.0, 30.0]


@pytest.mark.parametrize(("value", "end"), [(1, 9.0), (2, 7.0)])
def test_a_true_condition_before_m99_jumps(value: int, end: float) -> None:
    program = f"G21 G90 F10.\n#100={value}\n[#100 EQ 1] M99 P10\nG1 X7.\nM30\nN10 G1 X9.\nM30\n"
    assert ends(ran(program, "haas:a"))[-1] == (end, 0.0)


def test_an_oblique_move_in_three_axes_is_compensated() -> None:
    run = ran("G21 G90 F100.\nG1 G41 D1 X10. Y0\nX30. Z-1.\nX50. Y5. Z-2.\nX70. Y5.\nG40 X90.\nM30\n")
    # where y = 10 meets the line 5 to the left of the one from (30, 0) in direction (4, 1)
    corner = (70 - 5 * 17**0.5, 10.0, -2.0)
    assert any(apart(move.end, corner) < 1e-6 for move in flat(run))


def test_text_after_a_semicolon_may_be_a_number() -> None:
    run = ran("G21 G90 G0 X0 Y0\nM6 T1 ; 0.8128\nM30")
    assert not alarms(run)


@pytest.mark.parametrize("line", ["$AddRegPart 1 X2.925 Y2.005", "#region", "  #EndRegion (part)"])
def test_lines_for_editors_and_simulators_are_ignored(line: str) -> None:
    run = ran(f"O1\n{line}\nG21 G90 G0 X3. Y0\nM30")
    assert not alarms(run)
    assert run.moves.points[-1, 0] == 3.0
    assert any("for an editor or a simulator" in finding.text for finding in run.findings)


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a"])
@pytest.mark.parametrize("line", ["G71 P10 Q20 U0.02 W0.01 F0.01", "G72 P1 Q2", "G75 R.1 W2."])
def test_a_lathe_cycle_is_named_as_such(line: str, control: str) -> None:
    run = registry.run(f"O1\nG20 G90 G0 X0 Z0\n{line}\nM30".encode(), control)
    stop = next(finding for finding in run.findings if finding.line == run.stopped_at)
    assert stop.text == f"{line[:3]} is a cycle of lathes. cutcomp checks programs of mills."


def test_a_haas_drilling_cycle_needs_no_r() -> None:
    """Calculated by hand: from Z 0.1 down to -0.45 and back."""
    text = b"O1\nG20 G90 G0 X1. Y2. Z0.1\nG81 G98 Z-0.45 F9.\nG80\nM30"
    run = registry.run(text, "haas:a")
    assert run.stopped_at is None
    assert [round(z / 25.4, 4) for z in run.moves.points[-2:, 2].tolist()] == [-0.45, 0.1]
    other = registry.run(text, "fanuc:a")
    assert other.stopped_at == 3


def test_the_radius_takes_precedence_over_the_center_of_an_arc() -> None:
    plain = ran(f"{HEAD}X0 Y0\nG2 X10. R5.\nM30")
    both = ran(f"{HEAD}X0 Y0\nG2 X10. R5. I3. J1.\nM30")
    assert flat(both) == flat(plain)
    assert flat(both)[-1].center == pytest.approx((5.0, 0.0))


def test_a_colon_may_replace_the_letter_of_a_program_number() -> None:
    run = ran(f"%\n:5\n{HEAD}X10.\nY5.\nM98 P7\nM30\n:7\nX20.\nM99\n%")
    assert [move.end[:2] for move in flat(run)] == [(10.0, 0.0), (10.0, 5.0), (20.0, 5.0)]
    assert not [finding for finding in run.findings if finding.severity is not Severity.INFO]


UNSUPPORTED: Final = (
    "G2.1 G2.2 G2.3 G2.4 G3.1 G3.2 G3.3 G3.4 G6.2 G7 G7.1 G12.1 G13.1 G29 G33 G37 G43.1 G43.4 G43.5 G45 G46 G47 G48 "
    "G66.1 G68.2 G68.3 G68.4"
)
"""Codes in the control's manual that change the path in a way cutcomp does not calculate."""


@pytest.mark.parametrize("code", UNSUPPORTED.split())
def test_an_unsupported_code_of_the_control_stops_the_run(code: str) -> None:
    run = ran(f"{HEAD}X1.\n{code} X5. I1. J1. R1.\nX9.\nM30")
    stop = run.findings[-1]
    assert (stop.code, stop.severity, stop.line) == ("BEYOND", Severity.ERROR, 3)
    assert f"does not support {code}." in stop.text
    assert flat(run)[-1].end[0] == 1.0


@pytest.mark.parametrize("leader", ["\0\0\0", "\x12", "\x7f\0\x11 "])
@pytest.mark.parametrize("control", ["fanuc:a", "haas:a"])
def test_the_leader_of_a_tape_is_not_read(leader: str, control: str) -> None:
    run = ran(f"{leader}%\nO1\nG21 G90\nG0 X1.\nM30\n\x14%\n\0\0", control)
    assert ends(run) == [(1.0, 0.0)]
    assert not alarms(run)


def test_the_older_work_offset_variables_equal_those_of_g10() -> None:
    """#2501 to #2506 are X of G54 to G59, #2600 is Y of the external offset."""
    assert ends(ran("G21\nG10 L2 P2 X20.\n#2600=3.\nG55 G0 X#2502 Y1.\nM30")) == [(40.0, 4.0)]


def test_calls_that_may_count_as_blocks_without_movement_are_reported() -> None:
    """Controls differ on whether the M98 and M99 of two subprograms in a row count."""
    program = f"{ENTERED}M98 P2\nM98 P3\nG40 X0\nM30\nO2\nY40\nM99\nO3\nX0\nM99"
    assert findings_of(ran(program), "FN-N2")[0].text.endswith(
        "Some controls count M98 and M99 as such blocks, as here."
    )
    assert "M98" not in findings_of(ran(f"{ENTERED}M8\nM9\nY40\nG40 X0\nM30"), "FN-N2")[0].text


def test_g54_with_p_is_g54_1_and_g30_accepts_p() -> None:
    program = "G21 G17 G90 G40\nG10 L20 P3 X100. Y0. Z0.\nG54 P3\nG0 X1.\nM30\n"
    written = ran(program)
    assert flat(written) == flat(ran(program.replace("G54 P3", "G54.1 P3")))
    assert not {"UNUSED", "OFFSET"} & {finding.code for finding in written.findings}
    # no Haas manual lists it
    assert "UNUSED" in {finding.code for finding in ran(program, "haas:a").findings}
    for control in ("fanuc:a", "haas:a"):
        home = ran("G21 G90\nG91 G30 P2 Z0.\nM30\n", control)
        assert "UNUSED" not in {finding.code for finding in home.findings}


@pytest.mark.parametrize(
    "block",
    ["G54 G4 P500", "G54 G10 L2 P1 X5.", "G54 G82 X5. Y5. Z-5. R1. P500 F100.", "G54 M98 P1", "G54 G30 P2 Z0."],
)
@pytest.mark.parametrize("control", ["fanuc:a", "haas:a"])
def test_the_p_of_another_code_selects_no_work_offset(block: str, control: str) -> None:
    program = f"O1000\nG21 G17 G90 G40\nG55\n{block}\nG90 G80 G0 X1. Y1.\nM30\nO1\nM99\n"
    apart = program.replace("G54 ", "G54\n")
    run = ran(program, control)
    assert run.stopped_at is None, run.findings
    assert [move.end for move in flat(run)] == [move.end for move in flat(ran(apart, control))]


@pytest.mark.parametrize(
    ("control", "alarm"), [("fanuc:a", None), ("haas:a", "H342"), ("haas:b", "H342"), ("haas:a-yasnac", "H342")]
)
def test_an_inside_arc_of_the_tool_radius_is_an_alarm_on_haas_only(control: str, alarm: str | None) -> None:
    program = (
        "G21 G17 G90 G40\nT1 M6\nG0 X20. Y20.\nG1 Z-5. F200.\nG41 D1 Y0.\nX35.\nG3 X40. Y5. R5.\nG1 Y40.\nX0.\nY0.\n"
        "X22.\nG40 X20. Y20.\nM30\n"
    )
    run = ran(program, control)
    assert run.stopped_at == (None if alarm is None else 7)
    assert [finding.code for finding in run.findings if finding.severity is Severity.ERROR] == (
        [alarm] if alarm else []
    )


@pytest.mark.parametrize(
    ("moves", "ends"),
    [
        ("G91 G1 Y45.\n", [(35.355339, 35.355339)]),
        ("G91 G3 Y45. R50.\n", [(35.355339, 35.355339)]),
        ("G91 G1 Y45. ,R2.\nY45.\n", [(0.0, 50.0)]),
    ],
)
def test_a_polar_angle_counts_once(moves: str, ends: list[tuple[float, float]]) -> None:
    """Calculated by hand: 50 at 45 degrees and at 90."""
    run = ran(f"G21 G90 G17\nG0 X0. Y0.\nG16\nG1 X50. Y0. F100.\n{moves}G90 G15\nM30\n")
    assert run.stopped_at is None, run.findings
    assert [move.end[:2] for move in flat(run)][-1] == pytest.approx(ends[-1], abs=1e-5)


@pytest.mark.parametrize(
    ("before", "key"),
    [
        ("G91 G28 X0. Y0.\nG90\n", 5001),
        ("G91 G28 X0. Y0.\nG90\n", 5042),
        ("G53 G0 Z0.\n", 5003),
        ("G41 D1 G1 X20. F100.\nX40.\n", 5041),
    ],
)
@pytest.mark.parametrize("control", ["fanuc:a", "haas:a"])
def test_an_unknown_position_cannot_be_read(before: str, key: int, control: str) -> None:
    run = ran(f"G21 G90 G17\nG0 X10. Y20. Z5.\n{before}#101=#{key}\nG40 G1 X[#101+1.] Y1. F100.\nM30\n", control)
    assert run.stopped_at == 3 + before.count("\n")
    assert [finding.code for finding in run.findings if finding.severity is Severity.ERROR] == ["PS0115"]
    known = ran(f"G21 G90 G17\nG0 X10. Y20. Z5.\n#101=#{key}\nG1 X[#101+1.] Y1. F100.\nM30\n", control)
    assert known.stopped_at is None


@pytest.mark.parametrize("end", ["", "G28 X0. Y0.\n", "G53 X0. Y0.\n", "G91 G28 Z0.\n"])
def test_compensation_left_on_is_reported_even_after_a_move_to_a_machine_position(end: str) -> None:
    program = f"{ENTERED}{end}M30\n"
    assert "FN-OPEN" in {finding.code for finding in ran(program).findings}
    alarmed = ran(program, "haas:a")
    assert [finding.code for finding in alarmed.findings if finding.severity is Severity.ERROR] == ["H349"]
    assert "FN-OPEN" not in {finding.code for finding in ran(f"{ENTERED}G40 G0 Y-20\n{end}M30\n").findings}


def test_text_before_the_first_percent_sign_is_reported() -> None:
    run = ran("O1\nG21 G90 G17\nG0 X50.\nM30\n%\nO2\nG21 G90\nG0 X2.\nM30\n%\n")
    (unread,) = [finding for finding in run.findings if finding.code == "NOT_RUN"]
    assert (unread.line, "before the program" in unread.text) == (1, True)


def test_repeated_i_and_j_arguments_of_a_macro_are_no_mistake() -> None:
    run = ran("G65 P9 I1. J2. I3. J4.\nM30\nO9\nG0 X#4 Y#7\nM99\n")
    assert "TWICE" not in {finding.code for finding in run.findings}
    assert flat(run)[-1].end[:2] == (1.0, 3.0)


REPEATED = (
    "O1003\nG21 G17 G40 G80 G90\nT1 M6\nG54 G0 X-20. Y-20.\nG43 H1 Z5.\nG10 L12 P1 R{first}\nM98 P2003\n"
    "G10 L12 P1 R{second}\nM98 P2003\nG0 Z100.\nM30\nO2003\nG0 X-20. Y-20. Z2.\nG1 Z-5. F200.\n"
    "G41 D1 X0 Y-10.\nY50.\nX60.\nY0\nX-10.\nG40 X-20. Y-20.\nG0 Z5.\nM99\n"
)
"""A subprogram that is run with two offsets."""


@pytest.mark.parametrize(("first", "second"), [("6.", "4."), ("4.", "6."), ("3.", "4.")])
def test_a_warning_on_a_line_is_kept_after_information_on_its_first_run(first: str, second: str) -> None:
    done = ran(REPEATED.format(first=first, second=second))
    assert done.stopped_at is None
    assert [finding.code for finding in done.findings if finding.severity is Severity.WARNING] == ["OFFSET"]


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a"])
@pytest.mark.parametrize(
    ("home", "axes"),
    [
        ("G91 G28 X0. Y0. Z0.", "X and Y"),
        ("G91 G28 Y0.", "Y"),
        ("G53 G0 X-100. Z0.", "X"),
        ("G91 G28 Z0.\nG28 X0. Y0.", ""),
        ("G53 G0 Z0.\nG53 X0. Y0.", ""),
        ("G0 Z1.\nG91 G28 X0. Y0. Z0.", ""),
        ("G91 G28 X0. Y0. Z10.", ""),
        ("T2 M6\nG91 G28 X0. Y0.", ""),
    ],
)
def test_x_and_y_that_leave_for_a_machine_point_at_depth_are_a_warning(control: str, home: str, axes: str) -> None:
    run = ran(f"{HEAD}G54 G0 X50.\nZ5.\nG1 Z-5. F100.\nX60.\n{home}\nM30\n", control)
    warnings = [finding for finding in findings_of(run, "HOME") if finding.severity is Severity.WARNING]
    assert [(finding.line, finding.lengths) for finding in warnings] == ([(6, (-5.0,))] if axes else [])
    assert all(f"goes to the machine's {axes}." in finding.text for finding in warnings)


def test_the_height_at_a_machine_point_is_that_of_the_work_offset() -> None:
    text = f"{HEAD}G10 L2 P1 Z-300.\nG54 G0 X50.\nZ5.\nG91 G28 X0.\nM30\n"
    assert {finding.severity for finding in findings_of(ran(text), "HOME")} == {Severity.INFO}
    assert findings_of(ran(text.replace("Z5.", "Z-2.")), "HOME")[0].lengths == (-2.0,)


@pytest.mark.parametrize("offset", ["G10 L2 P1 Z50.\nG54", "G52 Z20."])
def test_the_height_is_not_known_before_the_first_move_in_z(offset: str) -> None:
    run = ran(f"{HEAD}{offset}\nG91 G28 X0. Y0.\nM30\n")
    assert {finding.severity for finding in findings_of(run, "HOME")} == {Severity.INFO}


@pytest.mark.parametrize("control", ["fanuc:a", "fanuc:b"])
def test_a_start_up_from_a_height_at_the_machines_point_is_an_ordinary_one(control: str) -> None:
    """Only Z is at the machine's point: where the move starts in the plane is known."""
    text = f"{HEAD}G0 X0. Y0.\nG91 G28 Z0.\nG90 G41 D1 X50. Y0. Z5.\nG1 X90. F100.\nG40 Y50.\nM30\n"
    run = ran(text, control)
    assert run.stopped_at is None
    assert not findings_of(run, "FN-WHERE")


def test_a_program_in_increments_goes_on_after_a_tool_change() -> None:
    """Where the machine changes tools is its own matter: the increments count from the programmed height."""
    run = ran(f"{HEAD}G0 Z10.\nG91 Z-5.\nT2 M6\nG0 X9.\nZ-2.\nM30\n")
    assert run.stopped_at is None
    assert run.moves.points[-1].tolist() == [9.0, 0.0, 3.0]


@pytest.mark.parametrize("control", ["fanuc:a", "haas:b"])
def test_compensation_without_a_contour_is_a_stretch_of_its_own(control: str) -> None:
    """Each side of a slot in one move: by hand, each goes from Y0 to Y5, the second one on its way back."""
    slot = "G0 X0. Y0.\nG41 D1\nG1 X50. F100.\nG40\nG0 Z5.\nY0.\nG42 D1\nG1 X0.\nG40\nZ50.\nM30\n"
    run = ran(f"{HEAD}{slot}", control)
    assert [(stretch.side, stretch.programmed.lines.tolist()) for stretch in run.stretches] == [
        (Side.LEFT, [0, 4]),
        (Side.RIGHT, [0, 9]),
    ]
    assert [move.point[:2] for move in run.moves if move.line in (4, 9)] == [(50.0, 5.0), (0.0, 5.0)]


def test_an_arc_that_loses_crossing_vectors_runs_as_a_line() -> None:
    arcs = "X-3.3 Y-6.8\nG3 X.1 Y.4 R9.44\nG1 X1.8 Y-3.2\nG2 X2.7 Y-2.5 R2.72\nX-3. Y-5.5 R4.08\n"
    made = ran(f"{HEAD}G41 D1 X0 Y0\n{arcs}G40 G1 Y50.\nM30\n", radii={1: 2.0})
    assert [finding.line for finding in findings_of(made, "FN-VECTOR")]
    turns = {line: {move.turn for move in made.moves if move.line == line} for line in (4, 6, 7)}
    assert turns == {4: {1}, 6: {0}, 7: {0, -1}}
