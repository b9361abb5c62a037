"""What the engine keeps from key to key."""

from __future__ import annotations

from dataclasses import replace

import pytest

from app.documents.files import load
from app.documents.programs import example
from app.painted.desk import Desk
from app.painted.engine import Engine, Known, derived_again
from app.painted.screens.contour import Contour
from app.painted.screens.draw import DrawPage
from app.painted.screens.findings import FindingsPage
from app.painted.screens.lookahead import LookaheadTable
from app.painted.screens.page import WHOLE, Surface
from app.painted.session import Session
from app.painted.widgets.rows import text_of
from core.advice.block_paths import BlockPaths
from core.finding import Finding, Severity
from core.pipeline.derive import advice_for_block, derive
from core.pipeline.derived import DerivedBlock
from core.pipeline.outline import outline
from core.program.edit import FormPlace, copy_block, type_field
from core.program.model import Number, Program
from tests.bench.keys import gear

PART = load(example("notch"))


@pytest.fixture
def engine() -> Engine:
    engine = Engine(ready=True)
    found = derive(PART).blocks[0]
    engine.keep_table(found, PART)
    engine.keep_needs(found, PART)
    return engine


def changed(where: FormPlace, field: str, value: float) -> tuple[DerivedBlock, Program]:
    """The block after one number was typed."""
    program = type_field(PART, where, field, Number(value))
    assert isinstance(program, Program)
    return derive(program).blocks[0], program


def test_another_path_has_another_table(engine: Engine) -> None:
    found, program = changed(FormPlace(1, 1), "x_end", 2.5)
    assert not engine.tabulated(found)
    assert engine.known(found, None).table is None
    engine.keep_table(found, program)
    assert engine.tabulated(found)
    assert engine.lacks_needs(found)


def test_another_depth_keeps_the_table_and_what_the_contour_needs() -> None:
    engine, before = Engine(ready=True), derive(PART)
    engine.keep_table(before.blocks[0], PART)
    engine.keep_needs(before.blocks[0], PART)
    program = type_field(PART, FormPlace(1, 0), "z_bottom", Number(-0.5))
    assert isinstance(program, Program)
    found = derived_again(program, before).blocks[0]
    assert found is not before.blocks[0]
    assert engine.tabulated(found)
    assert not engine.lacks_needs(found)
    assert engine.known(found, None).table is engine.known(before.blocks[0], None).table


EDITS = [
    *((FormPlace(1, 0), "tool", text) for text in ("1", "3", "7")),
    *((FormPlace(1, 0), "z_bottom", text) for text in ("-.1", "-0", "2")),
    *((FormPlace(1, 1), "x_end", text) for text in ("2.5", ".1", "-0", "9")),
    (FormPlace(1, 0), "lookahead", "1"),
]


@pytest.mark.parametrize("name", ["notch", "pocket", "flange", "plate-mm"])
@pytest.mark.parametrize(("where", "field", "text"), EDITS)
def test_what_was_tried_out_is_what_would_be_derived_of_an_equal_program(
    name: str, where: FormPlace, field: str, text: str
) -> None:
    part = load(example(name))
    tried, accepted = (type_field(part, where, field, Number(float(text))) for _ in range(2))
    assert isinstance(tried, Program)
    assert isinstance(accepted, Program)
    engine = Engine(ready=True)
    engine.derive(tried, derive(part))
    held = engine.held(accepted)
    assert held is not None
    assert held.program is accepted
    assert all(one.block is block for one, block in zip(held.blocks, accepted.blocks, strict=True))
    assert [plain(one) for one in held.blocks] == [plain(one) for one in derive(accepted).blocks]


def plain(found: DerivedBlock) -> tuple[object, ...]:
    """All that is derived, in values that can be compared."""
    told = (found.number, found.block, found.lookahead, found.side, found.profile, found.radius, found.known)
    return (*told, found.solved, found.findings, None if found.paths is None else cut(found.paths))


def cut(work: BlockPaths) -> tuple[object, ...]:
    """The paths and what they do."""
    paths = [work.surface, *(loop.whole for loop in work.loops)]
    arrays = [array.tolist() for path in paths for array in (path.points, path.centers, path.turns, path.numbers)]
    verdict = work.verdict
    return arrays, None if verdict is None else (verdict.clean, verdict.uncut_length, verdict.clearance)


def test_nothing_is_held_of_another_program() -> None:
    engine = Engine(ready=True)
    assert engine.held(PART) is None
    engine.derive(PART, derive(PART))
    assert engine.held(PART) is not None
    assert engine.held(changed(FormPlace(1, 1), "x_end", 2.5)[1]) is None


def drawn(known: Known, session: Session) -> str:
    """The drawing's text in 40 x 12 cells."""
    return "".join(text_of(row) for row in known.drawing(Desk(session), WHOLE, 40, 12)).strip()


def test_until_the_new_path_is_there_the_drawing_of_this_block_stands_and_never_another_one() -> None:
    known, program = Known(ready=True), copy_block(PART, 1)
    assert isinstance(program, Program)
    session = Session.of(program)
    shown = drawn(known, session.knowing(derive(program)))
    assert shown
    edited = type_field(program, FormPlace(1, 1), "x_end", Number(2.5))
    assert isinstance(edited, Program)
    stale = session.apply(edited, "X END").knowing(outline(edited))
    assert not stale.found.known
    assert drawn(known, stale) == shown
    for other in (stale.at(FormPlace(2)), Session.of(edited)):
        contour = drawn(Known(ready=True), other)
        assert contour != shown
        assert drawn(known, other) == contour


def test_nothing_is_complete_before_the_notes_and_the_needs_are_known() -> None:
    engine, found = Engine(ready=True), derive(PART).blocks[0]
    assert not engine.lacks_notes(found)
    engine.keep_table(found, PART)
    complete = []
    for keep in (lambda: engine.keep_notes(found), lambda: engine.keep_needs(found, PART)):
        table = engine.known(found, None).table
        assert table is not None
        complete.append(table.complete)
        keep()
    table = engine.known(found, None).table
    assert table is not None
    assert [*complete, table.complete] == [False, False, True]
    assert table is engine.known(found, None).table


def test_a_page_is_made_again_for_another_session_page_or_room_and_shows_the_table_only_where_it_says_so() -> None:
    session, known, page, room = Session.of(PART), Known(), Contour(), Surface()
    view = known.view(page, session, room)
    assert known.view(page, session, room) is view
    for other in (known.view(Contour(), session, room), known.view(page, session.at(FormPlace(1, 1)), room)):
        assert other is not view
    assert known.view(page, session, room._replace(width=132)) is not view
    assert [one for one in (Contour, DrawPage, LookaheadTable, FindingsPage) if one.tabled] == [
        LookaheadTable,
        FindingsPage,
    ]


def test_needs_that_were_given_up_are_not_known(engine: Engine) -> None:
    program = gear(24)
    found = derive(program).blocks[0]
    engine.keep_table(found, program)
    engine.keep_needs(found, program, lambda: False)
    assert engine.lacks_needs(found)
    engine.keep_needs(found, program)
    assert not engine.lacks_needs(found)


def test_needs_are_remembered_and_told_of_what_is_accepted_alone(engine: Engine) -> None:
    accepted, tried = derive(PART).blocks[0], changed(FormPlace(1, 1), "x_end", 2.5)
    engine.keep_table(*tried)
    engine.keep_needs(*tried)
    for found, before, told in ((tried[0], accepted, False), (tried[0], tried[0], True), (tried[0], None, True)):
        table = engine.known(found, None, before).table
        assert table is not None
        assert any(one.code == "CAL_NOT_CLEAN" for one in table.notes) is told
    assert not engine.lacks_needs(tried[0])


def test_what_a_better_path_would_cut_is_told_of_what_is_accepted_alone(engine: Engine) -> None:
    accepted, (found, program) = derive(PART).blocks[0], changed(FormPlace(1, 1), "x_end", 2.5)
    note = Finding("BEST_DIFFERS", Severity.INFO, "A better path would cut more.")
    engine.keep_table(found, program)
    assert found.paths is not None
    engine.notes = ((found.paths, (note,)),)
    for before, told in ((accepted, False), (found, True), (None, True)):
        table = engine.known(found, None, before).table
        assert table is not None
        assert (note in table.notes) is told


def test_what_is_said_of_one_calculated_value_is_never_said_of_another(engine: Engine) -> None:
    found = derive(PART).blocks[0]
    engine.keep_table(found, PART)
    for calculated in (found.lookahead.calculated, 1, 5):
        other = replace(found, lookahead=replace(found.lookahead, calculated=calculated))
        engine.keep_needs(other, PART)
        told, table = advice_for_block(other, PART), engine.known(other, None).table
        assert told is not None
        assert table is not None
        assert table.notes[: len(told.sentences)] == told.sentences
