"""The pure methods of the session."""

from __future__ import annotations

from dataclasses import replace

from app.documents.programs import empty_program
from app.session.session import Session, changed
from core.pipeline.derived import solve_fields
from core.program.edit import SEGMENT_FIELD, FormPlace
from core.program.model import LineSegment, Number, Program


def session(*segments: LineSegment) -> Session:
    program = empty_program()
    return Session.of(replace(program, blocks=(replace(program.blocks[0], segments=segments),)))


def with_start(program: Program, x: float) -> Program:
    return replace(program, blocks=(replace(program.blocks[0], x_start=Number(x)),))


def test_an_edit_is_unsaved_until_it_is_saved_or_undone():
    before = session()
    edited = before.with_program(with_start(before.program, 1.0), "X START")
    assert (before.unsaved, edited.unsaved) == (False, True)
    assert not replace(edited, saved=edited.program).unsaved
    assert not edited.undone().unsaved
    assert edited.undone().redone().program == edited.program


def test_the_cursor_stays_within_the_program():
    before = session(LineSegment(), LineSegment())
    assert before.at(FormPlace(7, 9)).place == FormPlace(1, 2)
    assert before.at(FormPlace(0, -1)).place == FormPlace(1, 0)


def test_undo_and_redo_move_the_cursor_to_the_field_they_change():
    before = session(LineSegment(), LineSegment(y_end=Number(1.0)))
    block = before.program.blocks[0]
    typed = replace(block, segments=(block.segments[0], LineSegment(y_end=Number(2.0))))
    edited = before.with_program(replace(before.program, blocks=(typed,)), "Y END").at(FormPlace(1, 0))
    undone = edited.undone()
    assert (undone.place, undone.cursor.field) == (FormPlace(1, 2), "y_end")
    redone = undone.at(FormPlace(1, 0)).redone()
    assert (redone.place, redone.cursor.field) == (FormPlace(1, 2), "y_end")


def test_undoing_a_new_segment_moves_the_cursor_off_it():
    before = session(LineSegment())
    longer = replace(before.program.blocks[0], segments=(LineSegment(), LineSegment()))
    edited = before.with_program(replace(before.program, blocks=(longer,)), "LINE").at(FormPlace(1, 2), "x_end")
    assert (edited.undone().place, edited.undone().cursor.field) == (FormPlace(1, 1), SEGMENT_FIELD)


def test_a_change_outside_the_blocks_keeps_the_cursor_and_equal_programs_have_no_change():
    before = session(LineSegment())
    named = replace(before.program, setup=replace(before.program.setup, name="PLATE"))
    edited = before.with_program(named, "PART NAME").at(FormPlace(1, 1), "x_end")
    assert edited.undone().place == FormPlace(1, 1)
    assert changed(before.program, before.program) is None


def test_results_for_another_program_are_dropped():
    before = session()
    late = solve_fields(before.program)
    edited = before.with_program(with_start(before.program, 1.0), "X START")
    assert edited.with_derived(late).derived is edited.derived
    assert edited.with_derived(known := solve_fields(edited.program)).derived is known
