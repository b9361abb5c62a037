from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from textual.app import App, ComposeResult
from textual.widgets import Static

from app.documents.files import load
from app.documents.programs import empty_program, example
from app.session.formats import segment_numbers
from app.widgets.verdict import MARKS_OF_CHARACTERS, Case, Verdict, chips, strip, title
from core.finding import Finding, Severity
from core.pipeline.derive import derive, look_ahead_table
from core.pipeline.derived import DerivedBlock
from core.program.model import ArcSegment, Number, Unread, changed
from core.units import Unit


def case_of(name: str) -> Case:
    program = load(example(name))
    block = derive(program).block(1)
    return Case(block, look_ahead_table(block, program), program.unit)


@pytest.fixture(scope="module")
def pocket() -> Case:
    return case_of("pocket")


@pytest.fixture(scope="module")
def notch() -> Case:
    return case_of("notch")


def test_the_pocket_has_the_designed_title_strip_and_chips(pocket):
    marks = MARKS_OF_CHARACTERS["braille"]
    assert title(pocket) == "LOOK-AHEAD CAL 8 deletes segment 9"
    assert strip(pocket, marks).plain == " 1 ✖•••••• 8 •••••••••••• 20   best 2: deletes 9"
    assert chips(pocket, marks).plain == "✓ GOUGE none   ▲ UNCUT 1.9367 long   × DELETED 9"


def test_the_strip_fills_as_values_become_known(pocket):
    marks = MARKS_OF_CHARACTERS["braille"]
    waiting = replace(pocket, table=None)
    assert strip(waiting, marks).plain.startswith(" 1 ••••••• 8 ")
    some = strip(replace(waiting, rows=pocket.table.rows[:3]), marks)
    assert some.plain.startswith(" 1 ✖•••••• 8 ")
    looks = {str(span.style) for span in some.spans if span.start in (4, 5, 6)}
    assert looks == {"$c-deleted", "$c-label"}, "two are judged, the next one is not"


def test_a_gouge_comes_first_in_title_and_chips(notch):
    assert title(notch).startswith("LOOK-AHEAD CAL 2 gouges segment ")
    assert chips(notch, MARKS_OF_CHARACTERS["braille"]).plain.startswith("✖ GOUGE 0.2500")


def test_every_character_set_has_a_cell_for_each_value(pocket):
    for characters, marks in MARKS_OF_CHARACTERS.items():
        line = strip(pocket, marks).plain
        assert line.startswith(f" 1 {marks.gouge}"), characters
        assert line.index(" 20") == 3 + 7 + 3 + 12
    assert chips(pocket, MARKS_OF_CHARACTERS["ascii"]).plain.isascii()


def test_the_title_shows_the_progress_of_the_calculation(pocket):
    assert title(replace(pocket, working=0.4)) == "LOOK-AHEAD CAL 8  working 40 %"


def test_without_a_table_no_value_is_called_best(pocket):
    assert strip(replace(pocket, table=None), MARKS_OF_CHARACTERS["braille"]).plain.rstrip().endswith(" 20")


def test_the_chips_show_an_error_after_a_clean_beginning():
    program = load(example("pocket"))
    block = program.blocks[0]
    third = changed(block.segments[2], {"x_end": Unread("4.7.5", "not a number")})
    spoiled = replace(program, blocks=(replace(block, segments=(*block.segments[:2], third, *block.segments[3:])),))
    block_with_error = derive(spoiled).block(1)
    case = Case(block_with_error, look_ahead_table(block_with_error, spoiled), program.unit)
    assert title(case).endswith("segments 1-2 only")
    assert chips(case, MARKS_OF_CHARACTERS["braille"]).plain.startswith("✖ Segment 3, X END: 4.7.5 ")
    assert "none" not in chips(case, MARKS_OF_CHARACTERS["braille"]).plain
    # a sentence too long for the line is cut after its last part that has room
    fourth = replace(ArcSegment(), start_angle=Unread("y", "y is not a number: type degrees such as 22.5"))
    spoiled = replace(program, blocks=(replace(block, segments=(*block.segments[:3], fourth)),))
    case = Case(derive(spoiled).block(1), None, program.unit)
    assert chips(case, MARKS_OF_CHARACTERS["braille"]).plain == "✖ Segment 4, START ANGLE: y is not a number."
    # a segment that is only incomplete is no error
    blank = changed(block.segments[2], {"x_end": None})
    waiting = replace(program, blocks=(replace(block, segments=(*block.segments[:2], blank, *block.segments[3:])),))
    assert (
        "GOUGE none" in chips(Case(derive(waiting).block(1), None, program.unit), MARKS_OF_CHARACTERS["braille"]).plain
    )


def test_the_chips_of_a_clean_path_with_a_warning_point_to_f10(pocket):
    program = load(example("pocket"))
    changed_block = replace(program.blocks[0], lookahead=Number(3.0))
    typed = replace(program, blocks=(changed_block,))
    block = derive(typed).block(1)
    assert any(finding.severity is Severity.WARNING for finding in block.findings)
    assert chips(Case(block, None, program.unit), MARKS_OF_CHARACTERS["braille"]).plain.endswith("▲ see F10")
    assert "F10" not in chips(pocket, MARKS_OF_CHARACTERS["braille"]).plain


def test_the_chips_of_a_clean_path_with_an_error_point_to_f10_first():
    program = load(example("pocket"))
    unread = Unread("12o", "not a number")
    for spoiled in (
        replace(program.blocks[0], speed=unread, lookahead=Number(3.0)),
        replace(
            program.blocks[0],
            segments=(changed(program.blocks[0].segments[0], {"length": unread}), *program.blocks[0].segments[1:]),
        ),
    ):
        block = derive(replace(program, blocks=(spoiled,))).block(1)
        assert block.errors
        assert chips(Case(block, None, program.unit), MARKS_OF_CHARACTERS["braille"]).plain.endswith("✖ see F10")


def test_the_chips_of_many_deleted_segments_still_point_to_f10(pocket):
    paths = pocket.block.paths
    gone = replace(paths.compensated.deleted, segments=np.array([2.0, 4.0, 5.5, 6.0, 8.0]))
    compensated = replace(paths.compensated, deleted=gone)
    warning = Finding("ANY", Severity.WARNING, "A warning.", 2)
    block = replace(pocket.block, paths=replace(paths, compensated=compensated))
    case = Case(replace(block, findings=(warning,)), None, Unit.MM)
    line = chips(case, MARKS_OF_CHARACTERS["braille"]).plain
    assert line == "✓ GOUGE none  ▲ UNCUT 49.191 long  × 4 DELETED  ▲ see F10"
    assert len(line) <= 57
    without = chips(Case(replace(block, findings=()), None, Unit.MM), MARKS_OF_CHARACTERS["braille"]).plain
    assert without == "✓ GOUGE none   ▲ UNCUT 49.191 long   × DELETED 2 4 6 8"


def test_an_empty_block_says_what_to_type_first():
    program = empty_program()
    block: DerivedBlock = derive(program).block(1)
    assert (
        chips(Case(block, None, Unit.IN), MARKS_OF_CHARACTERS["braille"]).plain
        == " Fill in START, then Page Down for segment 1."
    )


def test_runs_of_segment_numbers_are_joined():
    assert segment_numbers((4.0, 2.0, 3.0, 3.5, 7.0)) == "2-4 7"


async def test_the_widget_shows_a_new_case_at_once(pocket, notch):
    class Shown(App[None]):
        def get_css_variables(self) -> dict[str, str]:
            roles = dict.fromkeys(("c-label", "c-gouge", "c-uncut", "c-deleted", "c-good"), "red")
            return {**super().get_css_variables(), **roles}

        def compose(self) -> ComposeResult:
            yield Verdict()

    app = Shown()
    async with app.run_test() as pilot:
        verdict = app.query_one(Verdict)
        for case in (pocket, notch):
            verdict.case = case
            await pilot.pause()
            assert verdict.border_title == title(case)
            assert str(app.query_one("#chips", Static).content) == str(chips(case, MARKS_OF_CHARACTERS["braille"]))


def test_the_chips_say_why_there_is_no_path():
    program = load(example("pocket"))
    program = replace(program, blocks=(replace(program.blocks[0], tool=Number(9.0)),))
    case = Case(derive(program).block(1), None, program.unit)
    assert chips(case, MARKS_OF_CHARACTERS["braille"]).plain.startswith("✖ Tool 9")
    assert len(chips(case, MARKS_OF_CHARACTERS["braille"])) <= 58
