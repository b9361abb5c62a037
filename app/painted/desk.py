"""The desk: the session with the screens that lie on it, and what a key makes of the two.

Everything between a key and the next picture is here and pure, but for the messages that touch files, which
`app.painted.filing` carries out.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import partial
from typing import Final, assert_never

from app.painted.messages import (
    Browse,
    Close,
    Do,
    Edit,
    Leave,
    Load,
    Message,
    Move,
    NextMode,
    Open,
    Post,
    Redo,
    Save,
    Say,
    Swap,
    Undo,
)
from app.painted.screens import doors
from app.painted.screens.contour import Contour
from app.painted.screens.page import Answer, Layout, Page, withheld
from app.painted.screens.program import ProgramPage
from app.painted.session import Session, Tone
from app.painted.settings import Settings
from app.terminal.split_keys import TOLD
from core.pipeline.derived import Derived
from core.program.edit import Refused

FUNCTION_KEYS: Final = {f"f{number}": number for number in range(1, 9)}
AT_ONCE: Final = {f"alt+{number}": number for number in range(1, 9)}
"""Esc and a digit in one packet: Alt and the digit, or both keys over a link that held the first one back."""
DIGITS: Final = frozenset("12345678")
ARMED: Final = "1 to 8 press the softkey now, for 2 seconds. Anything else goes on typing, Esc ends it."
WALKING: Final = frozenset({"enter", "tab", "shift+tab", "up", "down", "left", "right", "pageup", "pagedown"})
"""Keys that only take the cursor elsewhere while nothing is half typed."""
EVERYWHERE: Final = frozenset(
    {"ctrl+z", "ctrl+y", "ctrl+s", "ctrl+o", "ctrl+q", "ctrl+c", "ctrl+k", "ctrl+g", "ctrl+f"}
)
MODES: Final = ("braille", "block", "ascii")
"""The sets of characters of the drawing, as `core.draw.characters.Mode` names them."""
LONGEST_NAME: Final = 40
"""Characters of a name in a sentence that has to say more."""
ONE_MODE: Final = (
    "LANG or TERM says that there is no UTF-8, so the drawing is in ASCII. Where there is: cutcomp --characters braille"
)


@dataclass(frozen=True, eq=False, slots=True)
class Desk:
    """`pages` lie on each other, the last one is seen.  `armed`: Esc was pressed, a digit is a softkey until the
    next key, and until `disarmed` is asked for because it took too long.

    `modes` are the sets of characters the terminal can draw with, `mode` is the one in use.
    `settings` are what stays from one time to the next; `guided` while the guide sits on the prompt lines.
    `exit` is set when the program is to end.
    """

    session: Session
    pages: tuple[Page, ...] = (ProgramPage(), Contour())
    armed: bool = False
    mode: str = MODES[0]
    modes: tuple[str, ...] = MODES
    settings: Settings = field(default_factory=Settings)
    guided: bool = False
    exit: bool = False

    @property
    def page(self) -> Page:
        """The page that is seen."""
        return self.pages[-1]

    def press(self, key: str, character: str | None = None) -> Desk:
        """What a key makes of everything; pages that got covered are as they will be seen again."""
        desk = self._pressed(key, character)
        below = (page.covered() for page in desk.pages[:-1])
        return replace(desk, pages=(*below, desk.page)) if len(desk.pages) != len(self.pages) else desk

    def _pressed(self, key: str, character: str | None) -> Desk:
        said = self.session.said
        quiet = self.session if said is not None and said.stays and key in WALKING else self.session.quiet()
        armed, desk = self.armed, replace(self, session=quiet, armed=False)
        if key in TOLD:
            return desk.take(Say(TOLD[key], Tone.WARNING))
        if key in AT_ONCE:
            return desk._at_once(AT_ONCE[key])
        if armed and key in DIGITS and desk._labeled(int(key)):
            return desk._softkey(int(key))
        if key in FUNCTION_KEYS:
            return desk._softkey(FUNCTION_KEYS[key])
        if key == "escape":
            return desk if armed else desk._escape()
        if key in EVERYWHERE:
            own = desk.page.everywhere(key, desk.session)
            return desk._everywhere(key) if own is None else desk._answered(own)
        answer = desk.page.press(key, character, desk.session)
        if answer is None and character == "?":
            return desk._helped()
        return desk if answer is None else desk._answered(answer)

    def disarmed(self) -> Desk:
        """The desk after the time for a digit is over: digits are typed again, and nothing says otherwise."""
        if not self.armed:
            return self
        ours = self.session.said is not None and self.session.said.text == ARMED
        return replace(self, armed=False, session=self.session.quiet() if ours else self.session)

    def told(self, answer: object) -> Desk:
        """The desk with the answer to a page's question."""
        return replace(self, pages=tuple(page.hearing(answer) for page in self.pages))

    def knowing(self, derived: Derived) -> Desk:
        """The desk with what follows from its program."""
        return replace(self, session=self.session.knowing(derived))

    def paste(self, text: str) -> Desk:
        """Text pasted into the terminal: its first line as if typed, so that no line ending accepts anything."""
        own = self.page.pasted(text, self.session)
        if own is not None:
            return self._answered(own)
        desk = replace(self, armed=False)
        for character in (text.splitlines() or [""])[0][:200]:
            desk = desk.press("space" if character == " " else character, character)
        return desk

    def take(self, message: Message) -> Desk:
        """One message carried out."""
        desk = self._taken(message)
        if not (self.guided and desk.guided):
            return desk
        from app.painted import guide

        return guide.after(self, desk, message)

    def _taken(self, message: Message) -> Desk:
        match message:
            case Edit(outcome, label):
                return replace(self, session=self.session.apply(outcome, label))
            case Move(where, field):
                return replace(self, session=self.session.at(where, field))
            case Say(text, tone, stays):
                return replace(self, session=self.session.saying(text, tone, stays=stays))
            case Undo():
                return self._turned(self.session.undo())
            case Redo():
                return self._turned(self.session.redo())
            case Open() | Swap() | Close():
                return self._on(self._stacked(message))
            case NextMode():
                return self._next_mode()
            case Do() | Save() | Browse() | Load() | Post() | Leave():
                return self._touching_files(message)
            case _:
                assert_never(message)

    def _turned(self, session: Session) -> Desk:
        """After undo or redo, which may have moved the cursor: half-typed texts are gone, on all screens."""
        if session.history is self.session.history:
            return replace(self, session=session)
        return replace(self, session=session, pages=tuple(page.forgetting() for page in self.pages))

    def _touching_files(self, message: Do | Save | Browse | Load | Post | Leave) -> Desk:
        """What may touch files; a name or a disk that does not oblige becomes a sentence."""
        from app.documents.files import why
        from app.painted import filing

        try:
            return message.work(self) if isinstance(message, Do) else filing.carry_out(self, message)
        except OSError as error:
            name = str(error.filename or "That")
            name = name if len(name) <= LONGEST_NAME else f"{name[:LONGEST_NAME]}..."
            return self.take(Say(f"{name} cannot be used: {why(error)}", Tone.ERROR))

    def _stacked(self, message: Open | Swap | Close) -> tuple[Page, ...]:
        match message:
            case Open(page):
                return (*self.pages, page if isinstance(page, Page) else page())
            case Swap(page):
                return (*self.pages[:-1], page)
            case Close():
                return self.pages[:-1] if len(self.pages) > 1 else self.pages
            case _:
                assert_never(message)

    def _on(self, pages: tuple[Page, ...]) -> Desk:
        """The desk with these pages; a question that has come up tells by itself how it is answered."""
        asked = pages[-1].asks and len(pages) > len(self.pages)
        return replace(self, pages=pages, session=self.session.quiet() if asked else self.session)

    def _answered(self, answer: Answer) -> Desk:
        """The page as the key left it, then its messages in order, up to an edit that is refused."""
        desk = replace(self, pages=(*self.pages[:-1], answer.page))
        for message in answer.messages:
            desk = desk.take(message)
            if isinstance(message, Edit) and (isinstance(message.outcome, Refused) or desk.session.guard.looking):
                break
        return desk

    def _softkey(self, number: int) -> Desk:
        """A softkey: first the half-typed text is taken; where it is refused, the softkey waits."""
        settled = self.page.before(number).settle(self.session)
        desk = self._answered(settled)
        if any(isinstance(message, Say) for message in settled.messages):
            return desk
        softkeys = desk.page.softkeys(desk.session)
        if number not in softkeys:
            return desk
        return desk._answered(desk.page.softkeyed(desk.session, number, softkeys[number].messages))

    def _labeled(self, number: int) -> bool:
        """Whether a softkey can be seen: a digit without one is typed, never swallowed."""
        softkey = self.page.softkeys(self.session).get(number)
        return softkey is not None and bool(softkey.label)

    def _at_once(self, number: int) -> Desk:
        """Esc and a digit that came together; where there is no such softkey, what Esc takes back, then the digit."""
        if self._labeled(number):
            return self._softkey(number)
        back = self.page.escape(self.session)
        desk = self if back is None or back.messages else self._answered(back)
        return desk._pressed(str(number), str(number))

    def _escape(self) -> Desk:
        answer = self.page.escape(self.session)
        return self._arming() if answer is None else self._answered(answer)

    def _arming(self) -> Desk:
        return replace(self, armed=True).take(Say(ARMED))

    def _next_mode(self) -> Desk:
        if len(self.modes) == 1:
            return self.take(Say(ONE_MODE))
        mode = self.modes[(self.modes.index(self.mode) + 1) % len(self.modes)]
        return replace(self, mode=mode, settings=replace(self.settings, mode=mode)).take(
            Say(f"Drawn with {mode} characters.")
        )

    def _settled(self, message: Message) -> Desk:
        """A half-typed text taken before something that concerns the whole program."""
        settled = self.page.settle(self.session)
        desk = self._answered(settled)
        return desk if any(isinstance(one, Say) for one in settled.messages) else desk.take(message)

    def _everywhere(self, key: str) -> Desk:
        """The keys that mean the same on every page; help may lie on a question, or on what has its own undo."""
        if (told := withheld(self.pages, key, self.session)) is not None:
            return self.take(told)
        match key:
            case "ctrl+z":
                return self._undo()
            case "ctrl+y":
                return self.take(Redo())
            case "ctrl+s":
                return self._save()
            case "ctrl+o":
                return self._settled(Browse())
            case "ctrl+q":
                return self._settled(Leave())
            case "ctrl+k":
                return self._arming()
            case "ctrl+f":
                return self._findings()
            case "ctrl+g":
                return self._helped()
            case _:
                return self.take(Say("F8 goes back, Ctrl+Q leaves the program."))

    def _findings(self) -> Desk:
        """FINDINGS on top, where the screen is about a block."""
        if self.page.layout in (Layout.FORM, Layout.TABLE, Layout.DRAW):
            return self._settled(Open(partial(doors.findings, self.session, self.page.look())))
        return self.take(Say("Ctrl+F shows the findings of a block: from its form."))

    def _helped(self) -> Desk:
        file = next((name for page in reversed(self.pages) if (name := page.about_file())), "")
        return self.take(Open(doors.keys_and_help(self.page.help(self.session), file)))

    def _undo(self) -> Desk:
        """Undo; a half-typed text is what is taken back first."""
        answer = self.page.escape(self.session)
        if answer is None or answer.messages:
            return self.take(Undo())
        return self._answered(answer).take(Say("What was half typed is gone. Ctrl+Z again undoes a change."))

    def _save(self) -> Desk:
        if self.session.file is None:
            return self._settled(Open(doors.save_as(self.session)))
        return self._settled(Save())
