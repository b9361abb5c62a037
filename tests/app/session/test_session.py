"""The session's pure methods."""

from __future__ import annotations

from dataclasses import replace

from app.documents.programs import empty_program
from app.session.changes import changed
from app.session.session import SEGMENT, Session
from core.pipeline.fields_stage import solve_fields
from core.program.edit import FormPlace
from core.program.model import LineSegment, Number, Program


def session(*segments: LineSegment) -> Session:
    program = empty_program()
    return Session.of(replace(program, blocks=(replace(program.blocks[0], segments=segments),)))


def with_start(program: Program, x: float) -> Program:
    return replace(program, blocks=(replace(program.blocks[0], x_start=Number(x)),))


def test_an_edit_makes_it_unsaved_and_saving_or_undoing_it_ends_that():
    begun = session()
    edited = begun.with_program(with_start(begun.program, 1.0), "X START")
    assert (begun.unsaved, edited.unsaved) == (False, True)
    assert not replace(edited, saved=edited.program).unsaved
    assert not edited.undone().unsaved
    assert edited.undone().redone().program == edited.program


def test_the_cursor_stays_within_the_program():
    begun = session(LineSegment(), LineSegment())
    assert begun.at(FormPlace(7, 9)).place == FormPlace(1, 2)
    assert begun.at(FormPlace(0, -1)).place == FormPlace(1, 0)


def test_undo_and_redo_lead_the_cursor_to_the_field_that_they_change():
    begun = session(LineSegment(), LineSegment(y_end=Number(1.0)))
    block = begun.program.blocks[0]
    typed = replace(block, segments=(block.segments[0], LineSegment(y_end=Number(2.0))))
    edited = begun.with_program(replace(begun.program, blocks=(typed,)), "Y END").at(FormPlace(1, 0))
    undone = edited.undone()
    assert (undone.place, undone.cursor.field) == (FormPlace(1, 2), "y_end")
    redone = undone.at(FormPlace(1, 0)).redone()
    assert (redone.place, redone.cursor.field) == (FormPlace(1, 2), "y_end")


def test_undoing_a_new_segment_takes_the_cursor_off_it():
    begun = session(LineSegment())
    longer = replace(begun.program.blocks[0], segments=(LineSegment(), LineSegment()))
    edited = begun.with_program(replace(begun.program, blocks=(longer,)), "LINE").at(FormPlace(1, 2), "x_end")
    assert (edited.undone().place, edited.undone().cursor.field) == (FormPlace(1, 1), SEGMENT)


def test_what_is_no_blocks_matter_leaves_the_cursor_and_equal_programs_differ_nowhere():
    begun = session(LineSegment())
    named = replace(begun.program, setup=replace(begun.program.setup, name="PLATE"))
    edited = begun.with_program(named, "PART NAME").at(FormPlace(1, 1), "x_end")
    assert edited.undone().place == FormPlace(1, 1)
    assert changed(begun.program, begun.program) is None


def test_what_was_worked_out_for_another_program_is_dropped():
    begun = session()
    late = solve_fields(begun.program)
    edited = begun.with_program(with_start(begun.program, 1.0), "X START")
    assert edited.knowing(late).derived is edited.derived
    assert edited.knowing(known := solve_fields(edited.program)).derived is known
