"""The guided first part: an operator who does what the prompt lines say, and one who does not."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from app.documents.files import load, save
from app.documents.programs import empty_program
from app.painted.desk import Desk
from app.painted.guide import STEPS, hint, next_step
from app.painted.messages import Edit, Move
from app.painted.screens.post import PostPage
from app.painted.session import Session
from core.pipeline.derive import derive
from core.program.edit import FormPlace, type_field
from core.program.fields import Form, field_of, read_typed
from core.program.model import CutterComp, Number
from tests.app.operator import Operator

NAMED = {"Enter": "enter", "Down": "down", "Up": "up", "Page Down": "pagedown", "Page Up": "pageup", "L": "l"}


def begun() -> Operator:
    """An operator who chose the guide on the start screen."""
    from app.painted.guide import begin

    operator = Operator.at()
    operator.desk = begin(operator.desk)
    return operator


def known(operator: Operator) -> Operator:
    """What the numeric library finds is on the desk."""
    session = operator.session
    operator.desk = operator.desk.knowing(derive(session.program))
    return operator


def obey(operator: Operator) -> None:
    """Press what the guide says, and nothing else."""
    operator.press("ctrl+t")
    text = operator.said.removeprefix("GUIDE ").strip()
    if typed := re.search(r": type (\S+), then Enter", text):
        operator.press(*typed[1], "enter")
    elif ": press Del, then Enter" in text:
        operator.press("delete", "enter")
    elif "press L until LEFT" in text or text.startswith("Press L"):
        operator.press("l")
    elif text.startswith("Type a name"):
        operator.press("delete", *"plate", "enter")
    elif found := re.match(
        r"(?:.*: |.*\. )?(Ctrl\+S|Ctrl\+Home|Ctrl\+End|F8|F6|F1|Page Down|Page Up|Enter|Up|Down)\b", text
    ):
        key = found[1]
        operator.press(NAMED.get(key, key.lower()))
    else:
        raise AssertionError(text)


def finished(operator: Operator, most: int = 120) -> int:
    """Obey until the guide is gone; how many times that took."""
    for count in range(most):
        if not operator.desk.guided:
            return count
        obey(known(operator))
    raise AssertionError(operator.screen())


def test_by_its_own_words_from_the_start_to_a_posted_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    operator = begun()
    finished(operator)
    assert "that is the whole way" in operator.said
    program = load("plate.toml")
    assert program.blocks[0].cutter_comp is CutterComp.LEFT
    (found,) = derive(program).blocks
    assert found.solved.closed
    assert found.errors == ()
    assert found.findings == ()
    assert Path("plate.nc").read_text().startswith("(PROGRAM plate)")


@pytest.mark.parametrize(
    "astray",
    [
        ("tab", "7", "enter"),
        ("pagedown", "a", "escape", "escape"),
        ("pagedown",),
        ("pagedown", "b"),
        ("f6",),
        ("f8",),
        ("f7",),
        ("tab", "x", "enter"),
        ("f8", "f2"),
        ("?",),
        ("ctrl+s",),
    ],
)
def test_no_wrong_key_loses_the_guide(astray: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    operator = begun().press(*astray)
    finished(operator)
    assert Path("plate.nc").exists()


@pytest.mark.parametrize(
    ("form", "name", "typed"),
    [
        (Form.LINE, "z_end", "1"),
        (Form.LINE, "angle", "5"),
        (Form.LINE, "feed", "0"),
        (Form.START, "finish_tool", "3"),
        (Form.START, "speed", "x"),
        (Form.START, "peck_depth", "-1"),
    ],
)
def test_a_value_in_a_field_that_the_plate_does_not_need_is_named(
    form: Form, name: str, typed: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    operator = begun()
    while len(operator.segments) < 3:
        obey(known(operator))
    where = FormPlace(1, 2 if form is Form.LINE else 0)
    value = read_typed(typed, field_of(form, name), operator.session.program.unit)
    operator.desk = operator.desk.take(Edit(type_field(operator.session.program, where, name, value), name))
    finished(operator)
    assert Path("plate.nc").exists()


def test_a_save_leaves_no_one_without_the_next_step(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    operator = begun()
    while operator.session.file is None:
        obey(known(operator))
    assert operator.said == "GUIDE Saved. F8 goes to the list of blocks (or Esc, then 8)."


def test_the_guide_asks_before_unsaved_work_is_given_up() -> None:
    from app.painted.guide import begin

    operator = Operator.at().press("tab", "9", "enter")
    operator.desk = begin(operator.desk)
    assert not operator.desk.guided
    assert "NOT SAVED" in operator.part("header")


def test_another_program_ends_the_guide(tmp_path: Path) -> None:
    save(empty_program(), tmp_path / "p.toml")
    operator = begun().press("ctrl+o")
    operator.press(*str(tmp_path / "p.toml"), "enter")
    assert operator.session.file == tmp_path / "p.toml"
    assert not operator.desk.guided


def test_every_sentence_fits_the_two_lines_at_80_columns(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    operator = begun()
    while operator.desk.guided:
        assert not operator.said.endswith("\u2026")
        obey(known(operator))


def test_the_next_step_is_the_first_field_that_differs() -> None:
    operator = begun()
    first = next_step(operator.session)
    assert first is not None
    assert (first.segment, first.name) == (0, "cutter_comp")
    assert [step.name for step in STEPS[:6]] == ["tool", "cutter_comp", "x_start", "y_start", "z_start", "z_bottom"]
    assert operator.block.tool == Number(1.0)


def test_posting_with_findings_leaves_the_words_to_the_screen() -> None:
    desk = Desk(Session.of(Operator.at().session.program), (PostPage(path=Path("x.nc")),), guided=True)
    assert hint(desk) is None


@pytest.mark.parametrize(("typed", "why"), [("20", "is 20 instead of 10"), ("2o", "cannot be read"), ("", "is blank")])
def test_what_is_to_be_changed_on_another_segment_is_named(typed: str, why: str) -> None:
    operator = begun()
    while len(operator.segments) < 2:
        obey(known(operator))
    feed = read_typed(typed, field_of(Form.LINE, "feed"), operator.session.program.unit)
    edit = Edit(type_field(operator.session.program, FormPlace(1, 1), "feed", feed), "FEED")
    operator.desk = operator.desk.take(edit).take(Move(FormPlace(1, 2), "x_end"))
    assert operator.said == f"GUIDE Segment 1 is next, its FEED {why}: Page Up goes there."


def test_what_is_to_be_changed_on_start_is_named() -> None:
    operator = begun()
    while len(operator.segments) < 1:
        obey(known(operator))
    operator.press("ctrl+home", "tab", "tab", "r", "pagedown")
    assert operator.said.startswith("GUIDE START is next, its CUTTER COMP is RIGHT instead of LEFT: Ctrl+Home goes")


def test_a_new_segment_is_offered_only_where_one_comes_next() -> None:
    operator = begun().press("pagedown")
    assert operator.said == "GUIDE A new segment is not what comes next: Page Up goes back."
    operator = begun()
    while len(operator.segments) < 2 or not operator.said.endswith("adds a LINE."):
        obey(known(operator))
    operator.press("pagedown")
    assert operator.said == "GUIDE Press L for LINE, or F1: a straight segment."
    operator.press("pageup", "pageup", "ctrl+t", "f2")
    assert operator.said == "GUIDE The next line belongs behind the last one of block 1: Page Up goes back."
