"""What is drawn of a block: its surface, the centre path, the cutter at the cursor, and what went wrong where."""

from __future__ import annotations

from collections.abc import Iterator

from core.comp.result import Compensated
from core.draw.scene import Circle, Layer, Mark, Scene, Style, Symbol
from core.geometry.path import Floats, Path
from core.geometry.piece import Piece, Point
from core.pipeline.derived import DerivedBlock
from core.units import Unit
from core.verify.verdict import Verdict


def block_scene(found: DerivedBlock, segment: int, unit: Unit) -> Scene:
    """The block with the cursor on `segment` (0 is START)."""
    work = found.work
    if work is None:
        return Scene(tuple(_sketched(found, segment)), marks=_start(found), unit=unit)
    return Scene(
        (*_surface(found, work.surface, segment), *_paths(work.compensated, work.centre)),
        _cutter(found, work.centre, segment),
        (*_start(found), *_trouble(work.compensated, work.verdict)),
        unit,
    )


def table_scene(found: DerivedBlock, compensated: Compensated, verdict: Verdict, unit: Unit) -> Scene:
    """The block with the path that another look-ahead value makes."""
    paths = _paths(compensated, compensated.path)
    return Scene(
        (*_surface(found, compensated.contour, 0), *paths), (), (*_start(found), *_trouble(compensated, verdict)), unit
    )


def _surface(found: DerivedBlock, surface: Path, segment: int) -> Iterator[Layer]:
    yield Layer(surface, Style.SURFACE)
    yield from _undetermined(found, found.solved.determined)
    if segment and segment <= len(found.solved.segments):
        piece = found.solved.segments[segment - 1].piece
        if piece is not None:
            yield Layer(_path(piece), Style.CURRENT)


def _sketched(found: DerivedBlock, segment: int) -> Iterator[Layer]:
    for one in found.solved.segments:
        if one.piece is not None:
            yield Layer(_path(one.piece), Style.CURRENT if one.number == segment else Style.SURFACE)
    yield from _undetermined(found, 0)


def _undetermined(found: DerivedBlock, first: int) -> Iterator[Layer]:
    """Segments not determined yet, dashed: what is known of them, or the solutions the operator picks from."""
    for one in found.solved.segments[first:]:
        if one.piece is None:
            for piece in one.choices or ((one.sketch,) if one.sketch is not None else ()):
                yield Layer(_path(piece), Style.CURRENT, dashed=True)


def _paths(compensated: Compensated | None, centre: Path) -> Iterator[Layer]:
    if compensated is None:
        yield Layer(centre, Style.PATH)
        return
    yield Layer(compensated.lead_in, Style.LEAD)
    yield Layer(compensated.lead_out, Style.LEAD)
    yield Layer(compensated.path, Style.PATH)


def _cutter(found: DerivedBlock, centre: Path, segment: int) -> tuple[Circle, ...]:
    """The cutter where the path of the cursor's segment ends; at the path's start on START or where it was erased."""
    if found.radius is None or not len(centre):
        return ()
    rows = [row for row, number in enumerate(centre.numbers.tolist()) if number == segment]
    point = centre.ends[rows[-1]] if rows else centre.points[0]
    return (Circle(_point(point), found.radius),)


def _start(found: DerivedBlock) -> tuple[Mark, ...]:
    first = found.solved.segments[0] if found.solved.segments else None
    if first is None or first.start is None:
        return ()
    mark = Mark(first.start, Style.START, Symbol.START)
    return (mark,) if first.piece is None else (mark, _arrow(_path(first.piece)))


def _arrow(path: Path) -> Mark:
    """The direction of travel, on the end of the first segment."""
    return Mark(_point(path.ends[0]), Style.START, Symbol.ARROW, _point(path.end_directions[0]))


def _trouble(compensated: Compensated | None, verdict: Verdict | None) -> Iterator[Mark]:
    for one in () if compensated is None else compensated.deleted:
        yield Mark(one.at, Style.DELETED, Symbol.DELETED)
    for gouge in () if verdict is None else verdict.gouges:
        yield Mark(gouge.surface_at, Style.GOUGE, Symbol.GOUGE)


def _path(piece: Piece) -> Path:
    return Path.from_pieces([piece])


def _point(row: Floats) -> Point:
    x, y = row.tolist()
    return (x, y)
