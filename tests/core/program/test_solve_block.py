"""A solved block: START, the settings that blocks share, and the values carried from segment to segment."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from itertools import pairwise
from math import dist, inf, nan, nextafter, pi
from typing import Any

import pytest
from hypothesis import given, settings

from core.finding import Severity
from core.geometry.piece import Arc, Line
from core.program.fields import FIELDS_OF_FORM, PARAMETERS, SETUP, Form, bounds, value_refusal
from core.program.model import (
    ArcSegment,
    BlendSegment,
    Block,
    Coolant,
    CutterComp,
    LineSegment,
    Number,
    PartSetup,
    Program,
    ProgramParameters,
    Tool,
    Unread,
    changed,
)
from core.program.solve.block import NEEDED_FIELDS, solve_block
from core.program.solve.reading import read_form, shared_findings
from core.program.solve.solved import Origin, Solved, SolvedBlock
from core.units import Kind, Unit, sentence, to_mm
from tests.core.program.parts import arc, blend, line, number, postable, program, programs, tags


def solved(given_program: Program) -> SolvedBlock:
    return solve_block(given_program.blocks[0], given_program)


def codes(block: SolvedBlock) -> list[tuple[str, float | None]]:
    return [(finding.code, finding.segment) for finding in block.all_findings]


POCKET = program(
    line(x_end=4.0, y_end=0.25, feed=12.0),
    arc("CCW", x_end=4.75, y_end=1.0, x_center=4.0, y_center=1.0),
    line(x_end=4.75, y_end=3.5),
    blend(0.5),
    line(x_end=3.0, y_end=3.5),
    line(x_end=2.5, y_end=3.0),
    line(x_end=1.0, y_end=3.0),
    arc("CW", x_end=0.5, y_end=3.5, x_center=1.0, y_center=3.5),
    line(x_end=0.25, y_end=3.5),
    line(x_end=0.25, y_end=0.25),
    line(x_end=2.0, y_end=0.25),
    unit=Unit.IN,
    x=2.0,
    y=0.25,
)


def test_a_pocket_is_solved_whole():
    block = solved(POCKET)
    assert postable(block)
    assert block.closed
    assert block.determined == 11
    assert block.all_findings == ()
    assert [number_ for number_, _ in block.pieces] == list(range(1, 12))
    third, corner, fifth = block.segments[2:5]
    assert isinstance(corner.piece, Arc)
    assert dist(corner.piece.center, (to_mm(4.25, Unit.IN), to_mm(3.0, Unit.IN))) < 1e-9
    assert third.piece == Line(block.segments[1].end or (0, 0), corner.piece.start)
    assert fifth.piece == Line(corner.piece.end, fifth.end or (0, 0))


def test_pieces_join_end_to_start():
    pieces = [piece for _, piece in solved(POCKET).pieces]
    for before, after in pairwise(pieces):
        assert before.end == after.start


def test_neighbors_of_a_blend_show_the_programmed_values():
    third = solved(POCKET).segments[2]
    assert number(third, "y_end") == 3.5
    assert number(third, "length") == pytest.approx(2.5)
    assert third.end == (to_mm(4.75, Unit.IN), to_mm(3.5, Unit.IN))


def test_feeds_and_z_are_carried_over():
    block = solved(
        program(
            line(x_end=1.0, y_end=0.0), line(x_end=2.0, y_end=0.0, feed=7.0, z_end=-0.5), line(x_end=3.0, y_end=0.0)
        )
    )
    assert [segment.feed for segment in block.segments] == [20.0, 7.0, 7.0]
    assert [(segment.z_start, segment.z_end) for segment in block.segments] == [
        (-0.25, -0.25),
        (-0.25, -0.5),
        (-0.5, -0.5),
    ]
    first, second, third = block.segments
    assert (first.values["feed"], first.values["z_end"]) == (Solved(20.0), Solved(-0.25))
    assert (second.values["feed"], second.values["z_end"]) == (Number(7.0), Number(-0.5))
    assert (third.values["feed"], third.values["z_end"]) == (Solved(7.0), Solved(-0.5))


def test_inch_values_are_millimeters_inside_and_inches_on_the_form():
    block = solved(program(line(length=1.0, angle=0.0), unit=Unit.IN, x=-1.0))
    assert block.segments[0].piece == Line((-25.4, 0.0), (0.0, 0.0))
    assert number(block.segments[0], "x_end") == 0.0
    assert block.segments[0].feed == 508.0
    assert (block.z_bottom, block.plunge_feed, block.speed, block.tool_diameter) == (-6.35, 508.0, 300.0, 12.7)


def test_an_edit_recalculates_the_segments_after_it():
    before = solved(program(line(x_end=1.0, y_end=0.0), line(length=2.0, angle=90.0)))
    after = solved(program(line(x_end=5.0, y_end=0.0), line(length=2.0, angle=90.0)))
    assert number(before.segments[1], "x_end") == pytest.approx(1.0)
    assert number(after.segments[1], "x_end") == pytest.approx(5.0)
    assert tags(after.segments[1])["x_end"] == "CAL"


def test_later_segments_continue_from_typed_values_after_a_gap():
    block = solved(
        program(
            line(x_end=1.0, y_end=0.0),
            LineSegment(),
            line(x_end=3.0, y_end=3.0),
            line(x_end=0.0, y_end=3.0),
            line(x_end=0.0, y_end=0.0),
        )
    )
    assert block.determined == 1
    assert [number_ for number_, _ in block.pieces] == [1]
    assert not postable(block)
    assert not block.closed
    assert codes(block) == [("MISSING", 2)]
    assert block.segments[2].piece is None
    assert block.segments[2].start is None
    assert block.segments[3].piece == Line((3.0, 3.0), (0.0, 3.0))


def test_a_contradictory_segment_is_not_determined_although_its_end_is_typed():
    block = solved(program(line(x_end=1.0, y_end=0.0, length=9.0), line(x_end=3.0, y_end=3.0)))
    assert block.determined == 0
    assert block.pieces == ()
    assert block.segments[1].piece == Line((1.0, 0.0), (3.0, 3.0))


@pytest.mark.parametrize(
    ("off", "closed"), [(0.0, True), (0.00253, True), (0.00255, False), (-0.00253, True), (1.0, False)]
)
def test_a_contour_is_closed_within_the_tolerance(off, closed):
    corners = (line(x_end=2.0, y_end=0.0), line(x_end=2.0, y_end=2.0), line(x_end=off, y_end=0.0))
    assert solved(program(*corners)).closed is closed


def test_a_contour_without_length_is_not_closed():
    block = solved(program(line(x_end=0.0, y_end=0.0)))
    assert not block.closed
    assert block.determined == 1
    assert not postable(block)
    assert codes(block) == [("ZERO_LENGTH", 1)]


def test_a_segment_without_length_is_skipped():
    block = solved(program(line(x_end=2.0, y_end=0.0), line(x_end=2.0, y_end=0.0), line(x_end=2.0, y_end=2.0)))
    assert block.determined == 3
    assert [number_ for number_, _ in block.pieces] == [1, 3]
    assert postable(block)


def test_unreadable_text_blocks_posting_and_is_reported_once():
    block = solved(program(LineSegment(x_end=Unread("1,5", "Type a point."), y_end=Number(0.0))))
    (finding,) = block.all_findings
    assert (finding.code, finding.segment, finding.field) == ("UNREADABLE", 1, "x_end")
    assert sentence(finding, Unit.IN) == "X END: 1,5 cannot be read. Type a point."
    assert block.segments[0].values["x_end"] == Unread("1,5", "Type a point.")
    assert block.segments[0].missing == ("x_end", "length", "angle")


def test_unreadable_text_in_a_feed_leaves_the_shape_known():
    block = solved(program(LineSegment(x_end=Number(1.0), y_end=Number(0.0), feed=Unread("x", "Type a number."))))
    assert block.segments[0].piece == Line((0.0, 0.0), (1.0, 0.0))
    assert codes(block) == [("UNREADABLE", 1)]
    assert not postable(block)


def test_a_number_out_of_its_range_is_not_used():
    block = solved(program(line(length=-1.0, angle=0.0)))
    (finding,) = block.all_findings
    assert (finding.code, finding.segment, finding.field) == ("OUT_OF_RANGE", 1, "length")
    assert finding.text == "XY LENGTH must be above 0, at most 254000."
    assert block.segments[0].piece is None


@pytest.mark.parametrize("name", ["x_start", "y_start"])
def test_nothing_is_determined_without_a_start(name):
    block = solved(program(line(x_end=1.0, y_end=0.0), line(x_end=1.0, y_end=1.0), start={name: None}))
    assert block.determined == 0
    assert codes(block) == [("MISSING", 0)]
    assert block.segments[1].piece == Line((1.0, 0.0), (1.0, 1.0))


@settings(derandomize=True, max_examples=30, deadline=None)
@given(programs)
def test_any_program_is_solved_without_raising(given_program):
    for block in given_program.blocks:
        solution = solve_block(block, given_program)
        assert len(solution.segments) == len(block.segments)
        for typed, solved_segment in zip(block.segments, solution.segments, strict=True):
            for name, value in solved_segment.values.items():
                entered = getattr(typed, name)
                assert value == entered if entered is not None else not isinstance(value, Number | Unread)
        for finding in solution.all_findings:
            assert sentence(finding, given_program.unit).endswith((".", "?", "!"))
        for segment in solution.segments:
            assert all(finding.segment == segment.number for finding in segment.findings)
        assert all(finding.segment == 0 for finding in solution.findings)
        assert solution.determined == len(solution.segments) or not postable(solution)


def test_an_empty_segment_is_reported_as_the_next_to_complete():
    segments: tuple[LineSegment | ArcSegment | BlendSegment, ...] = (LineSegment(), ArcSegment(), BlendSegment())
    for segment in segments:
        block = solved(program(line(x_end=1.0, y_end=0.0), segment))
        assert block.determined == 1
        assert not postable(block)
        assert next(finding.segment for finding in block.all_findings) == 2


def test_a_contour_is_determined_although_its_tool_is_missing():
    toolless = replace(POCKET, tools=())
    assert codes(solved(toolless)) == [("TOOL_MISSING", 0)]
    assert solved(toolless).determined == 11


def test_solving_does_not_load_numpy():
    """The first screen appears before the heavy packages are loaded."""
    names = ("edit", "fields", "history", "model", "tools", "solve.block", "file.read", "file.write")
    imports = ", ".join(f"core.program.{name}" for name in names)
    script = f"import {imports}, core.units, core.geometry.corner, sys; print('numpy' in sys.modules)"
    result = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert result.stdout.strip() == "False"


def test_a_segment_that_ends_out_of_range_is_refused():
    far = [line(length=4e3, angle=0.0) for _ in range(5)]
    block = solved(program(*far, unit=Unit.IN))
    assert codes(block) == [("OUT_OF_RANGE", 3)]
    assert block.determined == 2
    flat = solved(program(arc("CW", x_end=1e4, y_end=0.0, sweep=1e-4)))
    assert codes(flat) == [("OUT_OF_RANGE", 1)]


def test_control_characters_in_a_message_are_replaced():
    block = solved(program(LineSegment(x_end=Unread("\x1b[2J", "why."), y_end=Number(0.0))))
    assert block.all_findings[0].text == "X END: ?[2J cannot be read. why."


ALONG = line(x_end=1.0, y_end=0.0)


def findings(**start: object) -> list[str]:
    given = program(ALONG, unit=Unit.IN, start=start)
    start_findings = solve_block(given.blocks[0], given).findings
    return [
        f"{finding.code} {finding.severity} {finding.field}: {sentence(finding, Unit.IN)}" for finding in start_findings
    ]


def test_a_complete_start_has_no_findings():
    assert findings() == []


@pytest.mark.parametrize("name", NEEDED_FIELDS)
def test_blanks_are_named(name):
    (text,) = findings(**{name: None})
    assert text.startswith(f"MISSING error {name}: ")
    assert text.endswith(" is blank: enter it on START.")


def test_a_missing_tool_is_reported_before_blank_fields():
    texts = findings(tool=Number(7.0), finish_tool=Number(8.0), x_start=None, y_start=None)
    assert [text.split(":")[0] for text in texts] == [
        "TOOL_MISSING error tool",
        "TOOL_MISSING error finish_tool",
        "MISSING error x_start",
        "MISSING error y_start",
    ]


def test_blank_fields_that_mean_zero_are_filled_in():
    given = program(ALONG, start={"finish_tool": None, "peck_depth": None})
    block = solve_block(given.blocks[0], given)
    assert (block.values["finish_tool"], block.values["peck_depth"]) == (Solved(0.0, Origin.USUAL),) * 2
    assert (block.peck_depth, block.finish_diameter) == (0.0, None)
    assert postable(block)


@pytest.mark.parametrize(
    ("start", "text"),
    [
        ({"tool": Number(5.0)}, "TOOL_MISSING error tool: Tool 5 is not in the tool table"),
        ({"finish_tool": Number(5.0)}, "TOOL_MISSING error finish_tool: Tool 5 is not in the tool table"),
        ({"tool": Number(2.5)}, "OUT_OF_RANGE error tool: TOOL must be a whole number from 1 to 9999."),
        ({"lookahead": Number(21.0)}, "OUT_OF_RANGE error lookahead: CUTCOMP LOOKAHEAD must be a whole number"),
        ({"speed": Unread("x", "Type a number.")}, "UNREADABLE error speed: SPEED (RPM): x cannot be read."),
        (
            {"z_bottom": Number(0.5)},
            "Z_ORDER error z_bottom: Z BOTTOM 0.5000 is above Z START 0.0000: it must be below.",
        ),
        ({"z_bottom": Number(0.0)}, "Z_ORDER warning z_bottom: Z BOTTOM is at Z START: nothing is cut."),
    ],
)
def test_wrong_start_values_are_reported(start, text):
    assert findings(**start)[0].startswith(text)


def test_a_block_without_segments_is_not_postable():
    given = program()
    block = solve_block(given.blocks[0], given)
    (finding,) = block.findings
    assert (finding.code, finding.segment) == ("NO_SEGMENTS", 0)
    assert not postable(block)
    assert not block.closed


@pytest.mark.parametrize("diameter", [None, Number(0.0), Number(-0.5)])
@pytest.mark.parametrize(("comp", "severity"), [(CutterComp.RIGHT, Severity.ERROR), (CutterComp.ON, Severity.WARNING)])
def test_a_tool_without_a_diameter_is_only_a_warning_on_the_contour(diameter, comp, severity):
    given = replace(program(ALONG, start={"cutter_comp": comp}), tools=(Tool(1, diameter=diameter),))
    block = solve_block(given.blocks[0], given)
    (finding,) = block.findings
    assert (finding.code, finding.severity, finding.field) == ("TOOL_DIAMETER", severity, "tool")
    assert block.tool_diameter is None


def test_a_block_knows_both_of_its_tools():
    given = program(ALONG, start={"finish_tool": Number(2.0)})
    given = replace(given, tools=(*given.tools, Tool(2, "FINISHER", Number(0.25))))
    block = solve_block(given.blocks[0], given)
    assert (block.tool_diameter, block.tool_type, block.finish_diameter) == (0.5, "END MILL", 0.25)


def test_lengths_feeds_and_angles_are_converted_and_counts_are_not():
    reading = read_form(Form.LINE, line(x_end=2.0, angle=180.0, feed=10.0), Unit.IN, 1)
    assert reading.known == {"x_end": 50.8, "angle": pi, "feed": 254.0}
    assert reading.findings == ()
    assert reading.values["x_end"] == Number(2.0)
    assert reading.values["y_end"] is None


def test_faulty_values_are_reported_and_not_known():
    segment = LineSegment(x_end=Unread("1,5", "Type a point."), length=Number(-2.0), y_end=Number(float("inf")))
    reading = read_form(Form.LINE, segment, Unit.MM, 7)
    assert reading.known == {}
    assert [(finding.code, finding.segment, finding.field) for finding in reading.findings] == [
        ("UNREADABLE", 7, "x_end"),
        ("OUT_OF_RANGE", 7, "y_end"),
        ("OUT_OF_RANGE", 7, "length"),
    ]
    assert reading.values["x_end"] == Unread("1,5", "Type a point.")


@pytest.mark.parametrize("typed", [Number(1.0), Unread("x", "why")])
def test_fill_changes_blank_fields_only(typed):
    reading = read_form(Form.LINE, LineSegment(x_end=typed), Unit.IN, 1)
    for name, value in (("x_end", 3.0), ("y_end", 2.0), ("feed", None)):
        reading.fill(name, value)
    assert reading.values["x_end"] == typed
    assert (reading.values["y_end"], reading.values["feed"]) == (Solved(2.0), None)
    reading.fill("y_end", 4.0)
    assert reading.values["y_end"] == Solved(2.0)


PARTS: dict[Form, Any] = {
    Form.START: Block(),
    Form.LINE: LineSegment(),
    Form.ARC: ArcSegment(),
    Form.BLEND: BlendSegment(),
    Form.PARAMETERS: ProgramParameters(),
    Form.SETUP: PartSetup(),
}


@pytest.mark.parametrize("unit", Unit)
@pytest.mark.parametrize("form", PARTS)
def test_a_number_is_known_exactly_when_its_field_accepts_it(form: Form, unit: Unit):
    numbers = [field for field in FIELDS_OF_FORM[form] if field.kind not in (Kind.CHOICE, Kind.TEXT)]
    assert numbers
    for field in numbers:
        edges = {
            0.0,
            1.0,
            2.5,
            -3.0,
            54.0,
            1e300,
            *(edge for edge in (*bounds(field, unit), field.above) if edge is not None),
        }
        for value in (nan, inf, -inf, *(near for edge in edges for near in _about(edge))):
            reading = read_form(form, changed(PARTS[form], {field.name: Number(value)}), unit, 1)
            taken = value_refusal(field, value, unit) is None
            assert (field.name in reading.known) is taken
            assert len(reading.findings) == (not taken)


def _about(edge: float) -> tuple[float, float, float]:
    return nextafter(edge, -inf), edge, nextafter(edge, inf)


def shared_messages(program):
    return [(finding.code, finding.field, finding.segment, finding.text) for finding in shared_findings(program)]


def test_blanks_and_valid_values_have_no_findings():
    assert shared_messages(Program()) == []
    part = Program(Unit.MM, parameters=changed(Program().parameters, {"blend_offset": Number(3.0)}))
    assert shared_messages(part) == []


@pytest.mark.parametrize("one", [one for one in PARAMETERS if one.kind is not Kind.CHOICE], ids=lambda one: one.name)
def test_unreadable_text_and_numbers_out_of_range_are_errors_of_their_screen(one):
    parameters = changed(Program().parameters, {one.name: Unread("1..2", "Two points.")})
    text = f"PROGRAM PARAMETERS: {one.label}: 1..2 cannot be read. Two points."
    assert shared_messages(Program(parameters=parameters)) == [("UNREADABLE", one.name, None, text)]
    parameters = changed(Program().parameters, {one.name: Number(-1.0)})
    ((code, field_name, _, text),) = shared_messages(Program(parameters=parameters))
    assert (code, field_name) == ("OUT_OF_RANGE", one.name)
    assert text.startswith(f"PROGRAM PARAMETERS: {one.label} must be ")


def test_faults_in_part_setup_are_reported():
    setup = replace(Program().setup, work_offset=Number(54.5), safe_z=Unread("x", "Why."))
    assert len(SETUP) == 3
    assert shared_messages(Program(setup=setup)) == [
        ("OUT_OF_RANGE", "work_offset", None, "PART SETUP: WORK OFFSET must be a whole number from 54 to 59."),
        ("UNREADABLE", "safe_z", None, "PART SETUP: SAFE Z: x cannot be read. Why."),
    ]


@pytest.mark.parametrize(
    ("values", "labels"),
    [
        ({}, ""),
        ({"speed": Number(14000.0), "feed": Number(500.0)}, ""),
        ({"speed": Number(5000.0)}, "SPEED"),
        ({"feed": Number(600.0), "coolant": Coolant.FLOOD}, "FEED, COOLANT"),
    ],
)
def test_a_finish_tool_with_different_values_is_a_warning(values, labels):
    tools = (
        Tool(1, diameter=Number(0.5), speed=Number(14000.0), feed=Number(500.0)),
        replace(Tool(2, diameter=Number(0.25)), **values),
    )
    given = replace(program(ALONG, start={"finish_tool": Number(2.0), "speed": None}), tools=tools)
    warnings = [
        finding for finding in solve_block(given.blocks[0], given).all_findings if finding.code == "FINISH_VALUES"
    ]
    assert [finding.severity for finding in warnings] == ([Severity.WARNING] if labels else [])
    assert all(f"TOOL SETUP has another {labels} for it." in finding.text for finding in warnings)
