"""Rapids without compensation at the depth of a cut are reported through a contour, not beside or above it."""

from __future__ import annotations

from typing import Any

import pytest

from core.controls.judging import rapids_at_depth
from core.controls.judging.judged_findings import judged_findings
from core.controls.judging.judged_runs import judge_run
from core.controls.judging.rapids_at_depth import CutContour, moves_through
from core.finding import Finding, Severity
from core.units import Unit, sentence
from core.verify.judge import judge
from tests.core.controls.hand import run_of
from tests.progress import looks_until_stopped

CONTROLS = ["fanuc:a", "haas:a", "linuxcnc", "rosettacnc:normal"]
BORE = "G21 G17 G90 G40\nT1 M6\nG0 X20. Y20.\nZ5.\nG1 Z-5. F300\nG41 D1 X30.\nG3 I-10.\nG40 G1 X20.\n"
"""A 20 mm hole about X20 Y20, cut by a 10 mm tool."""


def rapids(program: str, control: str = "fanuc:a", code: str = "RAPID") -> list[Finding]:
    """The findings on rapids at depth."""
    run = run_of(program, control, t1=10.0, t2=6.0)
    assert run.stopped_at is None, run.findings
    return [finding for finding in judged_findings(judge_run(run)) if finding.code == code]


@pytest.mark.parametrize("control", CONTROLS)
def test_a_forgotten_retract_is_a_warning_with_its_line(control: str) -> None:
    (warning,) = rapids(f"{BORE}G0 X70.\nZ50.\nM30\n", control)
    assert (warning.line, warning.severity) == (9, Severity.WARNING)
    assert sentence(warning, Unit.MM) == (
        "This rapid at Z -5.000 cuts the contour of line 7 at X 30.000 Y 20.000. Raise the tool before it."
    )


@pytest.mark.parametrize(
    ("after", "count"),
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
def test_rapids_that_gouge_at_or_below_the_depth_of_cut_are_reported(after: str, count: int) -> None:
    findings = rapids(f"{BORE}{after}G0 Z50.\nM30\n")
    assert len(findings) == count
    if "X26." in after:
        assert findings[0].value == pytest.approx(1.0)  # by hand: 6 from the middle and 5 of the tool reach 11 of 10


def test_rapids_before_a_cut_and_between_cuts_are_reported() -> None:
    before = BORE.replace("Z5.\nG1 Z-5. F300\n", "Z-5.\nX70.\nX20.\nF300\n")
    assert [finding.line for finding in rapids(f"{before}G0 Z5.\nM30\n")] == [5, 6]
    after = "G0 X70.\nG41 D1 G1 X80.\nG3 I-10.\nG40 G1 X70.\nG0 Z5.\nM30\n"
    assert [finding.line for finding in rapids(BORE + after)] == [9]


@pytest.mark.parametrize(("begin", "count"), [("2.", 0), ("-1.", 1)])
def test_a_rapid_above_the_start_of_a_helix_is_not_reported(begin: str, count: int) -> None:
    """The rapid to the center is above the part or at the height of the start below its top."""
    helix = f"G41 D1 X30.\nG3 I-10. Z-5.\nG3 I-10.\nG40 G1 X20.\nG0 Z{begin}\nX70.\n"
    text = f"G21 G17 G90 G40\nT1 M6\nG0 X20. Y20.\nZ5.\nZ{begin}\nG1 F300\n{helix}Z50.\nM30\n"
    assert len(rapids(text)) == count


@pytest.mark.parametrize(("height", "lines"), [("-5.", [8]), ("-6.", [8]), ("5.", [])])
def test_a_rapid_along_a_wall_at_depth_is_reported(height: str, lines: list[int]) -> None:
    wall = f"G41 D1 X-20. Y0.\nX0.\nG0 Z{height} X60.\nG1 Z-5. X100.\nG40 Y20.\nG0 Z50.\nM30\n"
    text = f"G21 G17 G90 G40\nT1 M6\nG0 X-30. Y10.\nZ5.\nG1 Z-5. F300\n{wall}"
    findings = rapids(text)
    assert [finding.line for finding in findings] == lines
    assert all("under compensation" in finding.text for finding in findings)


@pytest.mark.parametrize(
    ("after", "lines"),
    [("G1 X70.\n", [9]), ("G1 X24.\nX70.\n", [10]), ("G1 Z-4.\nX70.\n", []), ("G0 Z5.\nG1 Z-5.\nX70.\n", []), ("", [])],
)
def test_a_feed_move_from_the_contour_through_its_wall_is_reported(after: str, lines: list[int]) -> None:
    run = run_of(f"{BORE}{after}G0 Z50.\nM30\n", "fanuc:a", t1=10.0)
    findings = [finding for finding in judged_findings(judge_run(run)) if finding.code == "FEED"]
    assert [finding.line for finding in findings] == lines
    assert all(finding.severity is Severity.WARNING for finding in findings)


@pytest.mark.parametrize(
    ("before", "lines"),
    [
        # from X100 across the boss to the place where compensation begins
        ("G1 Z-5. F200.\nX-20. F500.\nY-20.\n", [6]),
        ("G1 Z-4. F200.\nX-20.\nZ-5.\nY-20.\n", []),
        ("G1 X-20. F500.\nZ-5.\nY-20.\n", []),
        ("G0 X-20.\nG1 Z-5. F200.\nY-20.\n", []),
    ],
)
def test_a_feed_move_through_the_wall_to_the_contour_is_reported(before: str, lines: list[int]) -> None:
    boss = "G41 D1 X0. Y-10. F400.\nY50.\nX80.\nY0.\nX-10.\nG40 X-20. Y-20.\nG0 Z50.\nM30\n"
    run = run_of(f"G21 G17 G90 G40\nT1 M6\nG0 X100. Y25.\nZ10.\n{before}{boss}", "fanuc:a", t1=10.0)
    findings = [finding for finding in judged_findings(judge_run(run)) if finding.code == "FEED"]
    assert [finding.line for finding in findings] == lines


def test_rapids_are_compared_with_the_highest_pass() -> None:
    deeper = "G1 Z-10.\nG41 D1 X30.\nG3 I-10.\nG40 G1 X20.\n"
    assert [finding.line for finding in rapids(f"{BORE}{deeper}G0 Z-7.\nX70.\nZ5.\nM30\n")] == [14]


def test_rapids_in_klartext_are_reported() -> None:
    program = (
        "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nL X+20 Y+20 Z+5 R0 FMAX\nL Z-5 F300\nL X+30 RL\nCC X+20 Y+20\n"
        "C X+30 Y+20 DR+\nL X+20 R0\nL X+70 FMAX\nL Z+50 FMAX\nEND PGM A MM\n"
    )
    assert [finding.line for finding in rapids(program, "heidenhain")] == [9]


@pytest.mark.parametrize("home", ["G91 G28 Z0.\nG90\n", "G53 G0 Z0.\n", "G91 G28 X0. Y0. Z0.\nG90\n"])
@pytest.mark.parametrize("control", ["fanuc:a", "haas:a"])
def test_a_move_to_a_machine_position_ends_the_known_depth(home: str, control: str) -> None:
    assert not rapids(f"{BORE}{home}G0 X70.\nX20.\nG43 H1 Z5.\nX70.\nM30\n", control)
    assert [finding.line for finding in rapids(f"{BORE}{home}G0 X0. Y20.\nZ-5.\nX70.\nZ5.\nM30\n", control)] == [
        11 + home.count("\n")
    ]


@pytest.mark.parametrize("control", CONTROLS)
def test_a_rapid_in_another_setup_is_not_compared(control: str) -> None:
    """The table turns the part to a face that has nothing in the way."""
    turned = f"{BORE}G0 Z50.\nB90.\nX20.\nZ{{}}\nX70.\nZ50.\nB0\nX20.\nZ-5.\nX70.\nM30\n"
    assert [finding.line for finding in rapids(turned.format("-5."), control)] == [18]
    assert not rapids(turned.format("-2."), control, "LOW-RAPID")


def test_rapids_in_a_row_are_each_compared_with_their_own_setup() -> None:
    """The bore of G55, 100 mm to the right, is not in the way of the rapids before G55."""
    other_bore = BORE.replace("X20.", "X120.").replace("X30.", "X130.").replace("T1 M6\n", "G55\n")
    text = f"{BORE}G0 Z50.\n{other_bore}G0 Z50.\nG54 X260.\nZ-5.\nX160.\n{{}} X161.\nX120.\nZ50.\nM30\n"
    assert not rapids(text.format("G54"))
    assert [finding.line for finding in rapids(text.format("G55"))] == [23]


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize("change", ["G55 G0 X70.\n", "B90.\nG0 X70.\n"])
def test_a_retract_that_is_forgotten_before_another_setup_is_a_warning(change: str, control: str) -> None:
    """The move into the other setup still starts in the bore; the next one is clear of it."""
    assert [finding.line for finding in rapids(f"{BORE}{change}X-50.\nM30\n", control)] == [8 + change.count("\n")]
    low = f"{BORE}G0 Z-1.\n{change}X-50.\nM30\n"
    (warning,) = rapids(low, control, "LOW-RAPID")
    assert warning.line == 9 + change.count("\n")
    assert f"of line {warning.line} runs" in warning.text


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a"])
def test_a_tool_change_ends_the_known_depth(control: str) -> None:
    """These machines raise the tool to change it; LinuxCNC leaves it where it is."""
    text = f"{BORE}T2 M6\nG0 X70.\nX20.\nG43 H2 Z{{}}\nX70.\nG91 G28 X0. Y0.\nM30\n"
    assert not rapids(text.format("5."), control)
    assert [finding.line for finding in rapids(text.format("-5."), control)] == [13]
    assert [finding.line for finding in rapids(f"{BORE}T2 M6\nG0 X70.\nZ5.\nM30\n", "linuxcnc")] == [10]
    # the tool is in the spindle already: the machine may change and raise nothing
    assert [finding.line for finding in rapids(f"{BORE}T1 M6\nG0 X70.\nZ5.\nM30\n", control)] == [10]


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a"])
def test_a_rapid_from_where_a_probe_stopped_is_not_reported(control: str) -> None:
    """Where the stylus is, and how large it is, only the control knows; the next rapid is an ordinary one."""
    for change in ("T9 M6\n", ""):
        text = f"{BORE}G0 Z50.\n{change}G0 X20. Y20.\nZ-5.\nG31 X30. F100.\n#100=#5061\nG0 X20.\nX70.\nM30\n"
        assert [finding.line for finding in rapids(text, control)] == [15 + bool(change)]


@pytest.mark.parametrize("home", ["G91 G28 X0. Y0.\nG90\n", "G53 G0 X0. Y0.\n"])
def test_a_rapid_that_ends_in_a_wall_is_reported_wherever_it_starts(home: str) -> None:
    """Only X and Y are at the machine position: the depth and the end of the rapid are known."""
    assert [finding.line for finding in rapids(f"{BORE}{home}G0 X28. Y20.\nZ5.\nM30\n")] == [9 + home.count("\n")]


@pytest.mark.parametrize(("height", "lines"), [("-2.", [6, 7, 8, 9]), ("2.", [])])
def test_a_contour_cut_only_by_rapids_below_zero_is_reported(height: str, lines: list[int]) -> None:
    """The G1 is missing, so no cut at feed exists for comparison."""
    program = (
        f"G21 G17 G90 G40\nT1 M6\nG0 X-20. Y-20.\nZ{height}\nG41 D1 X0. F300.\nY40.\nX40.\nY0.\nX-20.\nG40 Y-20.\nM30\n"
    )
    assert [finding.line for finding in rapids(program)] == lines


def test_a_contour_in_rapids_above_the_part_is_reported() -> None:
    """The plunge is missing, and G1 with it."""
    boss = "G41 D1 X0. Y-10. F400.\nY50.\nX80.\nY0.\nX-10.\nG40 X-20. Y-20.\nG0 Z50.\nM30\n"
    head = "G21 G17 G90 G40\nT1 M6\nG0 X-20. Y-20.\nZ5.\n"
    (warning,) = rapids(f"{head}{boss}", code="NO-CUT")
    assert (warning.line, warning.severity) == (6, Severity.WARNING)
    assert warning.text.startswith("Nothing is cut: all moves of this contour are rapids above the part.")
    for plunge in ("G1 Z-5. F100.\n", "G1 F100.\n"):
        assert not rapids(f"{head}{plunge}{boss}", code="NO-CUT")


def test_m91_in_klartext_ends_the_known_depth() -> None:
    program = (
        "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nL X+20 Y+20 Z+5 R0 FMAX\nL Z-5 F300\nL X+30 RL\nCC X+20 Y+20\n"
        "C X+30 Y+20 DR+\nL X+20 R0\n{}L X+70 FMAX\nL Z+50 FMAX\nEND PGM A MM\n"
    )
    assert len(rapids(program.format("L Z-6 R0 FMAX\n"), "heidenhain")) == 1
    assert not rapids(program.format("L Z-1 R0 FMAX M91\n"), "heidenhain")


@pytest.mark.parametrize(
    ("after", "count"),
    [
        ("L Z-1 R0 FMAX M91\nL Z-5 R0 FMAX\nL X+60 R0 FMAX\n", 1),
        ("L Z-1 R0 FMAX M91\nL IZ-5 R0 F100\nL X+60 R0 FMAX\nL IX-60 R0 FMAX\n", 0),
        ("L M140 MB MAX FMAX\nL X+60 Y+20 R0 FMAX\n", 0),
        ("L M140 MB50 FMAX\nL X+60 Y+20 R0 FMAX\n", 0),
        ("L M140 MB MAX FMAX\nL Z-5 R0 FMAX\nL X+60 Y+20 R0 FMAX\n", 1),
        ("TOOL CALL 2 Z S1000\nL X+60 R0 FMAX\nL IZ+5 R0 FMAX\nL X+20 R0 FMAX\n", 0),
        ("TOOL CALL 2 Z S1000\nL Z-5 R0 FMAX\nL X+60 R0 FMAX\n", 1),
        ("TOOL CALL 1 Z S2000\nL X+60 R0 FMAX\n", 1),
    ],
)
def test_absolute_words_in_klartext_make_a_position_known_again(after: str, count: int) -> None:
    head = "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nL X+20 Y+20 Z+5 R0 FMAX\nL Z-5 F300\nL X+30 RL\nCC X+20 Y+20\n"
    program = f"{head}C X+30 Y+20 DR+\nL X+20 R0\n{after}L Z+50 FMAX\nEND PGM A MM\n"
    assert len(rapids(program, "heidenhain")) == count


def test_a_rapid_names_the_wall_that_is_already_cut() -> None:
    """The rapid runs from the first hole to the place of the second, which is cut later."""
    second = "G41 D1 G1 X80.\nG3 I-10.\nG40 G1 X70.\nG0 Z5.\nM30\n"
    (warning,) = rapids(f"{BORE}G0 X70.\n{second}")
    assert "contour of line 7 at X 30.000" in sentence(warning, Unit.MM)


@pytest.mark.parametrize("control", CONTROLS)
def test_a_rapid_below_zero_over_a_deeper_wall_is_reported(control: str) -> None:
    """The retract has a wrong sign: Z-1 for Z1."""
    program = f"{BORE}G0 Z-1.\nX70.\nX20.\nZ50.\nM30\n"
    (warning,) = rapids(program, control, "LOW-RAPID")
    assert (warning.line, warning.severity) == (10, Severity.WARNING)
    assert sentence(warning, Unit.MM) == (
        "The rapids of lines 10, 11 run below Z 0 over a wall that is cut deeper, first at X 30.000 Y 20.000, "
        "lowest at Z -1.000. Check the sign of Z, and that the material there is already cut away."
    )
    assert not rapids(program.replace("Z-1.", "Z1."), control, "LOW-RAPID")
    assert not rapids(program.replace("Z-1.", "Z-5."), control, "LOW-RAPID")


@pytest.mark.parametrize(
    ("after", "lines"),
    [
        # by hand: the tool reaches the wall at X25, a tenth of the way: at Z-4, at Z-2.5, and at Z0.5 above it
        ("G0 X70. Z5.\n", [9]),
        ("G0 X70. Z20.\n", [9]),
        ("G0 X70. Z50.\n", []),
        ("G0 X24. Z-1.\nX16.\n", []),
        ("G0 Z5.\nX70.\nX20. Z-5.\n", [11]),
        ("G0 Z5.\nX70.\nX20. Z-.1\n", []),
    ],
)
def test_only_the_part_of_a_rapid_below_zero_counts(after: str, lines: list[int]) -> None:
    findings = rapids(f"{BORE}{after}G0 Z50.\nM30\n", code="LOW-RAPID")
    assert [finding.line for finding in findings] == lines


@pytest.mark.parametrize(("floor", "count"), [("-3.", 0), ("-1.", 1)])
def test_a_rapid_where_the_material_is_cut_away_is_not_reported(floor: str, count: int) -> None:
    """The strip that the rapid at Z-2 runs along is faced to the floor before."""
    faced = BORE.replace("G1 Z-5. F300\n", f"G1 Z{floor} F300\nX80.\nX20.\nG1 Z-5.\n")
    assert len(rapids(f"{faced}G0 Z-2.\nX70.\nZ50.\nM30\n", code="LOW-RAPID")) == count


@pytest.mark.parametrize(("rougher", "count"), [("T2 M6\n", 0), ("", 1)])
def test_each_tool_cuts_away_what_its_own_size_reaches(rougher: str, count: int) -> None:
    """By hand: along Y10 the 20 mm tool clears Y0 to Y20, the 10 mm tool Y5 to Y15; the rapid needs Y9 to Y19."""
    head = f"G21 G17 G90 G40\nT1 M6\n{rougher}G0 X-30. Y10.\nZ5.\nG1 Z-3. F300\nX130.\nG0 Z50.\n"
    large = "X200. Y100.\nG1 Z-5.\nG41 D2 X230.\nG3 I-30.\nG40 G1 X200.\nG0 Z50.\nT1 M6\n"
    rapid = "G0 X-30. Y14.\nZ-3.\nX50.\nG1 Z-8.\nG41 D1 X60.\nG3 I-10.\nG40 G1 X50.\nG0 Z50.\nM30\n"
    run = run_of(f"{head}{large}{rapid}", "fanuc:a", t1=10.0, t2=20.0)
    assert [finding.code for finding in judged_findings(judge_run(run))].count("LOW-RAPID") == count


@pytest.mark.parametrize(("turned", "count"), [("B0\n", 0), ("B90.\n", 1)])
def test_what_is_cut_away_from_another_face_does_not_clear_a_rapid(turned: str, count: int) -> None:
    faced = f"{BORE}G0 Z50.\n{turned}G0 X-30. Y20.\nG1 Z-3.\nX130.\nG0 Z50.\nB0\nX20.\n"
    assert len(rapids(f"{faced}Z-2.\nX70.\nZ50.\nM30\n", code="LOW-RAPID")) == count


def test_a_tool_of_unknown_size_clears_no_more_than_its_axis_for_itself() -> None:
    """An engraver, which compensates nowhere, is not as large as the tool of the bore."""
    engraved = f"{BORE}G0 Z50.\nT3 M6\nG0 X20.\nG43 H3 Z5.\nG1 X40. Y15. F200.\nZ-1.\nX20. Y20.\nG0 Z50.\n"
    assert not rapids(f"{engraved}Z-.5\nX40. Y15.\nZ50.\nM30\n", code="LOW-RAPID")
    assert rapids(f"{engraved}Y22.\nZ-.5\nX40. Y17.\nZ50.\nM30\n", code="LOW-RAPID")


@pytest.mark.parametrize("control", CONTROLS)
def test_a_rapid_below_zero_has_the_tool_in_the_spindle(control: str) -> None:
    """A smaller tool fits closer to the wall; of a drill, which compensates nowhere, no size is known."""
    change = "G0 Z50.\nG40\nT2 M6\nX20. Y20.\nZ5.\nZ-4.\n"
    drill = f"{BORE}{change}X27.\nX13.\nG1 Z-6.\nG0 Z50.\nM30\n"
    assert not rapids(drill, control, "LOW-RAPID")
    assert [finding.line for finding in rapids(drill.replace("X27.", "X47."), control, "LOW-RAPID")] == [15]
    deep = drill.replace("Z-4.", "Z-5.")
    assert not rapids(deep, control)
    assert [finding.line for finding in rapids(deep.replace("X27.", "X47."), control)] == [15, 16]
    smaller = f"{BORE}{change}X26.\nX20.\nG1 Z-5.\nG41 D2 X30.\nG3 I-10.\nG40 G1 X20.\nG0 Z50.\nM30\n"
    assert not rapids(smaller, control, "LOW-RAPID")
    assert [finding.line for finding in rapids(smaller.replace("X26.", "X27.5"), control, "LOW-RAPID")] == [15]


def test_a_rapid_is_judged_with_the_contours_that_it_comes_near(monkeypatch: pytest.MonkeyPatch) -> None:
    """Hundreds of holes would take minutes if each rapid were judged with each of them."""
    judged = list[float]()

    def counting(*arguments: Any, **options: Any) -> Any:
        judged.append(arguments[2])
        return judge(*arguments, **options)

    monkeypatch.setattr(rapids_at_depth, "judge", counting)
    hole = "G0 X{0}. Y20.\nG1 Z-5.\nG41 D1 X{1}.\nG3 I-10.\nG40 G1 X{0}.\nG0 Z-1.\n"
    holes = "".join(hole.format(x, x + 10) for x in range(100, 500, 50))
    assert len(rapids(f"{BORE}G0 Z-1.\n{holes}Z50.\nM30\n", code="LOW-RAPID")) == 1
    # a rapid comes near the hole that it leaves and the one that it goes to
    assert len(judged) == 16


def test_a_canceled_judgment_stops_at_every_kind_of_move() -> None:
    """A rapid at depth, one below zero over a wall, and the feed moves beside the contour."""
    run = run_of(f"{BORE}G1 X22.\nG0 X70.\nZ-1.\nX20.\nZ50.\nM30\n", "fanuc:a", t1=10.0)
    contours = [CutContour(result.surface, result.stretch, -5.0, 0.0) for result in judge_run(run)]
    shares = list[float]()
    assert len(moves_through(run, contours, shares.append)) == 2
    assert shares == sorted(shares)
    assert {int(3.0 * share) for share in shares} == {0, 1, 2}
    for granted in range(len(shares)):
        assert looks_until_stopped(lambda check: moves_through(run, contours, check), granted) == granted + 1
