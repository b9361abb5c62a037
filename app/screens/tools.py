"""TOOL SETUP shows the tool table, one row per tool, and the blocks that use the tool with the cursor."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, ClassVar, Final

from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, Vertical, VerticalScroll
from textual.widgets import Static

from app.screens.field_texts import cell_of, unusable
from app.screens.form_screen import FormScreen
from app.session.messages import Sentence, Tone
from app.session.session import Session
from app.widgets.drawing import Drawing
from app.widgets.field import Cell, ChoiceField, NumberField, State
from app.widgets.plain import PlainLabel, PlainText, show_text
from app.widgets.softkeys import Softkey
from core.pipeline.derived import DerivedBlock
from core.program.edit import Edited, Refused, delete_tool, set_tool
from core.program.fields import TOOL, Field, Form, field_of, read_typed
from core.program.model import Coolant, Number, Program, Tool, Typed
from core.program.solve.solved import Value
from core.program.tools import unusual_size
from core.units import Kind, Unit, sentence, to_mm

NAME_SEPARATOR: Final = "@"
"""Separates the field's name from the tool's row in the name of a widget."""
HEADINGS: Final = {"diameter": "DIAMETER", "speed": "SPEED", "plunge_feed": "PLUNGE"}
"""Column headings for fields whose label is too wide."""
EMPTY_PROMPT: Final = "The tool table is empty. F2 adds a tool."


class ToolRow(Horizontal):
    """The fields of one tool."""

    def __init__(self, cells: Sequence[Cell]) -> None:
        super().__init__(classes="tool field")
        self.cells = tuple(cells)

    def compose(self) -> ComposeResult:
        """Lay out one widget per field."""
        for cell in self.cells:
            widget = (
                ChoiceField(cell.name, cell.choices, cell.text, prompt=" ", blank=True)
                if cell.choices
                else NumberField(cell.name, cell.text, cell.full)
            )
            widget.add_class(f"tool-{cell.name.partition(NAME_SEPARATOR)[0]}", cell.state)
            yield widget

    def field(self, name: str) -> NumberField | ChoiceField | None:
        """Return the widget with this name."""
        named = (each for each in self.children if isinstance(each, NumberField | ChoiceField) and each.name == name)
        return next(named, None)

    def show(self, cells: Sequence[Cell]) -> None:
        """Show these values."""
        for before, cell in zip(self.cells, cells, strict=True):
            widget = self.field(cell.name)
            if widget is None or cell == before:
                continue
            if cell.state is not before.state:
                widget.remove_class(before.state)
                widget.add_class(cell.state)
            if isinstance(widget, NumberField):
                widget.show(cell.text, cell.full)
            else:
                widget.show(cell.text)
        self.cells = tuple(cells)


class ToolsScreen(FormScreen):
    """The tool table; up and down go from tool to tool, Tab and Enter from field to field."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("up", "row(-1)", "Tool before", show=False),
        Binding("down", "row(1)", "Next tool", show=False),
        Binding("escape", "leave", "Back", show=False),
    ]
    SOFTKEYS: ClassVar[tuple[Softkey | None, ...]] = (
        Softkey("DELETE TOOL", "delete_tool", "DELETE", lambda screen: screen.tool is not None, EMPTY_PROMPT),
        Softkey("ADD TOOL", "add_tool", "ADD"),
        Softkey("IMPORT TABLE", "app.import_tools", "IMPORT"),
        *(None,) * 3,
        Softkey("DRAW", "app.draw", "DRAW"),
        Softkey("BACK", "app.back", "BACK"),
    )

    def __init__(self) -> None:
        super().__init__()
        self._drawn: tuple[Tool | None, DerivedBlock | None] | None = None
        """The tool and the block that the drawing shows."""

    def compose_body(self) -> ComposeResult:
        """Lay out the title, the headings, the rows, and the use of the tool."""
        with Vertical(id="tools", classes="panel -bare"):
            with Horizontal(classes="head"):
                yield PlainLabel("TOOL SETUP", classes="head-title")
            with Horizontal(id="tool-headings"):
                for field in TOOL:
                    yield PlainLabel(HEADINGS.get(field.name, field.label), classes=f"tool-{field.name}")
            with VerticalScroll(id="tool-rows", can_focus=False):
                yield from self._rows(self.host.session)
                yield PlainText(EMPTY_PROMPT, id="no-tools")
        with Vertical(id="tool-side"):
            yield Drawing(id="tool-drawing")
            yield PlainText(id="tool-use", classes="panel")

    def _rows(self, session: Session) -> list[ToolRow]:
        self._numbers = [tool.number for tool in session.program.tools]
        return [ToolRow(_cells(tool, row, session)) for row, tool in enumerate(session.program.tools)]

    def on_mount(self) -> None:
        """Put the cursor on the first tool."""
        self._focus_row(0)

    # ---- the table as a form

    def fields(self) -> tuple[Field, ...]:
        """Return the fields of every tool, each with its row in its name."""
        rows = range(len(self.current_session.program.tools))
        return tuple(replace(field, name=f"{field.name}{NAME_SEPARATOR}{row}") for row in rows for field in TOOL)

    def widget(self, name: str) -> NumberField | ChoiceField | None:
        """Return the widget with this name."""
        rows = self.query(ToolRow)
        row = _row(name)
        return rows[row].field(name) if row < len(rows) else None

    def value(self, name: str) -> Value | str:
        """Return what a tool has in a field."""
        tools, row = self.current_session.program.tools, _row(name)
        return _value(tools[row], name.partition(NAME_SEPARATOR)[0]) if row < len(tools) else None

    def may_be_blank(self, field: Field, /) -> bool:
        """Return True for TYPE and COOLANT, which a tool may leave blank."""
        return field.kind in (Kind.TEXT, Kind.CHOICE)

    def picked_text(self, field: Field) -> str:
        """Return the choice that the tool has."""
        return str(self.value(field.name) or "")

    def edited(self, field: Field, text: str) -> Edited:
        """Return the program with this text in its tool table."""
        program = self.current_session.program
        return _typed(program, program.tools[_row(field.name)], field, text)

    def take_text(self, widget: NumberField, field: Field) -> bool:
        """Take the text of a field; the cursor stays on a tool that another number has moved to another row."""
        before, has_cursor = {tool.number for tool in self.current_session.program.tools}, widget is self.current
        if not super().take_text(widget, field):
            return False
        numbers = [tool.number for tool in self.current_session.program.tools]
        moved = [row for row, number in enumerate(numbers) if number not in before]
        if has_cursor and moved and moved != [_row(field.name)]:
            self._focus_row(moved[0])
        return True

    def label(self, field: Field) -> str:
        """Return FIELD of a tool."""
        return f"{field.label} of tool {self.current_session.program.tools[_row(field.name)].number}"

    def show_session(self, session: Session) -> None:
        """Show the current rows; rebuild them if the number of tools has changed."""
        rows = list(self.query(ToolRow))
        if len(rows) != len(session.program.tools):
            self.call_next(self._rebuild)
        else:
            for row, (tool_row, tool) in enumerate(zip(rows, session.program.tools, strict=True)):
                tool_row.show(_cells(tool, row, session))
        self.query_one("#no-tools").display = not session.program.tools
        self._show_use()

    async def _rebuild(self) -> None:
        """Rebuild the rows after tools were added or deleted; the cursor keeps its row, or goes to a new tool."""
        if len(self.query(ToolRow)) == len(self.current_session.program.tools):
            self.show_session(self.current_session)
            return
        numbers = [tool.number for tool in self.current_session.program.tools]
        new = [row for row, number in enumerate(numbers) if number not in self._numbers]
        row = new[0] if len(new) == 1 else self.row
        table = self.query_one("#tool-rows")
        await self.query(ToolRow).remove()
        await table.mount_all(self._rows(self.current_session), before=0)
        self._focus_row(min(row, len(numbers) - 1))

    # ---- the cursor

    @property
    def row(self) -> int:
        """The index of the row with the cursor."""
        widget = self.current
        return 0 if widget is None else _row(widget.name or "")

    @property
    def tool(self) -> Tool | None:
        """The tool with the cursor."""
        tools = self.current_session.program.tools
        return tools[min(self.row, len(tools) - 1)] if tools else None

    def _focus_row(self, row: int, name: str = TOOL[0].name) -> None:
        if row >= 0:
            self.focus_field(f"{name}{NAME_SEPARATOR}{row}")
        self._show_use()

    def action_row(self, by: int) -> None:
        """Go to the same field of the previous or next tool, wrapping around."""
        self.clear_notice()
        count = len(self.current_session.program.tools)
        if not count or not self.take():
            return
        name = (self.current.name or "").partition(NAME_SEPARATOR)[0] if self.current is not None else TOOL[0].name
        self._focus_row((self.row + by) % count, name)

    def action_accept(self) -> None:
        """Take the field and go to the next one; on the last one the cursor stays."""
        if self.current is not None and self.current.name == self.names()[-1]:
            self.clear_notice()
            self.take()
        else:
            super().action_accept()

    def refresh_frame(self) -> None:
        """Also update the blocks that use the tool with the cursor."""
        super().refresh_frame()
        self._show_use()

    def _show_use(self) -> None:
        tool, program, lines = self.tool, self.current_session.program, list[str]()
        if tool is not None:
            tools = (tool, *(other for other in program.tools if other is not tool))
            lines = [f"TOOL {tool.number}", *(_uses(program, tool.number) or ["Not used by any block."])]
            lines += [fault for each in tools for fault in _faults(each, program.unit)]
        show_text(self.query_one("#tool-use", Static), "\n".join(lines))
        self._draw_use(tool)

    def _draw_use(self, tool: Tool | None) -> None:
        """Draw the first block that uses the tool, with the cutter on START, where there is room for a drawing."""
        drawing, derived = self.query_one("#tool-drawing", Drawing), self.current_session.derived
        used = [] if tool is None else [at for _, blocks in _calls(derived.program, tool.number) for at in blocks]
        block = derived.block(used[0]) if used else None
        if not drawing.display or self._drawn == (tool, block):
            return
        # imported here: the first paint must not load numpy and shapely
        from core.pipeline.plot import Subject

        self._drawn = tool, block
        drawing.heading = "DRAWING" if block is None else f"BLOCK {block.number}"
        drawing.subject = None if block is None else Subject(block, derived.program.unit, segment=0)

    # ---- softkeys

    def action_add_tool(self) -> None:
        """Add a tool with the lowest free number and put the cursor on its diameter."""
        program = self.current_session.program
        taken = {tool.number for tool in program.tools}
        tool = Tool(next(number for number in range(1, len(taken) + 2) if number not in taken))
        if self.host.apply(set_tool(program, tool), f"ADD TOOL {tool.number}"):
            row = [each.number for each in self.current_session.program.tools].index(tool.number)
            self.call_next(self._focus_row, row, "diameter")
            self.say(f"Tool {tool.number} added. Type its DIAMETER. Shift+Tab goes back to its number.")

    def action_delete_tool(self) -> None:
        """Delete the tool with the cursor."""
        tool, program = self.tool, self.current_session.program
        if tool is None:
            return
        if self.host.apply(delete_tool(program, tool.number), f"DELETE TOOL {tool.number}"):
            uses = ", ".join(_uses(program, tool.number))
            said = f" It was {uses}." if uses else ""
            self.notify(f"Deleted tool {tool.number}.{said} Ctrl+Z brings it back.", timeout=5)

    def prompt_text(self) -> Sentence:
        """Return what the field takes, or for an empty table how to begin."""
        return super().prompt_text() if self.current_session.program.tools else Sentence(EMPTY_PROMPT, Tone.WARNING)


def _row(name: str) -> int:
    return int(name.partition(NAME_SEPARATOR)[2] or 0)


def _cells(tool: Tool, row: int, session: Session) -> tuple[Cell, ...]:
    """Return the cells of a tool; each is unread or typed, as nothing is calculated here."""
    cells = (cell_of(field, _value(tool, field.name), session.program.unit, 0) for field in TOOL)
    return tuple(
        replace(
            cell,
            name=f"{cell.name}{NAME_SEPARATOR}{row}",
            state=State.UNREAD if cell.state is State.UNREAD else State.TYPED,
        )
        for cell in cells
    )


def _value(tool: Tool, name: str) -> Value | str:
    if name == "number":
        return Number(float(tool.number))
    value: Value | str = getattr(tool, name)
    return value


def _typed(program: Program, tool: Tool, field: Field, text: str) -> Edited:
    name = field.name.partition(NAME_SEPARATOR)[0]
    if name == "number":
        return _renumbered(program, tool, read_typed(text, field, program.unit))
    if name == "type" and isinstance(read_typed(text, field_of(Form.TOOL, "diameter"), program.unit), Number):
        kept = f"Esc brings {tool.type} back" if tool.type else "Esc blanks it"
        return Refused(
            f"TYPE takes a name such as END MILL, not a number such as {text.strip()}. {kept}; DIAMETER is next."
        )
    plain = field.kind in (Kind.TEXT, Kind.CHOICE)
    value: Any = text.strip() if plain else read_typed(text, field, program.unit)
    if name == "coolant":
        value = Coolant(value) if value else None
    return set_tool(program, replace(tool, **{name: value}))


def _renumbered(program: Program, tool: Tool, typed: Typed) -> Edited:
    remedy = f"Type another one. Esc brings {tool.number} back, F1 deletes tool {tool.number}."
    if not isinstance(typed, Number) or typed.value != int(typed.value):
        return Refused(f"A tool needs a whole number from 1 to 9999. {remedy}")
    if any(other.number == typed.value for other in program.tools if other is not tool):
        return Refused(f"Tool {typed.value:g} exists already. {remedy}")
    outcome = set_tool(program, replace(tool, number=int(typed.value)))
    return outcome if isinstance(outcome, Refused) else delete_tool(outcome, tool.number)


def _faults(tool: Tool, unit: Unit) -> list[str]:
    """Return an ERR line for each field of a tool that cannot be used, and a doubt about its diameter."""
    reasons = [(field.label, unusable(_value(tool, field.name), field, unit)) for field in TOOL]
    texts = [text if text.startswith(label) else f"{label}: {text}" for label, text in reasons if text]
    typed = tool.diameter
    doubt = unusual_size(f"Tool {tool.number}", to_mm(typed.value, unit), unit) if isinstance(typed, Number) else None
    return [
        *(f"ERR tool {tool.number} {text}" for text in texts),
        *([] if doubt is None else [f"WARNING: {sentence(doubt, unit)}"]),
    ]


def _uses(program: Program, number: int) -> list[str]:
    """Return the calls of a tool as the tool and as the finish tool, each with its blocks, as texts."""
    return [
        f"{role} of block{'s' if blocks[1:] else ''} {', '.join(map(str, blocks))}"
        for role, blocks in _calls(program, number)
        if blocks
    ]


def _calls(program: Program, number: int) -> tuple[tuple[str, list[int]], ...]:
    """Return TOOL and FINISH TOOL, each with the blocks that call this tool there."""

    def called(value: object) -> bool:
        return isinstance(value, Number) and value.value == number

    roughing = [at for at, block in enumerate(program.blocks, 1) if called(block.tool)]
    finishing = [at for at, block in enumerate(program.blocks, 1) if called(block.finish_tool)]
    return ("TOOL", roughing), ("FINISH TOOL", finishing)
