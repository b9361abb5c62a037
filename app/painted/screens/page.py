"""Page: what stands on the terminal as a pure function of the session, and what a key on it asks for."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING, ClassVar, Final, NamedTuple, Protocol

from app.painted.messages import Message, Say
from app.painted.session import Said, Session, Tone
from app.painted.widgets.rows import Row

if TYPE_CHECKING:
    from core.advice.lookahead_table import Table
    from core.draw.scene import Scene
    from core.program.model import Program


class Layout(StrEnum):
    """How a page shares the terminal: fields over a drawing, a table over it, text alone, the drawing alone, a listing
    beside a drawing over a list of findings."""

    FORM = "form"
    TABLE = "table"
    TEXT = "text"
    DRAW = "draw"
    PROOF = "proof"


class Surface(NamedTuple):
    """What a page may know of the terminal, in cells, and of what takes long to calculate."""

    width: int = 59
    body: int = 9
    table: Table | None = None
    """The look-ahead table of the block with the cursor, None while it is not known."""
    across: int = 59
    """Width of the body, which may be less than that of the page."""
    told: int = 4
    """Rows for the verdict."""
    below: int = 59
    """Width of the verdict."""


class Softkey(NamedTuple):
    """One of F1 to F8: its label, and what it asks for."""

    label: str
    messages: tuple[Message, ...] = ()


Softkeys = Mapping[int, Softkey]


@dataclass(frozen=True, slots=True)
class Sketch:
    """What the drawing shows instead of the whole block: a look-ahead value's path, a window.

    `zoom` enlarges what fits the room: by `middle` about the middle of the window, by the rest about the cutter or
    what else is marked.  `dx` and `dy` move the window by parts of its width and height.
    """

    lookahead: int | None = None
    zoom: float = 1.0
    middle: float = 1.0
    dx: float = 0.0
    dy: float = 0.0


WHOLE: Final = Sketch()
"""The block itself, as large as it fits."""


class Drawn(NamedTuple):
    """A drawing of a page's own: `scene` makes it, anew only where `about` is other things than before."""

    about: tuple[object, ...]
    scene: Callable[[], Scene]


class View(NamedTuple):
    """A page as it stands: rows for each part of the terminal.

    A page that is not about the session's block has its own rows for the verdict in `told`, and its own drawing.
    """

    header: tuple[Row, ...]
    body: tuple[Row, ...]
    prompt: Said
    focus: int = 0
    sketch: Sketch = WHOLE
    told: tuple[Row, ...] | None = None
    drawn: Drawn | None = None


class Answer(NamedTuple):
    """What a key does: the page as it is then, and what it asks of the App."""

    page: Page
    messages: tuple[Message, ...] = ()


class Question(Protocol):
    """Something to be calculated; `small` says that it may be fast."""

    @property
    def small(self) -> bool:
        """Whether it may be done before the next picture."""
        ...

    def answer(self) -> object:
        """The calculation itself."""
        ...


class Page:
    """A screen: frozen, its own state is no more than a half-typed text, a cursor, a window."""

    layout: ClassVar[Layout] = Layout.FORM
    asks: ClassVar[bool] = False
    """A question: nothing is saved, opened or changed from elsewhere before it is answered."""
    tabled: ClassVar[bool] = False
    """It shows the look-ahead table; the others are not made again when that comes, behind the path."""

    @property
    def opening(self) -> object | None:
        """What tells one opening of a text file from another, for a page whose text is kept in a journal of its own."""
        return None

    @property
    def status(self) -> tuple[str, str] | None:
        """Words for the status line that stand for pages on top too: the unit, and what can be undone."""
        return None

    def view(self, session: Session, surface: Surface) -> View:
        """What stands on the terminal."""
        raise NotImplementedError

    def softkeys(self, session: Session) -> Softkeys:
        """The softkeys as they are now."""
        raise NotImplementedError

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """What a key does; None for a key that means nothing here."""
        raise NotImplementedError

    def before(self, number: int) -> Page:
        """The page as a softkey finds it; most take what is half typed first."""
        return self

    def settle(self, session: Session) -> Answer:
        """What accepts a half-typed text before a softkey acts."""
        return Answer(self)

    def softkeyed(self, session: Session, number: int, messages: tuple[Message, ...]) -> Answer:
        """What pressing a softkey with these messages does; most pages stay as they are."""
        return Answer(self, messages)

    def escape(self, session: Session) -> Answer | None:
        """What Esc takes back; None when there is nothing to take back."""
        return None

    @property
    def question(self) -> Question | None:
        """What has to be calculated for this page and is not known yet."""
        return None

    def hearing(self, answer: object) -> Page:
        """The page with an answer; one to a question of other pages changes nothing."""
        return self

    def pasted(self, text: str, session: Session) -> Answer | None:
        """What pasted text does where it is not typed; None where it is."""
        return None

    @property
    def unsaved(self) -> bool:
        """The page holds work of its own that no file has."""
        return False

    def everywhere(self, key: str, session: Session) -> Answer | None:
        """What undo, redo and save mean here where they are not the program's; None where they are."""
        return None

    def look(self) -> int | None:
        """The look-ahead value that the screen is about, None where it is the one in force."""
        return None

    def covered(self) -> Page:
        """The page once another one lies on it: what it is when it is seen again."""
        return self

    def forgetting(self) -> Page:
        """The page without a half-typed text: its field may be another one now."""
        return self

    def preview(self, session: Session) -> Program | None:
        """The program as it would be if the half-typed text were accepted; None when there is none to accept."""
        return None

    def help(self, session: Session) -> tuple[str, ...]:
        """Sentences about what has the cursor."""
        return ()

    def about_file(self) -> str:
        """The name of the file that the page is about, where that is not the session's program."""
        return ""


UNANSWERED: Final = "Answer the question first."
COVERED: Final = "Esc goes back first: what this changes is not seen here."
WRITING: Final = frozenset({"ctrl+s", "ctrl+o", "ctrl+z", "ctrl+y"})
"""Keys that change the program or a file."""


def withheld(pages: tuple[Page, ...], key: str, session: Session) -> Say | None:
    """What is said in place of a key that changes something, on a screen that lies on a question, or on one where the
    key means something else than the program."""
    if key not in WRITING:
        return None
    if any(page.asks for page in pages):
        return Say(UNANSWERED, Tone.ERROR)
    return Say(COVERED) if any(page.everywhere(key, session) for page in pages[:-1]) else None


def unseen(page: Page, key: str) -> Answer | None:
    """Undo and redo in a dialog, which hides what they would change: only told."""
    if key not in ("ctrl+z", "ctrl+y"):
        return None
    return Answer(page, (Say("Esc leaves this question first, then Ctrl+Z and Ctrl+Y act on the program."),))
