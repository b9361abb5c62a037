"""The frame: the one Textual screen, its parts in their places, painted from the desk."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Final

from textual import events
from textual.app import ComposeResult
from textual.screen import Screen

from app.desk import Desk
from app.screens.page import Layout, Surface, View
from app.screens.plan import NATIVE, Area, Plan, plan
from app.session import Session
from app.surroundings import Surroundings
from app.widgets.prompt import prompt_rows
from app.widgets.rows import Look, Row, Rows, plain
from app.widgets.softkeys import softkey_rows
from app.widgets.status import status_row
from app.widgets.verdict import fitted, verdict_rows

if TYPE_CHECKING:
    from app.engine import Known
    from app.main import CutcompApp

PARTS: Final = tuple(part.name for part in fields(Plan))


@dataclass(frozen=True, eq=False, slots=True)
class Painted:
    """Everything on the terminal, part by part."""

    plan: Plan
    rows: dict[str, tuple[Row, ...]]
    focus: int


class Frame(Screen[None], inherit_bindings=False):
    """No widget of it takes the focus: every key goes to the App, and the cursor is the session's."""

    app: CutcompApp

    def compose(self) -> ComposeResult:
        """One widget for each part of the plan."""
        for part in PARTS:
            yield Rows(id=part)

    def on_key(self, event: events.Key) -> None:
        """Every key goes to the desk."""
        event.stop()
        event.prevent_default()
        self.app.key(event.key, event.character)

    def on_paste(self, event: events.Paste) -> None:
        """Pasted text is typed."""
        event.stop()
        self.app.paste(event.text)

    def on_resize(self, event: events.Resize) -> None:
        """Another terminal size: everything in its new place."""
        self.app.repaint(event.size.width, event.size.height)

    def show(self, painted: Painted) -> None:
        """Put everything on the terminal; parts that stay the same cost nothing."""
        for part in PARTS:
            widget = self.query_one(f"#{part}", Rows)
            _place(widget, getattr(painted.plan, part))
            widget.show(painted.rows.get(part, ()), _focus(painted, part))


def _focus(painted: Painted, part: str) -> int:
    """The row to keep in sight: the cursor's; of a header cut to one line, the second."""
    return {"body": painted.focus, "header": 1}.get(part, 0)


def _place(widget: Rows, area: Area) -> None:
    if widget.area == area:
        return
    widget.area = area
    shown = area.width > 0 and area.height > 0
    widget.display = shown
    if shown:
        widget.styles.offset = (area.x, area.y)
        widget.styles.width = area.width
        widget.styles.height = area.height


def painted(desk: Desk, known: Known, around: Surroundings, width: int, height: int) -> Painted:
    """The whole terminal as rows: a pure function of the desk, of what is derived, and of the size."""
    session = known.trial or desk.session
    layout = desk.page.view(session, Surface()).layout
    areas = plan(width, height, layout)
    surface = Surface(areas.body.width or areas.header.width, areas.body.height, known.table)
    view = desk.page.view(session, surface)
    said = session.said or view.prompt
    rows = {
        "notice": _notice(width, height),
        "header": view.header,
        "body": view.body,
        "verdict": _verdict(session, known, view, areas),
        "drawing": known.drawing(desk, view.sketch, areas.drawing.width, areas.drawing.height),
        "softkeys": softkey_rows(desk.page.softkeys(desk.session), areas.softkeys.height),
        "prompt": prompt_rows(said, areas.prompt.width),
        "status": (status_row(desk.session, around.clock(), around.free(), width),),
    }
    return Painted(areas, rows, view.focus)


def _notice(width: int, height: int) -> tuple[Row, ...]:
    return (plain(f"{width}x{height}: make it {NATIVE[0]}x{NATIVE[1]}"[:width], Look.WARNING),)


def _verdict(session: Session, known: Known, view: View, areas: Plan) -> tuple[Row, ...]:
    area = areas.verdict
    if area.height == 0:
        return ()
    unit = session.program.unit
    rows = verdict_rows(session.found, known.table, unit, area.width, look=view.sketch.lookahead)
    if view.layout is not Layout.FORM:
        rows = rows[1:]
    return fitted(rows, area.height - (area.height == 4), area.width)
