"""The journal: one line per edit, whole after any crash and read back as the same work; both kinds."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from functools import reduce
from typing import cast

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.documents.files import Stamp
from app.documents.journal import (
    MAX_UNDO_EDITS,
    Journal,
    Kind,
    beginning,
    continuing,
    delta,
    read_journal,
    records_between,
)
from app.documents.journal_file import Record, lines
from app.documents.lock import Owner
from app.documents.nc_text import NcText
from core.program.edit import FormPlace, type_field
from core.program.history import History
from core.program.model import Number, Program, Unread
from tests.app.nc_lines import changed, deleted, inserted
from tests.core.program.parts import line, program, programs
from tests.properties import exercised, must_exercise

PART = program(line(x_end=1.0), line(y_end=1.0), line(x_end=0.0))
OWNER = Owner("ann", "mill-3", 4711, "boot:12", "2025-03-04T06:00:00+01:00")
HEAD = (OWNER, "/parts/pocket.toml", Stamp(120, 5, "0123456789abcdef"))
PLACE = (1, 2, "y_end")
TIME = "2025-03-04T06:05:00+01:00"

EditStep = Callable[[History], History]


def typed(number: float) -> EditStep:
    """An edit that types this number into Y END of segment 2."""

    def do(history: History) -> History:
        edited = type_field(history.program, FormPlace(1, 2), "y_end", Number(number))
        assert isinstance(edited, Program)
        return history.do(edited, f"Y END {number}")

    return do


def whole(history: History) -> bytes:
    return lines(beginning(Journal(*HEAD, history, PLACE, TIME)))[0]


def further(data: bytes, old: History, new: History) -> bytes | None:
    """The lines extended by the records from the old history to the new; None where it does not follow."""
    records = records_between(old, new)
    return None if records is None else data + lines(continuing(records, PLACE, TIME), _sum(data))[0]


def _sum(data: bytes) -> int:
    """The checksum of the last whole line."""
    return int(data.splitlines()[-1][:8], 16)


def journal(*steps: EditStep) -> tuple[bytes, History]:
    """The lines of a journal of these steps, and the resulting history."""
    history = History(PART)
    data = whole(history)
    for step in steps:
        after = step(history)
        more = further(data, history, after)
        assert more is not None
        data, history = more, after
    return data, history


def read(data: bytes) -> Journal:
    result = read_journal(data)
    assert result is not None
    return result


STEPS: tuple[EditStep, ...] = (
    typed(2.0),
    typed(3.0),
    History.undo,
    typed(4.0),
    History.undo,
    History.undo,
    History.redo,
)


def test_work_place_time_and_head_are_read_back() -> None:
    data, history = journal(*STEPS)
    result = read(data)
    assert result.work == history
    assert (result.kind, result.place, result.time) == (Kind.CONTOUR, PLACE, TIME)
    assert (result.owner, result.file, result.stamp) == HEAD
    assert not result.damaged


steps = st.lists(st.one_of(st.floats(-9, 9).map(typed), st.just(History.undo), st.just(History.redo)), max_size=12)


@settings(max_examples=60, derandomize=True, deadline=None)
@given(steps)
def test_any_edits_come_back(made: list[EditStep]) -> None:
    data, history = journal(*made)
    assert read(data).work == history
    assert read(whole(history)).work == history


@settings(max_examples=40, derandomize=True, deadline=None)
@given(steps, steps)
def test_several_edits_in_one_key_come_back_or_begin_a_journal_anew(
    before: list[EditStep], key: list[EditStep]
) -> None:
    data, old = journal(*before)
    new = reduce(lambda history, step: step(history), key, old)
    more = further(data, old, new)
    assert read(whole(new) if more is None else more).work == new


@settings(max_examples=15, derandomize=True, deadline=None)
@given(programs, programs)
def test_any_program_comes_back(first: Program, second: Program) -> None:
    history = History(first).do(second, "everything")
    assert read(whole(history)).work == history


def test_a_journal_of_a_long_history_begins_with_its_last_edits() -> None:
    history = reduce(lambda history, step: step(history), map(typed, range(MAX_UNDO_EDITS + 9)), History(PART))
    assert read(whole(history)).work == History(history.program, history.past[-MAX_UNDO_EDITS:])


def test_an_edit_that_reads_as_no_change_can_be_undone() -> None:
    renamed = replace(PART.blocks[0], x_start=Unread("2", "A segment was deleted."))
    history = History(PART)
    for block in (renamed, replace(renamed, x_start=Unread("2", "Another one, too.")), PART.blocks[0]):
        history = history.do(replace(PART, blocks=(block,)), "X START")
    result = read(whole(history)).work
    assert isinstance(result, History)
    assert result.undo_count == 3
    assert result.undo().undo().undo().program == PART


def test_several_steps_at_once_do_not_follow() -> None:
    twice = typed(3.0)(typed(2.0)(History(PART)))
    assert records_between(History(PART), twice) is None
    assert records_between(twice, twice.undo().undo()) is None
    assert records_between(twice.undo(), typed(4.0)(twice)) is None


def test_a_history_of_another_program_does_not_follow() -> None:
    assert records_between(History(PART), History(program(line(x_end=7.0)))) is None


def test_a_journal_cut_anywhere_yields_its_whole_lines() -> None:
    data, _ = journal(*STEPS)
    ends = [index + 1 for index, byte in enumerate(data) if byte == 10]
    expected = {end: read(data[:end]).work for end in ends}
    assert read_journal(data[: ends[0] - 1]) is None
    for cut in range(ends[0], len(data)):
        result = read(data[:cut])
        assert result.work == expected[max(end for end in ends if end <= cut)], cut
        assert not result.damaged


@must_exercise(0.2, "some", "none")
@settings(max_examples=200, derandomize=True, deadline=None)
@given(st.data())
def test_a_changed_byte_leaves_the_work_of_the_lines_before_it(draws: st.DataObject) -> None:
    data, _ = journal(*STEPS)
    at = draws.draw(st.integers(0, len(data) - 1))
    byte = draws.draw(st.integers(0, 255).filter(lambda one: one != data[at]))
    found = read_journal(data[:at] + bytes([byte]) + data[at + 1 :])
    before = data[: data.rfind(b"\n", 0, at) + 1]
    if before:
        exercised("some")
        assert found is not None
        assert found.work == read(before).work
    else:
        exercised("none")
        assert found is None


def test_a_damaged_middle_is_reported_and_a_torn_end_is_not() -> None:
    data, _ = journal(*STEPS)
    second = data.index(b"\n") + 1
    assert read(data[:second] + b"\0" * 20 + data[second:]).damaged
    assert not read(data[:-3]).damaged
    assert not read(data + b"\0" * 512).damaged


def test_a_missing_line_ends_the_journal_as_damaged() -> None:
    rows = journal(*STEPS)[0].splitlines(keepends=True)
    result = read(rows[0] + b"".join(rows[2:]))
    assert result.work == History(PART)
    assert result.damaged


@pytest.mark.parametrize("data", [b"", b"not ours\n", bytes(range(256)) * 40])
def test_random_bytes_are_no_journal(data: bytes) -> None:
    assert read_journal(data) is None


# ---- NC texts

WORK = st.lists(st.tuples(st.sampled_from("cidur"), st.integers(0, 9), st.text("GX1.\t", max_size=4)), max_size=25)


def nc_edited(text: NcText, kind: str, row: int, typed: str) -> NcText:
    row %= len(text) + 1
    match kind:
        case "c" if len(text) > row:
            return changed(text, row, typed)
        case "i":
            return inserted(text, row, typed)
        case "d" if len(text) > row:
            return deleted(text, row)
        case "u":
            return text.undo()
        case "r":
            return text.redo()
        case _:
            return text


@settings(derandomize=True, deadline=None)
@given(WORK, st.sampled_from([b"", b"A\nB\nC", b"A\r\nB\r\n", b"\xff\xfeA\x00\n\x00", b"\xef\xbb\xbfA\n"]))
def test_any_edits_of_an_nc_text_come_back(work: list[tuple[str, int, str]], content: bytes) -> None:
    text = NcText.read(content)
    data = lines(beginning(Journal(*HEAD, text, (0,), TIME)))[0]
    for kind, row, typed_text in work:
        before, text = text, nc_edited(text, kind, row, typed_text)
        records = records_between(before, text)
        assert records is not None
        data += lines(continuing(records, (row,), TIME), _sum(data))[0]
    for written in (data, lines(beginning(Journal(*HEAD, text, (0,), TIME)))[0]):
        found = read(written)
        assert not found.damaged
        assert isinstance(found.work, NcText)
        assert (found.work.lines, found.work.encoding) == (text.lines, text.encoding)
        assert (len(found.work.past), len(found.work.future)) == (len(text.past), len(text.future))
        assert found.work.unsaved


# ---- valid checksums, wrong content


def signed(record: object, total: int = 0) -> bytes:
    """A line with a valid checksum, whatever its content is."""
    return lines([cast("Record", record)], total)[0]


FIRST = json.loads(whole(History(PART))[9:])
NC_FIRST = json.loads(lines(beginning(Journal(*HEAD, NcText.read(b"A\n"), (0,), TIME)))[0][9:])
TEXT = NC_FIRST["base"][1]


@pytest.mark.parametrize(
    "wrong",
    [
        None,
        [],
        {},
        {"journal": 4},
        {"kind": "drawing"},
        {"kind": ["NC text"]},
        {"kind": "NC text"},
        {"owner": None},
        {"owner": {"user": "ann"}},
        {"owner": {**FIRST["owner"], "pid": "7"}},
        {"file": 5},
        {"file": "a\0b"},
        {"stamp": []},
        {"stamp": [1, 2, "x"]},
        {"stamp": [True, 2, "01234567"]},
        {"base": None},
        {"base": {"blocks": 10**309}},
        {"base": {**FIRST["base"], "blocks": [0, 1]}},
        {"base": {**FIRST["base"], "text": "no program"}},
        {"at": [1, 2, 3]},
        {"at": 10**309},
        {"time": 5},
        {"time": "\n"},
    ],
)
def test_a_first_line_with_wrong_content_is_no_journal(wrong: object) -> None:
    record = {**FIRST, **wrong} if isinstance(wrong, dict) and wrong else wrong
    assert read_journal(signed(record)) is None


def test_a_place_of_one_number_belongs_to_an_nc_text_and_is_ignored_in_a_program() -> None:
    result = read_journal(signed({**FIRST, "at": [1]}))
    assert result is not None
    assert isinstance(result.work, History)
    assert (result.kind, result.damaged) == (Kind.CONTOUR, False)
    assert (result.owner, result.file, result.stamp) == HEAD
    assert result.work.program == PART


@pytest.mark.parametrize(
    "wrong",
    [
        {"base": ["no-such", TEXT]},
        {"base": ["rot13", TEXT]},
        {"base": ["utf-8", "!"]},
        {"base": ["utf-8", 5]},
        {"base": ["utf-8"]},
    ],
)
def test_a_first_line_of_an_nc_text_with_wrong_content_is_no_journal(wrong: dict[str, object]) -> None:
    assert read_journal(signed({**NC_FIRST, **wrong})) is None


@pytest.mark.parametrize(
    "wrong",
    [
        {"do": "x"},
        {"do": 5, "delta": {}},
        {"do": "\x1b", "delta": delta(PART, PART)},
        {"do": "x", "delta": {**delta(PART, PART), "blocks": [10**309, 0]}},
        {"undo": 1},
        {"redo": 1},
        {"undo": 2},
        {"owner": FIRST["owner"], "file": None, "stamp": None},
        {"jump": 1},
        [],
        None,
        5,
    ],
)
def test_a_later_line_with_wrong_content_ends_the_journal_as_damaged(wrong: object) -> None:
    first = signed(FIRST)
    record = {**wrong, "at": PLACE, "time": TIME} if isinstance(wrong, dict) else wrong
    result = read(first + signed(record, _sum(first)))
    assert result.damaged
    assert result.work == History(PART)
