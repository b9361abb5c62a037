"""Formats what `cutcomp path` and `cutcomp lookahead` print, as JSON or as lines, in program units."""

from __future__ import annotations

from collections.abc import Iterator
from math import isfinite
from typing import Any, Final

from core.advice.lookahead_table import Row, Table
from core.advice.path_findings import nearest_place
from core.finding import Finding
from core.geometry.path import Path
from core.geometry.piece import Arc, Point
from core.pipeline.derived import Derived, DerivedBlock
from core.program.fields import form_of
from core.program.model import ArcSegment, Relative, Unread
from core.program.solve.reading import measured_fields
from core.program.solve.solved import Solved, SolvedRun, SolvedSegment
from core.units import Kind, Unit, from_mm, length_text, sentence, show

Document = dict[str, Any]


def path_document(derived: Derived, number: int | None = None) -> Document:
    """Return `cutcomp path --json`: the finish path of every block, or of block `number` alone."""
    unit = derived.program.unit
    chosen = derived.blocks if number is None else (derived.block(number),)
    return {"units": str(unit), "blocks": [_block(block, unit) for block in chosen]}


def _block(block: DerivedBlock, unit: Unit) -> Document:
    return {
        "block": block.number,
        "closed": block.solved.closed,
        "lookahead": {"value": block.lookahead.value, "tag": str(block.lookahead.tag)},
        "radius": None if block.radius is None else from_mm(block.radius, unit),
        "comp": str(block.block.cutter_comp),
        "clearance": _clearance(block, unit),
        "clearance_at": _clearance_at(block, unit),
        "moves": list(_block_moves(block, unit)),
        "deleted": _deleted(block, unit),
        "segments": [_segment(segment, block, unit) for segment in block.solved.segments],
        "runs": [_run(run, unit) for run in block.solved.runs],
        "findings": [finding_document(finding, unit) for finding in block.findings],
    }


def _segment(segment: SolvedSegment, block: DerivedBlock, unit: Unit) -> Document:
    """Return one segment with the value of every field in program units, and its tag, null if it is typed.

    A typed number is given with the value that the solved piece has: if more is typed than needed, the two may differ
    within the tolerance.
    """
    typed = block.block.segments[segment.number - 1]
    run = block.solved.run_of(segment.number)
    document: Document = {"segment": segment.number, "kind": str(form_of(typed))}
    if isinstance(typed, ArcSegment):
        document["direction"] = str(typed.direction)
    if run is not None:
        document["run"] = [run.first, run.last]
    measured = {} if segment.sharp is None else measured_fields(segment.sharp, unit)
    for name, value in segment.values.items():
        if isinstance(value, Unread):
            document[name] = {"value": None, "tag": "ERR", "text": value.text}
        elif isinstance(value, Solved):
            document[name] = {"value": value.value, "tag": str(value.origin)}
        elif isinstance(value, Relative):
            document[name] = {"value": measured.get(name), "tag": "INC", "typed": value.value}
        elif value is not None:
            document[name] = {"value": _as_solved(value.value, measured.get(name), name), "tag": None}
    return document


def _as_solved(typed: float, solved: float | None, name: str) -> float:
    """Return the typed number, or the value of the solved piece if that differs."""
    if solved is None:
        return typed
    off = abs(typed - solved)
    if name in ("angle", "start_angle"):
        off = abs((off + 180.0) % 360.0 - 180.0)
    return typed if off <= TYPED_EXACTLY else solved


TYPED_EXACTLY: Final = 1e-9
"""A piece's value that differs from the typed number by no more than this is the typed one; program units."""


def _run(run: SolvedRun, unit: Unit) -> Document:
    """Return one run: the solution in force (an index, null for none), and all of them, the shortest first."""
    return {
        "first": run.first,
        "last": run.last,
        "solution": run.taken,
        "missing": run.missing,
        "code": run.code,
        "solutions": [
            {
                "choice": answer.choice,
                "pick": None if answer.pick is None else [from_mm(number, unit) for number in answer.pick],
                "total": from_mm(answer.length, unit),
                "segments": [{"segment": number, **measured_fields(piece, unit)} for number, piece in answer.pieces],
            }
            for answer in run.answers
        ],
    }


def _clearance(block: DerivedBlock, unit: Unit) -> float | None:
    """Return the smallest distance from the center path, blends included, to the surface; None without one."""
    verdict = None if block.paths is None else block.paths.verdict
    if verdict is None or not isfinite(verdict.clearance):
        return None
    return from_mm(verdict.clearance, unit)


def _clearance_at(block: DerivedBlock, unit: Unit) -> Document | None:
    """Return the place of the smallest distance: the contour's segment and the point on it."""
    place = nearest_place(block.paths)
    if place is None:
        return None
    x, y = place.surface_at
    return {"segment": segment_number(place.surface_number), "x": from_mm(x, unit), "y": from_mm(y, unit)}


def _block_moves(block: DerivedBlock, unit: Unit) -> Iterator[Document]:
    if block.paths is None:
        return
    for loop in block.paths.loops:
        yield from _moves(loop.lead_in, "blend-in", unit)
        yield from _moves(loop.path, "path", unit)
        yield from _moves(loop.lead_out, "blend-out", unit)


def _moves(path: Path, part: str, unit: Unit) -> Iterator[Document]:
    for piece, number in zip(path, path.numbers.tolist(), strict=True):
        (x0, y0), (x, y) = piece.start, piece.end
        ends = {"x0": from_mm(x0, unit), "y0": from_mm(y0, unit), "x": from_mm(x, unit), "y": from_mm(y, unit)}
        kind = "arc" if isinstance(piece, Arc) else "line"
        move = {"type": kind, "part": part, "segment": segment_number(number), **ends}
        if isinstance(piece, Arc):
            cx, cy = piece.center
            move |= {"cx": from_mm(cx, unit), "cy": from_mm(cy, unit), "ccw": piece.turn > 0}
        yield move


def _deleted(block: DerivedBlock, unit: Unit) -> list[Document]:
    if block.paths is None or block.paths.compensated is None or block.paths.best is not None:
        return []
    return [
        {
            "segment": segment_number(deletion.segment),
            "by": [segment_number(deletion.by[0]), segment_number(deletion.by[1])],
            "x": from_mm(deletion.at[0], unit),
            "y": from_mm(deletion.at[1], unit),
        }
        for deletion in block.paths.compensated.deleted
    ]


def finding_document(finding: Finding, unit: Unit) -> Document:
    """Return one finding with its place and value in program units."""
    at = (None, None) if finding.at is None else tuple(from_mm(number, unit) for number in finding.at)
    return {
        "code": finding.code,
        "severity": str(finding.severity),
        "segment": None if finding.segment is None else segment_number(finding.segment),
        "field": finding.field,
        "x": at[0],
        "y": at[1],
        "value": None if finding.value is None else from_mm(finding.value, unit),
        "area": None if finding.area is None else from_mm(from_mm(finding.area, unit), unit),
        "text": sentence(finding, unit),
    }


def table_document(block: DerivedBlock, table: Table | None, unit: Unit) -> Document:
    """Return `cutcomp lookahead --json` for one block: the path's result at every value, and the table's notes."""
    rows = () if table is None else table.rows
    return {
        "block": block.number,
        "lookahead": {"value": block.lookahead.value, "tag": str(block.lookahead.tag)},
        "values": [
            {
                "value": row.value,
                "clean": row.clean,
                "gouge": from_mm(row.gouge, unit),
                "uncut": from_mm(row.uncut, unit),
                "deleted": [segment_number(number) for number in row.deleted],
            }
            for row in rows
        ],
        "recommended": None if table is None else table.recommended,
        "needs": [] if table is None else [finding_document(note, unit) for note in table.notes],
        "findings": [finding_document(finding, unit) for finding in block.findings],
    }


def segment_number(number: float) -> int | float:
    """Return a segment's number, as an integer if it is one."""
    return int(number) if number == int(number) else number


def path_listing(derived: Derived, number: int | None = None) -> Iterator[str]:
    """Yield every move of the center path, a line each, under a heading for its block."""
    unit = derived.program.unit
    chosen = derived.blocks if number is None else (derived.block(number),)
    for block, document in zip(chosen, path_document(derived, number)["blocks"], strict=True):
        kind = "closed" if document["closed"] else "open"
        value = f"{document['lookahead']['tag']} {document['lookahead']['value']}"
        yield f"BLOCK {document['block']}  CUTTER COMP. {document['comp']}  {kind}  LOOKAHEAD {value}  {unit}"
        for move in document["moves"]:
            yield _move_line(move, unit)
        for deletion in document["deleted"]:
            x, y = _length(deletion["x"], unit), _length(deletion["y"], unit)
            yield f"  DELETED {deletion['segment']} by {deletion['by'][0]} and {deletion['by'][1]} at X {x} Y {y}"
        yield from verdict_listing(block, unit)


def verdict_listing(block: DerivedBlock, unit: Unit) -> Iterator[str]:
    """Yield what the cutter does to the surface: the least distance and its place, and each stretch not reached."""
    place = nearest_place(block.paths)
    if place is not None and block.radius is not None:
        distance, radius = (length_text(value, unit) for value in (place.distance, block.radius))
        at = _place(place.surface_at, place.surface_number, unit)
        yield f"  NEAREST {distance}  TOOL RADIUS {radius}  at {at}"
    verdict = None if block.paths is None else block.paths.verdict
    if verdict is None or not verdict.judged:
        return
    left, whole = (length_text(value, unit) for value in (verdict.uncut_length, verdict.surface_length))
    yield f"  UNCUT {left} of {whole}"
    for stretch in verdict.uncut:
        start = _place(stretch.start, stretch.first_number, unit)
        end = _place(stretch.end, stretch.last_number, unit)
        yield f"    {length_text(stretch.length, unit)} from {start} to {end}"


def _place(point: Point, segment: float, unit: Unit) -> str:
    x, y = (length_text(value, unit) for value in point)
    return f"X {x} Y {y} on segment {segment:g}"


def _length(value: float, unit: Unit) -> str:
    return show(value, Kind.LENGTH, unit)


def _move_line(move: dict[str, object], unit: Unit) -> str:
    def number(key: str) -> str:
        value = move[key]
        assert isinstance(value, float)
        return f"{_length(value, unit):>12}"

    line = f"  {move['segment']!s:>6} {move['part']!s:<9} X {number('x')} Y {number('y')}"
    if move["type"] == "line":
        return f"{line}  LINE"
    return f"{line}  {'CCW' if move['ccw'] else 'CW ':<3} about X {number('cx')} Y {number('cy')}"


def table_listing(block: DerivedBlock, table: Table | None, unit: Unit) -> Iterator[str]:
    """Yield the look-ahead table of one block, a line per value, and its notes."""
    yield f"BLOCK {block.number}  LOOKAHEAD {block.lookahead.tag} {block.lookahead.value}"
    if table is None:
        yield "  There is no contour to compensate yet, or CUTTER COMP. is ON."
        return
    yield "  value        gouge        uncut  deleted"
    for row in table.rows:
        yield _row_line(row, table, unit)
    if table.recommended is None:
        yield "  No value is clean."
    else:
        yield f"  Recommended: {table.recommended}"
    for note in table.notes:
        yield f"  {sentence(note, unit)}"


def _row_line(row: Row, table: Table, unit: Unit) -> str:
    gouge = "clean" if row.clean else length_text(row.gouge, unit)
    deleted = " ".join(str(segment_number(number)) for number in row.deleted) or "-"
    mark = "<" if row.value == table.recommended else " "
    return f"  {row.value:>4} {mark} {gouge:>11} {length_text(row.uncut, unit):>12}  {deleted}"
