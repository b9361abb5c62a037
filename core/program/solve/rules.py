"""Rules: which typed fields determine a segment, what they give, and whether the others agree.

A rule names the fields it needs; the first whose fields are typed and which has an answer is taken, in the
order of its table.  Fields typed beyond it must agree, and choose where the rule leaves two solutions.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from core.finding import Finding, Severity
from core.geometry.piece import Piece, Point
from core.program.fields import Form, field_of

Known = Mapping[str, float]
"""What is typed, by field name: millimeters, radians."""


@dataclass(frozen=True, slots=True)
class Given:
    """What a segment is solved from: where it starts, and what is typed of it."""

    start: Point
    known: Known
    back: bool = False
    """X END and Y END, as far as they are typed, are typed as the start's."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """A segment as far as its fields give it: one piece, or several to pick from, or what is missing or wrong."""

    pieces: tuple[Piece, ...] = ()
    missing: tuple[str, ...] = ()
    finding: Finding | None = None


Solver = Callable[[Given], Outcome | None]
"""None where the fields say nothing about this segment: another rule may."""


@dataclass(frozen=True, slots=True)
class Rule:
    """The fields that determine a segment, and how."""

    needs: frozenset[str]
    solve: Solver


@dataclass(frozen=True, slots=True)
class Task:
    """One kind of segment: its rules, the fields that bear on its shape, and how a piece disagrees with a typed one."""

    form: Form
    shape: tuple[str, ...]
    rules: tuple[Rule, ...]
    disagreement: Callable[[Piece, str, float], Finding | None]
    advice: str
    """What to type when nothing is."""
    special: Callable[[Given], tuple[tuple[str, ...], str] | None] = lambda _given: None
    """Missing fields and advice where what is typed says nothing about the segment."""

    def label(self, name: str) -> str:
        """A field's label on this form."""
        return field_of(self.form, name).label


def solve(task: Task, given: Given) -> Outcome:
    """The pieces that fit everything typed."""
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
    """Those of the pieces with which every other typed field agrees, or the first disagreement."""
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
    """Says that the fields `missing` are needed, with the advice what to type."""
    field = missing[0] if missing else None
    return Outcome(missing=missing, finding=fault("MISSING", f"More data needed: {advice}", field))


def _undetermined(task: Task, known: Known, *, tried: bool) -> Outcome:
    """What to type of what is blank; a rule was `tried` in vain where its fields said nothing."""
    blank = tuple(name for name in task.shape if name not in known)
    one_more = tuple(name for name in blank if any(rule.needs <= {*known, name} for rule in task.rules))
    missing = blank if tried or not one_more else one_more
    enough = one_more and not (tried and len(blank) > 2)
    return more_needed(missing, f"type {either([task.label(name) for name in missing])}." if enough else task.advice)


def either(labels: list[str]) -> str:
    """The choice between these, in words."""
    return labels[0] if len(labels) == 1 else f"{', '.join(labels[:-1])} or {labels[-1]}"


def fault(code: str, text: str, field: str | None, *lengths: float) -> Finding:
    """An error of one field."""
    return Finding(code, Severity.ERROR, text, field=field, lengths=lengths)


def contradiction(text: str, field: str, *lengths: float) -> Outcome:
    """The error on `field` that what is typed cannot be; `{0}` ... of the text are `lengths` (mm)."""
    return Outcome(finding=fault("CONTRADICTION", text, field, *lengths))
