"""One function a screen that another one opens: the first screen does not wait for the others to be imported."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from app.painted.screens.draw import DrawPage
    from app.painted.screens.findings import FindingsPage
    from app.painted.screens.help import HelpPage
    from app.painted.screens.lookahead import LookaheadTable
    from app.painted.screens.new_segment import NewSegment
    from app.painted.screens.parameters import ParametersPage
    from app.painted.screens.post import PostPage
    from app.painted.screens.save import SaveAsPage
    from app.painted.screens.setup import SetupPage
    from app.painted.screens.sheet import SheetPage
    from app.painted.screens.tools import ToolsPage
    from app.painted.session import Session


def draw() -> DrawPage:
    """DRAW."""
    from app.painted.screens.draw import DrawPage

    return DrawPage()


def findings(session: Session, look: int | None = None) -> FindingsPage:
    """FINDINGS, of a look-ahead value or of the one in force."""
    from app.painted.at_value import AtValue
    from app.painted.screens.findings import FindingsPage

    return FindingsPage(asked=AtValue.of(session, look))


def keys_and_help(about: tuple[str, ...], file: str = "") -> HelpPage:
    """KEYS AND HELP, beginning with these sentences; `file` as `Page.about_file` has it."""
    from app.painted.screens.help import HelpPage

    return HelpPage(about=about, file=file)


def lookahead_table(value: int) -> LookaheadTable:
    """LOOKAHEAD TABLE with the cursor on a value."""
    from app.painted.screens.lookahead import LookaheadTable

    return LookaheadTable(value)


def new_segment(number: int) -> NewSegment:
    """NEW SEGMENT of that number."""
    from app.painted.screens.new_segment import NewSegment

    return NewSegment(number)


def parameters() -> ParametersPage:
    """PROGRAM PARAMETERS."""
    from app.painted.screens.parameters import ParametersPage

    return ParametersPage()


def post(session: Session) -> PostPage:
    """POST NC."""
    from app.painted.screens.post import PostPage

    return PostPage.of(session)


def save_as(session: Session) -> SaveAsPage:
    """SAVE AS; what leaves the program once it is saved says so to the page itself."""
    from app.painted.screens.save import SaveAsPage

    return SaveAsPage.of(session)


def setup() -> SetupPage:
    """PART SETUP."""
    from app.painted.screens.setup import SetupPage

    return SetupPage()


def sheet(session: Session) -> SheetPage:
    """SETUP SHEET."""
    from app.painted.screens.sheet import SheetPage

    return SheetPage.of(session)


def tools() -> ToolsPage:
    """TOOL SETUP."""
    from app.painted.screens.tools import ToolsPage

    return ToolsPage()
