"""One function a screen that another one opens: the first screen does not wait for the others to be imported."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from app.screens.draw import DrawPage
    from app.screens.findings import FindingsPage
    from app.screens.help import HelpPage
    from app.screens.lookahead import LookaheadTable
    from app.screens.new_segment import NewSegment
    from app.screens.parameters import ParametersPage
    from app.screens.post import PostPage
    from app.screens.save import SaveAsPage
    from app.screens.setup import SetupPage
    from app.screens.sheet import SheetPage
    from app.screens.tools import ToolsPage
    from app.session import Session


def draw() -> DrawPage:
    """DRAW."""
    from app.screens.draw import DrawPage

    return DrawPage()


def findings(session: Session, look: int | None = None) -> FindingsPage:
    """FINDINGS, of a look-ahead value or of the one in force."""
    from app.at_value import AtValue
    from app.screens.findings import FindingsPage

    return FindingsPage(asked=AtValue.of(session, look))


def keys_and_help(about: tuple[str, ...], file: str = "") -> HelpPage:
    """KEYS AND HELP, beginning with these sentences; `file` as `Page.about_file` has it."""
    from app.screens.help import HelpPage

    return HelpPage(about=about, file=file)


def lookahead_table(value: int) -> LookaheadTable:
    """LOOKAHEAD TABLE with the cursor on a value."""
    from app.screens.lookahead import LookaheadTable

    return LookaheadTable(value)


def new_segment(number: int) -> NewSegment:
    """NEW SEGMENT of that number."""
    from app.screens.new_segment import NewSegment

    return NewSegment(number)


def parameters() -> ParametersPage:
    """PROGRAM PARAMETERS."""
    from app.screens.parameters import ParametersPage

    return ParametersPage()


def post(session: Session) -> PostPage:
    """POST NC."""
    from app.screens.post import PostPage

    return PostPage.of(session)


def save_as(session: Session) -> SaveAsPage:
    """SAVE AS; what leaves the program once it is saved says so to the page itself."""
    from app.screens.save import SaveAsPage

    return SaveAsPage.of(session)


def setup() -> SetupPage:
    """PART SETUP."""
    from app.screens.setup import SetupPage

    return SetupPage()


def sheet(session: Session) -> SheetPage:
    """SETUP SHEET."""
    from app.screens.sheet import SheetPage

    return SheetPage.of(session)


def tools() -> ToolsPage:
    """TOOL SETUP."""
    from app.screens.tools import ToolsPage

    return ToolsPage()
