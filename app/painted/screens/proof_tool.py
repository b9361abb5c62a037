"""What NC PROOF asks for on a line: a tool's diameter, and a line's number."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, ClassVar, Final

from app.painted.messages import Close, Do, Message, Say
from app.painted.screens.entry import EntryPage, entry_row
from app.painted.screens.page import Answer, Layout, Softkey, Softkeys, Surface, View
from app.painted.session import Said, Session, Tone
from app.painted.widgets.field import Editing
from app.painted.widgets.rows import Look, Row, plain
from core.controls.control_tools import CutterTool, ToolTable
from core.units import Kind, Unit, Unreadable, parse, show

if TYPE_CHECKING:
    from app.painted.desk import Desk
    from app.painted.screens.proof import ProofPage

STEP: Final = {Unit.IN: 0.001, Unit.MM: 0.01}
"""By how much one key changes a diameter, in program units."""
LARGEST: Final = 1e4
_NUMBERED: Final = re.compile(r"\s*(\d{1,6})\s*=(.*)", re.DOTALL)


def unit_of(page: ProofPage) -> Unit:
    """The program's unit as far as it is known."""
    return page.told.answer.unit if page.told is not None and page.told.answer is not None else Unit.IN


def proof_page(desk: Desk) -> ProofPage:
    """The page under proof that lies on the desk, on top or below."""
    from app.painted.screens.proof import ProofPage

    return next(page for page in reversed(desk.pages) if isinstance(page, ProofPage))


def put(desk: Desk, page: ProofPage) -> Desk:
    """The desk with another state of the page under proof."""
    old = proof_page(desk)
    return replace(desk, pages=tuple(page if one is old else one for one in desk.pages))


@dataclass(frozen=True, eq=False, slots=True)
class ToolSize(EntryPage):
    """The diameter of a tool: `2=.5`, or `.5` for the tool in `number`."""

    layout: ClassVar[Layout] = Layout.TEXT
    number: int = 1
    unit: Unit = Unit.IN
    tools: ToolTable = field(default_factory=ToolTable)

    @classmethod
    def of(cls, page: ProofPage) -> ToolSize:
        """The page with what the table says of the tool."""
        unit, tool = unit_of(page), page.asked.tools.get(page.tool)
        size = "" if tool is None else show(tool.diameter, Kind.LENGTH, unit)
        return cls(Editing.of(f"{page.tool}={size}"), fresh=True, number=page.tool, unit=unit,
                   tools=page.asked.tools)  # fmt: skip

    def softkeys(self, session: Session) -> Softkeys:
        """Take it or not."""
        return {1: Softkey("TAKE DIAMETER", self._taken()), 8: Softkey("CANCEL", (Close(),))}

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """Enter takes it."""
        return Answer(self, self._taken()) if key == "enter" else self.typed(key, character)

    def _taken(self) -> tuple[Message, ...]:
        found = read_tool(self.entry.text, self.number, self.unit)
        if isinstance(found, str):
            return (Say(found, Tone.ERROR),)
        return (Close(), Do(with_tool(found)))

    def view(self, session: Session, surface: Surface) -> View:
        """The entry and the tools that are known."""
        known: list[Row] = [plain(f"   {one.number}={one.diameter:g}", Look.TYPED) for one in self.tools.tools.values()]
        body = (
            (),
            entry_row("TOOL", self.entry, surface.width, fresh=self.fresh),
            (),
            plain(" Number and diameter, as 2=.5 or 2=12.7mm, or the diameter", Look.LABEL),
            plain(" alone. Offset numbers too; negative where a control has it.", Look.LABEL),
            plain(" It counts before TOOL DEF of Klartext; any other size that", Look.LABEL),
            plain(" stands in the program counts before this one.", Look.LABEL),
            (),
            *known[: max(surface.body - 8, 0)],
        )
        title = (plain(" TOOL DIAMETER", Look.HEAD), plain(f" in {self.unit}", Look.LABEL))
        return View(title, body, Said("Type the tool's diameter, Enter takes it; the verdict follows."), 1)


def read_tool(text: str, number: int, unit: Unit) -> CutterTool | str:
    """A tool as typed, or why it is none."""
    found = _NUMBERED.fullmatch(text)
    number, size = (int(found[1]), found[2]) if found else (number, text)
    value = parse(size, Kind.LENGTH, unit)
    if isinstance(value, Unreadable):
        return value.reason
    return CutterTool(number, value, unit=unit) if abs(value) <= LARGEST else "That is no diameter of a tool."


def with_tool(tool: CutterTool) -> Callable[[Desk], Desk]:
    """The program tried with this tool."""

    def work(desk: Desk) -> Desk:
        page = proof_page(desk)
        tools = page.asked.tools.with_tools(ToolTable.of(tool))
        return put(desk, replace(page.asking(tools=tools), tool=tool.number))

    return work


def stepped(page: ProofPage, step: int) -> Answer:
    """The tool's diameter a little larger or smaller."""
    tool, unit = page.asked.tools.get(page.tool), unit_of(page)
    if tool is None:
        return Answer(page, (Say(f"Tool {page.tool} has no diameter here yet: t gives it one."),))
    size = round(tool.diameter + step * STEP[tool.unit or unit], 6)
    tools = page.asked.tools.with_tools(ToolTable.of(replace(tool, diameter=size)))
    return Answer(page.asking(tools=tools), (Say(f"Tool {tool.number} is {size:g} across."),))


@dataclass(frozen=True, eq=False, slots=True)
class GoTo(EntryPage):
    """The number of a line."""

    layout: ClassVar[Layout] = Layout.TEXT

    def softkeys(self, session: Session) -> Softkeys:
        """Go or not."""
        return {1: Softkey("GO", self._gone()), 8: Softkey("CANCEL", (Close(),))}

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """Enter goes."""
        return Answer(self, self._gone()) if key == "enter" else self.typed(key, character)

    def _gone(self) -> tuple[Message, ...]:
        text = self.entry.text.strip()
        if not text.isdecimal() or len(text) > 9:
            return (Say("Type the number of a line.", Tone.ERROR),)
        row = int(text) - 1
        return (Close(), Do(lambda desk: put(desk, proof_page(desk).at_row(row))))

    def view(self, session: Session, surface: Surface) -> View:
        """The entry."""
        body = ((), entry_row("LINE", self.entry, surface.width, fresh=False))
        return View(
            (plain(" GO TO LINE", Look.HEAD), ()), body, Said("Type the number of a line, Enter goes there."), 1
        )
