"""The calculated fields: a block with every blank that the typed fields determine.

A segment starts where the one before it ends.  Of its own fields those that are blank are calculated as
`Solved`; Z END and FEED carry over from the segment before, on the first from Z BOTTOM and PLUNGE FEED.  A blank
X END or Y END does not carry over: the line or arc then is not determined, and says what is missing.  Where two
solutions fit, the order is documented in `solve_line` and `solve_arc`, and the segment's `choice` picks.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import compress, count
from math import hypot
from operator import is_, is_not

from core.geometry.piece import Piece
from core.program.model import BlendSegment, Block, Program
from core.program.solve.blend import Blends, blended
from core.program.solve.segment import Draft, Here, carried, drafted
from core.program.solve.solved import SolvedBlock, SolvedSegment
from core.program.solve.start import Start, made_of, solve_start
from core.tolerance import CLOSED


@dataclass(frozen=True, eq=False, slots=True)
class Making:
    """What a block was solved from and by way of, for the block that an edit makes of it."""

    block: Block
    program: Program
    start: Start
    drafts: list[Draft]


def solve_block(block: Block, program: Program, before: SolvedBlock | None = None) -> SolvedBlock:
    """The block with its blanks calculated; trouble is in its findings, never raised.

    START and segments that are the same objects as in `before`, and begin with the same, are taken from there.
    """
    old = None if before is None else before.making
    start = _start(block, program, old)
    drafts = _drafts(block, program, start, old)
    segments, others = _segments(block, drafts, before)
    determined, pieces = _surface(segments, others, before)
    known = start.known
    return SolvedBlock(
        values=start.values,
        segments=tuple(segments),
        closed=determined == len(segments) and _closed(segments),
        determined=determined,
        tool_diameter=start.tool.diameter,
        tool_type=start.tool.type,
        finish_diameter=start.finish.diameter,
        z_start=known.get("z_start"),
        z_bottom=known.get("z_bottom"),
        plunge_feed=known.get("plunge_feed"),
        speed=known.get("speed"),
        peck_depth=known.get("peck_depth", 0.0),
        findings=start.findings,
        pieces=pieces,
        making=Making(block, program, start, drafts),
    )


def _others(new: Sequence[object], old: Sequence[object]) -> list[int]:
    """Indices of those that are not the same objects as before in their places."""
    return [*compress(count(), map(is_not, new, old)), *range(len(old), len(new))]


def _start(block: Block, program: Program, old: Making | None) -> Start:
    """START of a block, the one of before if all it is made of are the same objects."""
    if old is not None and all(map(is_, made_of(block, program), made_of(old.block, old.program))):
        return old.start
    return solve_start(block, program)


def _surface(
    segments: list[SolvedSegment], others: list[int], before: SolvedBlock | None
) -> tuple[int, tuple[tuple[int, Piece], ...]]:
    """How many segments from the first on are determined, and their pieces with their numbers.

    `others` are indices of all segments that are not those of `before`.
    """
    if before is not None and len(before.pieces) == len(before.segments) == len(segments):
        # every segment had its piece
        pieces = [*before.pieces]
        for index in others:
            one = segments[index]
            if one.start is None or one.end is None or one.piece is None:
                break
            pieces[index] = one.number, one.piece
        else:
            return len(segments), tuple(pieces)
    undetermined = (index for index, one in enumerate(segments) if one.start is None or one.end is None)
    determined = next(undetermined, len(segments))
    return determined, tuple((one.number, one.piece) for one in segments[:determined] if one.piece is not None)


def _closed(segments: list[SolvedSegment]) -> bool:
    """Whether the last programmed end is START again; a contour without any length is not closed."""
    if not any(segment.piece for segment in segments):
        return False
    first, last = segments[0].start, segments[-1].end
    if first is None or last is None:
        return False
    return hypot(last[0] - first[0], last[1] - first[1]) <= CLOSED


def _segments(block: Block, drafts: list[Draft], before: SolvedBlock | None) -> tuple[list[SolvedSegment], list[int]]:
    """Every segment, and the indices of those that are not the objects they were `before`.

    A segment stands as it was where it is the same draft and no blend makes anything else of it than before.
    """
    others = _others(drafts, () if before is None else before.making.drafts)
    blends = None
    if _blending(block) or (before is not None and _blending(before.making.block)):
        blends = _blends(block, drafts)
        others = sorted({*others, *_reblended(drafts, blends, () if before is None else before.segments)})
    segments = [] if before is None else [*before.segments[: len(drafts)]]
    for index in others:
        segments[index : index + 1] = [_finished(drafts[index], index, blends)]
    return segments, others


def _blending(block: Block) -> bool:
    return BlendSegment in map(type, block.segments)


def _blends(block: Block, drafts: list[Draft]) -> Blends:
    """The surface with its blends."""
    pieces = [draft.shape.piece for draft in drafts]
    blend = [index for index, segment in enumerate(block.segments) if isinstance(segment, BlendSegment)]
    radii = {index: drafts[index].reading.known["radius"] for index in blend if "radius" in drafts[index].reading.known}
    shapes = (draft.shape for draft in drafts)
    lengthless = (index for index, shape in enumerate(shapes) if shape.piece is None and shape.end is not None)
    return blended(block.segments, blend, pieces, radii, frozenset(lengthless).difference(blend))


def _reblended(drafts: list[Draft], blends: Blends, before: Sequence[SolvedSegment]) -> list[int]:
    """Indices of segments of which blends make something else than they did before, and of blends not in place."""
    off = blends.faults.keys() | blends.waiting
    each = enumerate(zip(drafts, blends.pieces, before, strict=False))
    return [
        index
        for index, (draft, piece, old) in each
        if old.piece is not piece or old.end is not draft.shape.end or index in off
    ]


def _drafts(block: Block, program: Program, start: Start, before: Making | None) -> list[Draft]:
    """Every segment solved by itself; those that are kept, and take over what they took, are taken run by run."""
    here = Here(start.point, start.known.get("z_bottom"), start.known.get("plunge_feed"))
    segments, unit = block.segments, program.unit
    kept = before.drafts if before is not None and before.program.unit is unit else []
    anew = _others(segments, before.block.segments if before is not None and kept else ())
    drafts: list[Draft] = []
    for index in (*anew, len(segments)):
        while len(drafts) < index:
            old = kept[len(drafts)]
            # behind a segment that is kept it is the same object
            if old.here is here or old.here == here:
                drafts += kept[len(drafts) : index]
            elif old.here.point == here.point:
                drafts.append(carried(old, here))
            else:
                drafts.append(drafted(segments[len(drafts)], len(drafts) + 1, here, unit))
            here = drafts[-1].ahead
        if index < len(segments):
            drafts.append(drafted(segments[index], index + 1, here, unit))
            here = drafts[-1].ahead
    return drafts


def _finished(draft: Draft, index: int, blends: Blends | None) -> SolvedSegment:
    shape, here, ahead = draft.shape, draft.here, draft.ahead
    piece, end, told = shape.piece, shape.end, shape.findings
    if blends is not None:
        piece, fault = blends.pieces[index], blends.faults.get(index)
        end = None if index in blends.waiting else end
        told = told if fault is None else (*told, fault)
    own = tuple(replace(finding, segment=index + 1) for finding in told) if told else ()
    return SolvedSegment(
        index + 1,
        draft.reading.values,
        piece,
        shape.missing,
        shape.choices,
        here.point,
        end,
        shape.sketch,
        here.z or 0.0,
        ahead.z or 0.0,
        ahead.feed,
        draft.reading.findings + own,
    )
