"""Undo and redo, and the differences between two programs in words."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.program.edit import (
    FormPlace,
    choose,
    copy_block,
    delete_segment,
    delete_tool,
    insert_segment,
    set_setup,
    set_tool,
    set_unit,
    type_field,
)
from core.program.history import History, differences, splice
from core.program.model import ArcSegment, CutterComp, LineSegment, Number, PartSetup, Program, Relative, Tool, Unread
from core.units import Unit
from tests.core.program.parts import line, program, programs


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


PART = program(line(x_end=1.0), line(y_end=1.0), line(x_end=0.0), unit=Unit.IN)


def differences_to(edited: object) -> tuple[str, ...]:
    assert isinstance(edited, Program)
    return differences(PART, edited)


def test_differences_name_changed_fields() -> None:
    assert differences_to(type_field(PART, FormPlace(1, 2), "y_end", Number(2.5))) == (
        "Block 1, segment 2: Y END 2.5000, was 1.0000.",
    )
    assert differences_to(type_field(PART, FormPlace(1), "x_start", None)) == ("Block 1: X START blank, was 0.0000.",)
    unread = type_field(PART, FormPlace(1, 1), "x_end", Unread("2..5", ""))
    assert differences_to(unread) == ("Block 1, segment 1: X END 2..5 (cannot be used), was 1.0000.",)


def test_differences_name_changed_choices() -> None:
    block = replace(PART.blocks[0], cutter_comp=CutterComp.RIGHT)
    assert differences_to(replace(PART, blocks=(block,))) == ("Block 1: CUTTER COMP. RIGHT, was LEFT.",)


def test_differences_say_what_a_field_takes_besides_numbers() -> None:
    relative = type_field(PART, FormPlace(1, 1), "x_end", Relative(2.0))
    assert differences_to(relative) == ("Block 1, segment 1: X END I2.0000, was 1.0000.",)
    tangent = choose(PART, FormPlace(1, 2), "tangent", "YES")
    assert differences_to(tangent) == ("Block 1, segment 2: TANGENT YES, was NO.",)
    picked = choose(PART, FormPlace(1, 2), "choice", 1)
    assert differences_to(picked) == ("Block 1, segment 2: solution changed.",)


def test_differences_name_changed_segments() -> None:
    assert differences_to(insert_segment(PART, FormPlace(1, 2), LineSegment())) == ("Block 1, segment 2 is new.",)
    assert differences_to(delete_segment(PART, FormPlace(1, 3))) == ("Block 1, segment 3 is deleted.",)
    first, *_ = PART.blocks[0].segments
    arc = replace(PART.blocks[0], segments=(first, ArcSegment(), *PART.blocks[0].segments[2:]))
    assert differences_to(replace(PART, blocks=(arc,))) == ("Block 1, segment 2: ARC, was LINE.",)
    fewer = replace(PART.blocks[0], segments=(ArcSegment(),))
    assert differences_to(replace(PART, blocks=(fewer,))) == ("Block 1, segments 1 to 3: 3 replaced by 1.",)


def test_differences_name_new_blocks_and_changed_tools() -> None:
    assert differences_to(copy_block(PART, 1)) == ("Block 2 is new.",)
    assert differences_to(set_tool(PART, Tool(7))) == ("Tool 7 is new.",)
    assert differences_to(delete_tool(PART, 1)) == ("Tool 1 is deleted.",)
    assert differences_to(set_tool(PART, Tool(1, "BALL", Number(0.5)))) == ("Tool 1: TYPE BALL, was END MILL.",)


def test_differences_name_changed_setup_and_units() -> None:
    assert differences_to(set_setup(PART, "name", "COVER")) == ("PART SETUP: PART NAME COVER, was blank.",)
    assert differences_to(set_unit(PART, Unit.MM)) == ("Program units: MM, was IN.",)


@settings(max_examples=12, derandomize=True, deadline=None)
@given(programs, programs)
def test_differences_are_reported_if_and_only_if_programs_differ(old: Program, new: Program) -> None:
    assert differences(old, old) == ()
    assert bool(differences(old, new)) is (old != new)
    assert all(sentence.isprintable() for sentence in differences(old, new))


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
