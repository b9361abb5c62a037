"""The machine-readable side: a derived program as plain dictionaries, numbers in program units."""

from __future__ import annotations

from collections.abc import Iterator
from math import isfinite
from typing import Any

from core.finding import Finding
from core.geometry.path import Path
from core.pipeline.derived import Derived, DerivedBlock
from core.pipeline.table import Table
from core.pipeline.trouble import nearest_of
from core.units import Unit, from_mm, sentence

Document = dict[str, Any]


def path_document(derived: Derived, number: int | None = None) -> Document:
    """`cutcomp path --json`: the finish path of every block, or of block `number` alone."""
    unit = derived.program.unit
    chosen = derived.blocks if number is None else (derived.block(number),)
    return {"units": str(unit), "blocks": [_block(found, unit) for found in chosen]}


def _block(found: DerivedBlock, unit: Unit) -> Document:
    return {
        "block": found.number,
        "closed": found.solved.closed,
        "lookahead": {"value": found.lookahead.value, "tag": str(found.lookahead.tag)},
        "radius": None if found.radius is None else from_mm(found.radius, unit),
        "comp": str(found.block.cutter_comp),
        "clearance": _clearance(found, unit),
        "clearance_at": _clearance_at(found, unit),
        "moves": list(_block_moves(found, unit)),
        "deleted": _deleted(found, unit),
        "findings": [finding_document(finding, unit) for finding in found.findings],
    }


def _clearance(found: DerivedBlock, unit: Unit) -> float | None:
    """The smallest distance from the center path to the surface, blends included; None where there is none."""
    verdict = None if found.work is None else found.work.verdict
    if verdict is None or not isfinite(verdict.clearance):
        return None
    return from_mm(verdict.clearance, unit)


def _clearance_at(found: DerivedBlock, unit: Unit) -> Document | None:
    """The place of the smallest distance: the contour's segment and the point on it."""
    place = nearest_of(found)
    if place is None:
        return None
    x, y = place.surface_at
    return {"segment": plain(place.surface_number), "x": from_mm(x, unit), "y": from_mm(y, unit)}


def _block_moves(found: DerivedBlock, unit: Unit) -> Iterator[Document]:
    if found.work is None:
        return
    for loop in found.work.loops:
        yield from _moves(loop.lead_in, "blend-in", unit)
        yield from _moves(loop.path, "path", unit)
        yield from _moves(loop.lead_out, "blend-out", unit)


def _moves(path: Path, part: str, unit: Unit) -> Iterator[Document]:
    points, centers, turns, numbers = (
        array.tolist() for array in (path.points, path.centers, path.turns, path.numbers)
    )
    for row, turn in enumerate(turns):
        (x0, y0), (x, y) = points[row], points[row + 1]
        ends = {"x0": from_mm(x0, unit), "y0": from_mm(y0, unit), "x": from_mm(x, unit), "y": from_mm(y, unit)}
        move = {"type": "arc" if turn else "line", "part": part, "segment": plain(numbers[row]), **ends}
        if turn:
            cx, cy = centers[row]
            move |= {"cx": from_mm(cx, unit), "cy": from_mm(cy, unit), "ccw": turn > 0}
        yield move


def _deleted(found: DerivedBlock, unit: Unit) -> list[Document]:
    if found.work is None or found.work.compensated is None or found.work.best is not None:
        return []
    return [
        {
            "segment": plain(one.segment),
            "by": [plain(one.by[0]), plain(one.by[1])],
            "x": from_mm(one.at[0], unit),
            "y": from_mm(one.at[1], unit),
        }
        for one in found.work.compensated.deleted
    ]


def finding_document(finding: Finding, unit: Unit) -> Document:
    """One finding with its place and value in program units."""
    at = (None, None) if finding.at is None else tuple(from_mm(number, unit) for number in finding.at)
    return {
        "code": finding.code,
        "severity": str(finding.severity),
        "segment": None if finding.segment is None else plain(finding.segment),
        "field": finding.field,
        "x": at[0],
        "y": at[1],
        "value": None if finding.value is None else from_mm(finding.value, unit),
        "area": None if finding.area is None else from_mm(from_mm(finding.area, unit), unit),
        "text": sentence(finding, unit),
    }


def table_document(found: DerivedBlock, table: Table | None, unit: Unit) -> Document:
    """`cutcomp lookahead --json` for one block: what becomes of the path at every value, and the table's notes."""
    rows = () if table is None else table.rows
    return {
        "block": found.number,
        "lookahead": {"value": found.lookahead.value, "tag": str(found.lookahead.tag)},
        "values": [
            {
                "value": row.value,
                "clean": row.clean,
                "gouge": from_mm(row.gouge, unit),
                "uncut": from_mm(row.uncut, unit),
                "deleted": [plain(number) for number in row.deleted],
            }
            for row in rows
        ],
        "recommended": None if table is None else table.recommended,
        "needs": [] if table is None else [finding_document(note, unit) for note in table.notes],
        "findings": [finding_document(finding, unit) for finding in found.findings],
    }


def plain(number: float) -> int | float:
    """A segment's number as an integer where it is one."""
    return int(number) if number == int(number) else number
