"""Turns a drawing's shapes into contours: scaled to millimeters, cleaned, chained, joined, nested and sorted.

`contours_of` is all that an import screen or command needs; it takes a drawing as read and the operator's options.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, replace
from math import dist
from typing import Final

import shapely

from core.geometry.piece import Line, Piece, Point, Turn
from core.importing.clean_up import Cleaned, LayeredPiece, clean_up
from core.importing.contour import Contour, ContourKind, joined_open, reversed_contour, rounded, started_at_usual_place
from core.importing.curves import moved_piece, pieces_of_ellipse, pieces_of_spline
from core.importing.drawing import (
    BSpline,
    Drawing,
    DrawingError,
    DrawingUnit,
    EllipseArc,
    LayeredShape,
    StageProgress,
    no_stage_progress,
)
from core.importing.joints import joined_chain, reversed_pieces
from core.importing.loops import Chain, chained
from core.importing.nesting import box_of, containers, crosses_itself, crossings
from core.importing.nodes import KEY_DECIMALS, SAME_POINT
from core.program.fields import LARGEST_LENGTH
from core.units import Kind, Unit, decimals_shown, from_mm, length_text, show

JOIN_TOLERANCE: Final[Mapping[Unit, float]] = {Unit.IN: 0.0005 * 25.4, Unit.MM: 0.01}
"""Largest distance in millimeters of ends that are joined, by the program's unit; the operator may change it."""

MAX_TOLERANCE: Final[Mapping[Unit, float]] = {Unit.IN: 0.1 * 25.4, Unit.MM: 2.0}

FIT_TOLERANCE: Final[Mapping[Unit, float]] = {Unit.IN: 0.0002 * 25.4, Unit.MM: 0.005}
"""Largest deviation in millimeters of arcs from a curve or a run of lines, by the program's unit."""

BRANCH_REACH: Final = 2.0
"""A contour ends at a branch if its end is within this many tolerances of it."""

MAX_CROSSING_CHECK: Final = 2000
"""Most closed contours that are checked for touching and crossing."""


@dataclass(frozen=True, slots=True)
class ImportOptions:
    """The operator's choices; `tolerance` and `fit` in millimeters.  `layers` None means all layers.

    Messages give lengths in the unit `program`; None means that of a program made from this drawing alone.
    """

    unit: DrawingUnit
    tolerance: float
    fit: float
    layers: frozenset[str] | None = None
    program: Unit | None = None

    @staticmethod
    def usual(unit: DrawingUnit, program: Unit | None = None) -> ImportOptions:
        """Return the options with the usual tolerances of a program's unit."""
        usual = program or unit.program_unit
        return ImportOptions(unit, JOIN_TOLERANCE[usual], FIT_TOLERANCE[usual], program=program)

    @property
    def program_unit(self) -> Unit:
        """The unit of lengths in messages."""
        return self.program or self.unit.program_unit


@dataclass(frozen=True, slots=True)
class Branch:
    """A point where more than two ends meet, and the numbers of the open contours that end there."""

    at: Point
    end_count: int
    contours: tuple[int, ...] = ()


@dataclass(frozen=True, eq=False, slots=True)
class ContourList:
    """All contours of a drawing: largest first, holes after the contour around them, open ones last.

    `cleaned` counts what clean-up removed; `gap` is the largest gap closed.  `notes` are sentences for the operator.
    """

    drawing: Drawing
    options: ImportOptions
    contours: tuple[Contour, ...]
    cleaned: Cleaned
    gap: float
    branches: tuple[Branch, ...]
    notes: tuple[str, ...]

    @property
    def unit(self) -> Unit:
        """The unit of lengths in messages."""
        return self.options.program_unit


def contours_of(drawing: Drawing, options: ImportOptions, progress: StageProgress = no_stage_progress) -> ContourList:
    """Return the contours of a drawing; DrawingError NOT_FLAT if a chosen layer has an entity outside the plane."""
    for entity in drawing.not_flat:
        if options.layers is None or entity.layer in options.layers:
            raise DrawingError("NOT_FLAT", entity.text)
    shapes = [layered for layered in drawing.shapes if options.layers is None or layered.layer in options.layers]
    pieces = _pieces(shapes, options, progress)
    notes = list(drawing.notes)
    left, bottom, right, top = box_of([item.piece for item in pieces]) if pieces else (0.0, 0.0, 0.0, 0.0)
    if max(left, bottom, -right, -top) > LARGEST_LENGTH:
        pieces = [item._replace(piece=moved_piece(item.piece, -left, -bottom)) for item in pieces]
        unit = options.program_unit
        x, y = (f"{from_mm(value, unit):.{decimals_shown(Kind.LENGTH, unit)}f}" for value in (left, bottom))
        notes.append(f"The drawing begins at X {x} Y {y}, farther out than the form takes: it is moved to X 0 Y 0.")
    progress("cleaning", 0, 1)
    cleaned = clean_up(pieces, options.tolerance)
    progress("chaining", 0, 1)
    groups = [cleaned.pieces, *cleaned.closed]
    results = [chained([item.piece for item in items], options.tolerance) for items in groups]
    chains = ((chain, items) for items, (chains, _) in zip(groups, results, strict=True) for chain in chains)
    contours = [contour for each in chains if (contour := _contour(*each, options.tolerance)).pieces]
    progress("nesting", 0, 1)
    ordered = _with_open_gaps(_nested(contours), options.program_unit, options.tolerance)
    return ContourList(
        drawing,
        options,
        tuple(ordered),
        cleaned,
        max((contour.gap for contour in ordered), default=0.0),
        _branches(results[0][1], ordered, options.tolerance),
        tuple(notes),
    )


def _pieces(shapes: Sequence[LayeredShape], options: ImportOptions, progress: StageProgress) -> list[LayeredPiece]:
    """Return the shapes as pieces in millimeters, with curves as arcs."""
    scale, pieces = options.unit.mm, list[LayeredPiece]()
    for number, layered in enumerate(shapes):
        if number % 100 == 0:
            progress("fitting", number, len(shapes))
        pieces += [LayeredPiece(piece, layered.layer, layered.entity) for piece in _scaled(layered, scale, options.fit)]
    return pieces


def _scaled(layered: LayeredShape, scale: float, fit: float) -> Sequence[Piece]:
    match layered.shape:
        case Line(start, end):
            return (Line(_times(start, scale), _times(end, scale)),)
        case EllipseArc(center, first, second, begin, end):
            return pieces_of_ellipse(EllipseArc(center * scale, first * scale, second * scale, begin, end), fit)
        case BSpline(degree, points, weights, knots):
            pieces = pieces_of_spline(BSpline(degree, points * scale, weights, knots), fit)
            at = (float(points[0].real) * scale, float(points[0].imag) * scale)
            # a spline without length counts as a piece that is too short
            return pieces or [Line(at, at)]


def _times(point: Point, scale: float) -> Point:
    return point[0] * scale, point[1] * scale


def _contour(chain: Chain, items: Sequence[LayeredPiece], tolerance: float) -> Contour:
    """Join a chain into a contour without a number; an open one starts at its lower left end."""
    rows = [items[link.row] for link in chain.links]
    pieces = [
        item.piece if link.forward else item.piece.reversed() for item, link in zip(rows, chain.links, strict=True)
    ]
    joined = joined_chain(pieces, closed=chain.closed, tolerance=tolerance)
    lengths: dict[str, float] = {}
    for item in rows:
        lengths[item.layer] = lengths.get(item.layer, 0.0) + item.piece.length
    layers = tuple(sorted(lengths, key=lambda layer: (-round(lengths[layer], KEY_DECIMALS), layer)))
    kind = ContourKind.OUTSIDE if chain.closed else ContourKind.OPEN
    contour = Contour(0, joined.pieces, chain.closed, kind, layers, len(joined.pieces), joined.gap)
    if not chain.closed and joined.pieces and rounded(joined.pieces[-1].end) < rounded(joined.pieces[0].start):
        return replace(contour, pieces=reversed_pieces(joined.pieces))
    return contour


def with_joined(listed: ContourList, first: int, second: int) -> ContourList | None:
    """Join two open contours that meet at a branch, and renumber the list; None if they do not meet.

    A contour keeps its start and its direction unless its kind changes.
    """
    pair = [next(contour for contour in listed.contours if contour.number == number) for number in (first, second)]
    tolerance, unit = listed.options.tolerance, listed.unit
    joined = joined_open(pair[0], pair[1], BRANCH_REACH * max(tolerance, SAME_POINT))
    if joined is None:
        return None
    others = [contour for contour in listed.contours if contour not in pair]
    # without the values that depend on the rest of the list
    unlisted = [
        replace(each, problems=(), open_gap=None, open_gap_to=0) for each in (*others, replace(joined, number=0))
    ]
    contours = _with_open_gaps(_nested(unlisted), unit, tolerance)
    nodes = [(branch.at, branch.end_count) for branch in listed.branches]
    return replace(listed, contours=tuple(contours), branches=_branches(nodes, contours, tolerance))


def frame_notes(listed: ContourList, numbers: AbstractSet[int]) -> list[str]:
    """Return a sentence for each outermost contour that is not taken, around taken ones of which one lies in another.

    It may be the part's outline or the frame of the drawing; a frame makes holes of outlines.
    """
    around = {number: _around(listed, number) for number in sorted(numbers)}
    outermost = {outer[0] for outer in around.values() if not numbers.isdisjoint(outer)} - numbers
    return [
        f"Chain {number} around chains {', '.join(str(each) for each in around if number in around[each])} is not "
        "taken. If it is only a frame, reverse them."
        for number in sorted(outermost)
    ]


def _around(listed: ContourList, number: int) -> list[int]:
    """Return the numbers of the contours around one, the outermost first."""
    around: list[int] = []
    while number := listed.contours[number - 1].inside:
        around.insert(0, number)
    return around


def _nested(contours: Sequence[Contour]) -> list[Contour]:
    """Return the contours in list order with nesting, direction and start; open ones last, longest first."""
    closed = _by_size([contour for contour in contours if contour.closed])
    inside = containers([contour.pieces for contour in closed])
    crossed = crossings([contour.pieces for contour in closed], MAX_CROSSING_CHECK)
    areas = [contour.area for contour in closed]
    parents = [min(outer, key=areas.__getitem__, default=None) for outer in inside]
    children: dict[int | None, list[int]] = {}
    for row, parent in enumerate(parents):
        children.setdefault(parent, []).append(row)
    # no recursion: thousands of rings may lie in one another
    order, waiting = list[int](), children.get(None, [])[::-1]
    while waiting:
        order.append(waiting.pop())
        waiting += children.get(order[-1], [])[::-1]
    numbers = {row: number for number, row in enumerate(order, 1)}
    listed = []
    for row in order:
        parent, depth = parents[row], len(inside[row])
        kind = ContourKind.HOLE if depth % 2 else ContourKind.ISLAND if depth else ContourKind.OUTSIDE
        contour = replace(closed[row], kind=kind, depth=depth)
        if not contour.number or kind is not closed[row].kind:
            # for climb milling with the tool on the left
            travel = Turn.CCW if kind is ContourKind.HOLE else Turn.CW
            contour = started_at_usual_place(contour if contour.turn is travel else reversed_contour(contour))
        problems = [f"touches or crosses chain {numbers[crossed[row]]}"] if row in crossed else []
        if len(closed) <= MAX_CROSSING_CHECK and crosses_itself(contour.pieces):
            problems.append("touches or crosses itself")
        number = numbers[row]
        listed.append(
            replace(contour, number=number, inside=0 if parent is None else numbers[parent], problems=tuple(problems))
        )
    open_contours = sorted(
        (contour for contour in contours if not contour.closed),
        key=lambda contour: (-round(contour.length, KEY_DECIMALS), *map(rounded, (contour.start, contour.end))),
    )
    return listed + [replace(contour, number=len(listed) + row) for row, contour in enumerate(open_contours, 1)]


def _by_size(contours: Sequence[Contour]) -> list[Contour]:
    """Sort contours by size, largest first; those of equal size by position."""

    def key(contour: Contour) -> tuple[float, ...]:
        return -round(contour.area, KEY_DECIMALS), *rounded(box_of(contour.pieces)[:2]), *rounded(contour.start)

    return sorted(contours, key=key)


def _open_ends(contours: Sequence[Contour]) -> list[tuple[Point, int]]:
    """Return the ends of the open contours, each with the contour's row."""
    return [
        (end, row) for row, contour in enumerate(contours) if not contour.closed for end in (contour.start, contour.end)
    ]


def _with_open_gaps(contours: list[Contour], unit: Unit, tolerance: float) -> list[Contour]:
    """Give each open contour the distance to the nearest loose end, another contour's or its own."""
    ends = _open_ends(contours)
    if not ends:
        return contours
    points = [shapely.Point(end) for end, _ in ends]
    pairs = shapely.STRtree(points).query(points, predicate="dwithin", distance=MAX_TOLERANCE[unit]).T.tolist()
    nearest: dict[int, tuple[float, int]] = {}
    for first, second in pairs:
        (here, row), (there, other) = ends[first], ends[second]
        gap = dist(here, there)
        if first == second or gap <= tolerance or (row == other and gap > contours[row].length / 2.0):
            continue
        nearest[row] = min(nearest.get(row, (gap, other)), (gap, other))
    return [
        contour if row not in nearest else _with_gap(contour, *nearest[row], contours, unit)
        for row, contour in enumerate(contours)
    ]


def _with_gap(contour: Contour, gap: float, other: int, contours: Sequence[Contour], unit: Unit) -> Contour:
    number = contours[other].number
    length = length_text(gap, unit)
    target = "its other end" if number == contour.number else f"chain {number}"
    text = f"gap {length} to {target}: TOLERANCE {_rounded_up(gap, unit)} would join it"
    return replace(contour, open_gap=gap, open_gap_to=number, problems=(*contour.problems, text))


def _rounded_up(gap: float, unit: Unit) -> str:
    """Return a gap rounded up to a TOLERANCE, in program units, that joins it."""
    value = from_mm(gap, unit)
    text = show(value, Kind.LENGTH, unit)
    step = 0.0001 if unit is Unit.IN else 0.001
    return text if float(text) >= value - 1e-9 else show(value + step, Kind.LENGTH, unit)


def _branches(nodes: Sequence[tuple[Point, int]], contours: Sequence[Contour], tolerance: float) -> tuple[Branch, ...]:
    """Return the branches, each with the open contours that end there."""
    ends = _open_ends(contours)
    if not ends or not nodes:
        return tuple(Branch(at, end_count) for at, end_count in nodes)
    tree = shapely.STRtree([shapely.Point(end) for end, _ in ends])
    points = [shapely.Point(at) for at, _ in nodes]
    numbers: dict[int, list[int]] = {}
    reach = BRANCH_REACH * max(tolerance, SAME_POINT)
    for branch, end in tree.query(points, predicate="dwithin", distance=reach).T.tolist():
        numbers.setdefault(branch, []).append(contours[ends[end][1]].number)
    return tuple(
        Branch(at, end_count, tuple(sorted(numbers.get(row, ())))) for row, (at, end_count) in enumerate(nodes)
    )
