"""The LinuxCNC control against the rs274 interpreter and against hand calculations."""

from __future__ import annotations

from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

from core.controls import registry
from core.controls.compensation.element_queue import ARC_RUN_AT_STOP
from core.controls.control_tools import read_table
from core.controls.moves import Plane
from core.finding import Severity
from core.units import Unit, from_mm
from tests.core.controls.compare_rs274 import outcome, programs, sample_outcome
from tests.core.controls.compensated_codes import CODES, EXPLAINED, FRAMES, PROGRAMS
from tests.core.controls.distribution import COMPENSATED, LIBRARY, SAMPLES, called, sample
from tests.core.controls.hand import findings_of, run_of, run_until_given_up, same, shape
from tests.core.controls.macro_programs import whole
from tests.core.controls.programs import MODAL, stopped
from tests.core.controls.rs274 import difference, printed, run_witness, witness
from tests.rs274 import WITNESS

needs_witness = pytest.mark.skipif(WITNESS is None, reason="LinuxCNC's rs274 is not installed")

DIAMETERS = {1: 0.5, 2: 0.25}


@needs_witness
def test_random_programs_match_the_interpreter(tmp_path: Path) -> None:
    results = {name: outcome(text, tmp_path) for name, text in programs(180)}
    wrong = {
        name: result for name, result in results.items() if not result[0].startswith(("same moves", "both refuse"))
    }
    assert not wrong
    assert sum(result[0] == "same moves" for result in results.values()) >= 100


@needs_witness
@pytest.mark.skipif(not SAMPLES.is_dir(), reason="LinuxCNC's sample programs are not installed")
@pytest.mark.parametrize("name", [name for name, why in COMPENSATED.items() if not why])
def test_the_sample_programs_of_linuxcnc_match_the_interpreter(name: str, tmp_path: Path) -> None:
    result, apart = sample_outcome(sample(name), tmp_path)
    assert result.startswith(("same moves", "both refuse")), apart


@needs_witness
@pytest.mark.skipif(not SAMPLES.is_dir(), reason="LinuxCNC's sample programs are not installed")
@pytest.mark.parametrize("name", LIBRARY)
def test_the_subprogram_library_of_linuxcnc_matches_the_interpreter(name: str, tmp_path: Path) -> None:
    result, apart = sample_outcome(called(name), tmp_path)
    assert result.startswith(("same moves", "both refuse")), apart


@needs_witness
@pytest.mark.parametrize("head", ["T1 M6\n", "T2 M6\n", "", "T1 M6\nT2\n"])
def test_d0_selects_the_tool_in_the_spindle(head: str, tmp_path: Path) -> None:
    text = f"G20 F9\n{head}G0 X-1 Y-1\nG1 G41 D0 X0 Y-.6\nY2\nX2\nY-1\nG40 X4\nM2\n"
    assert outcome(text, tmp_path, DIAMETERS, Unit.IN) == ("same moves", "")
    if head:
        run = run_of(text, "linuxcnc", t1=0.5, t2=0.25)
        assert not findings_of(run, "RADIUS0")
        assert run.stretches[0].radius == 25.4 * (0.125 if "T2 M6" in head else 0.25)


LATHE = """G20 G18 F30
T{tool} M6
G0 X.3 Z0
G41
G1 X.1
G3 X0 Z.1 R.1
G1 Z1
G2 R.25 X-.25 Z1.25
G1 Z1.75
G40
G0 X.3
M2
"""


@needs_witness
@pytest.mark.parametrize("orientation", range(10))
def test_the_orientation_of_a_lathe_tool_shifts_its_moves(orientation: int, tmp_path: Path) -> None:
    text, table = tmp_path / "p.ngc", tmp_path / "t.tbl"
    text.write_text(LATHE.format(tool=1))
    table.write_text(f"T1 P1 D.1 Z0 Q{orientation}\n")
    theirs = run_witness(text, table)
    tools, _ = read_table(table.read_bytes())
    ours = registry.run(text.read_bytes(), "linuxcnc", tools)
    assert not theirs.refusal
    assert not difference(printed(ours), theirs.moves)


def test_l_next_to_g41_1_is_the_orientation_of_the_lathe_tool() -> None:
    """Radius 1, orientation 3: the controlled point is one radius behind the nose's center in Z, and above it in X."""
    run = run_of("G21 G18 F9\nG41.1 D2 L3\nG1 Z5\nZ9\nG40\nM2\n", "linuxcnc")
    assert [(move.point[0], move.point[2]) for move in run.moves if move.line] == [(2.0, 4.0), (2.0, 8.0)]


@needs_witness
@pytest.mark.parametrize("name", MODAL)
def test_modal_programs_match_the_interpreter(name: str, tmp_path: Path) -> None:
    theirs = witness(MODAL[name], tmp_path, DIAMETERS, Unit.IN)
    ours = run_of(MODAL[name], "linuxcnc", t1=0.5, t2=0.25)
    assert not theirs.refusal
    assert ours.stopped_at is None
    assert not difference(printed(ours), theirs.moves)


@needs_witness
@pytest.mark.parametrize("frame", ["between compensated moves", "with its end"])  # the others are in compare_rs274
def test_every_code_near_compensation_matches_the_interpreter(frame: str, tmp_path: Path) -> None:
    results = {code: outcome(FRAMES[frame].format(code), tmp_path, DIAMETERS, Unit.IN) for code in CODES}
    assert not {
        code: result for code, result in results.items() if not result[0].startswith(("same moves", "both refuse"))
    }


@needs_witness
@pytest.mark.parametrize("name", PROGRAMS)
def test_stops_tool_data_and_shifts_match_the_interpreter(name: str, tmp_path: Path) -> None:
    result, apart = outcome(whole(PROGRAMS[name]), tmp_path, DIAMETERS, Unit.IN)
    assert result.startswith("same moves" if name != _REFUSED_BY_BOTH else "both refuse"), apart


@needs_witness
def test_random_stops_match_the_interpreter_or_are_refused(tmp_path: Path) -> None:
    results = {seed: outcome(stopped(seed), tmp_path) for seed in range(40)}
    accepted = ("same moves", "both refuse")
    assert not {
        seed: result
        for seed, result in results.items()
        if not result[0].startswith(accepted) and result[1] != ARC_RUN_AT_STOP
    }
    assert sum(result[0] == "same moves" for result in results.values()) >= 16


_REFUSED_BY_BOTH = "a stop before a tangent move that is too short"


@needs_witness
@pytest.mark.parametrize("code", EXPLAINED)
def test_every_explained_difference_exists(code: str, tmp_path: Path) -> None:
    before, _ = outcome(FRAMES["before the entry"].format(code), tmp_path, DIAMETERS, Unit.IN)
    after, _ = outcome(FRAMES["after compensation"].format(code), tmp_path, DIAMETERS, Unit.IN)
    assert before.startswith("only") or after.startswith("only")


WORK_OFFSETS = ("G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3")


@pytest.mark.parametrize(
    ("code", "rule"),
    [
        *(("M6", "N-TOOL"), ("G49", "N-LENGTH"), ("M48", "N-OVERRIDE"), ("M62 P0", "N-OUTPUT")),
        *((code, "N-OFFSETS") for code in WORK_OFFSETS),
    ],
)
def test_a_code_refused_under_compensation_names_its_rule_and_g40(code: str, rule: str) -> None:
    run = run_of(FRAMES["between compensated moves"].format(code), "linuxcnc", t1=0.5)
    (finding,) = findings_of(run, rule)
    assert (finding.line, run.stopped_at) == (7, 7)
    assert "G40" in finding.text


def test_a_shift_that_compensation_ignores_is_a_warning() -> None:
    assert findings_of(run_of(FRAMES["between compensated moves"].format("G92.1"), "linuxcnc", t1=0.5), "N-OFFSETS")


def test_m61_sets_the_tool_whose_radius_counts_without_d() -> None:
    """The stand-alone interpreter has no spindle and keeps the previous tool; the manual says that M61 sets it."""
    run = run_of("G20 F9\nT1 M6\nM61 Q2\nG41\nG1 X1\nX3\nG40\nX4\nM2\n", "linuxcnc", t1=0.5, t2=0.25)
    assert same(shape(run)[:1], [("line", 1, 0.125)])


@pytest.mark.parametrize(("line", "rule"), [("M61", "N-WORDALONE"), ("M61 Q-1", "N-WORDALONE"), ("M61 Q9", "TOOL")])
def test_m61_without_a_tool_of_the_table_is_refused(line: str, rule: str) -> None:
    assert [finding.line for finding in findings_of(run_of(f"G20 F9\n{line}\nM2\n", "linuxcnc", t1=0.5), rule)] == [2]


def test_an_m_code_of_the_machine_is_reported() -> None:
    assert findings_of(run_of("G20 F9\nM101\nG1 X1\nM2\n", "linuxcnc"), "M")


REFUSED = {
    "no feed": "G20\nG1 X1\nM2\n",
    "no motion": "G20 F9\nX1\nM2\n",
    "an arc that does not reach": "G20 F9\nG2 X5 R1\nM2\n",
    "radii that differ": "G20 F9\nG2 X2 I1.5\nM2\n",
    "a center outside the plane": "G20 F9\nG2 X2 K1\nM2\n",
    "an arc without center": "G20 F9\nG2 X2\nM2\n",
    "a radius and a center": "G20 F9\nG2 X2 R1 I1\nM2\n",
    "a full circle by radius": "G20 F9\nG2 X0 Y0 R1\nM2\n",
    "an unknown code": "G20 F9\nG77 X1\nM2\n",
    "a tool that is not there": "G20 F9\nT8 M6\nM2\n",
    "a missing subprogram": "G20 F9\nM98 P44\nM2\n",
    "a dwell without time": "G20 F9\nG4\nG1 X1\nM2\n",
    "an unknown M code": "G20 F9\nG1 X1 M984\nM2\n",
    "a comment in a comment": "G20 F9\nG1 X1 ((two)\nM2\n",
    "a digit parted by a comment": "G20 F9\nG1 X1 (and)0\nM2\n",
    "two codes that take axis words": "G20 F9\nG92 G1 X5\nM2\n",
    "a call that does not stand alone": "G20 F9\nG90 M98 P1\nM2\nO1\nM99\n",
    "an arc alone": "G20 F9\nG2\nM2\n",
    "words without their code": "G20 F9\nG1 X1 P2\nM2\n",
    "axis words with g80": "G20 F9\nG0 X1\nG80 X2\nM2\n",
    "axis words after g80": "G20 F9\nG0 X1\nG80\nX2\nM2\n",
    "two motions next to g80": "G20 F9\nG0 G80 G1 X5\nM2\n",
    "no end": "G20 F9\nG1 X1\n\n",
}


@needs_witness
@pytest.mark.parametrize("name", REFUSED)
def test_a_program_that_the_interpreter_refuses_is_refused_or_reported(name: str, tmp_path: Path) -> None:
    assert witness(REFUSED[name], tmp_path, DIAMETERS, Unit.IN).refusal
    ours = run_of(REFUSED[name], "linuxcnc", t1=0.5)
    assert ours.stopped_at is not None or findings_of(ours, "END")


M_GROUPS = (("M0", "M30", "M60"), ("M3", "M5", "M19"), ("M7", "M8", "M9"), ("M48", "M53"), ("M62 P1",))
M_PAIRS = [
    *(pair for group in M_GROUPS for pair in combinations(group, 2)),
    *combinations((group[0] for group in M_GROUPS), 2),
]
"""All pairs within a group, and one pair of every two groups."""


@needs_witness
def test_m_codes_of_one_group_match_the_interpreter(tmp_path: Path) -> None:
    blocks = [f"{first} {second}" for first, second in M_PAIRS] + ["M3 M8 M48 M62 P1", "M3 M8 M48 M62 P1 M0"]
    blocks += ["F-3", "S-5", "G4 P-1", "N-1"]
    refused = 0
    for block in blocks:
        text = f"G20 F9 S100\nG0 X-1 Y-1\n{block}\nM2\n"
        result = outcome(text, tmp_path, DIAMETERS, Unit.IN)[0]
        assert result.startswith(("same moves", "both refuse")), block
        refused += result.startswith("both refuse")
    assert 10 < refused < len(blocks) - 10


@needs_witness
@pytest.mark.parametrize("start", [0.49998, 0.50002, 0.5004])
@pytest.mark.parametrize("end", [0.49998, 0.499998, 0.5004])
def test_the_radius_at_the_end_of_an_arc_must_be_larger_than_the_tool(start: float, end: float, tmp_path: Path) -> None:
    text = f"G20 F9\nT1 M6\nG0 X0 Y0\nG1 G42 D1 X1\nX2\nG2 X{2 + end:.6f} Y{-start:.6f} I0 J{-start:.6f}\n"
    result = outcome(f"{text}G1 Y-3\nG40 X5 Y-5\nM2\n", tmp_path, {1: 1.0}, Unit.IN)[0]
    if result.startswith(("same moves", "both refuse")):
        return
    # only cutcomp refuses an arc that starts inside the radius of the tool
    assert start < 0.5 < end


def test_entry_corner_and_exit_match_a_hand_calculation() -> None:
    run = run_of("G20 F9\nG41 D1\nG1 X1 Y0\nX2 Y0\nX2 Y1\nG40\nX5 Y5\nM2\n", "linuxcnc", t1=0.5)
    wanted = [("line", 1, 0.25), ("line", 1.75, 0.25), ("line", 1.75, 1), ("line", 5, 5)]
    assert same(shape(run), wanted)


def test_the_unit_may_change_under_compensation() -> None:
    run = run_of("G20 F9\nG41 D1\nG1 X2\nX4\nG21\nX152.4\nG40\nG1 Y25.4\nM2\n", "linuxcnc", t1=0.5)
    assert same(shape(run), [("line", 2, 0.25), ("line", 4, 0.25), ("line", 6, 0.25), ("line", 6, 1)])


def test_recursive_subprograms_are_stopped() -> None:
    run = run_of("G20 F9\nM98 P1\nM2\nO1\nG1 X1\nM98 P2\nM99\nO2\nM98 P1\nM99\n", "linuxcnc")
    assert run.stopped_at == findings_of(run, "SUBPROGRAM")[0].line == 9


def test_endless_repeats_are_stopped() -> None:
    text = "G20 F9\nM98 P1 L9999999\nM2\nO1\nS1\nM99\n"
    assert findings_of(run_until_given_up(text, 20_000), "LIMIT")


@pytest.mark.timeout(10)
def test_thousands_of_subprograms_before_the_program_are_passed_quickly() -> None:
    subprograms = "".join(f"o{number} sub\no{number} endsub\n" for number in range(7000))
    assert run_of(f"{subprograms}G21 F9\nG1 X1\nM2\n", "linuxcnc").stopped_at is None


def test_a_feed_before_g20_is_in_the_unit_in_force_before() -> None:
    run = run_of("G20 F20\nG1 X1\nF20\nG1 X2\nM2\n", "linuxcnc")
    assert [from_mm(move.feed, Unit.IN) for move in list(run.moves)[1:]] == pytest.approx([20 / 25.4, 20])


def test_a_stretch_knows_its_programmed_contour() -> None:
    run = run_of("G20 F9\nG0 X0 Y-1\nG42 D1\nG1 Y0\nX4\nY4\nG40\nX9\nM2\n", "linuxcnc", t1=0.5)
    (stretch,) = run.stretches
    assert (stretch.plane, stretch.entry, stretch.exit) == (Plane.XY, 1, 0)
    points = [(0, -1, 0), (0, 0, 0), (4, 0, 0), (4, 4, 0)]
    assert np.allclose(stretch.programmed.points / 25.4, points)
    assert [int(line) for line in stretch.programmed.lines] == [0, 4, 5, 6]


@needs_witness
@pytest.mark.parametrize(
    ("line", "runs"),
    [
        ("N5 X1", True),
        ("/N5 X1", True),
        ("N5.5 X1", True),
        ("X1 N5", False),
        ("X[1+2] N5", False),
        ("N80. X1", False),
        ("N80 0.", False),
        ("N-5 X1", False),
        ("N1 N5 X1", False),
        ("#1=5 N10", False),
        ("N10. X[1+1]", False),
        ("N10. #1=2", False),
        ("X1\x01", False),
        (f"o1 if [1 EQ 1] ({'x' * 240})\nX1\no1 endif", False),
        ("X1\x0cY2", False),
        (f"({'a' * 250})", True),
        (f"({'a' * 252})", False),
    ],
)
def test_a_line_that_the_interpreter_cannot_read_is_refused(line: str, runs: bool, tmp_path: Path) -> None:
    text = f"G21 G0\n{line}\nM2\n"
    result, apart = outcome(text, tmp_path)
    assert result.startswith("same moves" if runs else "both refuse"), apart


@pytest.mark.parametrize("start", [b"\xef\xbb\xbf", b"\xff\xfe", b"\xfe\xff"])
def test_a_byte_order_mark_stops_the_run(start: bytes) -> None:
    """rs274 says: Bad character '\\357' used. Other controls are not tested."""
    refused = registry.run(start + b"G21 G0 X1\nM2\n", "linuxcnc")
    assert (refused.stopped_at, [finding.code for finding in refused.findings]) == (1, ["WORD"])


def test_the_length_of_a_latin_1_comment_is_counted_in_bytes() -> None:
    text = "(" + "\N{LATIN SMALL LETTER A WITH DIAERESIS}" * 200 + ")\nG21 G0 X1\nM2\n"
    assert run_of(text.encode("latin-1"), "linuxcnc").stopped_at is None


def test_the_error_of_a_misplaced_n_has_its_column() -> None:
    (error,) = [
        finding for finding in run_of("G21 G0\nX1 N5\nM2\n", "linuxcnc").findings if finding.severity is Severity.ERROR
    ]
    assert (error.line, error.column) == (2, 4)


@needs_witness
def test_a_move_as_short_as_a_rounding_error_is_a_move(tmp_path: Path) -> None:
    """X0.3 and X[0.1+0.2] differ by 5.6e-17, and LinuxCNC goes around that corner."""
    text = "G20 G90 G17 F100\nT1 M6\nG0 X-30 Y-10\nG41 D1 G1 X0.3 Y-10\nY40\nX[0.1+0.2]\nX-40\nG40 Y0\nM2\n"
    assert outcome(text, tmp_path, {1: 6.0}, Unit.IN) == ("same moves", "")


def test_line_ends_of_cr_only_are_refused() -> None:
    assert run_of(b"G21 G0 X1\rY2\nM2\n", "linuxcnc").stopped_at == 1
    assert run_of(b"G21 G0 X1\r\nY2\r\nM2\r\n", "linuxcnc").stopped_at is None


@pytest.mark.parametrize("word", ["@50 ^180", "@[20+30] ^180", "^#1"])
def test_polar_coordinates_are_not_followed(word: str) -> None:
    (finding,) = findings_of(run_of(f"G21 G90\nG1 {word} F300\nM2\n", "linuxcnc"), "BEYOND")
    assert (finding.line, finding.column) == (2, 4)


BORE_WITH_TURNS = (
    "G21 G17 G90 G40\nF300\nG0 X0 Y0 Z1\nG41.1 D6 G1 X5 Y-5\nG3 X10 Y0 R5\n{}G3 X5 Y5 R5\nG40 G1 X0 Y0\n"
    "G2 X4 Y0 I2 P2\nG93 G2 X8 Y0 I2 P3 F2\nM2\n"
)


def test_p_of_an_arc_is_its_number_of_turns() -> None:
    """By hand: four turns from Z1 to Z-3 go down 1 mm each; a half turn and two turns on R2 are 10 pi, at F2 20 pi."""
    run = run_of(BORE_WITH_TURNS.format("G3 I-10 Z-3 P4\n"), "linuxcnc")
    single = run_of(BORE_WITH_TURNS.format("".join(f"G3 I-10 Z{z}\n" for z in (0, -1, -2, -3))), "linuxcnc")
    assert run.stopped_at is None
    assert run.moves.points == pytest.approx(single.moves.points)
    assert run.moves.turns.tolist() == single.moves.turns.tolist()
    assert run.moves.points[-2:].tolist() == [[4.0, 0.0, -3.0], [8.0, 0.0, -3.0]]
    assert run.moves.turns[-6:].tolist() == [0, -1, -1, -1, -1, -1]
    assert run.moves.feeds[-1] == pytest.approx(20.0 * np.pi)


@needs_witness
def test_turns_match_the_interpreter(tmp_path: Path) -> None:
    text = BORE_WITH_TURNS.format("G3 I-10 Z-3 P4\n")
    theirs = witness(text, tmp_path, {}, Unit.MM).moves
    ours = list(printed(run_of(text, "linuxcnc")))
    for move in theirs:
        turns = max(abs(move.turn), 1)
        assert {one.turn for one in ours[:turns]} == {move.turn // turns}
        assert ours[turns - 1].end == pytest.approx(move.end, abs=move.digit or 1e-3)
        del ours[:turns]
    assert not ours


@needs_witness
@pytest.mark.parametrize("turns", ["0", "1.5", "-1", "2000"])
def test_turns_that_are_no_whole_number_are_refused(turns: str, tmp_path: Path) -> None:
    text = f"G21 F300\nG0 X0 Y0\nG2 X4 I2 P{turns}\nM2\n"
    (alarm,) = findings_of(run_of(text, "linuxcnc"), "ARC")
    assert (alarm.severity, alarm.line, alarm.column) == (Severity.ERROR, 3, 10)
    # cutcomp alone has an upper limit
    assert bool(witness(text, tmp_path, {}, Unit.MM).refusal) == (turns != "2000")


@needs_witness
def test_an_entry_arc_whose_chord_is_tangent_at_its_end_is_refused(tmp_path: Path) -> None:
    """No circle runs from such a start to the offset end with the programmed tangent there."""
    program = "G21 G90 G17 F100\nG0 X.866025 Y.5\nG41 D1 G3 X0 Y1 I-.866025 J-.5\nG1 X-5\nG40 G1 X-5 Y-5\nM2\n"
    made = run_of(program, "linuxcnc", t1=1.0)
    assert (made.stopped_at, made.findings[-1].code) == (3, "N-ARCRADIUS")
    assert witness(program, tmp_path, {1: 1.0}, Unit.MM).refusal == "Tool radius not less than arc radius with comp"
