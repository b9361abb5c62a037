"""This module decides where Enter stops on MILL CONTOUR: at fields that need an answer; arrows reach the rest."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from app.screens.contour_cells import fields_at, form_at, missing_fields, run_here, solution_here, value_at
from app.screens.field_texts import unusable
from app.session.session import Session
from core.program.fields import Field, Form
from core.program.model import Number, Unread
from core.program.solve.solved import Solved

PERMANENT_STOPS: Final[Mapping[Form, frozenset[str]]] = MappingProxyType(
    {
        Form.START: frozenset({"cutter_comp", "x_start", "y_start"}),
        Form.LINE: frozenset({"x_end", "y_end"}),
        Form.ARC: frozenset({"direction", "x_end", "y_end"}),
        Form.BLEND: frozenset({"radius"}),
        Form.CHAMFER: frozenset({"length"}),
    }
)
"""The fields at which Enter always stops."""
UNLESS_CALCULATED: Final = frozenset({"x_center", "y_center", "radius"})
"""The fields of an ARC at which Enter stops unless they are calculated."""


def next_stop(session: Session, name: str) -> str | None:
    """Return the next field after `name` at which Enter stops; None after the last one."""
    fields = fields_at(session)
    names = [field.name for field in fields]
    after = fields[names.index(name) + 1 :] if name in names else fields
    return next((field.name for field in after if stops(session, field)), None)


def unanswered(session: Session) -> str | None:
    """Return the first field that still needs an answer: it is blank and needed, or unusable; None if there is none."""
    return next((field.name for field in fields_at(session) if _needs_answer(session, field)), None)


def stops(session: Session, field: Field) -> bool:
    """Return whether Enter stops at a field."""
    form = form_at(session)
    if field.name in PERMANENT_STOPS[form] or _needs_answer(session, field):
        return True
    if form is Form.ARC and field.name in UNLESS_CALCULATED:
        return not isinstance(value_at(session, field.name), Solved)
    solution = solution_here(session)
    return field.name == "choice" and solution is not None and solution.taken is None


def run_stops(session: Session) -> bool:
    """Return whether the run at the cursor has no answer and later segments cannot give one."""
    run = run_here(session)
    if run is None or run.taken is not None or run.code == "PICK_SOLUTION":
        return False
    last = session.block.segments[run.last - 1]
    ends = (getattr(last, "x_end", None), getattr(last, "y_end", None))
    return run.code != "MISSING" or all(isinstance(end, Number) for end in ends)


def run_lacks(session: Session) -> bool:
    """Return whether more values would help the run at the cursor: too few, or not solvable from these yet."""
    run = run_here(session)
    return run is not None and run.code in ("MISSING", "NOT_YET")


def _needs_answer(session: Session, field: Field) -> bool:
    value = value_at(session, field.name)
    if isinstance(value, Unread) or unusable(value, field, session.program.unit) is not None:
        return True
    return value is None and field.name in missing_fields(session)
