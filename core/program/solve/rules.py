"""This module applies rules: which typed fields determine a segment, what they give, and whether the others agree.

A rule names the fields it needs.  The first rule in the table whose fields are typed and which gives a result is used.
Other typed fields must agree with it, and choose if the rule leaves two solutions.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from core.finding import Finding, Severity
from core.geometry.piece import Piece, Point, Turn
from core.program.fields import Form, field_of

Known = Mapping[str, float]
"""The typed values by field name, in millimeters and radians."""


@dataclass(frozen=True, slots=True)
class Given:
    """The data from which a segment is solved: its start, its typed values, and the direction of an arc."""

    start: Point
    known: Known
    back: bool = False
    """True if each of X END and Y END that is typed is typed as the start's."""
    turn: Turn = Turn.NONE


@dataclass(frozen=True, slots=True)
class Outcome:
    """The result of a segment's fields: one piece, several to pick from, or what is missing or wrong."""

    pieces: tuple[Piece, ...] = ()
    missing: tuple[str, ...] = ()
    finding: Finding | None = None


Solver = Callable[[Given], Outcome | None]
"""Returns None if its fields do not determine this segment; another rule may."""


@dataclass(frozen=True, slots=True)
class Rule:
    """The fields that determine a segment, and how."""

    needs: frozenset[str]
    solve: Solver


@dataclass(frozen=True, slots=True)
class Task:
    """One kind of segment: its rules, its shape fields, and a check of a piece against one typed field."""

    form: Form
    shape: tuple[str, ...]
    rules: tuple[Rule, ...]
    disagreement: Callable[[Piece, str, float], Finding | None]
    advice: str
    """The advice if nothing more specific is known."""
    special: Callable[[Given], tuple[tuple[str, ...], str] | None] = lambda _given: None
    """Returns missing fields and advice for a special case in which no rule has given a result, else None."""

    def label(self, name: str) -> str:
        """Return a field's label on this form."""
        return field_of(self.form, name).label


def solve(task: Task, given: Given) -> Outcome:
    """Return the pieces that fit all typed values, or what is missing or wrong."""
    known, tried = given.known, False
    for rule in task.rules:
        if not rule.needs <= known.keys():
            continue
        outcome = rule.solve(given)
        if outcome is not None:
            others = [name for name in known if name not in rule.needs]
            return _agreeing(task, outcome, others, known) if outcome.pieces and others else outcome
        tried = True
    special = task.special(given) if tried else None
    return _undetermined(task, known, tried=tried) if special is None else more_needed(*special)


def _agreeing(task: Task, outcome: Outcome, others: list[str], known: Known) -> Outcome:
    """Keep the pieces that agree with every other typed field; if none does, return the first disagreement."""
    complaints = [_complaint(task, piece, others, known) for piece in outcome.pieces]
    fitting = tuple(piece for piece, complaint in zip(outcome.pieces, complaints, strict=True) if complaint is None)
    return Outcome(fitting) if fitting else Outcome(finding=complaints[0])


def _complaint(task: Task, piece: Piece, others: list[str], known: Known) -> Finding | None:
    for name in others:
        finding = task.disagreement(piece, name, known[name])
        if finding is not None:
            rest = " and ".join(task.label(other) for other in task.shape if other in known and other != name)
            return replace(finding, field=name, text=f"{finding.text} by {rest}: correct or blank one of them.")
    return None


def more_needed(missing: tuple[str, ...], advice: str) -> Outcome:
    """Return an outcome that the fields `missing` are needed, with advice on what to type."""
    field = missing[0] if missing else None
    return Outcome(missing=missing, finding=fault("MISSING", f"More data needed: {advice}", field))


def _undetermined(task: Task, known: Known, *, tried: bool) -> Outcome:
    """Advise which blank fields to type; `tried` if a rule had its fields but they did not determine the segment."""
    blank = tuple(name for name in task.shape if name not in known)
    one_more = tuple(name for name in blank if any(rule.needs <= {*known, name} for rule in task.rules))
    missing = blank if tried or not one_more else one_more
    enough = one_more and not (tried and len(blank) > 2)
    return more_needed(missing, f"type {either([task.label(name) for name in missing])}." if enough else task.advice)


def either(labels: list[str]) -> str:
    """Join labels with commas and `or`."""
    return labels[0] if len(labels) == 1 else f"{', '.join(labels[:-1])} or {labels[-1]}"


def fault(code: str, text: str, field: str | None, *lengths: float) -> Finding:
    """Return an error at one field."""
    return Finding(code, Severity.ERROR, text, field=field, lengths=lengths)


def contradiction(text: str, field: str, *lengths: float) -> Outcome:
    """Return the error at `field` that typed values contradict; `{0}` ... in the text are `lengths` (mm)."""
    return Outcome(finding=fault("CONTRADICTION", text, field, *lengths))
