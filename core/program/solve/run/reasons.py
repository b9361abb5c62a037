"""This module words why a run has no answer: one function per reason, which returns a finding with its numbers.

A finding names the segment to correct and, if one number is at fault, its field.
"""

from __future__ import annotations

from math import cos, degrees, dist, pi, tau

from core.finding import Finding, Severity
from core.geometry.oriented import Circle, Locus
from core.geometry.piece import Point, Turn
from core.program.fields import Form, field_of
from core.program.solve.rules import angle_text, nearest_equivalent
from core.program.solve.run.branch import Branch, Element, LineTie, Run
from core.tolerance import ARC_RADII


def _fault(code: str, text: str, element: Element, field: str | None, *lengths: float) -> Finding:
    return Finding(code, Severity.ERROR, text, segment=element.number, field=field, lengths=lengths)


def segments(elements: tuple[Element, ...]) -> str:
    """Name the segments: `Segment 2`, `Segments 2 and 3` or `Segments 2 to 4`."""
    first, last = elements[0].number, elements[-1].number
    if first == last:
        return f"Segment {first}"
    return f"Segments {first} {'and' if len(elements) == 2 else 'to'} {last}"


def label(element: Element, name: str) -> str:
    """Return a field's label on the element's form."""
    form = Form.ARC if element.turn else Form.LINE
    return field_of(form, name.removesuffix("_inc")).label


def _plain_angle(angle: float) -> str:
    """Format an angle in degrees from 0 up to 360, without trailing zeros."""
    return f"{degrees(angle) % 360.0:.3f}".rstrip("0").rstrip(".")


def line_runs_backward(run: Run, index: int, length: float, heading: float) -> Finding:
    """A line would have to run against its heading."""
    element = run.elements[index]
    field = "angle" if "angle" in element.known else None
    text = f"Segment {element.number} would have to run {{0}} backwards at XY ANGLE {_plain_angle(heading)}: "
    if element.link is not None:
        text += (
            "blank TANGENT, or correct its end." if element.link == 0.0 else "correct its relative angle or its end."
        )
    elif len(run.elements) == 1:
        text += f"enter {_plain_angle(heading + pi)}, or correct its other fields."
    else:
        other = run.elements[index - 1 if index else 1]
        text += f"enter {_plain_angle(heading + pi)}, or correct segment {other.number}."
    return _fault("BEHIND", text, element, field, length)


def no_length(element: Element) -> Finding:
    """An element would have no length."""
    text = f"Segment {element.number} would have no length: delete it, or correct the segments before and after it."
    return _fault("NO_LENGTH_LEFT", text, element, None)


def out_of_range(branch: Branch, index: int) -> Finding:
    """An end or a center lies beyond any machine's travel."""
    elements = branch.run.elements
    element = elements[index]
    text = "This segment's end or center is beyond any machine's travel. Check its numbers."
    if index + 1 < len(elements) and not element.turn and not elements[index + 1].turn:
        first, second = branch.heading_in[index], branch.heading_in[index + 1]
        if first is not None and second is not None:
            angle = abs((first - second + pi / 2.0) % pi - pi / 2.0)
            if angle < 0.01:
                text += f" Segments {element.number} and {elements[index + 1].number} are parallel but for "
                text += f"{degrees(angle):.3f} degrees."
    return _fault("OUT_OF_RANGE", text, element, None)


def radii_differ(element: Element, radius: float, end_radius: float) -> Finding:
    """An arc's ends lie at different distances from its center."""
    text = "The arc's radius is {0~1} at its start and {1~0} at its end: correct the end, the center or RADIUS."
    return _fault("CONTRADICTION", text, element, "radius", radius, end_radius)


def _other_data(run: Run) -> str:
    """Name what a value of one element contradicts."""
    return segments(run.elements).replace("S", "s", 1) if len(run.elements) > 1 else "its other fields"


def angle_differs(run: Run, index: int, name: str, typed: float, actual: float) -> Finding:
    """A typed angle differs from the one that the other data give."""
    element = run.elements[index]
    if name != "sweep":
        actual = nearest_equivalent(actual, typed)
    given, other = angle_text(typed), angle_text(actual)
    if given == other:
        given, other = f"{degrees(typed):.6f}", f"{degrees(actual):.6f}"
    text = f"{label(element, name)} is {given}, but {other} by {_other_data(run)}: correct or blank one of them."
    return _fault("CONTRADICTION", text, element, name.removesuffix("_inc"))


def length_differs(run: Run, index: int, name: str, typed: float, actual: float) -> Finding:
    """A typed length or coordinate differs from the one that the other data give."""
    element = run.elements[index]
    text = f"{label(element, name)} is {{0~1}}, but {{1~0}} by {_other_data(run)}: correct or blank one of them."
    return _fault("CONTRADICTION", text, element, name.removesuffix("_inc"), typed, actual)


def point_missed(element: Element, point: Point, typed: float, actual: float) -> Finding:
    """An element passes its point at a distance other than the typed one."""
    text = f"The point {{2}} {{3}} is {{1~0}} from segment {element.number}, not {{0~1}}: correct or blank it."
    return _fault("CONTRADICTION", text, element, "point_x", typed, actual, *point)


def not_linked(run: Run, index: int, link: float, actual: float) -> Finding:
    """An element does not start at the typed angle to the element before it."""
    element = run.elements[index]
    turned = degrees((actual + pi) % tau - pi)
    if link == 0.0:
        text = f"Segment {element.number} is not tangent to the one before: the corner turns by {turned:.3f} degrees. "
        return _fault("CONTRADICTION", f"{text}Blank TANGENT, or correct one of them.", element, "tangent")
    name = "start_angle" if element.turn else "angle"
    text = f"{label(element, name)} is I{degrees(link):g}, but I{turned:.3f} by {_other_data(run)}: correct or blank "
    return _fault("CONTRADICTION", f"{text}one of them.", element, name)


def not_parallel(element: Element, target_heading: float, actual: float) -> Finding:
    """A line is not parallel to its target, which runs at the wanted angle or opposite to it."""
    if cos(actual - target_heading) < 0.0:
        target_heading += pi
    if (typed := element.known.get("angle")) is not None:
        given, other = angle_text(typed), angle_text(nearest_equivalent(target_heading, typed))
        text = f"XY ANGLE is {given}, but {other} by PARALLEL TO: correct or blank one of them."
    else:
        given, other = angle_text(actual % tau), angle_text(target_heading % tau)
        text = f"XY ANGLE comes to {given}, but {other} by PARALLEL TO: correct the end, or blank PARALLEL TO."
    return _fault("CONTRADICTION", text, element, "parallel")


def coincident(run: Run, index: int) -> Finding:
    """Both elements at a joint run on the same line or circle."""
    first, second = run.elements[index - 1], run.elements[index]
    shape = "circle" if first.turn and second.turn else "line"
    text = (
        f"Segments {first.number} and {second.number} run on one {shape}: their joint may be anywhere. Enter one end."
    )
    return _fault("UNDETERMINED", text, second, None)


def no_meeting(branch: Branch, joint: int, first: Locus, second: Locus, distance: float) -> Finding:
    """Two loci of a joint miss each other; `distance` is as in `oriented.Meeting`."""
    elements = branch.run.elements
    before = elements[joint - 1]
    after = elements[joint] if joint < len(elements) else before
    circles = [locus for locus in (first, second) if isinstance(locus, Circle)]
    arcs = [_arc_about(branch, (joint - 1, joint), circle.center) for circle in circles]
    match circles:
        case [circle]:
            return _line_misses(before, after, distance, circle, arcs[0])
        case [_, _]:
            return _circles_miss(before, after, distance, circles, arcs)
        case _:
            return _parallel_lines(before, after, distance)


def _arc_about(branch: Branch, indices: tuple[int, int], at: Point) -> Element | None:
    """Return the first of two elements, as far as they exist, that is an arc with its known center at a point."""
    for index in indices:
        if 0 <= index < len(branch.run.elements):
            center = branch.center(index)
            if center is not None and dist(center, at) <= ARC_RADII:
                return branch.run.elements[index]
    return None


def _parallel_lines(before: Element, after: Element, distance: float) -> Finding:
    if before is after:
        text = f"Segment {before.number} runs {{0}} beside the end that is typed: it never reaches it. Correct one."
        return _fault("NO_MEETING", text, before, None, distance)
    text = f"Segments {before.number} and {after.number} are parallel, {{0}} apart: they never meet."
    return _fault("NO_MEETING", text, after, None, distance)


def _line_misses(before: Element, after: Element, distance: float, circle: Circle, arc: Element | None) -> Finding:
    if arc is not None:
        other = before if arc is after else after
        subject = f"Segment {other.number}" if other is not arc else "The end that is typed"
        text = f"{subject} passes the circle of segment {arc.number} at {{0~1}}; its RADIUS is {{1~0}}."
        return _fault("NO_MEETING", text, arc, "radius", distance, circle.radius)
    element = next((element for element in (after, before) if "length" in element.known), after)
    field = "radius" if element.turn else "length"
    text = f"{label(element, field)} {{0~1}} does not reach: it takes at least {{1+}}."
    return _fault("TOO_SHORT", text, element, field, circle.radius, distance)


def _circles_miss(
    before: Element, after: Element, center_distance: float, circles: list[Circle], arcs: list[Element | None]
) -> Finding:
    first, second = circles
    if None not in arcs:
        text = f"The circles of segments {before.number} and {after.number} never meet: their centers are {{2}} apart, "
        text += "their RADIUS {0} and {1}."
        return _fault("NO_MEETING", text, after, "radius", first.radius, second.radius, center_distance)
    names = [_size_label(element) for element in (before, after)]
    both = names[0] if names[0] == names[1] else ""
    text = (
        f"{both or names[0]} {{0}} and {'' if both else f'{names[1]} '}{{1}} do not reach: the points are {{2}} apart."
    )
    field = "radius" if after.turn else "length"
    return _fault("TOO_SHORT", text, after, field, first.radius, second.radius, center_distance)


def _size_label(element: Element) -> str:
    return "The chord" if element.turn else label(element, "length")


def no_tangent(branch: Branch, index: int, first: LineTie, second: LineTie) -> Finding:
    """No line passes two points at the given distances."""
    element, elements = branch.run.elements[index], branch.run.elements
    (a, r, _), (b, s, _) = first, second
    if (r == 0.0) is not (s == 0.0):
        point, center = (a, b) if r == 0.0 else (b, a)
        arc = _arc_about(branch, (index - 1, index + 1), center)
        if arc is not None:
            text = f"The point {{0}} {{1}} lies inside the circle of segment {arc.number}: no line from it is tangent."
            return _fault("INSIDE", text, element, None, *point)
        text = "The point {0} {1} is only {2} away: no line passes it at {3}."
        return _fault("INSIDE", text, element, "point_dist", *center, dist(a, b), abs(s - r))
    before = elements[index - 1].number if index else element.number
    after = elements[index + 1].number if index + 1 < len(elements) else element.number
    text = f"Segments {before} and {after} overlap: no line runs from one to the other with these DIRECTIONS."
    return _fault("NO_TANGENT", text, element, None)


def no_circle(element: Element) -> Finding:
    """No circle meets the conditions; `fitting_number` looks for a RADIUS that does."""
    if "radius" in element.known:
        text = f"RADIUS {{0}} fits nowhere between the segments before and after segment {element.number}."
        return _fault("TOO_SMALL", text, element, "radius", element.known["radius"])
    text = f"No circle of segment {element.number} touches or reaches its neighbors: correct one of them."
    return _fault("NO_MEETING", text, element, None)


def radius_limit(run: Run, index: int, limit: float, *, least: bool) -> Finding:
    """RADIUS is too small or too large; `limit` is the nearest that fits."""
    element = run.elements[index]
    before, after = run.elements[index - 1].number if index else None, None
    if index + 1 < len(run.elements):
        after = run.elements[index + 1].number
    radius = element.known["radius"]
    if least:
        touched = f"touch segment {before}" if before is not None else "leave its start"
        reached = f"segment {after}" if after is not None else "the end"
        text = f"RADIUS {{0~1}} cannot {touched} and reach {reached}: it takes at least {{1+}}."
        return _fault("TOO_SMALL", text, element, "radius", radius, limit)
    numbers = [number for number in (before, after) if number is not None]
    if len(numbers) == 2:
        where = f"between segments {numbers[0]} and {numbers[1]}"
    else:
        where = f"beside segment {numbers[0]}" if numbers else "between its ends"
    text = f"RADIUS {{0~1}} does not fit {where}: the largest is {{1-}}."
    return _fault("TOO_LARGE", text, element, "radius", radius, limit)


def wrong_sense(element: Element) -> Finding:
    """The circle that fits turns in the other DIRECTION."""
    direction, other = ("CW", "CCW") if element.turn is Turn.CW else ("CCW", "CW")
    text = f"DIRECTION {direction}: a tangent arc to this end turns {other}."
    return _fault("WRONG_SENSE", text, element, "direction")


def missing(stuck: Branch, count: int, tangent: int | None) -> Finding:
    """Too few data are typed; `tangent` is the number of a segment where TANGENT would add a value, if any."""
    run = stuck.run
    values = f"{count} more value{'' if count == 1 else 's'}"
    subject = segments(run.elements)
    verb = "needs" if len(run.elements) == 1 else "need"
    element, name = suggested(stuck)
    suggestions = [
        f"{label(element, name)} of {element.number}",
        "an end" if name == "x_end" else "an end (X END or Y END)",
    ]
    if tangent is not None and name != "angle":
        suggestions.append(f"TANGENT YES on {tangent}")
    text = f"{subject} {verb} {values}: {', or '.join(suggestions)}."
    return Finding("MISSING", Severity.ERROR, text, segment=element.number, field=name)


def suggested(stuck: Branch) -> tuple[Element, str]:
    """Return a helpful blank field: an ARC's RADIUS, else a LINE's XY ANGLE or XY LENGTH, an ARC's sweep, or an end.

    What follows from the data already is passed over.
    """
    run = stuck.run
    for arcs, name in ((True, "radius"), (False, "angle"), (False, "length"), (True, "sweep"), (False, "x_end")):
        for index, element in enumerate(run.elements):
            relative = element.link is not None if name == "angle" else f"{name}_inc" in element.known
            follows = _follows(stuck, index, name) or (name == "radius" and _radius_follows(run, element))
            if bool(element.turn) is arcs and name not in element.known and not relative and not follows:
                return element, name
    return run.elements[0], "x_end"


def _follows(branch: Branch, index: int, name: str) -> bool:
    """True if a value of an element is known without being typed."""
    values = {"radius": branch.rho, "angle": branch.heading_in, "length": branch.length, "sweep": branch.sweep}
    ends_known = branch.joint(index) is not None and branch.joint(index + 1) is not None
    if name == "x_end":
        return branch.joint(index + 1) is not None
    return values[name][index] is not None or (ends_known and name in ("length", "angle"))


def _radius_follows(run: Run, element: Element) -> bool:
    """True if an arc's center and one of its points give its radius, so that RADIUS would add nothing."""
    known = element.known
    point = element is run.elements[0] or {"x_end", "y_end"} <= known.keys()
    return {"x_center_inc", "y_center_inc"} <= known.keys() or ({"x_center", "y_center"} <= known.keys() and point)


def unsolvable(run: Run, tangent: int | None, *, tried: bool) -> Finding:
    """The data suffice, but no method solves them; `tried` if the operator's pick leads to no solution either.

    `tangent` is as in `missing`.
    """
    text = f"{segments(run.elements)} cannot be calculated from these data yet: enter one end, "
    text += "or a center." if tangent is None else f"a center, or TANGENT YES on {tangent}."
    if tried:
        text += " The pick leads to no solution: set it nearer to the joint."
    return Finding("NOT_YET", Severity.ERROR, text, segment=run.elements[0].number)


def pick_nearer(run: Run, count: int) -> Finding:
    """The pick is too far from an answer, or does not tell several answers apart."""
    fit = "One solution fits, but it is far from the pick" if count == 1 else f"{count} solutions fit"
    text = f"{fit}: set the pick nearer to the end of segment {run.elements[0].number}, or pick one on SOLUTION."
    return Finding("PICK_SOLUTION", Severity.ERROR, text, segment=run.elements[0].number, field="choice")


def pick_solution(run: Run, count: int, *, picked: bool) -> Finding:
    """Several answers fit and none is picked, or the picked one is no longer possible."""
    vanished = "The solution that was picked is no longer possible. " if picked else ""
    number = {1: "One solution fits", 2: "Two solutions fit"}.get(count, f"{count} solutions fit")
    text = f"{vanished}{number}: pick {'it' if count == 1 else 'one'} on SOLUTION."
    return Finding("PICK_SOLUTION", Severity.ERROR, text, segment=run.elements[0].number, field="choice")
