"""This module solves a block: it reads START and calculates every blank field that the typed fields determine.

A segment starts where the one before it ends.  Its blank fields are calculated as `Solved`, together with those of
later segments where they depend on each other (`run_of_segments`).  Z END and FEED carry over from the segment before;
those of the first segment come from Z BOTTOM and the tool's FEED, else PLUNGE FEED.  A LINE whose only typed shape
field is X END or Y END keeps the other coordinate.  No other blank X END or Y END carries over: the line or arc is then
undetermined, and a finding says what is missing.  If two solutions fit, the segment's `choice` picks one, in the order
that `rules` documents.

BLEND ARCs and CHAMFERs go at the corner of their two neighbors and shorten both.  They are inserted in the order of the
segments; a neighbor that is already shortened is shortened further.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from dataclasses import dataclass, field, replace
from itertools import takewhile
from math import dist
from typing import Final, assert_never

from core.finding import Finding, Severity
from core.geometry.corner import NoCorner, Reason, chamfer, fillet
from core.geometry.piece import Piece
from core.program.fields import FIELDS_OF_FORM, Form, field_of, form_of, typed_trouble
from core.program.model import BlendSegment, Block, Coolant, CornerSegment, CutterComp, Number, Program, Segment, Tool
from core.program.solve.reading import Reading, read_form, usable
from core.program.solve.run_of_segments import TypedContour, reference_faults, run_at
from core.program.solve.segment import Carried, Draft, solve_segment, typed_point
from core.program.solve.solved import Origin, SolvedBlock, SolvedRun, SolvedSegment
from core.program.tools import CalledTool, called_tool
from core.tolerance import CLOSED
from core.units import Unit

NEEDED_FIELDS: Final = ("tool", "x_start", "y_start", "z_start", "z_bottom", "plunge_feed", "speed")
"""The fields of START that must be typed, or proposed by TOOL SETUP."""

FINISH_VALUES: Final = ("speed", "feed", "plunge_feed", "coolant")
"""The values that TOOL SETUP keeps for a tool; a block uses the same ones for both of its tools."""

TOOL_VALUES: Final = ("speed", "plunge_feed")
"""The needed fields of START that TOOL SETUP proposes."""

ZERO_IF_BLANK: Final = ("finish_tool", "peck_depth")
"""The fields of START in which a blank means 0: no finish tool, full depth in one pass."""


def solve_block(block: Block, program: Program) -> SolvedBlock:
    """Return the block with its blanks calculated; problems become findings and are never raised."""
    start = _start(block, program)
    drafts, runs = _drafts(block, program.unit, start)
    corners, adjusted = _corners(block.segments, drafts), _adjustment(drafts)
    segments = tuple(_segment(index, draft, corners, adjusted.get(index)) for index, draft in enumerate(drafts))
    determined = list(takewhile(lambda segment: segment.start is not None and segment.end is not None, segments))
    known, (coolant, coolant_origin) = start.reading.known, start.coolant
    return SolvedBlock(
        values=start.reading.values,
        segments=segments,
        closed=len(determined) == len(segments) and _closed(segments),
        determined=len(determined),
        tool_diameter=start.tool.diameter,
        tool_type=start.tool.type,
        finish_diameter=start.finish.diameter,
        z_start=known.get("z_start"),
        z_bottom=known.get("z_bottom"),
        plunge_feed=known.get("plunge_feed"),
        speed=known.get("speed"),
        peck_depth=known.get("peck_depth", 0.0),
        findings=start.findings,
        coolant=coolant,
        coolant_origin=coolant_origin,
        pieces=tuple((segment.number, segment.piece) for segment in determined if segment.piece is not None),
        runs=runs,
    )


def _closed(segments: Sequence[SolvedSegment]) -> bool:
    """True if the last programmed end is back at START; a contour without length is not closed."""
    if not any(segment.piece for segment in segments):
        return False
    first, last = segments[0].start, segments[-1].end
    return first is not None and last is not None and dist(first, last) <= CLOSED


def _drafts(block: Block, unit: Unit, start: _Start) -> tuple[list[Draft], tuple[SolvedRun, ...]]:
    """Solve every segment, by itself or in a run, each from the end of the one before it; return drafts and runs."""
    known = start.reading.known
    point = (known["x_start"], known["y_start"]) if "x_start" in known and "y_start" in known else None
    typed = typed_point(start.reading.values, ("x_start", "y_start"))
    feed, origin = start.feed
    carried = Carried(point, typed, known.get("z_bottom"), feed, feed_origin=origin)
    numbered = enumerate(block.segments, 1)
    readings = [read_form(form_of(segment), segment, unit, number) for number, segment in numbered]
    drafts: list[Draft] = []
    runs: list[SolvedRun] = []
    contour = TypedContour(block.segments, readings, drafts, unit)
    while len(drafts) < len(readings):
        index = len(drafts)
        own_draft = solve_segment(block.segments[index], readings[index].copy(), carried, unit)
        new_drafts, run = run_at(contour, index, own_draft) or ((own_draft,), None)
        drafts += new_drafts
        runs += [run] if run is not None else []
        carried = drafts[-1].after
    for index, item in enumerate(drafts):
        findings = (*reference_faults(contour, index), *item.result.findings)
        drafts[index] = replace(item, result=replace(item.result, findings=findings))
    return drafts, tuple(runs)


def _adjustment(drafts: Sequence[Draft]) -> dict[int, Finding]:
    """Report once that arcs were fitted to their numbers, at the index of the segment that differs most."""
    adjusted = {index: finding for index, item in enumerate(drafts) if (finding := item.result.adjustment) is not None}
    if not adjusted:
        return {}
    worst = max(adjusted, key=lambda index: adjusted[index].value or 0.0)
    finding = adjusted[worst]
    others = len(adjusted) - 1
    more = f" {others} more {'arc differs' if others == 1 else 'arcs differ'} by less." if others else ""
    return {worst: replace(finding, text=finding.text + more)}


def _segment(index: int, draft: Draft, corners: Corners, adjusted: Finding | None) -> SolvedSegment:
    result, before, after = draft.result, draft.before, draft.after
    findings = [finding for finding in (*result.findings, corners.faults.get(index), adjusted) if finding is not None]
    return SolvedSegment(
        number=index + 1,
        values=draft.reading.values,
        piece=corners.pieces[index],
        missing=result.missing,
        choices=result.choices,
        start=before.point,
        end=None if index in corners.waiting else result.end,
        sketch=result.sketch,
        z_start=before.z or 0.0,
        z_end=after.z or 0.0,
        feed=after.feed,
        sharp=result.piece,
        findings=(*draft.reading.findings, *(replace(finding, segment=index + 1) for finding in findings)),
    )


@dataclass(frozen=True, slots=True)
class _Start:
    """START: its fields, its tools, and what the segments take over from it."""

    reading: Reading
    tool: CalledTool
    finish: CalledTool
    findings: tuple[Finding, ...]
    feed: tuple[float | None, Origin]
    """The feed of the segments before the first typed FEED, and its origin."""
    coolant: tuple[Coolant, Origin | None]


def _start(block: Block, program: Program) -> _Start:
    """Read START of a block, with blanks filled by defaults and TOOL SETUP."""
    reading = read_form(Form.START, block, program.unit, 0)
    severity = Severity.WARNING if block.cutter_comp is CutterComp.ON else Severity.ERROR
    tool = called_tool(program, block.tool, "tool", severity)
    finish = called_tool(program, block.finish_tool, "finish_tool", severity)
    for name in ZERO_IF_BLANK:
        reading.fill(name, 0.0, Origin.USUAL)
    proposed = _propose(reading, tool.tool, program.unit)
    # wrong entries come before missing ones: only a few findings are visible at once
    trouble = (
        *tool.findings,
        *finish.findings,
        *(_finish_values(block, tool.tool, finish.tool) if isinstance(block.tool, Number) else ()),
        *_depths(reading.known),
        *_missing(reading, tool.tool, program.unit),
        *_empty(block),
    )
    plunge_feed = reading.known.get("plunge_feed")
    feed = (plunge_feed, Origin.CALCULATED) if proposed is None else (proposed, Origin.TOOL)
    return _Start(reading, tool, finish, reading.findings + trouble, feed, _coolant(block, tool.tool))


def _propose(reading: Reading, tool: Tool | None, unit: Unit) -> float | None:
    """Fill blanks of START with the tool table's proposals; return the feed it proposes (mm/min), if any."""
    if tool is None:
        return None
    for name in TOOL_VALUES:
        typed = getattr(tool, name)
        known = usable(field_of(Form.TOOL, name), typed, unit)
        if known is not None and reading.values[name] is None:
            reading.known[name] = known
            reading.fill(name, typed.value, Origin.TOOL)
    return usable(field_of(Form.TOOL, "feed"), tool.feed, unit)


def _coolant(block: Block, tool: Tool | None) -> tuple[Coolant, Origin | None]:
    if block.coolant is not None:
        return block.coolant, None
    if tool is not None and tool.coolant is not None:
        return tool.coolant, Origin.TOOL
    return Coolant.OFF, Origin.USUAL


def _finish_values(block: Block, tool: Tool | None, finish: Tool | None) -> tuple[Finding, ...]:
    """Warn if TOOL SETUP has other speed, feeds or coolant for the finish tool than the block, which it cuts with."""
    if finish is None or finish is tool:
        return ()
    used = {name: getattr(block, name, None) or getattr(tool, name, None) for name in FINISH_VALUES}
    others = [name for name in FINISH_VALUES if getattr(finish, name) not in (None, used[name])]
    if not others:
        return ()
    labels = ", ".join(field_of(Form.TOOL, name).label.partition(" (")[0] for name in others)
    text = (
        f"Finish tool {finish.number} cuts with this block's values; TOOL SETUP has another {labels} for it. "
        f"A block of its own with TOOL {finish.number} takes those."
    )
    return (Finding("FINISH_VALUES", Severity.WARNING, text, 0, "finish_tool"),)


def _missing(reading: Reading, tool: Tool | None, unit: Unit) -> Iterator[Finding]:
    """Report the blank fields of START that are needed: there is no proposal, or it cannot be used."""
    for name in NEEDED_FIELDS:
        if reading.values[name] is not None:
            continue
        field = field_of(Form.START, name)
        proposal = None if tool is None or name not in TOOL_VALUES else getattr(tool, name)
        trouble = None if proposal is None else typed_trouble(field, proposal, unit)
        if tool is None or trouble is None:
            text = f"{field.label} is blank: enter it on START."
            yield Finding("MISSING", Severity.ERROR, text, 0, name)
        else:
            text = f"{field.label} of tool {tool.number} on TOOL SETUP{trouble[1].removeprefix(field.label)}"
            yield Finding("TOOL_VALUE", Severity.ERROR, text, 0, name)


def _depths(known: dict[str, float]) -> tuple[Finding, ...]:
    top, bottom = known.get("z_start"), known.get("z_bottom")
    if top is None or bottom is None or bottom < top:
        return ()
    if bottom > top:
        text = "Z BOTTOM {0~1} is above Z START {1~0}: it must be below."
        return (Finding("Z_ORDER", Severity.ERROR, text, 0, "z_bottom", lengths=(bottom, top)),)
    text = "Z BOTTOM is at Z START: nothing is cut."
    return (Finding("Z_ORDER", Severity.WARNING, text, 0, "z_bottom"),)


def _empty(block: Block) -> tuple[Finding, ...]:
    if block.segments:
        return ()
    text = "The contour has no segment yet: right arrow or Page Down on SEGMENT adds a LINE or an ARC."
    return (Finding("NO_SEGMENTS", Severity.ERROR, text, 0),)


@dataclass(slots=True)
class Corners:
    """The surface with its blends and chamfers, by segment index: the remaining pieces, and the faults.

    `waiting` holds the corners that are not inserted: faulty, without a size, or next to an undetermined segment.
    """

    pieces: list[Piece | None]
    faults: dict[int, Finding] = field(default_factory=dict)
    waiting: set[int] = field(default_factory=set)


def _corners(segments: Sequence[Segment], drafts: Sequence[Draft]) -> Corners:
    """Return the pieces of the segments with every BLEND ARC and CHAMFER inserted."""
    corners, determined = Corners([draft.result.piece for draft in drafts]), set[int]()
    for index, (segment, draft) in enumerate(zip(segments, drafts, strict=True)):
        # a determined segment may have no length, and so no piece
        if draft.result.piece is not None or (draft.result.end is not None and not isinstance(segment, CornerSegment)):
            determined.add(index)
    for index, segment in enumerate(segments):
        if not isinstance(segment, CornerSegment):
            continue
        fault = _misplaced(segments, index, segment)
        size = drafts[index].reading.known.get(FIELDS_OF_FORM[form_of(segment)][0].name)
        if fault is None and size is not None:
            fault = _insert_corner(corners.pieces, index, segment, size, determined)
        if fault is not None:
            corners.faults[index] = fault
        if corners.pieces[index] is None:
            corners.waiting.add(index)
    return corners


def _fault(segment: CornerSegment, fault: str, text: str, value: float | None = None, *lengths: float) -> Finding:
    verb, _, size_label = _words(segment)
    code = f"{verb.upper()}_{fault}"
    return Finding(code, Severity.ERROR, text, field=size_label.lower(), value=value, lengths=lengths)


def _misplaced(segments: Sequence[Segment], index: int, segment: CornerSegment) -> Finding | None:
    name = form_of(segment)
    if index == 0:
        text = f"A {name} cannot be the first segment: put a LINE or an ARC before it."
    elif isinstance(before := segments[index - 1], CornerSegment):
        other = f"another {name}" if form_of(before) is name else f"a {form_of(before)}"
        text = f"A {name} cannot follow {other}: delete one or put a segment between."
    elif index + 1 == len(segments):
        text = f"A {name} cannot be the last segment: add the LINE or ARC after it."
    else:
        return None
    return _fault(segment, "PLACE", text)


def _insert_corner(
    pieces: list[Piece | None], index: int, segment: CornerSegment, size: float, determined: Set[int]
) -> Finding | None:
    """Insert a blend or chamfer and shorten its neighbors, or return why not; wait for an undetermined neighbor."""
    before, after = pieces[index - 1], pieces[index + 1]
    if before is None or after is None:
        return _no_neighbor(pieces, index, segment, determined)
    corner = (fillet if isinstance(segment, BlendSegment) else chamfer)(before, after, size)
    if isinstance(corner, NoCorner):
        return _refused(corner, segment, index + 1, size)
    pieces[index - 1 : index + 2] = corner.before, corner.between, corner.after
    return None


def _no_neighbor(
    pieces: Sequence[Piece | None], index: int, segment: CornerSegment, determined: Set[int]
) -> Finding | None:
    """Return a fault if a determined neighbor has no length, or none left."""
    verb, _, size_label = _words(segment)
    for neighbor in (index - 1, index + 1):
        if pieces[neighbor] is None and neighbor in determined:
            remedy = f"correct it or delete this {form_of(segment)}."
            text = f"Segment {neighbor + 1} has no length left to {verb}: {remedy}"
            return _fault(segment, size_label, text)
    return None


def _words(segment: CornerSegment) -> tuple[str, str, str]:
    """Return how sentences speak of a corner: what is done to it, what fills it, and the label of its size field."""
    return ("blend", "arc", "RADIUS") if isinstance(segment, BlendSegment) else ("chamfer", "chamfer", "LENGTH")


def _refused(refused: NoCorner, segment: CornerSegment, number: int, size: float) -> Finding:
    verb, noun, size_label = _words(segment)
    pair = f"segments {number - 1} and {number + 1}"
    match refused.reason:
        case Reason.TANGENT:
            text = f"There is no corner to {verb}: {pair} already run smoothly into each other."
            return _fault(segment, "TANGENT", text)
        case Reason.REVERSAL:
            text = f"No {noun} fits: segment {number + 1} goes straight back along segment {number - 1}."
            return _fault(segment, size_label, text)
        case Reason.TOO_LARGE if refused.largest is not None:
            text = f"{size_label} {{value~0}} does not fit between {pair}: the largest that fits is {{0-}}."
            return _fault(segment, size_label, text, size, refused.largest)
        case Reason.TOO_LARGE:
            text = f"{size_label} {{value}} does not fit between {pair}: enter a smaller one."
            return _fault(segment, size_label, text, size)
        case _:
            assert_never(refused.reason)
