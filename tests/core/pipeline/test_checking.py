"""NC programs checked on controls: their stops and the options that help."""

from __future__ import annotations

from math import cos, pi, sin, sqrt

import pytest

from core.controls.control_run import ControlRun
from core.controls.control_tools import CutterTool, table_of
from core.controls.judging.judged_runs import judge_run
from core.controls.registry import run
from core.pipeline.checking import (
    CheckRequest,
    answer,
    answer_all,
    answered,
    lines,
    reasons,
    same_contours,
    unreadable,
    with_largest_tool,
)
from core.progress import Stopped
from core.units import Unit, from_mm


def request_for(control: str, *tools: CutterTool) -> CheckRequest:
    return CheckRequest(control, table_of(*tools), shop=False, unit=None)


def test_a_missing_diameter_stops_the_run_and_names_the_option_that_gives_it() -> None:
    row = answer(b"G21 F100.\nG41 D3 G1 X10. Y0\nX20.\nM30\n", request_for("fanuc:a"))
    assert row.stopped_at == 2
    assert row.stop is not None
    assert row.stop.text.endswith("On the command line: --tool 3=DIAMETER.")
    assert row.stop in row.findings


def test_a_comparison_of_contours_says_which_program_stops_and_why() -> None:
    whole, stopped = b"G21 F9.\nG41 D1 G1 X9.\nX20.\nG40 X30.\nM30\n", b"G21 F9.\nG41 D2 G1 X9.\nX20.\nM30\n"
    same, sentences = same_contours(whole, stopped, request_for("fanuc:a", CutterTool(1, 5.0)))
    assert not same
    assert sentences[-1].startswith("The second program stops at line 2; what follows is not compared. ")
    assert sentences[-1].endswith("On the command line: --tool 2=DIAMETER.")


def test_a_gouge_of_several_passes_at_one_place_is_reported_once() -> None:
    """Each lap of the loop cuts into a wall at the approach."""
    lap = b"G0 X0. Y0.\nG41 D3 G1 X10. Y10.\nX40.\nY40.\nX10.\nY0.\nG40 X0.\n"
    loop = b"G21 F100.\n#1=0\nWHILE [#1 LT %d] DO1\n#1=#1+1\n" + lap + b"END1\nM30\n"
    once, twice = (answer(loop % times, request_for("fanuc:a", CutterTool(3, 10.0))) for times in (1, 2))
    assert (once.stretches, twice.stretches) == (1, 2)
    assert any(finding.code == "GOUGE" for finding in once.findings)
    assert twice.findings == once.findings


def test_similar_information_on_many_contours_is_reported_a_few_times() -> None:
    """Each of ten holes has an arc in and an arc out."""
    lead_in = b"G1 X%d. Y0\nG41 D3 X%d. Y-5.\nG3 X%d. Y0 R5.\n"
    hole = lead_in + b"I-10.\nX%d. Y5. R5.\nG40 G1 X%d. Y0\n"
    places = range(0, 400, 40)
    holes = b"".join(hole % (x, x + 5, x + 10, x + 5, x) for x in places)
    row = answer(b"G21 G90 F100.\n" + holes + b"M30\n", request_for("linuxcnc", CutterTool(3, 8.0)))
    leads = [(finding.line, finding.text) for finding in row.findings if finding.code == "LEADS"]
    assert [line for line, _ in leads] == [4, 10, 16, 22]
    assert leads[-1][1] == "LEADS: 7 more lines like these."


def test_gouges_that_are_not_listed_are_counted_for_each_contour() -> None:
    """The slots of two combs are narrower than the tool: each comb has more gouges than are listed."""
    teeth = b"".join(b"X%d.\nY%d.\n" % (10 * tooth, 20 if tooth % 2 else 0) for tooth in range(1, 60))
    comb = b"G0 X0. Y-20.\nG41 G1 X0. Y0.\n" + teeth + b"G40 Y-50.\n"
    row = answer(b"G71 G90 F100.\nT3 M6\n" + comb + comb + b"M30\n", request_for("threeblock", CutterTool(3, 12.0)))
    more = [finding.text for finding in row.findings if "more gouges" in finding.text]
    assert len(more) == row.stretches == 2


def test_a_canceled_search_for_the_largest_tool_stops() -> None:
    request = request_for("fanuc:a", CutterTool(1, 0.5))
    row, finished_run = answer(SLOT, request), run(SLOT, "fanuc:a", request.tools)
    assert isinstance(finished_run, ControlRun)
    assert row.fits is not None

    def canceled(_: float) -> None:
        raise Stopped

    with pytest.raises(Stopped):
        with_largest_tool(row, finished_run, SLOT, request, canceled)


def test_a_program_with_its_tool_runs_to_its_end() -> None:
    row = answer(b"G21 F100.\nG41 D3 G1 X10. Y0\nX20.\nG40 X30.\nM30\n", request_for("fanuc:a", CutterTool(3, 10.0)))
    assert (row.stopped_at, row.stop) == (None, None)


SLOT = (
    b"G20 G90 G40 F20.\nG0 X-1. Y-1.\nT1 M6\nG41 D1 G1 X0. Y0.\nY2.\nX.3\nY1.\nX.7\nY2.\n"
    b"X2.\nY0.\nX-.5\nG40 X-1. Y-1.\nM30\n"
)
"""A plate with a 0.4 wide slot that is open at the top."""

SLANTING = b"G21 G17 G90 G1 F100.\nX-20. Y0.\nG41 D1 X0.\nX50.\nM8\nM9\nY40.\nX20.\nG40 X0.\nM30\n"
"""Two lines without movement at a corner that some controls cannot look past: every tool gouges."""


@pytest.mark.parametrize("control", ["linuxcnc", "fanuc:a", "haas:a", "allen-bradley:a"])
def test_the_largest_tool_that_fits_is_named_if_the_tool_is_too_big(control: str) -> None:
    row = answer(SLOT, request_for(control, CutterTool(1, 0.5), CutterTool(2, 0.25)))
    (finding,) = (finding for finding in row.findings if finding.code == "TOOL_FITS")
    assert finding.text == "Tool 1 is too big; the largest that does not gouge: {0}."
    assert from_mm(finding.lengths[0], Unit.IN) == pytest.approx(0.4, abs=1.1e-4)
    assert answer(SLOT, request_for(control, CutterTool(1, 0.3999))).fits is None


def test_no_tiny_tool_is_named_for_shallow_gouges_at_nearly_tangent_joints() -> None:
    """LinuxCNC gouges the chords of a wavy disc, which turn by up to 0.05 rad, by a few micrometers."""
    turns = [2 * pi * row / 200 for row in range(201)]
    places = [((50 + 1.2 * sin(8 * turn)) * cos(turn), (50 + 1.2 * sin(8 * turn)) * sin(turn)) for turn in turns]
    chords = "".join(f"X{x:.4f} Y{y:.4f}\n" for x, y in places)
    text = f"G21 G90\nT1 M6\nG0 X80 Y-20\nG42 G1 X60 Y-8 F300\n{chords}G40 X80 Y20\nM2\n"
    row = answer(text.encode(), request_for("linuxcnc", CutterTool(1, 10.0)))
    assert row.gouge is not None
    assert 0.0 < row.gouge[0] < 0.01
    assert row.fits is None


def test_no_tool_is_named_if_smaller_tools_gouge_too() -> None:
    row = answer(SLANTING, request_for("fanuc:a", CutterTool(1, 10.0)))
    assert row.gouge is not None
    assert row.fits is None


LEADS = "G21 G90 F200.\nT1 M6\nG0 X{start} Y-20.\nG41 D1 G1 X0. Y0.\nY30.\nX40.\nY0.\nX0.\nG40 X{end} Y{y}\nM30\n"


@pytest.mark.parametrize(("start", "end", "y"), [("10.", "0.", "-20."), ("0.", "-20.", "-2.")])
def test_a_lead_that_alone_gouges_should_be_moved(start: str, end: str, y: str) -> None:
    row = answer(LEADS.format(start=start, end=end, y=y).encode(), request_for("linuxcnc", CutterTool(1, 10.0)))
    assert row.gouge is not None
    assert row.fits is not None
    assert row.fits.text.startswith("Only a lead-in or lead-out gouges: move its far end.")


def test_the_table_of_all_controls_names_the_largest_tool_for_each() -> None:
    every = list(reasons(answer_all(SLOT, request_for("all", CutterTool(1, 0.5)))))
    assert "fanuc:a: Tool 1 is too big; the largest that does not gouge: 0.4000." in every
    assert any(reason.startswith("fanuc:a and fanuc:b at line 8 (PS0041): ") for reason in every)


def test_the_largest_tool_is_named_for_a_program_without_a_unit() -> None:
    """Every control assumes inches."""
    without_unit, with_unit = SLOT.replace(b"G20 ", b""), SLOT
    silent_rows, rows = (answer_all(text, request_for("all", CutterTool(1, 0.5))) for text in (without_unit, with_unit))
    fitting = [[row.control for row in each if row.fits is not None] for each in (silent_rows, rows)]
    assert fitting[0] == fitting[1]
    assert fitting[1]


AROUND = b"G21 F9.\nT1 M6\nG0 X-20 Y-20\n%s D1 G1 X0 Y0\nY30.\nX40\nY0\nX0\nG40 X-20 Y-20\nM2\n"
KLARTEXT = b"0 BEGIN PGM A MM\n1 L X+1 F9\n2 END PGM A MM\n"


@pytest.mark.parametrize(
    ("control", "text", "outcome", "moves"),
    [
        ("linuxcnc", b"", "has nothing to run", 0),
        ("linuxcnc", b"G21\nM2\n", "moves nothing", 0),
        ("linuxcnc", b"G21 F9\nG1 X1\nM2\n", "runs", 1),
        ("fanuc:a", b"G21 F9.\nG1 X1.\n", "runs, 1 warning (END)", 1),
        (
            "fanuc:a",
            b"G21 F9.\nG41 D0 G1 X9.\nX20.\nG40 X30.\nM30\n",
            "runs, nothing compensated, 1 warning (FN-D0)",
            3,
        ),
        ("linuxcnc", b"G21 F9\nG33 X1\nM2\n", "cannot be followed past line 2 (BEYOND)", 0),
        ("linuxcnc", AROUND % b"G41", "runs, 1 warning (UNCUT)", 10),
        ("linuxcnc", AROUND % b"G42", "gouges by 10.000 at line 4, 1 warning (UNCUT)", 8),
        (
            "linuxcnc",
            (AROUND % b"G42").replace(b"X40", b"G17 G18 X40"),
            "gouges by 0.076 at line 4, then alarms at line 6 (N-TWOG)",
            3,
        ),
        ("linuxcnc", KLARTEXT, "alarms at line 1 (WORD), 1 warning (LANGUAGE)", 0),
        ("klartext", b"G21 F9.\nG1 X1.\nM30\n", "alarms at line 1 (WORD), 1 warning (LANGUAGE)", 0),
    ],
)
def test_the_outcome_says_the_worst_in_a_few_words(control: str, text: bytes, outcome: str, moves: int) -> None:
    row = answer(text, request_for(control, CutterTool(1, 10.0)))
    assert (row.outcome_and_warnings, row.move_count) == (outcome, moves)
    assert row.uncompensated is ("nothing compensated" in outcome)
    assert row.errors is any(word in outcome for word in ("nothing to run", "cannot", "gouges", "alarms"))


@pytest.mark.parametrize(
    ("control", "text", "tool"),
    [
        ("fanuc:a", b"G21 F100.\nG41 D3 G1 X10. Y0\nX20.\nM30\n", 3),
        ("linuxcnc", b"G21 F100\nT4 M6\nG1 X10\nM2\n", 4),
        ("linuxcnc", b"G21 F100\nG1 X10\nM2\n", None),
        ("linuxcnc", b"G21 F100\nG33 X10\nM2\n", None),
    ],
)
def test_nc_proof_names_its_key_for_a_missing_diameter(control: str, text: bytes, tool: int | None) -> None:
    done = run(text, control, {})
    assert isinstance(done, ControlRun)
    row = answered(done, judge_run(done), text, {})
    assert row.missing == tool
    assert row.stop_reason.endswith(f"T gives tool {tool} its diameter.") is (tool is not None)


ARC = b"G20\nF9.\nG0 X1.\nG3 X2. Y1. I0. J1.\n%sM30\n"


def test_the_machine_readable_answer_is_in_program_units() -> None:
    row = answer(ARC % b"G33 X9.\n", request_for("fanuc:a"))
    text = "cutcomp does not support G33. Write out the moves that it makes or changes."
    finding = {"rule": "BEYOND", "severity": "error", "line": 5, "column": 1, "text": text, "lengths": []}
    rapid: dict[str, object] = {"type": "line", "mode": "rapid", "y": 0.0, "z": 0.0, "feed": None}
    arc = {"type": "arc", "mode": "feed", "line": 4, "x": 2.0, "y": 1.0, "z": 0.0, "feed": 9.0}
    assert row.json() == {
        "control": "fanuc:a",
        "units": "IN",
        "state": "not_followed",
        "stopped_at": 5,
        "deepest_gouge": None,
        "parts_from": None,
        "stretches": 0,
        "moves": [
            {**rapid, "line": 0, "x": 0.0},
            {**rapid, "line": 3, "x": 1.0},
            {**arc, "cx": 1.0, "cy": 1.0, "cz": 0.0, "plane": "XY", "ccw": True},
        ],
        "findings": [finding],
    }
    assert list(lines(row)) == [
        f"      5:1  error    BEYOND         {text}",
        "fanuc:a: cannot be followed past line 5 (BEYOND); 2 moves, 0 compensated stretches, IN.",
    ]


def test_the_machine_readable_answer_has_the_deepest_gouge_and_its_line() -> None:
    row = answer(AROUND % b"G42", request_for("linuxcnc", CutterTool(1, 10.0)))
    assert row.json()["deepest_gouge"] == {"depth": pytest.approx(10.0), "line": 4}


def test_a_file_that_cannot_be_read_has_the_same_keys_as_an_answer() -> None:
    document, row = unreadable("a.nc", "It is empty."), answer(ARC % b"", request_for("linuxcnc")).json()
    assert set(document) == {"file", *row}
    assert document["findings"] == [
        {"rule": "UNREADABLE", "severity": "error", "line": None, "column": None, "text": "It is empty.", "lengths": []}
    ]


def test_a_path_that_leaves_that_of_the_reference_says_from_where_and_how_far() -> None:
    """At the square corner Klartext makes an arc of radius 5; its middle is farthest from the offset lines."""
    text = b"G21 F9.\nG0 X-20. Y-10.\nG41 D1 G1 X0. Y0.\nY30.\nX40.\nG40 X60. Y50.\nM30\n"
    rows = answer_all(text, request_for("all", CutterTool(1, 10.0)), "haas:a")
    row = next(row for row in rows if row.control == "klartext")
    assert row.comparison == "its contour only; differs from haas:a from line 4, by 1.464 at line 4"
    distance = pytest.approx(5 * (1 - sqrt(0.5)))
    assert row.json()["parts_from"] == {"control": "haas:a", "line": 4, "farthest_line": 4, "distance": distance}
    assert row.findings[0].code == "LANGUAGE"


def test_a_program_without_a_contour_is_not_compared_with_another_language() -> None:
    (row,) = [row for row in answer_all(b"G21 F9.\nG1 X1.\nM30\n", request_for("all")) if row.control == "klartext"]
    assert (row.outcome, row.move_count, row.errors) == ("reads another language", 0, False)
    assert row.comparison.startswith("not compared: ")


FIRST = b"G21 F9.\nG41 D1 G1 X9.\nX20.\nY40.\nG40 X30.\nM30\n"


@pytest.mark.parametrize(
    ("second", "sentences"),
    [
        (FIRST, ["Contour 1: the same."]),
        (FIRST.replace(b"Y40", b"Y41"), ["Contour 1: line 4 of the second is 1.000 MM off."]),
        (FIRST.replace(b"G41", b"G42"), ["Contour 1: the sides or planes differ."]),
        (
            FIRST.replace(b"M30", b"G41 X60.\nX70.\nG40 X90.\nM30"),
            ["Contour 1: the same.", "The first program has 1 contour, the second 2."],
        ),
        (b"G21 F9.\nG1 X1.\nM30\n", ["The first program has 1 contour, the second 0."]),
    ],
)
def test_two_programs_are_compared_contour_by_contour(second: bytes, sentences: list[str]) -> None:
    same, found = same_contours(FIRST, second, request_for("fanuc:a", CutterTool(1, 5.0)))
    assert (same, list(found)) == (second == FIRST, sentences)


def test_programs_without_contours_are_not_the_same() -> None:
    text = b"G21 F9.\nG1 X1.\nM30\n"
    assert same_contours(text, KLARTEXT, request_for("all")) == (False, ("Neither program has a compensated contour.",))


@pytest.mark.parametrize(("condition", "runs"), [("#1 LT 10.", True), ("#1 GT 10.", False)])
def test_compensation_in_a_loop_that_is_never_run_is_a_warning(condition: str, runs: bool) -> None:
    """The relation is the wrong way around: the control runs no pass, and there is nothing to judge."""
    loop = f"WHILE [{condition}] DO1\n#1=#1+5.\nG41 D1 G1 X10. Y0\nX30.\nG40 Y20.\nEND1\n"
    program = f"G21 G17 G90 F100.\n(G41 IS BELOW)\n#1=0\nG0 Y-20.\n{loop}G0 Z50.\nM30\n"
    row = answer(program.encode(), request_for("fanuc:a", CutterTool(1, 10.0)))
    idle = [finding for finding in row.findings if finding.code == "NOT_RUN"]
    assert row.stopped_at is None
    assert [finding.line for finding in idle] == ([] if runs else [7])


@pytest.mark.parametrize("control", ["fanuc:a", "nine-series:a", "linuxcnc"])
def test_compensation_in_a_subprogram_that_nothing_calls_is_one_warning(control: str) -> None:
    text = b"G21 G17 G90 G40\nT1 M6\nG0 X20. Y20.\nM30\nO2\nG1 F300.\nG41 D1 X30.\nG3 I-10.\nG40 G1 X20.\nM99\n"
    row = answer(text, request_for(control, CutterTool(1, 10.0)))
    assert [finding.line for finding in row.findings if finding.code == "NOT_RUN"] == [5]


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ("G0 X5.\n%\n{}GOTO 9\n{}N9 M30\n%\n", [1, 8]),
        ("{}M98 P3\nM30\nO2\nG0 Z5.\nM99\nO3\nG0 Z9.\nGOTO 9\n{}N9 M99\n", [6, 13]),
        ("{}M30\nO2\nG0 Z5.\nM99\nO3\nG0 Z9.\n{}M99\n", [5]),
    ],
)
def test_compensation_is_not_taken_for_other_lines_that_are_not_run(text: str, lines: list[int]) -> None:
    contour = "G1 F300.\nG41 D1 X30.\nG3 I-10.\nG40 G1 X20.\n"
    program = text.format("G21 G17 G90 G40\nT1 M6\nG0 X20. Y20.\n", contour)
    row = answer(program.encode(), request_for("fanuc:a", CutterTool(1, 10.0)))
    assert sorted(finding.line or 0 for finding in row.findings if finding.code == "NOT_RUN") == lines


@pytest.mark.parametrize(("contour", "lines"), [("", [5]), ("Y40.\n", []), ("Z-6.\n", [5])])
@pytest.mark.parametrize("control", ["fanuc:a", "haas:a", "nine-series:a", "linuxcnc"])
def test_compensation_without_a_contour_is_a_warning(control: str, contour: str, lines: list[int]) -> None:
    """The wall of a slot in one move: it begins on the programmed line and ends a radius beside it."""
    text = f"G21 G17 G90 G40\nT1 M6\nG0 X0. Y0. Z5.\nG1 Z-5. F100.\nG41 D1 X50.\n{contour}G40\nG0 Z5.\nX0.\nM30\n"
    row = answer(text.encode(), request_for(control, CutterTool(1, 10.0)))
    assert row.stopped_at is None, row.findings
    assert [finding.line for finding in row.findings if finding.code == "NO-CONTOUR"] == lines
    beside, *_ = answer_all(text.encode(), request_for("all", CutterTool(1, 10.0)), control)
    assert beside.findings == row.findings


def test_klartext_compensation_that_is_jumped_over_is_a_warning() -> None:
    text = "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nL X+0 Y-30 R0 FMAX\n{}L X+0 Y+0 RL F100\nL Y+40\nL X+40 R0\nLBL 1\n"
    text += "L Z+50 R0 FMAX\nEND PGM A MM\n"
    for jump, count in (("FN 9: IF +1 EQU +1 GOTO LBL 1\n", 1), ("", 0)):
        row = answer(text.format(jump).encode(), request_for("heidenhain", CutterTool(1, 10.0)))
        assert row.stopped_at is None, row.findings
        assert [finding.code for finding in row.findings].count("NOT_RUN") == count
