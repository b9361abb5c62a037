"""What an operator takes in at a glance: words that cannot be taken for others, titles, where the cursor is."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from app.cli.screens import begin
from app.documents.files import load
from app.documents.programs import example
from app.painted.desk import Desk
from app.painted.messages import Load
from app.painted.screens.program import verdict_word
from app.painted.session import Session
from app.painted.survey import worst
from app.painted.widgets.rows import text_of
from app.painted.widgets.strip import strip
from core.pipeline.derive import derive, look_ahead_table
from core.program.model import Number
from tests.app.operator import Operator


def on(name: str = "pocket") -> Operator:
    return Operator(Desk(begin(None, name)))


@pytest.mark.parametrize("text", ["2..0", ""])
def test_a_block_that_cannot_be_read_or_is_incomplete_is_not_called_open(text: str) -> None:
    """An open contour is something else."""
    operator = on().press("tab", "tab", "tab", "tab", "backspace", *text, "enter")
    found = derive(operator.session.program)
    assert verdict_word(found.blocks[0])[0] == "not ready"
    assert worst(found)[0] == "not ready"
    assert "not ready" in " ".join(operator.press("f8", "?").screen())


def test_the_recommended_value_is_told_the_same_way_whatever_is_in_force() -> None:
    program = load(example("notch"))
    told = set()
    for value in (None, *range(1, 21)):
        block = replace(program.blocks[0], lookahead=None if value is None else Number(float(value)))
        one = replace(program, blocks=(block,))
        (found,) = derive(one).blocks
        told.add(text_of(strip(found, look_ahead_table(found, one), one.unit)).rpartition("best")[2])
    assert told == {" 3 (deletes 2-4)", ""}


@pytest.mark.parametrize("name", ["peck_depth", "finish_tool"])
def test_a_default_has_the_same_tag_on_start_as_elsewhere(name: str) -> None:
    operator = on()
    while operator.session.field != name:
        operator.press("tab")
    operator.press("backspace", "enter")
    label = {"peck_depth": "PECK DEPTH", "finish_tool": "FINISH TOOL"}[name]
    (line,) = [row for row in operator.part("body").splitlines() if label in row]
    assert "DEF" in line.partition(label)[2][:18]
    assert "CUTCOMP LOOKAHEAD CAL" in operator.part("body")


def test_an_example_is_titled_by_its_name() -> None:
    assert on().screen()[1].split("│")[0].rstrip().endswith("example pocket")
    operator = Operator.at().press("5", "escape")
    operator.desk = operator.desk.take(Load(example("notch"), unsaved=True))
    assert operator.screen()[1].split("│")[0].rstrip().endswith("example notch")
    operator.desk = operator.desk.take(Load(None, unsaved=True))
    assert operator.screen()[1].split("│")[0].rstrip().endswith("new program")


def test_an_example_that_is_saved_has_the_name_of_its_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    operator = on().press("ctrl+s", *"mine.toml", "enter")
    assert operator.screen()[1].split("│")[0].rstrip().endswith(" mine")


@pytest.mark.parametrize("size", [(20, 5), (20, 6), (24, 8), (30, 8), (40, 10)])
def test_the_segment_number_stands_on_the_smallest_terminals(size: tuple[int, int]) -> None:
    operator = on().press("pagedown", "pagedown")
    assert any(row.split() == ["SEGMENT", ">", "2", "ARC"] for row in _starts(operator.screen(*size)))


def _starts(rows: list[str]) -> list[str]:
    """The rows without a name at their right."""
    return [row[:20] for row in rows]


def test_the_first_character_behind_a_path_that_was_refused_replaces_it(tmp_path: Path) -> None:
    operator = on().press("ctrl+o", *str(tmp_path / "none.toml"), "enter")
    assert "none.toml" in operator.said
    assert "none.toml" in operator.part("body")
    operator.press("x")
    assert "none.toml" not in operator.part("body")
    assert "x" in operator.part("body")


def test_a_path_that_was_refused_can_be_changed_in_the_middle(tmp_path: Path) -> None:
    operator = on().press("ctrl+o", *str(tmp_path / "none.toml"), "enter", "left", "backspace", "X")
    assert "none.toXl" in operator.part("body")


def test_undoing_units_leaves_the_cursor_where_it_is() -> None:
    operator = on().press("f4", "right", "c", "escape", "tab")
    where, field = operator.session.where, operator.session.field
    assert str(operator.session.program.unit) == "MM"
    operator.press("ctrl+z")
    assert str(operator.session.program.unit) == "IN"
    assert (operator.session.where, operator.session.field) == (where, field)
    operator.press("ctrl+y")
    assert (operator.session.where, operator.session.field) == (where, field)


def test_a_session_without_an_example_has_no_title() -> None:
    assert Session.of(load(example("pocket"))).title == ""
