"""This module lists the findings of a block: gouges, errors, remedies, uncut stock by area, then the rest.

The findings list, the loupe, DRAW and the numbers in the part's drawing all use this list in this order.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import IntEnum
from typing import TYPE_CHECKING, Final

from app.session.formats import length
from core.finding import Finding, Severity
from core.pipeline.derived import DerivedBlock
from core.units import Unit, segment_name, sentence

if TYPE_CHECKING:
    from core.advice.lookahead_table import Table
    from core.geometry.piece import Point


class EntryKind(IntEnum):
    """The kind of a finding, in the order of the list."""

    GOUGE = 0
    ERROR = 1
    TO_TYPE = 2
    REMEDY = 3
    UNCUT = 4
    WARNING = 5
    NOTE = 6


TO_TYPE: Final = frozenset({"MISSING", "NO_SEGMENTS"})
"""Errors that only say that something is still to be typed."""
WAITING_CODES: Final = TO_TYPE | {"NOT_YET"}
"""Errors that the prompt reports: something is still to be typed, or a run waits for more values."""
GOUGE_CODES: Final = frozenset({"GOUGE", "ROUGH_GOUGES", "BLEND_GOUGES", "WRONG_SIDE"})
"""Errors that mean damage to the part."""
REMEDY_CODES: Final = frozenset(
    {"BLENDLESS", "START_MID_SIDE", "START_BLENDLESS", "START_AT_END", "TOOL_FITS", "TOOL_BLENDLESS"}
)
"""Advice that has been tried and gives a clean path."""
START_FIELD_OF_ADVICE: Final = {"CAL_NOT_CLEAN": "lookahead", "START_MID_SIDE": "x_start", "START_BLENDLESS": "x_start"}
"""The field of START in which advice is carried out, by the code of the advice, whichever segment it names."""
_KINDS: Final = {Severity.ERROR: EntryKind.ERROR, Severity.WARNING: EntryKind.WARNING, Severity.INFO: EntryKind.NOTE}


@dataclass(frozen=True, slots=True)
class Entry:
    """One finding as the list shows it: `title` is short, `where` names the segment, `text` is the full sentence.

    The loupe goes to `at` (mm), the cursor to `segment` and `field`; each is None if there is none.
    """

    kind: EntryKind
    title: str
    where: str
    text: str
    at: Point | None = None
    segment: int | None = None
    field: str | None = None
    area: float = 0.0


def block_findings(block: DerivedBlock, table: Table | None, unit: Unit) -> tuple[Entry, ...]:
    """Return all findings of a block and the notes of its look-ahead table, sorted by kind.

    A gouge of a blend arc is one entry with its remedy, though it is reported as GOUGE and as BLEND_GOUGES.
    """
    notes = () if table is None else table.notes
    findings = dict.fromkeys((*block.findings, *notes))
    blends = {_place(finding): finding for finding in findings if finding.code == "BLEND_GOUGES"}
    gouges = {_place(finding) for finding in findings if finding.code == "GOUGE"}
    entries = []
    for finding in findings:
        if finding.code == "BLEND_GOUGES" and _place(finding) in gouges:
            continue
        entry = _entry(finding, unit)
        blend = blends.get(_place(finding)) if finding.code == "GOUGE" else None
        if blend is not None:
            # with the advice of the finding on the blend arc, and with the field that mends it
            advice = sentence(blend, unit).partition(". ")[2]
            entry = replace(entry, text=f"{entry.text} {advice}", field=blend.field)
        entries.append(entry)
    return tuple(sorted(entries, key=lambda entry: (entry.kind, -entry.area)))


def _place(finding: Finding) -> tuple[float | None, Point | None, float | None]:
    """Return what GOUGE and BLEND_GOUGES have in common if they are about the same gouge."""
    return finding.segment, finding.at, finding.value


def _entry(finding: Finding, unit: Unit) -> Entry:
    segment = None if finding.segment is None else int(finding.segment)
    field, text = finding.field, sentence(finding, unit)
    if finding.code in START_FIELD_OF_ADVICE:
        segment, field = 0, START_FIELD_OF_ADVICE[finding.code]
    if finding.code == "GOUGE" and finding.value is not None:
        title = f"GOUGE {length(finding.value, unit)} deep"
    elif finding.code == "UNCUT" and finding.lengths:
        title = f"UNCUT {length(finding.lengths[0], unit)} thick"
    else:
        title = text.partition(". ")[0].rstrip(".")
    return Entry(_kind(finding), title, _where(finding), text, finding.at, segment, field, finding.area or 0.0)


def _where(finding: Finding) -> str:
    """Return `segment 8-10` for a finding that runs over several segments, else its segment, corner or START."""
    first, last = finding.segment, finding.last_segment
    if first is None:
        return ""
    if last is not None and int(last) != int(first):
        return f"segment {int(first)}-{int(last)}"
    return segment_name(first) if first else "START"


def remedy(table: Table | None, field: str, unit: Unit) -> str:
    """Return the first note about a field of START, such as a better value; empty if there is none."""
    for note in () if table is None else table.notes:
        if field == (note.field or START_FIELD_OF_ADVICE.get(note.code)):
            return sentence(note, unit)
    return ""


def _kind(finding: Finding) -> EntryKind:
    if finding.code in TO_TYPE:
        return EntryKind.TO_TYPE
    if finding.code in GOUGE_CODES:
        return EntryKind.GOUGE
    if finding.code in REMEDY_CODES:
        return EntryKind.REMEDY
    return EntryKind.UNCUT if finding.code == "UNCUT" else _KINDS[finding.severity]
