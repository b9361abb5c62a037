"""The session's pure methods."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from app.documents.programs import empty_program
from app.painted.session import SEGMENT, Session, Tone
from core.pipeline.outline import outline
from core.program.edit import FormPlace, Refused
from core.program.model import LineSegment, Number, Program


def session(*segments: LineSegment) -> Session:
    program = empty_program()
    return Session.of(replace(program, blocks=(replace(program.blocks[0], segments=segments),)))


def with_start(program: Program, x: float) -> Program:
    return replace(program, blocks=(replace(program.blocks[0], x_start=Number(x)),))


def test_a_new_session_is_saved_and_stands_on_segment_of_start() -> None:
    begun = session()
    assert not begun.unsaved
    assert (begun.where, begun.field) == (FormPlace(1, 0), SEGMENT)


def test_an_edit_makes_it_unsaved_and_saving_ends_that() -> None:
    begun = session()
    edited = begun.apply(with_start(begun.program, 1.0), "X START")
    assert edited.unsaved
    assert not begun.unsaved
    assert not edited.named(Path("part.toml")).unsaved
    assert edited.undo().unsaved is False


def test_a_refused_edit_changes_nothing_but_the_message() -> None:
    begun = session()
    refused = begun.apply(Refused("No."), "X START")
    assert refused.program is begun.program
    assert refused.said is not None
    assert (refused.said.text, refused.said.tone) == ("No.", Tone.ERROR)
    assert refused.quiet().said is None


def test_undo_names_what_it_took_back_and_redo_brings_it_again() -> None:
    begun = session()
    edited = begun.apply(with_start(begun.program, 1.0), "X START")
    undone = edited.undo()
    assert undone.program is begun.program
    assert undone.said is not None
    assert "X START" in undone.said.text
    assert undone.redo().program == edited.program


def test_there_is_nothing_to_undo_at_first() -> None:
    said = session().undo().said
    assert said is not None
    assert said.text == "There is nothing to undo."


def test_the_cursor_stays_within_the_program() -> None:
    begun = session(LineSegment(), LineSegment())
    assert begun.at(FormPlace(7, 9)).where == FormPlace(1, 2)
    assert begun.at(FormPlace(0, -1)).where == FormPlace(1, 0)


def test_undoing_a_segment_takes_the_cursor_off_it() -> None:
    begun = session(LineSegment())
    longer = replace(begun.program.blocks[0], segments=(LineSegment(), LineSegment()))
    edited = begun.apply(replace(begun.program, blocks=(longer,)), "new LINE").at(FormPlace(1, 2), "x_end")
    assert edited.undo().where == FormPlace(1, 1)
    assert edited.undo().field == SEGMENT


def test_a_late_result_for_another_program_is_dropped() -> None:
    begun = session()
    late = outline(begun.program)
    edited = begun.apply(with_start(begun.program, 1.0), "X START")
    assert edited.stale
    assert edited.knowing(late).stale
    assert not edited.knowing(outline(edited.program)).stale
