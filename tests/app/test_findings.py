"""What is told of a block: calm while it is begun, all of it by one key, what is left before it is posted."""

from __future__ import annotations

from dataclasses import replace

import pytest

from app.documents.files import load
from app.documents.programs import example
from app.painted.desk import Desk
from app.painted.screens.contour import Contour
from app.painted.screens.findings import FindingsPage
from app.painted.screens.help import HelpPage
from app.painted.screens.page import Surface
from app.painted.session import Session
from app.painted.widgets.rows import Span, plain, text_of
from app.painted.widgets.verdict import fitted, verdict_rows
from core.pipeline.derive import derive, look_ahead_table
from core.program.model import Number, Program
from tests.app.operator import Operator


def derived(name: str) -> Operator:
    """An example with everything that follows from it."""
    program = load(example(name))
    session = Session.of(program).knowing(derive(program))
    return Operator(Desk(session))


def verdict(operator: Operator) -> list[str]:
    found, program = operator.session.found, operator.session.program
    table = look_ahead_table(found, program)
    return [text_of(row) for row in verdict_rows(found, table, program.unit, None)]


def test_a_block_without_segments_begins_with_a_hint() -> None:
    operator = Operator.at()
    assert verdict(operator)[1:] == [" Type START, then right arrow for the first segment."]
    assert "!!" not in "\n".join(operator.press("tab", "down", "down", "down").screen())
    assert "!! block 1" in operator.press("f8", "f6").part("body")


def test_what_cannot_be_read_is_an_error_even_there() -> None:
    operator = Operator.at().press("tab", "down", "down", "down").type("1..5")
    assert any("!!" in line for line in verdict(operator))


@pytest.mark.parametrize("keys", [(), ("tab",), ("f4",), ("f5",), ("f6",), ("f8",)])
def test_one_key_shows_the_findings_from_every_form(keys: tuple[str, ...]) -> None:
    operator = derived("notch").press(*keys, "ctrl+f")
    assert isinstance(operator.desk.page, FindingsPage)
    assert not isinstance(operator.press("escape").desk.page, FindingsPage)


def test_that_key_opens_it_once_and_not_where_no_verdict_stands() -> None:
    assert isinstance(derived("notch").press("ctrl+f", "ctrl+f", "escape").desk.page, Contour)
    assert "from its form" in derived("notch").press("f8", "f6", "ctrl+f").said


@pytest.mark.parametrize("keys", [("ctrl+end", "right"), ("f4", "right"), ("tab", "9", "enter", "ctrl+q"), ("ctrl+s",)])
@pytest.mark.parametrize("look", ["ctrl+f", "ctrl+g"])
def test_a_question_beside_the_verdict_is_still_there_behind_what_only_looks(keys: tuple[str, ...], look: str) -> None:
    operator = derived("notch").press(*keys)
    page, history = operator.desk.page, operator.session.history
    operator.press(look)
    assert isinstance(operator.desk.page, FindingsPage if look == "ctrl+f" else HelpPage)
    operator.press("ctrl+z", "ctrl+y", "escape")
    assert operator.desk.page is page
    assert operator.session.history is history


def test_how_many_more_names_the_key() -> None:
    rows = fitted([plain(f" line {one}") for one in range(5)], 3, 59)
    assert text_of(rows[-1]).endswith(" +2 more: Ctrl+F")


def test_a_finding_that_is_cut_names_the_key_also_where_it_is_the_only_one() -> None:
    rows = fitted([plain(f" {'word ' * 40}")], 2, 59)
    assert text_of(rows[-1]).endswith("…  Ctrl+F")
    assert {len(text_of(row)) <= 59 for row in rows} == {True}
    assert "Ctrl+F" not in "".join(text_of(row) for row in fitted([plain(" word")], 2, 59))


def test_the_strip_tells_what_the_best_value_costs() -> None:
    assert verdict(derived("overrun-square"))[0].endswith("best 1")
    assert verdict(derived("pocket"))[0].endswith("best 2 (deletes 9)")
    assert verdict(derived("flange"))[0].endswith("best 1")


def test_every_gouge_is_told_in_full() -> None:
    operator = derived("notch")
    operator.press("ctrl+f")
    work = operator.session.found.paths
    assert work is not None
    assert work.verdict is not None
    body = operator.part("body", 132, 60)
    assert work.verdict.gouges
    assert body.count("deep in segment") == len(work.verdict.gouges)


def test_the_dialog_says_what_is_left_and_what_is_not_saved() -> None:
    operator = derived("notch").press("f8", "f6")
    assert "not saved" not in operator.part("body")
    told = derived("pocket").press("f8", "f6").part("body")
    assert " UNCUT   block 1 1.9367" in told
    assert " DELETED block 1 segments 9" in told
    edited = Operator.at().press("tab").type("2").press("f8", "f6")
    assert "The program is not saved: Esc, then Ctrl+S." in edited.part("body")


def test_nothing_is_called_right_before_the_verdict_is_there() -> None:
    operator = Operator.at(load(example("notch"))).press("f8", "f6")
    assert not operator.session.found.known
    assert "Nothing stands against posting." not in operator.part("body")
    assert "being calculated" in operator.part("body")
    told = Operator.at(load(example("notch"))).press("ctrl+f").part("body")
    assert "Nothing to report." not in told
    assert "being calculated" in told
    assert "Nothing stands against posting." in derived("pocket").press("f8", "f6").part("body")
    assert "being calculated" not in derived("pocket").press("f8", "f6").part("body")


@pytest.mark.parametrize("keys", [(), ("f7",)], ids=["form", "draw"])
@pytest.mark.parametrize("comp", ["l", "o"], ids=["LEFT", "ON"])
def test_every_drawing_says_so_while_its_path_is_being_calculated(keys: tuple[str, ...], comp: str) -> None:
    operator = Operator.at(load(example("overrun-square"))).press("tab", "down", comp, "enter", *keys)
    assert operator.session.block.cutter_comp.value == {"l": "LEFT", "o": "ON"}[comp]
    assert "calculating ..." in operator.part("verdict")
    operator.desk = operator.desk.knowing(derive(operator.session.program))
    assert "calculating" not in operator.part("verdict")


def test_how_near_the_path_comes_stands_beside_the_radius() -> None:
    operator = derived("notch")
    assert " UNCUT   0.0000 of 5.6000  NEAREST 0.0000" in verdict(operator)
    told = "\n".join(operator.press("ctrl+f").screen())
    assert "NEAREST 0.0000 at X 2.3000 Y -0.0500 on segment 4; the" in told
    assert "tool's radius is 0.2500." in told
    assert " UNCUT   0.0000 of 13.1416  GOUGE none  NEAREST 0.2500" in verdict(derived("flange"))


def test_a_value_that_does_not_fit_goes_with_its_label() -> None:
    row = (
        Span(" UNCUT   "),
        Span("1.0000 of 9.0000"),
        Span("  GOUGE "),
        Span("none"),
        Span("  NEAREST "),
        Span("0.2500"),
    )
    shown = fitted([row, plain(" more"), plain(" still more")], 1, 59)
    assert text_of(shown[0]).split() == ["UNCUT", "1.0000", "of", "9.0000", "GOUGE", "none", "+2", "more:", "Ctrl+F"]


LONG = " ".join(["word"] * 20)


def test_a_long_finding_takes_the_lines_that_are_free() -> None:
    rows = [plain(" strip"), plain(f" {LONG}"), plain(" UNCUT")]
    told = [text_of(row) for row in fitted(rows, 4, 59)]
    assert [line.strip() for line in told] == ["strip", "word " * 10 + "word", "word " * 8 + "word", "UNCUT"]
    cut = [text_of(row) for row in fitted(rows, 3, 59)]
    assert cut[1] == told[1]
    assert cut[2].startswith("     word")
    assert cut[2].endswith(" +1 more: Ctrl+F")


def test_a_row_that_is_cut_short_says_so() -> None:
    rows = [plain(" strip"), plain(f" {LONG}")]
    assert text_of(fitted(rows, 2, 59)[1]).rstrip().endswith("…  Ctrl+F")
    assert "…" in text_of(fitted([*rows, plain(" more")], 2, 59)[1])
    assert fitted(rows, 0, 59) == ()
    assert fitted([], 3, 59) == ()


def test_what_is_missing_is_told_in_full_on_the_form() -> None:
    operator = Operator.at().press("enter").type("1").press("l").type("", "0", "0", "0", "0", "-1")
    told = " ".join(operator.press("pagedown", "a").part("verdict").split())
    assert "type the end and the center, the end and RADIUS, or the center and SWEEP ANGLE." in told


@pytest.mark.parametrize("name", ["notch", "overrun-square", "pocket"])
@pytest.mark.parametrize("width", [20, 59])
def test_lines_that_have_no_room_are_counted_without_being_put_into_words(name: str, width: int) -> None:
    session = derived(name).session
    about = session.found, look_ahead_table(session.found, session.program), session.program.unit
    rows = verdict_rows(*about, None)
    assert len(rows) > 3
    for height in range(len(rows) + 2):
        few = verdict_rows(*about, None, height)
        assert few == [*rows[:height], *[()] * (len(rows) - height)]
        assert fitted(few, height, width) == fitted(rows, height, width)


def test_the_dialog_tells_the_warnings_with_which_it_posts() -> None:
    operator = derived("pocket")
    first = replace(operator.segments[0], feed=None)
    program = operator.session.program
    block = replace(program.blocks[0], segments=(first, *program.blocks[0].segments[1:]))
    blank = replace(program, blocks=(block,))
    operator.desk = Desk(Session.of(blank)).knowing(derive(blank))
    told = " ".join(operator.press("f8", "f6").part("body").split())
    assert "Nothing stands against posting. ! block 1, segment 1: FEED is blank:" in told


def on_table(program: Program, *keys: str) -> Operator:
    """FINDINGS asked for on the look-ahead table, and what it asks for answered."""
    operator = Operator(Desk(Session.of(program).knowing(derive(program))))
    operator.press(*["tab"] * 11, "f4", *keys, "ctrl+f")
    question = operator.desk.page.question
    if question is not None:
        operator.desk = operator.desk.told(question.answer())
    return operator


def told_of(operator: Operator) -> str:
    """All lines of FINDINGS, whatever the screen has room for."""
    page, session = operator.desk.page, operator.session
    assert isinstance(page, FindingsPage)
    surface = Surface(table=look_ahead_table(session.found, session.program))
    return "\n".join(text_of(row) for row in page.lines(session, surface))


def test_the_findings_of_a_value_of_the_table_are_those_of_its_path() -> None:
    operator = on_table(load(example("pocket")), "home")
    assert "FINDINGS AT LOOK-AHEAD 1" in operator.part("header")
    told = told_of(operator)
    assert told.startswith(" look-ahead [1!] 2-20*   best 2 (deletes 9)")
    assert "deep in segment 10" in told
    assert "DELETED 9" not in told
    assert "was typed" not in told
    assert "AT LOOK-AHEAD" not in operator.press("escape", "escape", "ctrl+f").part("header")


def test_roughing_and_blends_of_a_value_are_told_as_they_are_of_the_one_in_force() -> None:
    pocket = load(example("pocket"))
    rough = replace(pocket, parameters=replace(pocket.parameters, finish_xy=Number(0.05)))
    (block,) = rough.blocks
    rough = replace(rough, blocks=(replace(block, finish_tool=Number(1.0)),))
    assert "Roughing that leaves 0.0500 gouges" in told_of(on_table(rough, "home"))
    blend = replace(pocket, parameters=replace(pocket.parameters, blend_offset=Number(1.6)))
    assert "The blend-in arc gouges" in told_of(on_table(blend, "home"))


def test_the_value_in_force_has_the_findings_of_the_block() -> None:
    operator = on_table(load(example("pocket")))
    assert "AT LOOK-AHEAD" not in operator.part("header")
    assert told_of(operator) == told_of(derived("pocket").press("ctrl+f"))


def test_findings_of_a_value_go_with_the_program_they_were_asked_of() -> None:
    operator = on_table(load(example("pocket")), "home")
    program = operator.session.program
    operator.desk = replace(operator.desk, session=operator.session.apply(replace(program, tools=()), "a change"))
    assert "AT LOOK-AHEAD" not in operator.part("header")
    assert "[1!]" not in told_of(operator)


def test_findings_for_which_the_dialog_has_no_room_are_said_to_be_more() -> None:
    program = load(example("notch"))
    (block,) = program.blocks
    crowded = replace(program, blocks=(replace(block, segments=(*block.segments, *block.segments[-1:] * 8)),))
    operator = Operator(Desk(Session.of(crowded))).press("f8", "f6")
    operator.desk = operator.desk.knowing(derive(crowded))
    told = operator.part("body").rstrip().splitlines()
    assert told[-1] == " And more: Ctrl+F on a block's form tells all."
    assert "!! block 1, segment" in "\n".join(told)
