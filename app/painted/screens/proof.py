"""NC PROOF: a program's listing, the path a control makes of it, and what is to be said about it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Final

from app.documents.lock import Lock
from app.documents.nc_text import NcText
from app.painted.messages import Close, Leave, Message, Open, Say
from app.painted.proving import Question, Rest, Told, guess, tool_in
from app.painted.screens.ask import Ask
from app.painted.screens.page import WHOLE, Answer, Layout, Page, Sketch, Softkeys, Surface, View
from app.painted.session import Session, Tone
from app.painted.widgets.field import Editing, press
from core.controls.control_tools import ToolTable
from core.finding import Finding

STEPS: Final = {"up": -1, "down": 1, "pageup": -10, "pagedown": 10}
ENDS: Final = {"home": 0, "ctrl+home": 0, "end": 10**9, "ctrl+end": 10**9}
LONGEST: Final = 1_000_000
"""Characters of a line up to which more can be typed into it."""
OWN_KEYS: Final = {"ctrl+z": "u", "ctrl+y": "r", "ctrl+s": "s", "ctrl+f": "f"}
"""Keys that mean the program on other pages, and the letters that mean the same for the listing here."""
TURNING: Final = ("ctrl+z", "ctrl+y")
"""Those of them that take back a line being typed."""


@dataclass(frozen=True, eq=False, slots=True)
class ProofPage(Page):
    """One program under proof.

    `asked` is the question now and `told` the last answer, which may still be to an earlier one.  `row` is the line
    with the cursor, from 0; `at` the finding with it, and `telling` whether the arrows walk over the findings.
    `editing` is the line being typed.  `tool` is the number that < and > change.  `alone`: nothing lies below, leaving
    the page leaves the program.  `large`: the drawing has the whole terminal.  `second`: the other set of softkeys.
    `looking` is empty, or says who has the file open: its text cannot be changed then.  `lock` is ours, or None.
    `earlier` is a journal that was set aside and that somebody wants back.
    """

    asked: Question
    file: Path | None = None
    told: Told | None = None
    row: int = 0
    at: int = 0
    telling: bool = False
    editing: Editing | None = None
    tool: int = 1
    sketch: Sketch = field(default=WHOLE)
    alone: bool = False
    large: bool = False
    second: bool = False
    looking: str = ""
    lock: Lock | None = None
    earlier: Path | None = None
    opening: object = field(default_factory=object)

    @staticmethod
    def of(listing: NcText, file: Path | None = None, *, control: str = "", alone: bool = False) -> ProofPage:
        """The page on a text, on the control it looks like where none is named."""
        question = Question(listing, control or guess(listing), ToolTable())
        return ProofPage(question, file, tool=tool_in(listing), alone=alone)

    @property
    def layout(self) -> Layout:  # type: ignore[override]  # the one page with two layouts
        """A listing beside a drawing, or the drawing alone."""
        return Layout.DRAW if self.large else Layout.PROOF

    @property
    def listing(self) -> NcText:
        """The text as it is now."""
        return self.asked.listing

    @property
    def control(self) -> str:
        """The control the program is tried on."""
        assert self.asked.control is not None
        return self.asked.control

    @property
    def fresh(self) -> bool:
        """The answer is to the question that stands."""
        return self.told is not None and self.told.question is self.asked

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What was found last."""
        return () if self.told is None else self.told.findings

    @property
    def question(self) -> Question | Rest | None:
        """What is asked and not known yet: everything, or the verdict alone."""
        return self.asked if self.told is None or not self.fresh else self.told.rest

    def hearing(self, answer: object) -> ProofPage:
        """An answer to what is asked now; any other is dropped."""
        if not isinstance(answer, Told) or answer.question is not self.asked:
            return self
        last = max(len(answer.findings) - 1, 0)
        told = replace(self, told=answer, at=min(self.at, last), telling=self.telling and bool(answer.findings))
        return told.marked()

    @property
    def unsaved(self) -> bool:
        """The listing has changes that no file has."""
        return self.listing.unsaved

    def asking(
        self, *, listing: NcText | None = None, control: str | None = None, tools: ToolTable | None = None
    ) -> ProofPage:
        """The page with another question; a text without lines is one too."""
        now = self.asked
        text = now.listing if listing is None else listing
        known = now.tools if tools is None else tools
        return replace(self, asked=Question(text, control or now.control, known, now.unit))

    def softkeys(self, session: Session) -> Softkeys:
        """Two sets; F7 changes between them."""
        from app.painted.screens.proof_keys import softkeys

        return softkeys(self)

    def softkeyed(self, session: Session, number: int, messages: tuple[Message, ...]) -> Answer:
        """What a softkey does."""
        from app.painted.screens.proof_keys import chosen

        return chosen(self, number)

    def settle(self, session: Session) -> Answer:
        """A line being typed is taken."""
        return Answer(self) if self.editing is None else self.accepted()

    def escape(self, session: Session) -> Answer | None:
        """The line as it was; out of the large drawing; out of the findings; nothing else."""
        if self.editing is not None:
            return Answer(replace(self, editing=None))
        if self.large:
            return Answer(replace(self, large=False))
        return Answer(replace(self, telling=False)) if self.telling else None

    def everywhere(self, key: str, session: Session) -> Answer | None:
        """Undo, redo, save and the findings are those of the listing."""
        if key not in OWN_KEYS:
            return None
        if self.editing is not None and key in TURNING:
            return Answer(replace(self, editing=None))
        settled = self.settle(session)
        page = settled.page
        if settled.messages or not isinstance(page, ProofPage):
            return settled
        return page.press(OWN_KEYS[key], OWN_KEYS[key], session)

    def pasted(self, text: str, session: Session) -> Answer | None:
        """Letters are orders here: text is pasted into a line that is being typed only."""
        return None if self.editing is not None else Answer(self, (Say("Enter first: text goes into a line."),))

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """A key in a line being typed, over the findings, over the drawing, or over the listing."""
        from app.painted.screens.proof_keys import pressed

        if self.editing is not None:
            return self._typed(self.editing, key, character)
        if (key in STEPS or key in ENDS) and not self.large:
            return Answer(self.walked(key))
        return pressed(self, key, character)

    def _typed(self, editing: Editing, key: str, character: str | None) -> Answer | None:
        if key in ("enter", "up", "down"):
            settled = self.accepted()
            page = settled.page
            if settled.messages or not isinstance(page, ProofPage):
                return settled
            return Answer(page.at_row(page.row + (-1 if key == "up" else 1)))
        typed = press(editing, editing.text, key, character)
        return None if typed is None else Answer(replace(self, editing=typed))

    def edited(self) -> Answer:
        """The line under the cursor being typed."""
        if self.looking:
            return self.refused()
        editing = Editing.of(self.listing.text(self.row), LONGEST)
        return Answer(replace(self, editing=editing, telling=False))

    def refused(self) -> Answer:
        """No change: the file is only looked at."""
        return Answer(self, (Say(f"{self.looking} S saves a copy under another name.", Tone.WARNING),))

    def accepted(self) -> Answer:
        """The typed line taken into the listing, or the reason why the file cannot hold it."""
        assert self.editing is not None
        text = self.editing.text
        if not self.listing.takes(text):
            said = Say(f"The file is written in {self.listing.encoding}, which cannot hold this line.", Tone.ERROR)
            return Answer(self, (said,))
        done = replace(self, editing=None)
        same = text == self.listing.text(self.row) and self.listing.lines
        return Answer(done if same else done.asking(listing=self.listing.changed(self.row, text)))

    def walked(self, key: str) -> ProofPage:
        """The cursor on another line, or on another finding and its line."""
        if self.telling:
            return self.at_finding(ENDS[key] if key in ENDS else self.at + STEPS[key])
        return self.at_row(ENDS[key] if key in ENDS else self.row + STEPS[key])

    def at_row(self, row: int) -> ProofPage:
        """The cursor on a line."""
        return replace(self, row=min(max(row, 0), max(len(self.listing) - 1, 0))).marked()

    def marked(self) -> ProofPage:
        """The mark on the gravest finding of the cursor's line, unless one of that line has it already."""
        from app.painted.screens.proof_rows import ORDER

        told = self.findings if self.fresh else ()
        here = [index for index, one in enumerate(told) if one.line == self.row + 1]
        if not here or self.at in here:
            return self
        return replace(self, at=min(here, key=lambda index: ORDER.index(told[index].severity)))

    @property
    def current(self) -> Finding | None:
        """The finding that has the mark, where the cursor is on it: in its line if it has one, or among the findings.

        None while the answer is to other lines, but for those who walk over the findings.
        """
        one = self.findings[self.at] if self.findings else None
        here = one is not None and self.fresh and one.line in (None, self.row + 1)
        return one if self.telling or here else None

    def at_finding(self, index: int) -> ProofPage:
        """The cursor on a finding, and in its line."""
        if not self.findings:
            return self
        at = min(max(index, 0), len(self.findings) - 1)
        line = self.findings[at].line
        page = replace(self, at=at)
        return page if line is None else page.at_row(line - 1)

    def left(self) -> tuple[Message, ...]:
        """Out of the page; changes that are not saved are asked about."""
        from app.painted.screens.proof_files import saving

        if self.alone or not self.unsaved:
            return (Leave() if self.alone else Close(),)
        lines = ("The NC file has changes that are not saved.",)
        options = (("s", "SAVE", (Close(), saving())), ("l", "LEAVE UNSAVED", (Close(), Close())))
        return (Open(Ask("NOT SAVED", lines, options, "" if self.file is None else self.file.name)),)

    def view(self, session: Session, surface: Surface) -> View:
        """The listing, the drawing, the findings."""
        from app.painted.screens.proof_rows import view

        return view(self, surface)

    @property
    def status(self) -> tuple[str, str]:
        """The program's unit, and what can be undone."""
        from app.painted.screens.proof_rows import status

        return status(self)

    def help(self, session: Session) -> tuple[str, ...]:
        """Every key of the page."""
        from app.painted.screens.proof_keys import HELP

        return HELP

    def about_file(self) -> str:
        """The NC program."""
        return "no name" if self.file is None else self.file.name
