"""The strip: every look-ahead value's fate on one line, and which value is best."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from app.painted.widgets.rows import Look, Row, Span, plain
from app.painted.widgets.words import length, numbers
from core.pipeline.derived import DerivedBlock
from core.units import Unit

if TYPE_CHECKING:
    from core.advice.lookahead_table import Row as Fate
    from core.advice.lookahead_table import Table

STRIP: Final = 59
"""Cells of the strip: it stands above the form's drawing."""


def strip(found: DerivedBlock, table: Table | None, unit: Unit) -> Row:
    """The verdict's first line: every value's fate and which is best; the value in force alone before that is known.

    Of a contour that is not determined to its end it tells what all of the verdict is about, and advises nothing.
    """
    if found.side is None:
        told = ": the tool's center runs on the contour." if found.known else "   calculating ..."
        return plain(f" CUTTER COMP. ON{told}", Look.LABEL)
    if table is None:
        more = _alone(found) if found.known else "calculating ..."
        return plain(f" look-ahead [{found.lookahead.value}]   {more}".rstrip(), Look.LABEL)
    here = found.lookahead.value
    spans = [Span(" look-ahead", Look.LABEL)]
    for first, last, mark in _runs(table, here):
        spans.append(_run(first, last, mark, here=first == here == last))
    alone = _alone(found)
    advice = alone or _advice(table, here)
    left = STRIP - sum(len(span.text) for span in spans)
    if not alone and (price := _price(table, here, unit)) and left >= len(advice) + len(price) + 4:
        advice = f"{advice} {price}"
    if left < len(advice) + 2:
        spans = _shortened(spans, STRIP - len(advice) - 6)
    return (*spans, Span(f"   {advice}", Look.LABEL))


def _alone(found: DerivedBlock) -> str:
    """Which segments the verdict is about where that is not all of the contour."""
    if found.solved.whole or not found.solved.pieces:
        return ""
    last = found.solved.pieces[-1][0]
    return "of segment 1 alone" if last == 1 else f"of segments 1-{last} alone"


def _run(first: int, last: int, mark: str, *, here: bool) -> Span:
    text = f"{first}{mark}" if first == last else f"{first}-{last}{mark}"
    look = Look.ERROR if mark == "!" else Look.WARNING if mark == "*" else Look.GOOD
    return Span(f" [{text}]" if here else f" {text}", look)


def _runs(table: Table, here: int) -> list[tuple[int, int, str]]:
    """Neighboring values of one fate; the value in force stands alone."""
    runs: list[tuple[int, int, str]] = []
    for row in table.rows:
        mark = mark_of(row)
        joins = runs and runs[-1][2] == mark and here not in (row.value, runs[-1][1])
        runs[-1:] = [(runs[-1][0], row.value, mark)] if joins else [*runs[-1:], (row.value, row.value, mark)]
    return runs


def mark_of(fate: Fate) -> str:
    """! for a value that gouges, * for one that erases segments, nothing for a clean one."""
    if not fate.clean:
        return "!"
    erased = fate.compensated.deleted
    return "*" if len(erased) and any(number.is_integer() for number in erased.segments.tolist()) else ""


def _advice(table: Table, here: int) -> str:
    if table.recommended is None:
        return "none is clean"
    return "this is best" if table.recommended == here else f"best {table.recommended}"


def _price(table: Table, here: int, unit: Unit) -> str:
    """What the recommended value costs, told the same way whatever is in force: segments it deletes, else surface
    that it leaves."""
    if table.recommended is None or table.recommended == here:
        return ""
    best = table.row(table.recommended)
    if erased := numbers(best.deleted):
        return f"(deletes {erased})"
    left = length(best.uncut, unit)
    return f"(uncut {left})" if left.strip("0.") else ""


def _shortened(spans: list[Span], room: int) -> list[Span]:
    kept: list[Span] = []
    for span in spans:
        if sum(len(one.text) for one in kept) + len(span.text) > room:
            return [*kept, Span(" ...", Look.LABEL)]
        kept.append(span)
    return kept
