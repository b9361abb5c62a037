"""IMPORT TOOL TABLE reads a LinuxCNC tool table and shows its errors and what it would change."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Final

from textual import work
from textual.app import ComposeResult
from textual.content import Content
from textual.widgets import Static

from app.documents.paths import path_of_text
from app.documents.questions import Answer
from app.documents.tool_tables import merged, read_table, tool_line
from app.screens.dialogs import Question
from app.screens.entry_screen import EntryScreen, entry_keys
from app.session.messages import Tone
from app.widgets.plain import PlainText
from app.widgets.softkeys import Softkey
from core.finding import Finding, Severity
from core.program.file.read import StoreError
from core.program.model import Program, Tool
from core.units import Unit

UNIT_NAMES: Final = {Unit.IN: "INCH", Unit.MM: "MM"}
MAX_LISTED: int = 2
"""Most changed tools that the question lists."""


class ImportToolsScreen(EntryScreen):
    """The table's file name and the unit of its lengths, which the table itself does not state."""

    TITLE: ClassVar[str] = "IMPORT TOOL TABLE"
    PROMPT: ClassVar[str] = "Name of a LinuxCNC tool table, Enter reads it. F2 changes the units of its lengths."
    SOFTKEYS: ClassVar[tuple[Softkey | None, ...]] = entry_keys(
        "IMPORT", Softkey("CHANGE TABLE UNITS", "other_unit", "UNITS")
    )

    def __init__(self, text: str, unit: Unit) -> None:
        super().__init__(text)
        self.unit = unit

    def compose_rest(self) -> ComposeResult:
        """Yield the unit and the errors."""
        yield PlainText(f" TABLE UNITS: {UNIT_NAMES[self.unit]}", id="table-unit")
        yield PlainText(id="table-faults")

    def action_other_unit(self) -> None:
        """Switch the unit of the table's lengths."""
        self.unit = Unit.MM if self.unit is Unit.IN else Unit.IN
        self.query_one("#table-unit", Static).update(f" TABLE UNITS: {UNIT_NAMES[self.unit]}")

    @work(exclusive=True, group="question")
    async def entered(self, text: str) -> None:
        """Read the table; ask before anything changes."""
        program, faults = self.current_session.program, self.query_one("#table-faults", Static)
        try:
            table = read_table(path_of_text(text), self.unit, program.unit)
        except StoreError as error:
            self.say(str(error), Tone.ERROR)
            return
        faults.update(Content("\n").join([_fault(finding) for finding in table.findings]))
        if table.errors:
            self.say("Nothing was imported. Correct the lines that are listed.", Tone.ERROR)
            return
        ask = Question("IMPORT?", list(changes(program, table.tools)), [Answer("IMPORT")], "GO BACK")
        if await self.app.push_screen_wait(ask) == "IMPORT":
            self.host.apply(merged(program, table.tools), "IMPORT TOOL TABLE")
            self.notify(f"Imported {len(table.tools)} tools. Ctrl+Z brings the old ones back.", timeout=4)
            self.app.call_later(self.app.run_action, "app.back")


def _fault(finding: Finding) -> Content:
    role = "$c-err" if finding.severity is Severity.ERROR else "$c-warn"
    return Content.styled(f" line {finding.line}, column {finding.column}: {finding.text}", role)


def changes(program: Program, tools: tuple[Tool, ...]) -> Iterator[str]:
    """Yield a few lines on what the import would change in the tool table."""
    known = {tool.number: tool for tool in program.tools}
    new = [tool for tool in tools if tool.number not in known]
    changed = [tool for tool in tools if tool.number in known and known[tool.number] != tool]
    yield f"Tools: {len(tools)}. New: {len(new)}. Changed: {len(changed)}."
    for tool in changed[:MAX_LISTED]:
        before, after = tool_line(known[tool.number], program.unit), tool_line(tool, program.unit)
        yield f"{' '.join(before.split())} becomes {' '.join(after.split()[1:])}"
    if len(changed) > MAX_LISTED:
        yield f"{len(changed) - MAX_LISTED} more change."
