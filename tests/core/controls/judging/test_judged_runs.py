"""Verdicts on the path of a control, by line, and the comparison of all controls."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.controls.compared_controls import Compared, OtherLanguage, compare, parting
from core.controls.judging.judged_findings import judged_findings
from core.controls.judging.judged_runs import deepest_gouge, first_unjudged, judge_run
from core.controls.registry import choices, compared, names, reads, resolve
from core.finding import Severity
from core.geometry.path import Path
from core.units import Unit, from_mm, sentence, to_mm
from core.verify.judge import judge
from tests.core.controls.hand import DATA, findings_of, run_of, run_until_given_up, sample
from tests.tool_tables import end_mills

NOTCH = "G20 G17 F10\nG0 X-1 Y2\nG41 D1\nG1 X0 Y0\nX2\nY-.3\nX2.3\nY0\nX5\nG40\nG0 Y2\nM2\n"


def test_a_gouge_is_reported_with_its_depth_and_lines() -> None:
    run = sample("threeblock-outside.nc", "threeblock", t1=0.6)
    results = judge_run(run)
    cut, line = deepest_gouge(results)
    assert (round(from_mm(cut, Unit.IN), 9), line) == (0.05, 5)
    (gouge,) = [finding for finding in judged_findings(results) if finding.code == "GOUGE"]
    assert "surface of line 6 by 0.0500 at X" in sentence(gouge, Unit.IN)


def test_a_clean_path_has_no_finding() -> None:
    run = run_of("G20 F9\nG0 X0 Y2\nG41 D1\nG1 Y0\nX2\nY-3\nG40\nX5\nM2\n", "rosettacnc:easy", t1=0.5)
    assert not judged_findings(judge_run(run))


def test_stock_left_by_an_alarm_is_not_reported() -> None:
    text = "G21 G17 G90 F200\nT1 M6\nG0 X-20 Y-20\nG41 X0 Y-10\nG1 Z-3\nY50\nX80\n{}X-10\nG40 X-20\nM2\n"
    for wall, told in (("Y0\n", set()), ("Y45\nX84\nY0\n", {"N-CONCAVE"})):
        run = run_of(text.format(wall), "linuxcnc", t1=10.0)
        assert {finding.code for finding in run.findings if finding.severity is Severity.ERROR} == told
        uncut = [finding for finding in judged_findings(judge_run(run)) if finding.code == "UNCUT"]
        assert not uncut


@pytest.mark.parametrize(("rise", "severity"), [(1, Severity.INFO), (20, Severity.WARNING)])
def test_material_thinner_than_a_digit_in_a_corner_is_no_warning(rise: int, severity: Severity) -> None:
    """A cutter of radius 5 leaves 5 (1 / cos(a / 2) - 1) in an inside corner of angle a: 0.0002 or 0.097."""
    text = f"G21 G17 G90 F200\nT1 M6\nG0 X-20 Y0\nG1 Z-3\nG41 D1 X0\nX50\nX100 Y{rise}\nG40 Y40\nM30\n"
    (told,) = [
        finding for finding in judged_findings(judge_run(run_of(text, "fanuc:a", t1=10.0))) if finding.code == "UNCUT"
    ]
    assert told.severity is severity


BORE = "G21 G17 G90 F200\nT1 M6\nG0 X0 Y0\nG1 Z-3\nG41 D1 X6\nG3 I-6\nG40 G1 X0\nM30\n"


def test_a_cutter_as_wide_as_the_bore_cuts_all_of_it() -> None:
    run = run_of(BORE, "fanuc:a", t1=12.0)
    (result,) = judge_run(run)
    assert (result.verdict.clean, result.verdict.uncut_length) == (True, 0.0)
    assert not [finding for finding in judged_findings((result,)) if finding.code == "UNCUT"]


def test_a_notch_that_is_too_narrow_stops_threeblock_and_linuxcnc() -> None:
    rows = {row.control: row for row in compare(NOTCH.encode(), end_mills({1: 0.5}))}
    assert set(rows) == set(compared())
    lenient, strict = rows["threeblock"], rows["linuxcnc"]
    assert isinstance(lenient, Compared)
    assert isinstance(strict, Compared)
    assert lenient.run.stopped_at is not None
    assert strict.run.stopped_at == 8
    other = rows["klartext"]
    assert isinstance(other, OtherLanguage)
    assert other.why == "no control runs this program to the end"


@pytest.mark.parametrize("reference", ["fanuc:b", "fanuc:b-arc"])
def test_all_controls_are_compared_with_the_reference(reference: str) -> None:
    program = b"G20 F9\nG0 X0 Y2\nG41 D1\nG1 Y0\nX2\nY-3\nG40\nX5\nM2\n"
    rows = compare(program, end_mills({1: 0.5}), reference=reference)
    assert rows[0].control == reference
    assert {row.control for row in rows} == {*compared(), reference}
    others = [row for row in rows[1:] if isinstance(row, Compared)]
    assert len(others) > 5
    assert all(row.reference == reference for row in others)
    assert any(row.parting for row in others)


def test_parting_finds_where_two_paths_separate() -> None:
    easy = sample("rosettacnc-square.ngc", "rosettacnc:easy", t1=6)
    normal = sample("rosettacnc-square.ngc", "rosettacnc:normal", t1=6)
    difference = parting(easy.moves, normal.moves)
    assert difference is not None
    assert difference.line == difference.farthest == 14
    assert difference.distance == pytest.approx(np.hypot(23.675444679663241 - 23, 3), abs=1e-9)
    assert parting(easy.moves, easy.moves) is None


def test_klartext_and_iso_are_distinguished() -> None:
    assert reads("klartext", b"0 BEGIN PGM A MM\n")
    assert not reads("linuxcnc", b"  BEGIN PGM A MM\n")
    assert reads("linuxcnc", (DATA / "nc" / "rosettacnc-square.ngc").read_bytes())


def test_resolve_accepts_full_and_short_names() -> None:
    assert resolve("rosettacnc") == "rosettacnc:nist"
    assert resolve(" Nine-Series:B-G39.1 ") == "nine-series:b-g39.1"
    assert all(resolve(name) == name for name in names())
    for wrong in ("siemens", "rosettacnc:hard", "", "linuxcnc:2"):
        assert "linuxcnc" in getattr(resolve(wrong), "text", "")


def test_a_path_that_leaves_the_surface_and_turns_back_is_reported_with_its_line() -> None:
    run = run_of("G20 F9\nG0 X0 Y2\nG41 D1\nG1 Y0\nX2\nY-3\nG40\nX5\nM2\n", "rosettacnc:easy", t1=0.5)
    (result,) = judge_run(run)
    assert not {"AWAY", "BACKWARDS"} & {finding.code for finding in judged_findings((result,))}
    way = result.center.points.tolist()
    row = int(np.argmax(result.center.lengths * np.isin(result.center.numbers, result.surface.numbers)))
    (x0, y0), (x1, y1) = way[row], way[row + 1]
    along, off = np.array((x1 - x0, y1 - y0)), np.array((y0 - y1, x1 - x0)) * 0.2
    corners = [np.array((x0, y0)) + t * along + (t == 0.6) * off for t in (0.5, 0.6, 0.7, 0.4)]
    points = np.array([*way[: row + 1], *(corner.tolist() for corner in corners), *way[row + 1 :]])
    kept = np.insert(np.arange(len(result.center)), row, [row] * 4)
    path = result.center
    bent = Path.of(points, path.centers[kept], path.turns[kept], path.numbers[kept])
    verdict = judge(result.surface, result.stretch.side, result.stretch.radius, bent)
    strays = [
        finding
        for finding in judged_findings((replace(result, center=bent, verdict=verdict),))
        if finding.code in ("AWAY", "BACKWARDS")
    ]
    assert [finding.code for finding in strays] == ["BACKWARDS", "AWAY"]
    assert {finding.line for finding in strays} == {int(path.numbers[row])}


def test_air_cuts_at_several_places_are_reported_at_the_farthest() -> None:
    """The control runs around the corners of an outside contour, one of them sharper, with lines."""
    text = "G21 F9.\nG0 X-20. Y5.\nG41 D1 G1 X0.\nY40.\nX40.\nX50. Y0.\nX0.\nY10.\nG40 X-20.\nM2\n"
    (result,) = judge_run(run_of(text, "fanuc:a", t1=10.0))
    (away,) = (finding for finding in judged_findings((result,)) if finding.code == "AWAY")
    expected = "The path cuts air at 4 places (lines 4, 5, 6, 7), at most 2.071 off the part, at X 56.063 Y -3.638."
    assert sentence(away, Unit.MM) == expected
    assert away.line == 6


POCKET = "G20 G17 G90\n{load}\nG0 X1.5 Y1.2\nG1 F10.\nG41 X2. Y0.5\nX3.\nY2.\nX0.\nY0.5\nX2.\nG40 X1.5 Y1.2\nM2\n"


@pytest.mark.parametrize("control", ["nine-series:a", "nine-series:b-g39", "nine-series:b-g39.1"])
@pytest.mark.parametrize("load", ["T1 M6", "T1 M6 D0", "T1 M6 D2"])
def test_offset_0_reports_the_depth_of_cut_instead_of_a_wrong_side(control: str, load: str) -> None:
    run = run_of(POCKET.format(load=load), control, t1=0.5, t2=0)
    assert {"WRONG-SIDE", "GOUGE"}.isdisjoint(finding.code for finding in judged_findings(judge_run(run)))
    (radius0,) = findings_of(run, "RADIUS0")
    assert "tool 1, diameter 0.5000, cuts 0.2500 too deep along the contour" in sentence(radius0, Unit.IN)


def test_a_later_negative_offset_is_on_the_wrong_side() -> None:
    program = POCKET.format(load="T1 M6").replace("X3.\n", "X3.\nD9\n")
    assert "WRONG-SIDE" in {
        finding.code for finding in judged_findings(judge_run(run_of(program, "nine-series:a", t9=-0.5)))
    }


GROOVE = (
    "G21 G17 G90 G40 F200\nT1 M6\nG0 X-30. Y20.\nG1 Z-5.\nG41 D1 X-20. Y0.\nX0.\nY-20.\nX6.\nY0.\nX50.\nG40 Y30.\nM30\n"
)


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a", "linuxcnc", "rosettacnc:normal", "nine-series:a"])
def test_a_wall_that_is_cut_before_the_alarm_that_precedes_it_is_gouged(control: str) -> None:
    """The 10 mm cutter runs down one wall of a groove 6 mm wide, 4 mm deep into the other one."""
    run = run_of(GROOVE, control, t1=10.0)
    assert run.stopped_at is not None
    (gouge,) = [finding for finding in judged_findings(judge_run(run)) if finding.severity is Severity.ERROR]
    assert (gouge.code, gouge.line) == ("GOUGE", 7)
    assert gouge.value == pytest.approx(4.0)


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a", "linuxcnc", "rosettacnc:normal"])
def test_moves_after_an_alarm_are_not_walls(control: str) -> None:
    text = "G21 G17 G90 G40 F200\nT1 M6\nG0 X-20. Y-20.\nG1 Z-5.\nG41 D1 X0. Y-10.\nY40.\nX60.\nY0.\nX-10.\nG0 Z50.\n"
    run = run_of(f"{text}X100. Y-10.\nG1 Z-5.\nY40.\nX160.\nG40 Y60.\nM30\n", control, t1=10.0)
    assert run.stopped_at is not None
    assert not {finding.code for finding in judged_findings(judge_run(run))} & {"GOUGE", "WRONG-SIDE"}


CENTER_PATH = (
    "G21 G17 G90 G40 F400\nT1 M6\nG0 X{start} Y20.\nG1 Z-5.\nG41 D1 X-15. Y10.\nG3 X-5. Y20. I0 J10.\nG1 Y40.\n"
    "G2 X0 Y45. I5. J0\nG1 X60.\nG2 X65. Y40. I0 J-5.\nG1 Y0\nG2 X60. Y-5. I-5. J0\nG1 X0\nG2 X-5. Y0 I0 J5.\n"
    "G1 Y20.\nG3 X-15. Y30. I-10. J0\nG40 G1 X{end} Y20.\nM30\n"
)
"""The center path of a 10 mm cutter around a block of 60 by 40 mm, with arcs that lead in and out on tangent."""

WEAR_CONTROLS = ["fanuc:a", "fanuc:b", "haas:a-yasnac", "linuxcnc", "rosettacnc:normal", "nine-series:b"]


@pytest.mark.parametrize("control", WEAR_CONTROLS)
@pytest.mark.parametrize("diameter", [0.02, -0.02])
def test_a_center_path_with_wear_is_clean(diameter: float, control: str) -> None:
    run = run_of(CENTER_PATH.format(start=-25, end=-25), control, t1=diameter)
    assert run.stopped_at is None
    assert not [finding for finding in judged_findings(judge_run(run)) if finding.severity is not Severity.INFO]


@pytest.mark.parametrize("control", ["fanuc:a", "fanuc:b", "haas:a-yasnac"])
@pytest.mark.parametrize("diameter", [0.02, -0.02])
def test_a_center_path_with_wear_that_no_move_leaves_is_clean(diameter: float, control: str) -> None:
    text = CENTER_PATH.replace("G40 G1 X{end} Y20.", "G40\nG28 G91 Z0").format(start=-25)
    run = run_of(text, control, t1=diameter)
    assert run.stopped_at is None
    assert not [finding for finding in judged_findings(judge_run(run)) if finding.severity is not Severity.INFO]


@pytest.mark.parametrize("control", WEAR_CONTROLS)
@pytest.mark.parametrize(("start", "end", "line"), [(20, -25, 5), (-25, 20, 17)])
def test_a_center_path_with_negative_wear_that_begins_or_ends_in_the_part_is_on_the_wrong_side(
    start: int, end: int, line: int, control: str
) -> None:
    run = run_of(CENTER_PATH.format(start=start, end=end), control, t1=-0.02)
    errors = [finding for finding in judged_findings(judge_run(run)) if finding.severity is Severity.ERROR]
    assert [(finding.code, finding.line) for finding in errors] == [("WRONG-SIDE", line)]


@pytest.mark.parametrize("control", WEAR_CONTROLS)
@pytest.mark.parametrize(("link", "lines"), [("X30.\nX85.", {13}), ("Y-30.\nX85.", set())])
def test_a_link_through_the_part_between_two_center_paths_is_on_the_wrong_side(
    link: str, lines: set[int], control: str
) -> None:
    text = "G21 G17 G90 G40 F400\nT1 M6\nG0 X-25. Y20.\nG1 Z-5.\nG41 D1 X-15. Y20.\nX-5.\n"
    text += f"Y45.\nX65.\nY-5.\nX-5.\nY20.\nX-15.\n{link}\nX95. Y20.\nY45.\nX165.\nY-5.\nX95.\nY20.\nX85.\n"
    run = run_of(f"{text}G40 X80.\nM30\n", control, t1=-0.02)
    wrong = {finding.line for finding in judged_findings(judge_run(run)) if finding.code == "WRONG-SIDE"}
    assert wrong == lines


@pytest.mark.parametrize("control", WEAR_CONTROLS)
def test_a_negative_wear_says_what_the_cutter_does_to_an_outline(control: str) -> None:
    run = run_of(CENTER_PATH.format(start=-25, end=-25), control, t1=-0.02)
    (warning,) = [finding for finding in run.findings if "taken for wear" in finding.text]
    assert (warning.severity, warning.line) == (Severity.WARNING, 5)
    assert "If it is the part's outline, the cutter gouges it by half its diameter" in warning.text


@pytest.mark.parametrize("control", WEAR_CONTROLS)
def test_a_larger_negative_radius_is_that_of_a_tool_along_the_outline(control: str) -> None:
    run = run_of(CENTER_PATH.format(start=-25, end=-25), control, t1=-0.6)
    assert "GOUGE" in {finding.code for finding in judged_findings(judge_run(run))}


def test_a_tool_that_is_not_loaded_is_named_only_if_it_is_the_only_one() -> None:
    for control in ("linuxcnc", "rosettacnc", "nine-series:a"):
        (one_tool,) = findings_of(run_of(POCKET.format(load="M3"), control, t3=0.5), "RADIUS0")
        assert "tool 3, diameter 0.5000, cuts 0.2500 too deep" in sentence(one_tool, Unit.IN)
        (two_tools,) = findings_of(run_of(POCKET.format(load="M3"), control, t3=0.5, t4=0.25), "RADIUS0")
        assert "a cutter cuts its own radius too deep along the contour" in two_tools.text


def test_a_wrong_side_with_a_radius_is_reported() -> None:
    run = run_of(POCKET.format(load="T1 M6 D1").replace("G41", "G42"), "nine-series:a", t1=0.5)
    assert "WRONG-SIDE" in {finding.code for finding in judged_findings(judge_run(run))}


def test_a_run_beyond_the_repeat_limit_is_not_judged() -> None:
    run = run_until_given_up("G21 F9\nG41 D1\nG1 X9\no1 while [1]\nX20\nY20\nX0\nY0\no1 endwhile\nM2\n", 500, t1=1)
    assert run.stretches
    assert judge_run(run) == ()
    (limit,) = findings_of(run, "LIMIT")
    assert limit.text.startswith(
        "Subprograms or loops run more than 500 blocks again, long ones counted several times."
    )
    assert "does not judge the run" in limit.text


CHANGED = "G20 G17 G90\nT1 M6\nG0 X-1 Y-1\nG1 F10.\nG41 D1 X0 Y0\nX0 Y2\n{word}\nX0 Y4\nG40 X-1 Y5\nM2\n"


@pytest.mark.parametrize("word", ["D2", "G41 D2"])
@pytest.mark.parametrize("sizes", [(0.5, 0.75), (0.75, 0.5)])
def test_each_radius_is_judged_where_it_is_in_force(word: str, sizes: tuple[float, float]) -> None:
    results = judge_run(run_of(CHANGED.format(word=word), "nine-series:a", t1=sizes[0], t2=sizes[1]))
    assert [round(from_mm(result.stretch.radius, Unit.IN), 9) * 2 for result in results] == [*sizes]
    assert [result.surface.numbers.tolist() for result in results] == [[6.0], [8.0]]
    assert {finding.code for finding in judged_findings(results)} <= {"UNCUT"}


def test_a_radius_set_before_the_first_element_counts_for_the_stretch() -> None:
    text = CHANGED.replace("X0 Y2\n{word}", "D2\nX0 Y2")
    (result,) = judge_run(run_of(text, "nine-series:a", t1=0.5, t2=0.75))
    assert round(from_mm(result.stretch.radius, Unit.IN), 9) == 0.375
    assert not judged_findings((result,))


def test_a_larger_radius_gouges_the_wall_cut_before() -> None:
    """A radius of .375 along the second wall of a .6 slot is .225 from the first wall and gouges it by .15."""
    text = "G20 G17 G90\nM800\nG0 X-1 Y-1\nG1 F10.\nG41 D1 X0 Y0\nY2\nX-.6\nY1.5\nD2\nY0\nG40 X-.225 Y-1\nM2\n"
    results = judge_run(run_of(text, "nine-series:a", t1=0.4, t2=0.75))
    deepest = {gouge.surface_number: gouge.depth for gouge in reversed(results[1].verdict.gouges)}
    assert round(from_mm(deepest[6.0], Unit.IN), 9) == 0.15
    assert 6.0 not in {gouge.surface_number for gouge in results[0].verdict.gouges}
    assert any("surface of line 6" in finding.text for finding in judged_findings(results))


def test_a_subprogram_call_with_another_radius_is_judged_against_other_calls() -> None:
    """The second call runs .3 beside the first and cuts into its material."""
    head = "G20 G17 G90\nM800\nG0 X-1 Y-1\nG1 F10.\nG41 D1 X0 Y0\n"
    text = f"{head}M98 P1\nX5 Y2\nY-1\nX.3\nD2\nY0\nM98 P1\nG40 X-5 Y3\nM2\nO1\nG91 Y2\nG90\nM99\n"
    results = judge_run(run_of(text, "nine-series:a", t1=0.4, t2=0.75))
    line = float(1 + text.split("\n").index("G91 Y2"))
    cut = [gouge.depth for gouge in results[-1].verdict.gouges if gouge.surface_number == line]
    assert any(abs(from_mm(depth, Unit.IN) - 0.3) < 1e-6 for depth in cut)


@pytest.mark.parametrize("control", ["allen-bradley:a", "allen-bradley:b", "fanuc:a", "haas:a"])
def test_rounding_between_equal_positions_is_no_move(control: str) -> None:
    head = "G71 G90 G17" if control.startswith("allen") else "G21 G90 G17"
    text = f"{head} G40\nT1 M6\nG0 X-70. Y-20.\nG1 Z-5. F100.\nG41 D1 X-50. Y-10.\nG1 Y0.\nX0.\n{{}}"
    text += "X50.\nY-10.\nG40 X70.\nM30\n"
    # .1 + .1 + .1 is .30000000000000004
    tenths = run_of(text.format("G91\nX.1\nX.1\nX.1\nG90\nX.3\n"), control, t1=12)
    plain = run_of(text.format("X.1\nX.2\nX.3\n"), control, t1=12)
    assert not deepest_gouge(judge_run(tenths))[0]
    assert tenths.moves.points[-1] == pytest.approx(plain.moves.points[-1])


def test_parts_on_one_side_are_judged_together_before_a_side_change() -> None:
    head = "G20 G17 G90\nM800\nG0 X-1 Y-1\nG1 F10.\nG41 D1 X0 Y0\n"
    text = f"{head}X0 Y2\nX5\nY-1\nX.3\nD2\nY0\nY2\nX-3\n{{side}}X-5 Y3\nX-9\nG40 X-9 Y9\nM2\n"
    changed, same = (
        judge_run(run_of(text.format(side=side), "nine-series:a", t1=0.4, t2=0.75)) for side in ("G42 ", "")
    )
    cuts = [[gouge for result in results for gouge in result.verdict.gouges] for results in (changed, same)]
    assert max(gouge.depth for gouge in cuts[0]) > to_mm(0.2, Unit.IN)
    assert {gouge.surface_number for gouge in cuts[0]} & {6.0}
    assert [finding.line for finding in judged_findings(changed) if finding.code == "SIDES"] == [14]
    assert not [finding for finding in judged_findings(same) if finding.code == "SIDES"]


@pytest.mark.parametrize("control", ["nine-series:a", "nine-series:b"])
def test_a_side_change_reports_that_the_parts_are_judged_separately(control: str) -> None:
    """After the side change the tool cuts 2 into the first wall, which is not judged, so a warning says so."""
    head = "G21 G90 F100\nT1 M6\nG0 X-20 Y-20\nG41 D1 G1 X0 Y0\nX0 Y100\n"
    text = f"{head}{{side}}X50 Y100\nX50 Y50\nX2 Y50\nX2 Y20\nG40 X-40 Y20\nM2\n"
    changed = judged_findings(judge_run(run_of(text.format(side="G42 "), control, t1=10)))
    assert [(finding.line, finding.severity) for finding in changed if finding.code == "SIDES"] == [
        (6, Severity.WARNING)
    ]
    assert "SIDES" not in {
        finding.code for finding in judged_findings(judge_run(run_of(text.format(side=""), control, t1=10)))
    }


@pytest.mark.parametrize("arm", [".2999", ".3"])
def test_an_accepted_uneven_arc_hides_no_gouge_of_another_part(arm: str) -> None:
    """The second part runs .225 beside the first wall with a radius of .375."""
    head = "G20 G17 G90\nM800\nG0 X-1 Y-1\nG1 F10.\nG41 D1 X0 Y0\nY2\n"
    text = f"{head}G3 X-.6 Y2 I-{arm} J0\nG1 Y1.5\nD2\nY0\nG40 X-.225 Y-1\nM2\n"
    results = judge_run(run_of(text, "nine-series:a", t1=0.4, t2=0.75))
    cut, line = deepest_gouge(results)
    assert from_mm(cut, Unit.IN) == pytest.approx(0.15, abs=1e-6)
    assert line == 10
    assert any(
        "surface of line 6" in finding.text
        for finding in judged_findings(results)
        if finding.severity is Severity.ERROR
    )


@pytest.mark.parametrize(("off", "said"), [(".001", []), (".002", [8])])
def test_extra_tolerance_beyond_the_rounding_of_one_arc_is_reported(off: str, said: list[int]) -> None:
    """Two consecutive uneven arcs about two centers: each adds its own radius difference next to the other.

    Each difference alone is within the 0.00254 mm that pass silently.
    """
    wall = f"G3 X-10 Y20{off} I-10 J0\nG3 X-20 Y10 I0 J-10{off}\n"
    text = f"G21 G17 G90\nT1 M6\nG0 X-10 Y-20\nG1 F100\nG41 D1 X0 Y0\nG1 Y10\n{wall}G1 Y0\nG40 X-10 Y-20\nM2\n"
    results = judge_run(run_of(text, "nine-series:a", t1=4.0))
    assert results[0].verdict.clean
    assert results[0].verdict.radius_slack == pytest.approx(2 * float(off), abs=1e-6)
    arcs = [finding for finding in judged_findings(results) if finding.code == "ARC_RADII"]
    assert [finding.line for finding in arcs] == said
    assert all(finding.value == pytest.approx(2 * float(off), abs=1e-6) for finding in arcs)


@pytest.mark.parametrize(("center", "slack"), [(".25", 0.0), (".2502", 0.0004)])
def test_a_lead_gouge_names_the_extra_tolerance(center: str, slack: float) -> None:
    """The last move crosses the lead, an arc whose radii differ by `slack` inches."""
    lead = f"G41 D1 X-.5 Y-.5\nY0\nG2 X0 Y0 I{center} J0\n"
    text = f"G20 G17 G90\nM800\nG0 X-1 Y-1\nG1 F10.\n{lead}G1 Y2\nX2\nY0\nX0\nG40 X-1\nM2\n"
    results = judge_run(run_of(text, "nine-series:a", t1=0.05))
    cut = [finding for finding in judged_findings(results) if finding.code == "LEAD-GOUGE"]
    assert cut
    for finding in cut:
        assert ("extra tolerance" in finding.text) == (slack > 0.0)
        assert [from_mm(length, Unit.IN) for length in finding.lengths] == pytest.approx([slack] if slack else [])


def test_a_lead_that_cannot_be_judged_is_an_error() -> None:
    """The arc of the lead ends on its starting ray: it may be empty or a full circle."""
    head = "G20 G17 G90\nM800\nG0 X-1 Y-1\nG1 F10.\nG41 D1 X-.5 Y0\n"
    lead = "G3 X-.4999 Y0 I.2 J0\nG1 X0 Y0\n"
    text = f"{head}{lead}Y2\nX2\nY0\nX0\nG40 X-1\nM2\n"
    results = judge_run(run_of(text, "nine-series:a", t1=0.05))
    assert results[0].verdict.judged
    assert not results[0].lead_gouges
    unknown = [finding for finding in judged_findings(results) if finding.code == "UNJUDGED"]
    assert [(finding.severity, finding.line) for finding in unknown] == [(Severity.ERROR, 6)]
    assert first_unjudged(results)[0]


SQUARE = "G1 Y5\nX5\nY-5\nX-5\nY0\n"
BLENDED = "G41 D1 G1 X-6.5 Y-1.5\nG3 X-5 Y0 J1.5\n" + SQUARE + "Y.2\nG3 X-6.5 Y1.7 I-1.5\nG40 G1 X-9 Y1\nM2\n"
STRAIGHT = "G41 D1 G1 X-9 Y-1.5\nX-6 Y-.5\nX-5 Y0\n" + SQUARE + "X-6 Y.5\nX-9 Y1.5\nG40 G1 X-12 Y1\nM2\n"


def test_a_tangent_lead_has_no_gouge_and_a_straight_lead_has_one() -> None:
    head = "G20 F9\nG0 X-12 Y-3\n"
    codes = [
        {finding.code for finding in judged_findings(judge_run(run_of(head + text, "linuxcnc", t1=2)))}
        for text in (BLENDED, STRAIGHT)
    ]
    assert ["LEADS" in codes_of_program for codes_of_program in codes] == [True, True]
    assert ["LEAD-GOUGE" in codes_of_program for codes_of_program in codes] == [False, True]


@pytest.mark.parametrize("unit", Unit)
@pytest.mark.parametrize("digits", [0.4, 0.6])
def test_a_gouge_below_half_the_last_digit_is_reported_once_and_does_not_count(unit: Unit, digits: float) -> None:
    """The path is judged with a radius that is larger by `digits` of the last digit of the unit."""
    digit = digits * (1e-4 if unit is Unit.IN else 1e-3)
    code, far = ("G20", 10.0) if unit is Unit.IN else ("G21", 100.0)
    text = f"{code} F9\nG1 X4 Y9\nG41 D1 X4 Y0\nX{far}\nG40 X{far} Y9\n"
    run = run_of(text, "nine-series", t1=1.0)
    radius = run.stretches[0].radius
    shifted = replace(run.stretches[0], radius=radius + to_mm(digit, unit))
    results = judge_run(replace(run, stretches=(shifted,)))
    codes = [finding.code for finding in judged_findings(results)]
    reported = digits > 0.5
    assert ("GOUGE" in codes) == reported
    assert codes.count("DIGIT") == (not reported)
    assert (deepest_gouge(results)[0] > 0.0) == reported


def test_every_control_has_a_name_a_title_and_a_short_description() -> None:
    listed = choices()
    assert {choice.control for choice in listed} == set(names())
    assert all(resolve(choice.name) == choice.control for choice in listed)
    # the selection dialog has this much room on an 80-column terminal
    assert all(choice.title and 0 < len(choice.about) <= 51 for choice in listed)
    first = list(dict.fromkeys(choice.name.partition(":")[0] for choice in listed))
    assert first == ["fanuc", "haas", "linuxcnc", "heidenhain", "rosettacnc", "allen-bradley", "three-block"]
    assert next(choice.title for choice in listed if choice.control == "nine-series:a") == "Allen-Bradley 9/Series"


@pytest.mark.parametrize("control", ["fanuc:a", "fanuc:b", "haas:a", "linuxcnc", "rosettacnc:normal", "nine-series:a"])
@pytest.mark.parametrize("size", [4.0, 10.0, 16.0])
def test_a_full_circle_between_tangent_arcs_is_cut_completely(control: str, size: float) -> None:
    program = (
        "G90 G21 G17 G40\nT1 M6\nS2000 M3\nG0 X-60. Y-10.\nG1 Z-5. F200\nG41 D1 X-40. Y-10. F300\n"
        "G3 X-30. Y0 R10.\nG2 X-30. Y0 I30. J0\nG3 X-40. Y10. R10.\nG1 G40 X-60.\nM30\n"
    )
    run = run_of(program, control, t1=size)
    assert run.stopped_at is None
    (result,) = judge_run(run)
    assert result.verdict.uncut_length == pytest.approx(0.0, abs=1e-6)
    assert not result.verdict.gouges


@pytest.mark.parametrize(
    ("load", "radius"), [("G91 L12 P1 R.2", 5.2), ("G90 L12 P1 R.2", 0.2), ("G91 L13 P1 R.2", 5.2)]
)
def test_an_incremental_radius_adds_to_that_of_the_tool(load: str, radius: float) -> None:
    run = run_of(
        f"G21 G17 G90 F300\nT1 M6\nG0 Y-20.\nG10 {load}\nG90\nG41 D1 X10.\nY50.\nG40 X0.\nM30\n", "fanuc:a", t1=10.0
    )
    assert [stretch.radius for stretch in run.stretches] == [pytest.approx(radius)]


def test_a_place_in_another_plane_names_the_axes_of_the_plane() -> None:
    program = "G21 G18 G90 F100\nT1 M6\nG0 X-20. Z-20.\nG42 D1\nG1 X0. Z0.\nZ50.\nX.5\nZ52.\nX30.\nG40 Z60.\nM30\n"
    cut = [finding for finding in judged_findings(judge_run(run_of(program, "fanuc:a", t1=12.0))) if finding.at]
    assert cut
    assert all("at Z {x} X {y}" in finding.text for finding in cut)


@pytest.mark.parametrize(
    ("side", "corners", "line", "words"),
    [
        (
            "G42",
            ((0, 15), (20, 0), (20, 20), (0, 20), (0, 0)),
            8,
            "The contour begins on this line. The last {value} is taken for lead-out.",
        ),
        (
            "G41",
            ((0, 0), (0, 20), (20, 20), (20, 0), (0, 15)),
            5,
            "The contour ends on this line. The first {value} is taken for lead-in.",
        ),
    ],
)
def test_a_contour_whose_end_is_in_the_middle_of_a_wall_may_be_mistyped(
    side: str, corners: tuple[tuple[int, int], ...], line: int, words: str
) -> None:
    """The wall at X0 runs 15 past the point where the other end meets it."""
    (_, y), *further = corners
    walls = "".join(f"X{x} Y{y}\n" for x, y in further)
    text = f"G21 G90 F9\nT1 M6\nG0 X-30 Y{y}\n{side} D1 G1 X0 Y{y}\n{walls}G40 X-30\nM2\n"
    (finding,) = [one for one in judged_findings(judge_run(run_of(text, "linuxcnc", t1=2.0))) if one.code == "OVER_RUN"]
    assert (finding.severity, finding.line) == (Severity.WARNING, line)
    assert finding.value == pytest.approx(15.0)
    assert finding.text.startswith(words)
