"""SegmentList lists the segments of a block, one per row, with what becomes of each."""

from __future__ import annotations

from typing import ClassVar, NamedTuple

from rich.text import Text
from textual.binding import Binding, BindingType
from textual.reactive import reactive

from app.session.block_findings import WAITING_CODES
from app.session.formats import length
from app.session.posting import deleted_numbers
from app.session.session import Session
from app.widgets.rows import RowTable
from app.widgets.verdict import MARKS_OF_CHARACTERS
from core.finding import Severity
from core.pipeline.derived import DerivedBlock
from core.program.fields import form_of
from core.program.model import BlendSegment, ChamferSegment, Number
from core.program.solve.solved import Solved, SolvedSegment
from core.units import Kind, Unit, show

COLUMNS = (
    ("number", "", 3),
    ("type", " TYPE", 8),
    ("x", "X END", 9),
    ("y", "Y END", 9),
    ("feed", "FEED", 6),
    ("outcome", "", 12),
)
"""Key, heading and width of each column."""
OUTCOME_COLORS = {
    "error": "$c-err",
    "missing": "$c-warn",
    "gouge": "$c-gouge",
    "uncut": "$c-uncut",
    "deleted": "$c-deleted",
}


class SegmentRow(NamedTuple):
    """The texts of a row's columns; `outcome` is error, missing (a value is), gouge, uncut, deleted or empty."""

    number: str
    type: str
    x: str
    y: str
    feed: str
    outcome: str


class SegmentList(RowTable[Text]):
    """The list; its cursor is on the segment of the form; Enter edits it, Del and Ins delete and insert."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("delete", "screen.softkey(1)", "Delete segment", show=False),
        Binding("insert", "screen.softkey(2)", "Insert segment before", show=False),
    ]

    characters: reactive[str] = reactive("braille", repaint=False)

    def __init__(self, *, id: str | None = None, classes: str | None = None) -> None:
        super().__init__(id=id, classes=classes, cell_padding=0)
        self.border_title = "SEGMENTS"
        self._rows: list[SegmentRow] = []

    def on_mount(self) -> None:
        """Add the columns."""
        for key, label, width in COLUMNS:
            self.add_column(Text(label, justify="left" if key == "type" else "right"), width=width, key=key)

    def watch_characters(self) -> None:
        """Let the next `show` rebuild all rows, with other signs."""
        self._rows = []

    def show(self, session: Session) -> None:
        """Show the segments of the block with the cursor; update only rows that differ."""
        rows, before = segment_rows(session.derived_block, session.program.unit), self._rows
        cursor_row = self.cursor_row
        if len(rows) != len(before):
            self.clear()
            for row in rows:
                self.add_row(*(self._cell(row, key) for key, _, _ in COLUMNS), key=row.number)
        else:
            for old, row in zip(before, rows, strict=True):
                for key, _, _ in COLUMNS if row != old else ():
                    self.update_cell(row.number, key, self._cell(row, key))
        self._rows = rows
        self.follow(session.place.segment, cursor_row)

    def _cell(self, row: SegmentRow, key: str) -> Text:
        text = str(getattr(row, key))
        if key == "outcome":
            return self._outcome_cell(text)
        if key == "type":
            return Text.assemble(" ", (text, "strike dim" if row.outcome == "deleted" else ""))
        return Text(text, justify="right")

    def _outcome_cell(self, outcome: str) -> Text:
        marks = MARKS_OF_CHARACTERS[self.characters]
        signs = {"gouge": marks.gouge, "uncut": marks.warning, "deleted": marks.deleted}
        sign = (signs | {"error": marks.gouge, "missing": "?"}).get(outcome, "")
        color = self.app.theme_variables.get(OUTCOME_COLORS.get(outcome, "")[1:], "")
        return Text(f"  {sign} {outcome}".rstrip(), color.removeprefix("ansi_"))


def segment_rows(block: DerivedBlock, unit: Unit) -> list[SegmentRow]:
    """Return the rows of START and the segments."""
    start = block.solved.values
    outcomes = _outcomes(block)
    for solved in block.solved.segments:
        errors = {finding.code for finding in solved.findings if finding.severity is Severity.ERROR}
        if errors - WAITING_CODES - {"PICK_SOLUTION"}:
            outcomes[solved.number] = "error"
        elif solved.missing:
            outcomes[solved.number] = "missing"
    first = SegmentRow("0", "START", _text(start.get("x_start"), unit), _text(start.get("y_start"), unit), "", "")
    return [first, *(_row(block, segment, unit, outcomes.get(segment.number, "")) for segment in block.solved.segments)]


def _row(block: DerivedBlock, solved: SolvedSegment, unit: Unit, outcome: str) -> SegmentRow:
    segment = block.block.segments[solved.number - 1]
    feed = segment.feed.value if isinstance(segment.feed, Number) else None
    match segment:
        case BlendSegment(radius=size):
            kind, x, y = "BLEND", f"r {_text(size, unit)}", ""
        case ChamferSegment(length=size):
            kind, x, y = "CHAMFER", f"c {_text(size, unit)}", ""
        case _:
            kind = f"{form_of(segment)} {getattr(segment, 'direction', '')}".rstrip()
            end = None if solved.piece is None else solved.end or solved.piece.end
            x, y = ("", "") if end is None else (length(each, unit) for each in end)
    return SegmentRow(
        str(solved.number),
        kind,
        x,
        y,
        "" if feed is None else show(feed, Kind.FEED, unit),
        outcome,
    )


def _text(value: object, unit: Unit) -> str:
    return show(value.value, Kind.LENGTH, unit) if isinstance(value, Number | Solved) else ""


def _outcomes(block: DerivedBlock) -> dict[int, str]:
    """Return what becomes of each segment that is not simply cut; only the worst of several."""
    paths = block.paths
    if paths is None or paths.verdict is None:
        return {}
    outcomes: dict[int, str] = {}
    for stretch in paths.verdict.uncut:
        for number in _between(stretch.first_number, stretch.last_number, len(block.solved.segments)):
            outcomes[number] = "uncut"
    outcomes |= dict.fromkeys(deleted_numbers(block), "deleted")
    return outcomes | {int(gouge.surface_number): "gouge" for gouge in paths.verdict.gouges}


def _between(first: float, last: float, count: int) -> list[int]:
    """Return the segment numbers of a stretch, which may wrap around past START."""
    low, high = int(first), int(last)
    return list(range(low, high + 1)) if low <= high else [*range(low, count + 1), *range(1, high + 1)]
