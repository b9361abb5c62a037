"""This module moves, rotates and mirrors blocks, and repeats segments, as one edit.

Results are typed numbers with six decimals.  Calculated fields stay blank if they still give the same contour: the new
contour is solved and compared with the old one, and if it differs, all ends and centers are typed.  `no_longer_typed`
says which segments have lost data in this way.
"""

from __future__ import annotations

from cmath import exp, phase
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import dist, pi, radians
from typing import Final, assert_never

from core.geometry.piece import Arc, Piece, Point, Turn
from core.program.edit import Edited, FormPlace, Refused, renumbered, with_part
from core.program.model import (
    ArcSegment,
    BlendSegment,
    Block,
    ChamferSegment,
    CutterComp,
    Direction,
    LineSegment,
    Number,
    Program,
    Relative,
    Segment,
    changed,
)
from core.program.solve.block import solve_block
from core.program.solve.solved import SolvedBlock, SolvedSegment
from core.units import Unit, from_mm, to_mm

DECIMALS: Final = 6
"""Decimals of the resulting typed numbers."""
SAME_PLACE: Final = 1e-3
"""Millimeters by which six decimals may move a point: their rounding, magnified in calculated values."""
PARALLEL_TO_AXIS: Final = 1e-12
"""Largest sine of an angle that counts as 0 or 180 degrees."""
MAX_COPIES: Final = 400
OPPOSITE_SIDE: Final = {
    CutterComp.LEFT: CutterComp.RIGHT,
    CutterComp.RIGHT: CutterComp.LEFT,
    CutterComp.PROFILE_LEFT: CutterComp.PROFILE_RIGHT,
    CutterComp.PROFILE_RIGHT: CutterComp.PROFILE_LEFT,
}
OPPOSITE_DIRECTION: Final = {Direction.CW: Direction.CCW, Direction.CCW: Direction.CW}


@dataclass(frozen=True, slots=True)
class Motion:
    """A motion of the plane, in millimeters: mirrored in the X axis if `mirrored`, rotated, then shifted.

    `turn` and `shift` are complex numbers; `turn` has the modulus 1.
    """

    turn: complex = 1.0
    shift: complex = 0.0
    mirrored: bool = False

    def point(self, at: Point) -> Point:
        """Return the image of a point."""
        z = complex(*at)
        moved = self.turn * (z.conjugate() if self.mirrored else z) + self.shift
        return moved.real, moved.imag

    def angle(self, degrees: float) -> float:
        """Return the image of a direction, in degrees from 0 up to 360."""
        turned = phase(self.turn) * 180.0 / pi
        return (turned - degrees if self.mirrored else turned + degrees) % 360.0

    def then(self, other: Motion) -> Motion:
        """Return the motion that does this one first, then the other."""
        turn = self.turn.conjugate() if other.mirrored else self.turn
        shift = self.shift.conjugate() if other.mirrored else self.shift
        return Motion(other.turn * turn, other.turn * shift + other.shift, self.mirrored is not other.mirrored)


def shift(x: float, y: float) -> Motion:
    """Return a shift in millimeters."""
    return Motion(shift=complex(x, y))


def rotation(center: Point, degrees: float) -> Motion:
    """Return a counterclockwise rotation about a point (mm)."""
    turn, about = exp(1j * radians(degrees)), complex(*center)
    return Motion(turn, about - turn * about)


def reflection(point: Point, degrees: float) -> Motion:
    """Return a reflection in the line through a point (mm) in this direction."""
    turn, about = exp(2j * radians(degrees)), complex(*point)
    return Motion(turn, about - turn * about.conjugate(), mirrored=True)


def transform_block(program: Program, number: int, motion: Motion) -> Edited:
    """Move a block; a reflection also reverses DIRECTION and CUTTER COMP."""
    block = program.blocks[number - 1]
    solved = solve_block(block, program)
    if (refusal := _undetermined(block, solved)) is not None:
        return refusal
    assert isinstance(block.x_start, Number)
    assert isinstance(block.y_start, Number)
    unit = program.unit
    x, y = motion.point((to_mm(block.x_start.value, unit), to_mm(block.y_start.value, unit)))
    side = OPPOSITE_SIDE.get(block.cutter_comp, block.cutter_comp) if motion.mirrored else block.cutter_comp
    for explicit in (False, True):
        segments = tuple(_transformed(block.segments, solved.segments, motion, unit, explicit=explicit))
        moved_block = replace(
            block, x_start=_typed(x, unit), y_start=_typed(y, unit), cutter_comp=side, segments=segments
        )
        if _equals_moved(solve_block(moved_block, program), solved.segments, motion):
            return with_part(program, FormPlace(number), moved_block)
    return Refused("The block cannot be typed at its new place with six decimals.")


def no_longer_typed(before: Block, after: Block) -> list[int]:
    """Return the segments of a moved block that had typed data which are blank now, such as an angle or TANGENT."""
    pairs = enumerate(zip(before.segments, after.segments, strict=True), 1)
    return [
        number
        for number, (old, new) in pairs
        if any(getattr(old, name) and not getattr(new, name) for name in old.__match_args__)
    ]


def repeat_segments(program: Program, number: int, first: int, last: int, motion: Motion, copies: int) -> Edited:
    """Insert copies of segments `first` to `last` after `last`, each moved on from the one before.

    If a copy does not start at the end of the preceding segment, a LINE leads there.
    """
    block = program.blocks[number - 1]
    if first > last:
        return Refused(f"The last segment, {last}, is before the first, {first}.")
    if not 1 <= first <= last <= len(block.segments):
        return Refused(f"This block has segments 1 to {len(block.segments)}, not {first} to {last}.")
    if not 1 <= copies <= MAX_COPIES:
        return Refused(f"Type a number of copies from 1 to {MAX_COPIES}.")
    if motion.mirrored and copies > 1:
        return Refused("Only one mirrored copy can be made.")
    solved = solve_block(block, program)
    if (refusal := _undetermined(block, solved)) is not None:
        return refusal
    corner = (block.segments[first - 1], block.segments[last - 1])
    if any(isinstance(segment, BlendSegment | ChamferSegment) for segment in corner):
        return Refused("Begin and end the copied segments with a LINE or an ARC.")
    shapes, originals = solved.segments[first - 1 : last], block.segments[first - 1 : last]
    end, copied, step = _known(shapes[-1].end), list[Segment](), Motion()
    for _ in range(copies):
        step = step.then(motion)
        begin = step.point(_known(shapes[0].start))
        copy = list(_transformed(originals, shapes, step, program.unit, explicit=True))
        if dist(begin, end) > SAME_PLACE:
            copy.insert(0, LineSegment(_typed(begin[0], program.unit), _typed(begin[1], program.unit)))
        copied += _with_own_values(copy, shapes, program.unit)
        end = step.point(_known(shapes[-1].end))
    after = (renumbered(segment, last + 1, len(copied)) for segment in block.segments[last:])
    segments = (*block.segments[:last], *copied, *after)
    return with_part(program, FormPlace(number), replace(block, segments=segments))


def _with_own_values(copy: list[Segment], shapes: Sequence[SolvedSegment], unit: Unit) -> list[Segment]:
    """Return a copy whose FEED and Z END are typed where a blank would take other values from the copy before it.

    A LINE that leads to the copy also leads to the height at which the copied segments begin.
    """
    first, last = shapes[0], shapes[-1]
    at = len(copy) - len(shapes)
    if copy[at].feed is None and first.feed is not None and first.feed != last.feed:
        copy[at] = replace(copy[at], feed=_typed(first.feed, unit))
    lead = copy[0]
    if isinstance(lead, LineSegment | ArcSegment) and lead.z_end is None and first.z_start != last.z_end:
        copy[0] = replace(lead, z_end=_typed(first.z_start if at else first.z_end, unit))
    return copy


def _undetermined(block: Block, solved: SolvedBlock) -> Refused | None:
    """Refuse to move a block of which some segment or START is not determined; None if all are."""
    if not (isinstance(block.x_start, Number) and isinstance(block.y_start, Number)):
        return Refused("Type X START and Y START first.")
    if solved.determined < len(block.segments):
        return Refused(f"Segment {solved.determined + 1} is not determined yet: type it first.")
    return None


def _known(point: Point | None) -> Point:
    assert point is not None
    return point


def _typed(millimeters: float, unit: Unit) -> Number:
    # avoid minus zero
    return Number(round(from_mm(millimeters, unit), DECIMALS) + 0.0)


def _transformed(
    segments: Sequence[Segment], shapes: Sequence[SolvedSegment], motion: Motion, unit: Unit, *, explicit: bool
) -> Iterator[Segment]:
    """Yield the moved segments; if `explicit`, every end and center is typed."""
    for segment, shape in zip(segments, shapes, strict=True):
        match segment:
            case LineSegment() | ArcSegment() if not explicit and (moved := _moved_data(segment, motion, unit)):
                yield moved
            case LineSegment():
                x, y = motion.point(_known(shape.end))
                yield LineSegment(_typed(x, unit), _typed(y, unit), segment.z_end, feed=segment.feed)
            case ArcSegment():
                yield _arc(segment, shape, motion, unit)
            case BlendSegment() | ChamferSegment():
                yield segment
            case _:
                assert_never(segment)


def _moved_data(segment: LineSegment | ArcSegment, motion: Motion, unit: Unit) -> LineSegment | ArcSegment | None:
    """Return a segment with its typed numbers moved; None if one has no counterpart, such as X END alone."""
    values = dict[str, object]()
    for names in (("x_end", "y_end"), ("x_center", "y_center"), ("point_x", "point_y"), ("pick_x", "pick_y")):
        x, y = (getattr(segment, name, None) for name in names)
        alone = (x is None) is not (y is None) and abs(motion.turn.imag) > PARALLEL_TO_AXIS
        if alone or not isinstance(x, Number | None) or not isinstance(y, Number | None):
            return None
        at = motion.point((to_mm(x.value if x else 0.0, unit), to_mm(y.value if y else 0.0, unit)))
        values |= {name: _typed(to, unit) for name, old, to in zip(names, (x, y), at, strict=True) if old}
    for name in ("angle", "start_angle"):
        match getattr(segment, name, None):
            case Number(degrees):
                values[name] = Number(round(motion.angle(degrees), DECIMALS))
            case Relative(degrees) if motion.mirrored:
                values[name] = Relative(-degrees)
    if isinstance(segment, ArcSegment) and motion.mirrored:
        values["direction"] = OPPOSITE_DIRECTION[segment.direction]
    return changed(segment, values)


def _arc(segment: ArcSegment, shape: SolvedSegment, motion: Motion, unit: Unit) -> ArcSegment:
    direction = OPPOSITE_DIRECTION[segment.direction] if motion.mirrored else segment.direction
    x, y = motion.point(_known(shape.end))
    moved_arc = ArcSegment(direction, _typed(x, unit), _typed(y, unit), segment.z_end, feed=segment.feed)
    if isinstance(shape.sharp, Arc):
        x, y = motion.point(shape.sharp.center)
        sweep = segment.sweep if shape.sharp.start == shape.sharp.end else None
        moved_arc = replace(moved_arc, x_center=_typed(x, unit), y_center=_typed(y, unit), sweep=sweep)
    return moved_arc


def _equals_moved(new: SolvedBlock, before: Sequence[SolvedSegment], motion: Motion) -> bool:
    """True if a block equals the moved old one."""
    pairs = zip(new.segments, before, strict=True)
    return new.determined == len(before) and all(
        _same(new_segment.sharp, old_segment.sharp, motion) for new_segment, old_segment in pairs
    )


def _same(new: Piece | None, old: Piece | None, motion: Motion) -> bool:
    if new is None or old is None:
        return new is None and old is None
    if type(new) is not type(old):
        return False
    ends = zip((new.start, new.end), (old.start, old.end), strict=True)
    if any(dist(new_end, motion.point(old_end)) > SAME_PLACE for new_end, old_end in ends):
        return False
    if not (isinstance(new, Arc) and isinstance(old, Arc)):
        return True
    turn = Turn(-old.turn) if motion.mirrored else old.turn
    if new.turn is not turn or (new.start == new.end) is not (old.start == old.end):
        return False
    return dist(new.center, motion.point(old.center)) <= SAME_PLACE
