"""Edits of a contour program as JSON values: small, and read back as strictly as a program file."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest
from hypothesis import given, settings

from app.documents.journal import applied, delta
from app.documents.journal_file import DamagedError
from core.program.edit import FormPlace, delete_segment, insert_segment, type_field
from core.program.file.read import StoreError
from core.program.file.write import dumps
from core.program.model import ArcSegment, Direction, LineSegment, Number, Program, Relative, Tool, Unread
from core.units import Unit
from tests.core.program.parts import line, program, programs

PART = program(line(x_end=1.0), line(y_end=1.0), line(x_end=0.0))
ONE_TOOL = dumps(Program(PART.unit, tools=PART.tools))
NOTHING = {"tools": [0, 0], "blocks": [0, 0], "segments": None, "text": dumps(Program(PART.unit))}


def through_journal(old: Program, new: Program) -> Program:
    return applied(old, json.loads(json.dumps(delta(old, new))))


@settings(max_examples=20, derandomize=True, deadline=None)
@given(programs, programs)
def test_any_two_programs(old: Program, new: Program) -> None:
    assert through_journal(old, new) == new


def test_one_field_is_one_small_record() -> None:
    edited = type_field(PART, FormPlace(1, 2), "y_end", Number(2.5))
    assert isinstance(edited, Program)
    values = delta(PART, edited)
    assert (values["tools"], values["blocks"], values["segments"]) == ([1, 0], [0, 1], [1, 1])
    assert values["text"].count("[[block.segment]]") == 1
    assert "y_end = 2.5" in values["text"]


@pytest.mark.parametrize("typed", [None, Unread("2..5", "2..5 is not a number.")])
def test_a_blank_and_an_unreadable_text_are_recorded(typed: Unread | None) -> None:
    edited = type_field(PART, FormPlace(1), "x_start", typed)
    assert isinstance(edited, Program)
    result = through_journal(PART, edited).blocks[0].x_start
    assert result == typed if typed is None else result.text == typed.text


def test_an_inserted_and_a_deleted_segment_are_recorded() -> None:
    longer = insert_segment(PART, FormPlace(1, 2), LineSegment())
    shorter = delete_segment(PART, FormPlace(1, 1))
    assert isinstance(longer, Program)
    assert isinstance(shorter, Program)
    assert (through_journal(PART, longer), delta(PART, longer)["segments"]) == (longer, [1, 0])
    assert (through_journal(PART, shorter), delta(PART, shorter)["segments"]) == (shorter, [0, 1])


@pytest.mark.parametrize(
    "values",
    [
        None,
        {"text": NOTHING["text"]},
        {**NOTHING, "text": 5},
        {**NOTHING, "text": "format = 9"},
        {**NOTHING, "tools": [0, 2]},
        {**NOTHING, "tools": [5, 0]},
        {**NOTHING, "tools": [0, 0], "text": ONE_TOOL},
        {**NOTHING, "tools": ["0", 0]},
        {**NOTHING, "blocks": [1, 1]},
        {**NOTHING, "blocks": [-1, 1]},
        {**NOTHING, "blocks": 10**309},
        {**NOTHING, "segments": [0, 0]},
        {**NOTHING, "blocks": [0, 1], "segments": [0, 0]},
        {**delta(PART, PART), "blocks": [0, 1], "segments": [0, 4], "text": dumps(PART)},
        {**delta(PART, PART), "blocks": [1, 1], "segments": [0, 0], "text": dumps(PART)},
        {**delta(PART, PART), "blocks": [0, 1], "segments": 1, "text": dumps(PART)},
    ],
)
def test_an_invalid_difference_is_refused(values: object) -> None:
    with pytest.raises((DamagedError, StoreError)):
        applied(PART, values)


def test_applying_an_edit_shares_the_unchanged_segments() -> None:
    long = program(*(line(x_end=float(number)) for number in range(1000)))
    edited = type_field(long, FormPlace(1, 500), "x_end", Number(0.5))
    assert isinstance(edited, Program)
    result = applied(long, delta(long, edited))
    assert result == edited
    shared = zip(result.blocks[0].segments, long.blocks[0].segments, strict=True)
    assert sum(segment is other for segment, other in shared) == 999
    assert len(json.dumps(delta(long, edited))) < 800


def test_a_change_of_unit_is_one_small_record() -> None:
    inch = replace(PART, unit=Unit.IN)
    assert PART.unit is Unit.MM
    assert through_journal(PART, inch) == inch
    assert "[[block]]" not in delta(PART, inch)["text"]


def test_a_new_tool_is_sorted_in() -> None:
    more = replace(PART, tools=(*PART.tools, Tool(7, "DRILL", Number(3.0))))
    between = replace(more, tools=(more.tools[0], Tool(3), more.tools[1]))
    assert (through_journal(PART, more), through_journal(more, between), through_journal(between, PART)) == (
        more,
        between,
        PART,
    )


def test_values_that_connect_segments_are_read_back() -> None:
    connected = LineSegment(
        x_end=Relative(1.5),
        tangent=True,
        parallel=Number(1.0),
        offset=Number(2.0),
        point_x=Number(3.0),
        point_y=Number(4.0),
        point_dist=Number(5.0),
        pick_x=Number(6.0),
        pick_y=Number(7.0),
        choice=5,
    )
    arc = ArcSegment(Direction.CCW, x_center=Relative(-2.0), start_angle=Relative(90.0), choice=4096)
    assert through_journal(PART, program(connected, arc)) == program(connected, arc)
