"""The verdict: what the cutter does, in words and numbers, at the same place on every screen.

The strip on its first line tells every look-ahead value's fate; below it stand the findings, the gravest first.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import islice
from math import isfinite
from textwrap import wrap
from typing import TYPE_CHECKING, Final, NamedTuple

from app.painted.widgets.rows import Look, Row, Span, padded, plain, text_of
from app.painted.widgets.strip import STRIP, strip
from app.painted.widgets.words import length, number, numbers, pair, place, segment
from core.finding import Finding, Severity
from core.pipeline.derived import DerivedBlock
from core.units import Unit, sentence

if TYPE_CHECKING:
    from core.advice.lookahead_table import Table
    from core.comp.compensated import Compensated, Deletions
    from core.verify.verdict import Verdict


NOT_YET: Final = frozenset({"MISSING", "NO_SEGMENTS"})
"""Errors that only say that a block is still to be typed."""
IN_FORCE: Final = frozenset({"NO_BEST", "BEST_DIFFERS"})
"""Notes that compare the path in force with the best one."""
MARKS: Final = {Severity.ERROR: "!!", Severity.WARNING: "! ", Severity.INFO: "i "}
"""What each weight of a finding begins with."""
ASKS: Final = "? "
"""The same where only something is still to be typed, which is no mistake."""
READ_ON: Final = "Ctrl+F"
"""The key that shows every finding in full, behind how many more there are and behind one that is cut."""
UNKNOWN: Final = plain(" The verdict is being calculated.", Look.WARNING)
"""Where no finding stands and none may be missed."""


TO_START: Final = "Type START, then right arrow for the first segment."
TO_FIRST: Final = "START is complete: on SEGMENT, right arrow to segment 1."
"""What to do in a block without segments."""
BACK_TO_START: Final = "START is not complete yet: left arrow goes back to it."
CHOOSE: Final = "START is complete: choose what segment 1 is."
"""The same where the first segment is being chosen."""


@dataclass(frozen=True, eq=False, slots=True)
class Case:
    """The path the verdict is about: the block's own, or that of a look-ahead value of the table.

    `compensated` is None for the best path, which deletes nothing.
    """

    compensated: Compensated | None
    verdict: Verdict


Meeting = tuple[float, float, float, float]
"""The numbers of two pieces, and where they meet."""


class Erased(NamedTuple):
    """Segments that a pair of pieces has erased."""

    pair: Meeting
    segments: list[float]


Line = Row | Finding | Erased
"""A line of the verdict, in words or still to be put into words."""


def verdict_rows(
    found: DerivedBlock, table: Table | None, unit: Unit, look: int | None, most: int | None = None
) -> list[Row]:
    """All lines of the verdict; `look` is a look-ahead value to judge instead of the one in force.

    The lines behind the first `most`, which nobody reads, are empty: a hundred sentences take longer than a picture.
    """
    lines = _lines(found, table, unit, look, most)
    read = lines if most is None else lines[:most]
    return [*(_worded(one, unit) for one in read), *[()] * (len(lines) - len(read))]


def _worded(line: Line, unit: Unit) -> Row:
    """A line in words."""
    if isinstance(line, Finding):
        return _sentence(line, unit)
    return _erasing(line, unit) if isinstance(line, Erased) else line


def _lines(found: DerivedBlock, table: Table | None, unit: Unit, look: int | None, most: int | None) -> list[Line]:
    """The lines in their order, most still to be put into words; of the erased only the first `most` can be read."""
    case = _case(found, table, look)
    first = strip(found, table, unit)
    if hint := _beginning(found):
        return [first, plain(f" {hint}", Look.LABEL)]
    if look is not None and case is not None:
        return [first, *_case_lines(case, unit, most), *needed(table)]
    findings = _untold(found.findings, case)
    errors = [one for one in findings if one.severity is Severity.ERROR]
    rest = [one for one in findings if one.severity is not Severity.ERROR]
    lines = [] if case is None else _case_lines(case, unit, most)
    notes = () if table is None else table.notes
    gravest = 1 if case is not None and case.verdict.gouges else 0
    cause = _misplaced(findings) if gravest else []
    # what the errors behind the deepest gouge may come of
    ends = [one for one in rest if one.code == "NEARLY_CLOSED"] if gravest else []
    if cause or ends:
        rest = [one for one in rest if one not in cause and one not in ends]
    told = [replace(one, segment=None) for one in cause]
    return [first, *told, *lines[:gravest], *ends, *errors, *lines[gravest:], *notes, *rest]


def _misplaced(findings: list[Finding]) -> list[Finding]:
    """That START is away from the contour's end, where by that the contour crosses itself and turns its sides round.

    A contour that only over-runs its start crosses itself too, and its gouges have other causes.
    """
    away = [one for one in findings if one.code == "OPEN"]
    return away if away and {"CROSSES_ITSELF", "WRONG_SIDE"} <= {one.code for one in findings} else []


def needed(table: Table | None) -> list[Finding]:
    """Of the table's notes those on the contour, which hold beside every value: why CAL's is not clean, what helps."""
    return [] if table is None else [note for note in table.notes if note.code not in IN_FORCE]


def _beginning(found: DerivedBlock) -> str:
    """What to do in a block without segments; a text that cannot be read is an error even there."""
    if found.block.segments or any(one.code not in NOT_YET for one in found.errors):
        return ""
    if any(one.code == "MISSING" for one in found.errors):
        return TO_START
    return TO_FIRST


def before_first(found: DerivedBlock, unit: Unit) -> tuple[Row, ...] | None:
    """What stands there while the first segment is chosen; None where the verdict has something to say."""
    hint = _beginning(found)
    if not hint:
        return None
    hint = BACK_TO_START if hint == TO_START else CHOOSE
    return strip(found, None, unit), plain(f" {hint}", Look.LABEL)


def deepest_gouge(found: DerivedBlock, unit: Unit) -> list[Row]:
    """The deepest gouge's finding in full, which the verdict's own line tells in short."""
    told = _untold(found.findings, _case(found, None, None))
    return [_sentence(one, unit) for one in found.findings if one not in told]


def nearest_place(found: DerivedBlock, unit: Unit) -> list[Row]:
    """The least distance in full, with its place; nothing before the block is worked out."""
    if not found.known or found.paths is None:
        return []
    from core.advice.path_findings import nearest_finding

    one = nearest_finding(found.paths, found.radius)
    if one is None:
        return []
    look = Look.ERROR if found.paths.verdict is not None and found.paths.verdict.gouges else Look.TYPED
    return [(Span(" NEAREST ", Look.LABEL), Span(sentence(one, unit), look))]


def _untold(findings: tuple[Finding, ...], case: Case | None) -> list[Finding]:
    """The findings but for the deepest gouge, which the verdict's own line tells."""
    deepest = next((one for one in findings if one.code == "GOUGE"), None) if case is not None else None
    return [one for one in findings if one is not deepest]


def fitted(rows: list[Row], height: int, width: int) -> tuple[Row, ...]:
    """The rows wrapped to the width as far as they fit, the last line saying how many more there are.

    No more than the first `height` rows are looked at, one where there is no height.
    """
    lines: list[Row] = []
    for told, row in enumerate(rows, 1):
        block = _wrapped(row, width)
        room, left = height - len(lines), len(rows) - told
        if len(block) > room or (left and len(block) == room):
            return (*lines, *_last(block, room, width, left))
        lines += block
    return tuple(lines)


def _last(block: tuple[Row, ...], room: int, width: int, left: int) -> list[Row]:
    """What fits of a row's lines, and behind them how many rows are left."""
    if room <= 0:
        return []
    *whole, last = block[:room]
    more = f" +{left} more: {READ_ON}" if left else ""
    if len(block) > room:
        last = (*last, Span(" …", last[-1].look))
        more = more or f" {READ_ON}"
    space = width - len(more) - bool(more)
    return [*whole, (*padded(_cut(_paired(last, space), space), space), Span(more, Look.LABEL))]


@lru_cache(256)
def _wrapped(row: Row, width: int) -> tuple[Row, ...]:
    """A row's lines; most rows of a verdict were in the one before."""
    text = text_of(row)
    if len(text) < width:
        return (row,)
    return tuple(plain(f" {line}", row[-1].look) for line in wrap(text, max(width - 2, 8), subsequent_indent="    "))


def _paired(row: Row, width: int) -> Row:
    """The row without the last of several labels and their values where these do not fit."""
    while len(row) > 2 and len(text_of(row)) >= width:
        row = row[:-2]
    return row


def _cut(row: Row, width: int) -> Row:
    if len(text_of(row)) < width:
        return row
    kept = padded(row, width - 2)
    return (*kept, Span("…", row[-1].look))


def _case(found: DerivedBlock, table: Table | None, look: int | None) -> Case | None:
    if look is not None:
        return None if table is None else Case(table.row(look).compensated, table.row(look).verdict)
    work = found.paths
    if work is None or work.compensated is None or work.verdict is None:
        return None
    return Case(work.compensated if work.best is None else None, work.verdict)


def _sentence(finding: Finding, unit: Unit) -> Row:
    asks = finding.code in NOT_YET
    look = Look.ERROR if finding.severity is Severity.ERROR and not asks else Look.WARNING
    mark = ASKS if asks else MARKS[finding.severity]
    where = "" if not finding.segment else f"{segment(finding.segment)}: "
    return plain(f" {mark} {where}{sentence(finding, unit)}", look)


def _case_lines(case: Case, unit: Unit, most: int | None) -> list[Row | Erased]:
    """The deepest gouge, what is deleted, what stays uncut.

    Where several pairs delete, all but the first stand last: there may be more of them than the screen has lines.
    """
    verdict = case.verdict
    gouge = [_gouge(verdict, unit)] if verdict.gouges else []
    groups = {} if case.compensated is None else _erased(case.compensated.deleted)
    erased: list[Row | Erased] = [Erased(*group) for group in islice(groups.items(), most)]
    erased += [()] * (len(groups) - len(erased))
    return [*gouge, *erased[:1], _uncut(verdict, unit), *erased[1:]]


def _uncut(verdict: Verdict, unit: Unit) -> Row:
    """What stays uncut, whether it gouges, and the least distance."""
    uncut = f"{length(verdict.uncut_length, unit)} of {length(verdict.surface_length, unit)}"
    row: Row = (Span(" UNCUT   ", Look.LABEL), Span(uncut, Look.WARNING if verdict.uncut else Look.TYPED))
    if not verdict.gouges:
        word = "none" if verdict.clean else "wrong side" if verdict.judged else "not judged"
        row = (*row, Span("  GOUGE ", Look.LABEL), Span(word, Look.GOOD if verdict.clean else Look.ERROR))
    return (*row, *_nearest(verdict, unit, STRIP - len(text_of(row))))


def _nearest(verdict: Verdict, unit: Unit, room: int) -> Row:
    """The least distance from the path to the surface, where there is room for it."""
    if not isfinite(verdict.clearance):
        return ()
    text = length(verdict.clearance, unit)
    label = "  NEAREST "
    look = Look.ERROR if verdict.gouges else Look.TYPED
    return (Span(label, Look.LABEL), Span(text, look)) if len(label) + len(text) < room else ()


def _gouge(verdict: Verdict, unit: Unit) -> Row:
    deepest = verdict.gouges[0]
    more = f", {len(verdict.gouges) - 1} more" if len(verdict.gouges) > 1 else ""
    where = f"{place(deepest.surface_at, unit)} on segment {number(deepest.surface_number)}{more}"
    return plain(f" GOUGE   {length(deepest.depth, unit)} at {where}", Look.ERROR)


@lru_cache(4)
def _erased(deleted: Deletions) -> dict[Meeting, list[float]]:
    """Every pair of pieces that erased segments, and these, corner arcs left out; told again when the table comes."""
    groups: dict[Meeting, list[float]] = {}
    met = zip(*deleted.by.T.tolist(), *deleted.at.T.tolist(), strict=True)
    for by, one in zip(met, deleted.segments.tolist(), strict=True):
        segments = groups.setdefault(by, [])
        if one.is_integer():
            segments.append(one)
    return {by: segments for by, segments in groups.items() if segments}


def _erasing(line: Erased, unit: Unit) -> Row:
    first, second, x, y = line.pair
    by = f"by {pair(first, second)} at {place((x, y), unit)}"
    return (Span(" DELETED ", Look.LABEL), Span(f"{numbers(line.segments)}  {by}", Look.WARNING))
