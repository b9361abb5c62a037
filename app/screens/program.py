"""PROGRAM: the blocks of a program."""

from __future__ import annotations

from typing import ClassVar

from rich.text import Text
from textual import on
from textual.app import ComposeResult
from textual.containers import Horizontal, Vertical
from textual.widgets import DataTable, Label

from app.screens.base import BaseScreen
from app.session.messages import Sentence
from app.session.session import Session
from app.widgets.softkeys import Softkey
from core.finding import Severity
from core.pipeline.derived import DerivedBlock
from core.program.edit import FormPlace, delete_block, insert_block
from core.program.model import Number

COLUMNS = (("BLOCK", 5), ("KIND", 13), ("CUTTER COMP.", 14), ("TOOL", 4), ("SEG", 4), ("VERDICT", 10))


class ProgramScreen(BaseScreen):
    """The list of blocks; Enter edits the one with the cursor."""

    AUTO_FOCUS: ClassVar[str | None] = "#blocks"
    SOFTKEYS: ClassVar[tuple[Softkey | None, ...]] = (
        Softkey("DELETE BLOCK", "delete_block", "DELETE"),
        Softkey("INSERT BLOCK AFTER", "insert_block", "INSERT"),
        None,
        Softkey("PROGRAM PARAMETERS", "app.parameters", "PARAMS"),
        Softkey("PART SETUP", "app.part_setup", "SETUP"),
        Softkey("TOOL SETUP", "app.tools", "TOOLS"),
        Softkey("DRAW", "app.draw", "DRAW"),
        Softkey("QUIT", "app.quit", "QUIT"),
    )
    MORE_KEYS: ClassVar[tuple[tuple[str, str], ...]] = (("?", "KEYS, HELP"),)

    def compose_body(self) -> ComposeResult:
        """A title and the table of blocks."""
        with Vertical(id="program", classes="panel"):
            with Horizontal(classes="head"):
                yield Label("PROGRAM", classes="head-label")
                yield Label(id="block-count", classes="head-kind")
            yield DataTable(id="blocks", cursor_type="row")

    def on_mount(self) -> None:
        """The columns."""
        table = self.query_exactly_one("#blocks", DataTable)
        for label, width in COLUMNS:
            table.add_column(label, width=width)
        super().on_mount()

    def show_session(self, session: Session) -> None:
        """One row a block."""
        table = self.query_exactly_one("#blocks", DataTable)
        table.clear()
        for block in session.derived.blocks:
            table.add_row(*_row(block))
        table.move_cursor(row=session.place.block - 1)
        count = len(session.program.blocks)
        self.query_exactly_one("#block-count", Label).update(f"{count} block{'s' if count != 1 else ''}")

    def prompt_text(self) -> Sentence:
        """What the keys do."""
        return Sentence("Enter edits the block, up and down go from block to block.")

    @property
    def chosen(self) -> int:
        """The number of the block with the cursor."""
        return self.query_exactly_one("#blocks", DataTable).cursor_row + 1

    @on(DataTable.RowSelected)
    def _edit_block(self, event: DataTable.RowSelected) -> None:
        event.stop()
        self.host.move(FormPlace(event.cursor_row + 1))
        self.host.action_contour()

    def action_insert_block(self) -> None:
        """A new block after the one with the cursor, and its form."""
        at = self.chosen + 1
        if self.host.apply(insert_block(self.current_session.program, at), f"INSERT BLOCK {at}"):
            self.host.move(FormPlace(at))
            self.host.action_contour()

    def action_delete_block(self) -> None:
        """Delete the block with the cursor."""
        at = self.chosen
        if self.host.apply(delete_block(self.current_session.program, at), f"DELETE BLOCK {at}"):
            self.notify(f"Deleted block {at}. Ctrl+Z brings it back.", timeout=3)


def _row(block: DerivedBlock) -> tuple[Text, ...]:
    tool = f"{block.block.tool.value:g}" if isinstance(block.block.tool, Number) else "?"
    texts = (str(block.number), "MILL CONTOUR", str(block.block.cutter_comp), tool, str(len(block.block.segments)))
    return (*(Text(text) for text in texts), Text(verdict_word(block)))


def verdict_word(block: DerivedBlock) -> str:
    """The verdict on a block in one word."""
    if not block.known:
        return "..."
    if block.errors:
        gouges = any(finding.code.endswith(("GOUGE", "GOUGES")) for finding in block.errors)
        return "✖ gouge" if gouges else "? not ready"
    if any(finding.severity is Severity.WARNING for finding in block.findings):
        return "▲ warning"
    uncut = block.paths is not None and block.paths.verdict is not None and block.paths.verdict.uncut
    return "▲ uncut" if uncut else "✓ clean"
