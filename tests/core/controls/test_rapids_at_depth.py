"""Rapids without compensation at the depth of a cut: through a contour they are told, beside it and above it not."""

from __future__ import annotations

import pytest

from core.controls.judged_runs import judge_run, judged_findings
from core.finding import Finding, Severity
from core.units import Unit, sentence
from tests.core.controls.hand import ran

CONTROLS = ["fanuc:a", "haas:a", "linuxcnc", "rosettacnc:normal"]
BORE = "G21 G17 G90 G40\nT1 M6\nG0 X20. Y20.\nZ5.\nG1 Z-5. F300\nG41 D1 X30.\nG3 I-10.\nG40 G1 X20.\n"
"""A hole of 20 mm about X20 Y20, by a tool of 10 mm."""


def rapids(program: str, control: str = "fanuc:a") -> list[Finding]:
    """What is told of rapids at depth."""
    run = ran(program, control, t1=10.0)
    assert run.stopped_at is None, run.findings
    return [finding for finding in judged_findings(judge_run(run)) if finding.code == "RAPID"]


@pytest.mark.parametrize("control", CONTROLS)
def test_a_forgotten_retract_is_a_warning_with_its_line(control: str) -> None:
    (told,) = rapids(f"{BORE}G0 X70.\nZ50.\nM30\n", control)
    assert (told.line, told.severity) == (9, Severity.WARNING)
    assert sentence(told, Unit.MM) == (
        "This rapid at Z -5.000 cuts the contour of line 7 at X 30.000 Y 20.000. Raise the tool before it."
    )


@pytest.mark.parametrize(
    ("behind", "count"),
    [
        ("G0 Z5.\nX70.\n", 0),
        ("G0 Z-4.9\nX70.\n", 0),
        ("G0 Z-8.\nX70.\n", 1),
        ("G0 X70. Z5.\n", 0),
        ("G1 X70.\n", 0),
        ("G0 X24.\nX16.\n", 0),
        ("G0 X26.\nX20.\n", 1),
        ("G0 X70.\nX20.\n", 2),
    ],
)
def test_only_rapids_no_higher_than_the_cut_are_told_and_only_where_they_cut(behind: str, count: int) -> None:
    told = rapids(f"{BORE}{behind}G0 Z50.\nM30\n")
    assert len(told) == count
    if "X26." in behind:
        assert told[0].value == pytest.approx(1.0)  # by hand: 6 from the middle and 5 of the tool reach 11 of 10


def test_a_rapid_before_the_cut_and_one_on_the_way_to_the_next_are_told() -> None:
    before = BORE.replace("Z5.\nG1 Z-5. F300\n", "Z-5.\nX70.\nX20.\nF300\n")
    assert [finding.line for finding in rapids(f"{before}G0 Z5.\nM30\n")] == [5, 6]
    after = "G0 X70.\nG41 D1 G1 X80.\nG3 I-10.\nG40 G1 X70.\nG0 Z5.\nM30\n"
    assert [finding.line for finding in rapids(BORE + after)] == [9]


@pytest.mark.parametrize(("begin", "count"), [("2.", 0), ("-1.", 1)])
def test_a_helix_that_begins_in_the_air_cuts_nothing_there(begin: str, count: int) -> None:
    """The rapid to the middle is higher than the part, or the same height below its top."""
    helix = f"G41 D1 X30.\nG3 I-10. Z-5.\nG3 I-10.\nG40 G1 X20.\nG0 Z{begin}\nX70.\n"
    text = f"G21 G17 G90 G40\nT1 M6\nG0 X20. Y20.\nZ5.\nZ{begin}\nG1 F300\n{helix}Z50.\nM30\n"
    assert len(rapids(text)) == count


@pytest.mark.parametrize(("height", "lines"), [("-5.", [8]), ("-6.", [8]), ("5.", [])])
def test_a_rapid_along_a_wall_at_depth_is_told(height: str, lines: list[int]) -> None:
    wall = f"G41 D1 X-20. Y0.\nX0.\nG0 Z{height} X60.\nG1 Z-5. X100.\nG40 Y20.\nG0 Z50.\nM30\n"
    text = f"G21 G17 G90 G40\nT1 M6\nG0 X-30. Y10.\nZ5.\nG1 Z-5. F300\n{wall}"
    told = rapids(text)
    assert [finding.line for finding in told] == lines
    assert all("under compensation" in finding.text for finding in told)


@pytest.mark.parametrize(
    ("behind", "lines"),
    [("G1 X70.\n", [9]), ("G1 X24.\nX70.\n", [10]), ("G1 Z-4.\nX70.\n", []), ("G0 Z5.\nG1 Z-5.\nX70.\n", []), ("", [])],
)
def test_a_feed_move_that_goes_on_from_the_contour_through_its_wall_is_told(behind: str, lines: list[int]) -> None:
    run = ran(f"{BORE}{behind}G0 Z50.\nM30\n", "fanuc:a", t1=10.0)
    told = [finding for finding in judged_findings(judge_run(run)) if finding.code == "FEED"]
    assert [finding.line for finding in told] == lines
    assert all(finding.severity is Severity.WARNING for finding in told)


def test_the_highest_pass_counts() -> None:
    deeper = "G1 Z-10.\nG41 D1 X30.\nG3 I-10.\nG40 G1 X20.\n"
    assert [finding.line for finding in rapids(f"{BORE}{deeper}G0 Z-7.\nX70.\nZ5.\nM30\n")] == [14]


def test_klartext_rapids_are_told_too() -> None:
    program = (
        "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nL X+20 Y+20 Z+5 R0 FMAX\nL Z-5 F300\nL X+30 RL\nCC X+20 Y+20\n"
        "C X+30 Y+20 DR+\nL X+20 R0\nL X+70 FMAX\nL Z+50 FMAX\nEND PGM A MM\n"
    )
    assert [finding.line for finding in rapids(program, "heidenhain")] == [9]


@pytest.mark.parametrize("home", ["G91 G28 Z0.\nG90\n", "G53 G0 Z0.\n", "G91 G28 X0. Y0. Z0.\nG90\n"])
@pytest.mark.parametrize("control", ["fanuc:a", "haas:a"])
def test_behind_a_move_to_the_machines_point_nothing_is_at_the_old_depth(home: str, control: str) -> None:
    assert not rapids(f"{BORE}{home}G0 X70.\nX20.\nG43 H1 Z5.\nX70.\nM30\n", control)
    assert [one.line for one in rapids(f"{BORE}{home}G0 X0. Y20.\nZ-5.\nX70.\nZ5.\nM30\n", control)] == [
        11 + home.count("\n")
    ]


@pytest.mark.parametrize("home", ["G91 G28 X0. Y0.\nG90\n", "G53 G0 X0. Y0.\n"])
def test_a_rapid_that_ends_in_a_wall_is_told_wherever_it_begins(home: str) -> None:
    """Only X and Y are at the machine's point: the tool is as deep as before, and its end is known."""
    assert [one.line for one in rapids(f"{BORE}{home}G0 X28. Y20.\nZ5.\nM30\n")] == [9 + home.count("\n")]


@pytest.mark.parametrize(("height", "lines"), [("-2.", [6, 7, 8, 9]), ("2.", [])])
def test_a_contour_run_in_rapid_alone_is_told_where_it_is_below_zero(height: str, lines: list[int]) -> None:
    """The G1 was forgotten, and nothing is cut at feed to compare with."""
    program = (
        f"G21 G17 G90 G40\nT1 M6\nG0 X-20. Y-20.\nZ{height}\nG41 D1 X0. F300.\nY40.\nX40.\nY0.\nX-20.\nG40 Y-20.\nM30\n"
    )
    assert [one.line for one in rapids(program)] == lines


def test_klartext_stands_elsewhere_behind_m91_too() -> None:
    program = (
        "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nL X+20 Y+20 Z+5 R0 FMAX\nL Z-5 F300\nL X+30 RL\nCC X+20 Y+20\n"
        "C X+30 Y+20 DR+\nL X+20 R0\n{}L X+70 FMAX\nL Z+50 FMAX\nEND PGM A MM\n"
    )
    assert len(rapids(program.format("L Z-6 R0 FMAX\n"), "heidenhain")) == 1
    assert not rapids(program.format("L Z-1 R0 FMAX M91\n"), "heidenhain")


@pytest.mark.parametrize(
    ("behind", "count"),
    [
        ("L Z-1 R0 FMAX M91\nL Z-5 R0 FMAX\nL X+60 R0 FMAX\n", 1),
        ("L Z-1 R0 FMAX M91\nL IZ-5 R0 F100\nL X+60 R0 FMAX\nL IX-60 R0 FMAX\n", 0),
        ("L M140 MB MAX FMAX\nL X+60 Y+20 R0 FMAX\n", 0),
        ("L M140 MB50 FMAX\nL X+60 Y+20 R0 FMAX\n", 0),
        ("L M140 MB MAX FMAX\nL Z-5 R0 FMAX\nL X+60 Y+20 R0 FMAX\n", 1),
    ],
)
def test_in_klartext_absolute_words_end_the_loss_of_a_place(behind: str, count: int) -> None:
    head = "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nL X+20 Y+20 Z+5 R0 FMAX\nL Z-5 F300\nL X+30 RL\nCC X+20 Y+20\n"
    program = f"{head}C X+30 Y+20 DR+\nL X+20 R0\n{behind}L Z+50 FMAX\nEND PGM A MM\n"
    assert len(rapids(program, "heidenhain")) == count


def test_the_wall_that_is_cut_already_is_named() -> None:
    """The rapid runs out of the first hole into the place of the second one, which is cut later."""
    second = "G41 D1 G1 X80.\nG3 I-10.\nG40 G1 X70.\nG0 Z5.\nM30\n"
    (found,) = rapids(f"{BORE}G0 X70.\n{second}")
    assert "contour of line 7 at X 30.000" in sentence(found, Unit.MM)
