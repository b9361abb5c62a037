"""LOOKAHEAD TABLE shows what every value from 1 to 20 does to the path, draws one, and lets it be taken."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, ClassVar

from textual import on
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Vertical
from textual.content import Content
from textual.widgets import DataTable, Static

from app.screens.block_actions import BlockActions
from app.session.formats import length, segment_numbers
from app.session.messages import Sentence
from app.session.session import Session
from app.widgets.drawing import Drawing
from app.widgets.plain import PlainText
from app.widgets.rows import RowTable
from app.widgets.softkeys import Softkey, Softkeys
from app.widgets.verdict import MARKS_OF_CHARACTERS, Marks
from core.program.edit import FormPlace, type_field
from core.program.model import Number

if TYPE_CHECKING:
    from core.advice.lookahead_table import Row, Table

COLUMNS = (("VALUE", 5), ("GOUGE", 12), ("UNCUT", 8), ("DELETES", 10), ("", 13))
WAITING = "The table is being calculated."
NO_TABLE = "There is no path to compare yet: type START and the first segments."


class LookaheadScreen(BlockActions):
    """The table, with a drawing of the path for the row with the cursor."""

    AUTO_FOCUS: ClassVar[str | None] = "#values"
    BINDINGS: ClassVar[list[BindingType]] = [Binding("escape", "app.back", "Back", show=False)]
    SOFTKEYS: ClassVar[tuple[Softkey | None, ...]] = (
        Softkey("TAKE AS USR", "take", "TAKE", lambda screen: screen.row is not None, NO_TABLE),
        None,
        Softkey("RECALCULATE LOOKAHEAD", "recalculate", "RECALC"),
        *(None,) * 3,
        Softkey("DRAW", "app.draw", "DRAW"),
        Softkey("BACK to START", "app.back", "BACK"),
    )

    def compose_body(self) -> ComposeResult:
        """Lay out the title, the table, and the drawing of the value with the cursor."""
        with Vertical(id="lookahead", classes="panel -bare"):
            yield PlainText(id="lookahead-title", classes="head")
            yield RowTable(COLUMNS, id="values")
        yield Drawing(id="value-path")

    def show_session(self, session: Session) -> None:
        """Show one row per value; the cursor starts on the recommended value, else on the one in force."""
        table, values = session.lookahead_table, self.query_one("#values", DataTable)
        block = session.derived_block
        title = f"BLOCK {block.number}  LOOKAHEAD TABLE   {block.lookahead.tag} {block.lookahead.value} in force"
        self.query_one("#lookahead-title", Static).update(title, layout=False)
        at = values.cursor_row if values.row_count else None
        values.clear()
        if table is None:
            self._draw(None)
            return
        marks = MARKS_OF_CHARACTERS[self.host.characters]
        for row in table.rows:
            values.add_row(*_cells(row, table, session, marks))
        if at is None:
            at = (table.recommended or block.lookahead.value) - 1
        values.move_cursor(row=at)
        self._draw(table.rows[at])

    @property
    def row(self) -> Row | None:
        """The row with the cursor; None without a table."""
        table = self.current_session.lookahead_table
        return None if table is None else table.rows[self.query_one("#values", DataTable).cursor_row]

    def refresh_frame(self) -> None:
        """Name the value with the cursor on its softkey."""
        if self.is_live and self.row is not None:
            softkeys = self.query_one(Softkeys)
            take, *others = softkeys.keys
            if take is not None:
                softkeys.keys = (replace(take, label=f"TAKE {self.row.value} AS USR"), *others)
        super().refresh_frame()

    @on(DataTable.RowHighlighted)
    def _highlighted(self) -> None:
        self._draw(self.row)
        self.refresh_frame()

    def _draw(self, row: Row | None) -> None:
        # imported here: the first paint must not load shapely and numpy
        from core.pipeline.plot import Subject

        drawing, session = self.query_one(Drawing), self.current_session
        if row is None:
            drawing.subject = None
            return
        drawing.heading = f"LOOK-AHEAD {row.value}"
        near = None if self.has_class("-tall") else _worst_point(row)
        drawing.subject = Subject(session.derived_block, session.program.unit, row=row, near=near)

    @on(DataTable.RowSelected)
    def action_take(self) -> None:
        """Set CUTCOMP LOOKAHEAD to the value with the cursor, as if it were typed."""
        row, session = self.row, self.current_session
        if row is None:
            self.say(WAITING if session.derived_block.paths is not None else NO_TABLE)
            return
        place = FormPlace(session.place.block, 0)
        edited = type_field(session.program, place, "lookahead", Number(float(row.value)))
        if self.host.apply(edited, f"CUTCOMP LOOKAHEAD {row.value}, block {place.block}"):
            self.host.move(place, "lookahead")
            self.app.call_later(self.app.run_action, "app.back")

    def prompt_text(self) -> Sentence:
        """Return what the keys do, or why there is no table."""
        if self.current_session.lookahead_table is None:
            return Sentence(WAITING if self.current_session.derived_block.paths is not None else NO_TABLE)
        return Sentence("Up and down show what a value does. Enter takes it as USR.")


def _cells(row: Row, table: Table, session: Session, marks: Marks) -> tuple[Content, ...]:
    unit, lookahead = session.program.unit, session.derived_block.lookahead
    gouge = Content.styled(f"{marks.good} none", "$c-good")
    if not row.clean:
        depth = length(row.gouge, unit) if row.gouge else "wrong side"
        gouge = Content.styled(f"{marks.gouge} {depth}", "bold $c-gouge")
    notes = ["best"] if row.value == table.recommended else []
    if row.value == lookahead.calculated and not (notes and row.value == lookahead.value):
        # the title says of the value in force that it is CAL
        notes.append("CAL")
    if row.value == lookahead.value:
        notes.append("in force")
    deleted = Content.styled(segment_numbers(row.deleted), "$c-deleted")
    left = length(row.uncut, unit) if row.verdict.uncut else "none"
    role = "$c-cal" if row.value == lookahead.calculated else ""
    return Content(f"{row.value:>5}"), gouge, Content(f"{left:>8}"), deleted, Content.styled(" ".join(notes), role)


def _worst_point(row: Row) -> tuple[float, float] | None:
    """Return the point of a value's deepest gouge, else of the thickest uncut stock; None if there is neither."""
    if row.verdict.gouges:
        return row.verdict.gouges[0].surface_at
    stretches = list(row.verdict.uncut)
    return max(stretches, key=lambda stretch: stretch.thickness).thickest if stretches else None
