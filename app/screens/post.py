"""POST NC asks for the NC file's name and the control, and shows what prevents posting and the first lines."""

from __future__ import annotations

from asyncio import to_thread
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar, Final

from textual import on, work
from textual.app import ComposeResult
from textual.containers import Horizontal, VerticalScroll
from textual.content import Content
from textual.widgets import Input, OptionList, Static

from app.screens.base import BaseScreen
from app.screens.dialogs import Phrase
from app.screens.entry_screen import EntryScreen
from app.session.formats import counted
from app.session.guide import GUIDE_COMPLETED, POST_NAME
from app.session.messages import Sentence, Tone
from app.session.posting import CENTER_PATH, OVERRIDE_PHRASES, PostedText, choices, nc_text, objections
from app.session.session import Session
from app.widgets.plain import PlainLabel, PlainText
from app.widgets.rows import NamedRows, control_rows
from app.widgets.softkeys import Softkey
from app.widgets.status import SPACED_UNITS, Prompt
from app.widgets.verdict import MARKS_OF_CHARACTERS
from core.controls.control_names import display_name
from core.controls.registry import is_klartext
from core.program.edit import FormPlace
from core.program.file.read import StoreError
from core.progress import Stopped

if TYPE_CHECKING:
    from core.program.model import Program

PREVIEW_LINES: Final = 40
"""Most lines of the NC text in the preview."""


def usual_suffix(choice: str) -> str:
    """Return the suffix of an NC file for a control: one that reads Klartext lists only .h as such programs."""
    return ".h" if choice != CENTER_PATH and is_klartext(choice) else ".nc"


class PostScreen(EntryScreen):
    """The name, the list of controls, the findings and the first lines of the NC file."""

    TITLE: ClassVar[str] = "POST NC"
    LABEL: ClassVar[str] = "NC FILE"
    GUIDE: ClassVar[str] = POST_NAME
    HAS_PROGRESS: ClassVar[bool] = True
    SOFTKEYS: ClassVar[tuple[Softkey | None, ...]] = (
        Softkey("POST", "enter", "POST"),
        Softkey("CHOOSE CONTROL", "controls", "CONTROL"),
        *(None,) * 5,
        Softkey("BACK to program", "app.back", "BACK"),
    )
    MORE_KEYS: ClassVar[tuple[tuple[str, str], ...]] = BaseScreen.MORE_KEYS

    def __init__(self, text: str = "") -> None:
        super().__init__(text)
        self.choice = ""
        self.made: PostedText | None = None
        self.stopped = False
        self._enter_waits = False
        """Enter was pressed while the text was being made: it acts once the text is there."""
        self._program: Program | None = None
        """The program that `made` is, or is being, made from."""

    def compose_head(self) -> ComposeResult:
        """Yield the unit of the file, for the operator who loads it at the machine."""
        yield PlainLabel(SPACED_UNITS[self.current_session.program.unit], classes="head-unit")

    def compose_rest(self) -> ComposeResult:
        """Yield the controls, the findings and the preview."""
        yield NamedRows(*control_rows(choices()), id="post-controls")
        with Horizontal(id="post-answer"):
            with VerticalScroll(id="post-reasons", can_focus=False):
                yield PlainText(id="post-findings")
            yield PlainText(id="post-preview")

    def on_mount(self) -> None:
        """Preselect the choice of the last posting, at first the path of the tool's center."""
        self.choice = self.host.posted_for
        self._fit_suffix()
        controls = self.query_one("#post-controls", OptionList)
        controls.border_title = "CONTROL"
        controls.highlighted = controls.get_option_index(self.choice)

    def show_session(self, session: Session) -> None:
        """Make the text again if the program has changed; otherwise just update the findings."""
        if session.program is self._program:
            self._show()
        else:
            self._make(session.program)

    @on(OptionList.OptionHighlighted, "#post-controls")
    def _control_chosen(self, event: OptionList.OptionHighlighted) -> None:
        if event.option_id is not None and event.option_id != self.choice:
            self.choice = event.option_id
            self._fit_suffix()
            self.clear_notice()
            self._make(self.current_session.program)

    def _fit_suffix(self) -> None:
        """Give the name the usual suffix for the control, unless one that is not usual was typed."""
        path, suffix = Path(self.text), usual_suffix(self.choice)
        if path.suffix in (".nc", ".h") and path.suffix != suffix:
            self._text = self.query_one("#entry", Input).value = str(path.with_suffix(suffix))

    @on(OptionList.OptionSelected, "#post-controls")
    def _control_taken(self) -> None:
        self.query_one("#entry").focus()

    @on(NamedRows.Unknown)
    def _control_unknown(self, event: NamedRows.Unknown) -> None:
        self.say(f"No control begins with {event.letters}. Up, down or letters choose, Enter goes back to the name.")

    @on(Input.Changed, "#entry")
    def _name_changed(self) -> None:
        self._enter_waits = False

    def action_controls(self) -> None:
        """Move the cursor to the list of controls."""
        self.query_one("#post-controls").focus()

    def _make(self, program: Program) -> None:
        self.made, self.stopped, self._enter_waits, self._program = None, False, False, program
        self._show()
        self._make_in_thread(program)

    @work(exclusive=True, group="post", description="post")
    async def _make_in_thread(self, program: Program) -> None:
        """Make the NC text, or find what prevents posting."""
        name = Path(self._text or "part").stem
        with suppress(Stopped):
            with self.host.working(self._make_stopped) as work:
                made = await to_thread(nc_text, program, name, self.choice, progress=work)
                if work.stopped or not self.is_live:
                    return
            self.made = made
            self._show()
            if self._enter_waits:
                self._enter_waits = False
                self.action_enter()

    def _make_stopped(self) -> None:
        """Note that Esc has stopped the work; Enter starts it again."""
        self.stopped, self._enter_waits = True, False
        self._show()

    def _show(self) -> None:
        lines, preview = self._findings(), ""
        if self.made is not None:
            preview = "\n".join(self.made.text.splitlines()[:PREVIEW_LINES])
        self.query_one("#post-preview", Static).display = bool(preview)
        self.query_one("#post-preview", Static).update(Content(preview))
        self.query_one("#post-findings", Static).update(Content("\n").join(lines))
        self.refresh_frame()
        self.call_after_refresh(self.refresh_frame)

    def _findings(self) -> list[Content]:
        """Return what prevents posting, or that all is ready; then the notes, and what is uncut or deleted."""
        marks, session = MARKS_OF_CHARACTERS[self.host.characters], self.current_session
        if self.made is None:
            text = "Stopped. Enter makes the NC text." if self.stopped else "The NC text is being made."
            return [Content.styled(text, "$c-label")]
        against = [Content.styled(f"{marks.gouge} {text}", "$c-err") for text in self.made.against]
        notes = [Content.styled(f"{marks.warning} {text}", "$c-warn") for text in self.made.notes]
        ready = [] if against else [Content.styled(f"{marks.good} Ready to post.", "$c-good")]
        uncut_or_deleted = [
            Content.styled(f"{marks.warning} {line}", "$c-uncut") for line in objections(session.derived)
        ]
        unsaved = [Content.styled("The program is not saved: Ctrl+S saves it.", "$c-label")] if session.unsaved else []
        return [*against, *ready, *notes, *uncut_or_deleted, *unsaved]

    def prompt_text(self) -> Sentence:
        """Return what Enter does."""
        if self.focused is not None and self.focused.id == "post-controls":
            chosen = next(each for each in choices() if each.control == self.choice)
            return Sentence(f"{chosen.name}, {chosen.about}. Up, down or letters choose, Enter goes back to the name.")
        more = " Page Down: more findings." if self.query_one("#post-reasons").max_scroll_y else ""
        if self.made is None or not self.made.against:
            return Sentence(f"NC file name, Enter posts. F2 or Tab: which control compensates.{more}")
        trouble = f"{counted(len(self.made.against), 'finding')} must be corrected."
        if self.made.overridable:
            trouble = "A gouge must be corrected or overridden."
        return Sentence(f"NC file name. {trouble}{more}", Tone.WARNING)

    @work(exclusive=True, group="posting")
    async def entered(self, text: str) -> None:
        """Write the NC file; ask before replacing a file, and for the phrase that overrides a gouge."""
        if self.stopped:
            self._make(self.current_session.program)
            return
        if self.made is None:
            self._enter_waits = True
            self.say("The NC text is still being made and is posted when it is ready. Esc stops it.")
            return
        override = None
        if self.made.against:
            if not self.made.overridable:
                self.say(self._refusal(self.made), Tone.ERROR)
                return
            phrase = await self.app.push_screen_wait(
                Phrase("NOT POSTED", [self.made.against[0], "Type POST ANYWAY to write it; the file says so."])
            )
            if phrase.strip().upper() not in OVERRIDE_PHRASES:
                self.say("NOT POSTED.", Tone.WARNING)
                return
            override = phrase
        await self._write(text, override)

    def _refusal(self, made: PostedText) -> str:
        """Return the first reason that prevents posting; one too long for the prompt stands whole in the findings."""
        text = f"NOT POSTED: {made.against[0]}"
        if self.query_one(Prompt).has_room(text):
            return text
        sign = MARKS_OF_CHARACTERS[self.host.characters].gouge
        goes = "" if made.block is None else f" F10 goes to block {made.block}."
        return f"NOT POSTED: the reason stands above, at the first {sign}.{goes}"

    def action_panel(self, name: str) -> None:
        """Go to a list on MILL CONTOUR; that of the findings is of the block that prevents posting."""
        if name == "findings":
            self._go_to_refused_block()
        super().action_panel(name)

    def action_finding(self, by: int) -> None:
        """Show the next or previous finding of the block that prevents posting."""
        self._go_to_refused_block()
        super().action_finding(by)

    def _go_to_refused_block(self) -> None:
        block = None if self.made is None else self.made.block
        if block is not None and block != self.current_session.place.block:
            self.host.move(FormPlace(block))

    async def _write(self, text: str, override: str | None) -> None:
        program, choice = self.current_session.program, self.choice

        def make(path: Path) -> str:
            """Make the text again under the typed name, so that nothing stale is written."""
            made = nc_text(program, path.stem, choice, override)
            if made.against and override is None:
                raise StoreError(f"NOT POSTED: {made.against[0]}")
            return made.text

        written = await self.host.write_made(text, usual_suffix(choice), make)
        if written is None:
            return
        self.host.posted_for = choice
        path, lines = written[0], written[1].count("\n")
        subject = "the center path" if choice == CENTER_PATH else f"for {display_name(choice)}"
        self.notify(f"Posted {subject}: {path}, {lines} lines.", timeout=5)
        self.app.call_later(self.app.run_action, "app.back")
        self.app.call_later(self.host.end_guide, f"Posted. {GUIDE_COMPLETED}")
