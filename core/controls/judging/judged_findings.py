"""Findings of judged runs: what a control's path does to the contour of a program, in sentences with lines."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from core.controls.judging.contours_and_leads import MAX_LEAD_MOVES
from core.controls.judging.judged_contour import JudgedContour, ToleratedArc, first_line, line_of
from core.controls.judging.mirrored_arcs import mirrored_arcs
from core.controls.judging.rapids_at_depth import cuts_nothing, rapid_walls
from core.controls.moves import Plane
from core.finding import Finding, Severity
from core.geometry.path import Path
from core.tolerance import ROUNDING, SMALLEST_SHOWN_LENGTH
from core.verify.air_cuts import AirCut, air_cuts
from core.verify.report import LAST_INCH_DIGIT, contact_findings, enumerated, or_more
from core.verify.verdict import Gouge, OverRun

MAX_GOUGES: Final = 20
"""Most gouges of a result that get a finding each, deepest first."""

MAX_LINES: Final = 6
"""Most line numbers that one finding lists."""

CAM_ROUNDING: Final = 0.0127 + ROUNDING
"""Millimeters (0.0005 in) of tolerance that a CAM system's rounding explains; more may hide a gouge."""


def judged_findings(results: tuple[JudgedContour, ...]) -> tuple[Finding, ...]:
    """Return findings with lines: gouges, wrong sides and unjudged paths are errors, the rest warnings or notes."""
    gouged = {gouge.surface_number for result in results for gouge in result.verdict.gouges}
    uneven = _uneven_arcs(results)
    return (
        _unseen(results)
        + _rapid_walls(results)
        + tuple(
            _with_axes(finding, result.stretch.plane)
            for result in results
            for finding in (
                *_side_changes(result),
                *_passed_over(result),
                *_cuts_nothing(result),
                *_uneven_arc(uneven.get(result)),
                *_mirrored_arcs(result),
                *_cuts(result),
                *_open_contour(result, gouged),
                *_cut_away(result),
                *_leads(result),
                *_corner_loops(result),
                *_contact(result),
                *_uncut(result),
                *_crossing(result),
                *_uncompensated(result),
                *_low_rapids(result),
                *_cuts_of_others(result),
            )
        )
    )


def _with_axes(finding: Finding, plane: Plane) -> Finding:
    """Return the finding with the names of a plane's axes in its text."""
    first, second, _ = ("XYZ"[axis] for axis in plane.axes)
    return replace(finding, text=finding.text.replace("X {x} Y {y}", f"{first} {{x}} {second} {{y}}"))


def _unseen(results: tuple[JudgedContour, ...]) -> tuple[Finding, ...]:
    """Return one finding that counts the gouges too shallow for a digit, if any."""
    count = sum(result.shallow_gouges for result in results)
    if not count:
        return ()
    gouges = "1 gouge is" if count == 1 else f"{count} gouges are"
    text = f"{gouges} less than half the last digit that a control shows (0.00005 in, 0.0005 mm) and not counted."
    return (Finding("DIGIT", Severity.INFO, text),)


def _side_changes(result: JudgedContour) -> Iterator[Finding]:
    """Warn that a part is judged without the part on the other side before it."""
    text = "The side changes here. Cuts into the contour on the other side are not judged. Program G40 between them."
    if result.side_changes:
        yield Finding("SIDES", Severity.WARNING, text, line=first_line(result.surface))


def _uncompensated(result: JudgedContour) -> Iterator[Finding]:
    """Warn of moves without compensation through a contour; no error, since its wall may be cut away by then."""
    for cut in result.uncompensated_cuts:
        if cut.above:
            continue
        code, move = ("RAPID", "rapid") if cut.rapid else ("FEED", "move without compensation")
        at, line = cut.gouge.surface_at, line_of(cut.gouge.path_number)
        text = (
            f"This {move} at Z {{0}} cuts the contour of line {int(cut.gouge.surface_number)} at X {{x}} Y {{y}}. "
            "Raise the tool before it."
        )
        yield Finding(code, Severity.WARNING, text, at=at, value=cut.gouge.depth, lengths=(cut.height,), line=line)


def _low_rapids(result: JudgedContour) -> Iterator[Finding]:
    """Warn of rapids below zero over contours that are cut lower: no program says how high their walls are."""
    cuts = [cut for cut in result.uncompensated_cuts if cut.above]
    if not cuts:
        return
    lines = list(dict.fromkeys(str(line_of(cut.gouge.path_number)) for cut in cuts))
    listed = ", ".join(lines[:MAX_LINES]) + (" ..." if len(lines) > MAX_LINES else "")
    named = f"rapid of line {listed} runs" if len(lines) == 1 else f"rapids of lines {listed} run"
    lowest = min(cuts, key=lambda cut: cut.height)
    text = f"The {named} below Z 0 over a wall that is cut deeper, first at X {{x}} Y {{y}}, lowest at Z {{0}}. "
    text += "Check the sign of Z, and that the material there is already cut away."
    at, line = cuts[0].gouge.surface_at, line_of(cuts[0].gouge.path_number)
    yield Finding("LOW-RAPID", Severity.WARNING, text, at=at, lengths=(lowest.height,), line=line)


def _cuts_of_others(result: JudgedContour) -> Iterator[Finding]:
    """Warn of cuts into contours of other stretches; no error, since a slot, say, may be meant to cut the wall."""
    deepest = sorted(result.cuts_into_others, key=lambda cut: -cut.gouge.depth)
    for cut in deepest[:MAX_GOUGES]:
        into = (
            f"the contour of line {int(cut.gouge.surface_number)} at X {{x}} Y {{y}}. Check that this wall may be cut."
        )
        text = f"The cutter runs through {into}" if cut.through else f"The cutter cuts {{value}} into {into}"
        at, line = cut.gouge.surface_at, line_of(cut.gouge.path_number)
        yield Finding("OTHER-CONTOUR", Severity.WARNING, text, at=at, value=cut.gouge.depth, line=line)
    if len(deepest) > MAX_GOUGES:
        text = f"Other paths cut {len(deepest) - MAX_GOUGES} more contours, none deeper."
        yield Finding("OTHER-CONTOUR", Severity.WARNING, text)


def _rapid_walls(results: Sequence[JudgedContour]) -> tuple[Finding, ...]:
    """Warn of rapids under compensation at the depth of the cut, once per line."""
    moves = {move.line: move for result in results for move in rapid_walls(result.stretch)}
    text = "This rapid under compensation runs at the depth of the cut, Z {0}. Write G1, or raise the tool before it."
    return tuple(
        Finding("RAPID", Severity.WARNING, text, lengths=(move.point[2],), line=line_of(line))
        for line, move in sorted(moves.items())
    )


def _cuts_nothing(result: JudgedContour) -> Iterator[Finding]:
    """Warn of a contour that is run in rapids only, in the air: a G1 or a plunge is missing."""
    if cuts_nothing(result.stretch):
        text = "Nothing is cut: all moves of this contour are rapids above the part. Write the plunge and G1 before it."
        yield Finding("NO-CUT", Severity.WARNING, text, line=first_line(result.surface))


def _passed_over(result: JudgedContour) -> Iterator[Finding]:
    """Warn that moves above the part are not judged, because no program says how high the part is."""
    above = result.passed_over
    if above is None:
        return
    listed = ", ".join(map(str, above.lines[:MAX_LINES])) + (" ..." if len(above.lines) > MAX_LINES else "")
    named_lines = f"line {listed}" if len(above.lines) == 1 else f"lines {listed}"
    text = f"The tool passes over the part at Z {{0}} or higher ({named_lines}). Check that it clears part and clamps."
    yield Finding("ABOVE", Severity.WARNING, text, lengths=(above.height,), line=above.lines[0])


def _uneven_arcs(results: Sequence[JudgedContour]) -> dict[JudgedContour, ToleratedArc]:
    """Return the uneven arcs of judged parts that raise the tolerance; for each line the one that raises it most."""
    uneven = [(result, result.uneven_arc) for result in results if result.uneven_arc and result.verdict.judged]
    uneven.sort(key=lambda pair: pair[1].slack)
    return dict({arc.line: (result, arc) for result, arc in uneven if arc.slack > 0.0}.values())


def _uneven_arc(arc: ToleratedArc | None) -> list[Finding]:
    """Report an arc with two radii that the control accepts, and how it is judged; warn beyond CAM_ROUNDING."""
    if arc is None:
        return []
    text = "Arc radius {0} at its start, {1} at its end: judged at a radius between them, with {value} extra tolerance."
    severity = Severity.WARNING if arc.slack > CAM_ROUNDING else Severity.INFO
    return [Finding("ARC_RADII", severity, text, value=arc.slack, lengths=(arc.first, arc.last), line=arc.line)]


def _mirrored_arcs(result: JudgedContour) -> Iterator[Finding]:
    """Warn of arcs that may run on the wrong side of their chord.

    Where several are most arcs of a contour, its corners are probably meant so: then only the first one is noted.
    """
    arcs, tangent = mirrored_arcs(result.surface)
    doubtful = len(arcs) == 1 or len(arcs) <= tangent
    for arc in arcs if doubtful else arcs[:1]:
        size = "longer" if arc.long else "shorter"
        direction = "counterclockwise" if arc.counterclockwise else "clockwise"
        text = (
            f"This arc makes a corner at both ends. The {size} {direction} arc of the same radius is tangent there. "
            "Check its direction, center and the sign of R."
        )
        severity = Severity.WARNING if doubtful else Severity.INFO
        yield Finding("ARC-SIDE", severity, text, at=arc.at, line=line_of(arc.number))


def _cuts(result: JudgedContour) -> list[Finding]:
    verdict = result.verdict
    if not verdict.judged:
        return [_unjudged(result)]
    listed = [_gouge(gouge, verdict.radius) for gouge in verdict.gouges[:MAX_GOUGES]]
    unlisted = len(verdict.gouges) - len(listed)
    if unlisted:
        listed.append(Finding("GOUGE", Severity.ERROR, f"{unlisted} more gouges, none deeper."))
    if verdict.wrong_side:
        line = line_of(result.center.numbers[verdict.wrong_side[0]])
        text = "The cutter is on the wrong side of the contour at this line."
        listed.append(Finding("WRONG-SIDE", Severity.ERROR, text, line=line))
    return listed


def _unjudged(result: JudgedContour) -> Finding:
    """Return the error that says why a path cannot be judged."""
    arc, line = result.verdict.uneven_arc, first_line(result.center)
    if arc is None:
        text = "Not judged: a coordinate or the tool radius is too large for any machine."
        return Finding("UNJUDGED", Severity.ERROR, text, line=line)
    text = "Not judged: the radii of this arc differ by {value}. Correct its center or end point."
    if np.isinf(arc.difference):
        text = "Not judged: this arc may be empty or a full circle. Correct its center or end point."
    return Finding("UNJUDGED", Severity.ERROR, text, value=arc.difference, line=line_of(arc.number) or line)


def _gouge(gouge: Gouge, radius: float) -> Finding:
    too_small = gouge.depth < SMALLEST_SHOWN_LENGTH
    depth = "less than {0}" if too_small else "{value}" + or_more(gouge, radius)
    text = f"The cutter gouges the surface of line {int(gouge.surface_number)} by {depth} at X {{x}} Y {{y}}."
    line = line_of(gouge.path_number)
    return Finding(
        "GOUGE",
        Severity.ERROR,
        text,
        at=gouge.surface_at,
        value=gouge.depth,
        lengths=(LAST_INCH_DIGIT,) if too_small else (),
        line=line,
    )


def _open_contour(result: JudgedContour, gouged: set[float]) -> list[Finding]:
    """Warn that gouged lines may not be surface: nothing in a program says where a contour begins."""
    if not gouged & result.open_lines:
        return []
    first, last = int(min(result.open_lines)), int(max(result.open_lines))
    text = (
        f"Lines {first}-{last} are treated as a contour because they are more than {MAX_LEAD_MOVES} moves. If they "
        f"only connect contours, cancel compensation before them or use at most {MAX_LEAD_MOVES} moves."
    )
    return [Finding("WAY", Severity.WARNING, text, line=first)]


def _cut_away(result: JudgedContour) -> Iterator[Finding]:
    """Warn of walls that are not judged, or not above a height, because another pass cuts them away."""
    for wall in result.cut_away:
        lines, others = _lines_of(wall.path), _lines_of(wall.cut_away_by or wall.path)
        if wall.stands:
            text = f"The pass of {others} cuts the wall of {lines} away above Z {{0}}. "
        else:
            text = f"The pass of {lines} is taken for roughing: that of {others} cuts its wall away. "
        text += "If the wall should stay, it is gouged."
        lengths = (wall.top,) if wall.stands else ()
        yield Finding("ROUGHING", Severity.WARNING, text, lengths=lengths, line=first_line(wall.path))


def _lines_of(path: Path) -> str:
    first, last = map(int, path.numbers[[0, -1]])
    return f"line {first}" if first == last else f"lines {first}-{last}"


def _leads(result: JudgedContour) -> Iterator[Finding]:
    """Report moves that are treated as leads, and the cuts into them."""
    if not result.lead_lines:
        return
    text = f"{len(result.lead_lines)} moves before or after a contour are treated as lead moves, not as part of it."
    check = "They are long. Check that none of them is a wall."
    if len(result.lead_lines) == 1:
        text = "A move before or after a contour is treated as a lead move, not as part of it."
        check = "It is long. Check that it is no wall."
    severity = Severity.INFO
    if result.long_leads:
        severity, text = Severity.WARNING, f"{text} {check}"
    yield Finding("LEADS", severity, text, line=result.lead_lines[0])
    deepest = {gouge.surface_number: gouge for gouge in reversed(result.lead_gouges)}
    for gouge in sorted(deepest.values(), key=lambda gouge: -gouge.depth):
        text = f"The cutter cuts {{value}} into line {int(gouge.surface_number)}. If this is not a lead, it is a gouge."
        slack = (result.lead_slack,) if result.lead_slack > 0.0 else ()
        text += " It is judged with {0} extra tolerance." if slack else ""
        line, at = line_of(gouge.path_number), gouge.surface_at
        severity = Severity.WARNING if result.doubtful_leads else severity
        yield Finding("LEAD-GOUGE", severity, text, at=at, value=gouge.depth, lengths=slack, line=line)


def _corner_loops(result: JudgedContour) -> Iterator[Finding]:
    """Report that a contour crosses itself to go around an outside corner."""
    for loop in result.corner_loops:
        lines = enumerated("line", loop.numbers)
        text = f"Loop around the corner X {{x}} Y {{y}}: what lies beyond it on {lines} is no wall."
        severity = Severity.INFO
        if loop.long:
            severity, text = Severity.WARNING, f"{text} It is long. Check that none of it is a wall."
        yield Finding("CORNER-LOOP", severity, text, at=loop.at, line=line_of(loop.numbers[0]))


def _contact(result: JudgedContour) -> list[Finding]:
    """Report moves between the leads that leave the surface by more than the radius, or run backwards along it.

    Some controls leave it at every corner, so several such places make one finding.
    """
    numbers, lines = result.center.numbers, result.lines
    against = tuple(row for row in result.verdict.backwards if numbers[row] in lines)
    away: tuple[AirCut, ...] = ()
    if any(numbers[row] in lines for row in result.verdict.may_cut_air):
        cuts = air_cuts(result.surface, result.stretch.radius, result.center)
        away = tuple(cut for cut in cuts if _between_leads(cut, result.center, lines))
    first_lines = [*(int(numbers[row]) for row in against[:1]), *(int(cut.first_number) for cut in away)]
    listed = contact_findings(away, against)
    located = [replace(finding, segment=None, line=line) for finding, line in zip(listed, first_lines, strict=True)]
    return located if len(away) < 2 else [*located[: -len(away)], _several(located[-len(away) :])]


def _several(away: Sequence[Finding]) -> Finding:
    """Merge several air cuts into one finding, at the place farthest from the part."""
    lines = list(dict.fromkeys(str(finding.line) for finding in away))
    ellipsis = " ..." if len(lines) > MAX_LINES else ""
    text = f"The path cuts air at {len(away)} places (lines {', '.join(lines[:MAX_LINES])}{ellipsis}), "
    text += "at most {0} off the part, at X {x} Y {y}."
    return replace(max(away, key=lambda finding: finding.lengths), text=text)


def _between_leads(away: AirCut, center: Path, lines: frozenset[float]) -> bool:
    """True if an air cut is not a lead: leads are at a path's two ends, or have lines of their own."""
    ends = {tuple(center.points[0].tolist()), tuple(center.points[-1].tolist())}
    return {away.first_number, away.last_number} <= lines and not ends & {away.start, away.end}


def _uncut(result: JudgedContour) -> list[Finding]:
    verdict = result.verdict
    if not verdict.judged or not verdict.uncut or result.cut_short:
        return []
    worst = max(verdict.uncut, key=lambda stretch: stretch.thickness)
    too_small = worst.thickness < SMALLEST_SHOWN_LENGTH
    thick = "less than {2}" if too_small else "at most {value}"
    text = f"{{0}} of the surface's {{1}} stays uncut, {thick} thick at X {{x}} Y {{y}}."
    lengths = (verdict.uncut_length, verdict.surface_length, *((LAST_INCH_DIGIT,) if too_small else ()))
    line, at = int(worst.first_number), worst.thickest
    severity = Severity.INFO if too_small else Severity.WARNING
    return [Finding("UNCUT", severity, text, at=at, value=worst.thickness, lengths=lengths, line=line)]


def _crossing(result: JudgedContour) -> list[Finding]:
    """Report that the contour's ends run past its corner, or that it crosses itself."""
    verdict, line = result.verdict, first_line(result.surface)
    if verdict.over_run is not None:
        return [_over_run(verdict.over_run, result.surface)]
    if not verdict.crosses_itself:
        return []
    place = " at X {x} Y {y}" if verdict.crossing_at else ""
    text = f"The programmed contour crosses or touches itself{place}. All of it counts as surface."
    return [Finding("CROSSES", Severity.WARNING, text, at=verdict.crossing_at, line=line)]


def _over_run(over_run: OverRun, surface: Path) -> Finding:
    """Report that the contour's ends are leads; warn if its first or last point, or a lead, may be wrong."""
    if not over_run.doubtful and over_run.lead_numbers:
        which = enumerated("line", over_run.lead_numbers)
        text = f"Over-run at X {{x}} Y {{y}}. Taken for lead beyond it: {which}. Check that no wall is cut there."
        return Finding("OVER_RUN", Severity.WARNING, text, at=over_run.at, line=line_of(over_run.lead_numbers[0]))
    if not over_run.doubtful:
        text = "Over-run at X {x} Y {y}: the ends are lead-in and lead-out."
        return Finding("OVER_RUN", Severity.INFO, text, at=over_run.at, line=first_line(surface))
    length, line = max(over_run.lead_in, over_run.lead_out), line_of(over_run.last_number)
    text = "The contour begins on this line. The last {value} is taken for lead-out. Check where it begins."
    if over_run.lead_in > over_run.lead_out:
        line = line_of(over_run.first_number)
        text = "The contour ends on this line. The first {value} is taken for lead-in. Check where it ends."
    return Finding("OVER_RUN", Severity.WARNING, text, at=over_run.at, value=length, line=line)
