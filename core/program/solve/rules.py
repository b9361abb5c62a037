"""Solving one segment by rules: which typed fields determine it, what they give, and whether the others agree.

A rule names the fields it needs; the first whose fields are typed and which yields anything is taken, in the
order of its table.  Fields typed beyond it must agree, and choose where the rule leaves two solutions.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from core.finding import Finding, Severity
from core.geometry.construct import OnePoint, TwoPoints
from core.geometry.piece import Line, Piece, Point
from core.program.fields import Form, field

Known = Mapping[str, float]
"""What is typed, by field name: millimeters, radians."""

ERROR = Severity.ERROR


@dataclass(frozen=True, slots=True)
class Beside:
    """The rule's fields say nothing about this segment: another rule may."""


Answer = tuple[Piece, ...] | Finding | Beside


@dataclass(frozen=True, slots=True)
class Rule:
    """The fields that determine a segment, and how."""

    needs: frozenset[str]
    solve: Callable[[Point, Known], Answer]


@dataclass(frozen=True, slots=True)
class Outcome:
    """A segment as far as its own fields give it: one piece, or several to pick from, or what is missing or wrong."""

    pieces: tuple[Piece, ...] = ()
    missing: tuple[str, ...] = ()
    finding: Finding | None = None


@dataclass(frozen=True, slots=True)
class Task:
    """One kind of segment: its rules, the fields that bear on its shape, and how a piece disagrees with a typed one."""

    form: Form
    shape: tuple[str, ...]
    rules: tuple[Rule, ...]
    disagrees: Callable[[Piece, str, float], Finding | None]
    advice: str
    """What to type when nothing is."""
    instead: Callable[[Point, Known], tuple[tuple[str, ...], str] | None] = lambda _start, _known: None
    """Fields and advice where what is typed says nothing about the segment."""

    def label(self, name: str) -> str:
        """A field's label on this form."""
        return field(self.form, name).label


def solve(task: Task, start: Point, known: Known) -> Outcome:
    """The pieces that fit everything typed."""
    beside = False
    for rule in task.rules:
        if not rule.needs <= known.keys():
            continue
        answer = rule.solve(start, known)
        if isinstance(answer, Beside):
            beside = True
            continue
        if isinstance(answer, Finding):
            return Outcome(finding=answer)
        return _agreeing(task, answer, [name for name in known if name not in rule.needs], known)
    return (_instead(task, start, known) if beside else None) or _undetermined(task, known, beside=beside)


def _agreeing(task: Task, pieces: tuple[Piece, ...], others: list[str], known: Known) -> Outcome:
    """Those of the pieces with which every other typed field agrees, or the first disagreement."""
    if not others:
        return Outcome(pieces)
    complaints = [_complaint(task, piece, others, known) for piece in pieces]
    fitting = tuple(piece for piece, complaint in zip(pieces, complaints, strict=True) if complaint is None)
    return Outcome(fitting) if fitting else Outcome(finding=complaints[0])


def _complaint(task: Task, piece: Piece, others: list[str], known: Known) -> Finding | None:
    for name in others:
        found = task.disagrees(piece, name, known[name])
        if found is not None:
            rest = " and ".join(task.label(other) for other in task.shape if other in known and other != name)
            return replace(found, field=name, text=f"{found.text} by {rest}: correct or blank one of them.")
    return None


def _instead(task: Task, start: Point, known: Known) -> Outcome | None:
    found = task.instead(start, known)
    if found is None:
        return None
    missing, advice = found
    return Outcome(
        missing=missing, finding=Finding("MISSING", ERROR, f"Not determined yet: {advice}", field=missing[0])
    )


def _undetermined(task: Task, known: Known, *, beside: bool) -> Outcome:
    blank = tuple(name for name in task.shape if name not in known)
    typed = frozenset(known)
    one_more = tuple(name for name in blank if any(rule.needs <= typed | {name} for rule in task.rules))
    missing = blank if beside or not one_more else one_more
    enough = one_more and not (beside and len(blank) > 2)
    advice = f"enter {_either([task.label(name) for name in missing])}" if enough else task.advice
    text = f"Not determined yet: {advice}."
    return Outcome(missing=missing, finding=Finding("MISSING", ERROR, text, field=next(iter(missing), None)))


def _either(labels: list[str]) -> str:
    return labels[0] if len(labels) == 1 else f"{', '.join(labels[:-1])} or {labels[-1]}"


def lines_to(start: Point, ends: OnePoint | TwoPoints) -> tuple[Piece, ...]:
    """The lines from `start` to each point."""
    points = (ends.point,) if isinstance(ends, OnePoint) else (ends.first, ends.second)
    return tuple(Line(start, point) for point in points)


def wrong(code: str, text: str, name: str, *lengths: float) -> Finding:
    """An error of one field."""
    return Finding(code, ERROR, text, field=name, lengths=lengths)
