"""From the session to NC text; imported when something is posted, because it needs the numeric library."""

from __future__ import annotations

from app.session import Session
from core.finding import Finding
from core.output.post import Posted, post
from core.pipeline.derive import derive
from core.pipeline.jobs import jobs


def refusal_or_text(session: Session, name: str, override: str | None) -> tuple[Finding | None, str]:
    """The first finding that forbids posting, or the NC text; everything is derived anew, nothing stale is posted."""
    program = session.program
    result = post(jobs(derive(program)), program.unit, name=name, override=override)
    return (None, result.text) if isinstance(result, Posted) else (result.findings[0], "")
