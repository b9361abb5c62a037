"""A number that a field does not take stays there as it was typed, marked, and nothing is posted: on every form."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.documents.files import load
from app.documents.programs import example
from app.painted.journal import block_of, packed_block
from app.painted.screens.contour_cells import PLACES
from app.painted.screens.forms import FormPage
from app.painted.screens.tools import ToolsPage
from core.pipeline.outline import outline
from core.program.fields import TABLES, Form, value_refusal
from core.program.file.read import loads
from core.program.file.write import dumps
from core.program.model import ArcSegment, BlendSegment, Block, LineSegment, Number, Program, Unread, unread_texts
from core.units import Kind, Unit
from tests.app.operator import Operator

FORMS = {
    Form.START: (),
    Form.LINE: ("right",),
    Form.ARC: ("right", "right"),
    Form.BLEND: ("right", "right", "right"),
    Form.TOOL: ("f6",),
    Form.PARAMETERS: ("f4",),
    Form.SETUP: ("f5",),
}
HELD = frozenset({"lookahead", "number"})
"""CUTCOMP LOOKAHEAD keeps its old value, and a tool without a number is none."""
NOT_ON_THIS_FORM = {Form.TOOL: {"speed", "feed", "plunge_feed"}}
"""What only the other TOOL SETUP has a place for."""
FIELDS = [
    (form, one.name)
    for form in FORMS
    for one in TABLES[form]
    if one.kind not in (Kind.CHOICE, Kind.TEXT)
    and one.name not in HELD | NOT_ON_THIS_FORM.get(form, set())
    and one.name in PLACES.get(form, {one.name})
]


def program() -> Program:
    """One segment of every kind."""
    start = load(example("pocket"))
    line = LineSegment(Number(9.0), Number(9.0))
    block = Block(
        tool=Number(1.0),
        z_start=Number(0.0),
        cutter_comp=start.blocks[0].cutter_comp,
        segments=(line, ArcSegment(x_end=Number(1.0)), BlendSegment(Number(0.1)), line),
    )
    return Program(Unit.IN, tools=start.tools, blocks=(block,))


def on(form: Form, name: str) -> Operator:
    """The cursor on a field of a form."""
    operator = Operator.at(program()).press(*FORMS[form])
    for _ in range(20):
        page = operator.desk.page
        assert isinstance(page, FormPage)
        field = page.field(operator.session)
        if field is not None and field.name == name:
            return operator
        operator.press("tab")
    raise AssertionError(name)


def wild(form: Form, name: str) -> str:
    """A number that can be read and is none the field takes."""
    one = next(one for one in TABLES[form] if one.name == name)
    return next(text for text in ("0", "-1", "99999", "-999") if value_refusal(one, float(text), Unit.IN) is not None)


def held(operator: Operator, form: Form, name: str) -> object:
    """What the program holds there."""
    one = operator.session.program
    parts = {
        Form.START: one.blocks[0],
        Form.LINE: one.blocks[0].segments[0],
        Form.ARC: one.blocks[0].segments[1],
        Form.BLEND: one.blocks[0].segments[2],
        Form.TOOL: one.tools[0],
        Form.PARAMETERS: one.parameters,
        Form.SETUP: one.setup,
    }
    return getattr(parts[form], name)


@pytest.mark.parametrize(("form", "name"), FIELDS)
@pytest.mark.parametrize("key", ["enter", "down", "tab", "f8", "ctrl+end", "pagedown"])
def test_it_stays_marked_in_its_field_however_the_cursor_leaves(form: Form, name: str, key: str) -> None:
    if form not in (Form.START, Form.LINE, Form.ARC, Form.BLEND) and key in ("ctrl+end", "pagedown"):
        key = "enter"
    text = wild(form, name)
    operator = on(form, name)
    before = held(operator, form, name)
    operator.press(*text, key)
    typed = held(operator, form, name)
    assert isinstance(typed, Unread)
    assert typed.text == text
    assert "must be" in operator.said
    assert "ERR" in operator.part("body")
    operator.press("down", "up")
    assert "ERR" in operator.part("body")
    operator.press("escape")
    assert held(operator, form, name) == before


@pytest.mark.parametrize(("form", "name"), FIELDS)
def test_it_blocks_posting_and_is_saved_and_journaled(form: Form, name: str) -> None:
    text = wild(form, name)
    operator = on(form, name).press(*text, "enter")
    now = operator.session.program
    assert [one.text for one in unread_texts(now)] == [text]
    found = [
        one for block in outline(now).blocks for one in block.errors if one.field == (name, "tool")[name == "diameter"]
    ]
    assert found
    label = next(one.label for one in TABLES[form] if one.name == name)
    assert any(label in one.text and "must be" in one.text and text in one.text for one in found)
    assert "cannot be read" not in " ".join(one.text for one in found)
    assert loads(dumps(now), "part.toml") == now
    assert block_of(packed_block(now.blocks[0])) == now.blocks[0]


def test_a_number_out_of_range_in_a_file_is_marked_too(tmp_path: Path) -> None:
    file = tmp_path / "part.toml"
    file.write_text(dumps(load(example("pocket"))).replace("x_start = 2.0", "x_start = 99999.0"))
    operator = Operator.at(load(file))
    assert "ERR" in operator.part("body")
    assert "X START must be from -10000 to 10000" in operator.press("tab", "tab", "tab", "tab").said


def test_a_refused_tool_number_stays_until_it_is_mended() -> None:
    operator = Operator.at(program()).press("f6", "1", "0", "0", "0", "0")
    for key in ("enter", "down", "tab", "f8", "ctrl+s"):
        operator.press(key)
        assert isinstance(operator.desk.page, ToolsPage)
        assert "10000" in operator.part("body")
        assert "from 1 to 9999" in operator.said
    operator.press("escape", "enter")
    assert [tool.number for tool in operator.session.program.tools] == [1]


def test_a_refused_look_ahead_holds_the_cursor_once_whatever_the_key() -> None:
    for key in ("enter", "down", "pagedown", "ctrl+end", "ctrl+home"):
        operator = on(Form.START, "lookahead").press("2", "1", key)
        assert operator.session.field == "lookahead"
        assert operator.session.where.segment == 0
        assert "from 1 to 20" in operator.said


def test_a_safe_z_that_is_set_aside_is_said_on_its_screen_and_on_the_form() -> None:
    operator = on(Form.SETUP, "safe_z")
    operator.type("-1").press("up")
    assert "SAFE Z -1.0000 is below Z 0.1000" in operator.said
    operator.press("f8", "ctrl+f")
    assert "SAFE Z -1.0000 is below Z 0.1000" in " ".join(" ".join(operator.screen()).split())


def test_saving_says_that_what_cannot_be_used_is_in_the_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    operator = Operator.at().press("tab", "x", "enter").press("f8", "f7", "f3", "delete", *"part", "enter")
    assert operator.said == "Saved: part.toml, what is marked ERR as it was typed."
    operator.press("enter", "tab", "1", "enter", "ctrl+s")
    assert operator.said == "Saved: part.toml"
