"""The frame: the one Textual screen, painted from the desk as a whole."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from textual import events
from textual.app import ComposeResult
from textual.screen import Screen

from app.painted.desk import Desk
from app.painted.screens.page import Layout, Page, Surface, View
from app.painted.screens.plan import NATIVE, Plan, plan
from app.painted.session import Said, Session, Tone
from app.painted.surroundings import Surroundings
from app.painted.widgets.painted import Rows
from app.painted.widgets.prompt import needed, prompt_rows
from app.painted.widgets.rows import Look, Part, Row, composed, plain, text_of
from app.painted.widgets.softkeys import softkey_rows
from app.painted.widgets.status import status_row

if TYPE_CHECKING:
    from app.painted.application import CutcompApp
    from app.painted.engine import Known

SECOND: Final = 1
"""Where a header does not fit, its second line counts."""
WAITS: Final = Said("A question waits: make it larger to read and answer it.", Tone.WARNING)
PASSING: Final = frozenset({"escape", "ctrl+q"})
"""Keys that answer no question: back from it where it can be left, and out of the program."""


class Frame(Screen[None], inherit_bindings=False, inherit_css=False):
    """One widget over the whole terminal.  Nothing takes the focus: keys are the App's, the cursor the session's."""

    app: CutcompApp

    def compose(self) -> ComposeResult:
        """The widget with the first picture in it: one layout, one painting."""
        yield Rows(self.app.picture(self.app.size.width, self.app.size.height))

    def on_resize(self, event: events.Resize) -> None:
        """Another terminal size: everything in its new place."""
        self.app.refresh_screen(event.size.width, event.size.height)

    def show(self, rows: tuple[Row, ...]) -> None:
        """Put the picture on the terminal; what stays the same costs nothing."""
        self.query_one(Rows).show(rows)


def picture(desk: Desk, known: Known, around: Surroundings, width: int, height: int) -> tuple[Row, ...]:
    """The whole terminal as rows: a pure function of the desk, of what is derived, and of the size."""
    return composed(list(parts(desk, known, around, width, height).values()), width, height)


def unread(page: Page, session: Session, width: int, height: int) -> bool:
    """Whether the page asks something of which a smaller terminal than the usual one shows less than that one."""
    if not page.asks or (width >= NATIVE[0] and height >= NATIVE[1]):
        return False
    areas = plan(width, height, page.layout)
    body = areas.body
    most = plan(*NATIVE, page.layout).body.height
    rows = page.view(session, Surface(areas.header.width, body.height, None, body.width)).body[:most]
    return len(rows) > body.height or any(len(text_of(row).rstrip()) > body.width for row in rows)


def heard(desk: Desk, key: str, width: int, height: int) -> bool:
    """Whether a key, or pasted text as an empty one, may do anything on a terminal of this size."""
    return key in PASSING or not unread(desk.page, desk.session, width, height)


def parts(desk: Desk, known: Known, around: Surroundings, width: int, height: int) -> dict[str, Part]:
    """The parts of the picture by their names in the plan."""
    session = known.trial or desk.session
    layout = desk.page.layout
    waits = unread(desk.page, session, width, height)
    said = WAITS if waits else desk.session.said
    areas = plan(width, height, layout, 0 if said is None else needed(said, width))
    view = known.view(desk.page, session, _surface(areas, known if desk.page.tabled else None))
    drawn = areas.drawing
    softkeys = {} if waits else desk.page.softkeys(desk.session)
    status = next((page.status for page in reversed(desk.pages) if page.status is not None), None)
    return {
        "notice": Part(areas.notice, _notice(width, height)),
        "header": Part(areas.header, view.header, SECOND),
        "body": Part(areas.body, view.body, view.focus),
        "verdict": Part(areas.verdict, _verdict(session, known, view, layout, areas)),
        "drawing": Part(drawn, known.drawing(desk, view.sketch, drawn.width, drawn.height, view.drawn)),
        "softkeys": Part(areas.softkeys, softkey_rows(softkeys, areas.softkeys.height)),
        "prompt": Part(areas.prompt, _prompt_rows(said or _guide(desk) or view.prompt, areas)),
        "status": Part(areas.status, (status_row(desk.session, around.clock(), around.free(), width, status),)),
    }


def _surface(areas: Plan, known: Known | None) -> Surface:
    body, told, table = areas.body, areas.verdict, None if known is None else known.table
    return Surface(areas.header.width, body.height, table, body.width, told.height, told.width)


def _prompt_rows(said: Said, areas: Plan) -> tuple[Row, ...]:
    """What was said about the last key, else the guide, else the screen's own prompt."""
    return prompt_rows(said, areas.prompt.width, max(areas.prompt.height, 1))


def _guide(desk: Desk) -> Said | None:
    if not desk.guided:
        return None
    from app.painted import guide

    return guide.said(desk)


def _notice(width: int, height: int) -> tuple[Row, ...]:
    return (plain(f"{width}x{height}: make it {NATIVE[0]}x{NATIVE[1]}", Look.WARNING),)


def _verdict(session: Session, known: Known, view: View, layout: Layout, areas: Plan) -> tuple[Row, ...]:
    area = areas.verdict
    if area.height == 0:
        return ()
    if view.told is not None:
        return view.told[: area.height]
    # the strip of all look-ahead values stands on the form alone, but that nothing is known yet beside every drawing
    first = 0 if layout is Layout.FORM or not session.found.known else 1
    return known.verdict(session, view.sketch.lookahead, area.height, area.width, first)
