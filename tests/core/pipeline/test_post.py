"""Programs posted for compensating controls are read back and measured."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from app.documents.files import load
from core.controls.control_names import display_name
from core.controls.control_run import ControlRun
from core.controls.control_tools import ToolTable
from core.controls.judging.judged_findings import judged_findings
from core.controls.judging.judged_runs import judge_run
from core.controls.registry import NO_TOOLS, names, run
from core.controls.write.written_program import Posted, Refusal
from core.geometry.distance import distance
from core.geometry.path import Path as Line
from core.geometry.piece_arrays import at, piece_arrays
from core.output.passes import passes
from core.pipeline import post
from core.pipeline.derive import derive
from core.pipeline.derived import Derived
from core.pipeline.jobs import jobs
from core.pipeline.post import post_center_path, post_control_program
from core.program.model import (
    ArcSegment,
    Block,
    CutterComp,
    Direction,
    LineSegment,
    Number,
    PathChoice,
    Program,
    ProgramParameters,
    changed,
)
from core.units import Unit, from_mm
from tests import rs274
from tests.core.controls.some_controls import FIRST_VARIANTS
from tests.core.pipeline.parts import MID_SIDE_SQUARE, NOTCH, OVER_RUN_SQUARE, block, program
from tests.tool_tables import end_mills

EXAMPLES = sorted((Path(__file__).parents[3] / "app" / "examples").glob("*.toml"))
BLENDS = ProgramParameters(blend_offset=Number(0.125), blend_overlap=Number(0.125))
SQUARE = replace(block(MID_SIDE_SQUARE, CutterComp.RIGHT), peck_depth=Number(0.1))

ROUND = replace(
    SQUARE,
    x_start=Number(3.0),
    y_start=Number(1.0),
    segments=(ArcSegment(Direction.CCW, Number(3.0), Number(1.0), x_center=Number(1.0), y_center=Number(1.0)),),
)
"""A disk of radius 2: it has no corner that a control could take differently."""


@cache
def derived_program(typed: Program) -> Derived:
    return derive(typed)


def derived(*blocks: Block, parameters: ProgramParameters = BLENDS) -> Derived:
    return derived_program(program(*blocks, parameters=parameters))


@cache
def derived_example(example: Path) -> Derived:
    return derive(load(example))


def posted(part: Derived, control: str) -> Posted:
    result = post_control_program(part, name="PART", control=control)
    assert isinstance(result, Posted), result
    return result


def table(part: Program, text: str) -> ToolTable:
    """The tools of the program and the offsets in its header."""
    diameters = {tool.number: tool.diameter.value for tool in part.tools if isinstance(tool.diameter, Number)}
    for line in text.splitlines():
        if line.startswith("(OFFSET D"):
            words = line.split()
            diameters[int(words[1][1:])] = 2 * float(words[3].strip(",)"))
    return end_mills(diameters, part.unit)


def apart(first: Line, second: Line) -> float:
    """The largest distance of the ends and middles of one path's pieces from another path."""
    pieces, onto = piece_arrays(first), piece_arrays(second)
    places = np.concatenate([at(pieces, np.full(len(pieces), part)) for part in (0.0, 0.5, 1.0)])
    rows, place_rows = np.tile(np.arange(len(onto)), len(places)), np.arange(len(places)).repeat(len(onto))
    distances = distance(onto.take(rows), places.take(place_rows)).reshape(len(places), len(onto))
    return float(distances.min(axis=1).max())


def runs_of(text: str, control: str, tools: ToolTable, unit: Unit) -> list[Line]:
    """The paths of a program's compensated runs without their entry and exit moves."""
    made = run(text.encode(), control, tools, unit)
    assert isinstance(made, ControlRun)
    assert made.stopped_at is None, made.findings
    paths = [made.moves.part(stretch.first, stretch.last).path() for stretch in made.stretches]
    return paths if control == "klartext" else [path.part(1, len(path) - 1) for path in paths]


@pytest.mark.parametrize("control", names())
@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_every_example_reads_back_or_is_refused_with_a_reason(example: Path, control: str) -> None:
    part = derived_example(example)
    result = post_control_program(part, name=example.stem, control=control)
    if isinstance(result, Refusal):
        assert example.stem in ("notch", "overrun-square", "pocket")
        assert all(finding.segment is not None for finding in result.findings)
        return
    unit = part.program.unit
    tools = NO_TOOLS if control in ("klartext", "threeblock") else table(part.program, result.text)
    wanted = [one.compensated.with_leads for each in part.blocks for one in each.paths.rough]
    wanted += [each.paths.compensated.with_leads for each in part.blocks]
    allowed = 0.006 + sum(note.lengths[0] for note in result.notes if note.code == "DIFFERS")
    for path in runs_of(result.text, control, tools, unit):
        assert any(apart(path, one) <= allowed and apart(one, path) <= allowed for one in wanted)


@pytest.mark.parametrize("control", names())
@pytest.mark.parametrize("side", [CutterComp.LEFT, CutterComp.PROFILE_LEFT])
def test_the_judge_finds_a_square_that_starts_at_its_corner_clean(side: CutterComp, control: str) -> None:
    """Both blend arcs begin and end at one point."""
    corners = ((0.0, 0.0), (0.0, 3.0), (5.0, 3.0), (5.0, 0.0), (0.0, 0.0))
    part = derived(replace(block(corners, side), peck_depth=Number(0.1)))
    result = post_control_program(part, name="PART", control=control)
    assert isinstance(result, Posted), result
    tools = NO_TOOLS if control in ("klartext", "threeblock") else table(part.program, result.text)
    made = run(result.text.encode(), control, tools, part.program.unit)
    assert isinstance(made, ControlRun)
    results = judge_run(made)
    assert results
    assert [result.verdict.clean for result in results] == [True] * len(results)


@pytest.mark.parametrize("control", ["linuxcnc", "fanuc:a", "klartext"])
def test_the_header_lists_deleted_segments(control: str) -> None:
    """The cutter cannot reach a short chamfer: the program has a sharp corner, which a smaller tool would cut."""
    chamfered = ((2.0, 0.0), (3.9, 0.0), (4.0, 0.1), (4.0, 4.0), (0.0, 4.0), (0.0, 0.0), (2.0, 0.0))
    result = post_control_program(derived(block(chamfered, CutterComp.LEFT)), name="PART", control=control)
    assert isinstance(result, Posted), result
    assert "DELETED BY THE LOOK-AHEAD: SEGMENT 2" in result.text
    assert "AS TYPED" not in result.text
    (left_out,) = (note for note in result.notes if note.code == "LEFT_OUT")
    assert left_out.lengths == (12.7,)
    plain = post_control_program(derived(SQUARE), name="PART", control=control)
    assert "AS TYPED" in plain.text
    assert "LEFT_OUT" not in {note.code for note in plain.notes}


def test_a_refusal_names_the_rule_the_line_and_the_segment() -> None:
    inside = derived(block(MID_SIDE_SQUARE, CutterComp.LEFT))
    result = post_control_program(inside, name="PART", control="rosettacnc:nist")
    assert isinstance(result, Refusal)
    assert result.text.startswith("Block 1, segment 2: rosettacnc:nist stops at line")
    assert "rule C6" in result.text


def test_a_refusal_without_a_line_names_the_block() -> None:
    small = block(((0.3, 0), (0.6, 0), (0.6, 0.6), (0, 0.6), (0, 0), (0.3, 0)), CutterComp.LEFT)
    blends = replace(BLENDS, blend_offset=Number(0.0), blend_overlap=Number(0.0))
    result = post_control_program(derived(small, small, parameters=blends), name="PART", control="linuxcnc")
    assert isinstance(result, Refusal)
    assert [finding.block for finding in result.findings] == [1, 2]
    assert result.text.startswith("Block 1: There is no room for the straight move into the cut")


@pytest.mark.parametrize("control", ["nine-series:a", "fanuc:a"])
def test_a_difference_names_its_block_if_there_are_several(control: str) -> None:
    result = posted(derived(ROUND, SQUARE), control)
    # the move into the square comes through the edge of the disk around it
    assert [(note.code, note.block) for note in result.notes] == [("DIFFERS", 2), ("OTHER_BLOCK", 2)]
    assert f"(NOTE DIFFERS BLOCK 2 SEGMENT {result.notes[0].segment:g}: " in result.text


def test_an_alarm_of_the_control_names_its_block() -> None:
    inside = block(MID_SIDE_SQUARE, CutterComp.LEFT)
    result = post_control_program(derived(ROUND, inside), name="PART", control="rosettacnc:nist")
    assert isinstance(result, Refusal)
    assert result.text.startswith("Block 2, segment 2: rosettacnc:nist stops at line")


def test_the_header_notes_where_the_control_differs() -> None:
    result = posted(derived(SQUARE), "nine-series:a")
    assert [note.code for note in result.notes] == ["DIFFERS"]
    assert "(NOTE DIFFERS SEGMENT" in result.text
    assert "by up to 0.1036" in " ".join(result.text.replace(")\n(", " ").split())
    assert "(OFFSET D1 RADIUS 0.2500 OF TOOL 1)" in result.text


def test_each_peck_is_a_separate_compensated_run() -> None:
    result = posted(derived(SQUARE), "linuxcnc")
    assert result.text.count("G42 D1") == 3
    plunges = [line.split()[1] for line in result.text.splitlines() if line.startswith("G1 Z")]
    assert plunges == ["Z-0.1", "Z-0.2", "Z-0.25"]
    assert result.text.count("G0 Z-0.05\n") == 1


@pytest.mark.parametrize("control", FIRST_VARIANTS)
def test_a_program_never_rapids_across_the_part_below_its_top(control: str) -> None:
    """This covers pecks, the move to the next block, and the end at SAFE Z."""
    part = derived(SQUARE, SQUARE)
    text = posted(part, control).text
    made = run(text.encode(), control, NO_TOOLS if control == "klartext" else table(part.program, text), Unit.IN)
    assert isinstance(made, ControlRun)
    points, rapid = made.moves.points, made.moves.rapid
    across = np.any(points[1:, :2] != points[:-1, :2], axis=1) & rapid[1:]
    assert across.any()
    assert (np.minimum(points[1:, 2], points[:-1, 2])[across] >= 0.0).all()
    assert points[-1, 2] == pytest.approx(25.4)


@pytest.mark.parametrize("control", names())
def test_an_over_run_posted_for_a_control_reads_back_as_an_over_run(control: str) -> None:
    """The blend arcs before the first element and after the last one are leads too."""
    _, _, made = posted_and_run(program(block(OVER_RUN_SQUARE, CutterComp.RIGHT), parameters=BLENDS), control)
    results = judge_run(made)
    codes = [finding.code for finding in judged_findings(results)]
    assert codes.count("OVER_RUN") == 1, codes
    assert {"GOUGE", "CROSSES", "UNCUT", "WRONG-SIDE"}.isdisjoint(codes), codes


def test_nothing_is_posted_with_an_error() -> None:
    result = post_control_program(derived(block(NOTCH, CutterComp.LEFT)), name="PART", control="threeblock")
    assert isinstance(result, Refusal)
    assert "GOUGE" in {finding.code for finding in result.findings}


def test_changing_heights_under_compensation_and_best_are_refused() -> None:
    best = derived(SQUARE, parameters=replace(BLENDS, path=PathChoice.BEST))
    climbing = replace(SQUARE, segments=(changed(SQUARE.segments[0], {"z_end": Number(-0.1)}), *SQUARE.segments[1:]))
    for part, word in ((best, "BEST"), (derived(climbing), "Z END")):
        result = post_control_program(part, name="PART", control="linuxcnc")
        assert isinstance(result, Refusal)
        assert any(word in finding.text for finding in result.findings), result


def climbing() -> Block:
    """An uncompensated square whose first side climbs."""
    plain = replace(block(MID_SIDE_SQUARE, CutterComp.ON), peck_depth=Number(0.1))
    return replace(plain, segments=(changed(plain.segments[0], {"z_end": Number(-0.1)}), *plain.segments[1:]))


def arc(way: Direction, end: tuple[float, float], height: float, center: tuple[float, float]) -> ArcSegment:
    """An arc that climbs or falls to a height."""
    (x, y), (cx, cy) = map(Number, end), map(Number, center)
    return ArcSegment(way, x_end=x, y_end=y, z_end=Number(height), x_center=cx, y_center=cy)


HELIX = replace(
    block(((2.0, 0.0),), CutterComp.ON),
    segments=(
        arc(Direction.CCW, (0.0, 2.0), -0.05, (0.0, 0.0)),
        arc(Direction.CW, (1.0, 3.0), -0.2, (1.0, 2.0)),
    ),
)


def posted_and_run(typed: Program, control: str) -> tuple[Derived, str, ControlRun]:
    part = derived_program(typed)
    text = posted(part, control).text
    made = run(text.encode(), control, NO_TOOLS if control == "threeblock" else table(typed, text), typed.unit)
    assert isinstance(made, ControlRun)
    assert made.stopped_at is None
    return part, text, made


@pytest.mark.parametrize("control", FIRST_VARIANTS)
@pytest.mark.parametrize("of", [climbing(), HELIX], ids=["lines", "helices"])
def test_on_runs_on_the_contour_at_every_height(of: Block, control: str) -> None:
    part, text, made = posted_and_run(program(of), control)
    assert not {"G41", "G42", "RL", "RR"} & set(text.split())
    assert not made.stretches
    assert control == "threeblock" or "NOTHING" in text
    wanted = [motion for job in jobs(part) for one in passes(job) for motion in one.motions if not motion.rapid]
    feeds = [move for move in made.moves if not move.rapid]
    ends = [(move.point, move.turn) for move, before in zip(feeds, [None, *feeds], strict=False) if move != before]
    assert [turn for _, turn in ends] == [int(motion.turn) for motion in wanted]
    places = np.array([(motion.x, motion.y, motion.z) for motion in wanted])
    assert np.array([point for point, _ in ends]) == pytest.approx(places, abs=0.006)


@pytest.mark.parametrize("control", FIRST_VARIANTS)
def test_a_block_with_on_may_stand_between_blocks_with_compensation(control: str) -> None:
    part, _, made = posted_and_run(program(SQUARE, climbing(), SQUARE, parameters=BLENDS), control)
    assert len(made.stretches) == 6
    assert [each.block.cutter_comp for each in part.blocks].count(CutterComp.ON) == 1


NEARLY = [0.0005, 0.001, 0.004, 359.9, 359.998, 359.9985, 360.0]


def circling(sweep: float, unit: Unit, comp: CutterComp, direction: Direction) -> Program:
    """A line and an arc of `sweep` degrees about a center one unit above the end of the line."""
    scale = 1.0 if unit is Unit.IN else 25.4
    first = LineSegment(length=Number(2.0 * scale), angle=Number(45.0), feed=Number(8.0 * scale))
    x, y = (round(value * scale, 4) for value in (1.4142, 2.4142))
    around = ArcSegment(direction, x_center=Number(x), y_center=Number(y), sweep=Number(sweep))
    plain = changed(block(((0.0, 0.0),), comp), {"z_bottom": Number(-0.25 * scale), "plunge_feed": Number(5.0 * scale)})
    made = program(replace(plain, segments=(first, around)), parameters=ProgramParameters(blend_offset=Number(0.0)))
    return replace(made, unit=unit, tools=(replace(made.tools[0], diameter=Number(0.5 * scale)),))


@pytest.mark.parametrize("control", FIRST_VARIANTS)
@pytest.mark.parametrize("direction", list(Direction))
@pytest.mark.parametrize("unit", list(Unit))
@pytest.mark.parametrize("sweep", NEARLY)
def test_an_arc_that_ends_near_its_start_keeps_its_length_on_every_control(
    sweep: float, unit: Unit, direction: Direction, control: str
) -> None:
    """Only a full circle may be read as one; the read-back measures the path that the control runs."""
    part = derived_program(circling(sweep, unit, CutterComp.ON, direction))
    result = post_control_program(part, name="PART", control=control)
    assert isinstance(result, Posted), result
    tools = NO_TOOLS if control in ("klartext", "threeblock") else table(part.program, result.text)
    made = run(result.text.encode(), control, tools, unit)
    assert isinstance(made, ControlRun)
    assert made.stopped_at is None
    path = made.moves.path()
    fed = np.isin(path.numbers, made.moves.lines[~made.moves.rapid])
    assert path.lengths[fed].sum() == pytest.approx(part.blocks[0].paths.surface.lengths.sum(), abs=0.01)
    circles = (path.turns != 0) & (path.points[:-1] == path.points[1:]).all(axis=1)
    assert circles.sum() == (sweep == 360.0)


@pytest.mark.parametrize("control", FIRST_VARIANTS)
@pytest.mark.parametrize(
    ("unit", "side"),
    [(Unit.IN, (CutterComp.LEFT, Direction.CCW)), (Unit.MM, (CutterComp.RIGHT, Direction.CW))],
)
@pytest.mark.parametrize("sweep", [0.0005, 0.001, 0.004, 359.998])
def test_no_program_compensates_an_arc_that_ends_near_its_start(
    sweep: float, side: tuple[CutterComp, Direction], unit: Unit, control: str
) -> None:
    """Such an arc becomes a line, or nothing is posted."""
    result = post_control_program(derived_program(circling(sweep, unit, *side)), name="PART", control=control)
    if isinstance(result, Posted):
        assert re.search(r"G0?[23][XYIJ ]| C [XY]", result.text) is None


@pytest.mark.parametrize("control", ["threeblock", "nine-series:a"])
@pytest.mark.parametrize("unit", list(Unit))
def test_an_arc_that_a_control_runs_as_a_full_circle_is_refused(
    unit: Unit, control: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The read-back finds the arc however it got into the program."""
    monkeypatch.setattr(post, "_travels", tuple)
    part = derived_program(circling(0.001, unit, CutterComp.ON, Direction.CW))
    result = post_control_program(part, name="PART", control=control)
    assert isinstance(result, Refusal)
    assert f"{display_name(control)} ends line" in result.text


def test_a_work_offset_that_cannot_be_written_is_reported() -> None:
    plain = program(SQUARE, parameters=BLENDS)
    moved = derive(replace(plain, setup=replace(plain.setup, work_offset=Number(55))))
    assert "G55" in posted(moved, "linuxcnc").text.split("\n(")[-1]
    assert [note.code for note in posted(moved, "threeblock").notes] == ["WORK_OFFSET"]


@pytest.mark.parametrize("example", [path for path in EXAMPLES if path.stem in ("flange", "plate-mm")], ids=str)
def test_linuxcnc_runs_its_posted_program_as_cutcomp_does(example: Path, tmp_path: Path) -> None:
    part = derive(load(example))
    result = posted(part, "linuxcnc")
    unit = part.program.unit
    scale = 1.0 if unit is Unit.IN else 25.4
    tools = {tool.number: tool.diameter.value / scale for tool in part.program.tools}
    witness = rs274.run(result.text, tools, tmp_path)
    assert witness.accepted, witness.said
    ours = run(result.text.encode(), "linuxcnc", table(part.program, result.text), unit)
    assert isinstance(ours, ControlRun)
    wanted = [[from_mm(value, unit) for value in point] for point in ours.moves.points[1:].tolist()]
    made = [list(move[1:4]) for move in witness.moves]
    assert _distinct(made) == pytest.approx(np.array(_distinct(wanted)), abs=1e-4)


def _distinct(points: list[list[float]]) -> np.ndarray:
    """The points without repetitions and without the first two, which are unknown."""
    kept = [points[0]]
    for point in points[1:]:
        if max(abs(a - b) for a, b in zip(point, kept[-1], strict=True)) > 2e-4:
            kept.append(point)
    return np.array(kept[2:])


@pytest.mark.parametrize("control", FIRST_VARIANTS)
def test_every_program_starts_with_the_part_name(control: str) -> None:
    """The other blocks stay the same; a control whose text holds no comments gets a note."""
    plain = program(SQUARE, SQUARE, parameters=BLENDS)
    named = derived_program(replace(plain, setup=replace(plain.setup, name="Teil ö) ; M30 (7")))
    with_name, without_name = posted(named, control), posted(derived_program(plain), control)
    lines, lines_without_name = with_name.text.splitlines(), without_name.text.splitlines()
    codes = [note.code for note in with_name.notes if note.code == "PART_NAME"]
    if control == "threeblock":
        assert (lines, codes) == (lines_without_name, ["PART_NAME"])
        return
    at = 3 if control.startswith(("fanuc", "haas")) else 2 if control == "klartext" else 1
    comment = "PART Teil oe] , M30 [7"
    assert lines[at] == (f"{at} ; {comment}" if control == "klartext" else f"({comment})")
    assert codes == []
    bare = [line.partition(" ")[2] if control == "klartext" else line for line in lines]
    assert [*bare[:at], *bare[at + 1 :]] == [
        line.partition(" ")[2] if control == "klartext" else line for line in lines_without_name
    ]


def test_a_name_that_no_control_accepts_is_changed() -> None:
    result = post_control_program(derive(program(SQUARE, parameters=BLENDS)), name="Teil 7 ;) ö", control="klartext")
    assert isinstance(result, Posted)
    assert result.text.startswith("0 BEGIN PGM Teil-7----oe INCH\n")
    assert result.text.isascii()


def island_in_a_pocket(start: float, y: float) -> Program:
    """A pocket 4.2 by 2 that starts on its lower side, and a round island of 0.3 about X 2.6 and this Y."""
    corners = ((start, 0), (4.2, 0), (4.2, 2), (0, 2), (0, 0), (start, 0))
    circle = ArcSegment(Direction.CW, Number(2.3), Number(y), x_center=Number(2.6), y_center=Number(y))
    island = changed(block(((2.3, y), (2.3, y)), CutterComp.LEFT), {"segments": (circle,)})
    return program(block(corners, CutterComp.LEFT), island, parameters=BLENDS)


@pytest.mark.parametrize("control", ["fanuc:a", "linuxcnc", "haas:a", "threeblock"])
@pytest.mark.parametrize(("start", "y"), [(1.0, 1.0), (2.6, 1.2), (2.6, 1.0)])
def test_leads_of_a_control_keep_clear_of_an_island(control: str, start: float, y: float) -> None:
    """The block's own path is clean; only the control's straight move into the cut could cross the island.

    LinuxCNC's must be longer than the tool's radius: below the nearer island there is no room for it.
    """
    cuts = control == "linuxcnc" and (start, y) == (2.6, 1.0)
    derived = derive(island_in_a_pocket(start, y))
    assert not [finding for each in derived.blocks for finding in each.findings if finding.code == "OTHER_BLOCK"]
    posted = post_control_program(derived, name="island", control=control)
    assert isinstance(posted, Posted), posted
    notes = [finding for finding in posted.notes if finding.code == "OTHER_BLOCK"]
    # the judge of NC programs finds the same cuts in the text
    made = run(posted.text.encode(), control, end_mills({1: 0.5}), Unit.IN)
    assert isinstance(made, ControlRun)
    depths = [cut.gouge.depth for result in judge_run(made) for cut in result.cuts_into_others]
    assert ("NOTE OTHER_BLOCK BLOCK 1: " in posted.text) == cuts
    if not cuts:
        assert (notes, depths) == ([], [])
        return
    (note,) = notes
    assert note.block == 1
    assert "the contour of block 2" in note.text
    assert note.value == pytest.approx(max(depths))


def test_a_posted_file_says_which_block_cuts_into_another() -> None:
    """The island is 0.4 from the pocket's left wall and the cutter 0.5 across: each path cuts 0.1 into the other."""
    pocket = block(((1, 0), (4, 0), (4, 3), (0, 3), (0, 0), (1, 0)), CutterComp.LEFT)
    near = block(((0.4, 1), (0.4, 2), (2, 2), (2, 1), (0.4, 1)), CutterComp.LEFT)
    derived = derive(program(pocket, near, parameters=BLENDS))
    for posted in (
        post_center_path(derived, name="part"),
        post_control_program(derived, name="part", control="fanuc:a"),
    ):
        assert isinstance(posted, Posted), posted
        text = " ".join(posted.text.replace("(", "").replace(")", "").split())
        cut = "NOTE OTHER_BLOCK The path of segment 4 cuts 0.1000 into the contour of block 2 at X 0.4000 "
        assert cut in text
        assert text.count("NOTE OTHER_BLOCK") == 2
