"""Where Enter stops on the MILL CONTOUR form: at fields that need an answer; others are reached by the arrows."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from app.screens.contour_cells import fields_at, form_at, missing_fields, run_here, solution_here, value_at
from app.screens.values import unusable
from app.session.session import Session
from core.program.fields import Field, Form
from core.program.model import Number, Unread
from core.program.solve.solved import Solved

ALWAYS: Final[Mapping[Form, frozenset[str]]] = MappingProxyType(
    {
        Form.START: frozenset({"cutter_comp", "x_start", "y_start"}),
        Form.LINE: frozenset({"x_end", "y_end"}),
        Form.ARC: frozenset({"direction", "x_end", "y_end"}),
        Form.BLEND: frozenset({"radius"}),
        Form.CHAMFER: frozenset({"length"}),
    }
)
"""The fields where Enter stops whatever they hold."""
UNLESS_CALCULATED: Final = frozenset({"x_center", "y_center", "radius"})
"""The fields of an ARC where Enter stops unless they follow from what was typed."""


def next_stop(session: Session, name: str) -> str | None:
    """The field after `name` where Enter stops; None after the last one."""
    fields = fields_at(session)
    names = [field.name for field in fields]
    after = fields[names.index(name) + 1 :] if name in names else fields
    return next((field.name for field in after if stops(session, field)), None)


def unanswered(session: Session) -> str | None:
    """The first field without which the form cannot be left behind: it is blank and needed, or cannot be read."""
    return next((field.name for field in fields_at(session) if _needs_answer(session, field)), None)


def stops(session: Session, field: Field) -> bool:
    """Whether Enter stops at a field."""
    form = form_at(session)
    if field.name in ALWAYS[form] or _needs_answer(session, field):
        return True
    if form is Form.ARC and field.name in UNLESS_CALCULATED:
        return not isinstance(value_at(session, field.name), Solved)
    solution = solution_here(session)
    return field.name == "choice" and solution is not None and solution.taken is None


def run_stops(session: Session) -> bool:
    """Whether the run of the segment has no answer that the segments after it could still give."""
    run = run_here(session)
    if run is None or run.taken is not None or run.code == "PICK_SOLUTION":
        return False
    last = session.block.segments[run.last - 1]
    ends = (getattr(last, "x_end", None), getattr(last, "y_end", None))
    return run.code != "MISSING" or all(isinstance(end, Number) for end in ends)


def run_lacks(session: Session) -> bool:
    """Whether more data would help the run of the segment: there are too few, or they are not calculated yet."""
    run = run_here(session)
    return run is not None and run.code in ("MISSING", "NOT_YET")


def _needs_answer(session: Session, field: Field) -> bool:
    value = value_at(session, field.name)
    if isinstance(value, Unread) or unusable(value, field, session.program.unit) is not None:
        return True
    return value is None and field.name in missing_fields(session)
