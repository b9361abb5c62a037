"""NC import: posted control programs and center paths come back as their contours."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache
from math import pi
from pathlib import Path

import pytest

from core.controls.compared_contours import apart
from core.controls.control_tools import CutterTool, ToolTable, table_of
from core.controls.write.written_program import Posted
from core.geometry.path import Path as GeometryPath
from core.geometry.piece import Piece, Side
from core.importing.nc import read_nc
from core.importing.nc_contour import CenterPathTool, NcError, NcProgram, nc_blocks
from core.importing.segments import DoesNotFitError
from core.pipeline.derive import derive
from core.pipeline.derived import Derived
from core.pipeline.post import post_center_path, post_control_program
from core.program.file.read import loads
from core.program.model import CutterComp, Number, Program
from core.units import Unit, from_mm
from tests.core.controls.some_controls import ENTRY_VARIANTS

EXAMPLES = sorted((Path(__file__).parents[3] / "app" / "examples").glob("*.toml"))
POSTED = [example for example in EXAMPLES if example.stem in ("flange", "overrun-square", "plate-mm")]
"""The examples that can be posted for controls: the others gouge or lose segments to the look-ahead."""

CASES = [(example, control) for example in POSTED for control in ENTRY_VARIANTS]


TOOLS = table_of(CutterTool(1, 4.0, unit=Unit.MM))


def program(example: Path) -> Program:
    return loads(example.read_text(), example.name)


@cache
def derived_example(example: Path) -> tuple[Program, Derived]:
    original = program(example)
    return original, derive(original)


def tools_of(part: Program) -> ToolTable:
    """The tools of a program, in its unit."""
    sizes = [(tool.number, tool.diameter) for tool in part.tools]
    return table_of(
        *(CutterTool(number, size.value, unit=part.unit) for number, size in sizes if isinstance(size, Number))
    )


def offsets_in(text: str, unit: Unit) -> ToolTable:
    """The offsets that the header of a program lists."""
    rows = re.findall(r"OFFSET D(\d+) RADIUS ([\d.]+)", text)
    return table_of(*(CutterTool(int(number), 2 * float(radius), unit=unit) for number, radius in rows))


def largest_difference(first: tuple[Piece, ...], second: tuple[Piece, ...]) -> float:
    """The largest distance of starts, middles and ends of pieces; infinite if the counts differ."""
    if len(first) != len(second):
        return float("inf")
    return max(
        abs(complex(*piece.point_at(share)) - complex(*other_piece.point_at(share)))
        for piece, other_piece in zip(first, second, strict=True)
        for share in (0.0, 0.5, 1.0)
    )


def surfaces(derived: Derived) -> list[tuple[Piece, ...]]:
    return [tuple(piece for _, piece in block.solved.pieces) for block in derived.blocks]


def imported(read: NcProgram) -> Program:
    """A program with only the blocks of an NC program."""
    part, _ = nc_blocks(Program(unit=read.unit), read)
    return part


@pytest.mark.parametrize(("example", "control"), CASES, ids=lambda case: getattr(case, "stem", case))
def test_a_posted_control_program_is_imported_as_its_contour(example: Path, control: str) -> None:
    original, derived = derived_example(example)
    posted = post_control_program(derived, name=example.stem, control=control)
    assert isinstance(posted, Posted), posted.text
    tools = {**tools_of(original), **offsets_in(posted.text, original.unit)}
    read = read_nc(posted.text.encode(), control, tools)
    again = imported(read)
    back = surfaces(derive(again))
    assert len(back) == len(derived.blocks)
    for contour, surface in zip(back, surfaces(derived), strict=True):
        assert largest_difference(contour, surface) <= 0.001
    for block, first in zip(again.blocks, original.blocks, strict=True):
        assert block.cutter_comp.value in first.cutter_comp.value
        assert block.z_bottom == first.z_bottom


CUT = [example for example in EXAMPLES if example.stem != "notch"]
"""The examples whose path does not gouge."""


@pytest.mark.parametrize("example", CUT, ids=lambda path: path.stem)
def test_a_posted_center_path_is_imported_as_a_contour_with_that_path(example: Path) -> None:
    original = program(example)
    # one pass at one radius: the path of one contour
    single = replace(
        original,
        blocks=tuple(
            replace(block, cutter_comp=_plain(block.cutter_comp), finish_tool=None) for block in original.blocks
        ),
    )
    derived = derive(single)
    posted = post_center_path(derived, name="x")
    assert isinstance(posted, Posted), posted.text
    block = derived.blocks[0]
    assert block.side is not None
    assert block.radius is not None
    center = CenterPathTool(block.side, from_mm(2.0 * block.radius, single.unit))
    read = read_nc(posted.text.encode(), "linuxcnc", tools_of(single), center=center)
    assert len(read.contours) == len(derived.blocks)
    again = derive(imported(read))
    assert again.blocks[0].paths is not None
    path = block.paths.loops[0].path
    back = again.blocks[0].paths.loops[0].path
    assert apart(path, back, 0.002) is None
    assert apart(back, path, 0.002) is None
    assert block.paths.compensated is not None
    if not len(block.paths.compensated.deleted):
        assert _covers(back_surface(again), back_surface(derived))


def back_surface(derived: Derived) -> GeometryPath:
    paths = derived.blocks[0].paths
    assert paths is not None
    return paths.surface


def _covers(first: GeometryPath, second: GeometryPath) -> bool:
    return apart(first, second, 0.001) is None and apart(second, first, 0.001) is None


def _plain(comp: CutterComp) -> CutterComp:
    return CutterComp(comp.value.removeprefix("PROFILE "))


SQUARE = b"G21 G90 G17\nT1 M6\nS900 M3\nG0 X-10 Y0\nG1 Z-2 F100\n%s\nG1 X20 Y0\nX20 Y20\nX0 Y20\nX0 Y0\n%s\nM30\n"


def test_a_second_round_trip_changes_nothing() -> None:
    example = next(path for path in EXAMPLES if path.stem == "flange")
    original = program(example)
    tools = tools_of(original)
    programs = [original]
    for _ in range(2):
        posted = post_control_program(derive(programs[-1]), name="x", control="linuxcnc")
        assert isinstance(posted, Posted)
        programs.append(imported(read_nc(posted.text.encode(), "linuxcnc", tools)))
    assert programs[1].blocks == programs[2].blocks


def test_even_depth_steps_become_pecks_and_feeds_stay_with_their_segments() -> None:
    ring = b"G1 Z%d F50\nG41 D1 X0 Y0 F200\nX20 Y0\nX20 Y20 F300\nX0 Y20\nX0 Y0\nG40 X-10 Y-10\nG0 X-10 Y-10\n"
    text = b"G21 G90 G17\nT1 M6\nS900 M3\nG0 X-10 Y-10\n" + ring % -2 + ring % -4 + ring % -6 + b"M30\n"
    read = read_nc(text, "linuxcnc", TOOLS)
    assert len(read.contours) == 1
    block = imported(read).blocks[0]
    assert (block.z_bottom, block.peck_depth, block.z_start) == (Number(-6.0), Number(2.0), Number(0.0))
    assert (block.tool, block.speed, block.plunge_feed) == (Number(1.0), Number(900.0), Number(50.0))
    assert [segment.feed for segment in block.segments] == [Number(200.0), Number(300.0), None, None]
    assert block.cutter_comp is CutterComp.LEFT


def test_an_imported_contour_adds_its_tool() -> None:
    text = b"G21 G90 G17\nT7 M6\nG0 X-9 Y-9\nG1 G41 D7 X0 Y0 F200\nX20 Y0\nX20 Y20\nX0 Y0\nG40 X-9 Y-9\nM30\n"
    part = imported(read_nc(text, "linuxcnc", table_of(CutterTool(7, 6.0))))
    assert part.blocks[0].tool == Number(7.0)
    assert [tool.diameter for tool in part.tools if tool.number == 7] == [Number(6.0)]


def test_a_tool_selected_for_the_next_change_is_not_the_contours_tool() -> None:
    moves = b"S900 M3\nG0 X-9 Y-9\nT7\nG1 G41 D1 X0 Y0 F200\nX20 Y0\nX20 Y20\nX0 Y0\nG40 X-9 Y-9\nM30\n"
    tools = table_of(CutterTool(1, 4.0), CutterTool(7, 6.0))
    (contour,) = read_nc(b"G21 G90 G17\nT1 M6\n" + moves, "linuxcnc", tools).contours
    assert (contour.tool, contour.speed) == (1, 900.0)


def test_the_tool_and_speed_of_a_klartext_contour_are_those_of_its_tool_call() -> None:
    moves = b"L X-9 Y-9 R0 FMAX\nL X+0 Y+0 RL F200\nL X+20\nL Y+20\nL X+0 Y+0\nL X-9 Y-9 R0\nEND PGM A MM\n"
    calls = b"BEGIN PGM A MM\nTOOL DEF 3 L+0 R+2\nTOOL CALL 3 Z S1800\nTOOL CALL S2500\n"
    (contour,) = read_nc(calls + moves, "klartext", {}).contours
    assert (contour.tool, contour.speed) == (3, 2500.0)


def test_a_center_path_needs_side_and_diameter() -> None:
    text = SQUARE % (b"G1 X0 Y0", b"")
    with pytest.raises(NcError, match="its side and the tool's diameter are needed"):
        read_nc(text, "linuxcnc", TOOLS)
    read = read_nc(text, "linuxcnc", TOOLS, center=CenterPathTool(None, 4.0))
    assert len(read.contours[0].pieces) == 5
    assert imported(read).blocks[0].cutter_comp is CutterComp.ON
    # the inside of the square is to the left of its travel
    inside = read_nc(text, "linuxcnc", TOOLS, center=CenterPathTool(Side.LEFT, 4.0))
    corners = {tuple(round(value, 6) for value in piece.start) for piece in inside.contours[0].pieces}
    assert corners == {(10.0, -2.0), (-2.0, -2.0), (-2.0, 22.0), (22.0, -2.0), (22.0, 22.0)}


@pytest.mark.parametrize(
    ("text", "size", "reason"),
    [
        ("G18\nG1 Z1 F100\nG2 X3 Z1 I1.5 K0\n", 4.0, "Line 4: an arc outside of the XY plane cannot be imported"),
        (
            "G18\nG41 D1 G1 X9 Z9 F100\nX20\nG40 X30\n",
            None,
            "Line 4: the contour is in the ZX plane; only XY can be imported",
        ),
        ("G0 X5\nG1 Z-1 F100\n", 4.0, "The program has no move in the XY plane at a feed"),
        ("G0 X2\nG2 X2 I-2 F100\n", 4.0, "Line 3: the path only turns about a point; there is no contour"),
        ("G1 X10 F100\nX0\n", 4.0, "Line 3: two pieces of the contour do not meet; no contour has this path"),
        # a step of half the radius to the tool's side
        ("G1 X10 F100\nY1\nX20\n", 4.0, r"Line 3: no contour has this path; the nearest one is \d+\.\d{3} mm off"),
    ],
)
def test_a_program_without_a_contour_is_refused_with_the_reason(text: str, size: float | None, reason: str) -> None:
    program = f"G21 G90 G17 G0 X0 Y0 Z0\n{text}M30\n".encode()
    center = None if size is None else CenterPathTool(Side.LEFT, size)
    with pytest.raises(NcError, match=f"^{reason}"):
        read_nc(program, "linuxcnc", TOOLS, center=center)


def test_a_control_that_is_not_known_is_refused() -> None:
    with pytest.raises(NcError, match=r"^No such control\. Choose one of: fanuc:a, "):
        read_nc(b"M30\n", "there-is-none", TOOLS)


# radius 3; the arcs of the contour have 0.5.  Their offsets meet where the surfaces do not: lines lead into the corner.
BENDS = {
    "line, arc": ("G1 X0 Y3", ["G1 X7.627719 Y3 F90", "G2 X10.5 Y4.5 I2.872281 J-2", "G1 X20"]),
    "arc, line": ("G1 X-20 Y4.5", ["G1 X-10.5 F90", "G2 X-7.627719 Y3 I0 J-3.5", "G1 X0"]),
    "arc, arc": ("G1 X-6.5 Y0", ["G2 X0 Y1.802776 I3.5 J0 F90", "G2 X6.5 Y0 I3 J-1.802776"]),
}


@pytest.mark.parametrize(
    ("name", "starts"),
    [
        ("line, arc", [(0, 0), (9.194418, 0), (10.089674, 1.285714), (10.5, 1.5)]),
        ("arc, line", [(-20, 1.5), (-10.5, 1.5), (-10.089674, 1.285714), (-9.194418, 0)]),
        ("arc, arc", [(-3.5, 0), (-2.571429, 0.257540), (0, -4.021577), (2.571429, 0.257540)]),
    ],
)
def test_a_corner_that_the_tool_does_not_reach_is_closed_by_tangents(
    name: str, starts: list[tuple[float, float]]
) -> None:
    start, moves = BENDS[name]
    text = "\n".join(["G21 G90 G17 G0 X-30 Y9", start.replace("G1", "G0"), "G1 Z-1 F50", *moves, "M30\n"])
    (contour,) = read_nc(text.encode(), "linuxcnc", TOOLS, center=CenterPathTool(Side.LEFT, 6.0)).contours
    assert [piece.start for piece in contour.pieces] == [pytest.approx(point, abs=1e-5) for point in starts]


def test_an_arc_smaller_than_the_tool_is_refused_with_its_line() -> None:
    text = b"G21 G90 G17 G0 X0 Y0\nG1 Z-1 F100\nG1 X10 Y0\nG2 X12 Y-2 I0 J-2\nG1 X12 Y-20\nM30\n"
    with pytest.raises(NcError, match=r"Line 4: an arc of the path is smaller than the tool"):
        read_nc(text, "linuxcnc", {}, center=CenterPathTool(Side.LEFT, 10.0))


DATA = Path(__file__).parents[2] / "data"
PROGRAMS = sorted(path for path in DATA.rglob("*") if path.suffix.lower() in (".nc", ".ngc", ".h"))
SIZES = table_of(*(CutterTool(number, 10.0, unit=Unit.MM) for number in range(1, 60)))


@pytest.mark.parametrize(
    "center", [None, CenterPathTool(Side.LEFT, 2.0), CenterPathTool(None, 2.0)], ids=["own", "left", "on"]
)
def test_any_program_gives_contours_or_a_reason(center: CenterPathTool | None) -> None:
    imported_count, refusals = 0, list[str]()
    for path in PROGRAMS[::3]:
        text = path.read_bytes()
        for control in ("linuxcnc", "klartext", "nine-series:a"):
            try:
                nc_blocks(Program(), read_nc(text, control, SIZES, center=center))
            except (NcError, DoesNotFitError) as error:
                refusals.append(str(error))
            else:
                imported_count += 1
    assert imported_count >= 5
    assert all(refusals)


def test_an_alarm_names_the_line() -> None:
    with pytest.raises(NcError, match="stops at line 2"):
        read_nc(b"G21 G90 G17\nG41 D9 G1 X1 F100\nM30\n", "linuxcnc", {})
    with pytest.raises(NcError, match=r"^three-block stops at line 2"):
        read_nc(b"G17G71G40G90\nG2X1.\n", "threeblock", {})


@pytest.mark.parametrize(("control", "lines"), [("fanuc:a", "5 to 6"), ("nine-series", "4 to 5")])
def test_a_contour_whose_offset_changes_on_the_way_is_refused_with_the_place(control: str, lines: str) -> None:
    """Fanuc reaches the offset of D2 at the end of its block, the nine-series before it."""
    text = b"G21 G90 G17\nG0 X-9. Y-9.\nG1 G42 D1 X0. Y0. F100\nX20.\nD2 Y20.\nX0.\nY0.\nG40 X-9. Y-9.\nM30\n"
    tools = table_of(CutterTool(1, 4.0, unit=Unit.MM), CutterTool(2, 5.0, unit=Unit.MM))
    with pytest.raises(NcError, match=f"^The side or the radius of the tool changes .*, from line {lines}[.]"):
        read_nc(text, control, tools)


def test_the_unit_of_the_program_is_kept() -> None:
    text = b"G20 G90 G17\nG0 X0 Y0\nG1 Z-.1 F10\nX1.\nY1.\nM30\n"
    read = read_nc(text, "linuxcnc", {}, center=CenterPathTool(None, 1.0))
    assert read.unit is Unit.IN
    block = imported(read).blocks[0]
    assert block.segments[0].x_end == Number(1.0)
    assert block.segments[0].feed == Number(10.0)


OPEN_WITH_LEADS = b"""G21 G90 G17 G40
T1 M6
S1000 M3
G0 X-20 Y10
G0 Z2
G1 Z-1 F100
G1 G41 D1 X-5 Y5 F200
G3 X0 Y0 I5 J0
G1 X30 Y0
G1 X30 Y30
G3 X25 Y35 I-5 J0
G1 G40 X10 Y45
M2
"""


def test_quarter_circles_taken_as_leads_of_an_open_contour_are_reported() -> None:
    read = read_nc(OPEN_WITH_LEADS, "linuxcnc", TOOLS)
    assert len(read.contours[0].pieces) == 2
    _, items = nc_blocks(Program(unit=read.unit), read)
    assert any(
        "quarter circles of lines 8 and 11 are taken for lead-in and lead-out" in note for note in items[0].notes
    )


@pytest.mark.parametrize(
    "text", ["G2 X20. Y0 I20. J0\nG2 X-19.9239 Y1.7431 I-20. J0\n", "G2 I20. J0\nG2 X-19.9239 Y1.7431 I20. J0\n"]
)
def test_a_circle_that_runs_past_its_start_is_imported_as_one_lap(text: str) -> None:
    whole = (
        f"G21 G17 G40 G90 F400\nT1 M6\nG0 X-50. Y-15.\nG41 G1 X-35. Y-15.\nG3 X-20. Y0 I0 J15.\n{text}"
        "G3 X-33.5594 Y17.9934 I-14.9429 J1.3073\nG40 G1 X0 Y60.\nM2\n"
    )
    (contour,) = read_nc(whole.encode(), "linuxcnc", TOOLS).contours
    assert contour.closed
    assert abs(sum(piece.length for piece in contour.pieces) - 40.0 * pi) < 1e-3
