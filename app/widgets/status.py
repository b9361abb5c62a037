"""The status line: unit, free memory, how much can be undone, the clock."""

from __future__ import annotations

from app.session import Session
from app.widgets.rows import Look, Row, Span, padded


def status_row(session: Session, clock: str, free: int, width: int) -> Row:
    """`Prog Units: IN   Free: n      undo n      clock`."""
    done = session.history.undo_count
    left = f" Prog Units: {session.program.unit}   Free: {free}"
    middle = f"undo {done}" if done else ""
    if session.history.redo_count:
        middle += f"  redo {session.history.redo_count}"
    right = f"{clock} "
    room = max(width - len(right), 0)
    start = max(len(left) + 3, width // 2 + 9)
    text = f"{left:<{start}}{middle}" if middle else left
    return (*padded((Span(text, Look.DIM),), room), Span(right[:width], Look.DIM))
