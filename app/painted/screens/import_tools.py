"""IMPORT TOOL TABLE: the file of a LinuxCNC tool table, what is wrong with it, and what it would change."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar

from app.documents.naming import typed
from app.painted.messages import Close, Do, Edit, Message, Open, Say
from app.painted.screens.ask import Ask
from app.painted.screens.entry import EntryPage, entry_row
from app.painted.screens.page import Answer, Layout, Softkey, Softkeys, Surface, View
from app.painted.screens.text import TextPage, paragraph
from app.painted.session import Said, Session, Tone
from app.painted.widgets.field import Editing
from app.painted.widgets.header import header
from app.painted.widgets.rows import Look, Row, plain
from core.finding import Finding, Severity
from core.program.file.read import StoreError
from core.program.model import Program, Tool
from core.units import Unit

if TYPE_CHECKING:
    from app.painted.desk import Desk


@dataclass(frozen=True, eq=False, slots=True)
class ImportPage(EntryPage):
    """The table's name and the unit its lengths are in; a table does not say it itself."""

    unit: Unit = Unit.IN

    @classmethod
    def of(cls, session: Session) -> ImportPage:
        """The page with LinuxCNC's usual name, in the program's unit."""
        return cls(Editing.of("tool.tbl"), unit=session.program.unit)

    def softkeys(self, session: Session) -> Softkeys:
        """Read it; in the other unit."""
        other = Unit.MM if self.unit is Unit.IN else Unit.IN
        return {
            1: Softkey("IMPORT", (Do(importing(self.entry.text, self.unit)),)),
            2: Softkey(f"TABLE IS IN {other}", (Do(in_unit(other)),)),
            8: Softkey("CANCEL", (Close(),)),
        }

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """Enter reads; up and down change the unit."""
        if key == "enter":
            return self.accepted((Do(importing(self.entry.text, self.unit)),))
        if key in ("up", "down"):
            return Answer(replace(self, unit=Unit.MM if self.unit is Unit.IN else Unit.IN))
        return self.typed(key, character)

    def softkeyed(self, session: Session, number: int, messages: tuple[Message, ...]) -> Answer:
        """IMPORT is Enter."""
        return self.accepted(messages) if number == 1 else Answer(self, messages)

    def view(self, session: Session, surface: Surface) -> View:
        """The name and the unit."""
        name = entry_row("FILE", self.entry, surface.width, fresh=self.replaced)
        rows = ((), name, (), plain(f" The diameters in the table are in {self.unit}.", Look.HEAD))
        said = Said("Type the name of a LinuxCNC tool table. Up and down change its unit, Enter reads it.")
        return View(header("IMPORT TOOL TABLE", plain(""), session, surface.width), rows, said, 1)


@dataclass(frozen=True, eq=False, slots=True)
class FaultsPage(TextPage):
    """Why a table is not imported."""

    layout: ClassVar[Layout] = Layout.TEXT
    findings: tuple[Finding, ...] = ()

    def title(self, session: Session) -> str:
        """What happened."""
        return "NOTHING WAS IMPORTED"

    def lines(self, session: Session, surface: Surface) -> tuple[Row, ...]:
        """Each fault with its place."""
        return tuple(row for one in self.findings for row in paragraph(_told(one), surface.width, _look(one), "  "))


def _told(one: Finding) -> str:
    return f"line {one.line}, column {one.column}: {one.text}"


def _look(one: Finding) -> Look:
    return Look.ERROR if one.severity is Severity.ERROR else Look.WARNING


def in_unit(unit: Unit) -> Callable[[Desk], Desk]:
    """What makes the table one in this unit."""

    def work(desk: Desk) -> Desk:
        page = desk.page
        page = replace(page, unit=unit) if isinstance(page, ImportPage) else page
        return replace(desk, pages=(*desk.pages[:-1], page))

    return work


def importing(name: str, unit: Unit) -> Callable[[Desk], Desk]:
    """What reads the table and asks before anything changes."""

    def work(desk: Desk) -> Desk:
        from app.documents.tool_tables import merged, read_table

        program = desk.session.program
        try:
            table = read_table(typed(name), unit, program.unit)
        except StoreError as error:
            return desk.take(Say(str(error), Tone.ERROR))
        if table.errors:
            return desk.take(Open(FaultsPage(findings=table.findings)))
        edit = Edit(merged(program, table.tools), "IMPORT TOOL TABLE")
        lines = (*_changes(program, table.tools), *(_told(one) for one in table.findings[:3]))
        done = Say(f"Imported: {name.strip()}. Ctrl+Z brings the tools back that were here before.")
        return desk.take(Open(Ask("IMPORT?", lines, (("i", "IMPORT", (Close(), Close(), edit, done)),))))

    return work


def _changes(program: Program, tools: tuple[Tool, ...]) -> tuple[str, ...]:
    """What the import does to the table, in a few lines."""
    from app.documents.tool_tables import tool_line as told

    known = {tool.number: tool for tool in program.tools}
    new = [tool for tool in tools if tool.number not in known]
    other = [tool for tool in tools if tool.number in known and known[tool.number] != tool]
    lines = [f"Tools: {len(tools)}. New: {len(new)}. In place of one that differs: {len(other)}."]
    for tool in other[:2]:
        before, after = told(known[tool.number], program.unit), told(tool, program.unit)
        lines.append(f"{' '.join(before.split())} becomes {' '.join(after.split()[1:])}")
    return (*lines, f"{len(other) - 2} more change.") if len(other) > 2 else tuple(lines)
