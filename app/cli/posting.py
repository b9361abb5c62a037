"""From the session to NC text; imported when something is posted, because it needs the numeric library."""

from __future__ import annotations

from app.painted.session import Session
from core.output.nc import Posted, Refusal
from core.pipeline.derive import derive
from core.pipeline.derived import Derived
from core.pipeline.post import post_center_path, post_control_program


def nc_text(derived: Derived, name: str, override: str | None, control: str | None) -> Posted | Refusal:
    """The path of the tool's center, or the program of a control that compensates by itself, by its full name."""
    if control is not None:
        return post_control_program(derived, name=name, control=control)
    return post_center_path(derived, name=name, override=override)


def posted_anew(session: Session, name: str, override: str | None, control: str | None = None) -> Posted | Refusal:
    """The NC text or what forbids it.  Everything is derived anew, nothing stale is posted."""
    return nc_text(derive(session.program), name, override, control)
