"""Reads the entities in a DXF drawing's model space as shapes in its own unit, with the package ezdxf.

Whatever is not taken is counted or reported; what was read is compared with the tags of the file.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from math import dist, isfinite, radians, tau
from typing import TYPE_CHECKING, Any, Final, cast

import numpy as np

from core.geometry.piece import ANGLE_ROUNDING, Line
from core.importing.curves import ends_of_spline
from core.importing.drawing import (
    MAX_BYTES,
    MAX_ENTITIES,
    MAX_INSERT_DEPTH,
    MAX_SHAPES,
    OTHER_UNITS,
    UNIT_CODES,
    BSpline,
    Drawing,
    DrawingError,
    EllipseArc,
    LayeredShape,
    NotFlat,
    Shape,
    StageProgress,
    counted,
    no_stage_progress,
)
from core.importing.dxf_document import Scan, ScannedEntity, damaged_file, document_of, is_dxf, too_much, words_of
from core.tolerance import LARGEST_COORDINATE

if TYPE_CHECKING:
    from ezdxf.document import Drawing as Document
    from ezdxf.entities.dxfgfx import DXFGraphic
    from ezdxf.entities.ellipse import Ellipse
    from ezdxf.entities.insert import Insert
    from ezdxf.entities.lwpolyline import LWPolyline
    from ezdxf.entities.polyline import Polyline
    from ezdxf.entities.spline import Spline
    from ezdxf.math import OCS, Matrix44, Vec3

MAX_FLAT_Z_DIFFERENCE: Final = 1e-4
"""Largest difference in Z of one entity's points, in the drawing's unit; a larger one is a slope, not rounding."""

LARGEST_SAGITTA: Final = 0.005
"""Largest sagitta, in the drawing's unit, of an arc read as a line because its center is out of range."""

ROUNDED_TURN: Final = 1e-4
"""An end within this of a full turn after the begin, in radians, is a full turn whose angles were rounded."""

SPLINE_GAP: Final = 0.01
"""The ends of a closed SPLINE do not meet if they are farther apart than this, in the drawing's unit."""

STEPS_OF_PROGRESS: Final = 100
"""Entities between two calls of the progress callback."""


def read_dxf(data: bytes, name: str, *, damaged: bool = False, progress: StageProgress = no_stage_progress) -> Drawing:
    """Return the drawing in a DXF file's bytes; `name` is the file's name in messages.

    With `damaged`, what can be read of a damaged file is taken.  Raises DrawingError.
    """
    if len(data) > MAX_BYTES:
        raise too_much("bytes", len(data), MAX_BYTES)
    if not is_dxf(data):
        raise DrawingError("NOT_DXF", f"{name} is not a DXF file.")
    progress("reading", 0, 1)
    scan, document = document_of(data, damaged=damaged)
    reader = _Reader(document, progress, damaged=damaged)
    if scan.repaired:
        reader.notes[f"The file is damaged ({scan.repaired}): what could be repaired is taken."] += 1
    elif not scan.whole:
        reader.notes[f"The file breaks off at line {scan.last_line}: what comes after it is missing."] += 1
    for entity in scan.lost:
        reader.notes[f"The {entity.kind} {entity.where} {entity.fault}: it is not read."] += 1
    for section in scan.unknown_sections:
        reader.notes[f"The section {words_of(section)!r} is unknown and is not read."] += 1
    try:
        reader.read(scan)
    except DrawingError:
        raise
    except Exception as error:  # damage may not show before it is used
        raise damaged_file(words_of(error)) from error
    drawing = reader.drawing(scan)
    if not drawing.shapes and not drawing.not_flat:
        raise DrawingError("NO_GEOMETRY", _no_geometry(drawing))
    return drawing


def _no_geometry(drawing: Drawing) -> str:
    text = "There is no line, arc, circle, polyline, ellipse or spline in model space"
    skipped, hidden = drawing.skipped, drawing.hidden
    if skipped:
        text += f": {counted(skipped)} {'was' if sum(skipped.values()) == 1 else 'were'} skipped"
    if hidden:
        count = sum(hidden.values())
        entities = "1 entity is" if count == 1 else f"{count} entities are"
        text += f"{'; ' if skipped else ': '}{entities} frozen, off or invisible"
    return " ".join((f"{text}.", *drawing.notes))


_SKIPPED_ALWAYS: Final = frozenset({"ATTDEF", "VIEWPORT"})


@dataclass(slots=True)
class _Reader:
    """Walks through model space; follows INSERTs with their transformation."""

    document: Document
    progress: StageProgress
    damaged: bool
    shapes: list[LayeredShape] = field(default_factory=list)
    skipped: Counter[str] = field(default_factory=Counter)
    hidden: Counter[str] = field(default_factory=Counter)
    not_flat: list[NotFlat] = field(default_factory=list)
    notes: Counter[str] = field(default_factory=Counter)
    entity_count: int = 0
    heights: list[float] = field(default_factory=list)
    lines: dict[int, ScannedEntity] = field(default_factory=dict)
    layers: dict[str, tuple[bool, bool]] = field(default_factory=dict)
    scanned: dict[str, list[ScannedEntity]] = field(default_factory=dict)
    """The entities of each block that is not compared yet, by the block's name in lower case."""

    def read(self, scan: Scan) -> None:
        """Read every entity of model space; count those of paper space."""
        entities = list(self.document.modelspace())
        if len(entities) > MAX_ENTITIES:
            raise too_much("entities", len(entities), MAX_ENTITIES)
        in_paper = [entity for layout in self.document.layouts if layout.name != "Model" for entity in layout]
        self.scanned = scan.blocks
        self._match(entities, [entity for entity in scan.entities if not entity.paper], in_paper)
        for layer in self.document.layers:
            self.layers[str(layer.dxf.name).lower()] = bool(layer.is_frozen()), bool(layer.is_off())
        for number, entity in enumerate(entities):
            if number % STEPS_OF_PROGRESS == 0:
                self.progress("reading", number, len(entities))
            self._entity(entity, None, None, 0)
        kinds = (entity.dxftype() for entity in in_paper)
        self.skipped.update(f"{kind} in paper space" for kind in kinds if kind not in _SKIPPED_ALWAYS)

    def _match(self, entities: list[DXFGraphic], scanned: list[ScannedEntity], others: Iterable[Any] = ()) -> None:
        """Find the line of each entity, and refuse a file from which ezdxf has lost an entity."""
        if not scanned:
            return
        kinds = [entity.dxftype() for entity in entities]
        if kinds == [entity.kind for entity in scanned]:
            self.lines |= {id(entity): place for entity, place in zip(entities, scanned, strict=True)}
            return
        counts = Counter([*kinds, *(entity.dxftype() for entity in others)])
        lost = {
            kind: count - counts[kind]
            for kind, count in Counter(entity.kind for entity in scanned).items()
            if kind in _CONTOUR_KINDS and count > counts[kind]
        }
        if lost and not self.damaged:
            raise damaged_file(f"{counted(lost)} could not be read", sum(counts.values()))
        if lost:
            self.notes[f"{counted(lost)} could not be read."] += 1

    def drawing(self, scan: Scan) -> Drawing:
        """Return everything that was read."""
        notes = [text if count == 1 else f"{count} times: {text}" for text, count in self.notes.items()]
        if self.heights and max(self.heights) - min(self.heights) > MAX_FLAT_Z_DIFFERENCE:
            low, high = min(self.heights), max(self.heights)
            notes.append(f"The entities lie at heights from Z {low:g} to {high:g}: Z is dropped.")
        code, other = scan.units, ""
        if code not in UNIT_CODES and code:
            other = f"{OTHER_UNITS.get(code, 'unknown')}, $INSUNITS {code}"
            notes.append(f"The drawing has a unit that is not read: {other}.")
        return Drawing(
            UNIT_CODES.get(code),
            tuple(self.shapes),
            dict(self.skipped),
            dict(self.hidden),
            tuple(self.not_flat),
            tuple(notes),
            self.entity_count,
            other,
        )

    def _entity(self, entity: DXFGraphic, matrix: Matrix44 | None, outer_layer: str | None, depth: int) -> None:
        """Read one entity under the transformation of the INSERTs around it."""
        kind = entity.dxftype()
        layer = str(entity.dxf.get("layer", "0")) if entity.dxf.is_supported("layer") else "0"
        if layer == "0" and outer_layer is not None:
            layer = outer_layer
        frozen, off = self.layers.get(layer.lower(), (False, False))
        place = self.lines.get(id(entity))
        if place is not None and place.fault:
            self._unreadable(entity, f"it {place.fault}")
        elif kind not in _CONTOUR_KINDS:
            if kind not in _SKIPPED_ALWAYS:
                self.skipped[kind] += 1
        elif frozen or (off and kind != "INSERT") or entity.dxf.get("invisible", 0):
            self.hidden[layer] += 1
        else:
            try:
                if kind == "INSERT":
                    self._insert(cast("Insert", entity), matrix, layer, depth)
                else:
                    self._take(entity, matrix, layer)
            except DrawingError:
                raise
            except Exception as error:  # noqa: BLE001  # an entity with unforeseen values
                self._unreadable(entity, words_of(error))

    def _take(self, entity: DXFGraphic, matrix: Matrix44 | None, layer: str) -> None:
        """Take the shapes of an entity."""
        kind = entity.dxftype()
        try:
            shapes = list(_READERS[kind](self, entity, matrix))
        except _NotFlatError as error:
            self.not_flat.append(NotFlat(layer, f"The {kind} {self._where(entity)} {error}."))
            return
        if len(self.shapes) + len(shapes) > MAX_SHAPES:
            raise too_much("lines and curves", len(self.shapes) + len(shapes), MAX_SHAPES)
        numbers = [number for shape in shapes for number in _numbers(shape)]
        if not all(map(isfinite, numbers)):
            self._unreadable(entity, "a coordinate is not a number")
            return
        largest = max(numbers, key=abs, default=0.0)
        if abs(largest) > LARGEST_COORDINATE:
            self._too_far(entity, largest)
            return
        self.entity_count += 1
        self.shapes += [LayeredShape(shape, layer, self.entity_count) for shape in shapes]

    def _unreadable(self, entity: DXFGraphic, why: str) -> None:
        text = f"The {entity.dxftype()} {self._where(entity)} cannot be read: {why}"
        if not self.damaged:
            raise damaged_file(text, len(self.document.modelspace()) - 1)
        self.notes[f"{text}."] += 1

    def _too_far(self, entity: DXFGraphic, number: float) -> None:
        far = f"{_grouped_digits(number)}, larger than {_grouped_digits(LARGEST_COORDINATE)}"
        text = f"The {entity.dxftype()} {self._where(entity)} has {far}"
        if not self.damaged:
            limit = "the largest coordinate that can be read. Move or scale it in the drawing"
            raise DrawingError("TOO_FAR", f"{text}, {limit}.", len(self.document.modelspace()) - 1)
        self.notes[f"{text}: it is left out."] += 1

    def _where(self, entity: DXFGraphic) -> str:
        place = self.lines.get(id(entity))
        return place.where if place is not None else f"#{entity.dxf.get('handle', '?')}"

    def _insert(self, insert: Insert, matrix: Matrix44 | None, layer: str, depth: int) -> None:
        """Read the entities of a block, once for each insertion."""
        block = insert.block()
        if block is None:
            self.notes[
                f"INSERT of the block {words_of(insert.dxf.get('name', ''))!r}, which the file does not have."
            ] += 1
            self.skipped["INSERT"] += 1
            return
        if depth >= MAX_INSERT_DEPTH:
            raise DrawingError("TOO_MUCH", f"INSERTs are nested deeper than {MAX_INSERT_DEPTH} blocks.")
        self._match(list(block), self.scanned.pop(str(block.name).lower(), []))
        if not len(block):
            name, head = words_of(insert.dxf.get("name", "")), block.block
            why = "which holds nothing"
            if head is not None and (head.is_xref or head.is_xref_overlay):
                path = head.dxf.get("xref_path", "")
                why = "whose geometry is in another file (XREF)" + (f": {words_of(path)!r}" if path else "")
            self.notes[f"INSERT of the block {name!r}, {why}."] += 1
        if _is_clipped(insert):
            self.notes["An INSERT is clipped (XCLIP): all of its block is taken."] += 1
        rows, columns = insert.dxf.row_count, insert.dxf.column_count
        count = max(insert.mcount, 1)
        if count * max(len(block), 1) > MAX_SHAPES:
            raise too_much("lines and curves", count * len(block), MAX_SHAPES)
        if insert.attribs:
            self.skipped["ATTRIB"] += len(insert.attribs)
        inserts = insert.multi_insert() if count > 1 and rows * columns > 1 else (insert,)
        for single in inserts:
            transform = single.matrix44()
            transform = transform if matrix is None else transform * matrix
            for entity in block:
                self._entity(entity, transform, layer, depth + 1)

    def line(self, entity: DXFGraphic, matrix: Matrix44 | None) -> Iterator[Shape]:
        """Yield a LINE."""
        yield self._straight(_moved(entity.dxf.start, matrix), _moved(entity.dxf.end, matrix))

    def _straight(self, start: Vec3, end: Vec3) -> Line:
        self._level(start.z, end.z)
        return Line((start.x, start.y), (end.x, end.y))

    def _level(self, *heights: float) -> None:
        """Raise if the heights differ; keep the first one."""
        if max(heights) - min(heights) > MAX_FLAT_Z_DIFFERENCE:
            raise _NotFlatError("does not lie in the XY plane")
        self.heights += heights[:1]

    def circle(self, entity: DXFGraphic, matrix: Matrix44 | None) -> Iterator[Shape]:
        """Yield a CIRCLE or an ARC; skip one without a radius."""
        dxf = entity.dxf
        radius = float(dxf.radius)
        if radius <= 0.0:
            article = "An" if entity.dxftype() == "ARC" else "A"
            self.notes[f"{article} {entity.dxftype()} has the radius {radius:g} and is skipped."] += 1
            self.skipped[entity.dxftype()] += 1
            return
        arc = entity.dxftype() == "ARC"
        begin = radians(dxf.start_angle) if arc else 0.0
        end = radians(dxf.end_angle) if arc else tau
        yield self._round(entity.ocs(), dxf.center, radius, _counterclockwise_turn(begin, end), matrix)

    def _round(
        self, ocs: OCS, center: Vec3, radius: float, angles: tuple[float, float], matrix: Matrix44 | None
    ) -> EllipseArc:
        from ezdxf.math import Vec3

        first, second = ocs.to_wcs(Vec3(radius, 0, 0)), ocs.to_wcs(Vec3(0, radius, 0))
        return self._ellipse(ocs.to_wcs(center), first, second, angles, matrix)

    def _ellipse(
        self, center: Vec3, first: Vec3, second: Vec3, angles: tuple[float, float], matrix: Matrix44 | None
    ) -> EllipseArc:
        if matrix is not None:
            center = matrix.transform(center)
            first, second = matrix.transform_direction(first), matrix.transform_direction(second)
        self._level(center.z, center.z + first.z, center.z + second.z)
        return EllipseArc(
            complex(center.x, center.y), complex(first.x, first.y), complex(second.x, second.y), *angles
        )  # fmt: skip

    def ellipse(self, entity: Ellipse, matrix: Matrix44 | None) -> Iterator[Shape]:
        """Yield an ELLIPSE; its parameters count from its major axis."""
        tool = entity.construction_tool()
        angles = _counterclockwise_turn(float(entity.dxf.start_param), float(entity.dxf.end_param))
        yield self._ellipse(tool.center, tool.major_axis, tool.minor_axis, angles, matrix)

    def lwpolyline(self, entity: LWPolyline, matrix: Matrix44 | None) -> Iterator[Shape]:
        """Yield the lines of an LWPOLYLINE, and the arcs of its bulges."""
        dxf = entity.dxf
        rows = entity.get_points("xyseb")
        if dxf.get("const_width", 0.0) or any(start or end for _, _, start, end, _ in rows):
            self.notes["The width of polylines is ignored."] = 1
        vertices = [(x, y, bulge) for x, y, _, _, bulge in rows]
        yield from self._bulged(entity, vertices, float(dxf.get("elevation", 0.0)), matrix, closed=bool(entity.closed))

    def polyline(self, entity: Polyline, matrix: Matrix44 | None) -> Iterator[Shape]:
        """Yield the lines and bulge arcs of a POLYLINE, without the frame of a fitted one; a 3D one must be flat."""
        mode = entity.get_mode()
        if mode not in ("AcDb2dPolyline", "AcDb3dPolyline"):
            raise _NotFlatError("is a mesh, which may leave the XY plane")
        frame = 16
        rows = [vertex.dxf for vertex in entity.vertices if not vertex.dxf.flags & frame]
        if mode == "AcDb3dPolyline" and len(rows) > 1:
            points = [_moved(row.location, matrix) for row in rows]
            ends = points[1:] + points[:1] if entity.is_closed else points[1:]
            yield from (self._straight(start, end) for start, end in zip(points, ends, strict=False))
            return
        if any(row.get("start_width", 0.0) or row.get("end_width", 0.0) for row in rows):
            self.notes["The width of polylines is ignored."] = 1
        vertices = [(row.location.x, row.location.y, row.get("bulge", 0.0)) for row in rows]
        elevation = entity.dxf.get("elevation", None)
        height = 0.0 if elevation is None else elevation.z
        yield from self._bulged(entity, vertices, height, matrix, closed=bool(entity.is_closed))

    def _bulged(
        self,
        entity: DXFGraphic,
        vertices: list[tuple[float, float, float]],
        height: float,
        matrix: Matrix44 | None,
        *,
        closed: bool,
    ) -> Iterator[Shape]:
        from ezdxf.math import Vec3, bulge_to_arc

        ocs = entity.ocs()
        ends = vertices[1:] + vertices[:1] if closed else vertices[1:]
        if len(vertices) < 2:
            self.notes[f"A {entity.dxftype()} has fewer than two points and is skipped."] += 1
            self.skipped[entity.dxftype()] += 1
            return
        for (x, y, bulge), (x_end, y_end, _) in zip(vertices, ends, strict=False):
            if not _is_straight(dist((x, y), (x_end, y_end)), bulge):
                center, begin, end, radius = bulge_to_arc((x, y), (x_end, y_end), bulge)
                middle = Vec3(center.x, center.y, height)
                yield self._round(ocs, middle, radius, _counterclockwise_turn(begin, end), matrix)
            else:
                points = (ocs.to_wcs(Vec3(x, y, height)), ocs.to_wcs(Vec3(x_end, y_end, height)))
                yield self._straight(*(_moved(point, matrix) for point in points))

    def spline(self, entity: Spline, matrix: Matrix44 | None) -> Iterator[Shape]:
        """Yield a SPLINE by its control points, or through its fit points if it has no control points."""
        tool = entity.construction_tool()
        if not entity.control_point_count():
            if entity.closed and not np.allclose(entity.fit_points[0], entity.fit_points[-1]):
                self.notes["A closed SPLINE with fit points only is skipped. Export it with control points."] += 1
                self.skipped["SPLINE"] += 1
                return
            self.notes["A SPLINE has fit points only: the curve through them is calculated."] += 1
        points = [_moved(point, matrix) for point in tool.control_points]
        heights = [point.z for point in points]
        self._level(min(heights), max(heights))
        weights = np.array(tool.weights() or np.ones(len(points)), float)
        knots = np.array(tool.knots(), float)
        flat = np.array([complex(point.x, point.y) for point in points])
        if (weights <= 0.0).any() or (np.diff(knots) < 0.0).any() or len(knots) != len(points) + tool.order:
            raise ValueError("its knots or weights cannot be right")
        shape = BSpline(tool.degree, flat, weights, knots)
        if entity.closed:
            start, end = ends_of_spline(shape)
            if abs(end - start) > SPLINE_GAP:
                where = self._where(entity)
                self.notes[f"The SPLINE {where} is marked closed, but its ends do not meet: it is read as open."] += 1
        yield shape


class _NotFlatError(Exception):
    """An entity lies outside the XY plane; the text says how."""


_READERS: Final[Mapping[str, Callable[[_Reader, Any, Matrix44 | None], Iterator[Shape]]]] = {
    "LINE": _Reader.line,
    "CIRCLE": _Reader.circle,
    "ARC": _Reader.circle,
    "ELLIPSE": _Reader.ellipse,
    "LWPOLYLINE": _Reader.lwpolyline,
    "POLYLINE": _Reader.polyline,
    "SPLINE": _Reader.spline,
}
_CONTOUR_KINDS: Final = frozenset({*_READERS, "INSERT"})


def _is_clipped(insert: Insert) -> bool:
    from ezdxf.xclip import XClip

    return bool(insert.has_extension_dict and XClip(insert).has_clipping_path)


def _moved(point: Vec3, matrix: Matrix44 | None) -> Vec3:
    return point if matrix is None else matrix.transform(point)


def _is_straight(chord: float, bulge: float) -> bool:
    """True if an arc has no length, or is so flat that its center is out of the range of coordinates."""
    return abs(bulge) * chord / 2.0 <= min(chord * chord / (4.0 * LARGEST_COORDINATE), LARGEST_SAGITTA)


def _counterclockwise_turn(begin: float, end: float) -> tuple[float, float]:
    """Return two angles as a counterclockwise turn; equal ones, or ones a full turn apart, give the full circle."""
    swept = (end - begin) % tau
    # not for a begin a full turn after the end: a short arc over angle 0 has such angles
    if swept <= ANGLE_ROUNDING or tau - swept <= ANGLE_ROUNDING or abs(end - begin - tau) <= ROUNDED_TURN:
        swept = tau
    return begin, begin + swept


def _grouped_digits(number: float) -> str:
    """Return a number with commas, such as 20,000,000, or with an exponent if that would be long."""
    return f"{number:,.0f}" if abs(number) < 1e3 * LARGEST_COORDINATE else f"{number:g}"


def _numbers(shape: Shape) -> Iterable[float]:
    """Return the numbers of a shape that must be in the range of coordinates."""
    match shape:
        case Line():
            return (*shape.start, *shape.end)
        case EllipseArc():
            sizes = abs(shape.first), abs(shape.second)
            return (shape.center.real, shape.center.imag, *sizes, shape.begin, shape.end)
        case BSpline():
            arrays = (shape.points.real, shape.points.imag, shape.weights, shape.knots)
            return [float(array.flat[int(np.abs(array).argmax())]) for array in arrays]
