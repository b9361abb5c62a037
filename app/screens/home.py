"""HOME lists a folder's programs and drawings and the example parts; from here new programs and the guide start."""

from __future__ import annotations

from asyncio import to_thread
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path
from typing import ClassVar, Final

from textual import events, on, work
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Vertical
from textual.content import Content
from textual.widgets import DataTable, Static

from app.documents.files import load, why
from app.documents.folder_list import (
    DRAWING,
    NC_PROGRAM,
    Facts,
    Listed,
    day_of,
    example_programs,
    facts_of,
    openable_files,
)
from app.documents.paths import current_folder, short_path
from app.screens.base import NO_LIST_KEYS, BaseScreen
from app.session.formats import counted, length
from app.session.messages import Sentence, Tone
from app.widgets.block_summary import BlockSummary
from app.widgets.drawing import Drawable, Drawing
from app.widgets.plain import PlainText
from app.widgets.rows import RowTable, TypedLetters
from app.widgets.softkeys import Softkey
from app.widgets.verdict import MARKS_OF_CHARACTERS, verdict_word
from core.pipeline.derived import Derived
from core.program.file.read import StoreError
from core.units import Unit

NAME_WIDTH: Final = 17
COLUMNS: Final = (("PROGRAM", NAME_WIDTH), ("CHANGED", 11), ("BLK", 3), ("TOOLS", 6), ("VERDICT", 12))
PROMPT: Final = "Up and down choose, Enter opens. Letters jump to a name. F2 starts a new part in inch, F3 in mm."


class HomeScreen(BaseScreen):
    """The list of files, with a drawing of the program under the cursor."""

    AUTO_FOCUS: ClassVar[str | None] = "#programs"
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("left,backspace", "folder_above", "Folder above", show=False),
        Binding("escape", "leave", "Back", show=False),
    ]
    SOFTKEYS: ClassVar[tuple[Softkey | None, ...]] = (
        Softkey("OPEN", "open", "OPEN", lambda screen: screen.chosen is not None, "The list is empty."),
        Softkey("NEW INCH", "app.new('IN')", "INCH"),
        Softkey("NEW MM", "app.new('MM')", "MM"),
        Softkey("OPEN A PATH", "app.open_path", "PATH"),
        Softkey("FOLDER ABOVE", "folder_above", "ABOVE"),
        Softkey("NC PROOF", "app.open_path", "PROOF"),
        Softkey("GUIDED FIRST PART", "app.guide", "GUIDE"),
        Softkey("QUIT", "app.quit", "QUIT"),
    )
    MORE_KEYS: ClassVar[tuple[tuple[str, str], ...]] = NO_LIST_KEYS

    def __init__(self, folder: Path, at: Path | None = None) -> None:
        super().__init__()
        self.folder, self._at = folder, at
        self.listed: tuple[Listed, ...] = ()
        self.facts: dict[Path, Facts] = {}
        self.trouble = ""
        self._was_in_front = False
        self._last_chosen: Path | None = None
        self._typed = TypedLetters()

    def compose_body(self) -> ComposeResult:
        """Lay out the folder's name, its files, and the drawing of the program with the cursor."""
        with Vertical(id="files", classes="panel -bare") as files:
            files.border_title = "PROGRAMS"
            yield PlainText(id="folder", classes="head")
            yield RowTable(COLUMNS, id="programs")
            yield BlockSummary()
        yield Drawing(id="preview")

    def on_mount(self) -> None:
        """List the files, with the cursor on the open one unless another is asked for."""
        proofs = self.host.proofs
        file = proofs[-1].document.file.path if proofs else self.current_session.file
        self.show_folder(self.folder, at=self._at or (None if file is None else current_folder() / file))

    def on_screen_resume(self) -> None:
        """Refresh the list, except the first time: files may have changed behind another screen."""
        if self._was_in_front:
            self.list_anew()
        self._was_in_front = True

    # ---- the list

    def show_folder(self, folder: Path, *, at: Path | None = None) -> None:
        """List a folder with the cursor on `at`; if it cannot be read, say why and list only the examples."""
        try:
            self.listed, self.trouble = openable_files(folder), ""
        except OSError as error:
            self.trouble = f"{short_path(folder)} cannot be shown: {why(error)}"
            self.listed = tuple(example_programs())
        self.folder = folder
        self.query_one("#folder", Static).update(
            Content.assemble((" CUTCOMP ", "bold reverse"), f"  {folder}   {self._counts()}")
        )
        table = self.query_one("#programs", DataTable)
        table.clear()
        for each in self.listed:
            table.add_row(*self._cells(each), key=str(each.path))
        rows = [row for row, each in enumerate(self.listed) if each.path == at]
        table.move_cursor(row=rows[0] if rows else 0)
        self._survey()
        self.refresh_frame()

    def list_anew(self) -> None:
        """Refresh the list, with the cursor on the same file; keep the old list if the folder does not answer."""
        try:
            same = openable_files(self.folder) == self.listed
        except OSError:
            return
        if same:
            self._survey()
        else:
            chosen = self.chosen
            self.show_folder(self.folder, at=None if chosen is None else chosen.path)

    def _counts(self) -> str:
        """Return how many files of each kind the folder holds."""
        programs = sum(each.program and not each.example for each in self.listed)
        others = {kind: sum(each.kind == kind for each in self.listed) for kind in (DRAWING, NC_PROGRAM)}
        words = [counted(count, kind) for kind, count in others.items() if count]
        return ", ".join([counted(programs, "program"), *words] if programs or not words else words)

    def _cells(self, each: Listed) -> Sequence[Content]:
        name = Content.styled(each.name, "" if each.example else "bold").truncate(NAME_WIDTH, ellipsis=True)
        if each.folder or each.kind:
            # a long name has lost the slash of a folder
            return name, *(Content(""),) * 3, Content.styled(each.kind or "folder", "$c-label")
        if each.copy is not None:
            changed = datetime.fromisoformat(each.copy.time)
            return name, Content(day_of(changed, self.host.now())), Content(""), Content(""), Content(each.copy.word)
        facts = self.facts.get(each.path, Facts(each.path))
        day = "example" if each.example else "" if facts.changed is None else day_of(facts.changed, self.host.now())
        verdict = (
            Content("...")
            if facts.outcome is None
            else verdict_word(facts.outcome, MARKS_OF_CHARACTERS[self.host.characters])
        )
        return name, Content(day), Content(f"{facts.blocks:>3}"), Content(facts.tools), verdict

    @work(exclusive=True, group="survey")
    async def _survey(self) -> None:
        """Read the facts of the programs, one file after the other."""
        for each in self.listed:
            if each.program:
                self._show_facts(await to_thread(facts_of, each.path, self.facts.get(each.path)))

    def _show_facts(self, facts: Facts) -> None:
        if not self.is_live or self.facts.get(facts.path) == facts:
            return
        self.facts[facts.path] = facts
        table = self.query_one("#programs", DataTable)
        each = next((each for each in self.listed if each.path == facts.path), None)
        if each is not None:
            for (label, _), cell in zip(COLUMNS, self._cells(each), strict=True):
                table.update_cell(str(each.path), label, cell)
            self.refresh_frame()

    @property
    def chosen(self) -> Listed | None:
        """The entry with the cursor."""
        row = self.query_one("#programs", DataTable).cursor_row
        return self.listed[row] if row < len(self.listed) else None

    @on(DataTable.RowHighlighted)
    def _highlighted(self) -> None:
        each = self.chosen
        if each is not None and each.path != self._last_chosen:
            self._last_chosen = each.path
            self.clear_notice()
        if each is not None and each.program:
            self._preview(each.path, each.name)
        elif each is not None:
            self._show_preview(each.path, each.name)
        self.refresh_frame()

    @work(exclusive=True, group="preview")
    async def _preview(self, path: Path, name: str) -> None:
        """Draw the first block of the program with the cursor."""
        self._show_preview(path, *await to_thread(_first_block, path, name))

    def _show_preview(
        self, path: Path, heading: str, subject: Drawable | None = None, derived: Derived | None = None
    ) -> None:
        """Show the drawing of a file unless the cursor has left it."""
        if not self.is_live or self.chosen is None or self.chosen.path != path:
            return
        drawing = self.query_one("#preview", Drawing)
        drawing.heading, drawing.subject = heading, subject
        unit = Unit.IN if derived is None else derived.program.unit
        self.query_one(BlockSummary).show(None if derived is None else derived.block(1), unit, self.host.characters)

    # ---- keys

    @on(DataTable.RowSelected)
    def action_open(self) -> None:
        """Open the file or folder with the cursor."""
        each = self.chosen
        if each is None:
            return
        if each.folder:
            self.show_folder(each.path)
        else:
            self.host.open_file(each.path, kept_copy=each.copy is not None)

    async def action_leave(self) -> None:
        """Go back to the open work, if there is any; an empty form is not work."""
        session = self.current_session
        if session.file is None and not session.unsaved and not self.host.proofs:
            self.say("Enter opens a file, F2 and F3 start a new part, F8 quits.")
        else:
            await self.run_action("app.back")

    def action_folder_above(self) -> None:
        """List the parent folder, with the cursor on this one."""
        self.show_folder(self.folder.parent, at=self.folder)

    def on_key(self, event: events.Key) -> None:
        """Jump to the next name that begins with the letters typed."""
        table = self.query_one("#programs", DataTable)
        row = self._typed.row(event, [(each.name.lower(),) for each in self.listed], table.cursor_row)
        if row is not None:
            event.stop()
            table.move_cursor(row=row)

    def prompt_text(self) -> Sentence:
        """Return what a kept copy offers, what is wrong with the folder or file, or what the keys do."""
        each = self.chosen
        if each is not None and each.copy is not None:
            return Sentence(f"{each.copy.sentence(self.host.now().isoformat())} Enter offers it back.")
        facts = None if each is None else self.facts.get(each.path)
        trouble = self.trouble or ("" if facts is None else facts.trouble)
        return Sentence(trouble, Tone.WARNING) if trouble else Sentence(PROMPT)


def _first_block(path: Path, name: str) -> tuple[str, Drawable | None, Derived | None]:
    """Return the heading and subject of a program's drawing and what is derived; only a heading if unreadable."""
    # imported here: the first paint must not load numpy and shapely
    from core.pipeline.derive import derive
    from core.pipeline.plot import Subject

    try:
        derived = derive(load(path))
    except StoreError:
        return name, None, None
    block, unit = derived.block(1), derived.program.unit
    tool = "" if block.radius is None else f", tool {length(2 * block.radius, unit)}"
    of = "" if len(derived.blocks) == 1 else f"block 1 of {len(derived.blocks)}: "
    return f"{name}  {of}{len(block.block.segments)} segments{tool}", Subject(block, unit), derived
