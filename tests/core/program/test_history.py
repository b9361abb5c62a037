"""Undo and redo, and the middle in which two tuples differ."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.program.history import History, splice
from core.program.model import PartSetup, Program


def named(name: str) -> Program:
    return Program(setup=PartSetup(name))


def test_a_fresh_history_has_nothing_to_undo():
    fresh = History(named("a"))
    assert fresh.undo() is fresh
    assert fresh.redo() is fresh
    assert (fresh.undo_label, fresh.redo_label, fresh.undo_count, fresh.redo_count) == (None, None, 0, 0)


def test_undo_and_redo_reverse_each_other():
    history = History(named("a")).do(named("b"), "X END").do(named("c"), "Y END")
    assert (history.undo_label, history.undo_count) == ("Y END", 2)
    back = history.undo()
    assert (back.program, back.undo_label, back.redo_label) == (named("b"), "X END", "Y END")
    further = back.undo()
    assert (further.program, further.undo_label, further.redo_label) == (named("a"), None, "X END")
    assert further.redo() == back
    assert further.redo().redo() == history


def test_an_edit_after_undo_discards_undone_edits():
    history = History(named("a")).do(named("b"), "one").undo().do(named("c"), "two")
    assert (history.program, history.redo_count, history.undo_count) == (named("c"), 0, 1)


def test_an_edit_without_a_change_is_not_recorded():
    history = History(named("a")).do(named("b"), "one").undo()
    assert history.do(named("a"), "nothing") is history


@settings(derandomize=True, max_examples=100)
@given(st.lists(st.sampled_from(["undo", "redo", "do"]), max_size=30))
def test_the_history_behaves_like_a_list_with_a_cursor(steps):
    history, programs, at = History(named("0")), [named("0")], 0
    for index, step in enumerate(steps, 1):
        if step == "undo":
            history, at = history.undo(), max(0, at - 1)
        elif step == "redo":
            history, at = history.redo(), min(len(programs) - 1, at + 1)
        else:
            history = history.do(named(str(index)), step)
            programs[at + 1 :] = [named(str(index))]
            at += 1
        assert (history.program, history.undo_count) == (programs[at], at)
        assert history.redo_count == len(programs) - 1 - at


@pytest.mark.parametrize(
    ("old", "new", "at", "removed", "added"),
    [
        ("abc", "abc", 3, "", ""),
        ("abc", "axc", 1, "b", "x"),
        ("abc", "abbc", 2, "", "b"),
        ("aaa", "aa", 2, "a", ""),
        ("", "xy", 0, "", "xy"),
        ("xy", "", 0, "xy", ""),
    ],
)
def test_splice_finds_the_shortest_middle(old: str, new: str, at: int, removed: str, added: str) -> None:
    result = splice(tuple(old), tuple(new))
    assert (result.at, "".join(result.old), "".join(result.new)) == (at, removed, added)
