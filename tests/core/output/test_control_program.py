"""Programs for compensating controls: header, remarks and refusals, from hand-made jobs."""

from __future__ import annotations

from dataclasses import replace

import pytest

from core.comp.compensate import compensate
from core.comp.compensated import CenterPath
from core.controls.control_names import display_name
from core.controls.write.contour_pass import CenterMove, CompensatedPass, PassToWrite, UncompensatedPass
from core.controls.write.written_program import Posted, Refusal
from core.finding import Finding, Severity
from core.geometry.piece import Side
from core.output.control_program import control_program, control_program_errors
from core.output.passes import Floor, Job
from core.program.model import Coolant
from core.units import Unit
from tests.core.output.jobs import INCH, job, polyline

SQUARE = polyline((1, 0), (2, 0), (2, 2), (0, 2), (0, 0), (1, 0))


def cut(stock: float = 0.0, tool: int = 1, diameter: float = 0.5) -> CompensatedPass:
    """A run around the square's outside at 10 inches a minute, with blend moves of 0.125; inches."""
    radius = (diameter / 2 + stock) * INCH
    compensated = compensate(SQUARE, Side.RIGHT, radius, 8, closed=True, blend=0.125 * INCH, overlap=0.125 * INCH)
    return CompensatedPass(
        compensated=compensated, tool=tool, diameter=diameter * INCH, stock=stock * INCH, speed=300.0,
        feeds={number: 10.0 * INCH for number in range(1, 6)}, plunge_feed=20.0 * INCH,
        travel=INCH, near=0.1 * INCH, depth=-0.25 * INCH, leave=INCH,
    )  # fmt: skip


def plain() -> UncompensatedPass:
    """A run along a line without compensation."""
    travels = (
        CenterMove(0.0, 0.0, INCH, None, 0, (0.0, 0.0)),
        CenterMove(0.0, 0.0, 0.1 * INCH, None, 0, (0.0, 0.0)),
        CenterMove(0.0, 0.0, -0.25 * INCH, 20.0 * INCH, 0, (0.0, 0.0)),
        CenterMove(2.0 * INCH, 0.0, -0.25 * INCH, 10.0 * INCH, 0, (0.0, 0.0)),
        CenterMove(2.0 * INCH, 0.0, INCH, None, 0, (0.0, 0.0)),
    )
    return UncompensatedPass(
        travels=travels, tool=1, diameter=0.5 * INCH, stock=0.0, speed=300.0, feeds={1: 10.0 * INCH},
        plunge_feed=20.0 * INCH, travel=INCH, near=0.1 * INCH, depth=-0.25 * INCH, leave=INCH,
    )  # fmt: skip


def square(**changes: object) -> Job:
    return job(SQUARE, comp="RIGHT", finish=(CenterPath(cut().compensated.path),), peck_depth=0.0, **changes)


def posted(
    control: str,
    *cuts: PassToWrite,
    jobs: tuple[Job, ...] = (),
    name: str = "KEY",
    part: str = "",
) -> Posted:
    result = control_program(jobs or (square(),), cuts or (cut(),), Unit.IN, name=name, control=control, part=part)
    assert isinstance(result, Posted), result
    return result


def refused(*jobs: Job, control: str = "linuxcnc") -> Refusal:
    result = control_program(jobs, [cut() for _ in jobs], Unit.IN, name="KEY", control=control)
    assert isinstance(result, Refusal)
    return result


CONTOUR = [
    "G1 Z-0.25 F20.",
    "G42 D1 G1 X0.625 Y-0.375 F10.",
    "G2 X1. Y0. I0.375 J0.",
    "G1 X2. Y0.",
    "G1 X2. Y2.",
    "G1 X0. Y2.",
    "G1 X0. Y0.",
    "G1 X1. Y0.",
    "G1 X1.125 Y0.",
    "G2 X1.5 Y-0.375 I0. J-0.375",
    "G40 G1 X1.25 Y-0.875",
    "G0 Z1.",
]


def test_a_whole_program_is_written_for_linuxcnc() -> None:
    result = posted("linuxcnc", name="key way/1", part="PART; 7")
    assert result.notes == ()
    assert result.text.splitlines() == [
        "(PROGRAM key way/1)",
        "(PART PART, 7)",
        "(WRITTEN BY CUTCOMP FOR linuxcnc: THE CONTOUR AS TYPED, THE CONTROL)",
        "(COMPENSATES)",
        "(UNITS INCH)",
        "(TOOL 1 DIAMETER 0.5000: THE CONTROL'S TABLE MUST SAY THE SAME)",
        "(BLOCK 1 MILL CONTOUR CUTTER COMP. RIGHT Z 0.0000 TO -0.2500)",
        "G17 G20 G40 G49 G54 G80 G90 G91.1 G94",
        "G64 P0.0002",
        "T1 M6",
        "S300 M3",
        "G0 G43 H1 Z1.",
        "G0 X0.625 Y-0.875",
        "G0 Z0.1",
        *CONTOUR,
        "M5",
        "M30",
    ]


def test_a_whole_program_is_written_in_klartext() -> None:
    result = posted("klartext", name="key way/1", part="PART 7")
    assert result.text.splitlines()[:16] == [
        "0 BEGIN PGM key-way-1 INCH",
        "1 ; PROGRAM key way/1",
        "2 ; PART PART 7",
        "3 ; WRITTEN BY CUTCOMP FOR heidenhain: THE CONTOUR AS TYPED, THE CONTROL",
        "4 ; COMPENSATES",
        "5 ; UNITS INCH",
        "6 ; TOOL 1 DIAMETER 0.5000",
        "7 ; BLOCK 1 MILL CONTOUR CUTTER COMP. RIGHT Z 0.0000 TO -0.2500",
        "8 ; NOTE FEED_UNIT F is in inches per minute. A control that takes tenths of",
        "9 ; an inch per minute feeds ten times too slowly.",
        "10 TOOL DEF 1 L+0 R+0.25",
        "11 TOOL CALL 1 Z S300",
        "12 L Z+1 R0 FMAX M3",
        "13 L X+0.875 Y-0.375 R0 FMAX",
        "14 L Z+0.1 R0 FMAX",
        "15 L Z-0.25 R0 F20",
    ]


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a", "linuxcnc", "nine-series:a", "rosettacnc:nist", "klartext"])
def test_the_first_plunge_of_every_tool_has_its_feed(control: str) -> None:
    first = replace(cut(), feeds=dict.fromkeys(range(1, 6), 20.0 * INCH))
    lines = posted(control, first, cut(tool=2)).text.splitlines()
    plunges = [line for line in lines if "Z-" in line or "Z -" in line]
    assert len(plunges) == 2
    assert all("F20" in line for line in plunges), plunges


def test_the_header_lists_each_offset_to_enter_once() -> None:
    lines = posted("nine-series:b-g39", cut(0.02), cut(0.02), cut(), cut(tool=2, diameter=0.375)).text.splitlines()
    assert [line for line in lines if line.startswith(("(TOOL", "(OFFSET"))] == [
        "(TOOL 1 DIAMETER 0.5000: THE CONTROL'S TABLE MUST SAY THE SAME)",
        "(TOOL 2 DIAMETER 0.3750: THE CONTROL'S TABLE MUST SAY THE SAME)",
        "(OFFSET D51 RADIUS 0.2700 OF TOOL 1, LEAVES 0.0200)",
        "(OFFSET D1 RADIUS 0.2500 OF TOOL 1)",
        "(OFFSET D2 RADIUS 0.1875 OF TOOL 2)",
    ]


def test_a_control_with_the_stock_in_its_block_needs_no_offset() -> None:
    assert "OFFSET" not in posted("rosettacnc:nist", cut(0.02), cut()).text
    assert "OFFSET" not in posted("linuxcnc", cut()).text
    assert "OFFSET" not in posted("nine-series:b-g39", plain(), jobs=(job(polyline((0, 0), (2, 0))),)).text


def test_a_difference_from_the_path_of_the_block_is_noted_with_its_segment() -> None:
    result = posted("nine-series:a")
    assert [(note.code, note.severity, note.segment) for note in result.notes] == [("DIFFERS", Severity.WARNING, 2.0)]
    assert "(NOTE DIFFERS SEGMENT 2: allen-bradley:a takes corners differently, by up)" in result.text
    assert "(to 0.1036. It does not gouge or leave more.)" in result.text


def test_the_header_says_that_nothing_is_compensated() -> None:
    text = posted("linuxcnc", plain(), jobs=(job(polyline((0, 0), (2, 0))),)).text
    assert "(WRITTEN BY CUTCOMP FOR linuxcnc: THE CONTOUR AS TYPED, NOTHING IS)\n(COMPENSATED)\n" in text
    assert "CUTTER COMP. ON" in text
    assert "G41" not in text.replace("G40", "")


def test_a_work_offset_is_reported_for_a_control_without_work_offsets() -> None:
    for control in ("threeblock", "klartext"):
        (note,) = (
            finding
            for finding in posted(control, jobs=(square(work_offset=56),)).notes
            if finding.code == "WORK_OFFSET"
        )
        assert note.severity is Severity.WARNING
        assert (
            note.text
            == f"Work offset G56 cannot be written for {display_name(control)}; set its origin on the control."
        )
        assert not [finding for finding in posted(control).notes if finding.code == "WORK_OFFSET"]
    assert "WORK_OFFSET" not in [finding.code for finding in posted("linuxcnc", jobs=(square(work_offset=56),)).notes]
    assert "G56" in posted("linuxcnc", jobs=(square(work_offset=56),)).text
    assert "; NOTE WORK_OFFSET Work offset G56" in posted("klartext", jobs=(square(work_offset=56),)).text


def test_a_note_does_not_repeat_its_code():
    text = posted("fanuc:a", jobs=(square(coolant=Coolant.FLOOD),)).text
    assert "(NOTE COOLANT FLOOD is not written for fanuc:a" in text


def test_deleted_segments_make_a_warning_for_smaller_tools():
    chamfer = polyline((0, 0), (2, 0), (2.05, 0.05), (2.05, 2), (0, 2))
    compensated = compensate(chamfer, Side.LEFT, 0.25 * INCH, 2, closed=False, blend=0.125 * INCH)
    assert len(compensated.deleted)
    notes = [posted("linuxcnc", made).notes for made in (replace(cut(), compensated=compensated), cut())]
    (note,) = [note for note in notes[0] if note.code == "LEFT_OUT"]
    assert (note.severity, note.lengths) == (Severity.WARNING, (0.5 * INCH,))
    assert "LEFT_OUT" not in [note.code for note in notes[1]]


def test_the_note_on_coolant_names_the_control_as_the_list_of_controls_does():
    (note,) = posted("threeblock", jobs=(square(coolant=Coolant.MIST),)).notes
    assert note.text == "COOLANT MIST is not written for three-block; switch it on at the control."


def test_a_part_name_that_a_control_cannot_hold_is_reported() -> None:
    (note,) = posted("threeblock", part="A\x1bB").notes
    assert (note.code, note.severity, note.field) == ("PART_NAME", Severity.INFO, "name")
    assert note.text == "PART NAME A?B is not in the file: three-block has no comments."
    assert posted("threeblock", part="  ").notes == ()
    assert [note.code for note in posted("klartext", part="A").notes] == ["FEED_UNIT"]


@pytest.mark.parametrize(
    ("name", "short"),
    [
        ("key_way-1", "key_way-1"),
        ("key way/1", "key-way-1"),
        ("Nut \u00f8", "Nut-o"),
        ("Gehäuse", "Gehaeuse"),
        ("Nut \u90e8", "Nut--"),
        ("", "PART"),
        ("a" * 30, "a" * 24),
    ],
)
def test_the_program_name_is_made_acceptable_to_the_control(name: str, short: str) -> None:
    assert posted("klartext", name=name).text.startswith(f"0 BEGIN PGM {short} INCH\n")


@pytest.mark.parametrize("control", ["linuxcnc", "klartext", "nine-series:b"])
def test_no_sign_that_stands_for_another_ends_a_comment(control: str) -> None:
    wild = "a\u037eG0 Z-9 \uff1bb \ufe54c \uff09d \uff05e"
    lines = [line for line in posted(control, part=wild).text.splitlines() if "PART" in line]
    title = "PART a,G0 Z-9 ,b ,c ]d  PERCENTe"
    assert [line.partition("PART")[1] + line.partition("PART")[2].removesuffix(")") for line in lines] == [title]


def test_a_program_without_blocks_is_refused() -> None:
    result = refused()
    assert [finding.code for finding in result.findings] == ["NO_BLOCK"]
    assert result.text == "There is no block to post."


def test_a_segment_that_climbs_is_refused_under_compensation_only() -> None:
    climbing = tuple(Floor(number, -0.25 * INCH, -0.2 * INCH, 254.0) for number in range(1, 6))
    (finding,) = control_program_errors([square(floors=climbing)], Unit.IN)
    assert (finding.code, finding.severity, finding.block) == ("NOTWRITTEN", Severity.ERROR, 1)
    assert finding.text.startswith("A segment climbs or falls (Z END) under compensation")
    assert control_program_errors([replace(square(floors=climbing), comp="ON")], Unit.IN) == ()
    assert control_program_errors([square()], Unit.IN) == ()


def test_a_finding_that_prevents_posting_is_named_once() -> None:
    gouge = Finding("GOUGE", Severity.ERROR, "Gouges.", 2)
    assert [finding.code for finding in refused(square(findings=(gouge, gouge))).findings] == ["GOUGE"]
    assert [finding.code for finding in refused(square(cutter=None)).findings] == ["TOOL_MISSING"]
    assert refused(square(), square(block=2, work_offset=55)).text == "The blocks name different work offsets."


def test_a_contour_that_a_control_cannot_run_is_refused() -> None:
    tiny = cut(diameter=5.0)
    inside = replace(tiny, compensated=compensate(SQUARE, Side.LEFT, 2.5 * INCH, 1, closed=True))
    result = control_program([square()], [inside], Unit.IN, name="KEY", control="linuxcnc")
    assert isinstance(result, Refusal)
    assert {finding.severity for finding in result.findings} == {Severity.ERROR}
    assert result.unit is Unit.IN
