"""A derived program as lines of text for a person at a shell."""

from __future__ import annotations

from collections.abc import Iterator

from core.pipeline.derived import Derived, DerivedBlock
from core.pipeline.document import path_document, plain
from core.pipeline.table import Row, Table
from core.pipeline.trouble import nearest_of
from core.units import Kind, Unit, from_mm, sentence, show


def path_listing(derived: Derived, number: int | None = None) -> Iterator[str]:
    """Every move of the center path, a line each, under a heading for its block."""
    unit = derived.program.unit
    chosen = derived.blocks if number is None else (derived.block(number),)
    for found, block in zip(chosen, path_document(derived, number)["blocks"], strict=True):
        kind = "closed" if block["closed"] else "open"
        value = f"{block['lookahead']['tag']} {block['lookahead']['value']}"
        yield f"BLOCK {block['block']}  CUTTER COMP. {block['comp']}  {kind}  LOOKAHEAD {value}  {unit}"
        for move in block["moves"]:
            yield _move_line(move, unit)
        for one in block["deleted"]:
            x, y = _length(one["x"], unit), _length(one["y"], unit)
            yield f"  DELETED {one['segment']} by {one['by'][0]} and {one['by'][1]} at X {x} Y {y}"
        yield from verdict_listing(found, unit)


def verdict_listing(found: DerivedBlock, unit: Unit) -> Iterator[str]:
    """What the cutter does to the surface: the least distance and its place, and every stretch that is not reached."""
    place = nearest_of(found)
    if place is not None and found.radius is not None:
        x, y = (_length(from_mm(value, unit), unit) for value in place.surface_at)
        distance, radius = (_length(from_mm(value, unit), unit) for value in (place.distance, found.radius))
        yield f"  NEAREST {distance}  TOOL RADIUS {radius}  at X {x} Y {y} on segment {place.surface_number:g}"
    verdict = None if found.work is None else found.work.verdict
    if verdict is None or not verdict.judged:
        return
    left, whole = (_length(from_mm(value, unit), unit) for value in (verdict.uncut_length, verdict.surface_length))
    yield f"  UNCUT {left} of {whole}"
    for one in verdict.uncut:
        (x0, y0), (x1, y1) = ([_length(from_mm(value, unit), unit) for value in at] for at in (one.start, one.end))
        told = f"from X {x0} Y {y0} on segment {one.first_number:g} to X {x1} Y {y1} on segment {one.last_number:g}"
        yield f"    {_length(from_mm(one.length, unit), unit)} {told}"


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


def table_listing(found: DerivedBlock, table: Table | None, unit: Unit) -> Iterator[str]:
    """The look-ahead table of one block, a line a value, and its notes."""
    yield f"BLOCK {found.number}  LOOKAHEAD {found.lookahead.tag} {found.lookahead.value}"
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
    gouge = "clean" if row.clean else _length(from_mm(row.gouge, unit), unit)
    deleted = " ".join(str(plain(number)) for number in row.deleted) or "-"
    mark = "<" if row.value == table.recommended else " "
    return f"  {row.value:>4} {mark} {gouge:>11} {_length(from_mm(row.uncut, unit), unit):>12}  {deleted}"
