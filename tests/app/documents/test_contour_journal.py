"""Edits of a contour program as JSON values: small, and read back as strictly as a program file."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest
from hypothesis import given, settings

from app.documents.contour_journal import (
    MAX_WHOLE_EDITS,
    ContourReplay,
    DamagedError,
    applied,
    delta,
    whole_records,
)
from core.program.edit import FormPlace, delete_segment, insert_segment, type_field
from core.program.history import History
from core.program.model import LineSegment, Number, Program, Unread
from core.units import Unit
from tests.core.program.parts import line, program, programs

PART = program(line(x_end=1.0), line(y_end=1.0), line(x_end=0.0))


@settings(max_examples=20, derandomize=True, deadline=None)
@given(programs, programs)
def test_any_two_programs(old: Program, new: Program) -> None:
    assert applied(old, json.loads(json.dumps(delta(old, new)))) == new


def test_one_field_is_one_small_record() -> None:
    edited = type_field(PART, FormPlace(1, 2), "y_end", Number(2.5))
    assert isinstance(edited, Program)
    assert delta(PART, edited) == {"block": [0, {}, [1, 1, [["LINE", {"y_end": 2.5}]]]]}


def test_a_blank_and_an_unreadable_text_are_recorded() -> None:
    blank = type_field(PART, FormPlace(1), "x_start", None)
    unread = type_field(PART, FormPlace(1), "x_start", Unread("2..5", "two points"))
    assert isinstance(blank, Program)
    assert isinstance(unread, Program)
    assert delta(PART, blank) == {"block": [0, {"x_start": None}, [3, 0, []]]}
    assert delta(PART, unread) == {"block": [0, {"x_start": ["2..5", "two points"]}, [3, 0, []]]}


def test_an_inserted_and_a_deleted_segment_are_recorded() -> None:
    longer = insert_segment(PART, FormPlace(1, 2), LineSegment())
    shorter = delete_segment(PART, FormPlace(1, 1))
    assert isinstance(longer, Program)
    assert isinstance(shorter, Program)
    assert delta(PART, longer) == {"block": [0, {}, [1, 0, [["LINE", {}]]]]}
    assert delta(PART, shorter) == {"block": [0, {}, [0, 1, []]]}


@pytest.mark.parametrize(
    "values",
    [
        None,
        {"color": 3},
        {"unit": "FEET"},
        {"tools": [0, 0, [{"number": "1"}]]},
        {"tools": [0, 0, [{"number": 1, "type": "END\x1b[2JMILL"}]]},
        {"tools": [0, 0, [{"number": 10000}]]},
        {"tools": [0, 0, [{"number": 10**309}]]},
        {"tools": [0, 0, [{"number": 5}, {"number": 5}]]},
        {"tools": [0, 2, []]},
        {"tools": [5, 0, []]},
        {"setup": {"name": 5}},
        {"setup": {"segments": 5}},
        {"block": [1, {}, [0, 0, []]]},
        {"block": [0, {"x_start": float("nan")}, [0, 0, []]]},
        {"block": [0, {"x_start": True}, [0, 0, []]]},
        {"block": [0, {"x_start": 10**309}, [0, 0, []]]},
        {"block": [0, {"x_start": ["2..", "\x1b[2J"]}, [0, 0, []]]},
        {"block": [0, {"lookahead": 21}, [0, 0, []]]},
        {"block": [0, {}, [0, 1, [["LINE", {"choice": -1}]]]]},
        {"block": [True, {}, [0, 0, []]]},
        {"block": [0, {"x_start": 1e9}, [0, 0, []]]},
        {"block": [0, {"cutter_comp": "UP"}, [0, 0, []]]},
        {"block": [0, {}, [0, 4, []]]},
        {"block": [0, {}, [-1, 1, []]]},
        {"block": [0, {}, [0, 0, [["SPLINE", {}]]]]},
        {"blocks": [0, 1, [[{}]]]},
    ],
)
def test_an_invalid_difference_is_refused(values: object) -> None:
    with pytest.raises(DamagedError):
        applied(PART, values)


def test_applying_an_edit_shares_the_unchanged_segments() -> None:
    long = program(*(line(x_end=float(number)) for number in range(1000)))
    edited = type_field(long, FormPlace(1, 500), "x_end", Number(0.5))
    assert isinstance(edited, Program)
    result = applied(long, delta(long, edited))
    assert result == edited
    shared = zip(result.blocks[0].segments, long.blocks[0].segments, strict=True)
    assert sum(segment is other for segment, other in shared) == 999
    assert len(json.dumps(delta(long, edited))) < 80


def test_a_change_of_unit_is_one_small_record() -> None:
    inch = replace(PART, unit=Unit.IN)
    assert PART.unit is Unit.MM
    assert delta(PART, inch) == {"unit": "IN"}
    assert applied(PART, {"unit": "IN"}) == inch


def test_a_journal_of_a_long_history_begins_with_its_last_edits() -> None:
    history = History(PART)
    for number in range(MAX_WHOLE_EDITS + 9):
        edited = type_field(history.program, FormPlace(1, 2), "y_end", Number(float(number)))
        assert isinstance(edited, Program)
        history = history.do(edited, "Y END")
    base, *edits = whole_records(history)
    assert len(edits) == MAX_WHOLE_EDITS
    replay = ContourReplay.begun(base["base"])
    for edit in edits:
        replay.do(edit["do"], edit["delta"])
    assert replay.work() == History(history.program, history.past[-MAX_WHOLE_EDITS:])
