"""The status line: unit, free memory, how much can be undone, the clock."""

from __future__ import annotations

from app.painted.session import Session
from app.painted.widgets.rows import Look, Row, Span, padded


def status_row(session: Session, clock: str, free: int, width: int, own: tuple[str, str] | None = None) -> Row:
    """`Prog Units: IN   Free: n      undo n      clock`; `own` are another unit and another `undo n`."""
    done = session.history.undo_count
    unit = str(session.program.unit) if own is None else own[0]
    left = f" Prog Units: {unit}   Free: {free}"
    middle = f"undo {done}" if done else ""
    if session.history.redo_count:
        middle += f"  redo {session.history.redo_count}"
    middle = middle if own is None else own[1]
    right = f"{clock} "
    room = max(width - len(right), 0)
    start = max(len(left) + 3, width // 2 + 9)
    text = f"{left:<{start}}{middle}" if middle else left
    return (*padded((Span(text, Look.DIM),), room), Span(right[:width], Look.DIM))
