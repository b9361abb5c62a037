"""Turns a drawing's shapes into contours: scaled to millimeters, cleaned, chained, joined, nested and sorted.

`contours_of` is all that an import screen or command needs; it takes a drawing as read and the operator's options.  The
operator may then change each contour: its start, its direction, arcs for its runs of short lines.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import product
from math import dist
from typing import Final

import numpy as np
import shapely

from core.geometry.distance import distance, foot
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Point, Side, Turn, signed_area
from core.geometry.piece_arrays import piece_arrays
from core.importing.arc_fitting import Fitted, fit_arcs
from core.importing.clean_up import Cleaned, LayeredPiece, clean_up, is_circle
from core.importing.curves import moved_piece, pieces_of_ellipse, pieces_of_spline
from core.importing.drawing import BSpline, Drawing, DrawingError, DrawingUnit, Drawn, EllipseArc, Progress, silent
from core.importing.joints import joined_chain, reversed_pieces
from core.importing.loops import Chain, chained
from core.importing.nesting import box_of, boxes_of, containers, crosses_itself, crossings
from core.importing.nodes import KEY_DECIMALS, SAME_POINT
from core.program.fields import LARGEST_LENGTH
from core.units import Kind, Unit, decimals_shown, from_mm, length_text, show


class ContourKind(StrEnum):
    """The kind of a contour by its nesting."""

    OUTSIDE = "OUTSIDE"
    HOLE = "HOLE"
    ISLAND = "ISLAND"
    OPEN = "OPEN"


@dataclass(frozen=True, eq=False, slots=True)
class Contour:
    """One contour in millimeters, in its direction of travel, from its start.

    `number` counts from 1 in list order.  `drawn` is the number of pieces in the drawing, before a start in the middle
    of one divides it.  `gap` is the largest gap closed in it.  `inside` is the number of the contour around it,
    0 for none; `depth` counts the contours around it.  `open_gap` is the distance of an open contour's nearest end from
    another loose end, that of contour `open_gap_to`.  `fitted` is the result of FIT ARCS.
    """

    number: int
    pieces: tuple[Piece, ...]
    closed: bool
    kind: ContourKind
    layers: tuple[str, ...]
    drawn: int
    gap: float = 0.0
    depth: int = 0
    inside: int = 0
    open_gap: float | None = None
    open_gap_to: int = 0
    problems: tuple[str, ...] = ()
    fitted: Fitted | None = None

    @property
    def layer(self) -> str:
        """The layer's name in a list, with a plus sign if there are more."""
        return self.layers[0] + ("+" if len(self.layers) > 1 else "")

    @property
    def length(self) -> float:
        """Length in millimeters."""
        return sum(piece.length for piece in self.pieces)

    @property
    def area(self) -> float:
        """The area inside a closed contour in square millimeters, 0 for an open one."""
        return abs(signed_area(self.pieces)) if self.closed else 0.0

    @property
    def size(self) -> tuple[float, float]:
        """Width and height in millimeters."""
        left, bottom, right, top = box_of(self.pieces)
        return right - left, top - bottom

    @property
    def start(self) -> Point:
        """The start point."""
        return self.pieces[0].start

    @property
    def turn(self) -> Turn:
        """The direction of travel; NONE for an open contour."""
        if not self.closed:
            return Turn.NONE
        return Turn.CCW if signed_area(self.pieces) > 0.0 else Turn.CW

    @property
    def side(self) -> Side | None:
        """The proposed side of the tool: inside a hole, outside any other closed contour; None for an open one."""
        if not self.closed:
            return None
        outside = self.kind is not ContourKind.HOLE
        return Side.LEFT if outside is (self.turn is Turn.CW) else Side.RIGHT

    @property
    def circle(self) -> float | None:
        """The radius of a contour that is one full circle, None for any other."""
        piece = self.pieces[0]
        return piece.radius if len(self.pieces) == 1 and is_circle(piece) else None


def rounded(point: Point) -> tuple[float, float]:
    """Return a point rounded for sorting."""
    return round(point[0], KEY_DECIMALS), round(point[1], KEY_DECIMALS)


def reversed_contour(contour: Contour) -> Contour:
    """Return the contour traveled the other way; a closed one keeps its start, and its proposed side changes."""
    return replace(contour, pieces=reversed_pieces(contour.pieces))


def traveled_like(contour: Contour, other: Contour) -> Contour:
    """Give a contour the direction and the start of another one along the same line."""
    turned = contour if contour.turn is other.turn else reversed_contour(contour)
    return turned if turned.start == other.start else started_at(turned, other.start)


def started_at_usual_place(contour: Contour) -> Contour:
    """Start a closed contour at the middle of its longest line (or arc), a circle at its leftmost point."""
    if not contour.closed:
        return contour
    circle = contour.pieces[0]
    if len(contour.pieces) == 1 and is_circle(circle):
        start = (circle.center[0] - circle.radius, circle.center[1])
        return replace(contour, pieces=(replace(circle, start=start, end=start),))
    contour = _undivided(contour)
    lines = [row for row, piece in enumerate(contour.pieces) if isinstance(piece, Line)]
    rows = lines or list(range(len(contour.pieces)))
    longest = max(contour.pieces[row].length for row in rows)
    equal = [row for row in rows if contour.pieces[row].length >= longest - 10.0**-KEY_DECIMALS]
    row = min(equal, key=lambda row: tuple(reversed(rounded(contour.pieces[row].point_at(0.5)))))
    return _started_on(contour, row, 0.5)


def started_at(contour: Contour, point: Point) -> Contour:
    """Start a closed contour where it is nearest to a point, an open one at the nearer of its ends."""
    if not contour.closed:
        first, last = (dist(point, end) for end in (contour.pieces[0].start, contour.pieces[-1].end))
        return contour if first <= last else reversed_contour(contour)
    whole = _undivided(contour)
    pieces = piece_arrays(Path.from_pieces(whole.pieces))
    points = np.full(len(pieces), complex(*point))
    nearest = int(distance(pieces, points).argmin())
    return _started_on(whole, int(pieces.rows[nearest]), float(foot(pieces, points)[nearest]))


def started_at_corner(contour: Contour, step: int) -> Contour:
    """Start a closed contour at the corner that is `step` corners after (or before, if negative) its start."""
    if not contour.closed or contour.circle is not None:
        return contour
    whole = _undivided(contour)
    # a start between two corners first goes to the end of its piece, in the step's direction
    ahead = step - 1 if len(whole.pieces) < len(contour.pieces) and step > 0 else step
    return _started_on(whole, (ahead + (0 if whole is contour else 1)) % len(whole.pieces), 0.0)


def started_at_side(contour: Contour, step: int) -> Contour:
    """Start a closed contour at the middle of the piece that is `step` pieces after (or before) the one it starts on.

    From a corner the first step leads to the middle of the piece that begins there.  A circle moves by quarter turns.
    """
    if not contour.closed:
        return contour
    if contour.circle is not None:
        circle = contour.pieces[0]
        return started_at(contour, circle.point_at((step % 4) / 4.0))
    whole = _undivided(contour)
    ahead = step if len(whole.pieces) < len(contour.pieces) or step < 0 else step - 1
    return _started_on(whole, ahead % len(whole.pieces), 0.5)


def _undivided(contour: Contour) -> Contour:
    """Rejoin the piece that the contour's start divides: the contour then starts at that piece's beginning."""
    first, last = contour.pieces[0], contour.pieces[-1]
    if len(contour.pieces) <= contour.drawn:
        return contour
    return replace(contour, pieces=(replace(first, start=last.start), *contour.pieces[1:-1]))


def _started_on(contour: Contour, row: int, share: float) -> Contour:
    """Start an undivided closed contour at a fraction of one of its pieces, which is divided there."""
    pieces, piece = contour.pieces, contour.pieces[row]
    if contour.circle is not None:
        point = piece.point_at(share)
        return replace(contour, pieces=(replace(piece, start=point, end=point),))
    if min(share, 1.0 - share) * piece.length <= SAME_POINT:
        row = row if share < 0.5 else (row + 1) % len(pieces)
        return replace(contour, pieces=(*pieces[row:], *pieces[:row]))
    middle = piece.point_at(share)
    first, second = replace(piece, end=middle), replace(piece, start=middle)
    return replace(contour, pieces=(second, *pieces[row + 1 :], *pieces[:row], first))


def fitted_contour(contour: Contour, fit: float) -> Contour:
    """Fit arcs to the contour's runs of short lines; `fitted` then holds the result."""
    whole = _undivided(contour)
    fitted = fit_arcs(whole.pieces, fit, closed=contour.closed)
    made = replace(whole, pieces=fitted.pieces, drawn=len(fitted.pieces), fitted=replace(fitted, before=contour.drawn))
    return started_at_usual_place(made)


def fit_sentence(contour: Contour, unit: Unit) -> str:
    """Return the result of FIT ARCS on a contour, such as `3000 lines -> 1 ARC, off by 0.0000`."""
    fitted = contour.fitted
    if fitted is None:
        return ""
    arcs = sum(isinstance(piece, Arc) for piece in fitted.pieces)
    lines = len(fitted.pieces) - arcs
    parts = [f"{count} {name}{'S' if count > 1 else ''}" for count, name in ((arcs, "ARC"), (lines, "LINE")) if count]
    off = length_text(fitted.off, unit)
    return f"{fitted.before} lines -> {' and '.join(parts)}, off by {off}"


def joined_open(first: Contour, second: Contour, tolerance: float) -> Contour | None:
    """Join two open contours at a branch, as the operator chose.  None if their ends do not meet."""
    ways = ((contour.pieces, reversed_pieces(contour.pieces)) for contour in (first, second))
    for before, after in product(*ways):
        if dist(before[-1].end, after[0].start) <= tolerance:
            closed = dist(after[-1].end, before[0].start) <= tolerance
            joined = joined_chain((*before, *after), closed=closed, tolerance=tolerance)
            layers = tuple(dict.fromkeys((*first.layers, *second.layers)))
            kind = ContourKind.OUTSIDE if closed else ContourKind.OPEN
            return replace(
                first, pieces=joined.pieces, closed=closed, kind=kind, layers=layers, drawn=len(joined.pieces)
            )  # fmt: skip
    return None


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
    ways: int
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


def contours_of(drawing: Drawing, options: ImportOptions, progress: Progress = silent) -> ContourList:
    """Return the contours of a drawing; DrawingError NOT_FLAT if a chosen layer has an entity outside the plane."""
    for entity in drawing.not_flat:
        if options.layers is None or entity.layer in options.layers:
            raise DrawingError("NOT_FLAT", entity.text)
    shapes = [drawn for drawn in drawing.shapes if options.layers is None or drawn.layer in options.layers]
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
    chains = ((chain, items) for items, result in zip(groups, results, strict=True) for chain in result.chains)
    contours = [contour for each in chains if (contour := _contour(*each, options.tolerance)).pieces]
    progress("nesting", 0, 1)
    ordered = _with_open_gaps(_nested(contours), options.program_unit, options.tolerance)
    return ContourList(
        drawing,
        options,
        tuple(ordered),
        cleaned,
        max((contour.gap for contour in ordered), default=0.0),
        _branches(results[0].branches, ordered, options.tolerance),
        tuple(notes),
    )


def _pieces(shapes: Sequence[Drawn], options: ImportOptions, progress: Progress) -> list[LayeredPiece]:
    """Return the shapes as pieces in millimeters, with curves as arcs."""
    scale, pieces = options.unit.mm, list[LayeredPiece]()
    for number, drawn in enumerate(shapes):
        if number % 100 == 0:
            progress("fitting", number, len(shapes))
        pieces += [LayeredPiece(piece, drawn.layer, drawn.entity) for piece in _scaled(drawn, scale, options.fit)]
    return pieces


def _scaled(drawn: Drawn, scale: float, fit: float) -> Sequence[Piece]:
    match drawn.shape:
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
    rest = [contour for contour in listed.contours if contour not in pair]
    # without the values that depend on the rest of the list
    made = [replace(each, problems=(), open_gap=None, open_gap_to=0) for each in (*rest, replace(joined, number=0))]
    contours = _with_open_gaps(_nested(made), unit, tolerance)
    nodes = [(branch.at, branch.ways) for branch in listed.branches]
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
            wanted = Turn.CCW if kind is ContourKind.HOLE else Turn.CW
            contour = started_at_usual_place(contour if contour.turn is wanted else reversed_contour(contour))
        problems = [f"touches or crosses chain {numbers[crossed[row]]}"] if row in crossed else []
        if len(closed) <= MAX_CROSSING_CHECK and crosses_itself(contour.pieces):
            problems.append("touches or crosses itself")
        number = numbers[row]
        listed.append(
            replace(contour, number=number, inside=0 if parent is None else numbers[parent], problems=tuple(problems))
        )
    open_contours = sorted((contour for contour in contours if not contour.closed), key=_by_length)
    return listed + [replace(contour, number=len(listed) + row) for row, contour in enumerate(open_contours, 1)]


def _by_size(contours: Sequence[Contour]) -> list[Contour]:
    """Sort contours by size, largest first; those of equal size by position."""
    keys = [
        (-round(contour.area, KEY_DECIMALS), rounded(box[:2]), rounded(contour.start))
        for contour, box in zip(contours, boxes_of([contour.pieces for contour in contours]), strict=True)
    ]
    return [contours[row] for row in sorted(range(len(contours)), key=keys.__getitem__)]


def _by_length(contour: Contour) -> tuple[float, ...]:
    return -round(contour.length, KEY_DECIMALS), *rounded(contour.start), *rounded(contour.pieces[-1].end)


def _open_ends(contours: Sequence[Contour]) -> list[tuple[Point, int]]:
    """Return the ends of the open contours, each with the contour's row."""
    return [
        (end, row)
        for row, contour in enumerate(contours)
        if not contour.closed
        for end in (contour.pieces[0].start, contour.pieces[-1].end)
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
        return tuple(Branch(at, ways) for at, ways in nodes)
    tree = shapely.STRtree([shapely.Point(end) for end, _ in ends])
    points = [shapely.Point(at) for at, _ in nodes]
    numbers: dict[int, list[int]] = {}
    reach = BRANCH_REACH * max(tolerance, SAME_POINT)
    for branch, end in tree.query(points, predicate="dwithin", distance=reach).T.tolist():
        numbers.setdefault(branch, []).append(contours[ends[end][1]].number)
    return tuple(Branch(at, ways, tuple(sorted(numbers.get(row, ())))) for row, (at, ways) in enumerate(nodes))
