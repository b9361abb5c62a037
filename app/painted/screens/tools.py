"""TOOL SETUP: the tool table, a row a tool."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

from app.painted.messages import Close, Edit, Message, Open, Say
from app.painted.screens.forms import FormPage, shown_text, unusable
from app.painted.screens.import_tools import ImportPage
from app.painted.screens.page import Answer, Softkey, Softkeys, Surface, View
from app.painted.session import Said, Session
from app.painted.widgets.field import Editing
from app.painted.widgets.form import typed_spans
from app.painted.widgets.header import header
from app.painted.widgets.rows import Look, Row, Span, padded, plain
from core.program.edit import Edited, Refused, delete_tool, set_tool
from core.program.fields import TOOL as EVERY
from core.program.fields import Field, read_typed
from core.program.model import Number, Program, Tool, Typed, Unread
from core.program.solve.solved import Value
from core.units import Unit

TOOL: Final = EVERY[:3]
COLUMNS: Final = {"number": (3, 6), "type": (14, 23), "diameter": (38, 12)}
"""First cell and width of each column of the table."""


@dataclass(frozen=True, eq=False, slots=True)
class ToolsPage(FormPage):
    """The table; the cursor stands in row `row` and column `name`.

    `refused`: the half-typed number was not taken.  It stands there as a value in error does on START: the first
    character replaces it, and DELETE TOOL does not wait for a better one.
    """

    row: int = 0
    name: str = "number"
    refused: bool = False

    def tool(self, session: Session) -> Tool | None:
        """The tool in the cursor's row."""
        tools = session.program.tools
        return tools[min(self.row, len(tools) - 1)] if tools else None

    def fields(self, session: Session) -> tuple[Field, ...]:
        """The three columns; none while the table is empty."""
        return TOOL if session.program.tools else ()

    def cursor(self, session: Session) -> str:
        """The column."""
        return self.name

    def moved(self, session: Session, name: str) -> Answer:
        """Another column."""
        return Answer(replace(self, name=name))

    def value(self, session: Session, name: str) -> Value | str:
        """What stands in the cursor's row."""
        tool = self.tool(session)
        return None if tool is None else _value(tool, name)

    def edit(self, session: Session, one: Field, text: str) -> Edit:
        """The text put into the table."""
        tool = self.tool(session)
        assert tool is not None
        return Edit(_typed(session.program, tool, one, text), f"{one.label} of tool {tool.number}")

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """A key on the table."""
        return FormPage.press(self._ready_for(key, character) if self.refused else self, key, character, session)

    def _ready_for(self, key: str, character: str | None) -> ToolsPage:
        """The page with a refused number, as a key finds it: only the arrows, Home and End change that number."""
        anew = (character is not None and character.isprintable()) or key in ("backspace", "delete")
        return self._without_text() if anew else replace(self, refused=False)

    def before(self, number: int) -> ToolsPage:
        """A refused number goes with the tool it was typed for."""
        return self._without_text() if self.refused and number == 1 else self

    def _without_text(self) -> ToolsPage:
        return replace(self, editing=None, spelled="", refused=False)

    def _beyond(self, session: Session, key: str) -> Answer:
        """Up and down go over the rows, Tab and Enter over the fields."""
        rows, names = max(len(session.program.tools), 1), [one.name for one in TOOL]
        place = min(self.row, rows - 1) * len(names) + names.index(self.name)
        step = {"down": len(names), "up": -len(names), "shift+tab": -1}.get(key, 1)
        row, column = divmod((place + step) % (rows * len(names)), len(names))
        return Answer(replace(self._without_text(), row=row, name=names[column]))

    def settle(self, session: Session) -> Answer:
        """The text taken; the row follows a tool whose new number moves it in the table."""
        settled = FormPage.settle(self, session)
        if self.name != "number":
            return settled
        for message in settled.messages:
            if isinstance(message, Say):
                return Answer(replace(self, refused=True), settled.messages)
            if isinstance(message, Edit) and isinstance(message.outcome, Program):
                row = _changed_row(session.program, message.outcome)
                return Answer(replace(self._without_text(), row=row), settled.messages)
        return settled

    def preview(self, session: Session) -> Program | None:
        """A diameter is tried out; another number would move the row that is being typed in."""
        return FormPage.preview(self, session) if self.name == "diameter" else None

    def escape(self, session: Session) -> Answer | None:
        """The half-typed text forgotten, else back."""
        return FormPage.escape(self, session) or Answer(self, (Close(),))

    def softkeys(self, session: Session) -> Softkeys:
        """Rows out and in."""
        tool = self.tool(session)
        keys = {2: Softkey("ADD TOOL", (Edit(set_tool(session.program, _next(session.program)), "ADD TOOL"),))}
        if tool is not None:
            gone = Edit(delete_tool(session.program, tool.number), f"DELETE TOOL {tool.number}")
            keys[1] = Softkey("DELETE TOOL", (gone, Say(f"Deleted tool {tool.number}. Ctrl+Z brings it back.")))
        return {**keys, 3: Softkey("IMPORT TABLE", (Open(ImportPage.of(session)),)), 8: Softkey("EXIT", (Close(),))}

    def softkeyed(self, session: Session, number: int, messages: tuple[Message, ...]) -> Answer:
        """F2 puts the cursor into the new row."""
        if number != 2:
            return Answer(self, messages)
        row = [tool.number for tool in session.program.tools if tool.number < _next(session.program).number]
        return Answer(replace(self, row=len(row), name="diameter"), messages)

    def view(self, session: Session, surface: Surface) -> View:
        """The table as it stands."""
        one, tools = self.field(session), session.program.tools
        row = min(self.row, len(tools) - 1)
        shown = tuple(
            self._table_row(tool, session.program.unit, on_it=index == row) for index, tool in enumerate(tools)
        )
        room = max(surface.body - 2, 1)
        top = max(0, min(row - room // 2, len(shown) - room))
        empty = (plain("    The tool table is empty. F2 adds a tool.", Look.LABEL),)
        return View(
            header("TOOL SETUP", plain(""), session, surface.width),
            ((), _headings(), *(shown[top : top + room] or empty)),
            self.reason(session) or Said(one.prompt if one else "F2 ADD TOOL puts the first tool into the table."),
            2 + row - top,
        )

    def _table_row(self, tool: Tool, unit: Unit, *, on_it: bool) -> Row:
        row: list[Span] = []
        for one in TOOL:
            first, width = COLUMNS[one.name]
            row.append(Span(" " * (first - sum(len(span.text) for span in row))))
            here = on_it and one.name == self.name
            held, editing = _value(tool, one.name), self.editing if here else None
            if editing is not None and self.refused:
                held, editing = Unread(editing.text, ""), None
            row.extend(_table_cell(held, one, unit, width, editing, here=here))
        return tuple(row)


def _table_cell(
    held: Value | str, one: Field, unit: Unit, width: int, editing: Editing | None, *, here: bool
) -> tuple[Span, ...]:
    if editing is not None:
        return typed_spans(editing, width, right=one.name != "type")
    shown = shown_text(held, one, unit)
    text = f"{shown:<{width}}" if one.name == "type" else f"{shown:>{width}}"
    if len(text) > width:
        text = f"{text[: width - 1]}…"
    bad = unusable(held, one, unit) is not None
    look = Look.CURSOR if here else Look.ERROR if bad else Look.TYPED
    spans = padded((Span(text, look),), width)
    return (*spans, Span(" ERR", Look.ERROR)) if bad else spans


def _headings() -> Row:
    return plain(f"{'TOOL':>9}     {'TYPE':<23}{'DIAMETER':>13}", Look.LABEL)


def _value(tool: Tool, name: str) -> Value | str:
    match name:
        case "number":
            return Number(float(tool.number))
        case "type":
            return tool.type
        case _:
            return tool.diameter


def _typed(program: Program, tool: Tool, one: Field, text: str) -> Edited:
    match one.name:
        case "type":
            return set_tool(program, replace(tool, type=text.strip()))
        case "diameter":
            return set_tool(program, replace(tool, diameter=read_typed(text, one, program.unit)))
        case _:
            return _renumbered(program, tool, read_typed(text, one, program.unit))


def _renumbered(program: Program, tool: Tool, typed: Typed) -> Edited:
    ways = f"Type another one. Esc brings {tool.number} back, F1 deletes tool {tool.number}."
    if not isinstance(typed, Number) or typed.value != int(typed.value):
        return Refused(f"A tool needs a whole number from 1 to 9999. {ways}")
    if any(other.number == typed.value for other in program.tools if other is not tool):
        return Refused(f"There is a tool {typed.value:g} already. {ways}")
    outcome = set_tool(program, replace(tool, number=int(typed.value)))
    return outcome if isinstance(outcome, Refused) else delete_tool(outcome, tool.number)


def _next(program: Program) -> Tool:
    taken = {tool.number for tool in program.tools}
    return Tool(next(number for number in range(1, len(taken) + 2) if number not in taken))


def _changed_row(before: Program, after: Program) -> int:
    """The row whose number is not among those before."""
    numbers = {tool.number for tool in before.tools}
    return next((row for row, tool in enumerate(after.tools) if tool.number not in numbers), 0)
