"""Field findings: fields left blank, without effect, or at heights where the tool hits the part.  No numpy needed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Final

from core.finding import Finding, Severity
from core.program.fields import Form, default_value, field_of
from core.program.model import Block, CutterComp, Number, Program, Typed, Unread
from core.program.solve.reading import usable
from core.program.solve.solved import Origin, Solved, SolvedBlock
from core.program.tools import called_tool, unusual_size
from core.tolerance import JOINED, LAST_PASS, ON_PATH
from core.units import Kind, from_mm, length_text, show, to_mm

PARTNERS: Final = (("point_x", "point_y"), ("point_y", "point_x"), ("point_dist", "point_x"), ("offset", "parallel"))
"""Fields of a LINE or an ARC, each with another without which it has no effect."""
SMALLEST_VISIBLE_LENGTH: Final = 0.01
"""Millimeters: a longer length is displayed as something other than 0 in any unit."""


def field_findings(block: Block, solved: SolvedBlock, program: Program) -> Iterator[Finding]:
    """Yield what may surprise the operator about a block's fields and the program's parameters and setup."""
    yield from _z_ends(solved)
    yield from _safe_z(solved, program)
    yield from _tool_sizes(block, solved, program)
    yield from _without_partner(block, solved)
    yield from _blank_feeds(block, solved, program)
    yield from _fast_feeds(solved, program)
    yield from _allowances_without_finish_tool(block, program)
    yield from _finish_tool_without_allowance(block, program)
    yield from _no_clearance(solved, program)
    yield from _one_pass(block, solved, program)
    yield from _no_contour(solved)


def typed_lookahead_warning(value: int, calculated: int) -> Finding:
    """Say that a typed look-ahead is in force instead of the calculated one."""
    text = f"USR {value} in force, CAL is {calculated}. F3 goes back to CAL."
    return Finding("USR_LOOKAHEAD", Severity.WARNING, text, field="lookahead")


def _z_ends(solved: SolvedBlock) -> Iterator[Finding]:
    """Report typed Z ENDs outside Z START to Z BOTTOM: no pass goes deeper, and rapid moves would hit higher ones."""
    if solved.z_start is None or solved.z_bottom is None:
        return
    top, bottom = solved.z_start, solved.z_bottom
    for segment in solved.segments:
        height = segment.z_end
        if bottom - JOINED <= height <= top + JOINED or not isinstance(segment.values.get("z_end"), Number):
            continue
        if height > top + JOINED:
            text = "Z END {value} is above Z START {0}; rapids would hit it. Enter {1} to {0}."
            lengths = (top, bottom)
        else:
            text = "Z END {value} is below Z BOTTOM {0}: no pass goes so deep. Enter {0} to {1}."
            lengths = (bottom, top)
        number = float(segment.number)
        yield Finding("Z_END", Severity.ERROR, text, number, "z_end", value=height, lengths=lengths)


def _safe_z(solved: SolvedBlock, program: Program) -> Iterator[Finding]:
    """Report a SAFE Z below the clearance over Z START, which posting raises: a warning if typed, else information."""
    typed = program.setup.safe_z
    safe = _in_force(program, Form.SETUP, "safe_z")
    clearance = _in_force(program, Form.PARAMETERS, "retract_clearance")
    if safe is None or clearance is None or solved.z_start is None:
        return
    clear = solved.z_start + clearance
    if safe >= clear - JOINED:
        return
    text = "SAFE Z {value} is below Z {0}, RETRACT CLEARANCE {1} over Z START {2}: the tool rapids at Z {0} instead. "
    severity = Severity.INFO if typed is None else Severity.WARNING
    lengths = (clear, clearance, solved.z_start)
    yield Finding("SAFE_Z", severity, f"{text}Enter SAFE Z on PART SETUP.", field="safe_z", value=safe, lengths=lengths)


def _tool_sizes(block: Block, solved: SolvedBlock, program: Program) -> Iterator[Finding]:
    """Warn about tools whose diameter may be in the other unit."""
    top, bottom = solved.z_start, solved.z_bottom
    depth = 0.0 if top is None or bottom is None else top - bottom
    for name in ("tool", "finish_tool"):
        called = called_tool(program, getattr(block, name), name)
        if called.tool is None or called.diameter is None:
            continue
        finding = unusual_size(f"Tool {called.tool.number}", called.diameter, program.unit, depth)
        if finding is not None:
            text = f"{finding.text} F6 is TOOL SETUP."
            yield replace(finding, text=text, segment=0, field=name)


def _without_partner(block: Block, solved: SolvedBlock) -> Iterator[Finding]:
    """Warn about typed numbers that have no effect without another one, such as OFFSET without PARALLEL TO."""
    for number, segment in enumerate(block.segments[: solved.determined], 1):
        for name, partner in PARTNERS:
            if getattr(segment, name, None) is not None and getattr(segment, partner) is None:
                label, needed = (field_of(Form.LINE, each).label for each in (name, partner))
                text = f"{label} has no effect without {needed}. Enter {needed}, or blank {label}."
                yield Finding("NO_PARTNER", Severity.WARNING, text, number, name)


def _blank_feeds(block: Block, solved: SolvedBlock, program: Program) -> Iterator[Finding]:
    """Warn about leading segments without FEED from the form or the tool table, once the first segment is known."""
    if not solved.determined or solved.plunge_feed is None:
        return
    count = len(block.segments)
    count_blank = next((index for index, segment in enumerate(block.segments) if segment.feed is not None), count)
    if not count_blank:
        return
    feed_of_start = solved.segments[0].values.get("feed")
    if isinstance(feed_of_start, Solved) and feed_of_start.origin is Origin.TOOL:
        return
    if count_blank == count:
        subject = "the contour is"
    else:
        subject = "it is" if count_blank == 1 else f"segments 1 to {count_blank} are"
    feed = show(from_mm(solved.plunge_feed, program.unit), Kind.FEED, program.unit)
    text = f"FEED is blank: {subject} cut at PLUNGE FEED {feed}. Enter FEED."
    yield Finding("PLUNGE_FED", Severity.WARNING, text, 1, "feed")


def _fast_feeds(solved: SolvedBlock, program: Program) -> Iterator[Finding]:
    """Warn about a feed faster than a rapid: often it is a speed, typed into the wrong field.

    FEED is only compared with a typed RAPID RATE: fast machines mill faster than the usual one.
    """
    rapid = _in_force(program, Form.PARAMETERS, "rapid_feed")
    if rapid is None:
        return
    feeds = [(0, "plunge_feed", "PLUNGE FEED", solved.plunge_feed)]
    if program.parameters.rapid_feed is not None:
        typed = ((segment.number, segment.values.get("feed")) for segment in solved.segments)
        feeds += [
            (number, "feed", "FEED", to_mm(feed.value, program.unit))
            for number, feed in typed
            if isinstance(feed, Number)
        ]
    for number, name, label, feed in feeds:
        if feed is not None and feed > rapid + JOINED:
            fast, usual = (show(from_mm(each, program.unit), Kind.FEED, program.unit) for each in (feed, rapid))
            text = f"{label} {fast} is faster than RAPID RATE {usual}. Correct it, or RAPID RATE with F4."
            yield Finding("FAST_FEED", Severity.WARNING, text, number, name)
            return


def _allowances_without_finish_tool(block: Block, program: Program) -> Iterator[Finding]:
    """Warn about FINISH XY and FINISH Z without a finish tool."""
    tool = block.finish_tool
    if isinstance(tool, Unread) or (tool is not None and tool.value != 0.0):
        return
    for name in ("finish_xy", "finish_z"):
        typed = getattr(program.parameters, name)
        if not isinstance(typed, Number) or typed.value <= 0.0:
            continue
        label = field_of(Form.PARAMETERS, name).label
        scope = "" if len(program.blocks) == 1 else ", which counts for all blocks"
        text = f"{label} {{value}} has no effect: FINISH TOOL is 0. Enter FINISH TOOL on START, or 0 in {label} "
        value = to_mm(typed.value, program.unit)
        yield Finding(
            "NOT_LEFT", Severity.WARNING, text + f"on PROGRAM PARAMETERS{scope}.", 0, "finish_tool", value=value
        )


def _finish_tool_without_allowance(block: Block, program: Program) -> Iterator[Finding]:
    """Say that a finish tool finds nothing left to cut: it runs the contour once more.

    A finish tool smaller than the other one cuts the corners that it left.
    """
    tool = block.finish_tool
    if not isinstance(tool, Number) or tool.value == 0.0:
        return
    rough, finish = (called_tool(program, getattr(block, name), name).diameter for name in ("tool", "finish_tool"))
    if rough is not None and finish is not None and finish < rough:
        return
    if not any(_in_force(program, Form.PARAMETERS, name) for name in ("finish_xy", "finish_z")):
        text = f"FINISH TOOL {tool.value:g} has nothing to cut: FINISH XY and FINISH Z are 0. F4 sets them."
        yield Finding("NOTHING_LEFT", Severity.INFO, text, 0, "finish_tool")


def _no_clearance(solved: SolvedBlock, program: Program) -> Iterator[Finding]:
    """Warn about clearances that are displayed as 0: a rapid then ends on material."""
    consequences = {"retract_clearance": "the tool rapids right to the top of the stock"}
    if _pecks(solved):
        consequences["peck_clearance"] = "between pecks it rapids right to the last floor"
    for name, consequence in consequences.items():
        value = _in_force(program, Form.PARAMETERS, name)
        if value is None or value > SMALLEST_VISIBLE_LENGTH or length_text(value, program.unit).strip("0."):
            continue
        label = field_of(Form.PARAMETERS, name).label
        text = f"{label} is {{value}}: {consequence}. Enter {label} on PROGRAM PARAMETERS."
        yield Finding("NO_CLEARANCE", Severity.WARNING, text, field=name, value=value)


def _pecks(solved: SolvedBlock) -> bool:
    """True if the depth takes more than one pass."""
    if solved.z_start is None or solved.z_bottom is None or solved.peck_depth <= 0.0:
        return False
    return solved.z_start - solved.z_bottom > solved.peck_depth + LAST_PASS


def _one_pass(block: Block, solved: SolvedBlock, program: Program) -> Iterator[Finding]:
    """Warn about a PROFILE with MAX OFFSET 0, or not above FINISH XY with a finish tool: it makes one pass."""
    if block.cutter_comp not in (CutterComp.PROFILE_LEFT, CutterComp.PROFILE_RIGHT):
        return
    finishing = solved.finish_diameter is not None
    offset, least = (
        _in_force(program, Form.PARAMETERS, "max_offset"),
        _in_force(program, Form.PARAMETERS, "finish_xy") if finishing else 0.0,
    )
    if offset is None or least is None or offset > least + ON_PATH:
        return
    side = block.cutter_comp.removeprefix("PROFILE ")
    if least > 0.0:
        text = (
            f"MAX OFFSET {{value}} is no more than FINISH XY {{0}}: PROFILE {side} makes one roughing pass, the same "
        )
        text += f"as {side}. Enter a larger MAX OFFSET on PROGRAM PARAMETERS, or {side} in CUTTER COMP."
    else:
        text = f"MAX OFFSET is {{value}}: PROFILE {side} makes one pass, the same as {side}. Enter MAX OFFSET on "
        text += f"PROGRAM PARAMETERS, or {side} in CUTTER COMP."
    yield Finding("ONE_PASS", Severity.WARNING, text, 0, "cutter_comp", value=offset, lengths=(least,))


def _no_contour(solved: SolvedBlock) -> Iterator[Finding]:
    """Report a determined contour with only one segment that has a length, or none; a full circle alone is closed."""
    if not solved.segments or not solved.fully_determined or solved.closed or len(solved.pieces) > 1:
        return
    if not solved.pieces:
        text = "No segment has a length: the contour is a point, and there is no path. Correct X END or Y END."
        yield Finding("NO_LENGTH", Severity.ERROR, text, 1, "x_end", solved.segments[0].end)
        return
    number, piece = solved.pieces[0]
    text = "The contour is one segment: an open path from START to X {x} Y {y}. Right arrow or Page Down on SEGMENT "
    yield Finding("ONE_SEGMENT", Severity.INFO, text + "adds the next one.", number, None, piece.end)


def _in_force(program: Program, form: Form, name: str) -> float | None:
    """Return a number of PROGRAM PARAMETERS or PART SETUP in millimeters, as typed or its default; None if refused."""
    typed: Typed = getattr(program.setup if form is Form.SETUP else program.parameters, name)
    default = default_value(name, program.unit)
    if typed is None and default is not None:
        typed = Number(default)
    return usable(field_of(form, name), typed, program.unit)
