"""The journal: each edit a line that any crash leaves whole, read back as what was done."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from dataclasses import replace
from functools import reduce
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.documents.files import Stamp
from app.documents.journal_file import LARGEST_KEPT, JournalFile, journal_path, lines, set_aside
from app.documents.lock import Owner
from app.painted.journal import (
    Cursor,
    Damaged,
    Head,
    Recovered,
    applied,
    delta,
    edit_records,
    head_record,
    history_records,
    moved_record,
    recovered,
)
from core.program.edit import FormPlace, delete_segment, insert_segment, type_field
from core.program.history import History
from core.program.model import LineSegment, Number, Program, Unread
from tests.core.program.parts import line, program, programs

PART = program(line(x_end=1.0), line(y_end=1.0), line(x_end=0.0))
OWNER = Owner("ann", "mill-3", 4711, "boot:12", "2025-03-04T06:00:00+01:00")
HEAD = Head(OWNER, "/parts/pocket.toml", Stamp(120, 5, "ab"))
CURSOR = Cursor(FormPlace(1, 2), "y_end", "2025-03-04T06:05:00+01:00")

Step = Callable[[History], History]


def typed(number: float) -> Step:
    """An edit: this number into Y END of segment 2."""

    def do(history: History) -> History:
        edited = type_field(history.program, FormPlace(1, 2), "y_end", Number(number))
        assert isinstance(edited, Program)
        return history.do(edited, f"Y END {number}")

    return do


def journal(*steps: Step, start: History | None = None) -> tuple[bytes, History]:
    """The lines of a journal in which these steps were made, and the history they led to."""
    history = start or History(PART)
    data, total = lines([head_record(HEAD, history.program, CURSOR)])
    for step in steps:
        after = step(history)
        records = edit_records(history, after, CURSOR)
        assert records is not None
        more, total = lines(records, total)
        data, history = data + more, after
    return data, history


def read(data: bytes) -> Recovered:
    found = recovered(data)
    assert found is not None
    return found


STEPS: tuple[Step, ...] = (typed(2.0), typed(3.0), History.undo, typed(4.0), History.undo, History.undo, History.redo)


def test_program_cursor_and_undo_come_back() -> None:
    data, history = journal(*STEPS)
    found = read(data)
    assert found.history == history
    assert (found.head, found.cursor, found.damaged) == (HEAD, CURSOR, False)
    assert found.length == len(data)
    assert found.history.undo().program == PART


steps = st.lists(st.one_of(st.floats(-9, 9).map(typed), st.just(History.undo), st.just(History.redo)), max_size=12)


@settings(max_examples=60, derandomize=True, deadline=None)
@given(steps)
def test_any_edits(made: list[Step]) -> None:
    data, history = journal(*made)
    assert read(data).history == history


@settings(max_examples=40, derandomize=True, deadline=None)
@given(steps, steps)
def test_several_edits_in_one_key(before: list[Step], key: list[Step]) -> None:
    """However much one key does, its records lead there, or the journal is begun anew."""
    data, old = journal(*before)
    new = reduce(lambda history, step: step(history), key, old)
    records = edit_records(old, new, CURSOR)
    if records is None:
        assert read(lines(history_records(HEAD, new, CURSOR))[0]).history == new
    else:
        assert read(data + lines(records, read(data).total)[0]).history == new


@settings(max_examples=15, derandomize=True, deadline=None)
@given(programs, programs)
def test_any_program(first: Program, second: Program) -> None:
    history = History(first).do(second, "everything")
    assert read(lines(history_records(HEAD, history, CURSOR))[0]).history == history


def test_a_history_of_another_program_does_not_follow() -> None:
    assert edit_records(History(PART), History(program(line(x_end=7.0))), CURSOR) is None


def test_cut_anywhere_the_whole_lines_before_come_back() -> None:
    data, _ = journal(*STEPS)
    ends = [0, *(index + 1 for index, byte in enumerate(data) if byte == 10)]
    wanted = {end: recovered(data[:end]) for end in ends}
    assert [None if one is None else one.length for one in wanted.values()] == [None, *ends[1:]]
    for cut in range(len(data)):
        assert recovered(data[:cut]) == wanted[max(end for end in ends if end <= cut)], cut


@settings(max_examples=200, derandomize=True, deadline=None)
@given(st.data())
def test_a_wrong_byte_is_never_taken_for_a_right_one(draws: st.DataObject) -> None:
    data, history = journal(*STEPS)
    at = draws.draw(st.integers(0, len(data) - 1))
    byte = draws.draw(st.integers(0, 255).filter(lambda one: one != data[at]))
    wrong = data[:at] + bytes([byte]) + data[at + 1 :]
    found = recovered(wrong)
    before = data[: data.rfind(b"\n", 0, at) + 1]
    assert found is None or found.history == (read(before).history if before else history)


def test_a_damaged_middle_is_told_and_a_torn_end_is_none() -> None:
    data, _ = journal(*STEPS)
    second = data.index(b"\n") + 1
    assert read(data[:second] + b"\0" * 20 + data[second:]).damaged
    assert not read(data[:-3]).damaged
    assert not read(data + b"\0" * 512).damaged


def test_a_line_left_out_ends_the_journal() -> None:
    whole = journal(*STEPS)[0].splitlines(keepends=True)
    found = read(whole[0] + b"".join(whole[2:]))
    assert found.history == History(PART)
    assert found.damaged


def test_random_bytes_are_no_journal() -> None:
    assert recovered(b"") is None
    assert recovered(b"not ours\n") is None
    assert recovered(bytes(range(256)) * 40) is None


def test_a_whole_history_is_written_with_what_was_undone() -> None:
    _, history = journal(*STEPS)
    assert history.future
    assert read(lines(history_records(HEAD, history, CURSOR))[0]).history == history


def test_other_hands_and_another_file() -> None:
    data, history = journal(typed(2.0))
    later = Head(Owner("bob", "office", 1, "", "later"), "/parts/b.toml", None)
    more, _ = lines([moved_record(later, CURSOR)], read(data).total)
    assert read(data + more).head == later
    assert read(data + more).history == history


def begun(path: Path) -> JournalFile:
    file = JournalFile(path)
    file.add([head_record(HEAD, PART, CURSOR)])
    return file


def add(file: JournalFile, old: History, step: Step) -> History:
    new = step(old)
    records = edit_records(old, new, CURSOR)
    assert records is not None
    file.add(records)
    return new


def test_every_edit_is_in_the_file_when_add_returns(tmp_path: Path) -> None:
    path, history = tmp_path / "j", History(PART)
    file = begun(path)
    for step in STEPS:
        history = add(file, history, step)
        assert read(path.read_bytes()).history == history
    file.remove()
    assert list(tmp_path.iterdir()) == []


def test_a_journal_goes_on_behind_a_torn_line(tmp_path: Path) -> None:
    path = tmp_path / "j"
    file = begun(path)
    history = add(file, History(PART), typed(2.0))
    file.close()
    path.write_bytes(path.read_bytes() + b"0000")
    held = read(path.read_bytes())
    resumed = JournalFile.resumed(path, held.length, held.total)
    history = add(resumed, history, typed(5.0))
    assert read(path.read_bytes()).history == history


def test_undo_reaches_back_over_a_save(tmp_path: Path) -> None:
    path = tmp_path / "j"
    file = begun(path)
    history = add(file, History(PART), typed(2.0))
    assert file.put_away()
    assert list(tmp_path.iterdir()) == []
    history = add(file, history, typed(5.0))
    assert read(path.read_bytes()).history == history


def test_a_very_long_journal_is_not_kept_over_a_save(tmp_path: Path) -> None:
    file = JournalFile(tmp_path / "j", unwritten=b"x" * LARGEST_KEPT)
    file.add([head_record(HEAD, PART, CURSOR)])
    assert not file.put_away()
    assert list(tmp_path.iterdir()) == []


def test_a_journal_that_stands_there_is_moved_aside(tmp_path: Path) -> None:
    path = tmp_path / "j"
    path.write_text("somebody else's")
    begun(path).remove()
    assert [one.read_text() for one in tmp_path.iterdir()] == ["somebody else's"]


def test_remove_leaves_what_another_put_there(tmp_path: Path) -> None:
    path = tmp_path / "j"
    file = begun(path)
    aside = set_aside(path, "taken")
    path.write_text("another's")
    file.remove()
    assert path.read_text() == "another's"
    assert not aside.exists(), "its own is gone, whatever it was called by then"


def test_a_shorter_journal_in_the_place_of_a_long_one(tmp_path: Path) -> None:
    path = tmp_path / "j"
    file = begun(path)
    history = History(PART)
    for number in range(50):
        history = add(file, history, typed(float(number)))
    long = path.stat().st_size
    file.replace(history_records(HEAD, History(history.program), CURSOR))
    assert path.stat().st_size < long / 3
    history = add(file, History(history.program), typed(77.0))
    assert read(path.read_bytes()).history == history


def test_a_full_disk_loses_nothing_once_there_is_room(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A write that stops in the middle is taken back, and everything is written with the next edit."""
    path = tmp_path / "j"
    file = begun(path)
    history = add(file, History(PART), typed(2.0))
    before = path.read_bytes()
    whole = os.write

    def full(handle: int, data: bytes) -> int:
        if len(data) > 4:
            return whole(handle, data[:4])
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(os, "write", lambda handle, data: full(handle, data) if len(data) > 10 else full(handle, b""))
        for number in (3.0, 4.0):
            after = typed(number)(history)
            records = edit_records(history, after, CURSOR)
            assert records is not None
            with pytest.raises(OSError, match="No space"):
                file.add(records)
            history = after
            assert path.read_bytes() == before
    history = add(file, history, typed(5.0))
    assert read(path.read_bytes()).history == history


def test_no_journal_is_begun_on_a_full_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> int:
        raise OSError(28, "No space left on device")

    file = JournalFile(tmp_path / "j")
    with monkeypatch.context() as patch:
        patch.setattr(os, "write", full)
        with pytest.raises(OSError, match="No space"):
            file.add([head_record(HEAD, PART, CURSOR)])
    assert list(tmp_path.iterdir()) == []
    history = add(file, History(PART), typed(2.0))
    assert read((tmp_path / "j").read_bytes()).history == history


def test_the_journal_of_a_link_is_beside_the_file(tmp_path: Path) -> None:
    (tmp_path / "shop").mkdir()
    (tmp_path / "shop" / "part.toml").touch()
    (tmp_path / "link.toml").symlink_to(tmp_path / "shop" / "part.toml")
    assert journal_path(tmp_path / "link.toml") == tmp_path / "shop" / ".part.toml.cutcomp-journal"


@settings(max_examples=20, derandomize=True, deadline=None)
@given(programs, programs)
def test_any_two_programs(old: Program, new: Program) -> None:
    assert applied(old, json.loads(json.dumps(delta(old, new)))) == new


def test_one_field_is_one_small_record() -> None:
    edited = type_field(PART, FormPlace(1, 2), "y_end", Number(2.5))
    assert isinstance(edited, Program)
    assert delta(PART, edited) == {"block": [0, {}, [1, 1, [["LINE", {"y_end": 2.5}]]]]}


def test_a_blank_and_an_unreadable_text() -> None:
    blank = type_field(PART, FormPlace(1), "x_start", None)
    unread = type_field(PART, FormPlace(1), "x_start", Unread("2..5", "two points"))
    assert isinstance(blank, Program)
    assert isinstance(unread, Program)
    assert delta(PART, blank) == {"block": [0, {"x_start": None}, [3, 0, []]]}
    assert delta(PART, unread) == {"block": [0, {"x_start": ["2..5", "two points"]}, [3, 0, []]]}


def test_segments_in_and_out() -> None:
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
        {"tools": [0, 2, []]},
        {"tools": [5, 0, []]},
        {"setup": {"name": 5}},
        {"setup": {"segments": 5}},
        {"block": [1, {}, [0, 0, []]]},
        {"block": [0, {"x_start": float("nan")}, [0, 0, []]]},
        {"block": [0, {"x_start": True}, [0, 0, []]]},
        {"block": [0, {"x_start": 1e9}, [0, 0, []]]},
        {"block": [0, {"cutter_comp": "UP"}, [0, 0, []]]},
        {"block": [0, {}, [0, 4, []]]},
        {"block": [0, {}, [-1, 1, []]]},
        {"block": [0, {}, [0, 0, [["SPLINE", {}]]]]},
        {"blocks": [0, 1, [[{}]]]},
    ],
)
def test_what_is_no_difference_is_refused(values: object) -> None:
    with pytest.raises(Damaged):
        applied(PART, values)


def test_a_thousand_segments_share_all_but_one() -> None:
    long = program(*(line(x_end=float(number)) for number in range(1000)))
    edited = type_field(long, FormPlace(1, 500), "x_end", Number(0.5))
    assert isinstance(edited, Program)
    again = applied(long, delta(long, edited))
    assert again == edited
    shared = zip(again.blocks[0].segments, long.blocks[0].segments, strict=True)
    assert sum(one is other for one, other in shared) == 999
    assert len(json.dumps(delta(long, edited))) < 80


def test_units_change_everything() -> None:
    metric = replace(PART, unit=type(PART.unit)("IN"))
    assert delta(PART, metric) == {"unit": "IN"}
