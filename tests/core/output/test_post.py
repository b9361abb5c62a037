import re
from itertools import pairwise

import pytest

from core.comp.compensated import CenterPath
from core.controls.write.written_program import Posted, Refusal
from core.finding import Finding, Severity
from core.geometry.piece import Turn
from core.output.nc import center_path_program, comments
from core.output.objections import OVERRIDE_PHRASE
from core.output.passes import Cutter, Floor, Job, passes
from core.program.model import Coolant
from core.units import Unit, located_sentence
from tests.core.output.jobs import INCH, arc, floors, job, path_of, polyline

SLOT = path_of(polyline((0, 0), (1, 0))[0], arc((1, 0), (1.5, 0.5), (1, 0.5), Turn.CCW))
GOUGE = Finding("GOUGE", Severity.ERROR, "Gouges by {value} at X {x} Y {y}.", 2, at=(25.4, 0.0), value=2.54)


def text(posted_job: Job, unit: Unit = Unit.IN, override: str | None = None, name: str = "SLOT") -> str:
    result = center_path_program([posted_job], unit, name=name, override=override)
    assert isinstance(result, Posted), result
    return result.text


def refused(refused_job: Job, override: str | None = None) -> list[str]:
    result = center_path_program([refused_job], Unit.IN, name="SLOT", override=override)
    assert isinstance(result, Refusal)
    return [finding.code for finding in result.findings]


def test_a_whole_program_is_written_in_inches():
    slot = job(SLOT, peck_depth=0.0, comp="LEFT", lookahead="USR 4", notes=("A NOTE",))
    assert text(slot).splitlines() == [
        "(PROGRAM SLOT)",
        "(WRITTEN BY CUTCOMP.  THE PATH IS THAT OF THE TOOL CENTER: NO G41 OR G42)",
        "(UNITS INCH)",
        "(TOOL 1 END MILL DIAMETER 0.5000)",
        "(BLOCK 1 MILL CONTOUR CUTTER COMP. LEFT LOOKAHEAD USR 4)",
        "(Z 0.0000 TO -0.2500)",
        "(A NOTE)",
        "(G64 P0.0002: CORNER TOLERANCE 0.0002)",
        "G17 G20 G40 G49 G54 G80 G90 G91.1 G94",
        "G64 P0.0002",
        "T1 M6",
        "S300 M3",
        "(BLOCK 1 PASS 1 OF 1 Z -0.2500)",
        "G0 G43 H1 Z1.0",
        "G0 X0.0 Y0.0",
        "G0 Z0.1",
        "G1 Z-0.25 F20.0",
        "G1 X1.0 F10.0",
        "G3 X1.5 Y0.5 I0.0 J0.5",
        "G0 Z1.0",
        "M5",
        "M30",
    ]


@pytest.mark.parametrize(
    ("coolants", "words"),
    [
        ((Coolant.OFF, Coolant.OFF), []),
        ((Coolant.FLOOD, Coolant.FLOOD), ["M8", "M9"]),
        ((Coolant.MIST, Coolant.FLOOD), ["M7", "M9", "M8", "M9"]),
        ((Coolant.FLOOD, Coolant.OFF), ["M8", "M9"]),
    ],
)
def test_coolant_is_switched_where_it_changes_and_off_at_the_end(coolants: tuple[Coolant, ...], words: list[str]):
    jobs = [job(SLOT, block=number, coolant=coolant) for number, coolant in enumerate(coolants, 1)]
    result = center_path_program(jobs, Unit.IN, name="SLOT")
    assert isinstance(result, Posted)
    assert [line for line in result.text.splitlines() if line in ("M7", "M8", "M9")] == words


def head(part: str) -> list[str]:
    result = center_path_program([job(SLOT)], Unit.IN, name="SLOT", part=part)
    assert isinstance(result, Posted)
    return result.text.splitlines()


def test_the_part_name_is_in_the_second_line():
    assert head("HOUSING 7")[:3] == [
        "(PROGRAM SLOT)",
        "(PART HOUSING 7)",
        "(WRITTEN BY CUTCOMP.  THE PATH IS THAT OF THE TOOL CENTER: NO G41 OR G42)",
    ]
    assert head("   ") == head("")
    assert not any(line.startswith("(PART") for line in head(""))


@pytest.mark.parametrize(
    "part",
    [
        "A)\nG0 X9 Y9",
        "(MSG, hi) M3",
        "\x1b[31m\r\n%",
        ", M30",
        "TEIL \u00f6 \u4e2d \ud800",
        "N\u0085G1 X1\u2028M2 ",
        "x" * 300,
    ]
    + [f"{'y' * 60} MSG, G1 X{number}" for number in range(8, 16)],
)
def test_a_part_name_never_becomes_code(part):
    """A part name stays in plain comments at the head and changes nothing else in the file."""
    lines, plain_lines = head(part), head("")
    added = lines[1 : len(lines) - len(plain_lines) + 1]
    assert lines == [plain_lines[0], *added, *plain_lines[1:]]
    for line in added:
        assert re.fullmatch(r"\([ -&*-~]+\)", line)
        assert not re.match(r"\(\s*[A-Za-z_]+\s*,", line)


def test_the_program_is_written_in_millimeters():
    lines = text(job(SLOT, peck_depth=0.0, work_offset=56), Unit.MM).splitlines()
    assert "G17 G21 G40 G49 G56 G80 G90 G91.1 G94" in lines
    assert "G3 X38.1 Y12.7 I0.0 J12.7" in lines
    assert "G1 Z-6.35 F508.0" in lines


def test_the_finish_tool_is_called_after_the_spindle_stops():
    both = job(SLOT, rough=(CenterPath(SLOT, offset=0.0),), finisher=Cutter(7, 12.7, "BALL"), finish_tool=7)
    lines = [line for line in text(both).splitlines() if re.match(r"[TMS]|G0 (G43 H\d )?Z1\.0", line)]
    assert lines == [
        "T1 M6",
        "S300 M3",
        "G0 G43 H1 Z1.0",
        "G0 Z1.0",
        "M5",
        "T7 M6",
        "S300 M3",
        "G0 G43 H7 Z1.0",
        "G0 Z1.0",
        "M5",
        "M30",
    ]


def test_a_second_block_with_the_same_tool_keeps_it_and_clears_both():
    """The Z START of the second block is above SAFE Z, so every traverse is raised."""
    high = job(SLOT, block=2, speed=500.0, z_start=2 * INCH, peck_depth=0.0)
    result = center_path_program([job(SLOT, peck_depth=0.0), high], Unit.IN, name="TWO")
    assert isinstance(result, Posted)
    lines = result.text.splitlines()
    assert lines.count("T1 M6") == 1
    assert "S500" in lines
    assert "(SAFE Z 1.0000 RAISED TO 2.1000)" in lines
    assert "(THAT IS RETRACT CLEARANCE 0.1000 OVER Z START 2.0000)" in lines
    assert "G0 Z1.0" not in lines
    assert [line for line in lines if line.endswith("Z2.1")] == ["G0 G43 H1 Z2.1", "G0 Z2.1", "G0 Z2.1"]


def test_rapids_never_move_z_together_with_x_or_y():
    for line in text(job(SLOT)).splitlines():
        assert not (line.startswith("G0") and "Z" in line and ("X" in line or "Y" in line))


def test_posted_coordinates_are_accurate_to_half_the_last_digit():
    third = polyline((1 / 3, 1 / 7), (2 / 3, 10 / 7), (-1 / 9, 1e-6))
    for unit, digit in ((Unit.IN, 25.4e-5), (Unit.MM, 1e-4)):
        part = job(third, peck_depth=0.0)
        (cut,) = passes(part)
        places = positions(text(part, unit), INCH if unit is Unit.IN else 1.0)
        expected = [(motion.x, motion.y, motion.z) for motion in cut.motions]
        assert len(places) == len(expected)
        for place, expected_place in zip(places, expected, strict=True):
            assert max(abs(a - b) for a, b in zip(place, expected_place, strict=True)) <= digit / 2 + 1e-12


def positions(nc: str, scale: float) -> list[tuple[float, float, float]]:
    """The position in millimeters after each line that moves, once X, Y and Z are known."""
    place: dict[str, float] = {}
    places = []
    for line in nc.splitlines():
        words = dict(re.findall(r"([XYZ])(-?[\d.]+)", line)) if re.match(r"G[0-3] ", line) else {}
        place |= {axis: float(value) * scale for axis, value in words.items()}
        if words and len(place) == 3:
            places.append((place["X"], place["Y"], place["Z"]))
    return places


def test_moves_that_vanish_in_rounding_are_omitted_without_accumulating_error():
    """A thousand steps of a twentieth of the last digit end at the right place."""
    steps = polyline(*((number * 5e-8, 0.0) for number in range(1001)))
    lines = [line for line in text(job(steps, peck_depth=0.0)).splitlines() if line.startswith("G1 X")]
    assert lines[-1] == "G1 X0.00005"
    assert len(lines) == 50


def test_a_full_circle_is_one_line():
    ring = path_of(arc((1, 0), (1, 0), (0, 0), Turn.CW))
    assert "G2 X1.0 Y0.0 I-1.0 J0.0 F10.0" in text(job(ring)).splitlines()


def test_the_feed_of_an_omitted_move_does_not_take_effect():
    """The second segment is too short to write; its feed must not stay for the third."""
    path = polyline((0, 0), (1, 0), (1.0000001, 0), (2, 0))
    given = tuple(floor for floor in floors(3))
    slow = given[1].__class__(2, given[1].z_start, given[1].z_end, 1.0)
    lines = text(job(path, floors=(given[0], slow, given[2]), peck_depth=0.0))
    assert [line for line in lines.splitlines() if line.startswith("G1 X")] == ["G1 X1.0 F10.0", "G1 X2.0"]


@pytest.mark.parametrize("override", [None, "", "post with gouge", "YES", OVERRIDE_PHRASE + " "])
def test_a_gouge_is_refused_without_the_exact_override(override):
    assert refused(job(SLOT, findings=(GOUGE,)), override) == ["GOUGE"]


def test_an_overridden_gouge_stands_in_the_header():
    result = center_path_program([job(SLOT, findings=(GOUGE,))], Unit.IN, name="SLOT", override=OVERRIDE_PHRASE)
    assert isinstance(result, Posted)
    assert result.overridden == (GOUGE,)
    assert "(OVERRIDDEN GOUGE: Segment 2: Gouges by 0.1000 at X 1.0000 Y 0.0000.)" in result.text
    assert "(OVERRIDDEN BY THE OPERATOR: POST WITH GOUGE)" in result.text


def test_an_override_leaves_no_trace_when_there_is_nothing_to_override():
    assert "OVERRIDDEN" not in text(job(SLOT), override=OVERRIDE_PHRASE)


@pytest.mark.parametrize("code", ["UNREAD", "MISSING", "TOOL_MISSING", "ARC_RADII", "ANYTHING_NEW"])
def test_unknown_values_cannot_be_overridden(code):
    finding = Finding(code, Severity.ERROR, "Not known.")
    assert refused(job(SLOT, findings=(finding, GOUGE)), OVERRIDE_PHRASE) == [code]


def test_warnings_do_not_prevent_posting():
    assert "M30" in text(job(SLOT, findings=(Finding("GOUGE", Severity.WARNING, "Near."),)))


NAN, INFINITE = float("nan"), float("inf")


@pytest.mark.parametrize(
    ("changes", "code"),
    [
        ({"cutter": None}, "TOOL_MISSING"),
        ({"finish_tool": 3}, "TOOL_MISSING"),
        ({"cutter": Cutter(1, 0.0)}, "TOOL_DIAMETER"),
        ({"cutter": Cutter(1, NAN)}, "TOOL_DIAMETER"),
        ({"cutter": Cutter(0, 1.0)}, "TOOL_NUMBER"),
        ({"z_bottom": 1.0, "floors": floors(2, z=1.0)}, "DEPTH"),
        ({"floors": floors(2, z=-0.5)}, "Z_END"),
        ({"finisher": Cutter(2, 1.0), "finish_tool": 2, "finish_z": 0.25 * INCH}, "FINISH_Z"),
        ({"finisher": Cutter(2, 1.0), "finish_tool": 2, "comp": "LEFT"}, "NO_ROUGH_PATH"),
        ({"retract_clearance": 0.0}, "CLEARANCE"),
        ({"peck_clearance": -1.0}, "CLEARANCE"),
        ({"peck_depth": -0.1}, "PECK_DEPTH"),
        ({"peck_depth": 1e-4}, "PECK_DEPTH"),
        ({"z_start": NAN}, "NUMBER"),
        ({"safe_z": INFINITE}, "NUMBER"),
        ({"speed": 1e300}, "NUMBER"),
        ({"speed": 0.0}, "SPEED"),
        ({"work_offset": 53}, "WORK_OFFSET"),
        ({"finish": ()}, "NO_PATH"),
        ({"finish": (CenterPath(polyline((0, 0), (NAN, 0))),)}, "COORDINATE"),
        ({"finish": (CenterPath(polyline((0, 0), (1e9, 0))),)}, "COORDINATE"),
        ({"plunge_feed": 0.0}, "PLUNGE_FEED"),
        ({"plunge_feed": 1e-9}, "PLUNGE_FEED"),
        ({"floors": floors(1)}, "FEED"),
        ({"floors": floors(2, feed=0.0)}, "FEED"),
    ],
)
def test_a_job_that_cannot_be_cut_is_refused_and_cannot_be_overridden(changes, code):
    assert code in refused(job(SLOT, **changes))
    assert code in refused(job(SLOT, **changes), OVERRIDE_PHRASE)


def sentence_of(code: str, **changes: object) -> str:
    """The sentence of the finding with this code that refuses a job with these changes."""
    result = center_path_program([job(SLOT, **changes)], Unit.IN, name="SLOT")
    assert isinstance(result, Refusal)
    (finding,) = (finding for finding in result.findings if finding.code == code)
    return located_sentence(finding, Unit.IN)


def test_segments_without_a_feed_are_named_up_to_six():
    path = polyline(*((x, 0) for x in range(8)))
    for count, listed in ((1, "segment 1"), (6, "segments 1, 2, 3, 4, 5, 6"), (7, "segments 1, 2, 3, 4, 5, 6 ...")):
        given = (*floors(count, feed=0.0), *floors(7)[count:])
        sentence = sentence_of("FEED", surface=path, finish=(CenterPath(path),), floors=given)
        assert sentence == f"Block 1: There is no FEED above 0 on {listed}."


@pytest.mark.parametrize(
    ("allowed", "refused_changes", "code"),
    [
        ({"cutter": Cutter(99999, 12.7)}, {"cutter": Cutter(100000, 12.7)}, "TOOL_NUMBER"),
        ({"cutter": Cutter(1, 1e-3)}, {"cutter": Cutter(1, -1e-3)}, "TOOL_DIAMETER"),
        ({"work_offset": 54}, {"work_offset": 53}, "WORK_OFFSET"),
        ({"work_offset": 59}, {"work_offset": 60}, "WORK_OFFSET"),
        ({"peck_depth": 0.25 * INCH / 1999.0}, {"peck_depth": 0.25 * INCH / 2001.0}, "PECK_DEPTH"),
        ({"peck_clearance": 0.0}, {"peck_clearance": -1e-6}, "CLEARANCE"),
        ({"retract_clearance": 1e-6}, {"retract_clearance": 0.0}, "CLEARANCE"),
        ({"z_bottom": 0.0, "floors": floors(2, z=0.0)}, {"z_bottom": 1e-6, "floors": floors(2, z=1.0)}, "DEPTH"),
        ({"floors": floors(2, z=0.0)}, {"floors": floors(2, z=1e-4)}, "Z_END"),
        ({"floors": floors(2, z=-0.25)}, {"floors": floors(2, z=-0.2501)}, "Z_END"),
        ({"speed": 0.1}, {"speed": 0.0}, "SPEED"),
        ({"safe_z": 1e6}, {"safe_z": 1e12}, "NUMBER"),
    ],
)
def test_limits_are_posted_and_values_beyond_them_refused(allowed, refused_changes, code):
    assert isinstance(center_path_program([job(SLOT, **allowed)], Unit.IN, name="SLOT"), Posted)
    assert code in refused(job(SLOT, **refused_changes))


def test_finish_z_must_leave_some_depth_for_the_roughing_tool():
    both = {"finisher": Cutter(2, 1.0), "finish_tool": 2}
    assert "M30" in text(job(SLOT, **both, finish_z=0.2499 * INCH))
    assert refused(job(SLOT, **both, finish_z=0.25 * INCH)) == ["FINISH_Z"]
    assert "M30" in text(job(SLOT, finish_z=0.25 * INCH))


def test_a_field_with_an_error_gets_no_second_error():
    unread = Finding("UNREAD", Severity.ERROR, "x is not a number.", field="speed")
    assert refused(job(SLOT, speed=0.0, findings=(unread,))) == ["UNREAD"]
    assert refused(job(SLOT, finish=(), findings=(unread,))) == ["UNREAD"]
    assert refused(job(SLOT, finish=(), findings=(GOUGE,))) == ["GOUGE", "NO_PATH"]


def test_whole_speeds_have_no_decimals_and_a_change_is_written_once():
    slow, fast = job(SLOT, peck_depth=0.0, speed=1234.5), job(SLOT, block=2, speed=600.0)
    result = center_path_program([slow, fast], Unit.IN, name="TWO")
    assert isinstance(result, Posted)
    assert [line for line in result.text.splitlines() if line.startswith("S")] == ["S1234.5 M3", "S600"]


def test_the_header_names_the_peck_depth_if_there_is_one():
    assert "(BLOCK 1 MILL CONTOUR CUTTER COMP. ON Z 0.0000 TO -0.2500 PECK 0.1000)" in text(job(SLOT))
    assert "PECK" not in text(job(SLOT, peck_depth=0.0))


def test_the_header_names_the_roles_of_the_tools():
    both = job(SLOT, finisher=Cutter(7, 6.35, "BALL"), finish_tool=7)
    lines = text(both).splitlines()
    assert "(TOOL 1 END MILL DIAMETER 0.5000 ROUGH)" in lines
    assert "(TOOL 7 BALL DIAMETER 0.2500 FINISH)" in lines


def test_rapids_move_up_then_across_then_down():
    lines = text(job(SLOT)).splitlines()
    first = lines.index("(BLOCK 1 PECK 1 OF 3 Z -0.1000)")
    assert lines[first + 1 : first + 12] == [
        "G0 G43 H1 Z1.0",
        "G0 X0.0 Y0.0",
        "G0 Z0.1",
        "G1 Z-0.1 F20.0",
        "G1 X1.0 F10.0",
        "G3 X1.5 Y0.5 I0.0 J0.5",
        "G0 Z0.1",
        "(BLOCK 1 PECK 2 OF 3 Z -0.2000)",
        "G0 X0.0 Y0.0",
        "G0 Z-0.05",
        "G1 Z-0.2 F20.0",
    ]


def test_a_helix_split_in_two_climbs_evenly():
    """Nearly a full turn is written in two halves; the first ends halfway up."""
    almost = path_of(arc((1, 0), (1, -1e-5), (0, 0), Turn.CCW))
    climbing = (Floor(1, -0.25 * INCH, -0.05 * INCH, 254.0),)
    lines = text(job(almost, floors=climbing, peck_depth=0.0)).splitlines()
    assert [line for line in lines if line.startswith("G3")] == [
        "G3 X-1.0 Y0.000005 Z-0.15 I-1.0 J0.0 F10.0",
        "G3 X1.0 Y-0.00001 Z-0.05 I1.0 J-0.000005",
    ]


def test_a_bottom_above_the_top_is_reported_once():
    assert refused(job(SLOT, z_bottom=1.0, floors=floors(2, z=1.0))) == ["DEPTH"]


def test_a_program_without_blocks_is_refused():
    assert isinstance(center_path_program([], Unit.IN, name=""), Refusal)


def test_a_refusal_says_why_in_program_units():
    result = center_path_program([job(SLOT, findings=(GOUGE,), speed=0.0)], Unit.IN, name="")
    assert isinstance(result, Refusal)
    assert result.text == "Block 1, segment 2: Gouges by 0.1000 at X 1.0000 Y 0.0000. Block 1: SPEED must be above 0."


def test_blocks_with_different_work_offsets_are_refused():
    result = center_path_program([job(SLOT), job(SLOT, work_offset=55)], Unit.IN, name="")
    assert isinstance(result, Refusal)
    assert [finding.code for finding in result.findings] == ["WORK_OFFSET"]


def test_every_line_is_short_plain_text():
    program = text(job(SLOT, findings=()), name="Kontur (Ø 12) \n" * 40)
    assert program.isascii()
    assert all(0 < len(line) < 256 for line in program.splitlines())
    assert all(first != second for first, second in pairwise(program.splitlines()) if first.startswith("G"))


def test_a_long_comment_does_not_end_between_an_axis_and_its_number():
    for lead in range(50, 75):
        lines = list(comments(f"{'A' * lead} X 10.000 Y 32.000 Z -1.5 AND MORE WORDS"))
        assert not any(line.rstrip(")").endswith((" X", " Y", " Z")) for line in lines)
        assert max(map(len, lines)) <= 78
