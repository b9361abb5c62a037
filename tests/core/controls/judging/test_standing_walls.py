"""A closed contour that another pass cuts away is roughing or stands only below that pass; others are walls."""

from __future__ import annotations

import pytest

from core.controls.judging.judged_findings import judged_findings
from core.controls.judging.judged_runs import judge_run
from core.finding import Finding, Severity
from tests.core.controls.hand import run_of
from tests.core.controls.leveled_programs import CASES, TOOL, Level, program

CONTROLS = ("fanuc:a", "haas:a", "linuxcnc")
SHAPES = {
    "boss": ("X-60. Y0.", "X-50. Y0.\nX-{0}.\nG2 I{0}.\nG1 X-{1}.\nG2 I{1}.\nG1 X-50.", "X-60."),
    "bore": ("X0. Y0.", "X{0}. Y0.\nG3 I-{0}.\nG1 X{1}.\nG3 I-{1}.\nG1 X5.", "X0."),
    "plate": (
        "X-60. Y-20.",
        "X-45. Y-20.\nX-{0}. Y0.\nY{0}.\nX{0}.\nY-{0}.\nX-{0}.\nY0.\n"
        "X-{1}.\nY{1}.\nX{1}.\nY-{1}.\nX-{1}.\nY0.\nX-45. Y20.",
        "X-60.",
    ),
}
"""Where the tool starts, two passes of half the sizes {0} and {1} on the left of the path, and where it ends."""


def found(shape: str, first: int, second: int, control: str = "fanuc:a") -> list[Finding]:
    """What is said of two passes with a tool of 10."""
    start, passes, end = SHAPES[shape]
    number = "" if control == "linuxcnc" else " D1"
    cut = f"G41{number} G1 {passes.format(first, second)}\nG40 {end}"
    run = run_of(f"G21 G17 G40 G90 F400\nT1 M6\nG0 {start}\nG1 Z-3.\n{cut}\nM30\n", control, t1=10.0)
    return list(judged_findings(judge_run(run)))


def errors(findings: list[Finding]) -> set[str]:
    return {finding.code for finding in findings if finding.severity is Severity.ERROR}


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize(
    ("shape", "first", "second", "line"), [("boss", 30, 25, 7), ("bore", 20, 28, 6), ("plate", 32, 30, 7)]
)
def test_a_pass_that_a_later_pass_cuts_away_is_roughing(
    shape: str, first: int, second: int, line: int, control: str
) -> None:
    findings = found(shape, first, second, control)
    # LinuxCNC stops behind the step from pass to pass, which is shorter than the radius and goes into the second wall
    assert errors(findings) == ({"GOUGE"} if (shape, control) == ("plate", "linuxcnc") else set())
    (told,) = [finding for finding in findings if finding.code == "ROUGHING"]
    assert (told.severity, told.line) == (Severity.WARNING, line)


@pytest.mark.parametrize(("start", "height", "gouges"), [(-16, -2, [5]), (-15, -2, []), (-16, -10, [])])
def test_a_gouge_below_a_wider_pass_counts(start: int, height: int, gouges: list[int]) -> None:
    """The tool plunges 1 mm into the wall of a bore that a later pass widens, but not down to its depth."""
    text = (
        f"G21 G17 G40 G90 F400\nT1 M6\nG0 X{start}. Y0.\nG1 Z-10.\nG41 D1 X20.\nG3 I-20.\n"
        f"G1 Z{height}.\nX24.\nG3 I-24.\nG40 G1 X0.\nM30\n"
    )
    findings = judged_findings(judge_run(run_of(text, "fanuc:a", t1=10.0)))
    assert [finding.line for finding in findings if finding.code == "GOUGE"] == gouges
    assert [finding.line for finding in findings if finding.code == "ROUGHING"] == [6]


def test_a_pass_that_a_later_pass_cuts_away_in_two_steps_is_roughing() -> None:
    text = (
        "G21 G17 G40 G90 F400\nT1 M6\nG0 X-16. Y0.\nG1 Z-10.\nG41 D1 X20.\nG3 I-20.\n"
        "G1 Z-2.\nX24.\nG3 I-24.\nG1 Z-10.\nG3 I-24.\nG40 G1 X0.\nM30\n"
    )
    findings = judged_findings(judge_run(run_of(text, "fanuc:a", t1=10.0)))
    assert [finding.line for finding in findings if finding.severity is not Severity.INFO] == [6]


@pytest.mark.parametrize(
    ("shape", "first", "second"),
    [
        # deeper first, so the second pass has nothing to cut
        ("boss", 25, 30),
        ("bore", 28, 20),
        # more than a cutter's diameter deeper: a ring of the first pass's material stays
        ("boss", 40, 29),
        ("bore", 10, 21),
    ],
)
def test_other_passes_are_walls(shape: str, first: int, second: int) -> None:
    findings = found(shape, first, second)
    assert "GOUGE" in errors(findings)
    assert not [finding for finding in findings if finding.code == "ROUGHING"]


def test_a_pass_that_shares_a_wall_with_the_later_one_is_a_wall() -> None:
    """The second pass of one outline has a wrong coordinate."""
    once = "Y30.\nX{}.\nY-30.\nX-30.\nY0.\n"
    cut = f"G41 D1 G1 X-45. Y-20.\nX-30. Y0.\n{once.format(30)}{once.format(28)}X-45. Y20.\nG40 X-60."
    run = run_of(f"G21 G17 G40 G90 F400\nT1 M6\nG0 X-60. Y-20.\nG1 Z-3.\n{cut}\nM30\n", "fanuc:a", t1=10.0)
    assert "GOUGE" in errors(list(judged_findings(judge_run(run))))


def test_a_gouge_of_the_last_pass_is_reported() -> None:
    """The way out of the bore is to the left of the wall, where the part is."""
    start, passes, end = SHAPES["bore"]
    cut = f"G41 D1 G1 {passes.format(20, 28).replace('X5.', 'X40.')}\nG40 {end}"
    run = run_of(f"G21 G17 G40 G90 F400\nT1 M6\nG0 {start}\nG1 Z-3.\n{cut}\nM30\n", "fanuc:a", t1=10.0)
    assert "GOUGE" in errors(list(judged_findings(judge_run(run))))


RADIAL = {
    "bore": ("X8. Y0.", "G1 X20.\nG3 I-20.\nG1 X8.\nX11.\nX23.\nG3 I-23.\nG1 X11.\n"),
    "boss": ("X-45. Y0.", "G1 X-30.\nG2 I30.\nG1 X-45.\nX-42.\nX-27.\nG2 I27.\nG1 X-42.\n"),
    "counterbore": ("X8. Y0.", "G1 X20.\nG3 I-20.\nG1 X8.\nZ-2.\nX11.\nX23.\nG3 I-23.\nG1 X11.\n"),
}
"""Where the tool starts, and two passes that lines out and in on one radius join."""


def radial(shape: str, *, again: bool, old: str = "", new: str = "") -> list[Finding]:
    """What is said of the two passes, or of both again deeper, with the text `old` replaced."""
    start, passes = RADIAL[shape]
    cut = (passes + f"Z-6.\n{passes}" * again).replace(old, new)
    text = f"G21 G17 G40 G90 F400\nT1 M6\nG0 {start}\nG1 Z-3.\nG41 D1 {cut}G40 {start}\nM30\n"
    return list(judged_findings(judge_run(run_of(text, "fanuc:a", t1=10.0))))


@pytest.mark.parametrize("again", [False, True])
@pytest.mark.parametrize("shape", RADIAL)
def test_lines_out_and_in_on_one_radius_are_no_walls(shape: str, again: bool) -> None:
    findings = radial(shape, again=again)
    assert not errors(findings), findings
    assert [finding for finding in findings if finding.code == "ROUGHING"]


@pytest.mark.parametrize("again", [False, True])
@pytest.mark.parametrize(("shape", "out", "through"), [("bore", "X8.", "X32."), ("boss", "X-45.", "X-20.")])
def test_a_line_out_that_goes_through_the_wall_gouges_it(shape: str, out: str, through: str, again: bool) -> None:
    assert "GOUGE" in errors(radial(shape, again=again, old=out, new=through))


def test_a_move_of_a_micrometer_is_no_pass() -> None:
    body = "G21 G17 G40 G90 F400\nT1 M6\nG0 X-30. Y-30.\nG1 Z-3.\nG41 D1 X0. Y0.\nX.001\nG40 X-30. Y30.\nM30\n"
    findings = list(judged_findings(judge_run(run_of(body, "fanuc:a", t1=0.5))))
    assert "GOUGE" in errors(findings)
    assert not [finding for finding in findings if finding.code == "ROUGHING"]


def findings_of_levels(text: str, control: str) -> list[Finding]:
    program_text = text.replace(" D1", "") if control == "linuxcnc" else text
    run = run_of(program_text, control, t1=TOOL)
    return [*run.findings, *judged_findings(judge_run(run))]


@pytest.mark.parametrize("index", range(len(CASES)))
def test_passes_of_several_sizes_and_depths_are_clean(index: int) -> None:
    shape, levels, inside, rapid = CASES[index]
    findings = findings_of_levels(program(shape, levels, inside=inside, rapid=rapid), CONTROLS[index % 3])
    assert not errors(findings), findings
    assert bool({finding.code for finding in findings} & {"ROUGHING"}) is (len({half for half, _ in levels}) > 1)


@pytest.mark.parametrize("index", range(0, len(CASES), 2))
def test_a_wrong_side_or_lead_at_one_of_several_depths_is_found(index: int) -> None:
    shape, levels, inside, rapid = CASES[index]
    wrong_side = program(shape, levels, inside=inside, rapid=rapid, side="G42")
    wrong_lead = program(shape, levels, inside=inside, rapid=rapid, wrong_lead=index % len(levels))
    for text in (wrong_side, wrong_lead):
        assert errors(findings_of_levels(text, CONTROLS[index % 3]))


def test_forty_depths_with_leads_of_their_own_are_one_contour() -> None:
    levels = [(18.0, 0.5 * step) for step in range(1, 41)]
    findings = findings_of_levels(program("circle", levels, inside=True), "fanuc:a")
    assert {finding.code for finding in findings if finding.severity is not Severity.INFO} <= {"FN-POINT"}
    gouged = findings_of_levels(program("circle", levels, inside=True, wrong_lead=20), "fanuc:a")
    assert "GOUGE" in errors(gouged)


ONE_DEPTH: list[tuple[bool, list[Level]]] = [
    (True, [(22, 10), (18, 10)]),
    (True, [(18, 4), (22, 10), (18, 10)]),
    (False, [(20, 10), (24, 10)]),
]


@pytest.mark.parametrize("rapid", [False, True])
@pytest.mark.parametrize(("inside", "levels"), ONE_DEPTH)
def test_a_pass_that_has_nothing_to_cut_behind_a_deeper_one_is_a_wall(
    inside: bool, levels: list[Level], rapid: bool
) -> None:
    assert "GOUGE" in errors(findings_of_levels(program("circle", levels, inside=inside, rapid=rapid), "fanuc:a"))


def test_a_plunge_beside_the_wide_pass_gouges_the_bore_below_it() -> None:
    """Calculated by hand: the corner of the line to X24 leaves the center at X19 Y-5, 24.647 from the bore's axis."""
    text = (
        "G21 G17 G40 G90 F400\nT1 M6\nG0 X-16. Y0.\nG1 Z-10.\nG41 D1 X20.\nG3 I-20.\n"
        "G1 Z-2.\nX28.\nG3 I-28.\nG1 X24.\n{}Z-10.\nG3 I-24.\nG40 G1 X0.\nM30\n"
    )
    findings = list(judged_findings(judge_run(run_of(text.format(""), "fanuc:a", t1=10.0))))
    (gouge,) = [finding for finding in findings if finding.severity is Severity.ERROR]
    assert (gouge.line, round(gouge.value or 0.0, 3)) == (12, 0.647)


STEPS = {
    "pocket": ("X30. Y20.", "X0. Y20.", "Y0.\nX{0}\nY40.\nX0.\nY20.\n"),
    "boss": ("X-30. Y20.", "X0. Y20.", "Y40.\nX{0}\nY0.\nX0.\nY20.\n"),
    # the wall of the deep pass ends on a slanting wall of the wide one, rounded
    "triangle": ("X13. Y11.", "X15. Y5.", "X{0}\nX20. Y40.\nX0. Y0.\nX15. Y5.\n"),
}
"""Where the tool starts, where a pass begins, and a pass of the size {0}."""


def step(shape: str, passes: list[tuple[str, float]]) -> list[Finding]:
    """What is said of passes of these sizes and heights from one point on, with a tool of 12."""
    start, first, once = STEPS[shape]
    around = "".join(f"Z{height}\n{once.format(size)}" for size, height in passes)
    text = f"G21 G17 G40 G90 F400\nT1 M6\nG0 {start}\nG1 Z-1.\nG41 D1 {first}\n{around}G40 {start}\nM30\n"
    return list(judged_findings(judge_run(run_of(text, "fanuc:a", t1=12.0))))


@pytest.mark.parametrize(
    ("shape", "passes"),
    [
        ("pocket", [("50.", -10), ("60.", -5)]),
        ("pocket", [("60.", -5), ("50.", -10)]),
        # more than a cutter's diameter wider
        ("pocket", [("90.", -5), ("50.", -10)]),
        ("pocket", [("50.", -3), ("60.", -3), ("50.", -6), ("60.", -6), ("50.", -9)]),
        ("triangle", [("60. Y20.", -5), ("31.7 Y10.567", -10)]),
        ("boss", [("60.", -10), ("50.", -5)]),
        ("boss", [("50.", -5), ("60.", -10)]),
        ("boss", [("90.", -10), ("50.", -5)]),
        ("boss", [("50.", -3), ("60.", -3), ("50.", -6), ("60.", -6), ("60.", -9)]),
    ],
)
def test_a_step_may_share_walls_with_the_deeper_pass(shape: str, passes: list[tuple[str, float]]) -> None:
    findings = step(shape, passes)
    assert not errors(findings), findings
    assert [finding.severity for finding in findings if finding.code == "ROUGHING"] == [Severity.WARNING]


@pytest.mark.parametrize(
    ("shape", "passes"),
    [
        # one outline in two depths, with a wrong coordinate in the last one
        ("pocket", [("50.", -5), ("60.", -10)]),
        ("pocket", [("50.", -5), ("60.", -5)]),
        ("boss", [("60.", -5), ("50.", -10)]),
        ("boss", [("60.", -5), ("50.", -5)]),
    ],
)
def test_a_pass_that_shares_a_wall_and_is_no_shallower_is_a_wall(shape: str, passes: list[tuple[str, float]]) -> None:
    findings = step(shape, passes)
    assert "GOUGE" in errors(findings)
    assert not [finding for finding in findings if finding.code == "ROUGHING"]


@pytest.mark.parametrize("wrong", [0.1, 0.5, 2.0])
@pytest.mark.parametrize("heights", [(-5, -10), (-10, -5)])
@pytest.mark.parametrize("shape", ["pocket", "boss"])
def test_a_wrong_coordinate_at_one_of_several_depths_is_no_step(
    shape: str, heights: tuple[int, int], wrong: float
) -> None:
    sizes = {-5: 50 + wrong if shape == "pocket" else 50 - wrong, -10: 50.0}
    findings = step(shape, [(f"{sizes[height]}", height) for height in heights])
    assert "GOUGE" in errors(findings), findings
    assert not [finding for finding in findings if finding.code == "ROUGHING"]


@pytest.mark.parametrize(("dip", "gouges"), [("", []), ("Z-6.\n", [12])])
def test_a_plunge_beyond_the_shared_wall_gouges_the_step(dip: str, gouges: list[int]) -> None:
    """The wide pass runs 10 past the wall of the deep one; a plunge there cuts the floor of the step."""
    text = (
        "G21 G17 G40 G90 F400\nT1 M6\nG0 X30. Y20.\nG1 Z-10.\nG41 D1 X0. Y20.\nY0.\nX50.\nY40.\nX0.\nY20.\n"
        f"Z-5.\nY0.\nX70.\n{dip}Y40.\nX0.\nY20.\nG40 X30. Y20.\nM30\n"
    )
    findings = list(judged_findings(judge_run(run_of(text, "fanuc:a", t1=12.0))))
    assert bool(gouges) is ("GOUGE" in errors(findings)), findings


def with_two_offsets(passes: str, start: str = "X0. Y0.", depth: str = "Z-10.") -> list[Finding]:
    """What is said of passes with D1 of a tool of 12 and D2 of 12.5 in one stretch."""
    text = f"G21 G17 G40 G90 F400\nT1 M6\nG0 {start}\nG1 {depth}\nG41 {passes}G40 {start}\nM30\n"
    return list(judged_findings(judge_run(run_of(text, "fanuc:a", t1=12.0, t2=12.5))))


IN_BORE = "G1 X{0}. Y-10.\nG3 X{1}. Y0. R10.\nG3 I-{1}.\nG3 X{0}. Y10. R10.\nG1 X0. Y0.\n"
BORE, COUNTERBORE = IN_BORE.format(10, 20), IN_BORE.format(16, 26)
AROUND_BOSS = "G1 X-{1}. Y-10.\nG3 X-{0}. Y0. R10.\nG2 I{0}.\nG3 X-{1}. Y10. R10.\nG1 X-60. Y0.\n"
NECK, FOOT = AROUND_BOSS.format(20, 30), AROUND_BOSS.format(24, 34)
TWO_OFFSETS = {
    "bore, then counterbore": (f"D1 {BORE}G1 Z-5.\nD2 {COUNTERBORE}", "X0. Y0.", "Z-10."),
    "counterbore, then bore": (f"D2 {COUNTERBORE}Z-10.\nD1 {BORE}", "X0. Y0.", "Z-5."),
    "opened circle by circle": ("D2 G1 X20.\nG3 I-20.\nG1 X26.\nG3 I-26.\nD1 G1 X30.\nG3 I-30.\n", "X0. Y0.", "Z-9."),
    "neck, then foot": (f"D2 {NECK}Z-10.\nD1 {FOOT}", "X-60. Y0.", "Z-5."),
    "foot, then neck": (f"D2 {FOOT}Z-5.\nD1 {NECK}", "X-60. Y0.", "Z-10."),
}


@pytest.mark.parametrize("case", TWO_OFFSETS)
def test_passes_of_several_sizes_may_have_offsets_of_their_own(case: str) -> None:
    findings = with_two_offsets(*TWO_OFFSETS[case])
    assert not errors(findings), findings
    told = [finding.severity for finding in findings if finding.code == "ROUGHING"]
    assert set(told) <= {Severity.WARNING}


@pytest.mark.parametrize(
    ("passes", "start", "depth"),
    [
        # at one depth the bore has nothing to cut behind the counterbore
        (f"D2 {COUNTERBORE}D1 {BORE}", "X0. Y0.", "Z-5."),
        (f"D2 {NECK}D1 {FOOT}", "X-60. Y0.", "Z-5."),
        # the second pass is deeper than the first one, and wider
        (f"D1 {BORE}G1 Z-15.\nD2 G1 X-40. Y0.\n{COUNTERBORE}", "X0. Y0.", "Z-10."),
        # the lead of the bore starts too near to its wall
        (f"D2 {COUNTERBORE}Z-10.\nD1 {BORE.replace('X10. Y-10.', 'X10. Y-16.')}", "X0. Y0.", "Z-5."),
    ],
)
def test_a_gouge_with_offsets_of_their_own_is_found(passes: str, start: str, depth: str) -> None:
    assert errors(with_two_offsets(passes, start, depth))
