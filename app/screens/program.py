"""PROGRAM lists the blocks of a program and draws the one with the cursor."""

from __future__ import annotations

from asyncio import to_thread
from typing import ClassVar

from textual import events, on, work
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, Vertical
from textual.content import Content
from textual.widgets import DataTable, Label

from app.documents.folder_list import outcome_of
from app.screens.base import LIST_KEYS
from app.screens.block_actions import COPY_AND_MOVE, BlockActions
from app.session.block_findings import block_findings
from app.session.formats import counted
from app.session.guide import on_program
from app.session.session import Session
from app.session.work import times_in_words
from app.widgets.block_summary import BlockSummary
from app.widgets.drawing import Drawing
from app.widgets.findings_list import FindingsList
from app.widgets.plain import PlainLabel
from app.widgets.rows import RowTable
from app.widgets.softkeys import Softkey
from app.widgets.verdict import MARKS_OF_CHARACTERS, Marks, verdict_word
from core.pipeline.derived import Derived, DerivedBlock
from core.program.edit import SEGMENT_FIELD, FormPlace
from core.program.model import Number

COLUMNS = (("BLOCK", 5), ("KIND", 12), ("CUTTER COMP.", 13), ("TOOL", 4), ("SEG", 3), ("VERDICT", 11))


class ProgramScreen(BlockActions):
    """The list of blocks; Enter edits the block with the cursor."""

    AUTO_FOCUS: ClassVar[str | None] = "#blocks"
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("ctrl+up", "move_block(-1)", "Move block up", show=False),
        Binding("ctrl+down", "move_block(1)", "Move block down", show=False),
        Binding("c,C", "copy_block", "Copy block", show=False),
        Binding("escape", "app.home", "Back to files", show=False),
    ]
    SOFTKEYS: ClassVar[tuple[Softkey | None, ...]] = (
        Softkey("DELETE BLOCK", "delete_block", "DELETE"),
        Softkey("INSERT BLOCK AFTER", "insert_block", "INSERT"),
        Softkey("POST NC", "app.post", "POST"),
        Softkey("PROGRAM PARAMETERS", "app.parameters", "PARAMS"),
        Softkey("PART SETUP", "app.part_setup", "SETUP"),
        Softkey("TOOL SETUP", "app.tools", "TOOLS"),
        Softkey("DRAW", "app.draw", "DRAW"),
        Softkey("BACK to files", "app.home", "BACK"),
    )
    MORE_KEYS: ClassVar[tuple[tuple[str, str], ...]] = (*LIST_KEYS, ("^S", "SAVE"), ("?", "KEYS, HELP"))
    PROMPT: ClassVar[str] = "Enter edits the block. C copies it, Ctrl+Up and Ctrl+Down move it."
    PALETTE_ACTIONS: ClassVar[tuple[tuple[str, str, str], ...]] = COPY_AND_MOVE

    def __init__(self) -> None:
        super().__init__()
        self.times: dict[int, str] = {}

    def compose_body(self) -> ComposeResult:
        """Lay out the title, the table of blocks and the drawing."""
        with Vertical(id="program", classes="panel -bare"):
            with Horizontal(classes="head"):
                yield PlainLabel("PROGRAM", classes="head-label")
                yield PlainLabel(id="block-count", classes="head-kind")
                yield PlainLabel(id="program-file", classes="head-note")
            yield RowTable(COLUMNS, id="blocks")
            yield BlockSummary()
            yield FindingsList(id="program-findings")
        yield Drawing(id="block-drawing")

    def show_session(self, session: Session) -> None:
        """Show one row per block."""
        table, marks = self.query_one("#blocks", RowTable), MARKS_OF_CHARACTERS[self.host.characters]
        cursor_row = table.cursor_row
        table.clear()
        for block in session.derived.blocks:
            table.add_row(*_row(block, marks))
        table.follow(session.place.block - 1, cursor_row)
        self.query_one("#block-count", Label).update(counted(len(session.program.blocks), "block"))
        self.query_one("#program-file", Label).update(session.file_label)
        self._draw()
        if all(block.complete for block in session.derived.blocks):
            self._time(session.derived)

    @work(exclusive=True, group="times", description="times")
    async def _time(self, derived: Derived) -> None:
        """Show the times in the title of the drawing and next to the number of blocks."""
        total, blocks = await to_thread(times_in_words, derived)
        if not self.is_live or derived is not self.current_session.derived:
            return
        self.times = blocks
        self.query_one("#block-count", Label).update(f"{counted(len(derived.blocks), 'block')}   {total}")
        self._draw()

    def guide_text(self) -> str:
        """Return the next step of the guide's plate."""
        return on_program(self.current_session)

    @property
    def at_rest(self) -> bool:
        """Always true, as nothing is typed on this screen."""
        return True

    @property
    def chosen(self) -> int:
        """The number of the block with the cursor."""
        return self.query_one("#blocks", DataTable).cursor_row + 1

    @on(DataTable.RowHighlighted)
    def _highlighted(self) -> None:
        number = self.chosen
        if number != self.current_session.place.block and number <= len(self.current_session.program.blocks):
            self.query_one("#blocks", RowTable).program_row = number - 1
            self.host.move(FormPlace(number))
        self._draw()

    def _draw(self) -> None:
        # imported here: the first paint must not load numpy and shapely
        from core.pipeline.plot import Subject

        session, drawing = self.current_session, self.query_one("#block-drawing", Drawing)
        if self.chosen > len(session.derived.blocks):
            return
        block = session.derived.block(self.chosen)
        times = self.times.get(block.number, "")
        self.query_one(BlockSummary).show(block, session.program.unit, self.host.characters, times)
        findings = self.query_one(FindingsList)
        if findings.display:
            table = session.lookahead_table if block is session.derived_block else None
            findings.entries = block_findings(block, table, session.program.unit)
        drawing.heading = f"BLOCK {block.number}{f'  {times}' if times else ''}"
        drawing.subject = Subject(block, session.program.unit)

    @on(events.Resize)
    def _fill(self) -> None:
        """Show the findings on a terminal that has become large enough for them."""
        self.call_after_refresh(self._draw)

    @on(DataTable.RowSelected)
    def _edit_block(self, event: DataTable.RowSelected) -> None:
        self.edit_block(event.cursor_row + 1, SEGMENT_FIELD)


def _row(block: DerivedBlock, marks: Marks) -> tuple[Content, ...]:
    tool = f"{block.block.tool.value:g}" if isinstance(block.block.tool, Number) else "?"
    texts = (str(block.number), "MILL CONTOUR", str(block.block.cutter_comp), tool, str(len(block.block.segments)))
    verdict = verdict_word(outcome_of(block), marks) if block.complete else Content("...")
    return (*(Content(text) for text in texts), verdict)
