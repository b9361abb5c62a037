"""Corpus of the record: seeded random contours of many families, as program files and as NC programs.

It uses nothing of the program, so that two versions of it are asked exactly the same.
"""

from __future__ import annotations

from cmath import phase, rect
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from math import cos, pi, sin, sqrt, tan, tau
from random import Random
from typing import Final

IN: Final = 25.4


@dataclass(frozen=True)
class Element:
    """A line, or an arc where it has a center."""

    end: complex
    center: complex | None = None
    ccw: bool = False


@dataclass(frozen=True)
class Contour:
    """A contour in program units, its coordinates rounded as a drawing gives them."""

    start: complex
    elements: tuple[Element, ...]


@dataclass(frozen=True)
class Case:
    """Contours with what they are machined by: the fields of START, PROGRAM PARAMETERS and PART SETUP."""

    name: str
    unit: str
    decimals: int
    diameter: float
    comp: str
    contours: tuple[Contour, ...]
    start: dict[str, object] = field(default_factory=dict)
    parameters: dict[str, object] = field(default_factory=dict)
    setup: dict[str, object] = field(default_factory=dict)


def cases(count: int, seed: int) -> Iterator[Case]:
    """This many cases; the families take turns, and a case depends on its number and the seed alone."""
    for number in range(count):
        family = FAMILIES[number % len(FAMILIES)]
        yield _case(Random(f"{seed} {number}"), family, f"{family.__name__}-{number:04d}")


def _case(random: Random, family: Callable[[Random], tuple[list[complex], list[float]]], name: str) -> Case:
    unit = random.choice(("MM", "IN"))
    size = 1.0 if unit == "MM" else IN
    decimals = random.choice((3, 4, 4, 5, 6, 9))
    diameter = random.choice((2.0, 3.0, 4.0, 6.0, 6.0, 10.0, 12.0, 16.0, 20.0)) if unit == "MM" else _inch_tool(random)
    count = 1 if random.random() < 0.85 else random.randint(2, 3)
    contours = []
    for _ in range(count):
        places, bulges = family(random)
        if random.random() < 0.5:
            places, bulges = places[::-1], [-bulge for bulge in reversed(bulges)]
        shift = random.choice((0j, 0j, complex(37.5, -12.25), complex(-812.0, 655.0)))
        contours.append(_contour([(place + shift) / size for place in places], bulges, decimals))
    comp = random.choice(("LEFT", "LEFT", "LEFT", "RIGHT", "RIGHT", "RIGHT", "ON", "PROFILE LEFT", "PROFILE RIGHT"))
    return Case(
        name,
        unit,
        decimals,
        diameter,
        comp,
        tuple(contours),
        _start_fields(random, size),
        _parameters(random, size),
        _setup(random),
    )


def _inch_tool(random: Random) -> float:
    return random.choice((0.125, 0.1875, 0.25, 0.25, 0.375, 0.5, 0.75))


def _start_fields(random: Random, size: float) -> dict[str, object]:
    fields: dict[str, object] = {
        "finish_tool": random.choice((0, 0, 0, 1, 2)),
        "z_start": 0.0,
        "z_bottom": round(-random.uniform(1.0, 12.0) / size, 3),
        "plunge_feed": round(random.uniform(80.0, 300.0) / size, 1),
        "speed": random.randint(500, 8000),
        "peck_depth": random.choice((0.0, 0.0, round(random.uniform(0.8, 5.0) / size, 3))),
    }
    if random.random() < 0.4:
        fields["lookahead"] = random.choice((1, 1, 2, 3, 5, 8, 13, 20))
    return fields


def _parameters(random: Random, size: float) -> dict[str, object]:
    fields: dict[str, object] = {}
    for name, largest in (
        ("blend_offset", 6.0),
        ("blend_overlap", 5.0),
        ("finish_xy", 0.6),
        ("finish_z", 0.3),
        ("max_offset", 15.0),
    ):
        if random.random() < 0.4:
            fields[name] = random.choice((0.0, round(random.uniform(0.05, largest) / size, 3)))
    return fields


def _setup(random: Random) -> dict[str, object]:
    fields: dict[str, object] = {}
    if random.random() < 0.3:
        fields["name"] = random.choice(("PLATE", "COVER 12", "A (B) C"))
    if random.random() < 0.3:
        fields["work_offset"] = random.randint(54, 59)
    return fields


def _contour(places: list[complex], bulges: list[float], decimals: int) -> Contour:
    """The contour through these places, all numbers rounded; what the rounding leaves of an arc is moved or a line."""
    rounded = [complex(round(place.real, decimals), round(place.imag, decimals)) for place in places]
    elements = []
    for (start, end), bulge in zip(pairwise(rounded), bulges, strict=True):
        if start == end:
            continue
        if not bulge:
            elements.append(Element(end))
            continue
        center = (start + end) / 2.0 + 0.5j * (end - start) * (1.0 - bulge**2) / (2.0 * bulge)
        center = complex(round(center.real, decimals), round(center.imag, decimals))
        elements.append(Element(end, center, bulge > 0.0))
    return Contour(rounded[0], tuple(elements))


# the families: places in millimeters and the bulge (tan of a quarter of the sweep) of each element


Shape = tuple[list[complex], list[float]]


def polygon(random: Random) -> Shape:
    """Closed, corners on an oval, from mid-side or from a corner."""
    count, wide, size = random.randint(3, 10), random.uniform(1.0, 3.0), random.uniform(8.0, 60.0)
    corners = []
    for row in range(count):
        corner = rect(size, (row + random.uniform(-0.3, 0.3)) * tau / count)
        corners.append(complex(wide * corner.real, corner.imag))
    return _closed(random, corners, [0.0] * count)


def star(random: Random) -> Shape:
    """Closed, corners in and out, lines and arcs."""
    count, size = random.randint(3, 10), random.uniform(10.0, 70.0)
    angles = sorted(random.uniform(0.0, tau) for _ in range(count))
    corners = [rect(size * random.uniform(0.5, 1.4), angle) for angle in angles]
    return _closed(random, corners, [random.choice((0.0, random.uniform(-0.5, 0.5))) for _ in corners])


def chain(random: Random) -> Shape:
    """Open, lines and arcs at corners of every kind."""
    return _chain(random, random.randint(1, 8), _corner)


def tangent(random: Random) -> Shape:
    """Open, lines and arcs that run into one another."""
    return _chain(random, random.randint(2, 9), lambda _: 0.0)


def nearly_tangent(random: Random) -> Shape:
    """Open, corners of a fraction of a degree."""
    return _chain(random, random.randint(2, 7), lambda some: some.choice((-1, 1)) * 10.0 ** some.uniform(-8.0, -1.0))


def gear(random: Random) -> Shape:
    """Closed: tips and roots on two circles, straight flanks."""
    teeth, root, height = random.randint(5, 12), random.uniform(15.0, 50.0), random.uniform(2.0, 10.0)
    tip, gap, pitch = random.uniform(0.15, 0.45), random.uniform(0.15, 0.45), tau / teeth
    places, bulges = [], []
    free = (1.0 - tip - gap) * pitch / 2.0
    for tooth in range(teeth):
        angle = tooth * pitch
        places += [rect(root + height, angle), rect(root + height, angle + tip * pitch)]
        places += [rect(root, angle + tip * pitch + free), rect(root, angle + tip * pitch + free + gap * pitch)]
        bulges += [tan(tip * pitch / 4.0), 0.0, tan(gap * pitch / 4.0), 0.0]
    return _closed(random, places, bulges)


def rounded(random: Random) -> Shape:
    """Closed, tangent throughout: a rectangle with rounded corners."""
    wide, high = random.uniform(20.0, 90.0), random.uniform(20.0, 90.0)
    radius, places, bulges = random.uniform(0.5, 9.9), [], []
    for x, y, turn in ((1, -1, 1), (1, 1, 1j), (-1, 1, -1), (-1, -1, -1j)):
        corner = complex(x * wide, y * high) / 2.0
        places += [corner - radius * turn, corner + radius * 1j * turn]
        bulges += [tan(pi / 8.0), 0.0]
    return _closed(random, places, bulges)


def wavy_disc(random: Random) -> Shape:
    """Closed: a curve of many short lines with bays."""
    count, bays, depth = random.randint(30, 160), random.randint(2, 7), random.uniform(0.02, 0.3)
    size = random.uniform(8.0, 60.0)
    places = [rect(size * (1.0 + depth * cos(bays * row * tau / count)), row * tau / count) for row in range(count)]
    return _closed(random, places, [0.0] * count)


def notched(random: Random) -> Shape:
    """Closed: a square whose sides have notches and tiny steps."""
    size, places = random.uniform(20.0, 60.0), []
    for turn in (1, 1j, -1, -1j):
        at, depth, wide = random.uniform(-0.6, 0.5), random.uniform(0.01, 0.4), random.uniform(0.01, 0.35)
        step = random.choice((0.0, random.uniform(5e-5, 0.02)))
        side = [complex(-1.0, -1.0), complex(at, -1.0), complex(at, -1.0 + depth), complex(at + wide, -1.0 + depth)]
        side += [complex(at + wide, -1.0 + step)]
        side += [complex(0.95, -1.0 + step), complex(0.95, -1.0)] if step else []
        places += [size * turn * place for place in side]
    return _closed(random, places, [0.0] * len(places))


def spiral(random: Random) -> Shape:
    """Open: short lines or arcs, its turns from wide apart to closer than the cutter."""
    count, pitch, turns = random.randint(10, 80), random.uniform(2.0, 25.0), random.uniform(0.7, 3.0)
    angles = [0.8 + turns * tau * row / count for row in range(count + 1)]
    bulge = random.choice((0.0, tan(turns * tau / count / 4.0)))
    return [rect(pitch * angle / tau, angle) for angle in angles], [bulge] * count


def wave(random: Random) -> Shape:
    """Open: a wave of short lines, wider and tighter than the cutter."""
    count, length, height = random.randint(10, 120), random.uniform(8.0, 60.0), random.uniform(0.0, 15.0)
    step = random.uniform(0.2, 3.0)
    return [complex(step * row, height * sin(tau / length * step * row)) for row in range(count + 1)], [0.0] * count


def stairs(random: Random) -> Shape:
    """Open: steps from far smaller than the cutter to wider than it, up or down."""
    run, rise = random.choice((0.1, 1.0)) * random.uniform(0.2, 9.0), random.choice((-1, 1)) * random.uniform(0.1, 6.0)
    count = random.randint(2, 30)
    return [complex((row + 1) // 2 * run, row // 2 * rise) for row in range(count + 1)], [0.0] * count


def overrun(random: Random) -> Shape:
    """Open: a rectangle that starts and ends past its corner."""
    wide, high = random.uniform(15.0, 80.0), random.uniform(15.0, 80.0)
    before, past = random.uniform(0.5, 20.0), random.uniform(0.5, 20.0)
    return [complex(-before, 0), complex(wide, 0), complex(wide, high), complex(0, high), complex(0, -past)], [0.0] * 4


def bone(random: Random) -> Shape:
    """Closed: two round ends with a neck that the cutter may not pass."""
    long, neck, end = random.uniform(30.0, 80.0), random.uniform(1.0, 12.0), random.uniform(7.0, 20.0)
    reach = sqrt(max(end**2 - (neck / 2.0) ** 2, 1.0))
    corners = [complex(reach, -neck / 2), complex(long - reach, -neck / 2), complex(long - reach, neck / 2)]
    corners.append(complex(reach, neck / 2))
    ends = (tau - 2.0 * phase(complex(reach, neck / 2))) / 4.0
    return _closed(random, corners, [0.0, tan(ends), 0.0, tan(ends)])


def doubled(random: Random) -> Shape:
    """Open: along a wall, a hair's turn, and along it back and forth."""
    hair, tip = random.choice((0.0, 1e-6, 1e-4, 1e-2)), complex(random.uniform(20.0, 60.0))
    turned = tip - rect(random.uniform(2.0, 19.0), hair)
    end = turned + rect(random.uniform(3.0, 30.0), -hair)
    return [0j, tip, turned, end, end + random.uniform(5.0, 20.0) * 1j], [0.0] * 4


def dense(random: Random) -> Shape:
    """Closed: an outline of chords much shorter than the cutter."""
    count, size = random.randint(150, 400), random.uniform(6.0, 30.0)
    places = [rect(size * (1.0 + 0.05 * sin(5.0 * row * tau / count)), row * tau / count) for row in range(count)]
    return _closed(random, places, [0.0] * count)


FAMILIES: Final = (
    polygon,
    star,
    chain,
    tangent,
    nearly_tangent,
    gear,
    rounded,
    wavy_disc,
    notched,
    spiral,
    wave,
    stairs,
    overrun,
    bone,
    doubled,
    chain,
    star,
    tangent,
    dense,
)


def _closed(random: Random, corners: list[complex], bulges: list[float]) -> Shape:
    """Around and back to where it began: a corner, or the middle of the last side where that is a line."""
    if bulges[-1] or random.random() < 0.4:
        return [*corners, corners[0]], bulges
    middle = corners[-1] + random.uniform(0.2, 0.8) * (corners[0] - corners[-1])
    return [middle, *corners, middle], [0.0, *bulges[:-1], 0.0]


def _corner(random: Random) -> float:
    """The angle of a corner in radians: none, small, of the usual drawings, any, or turning back."""
    kind, sign = random.random(), random.choice((-1, 1))
    if kind < 0.25:
        return 0.0
    if kind < 0.35:
        return sign * random.uniform(0.0, 0.2)
    if kind < 0.6:
        return sign * random.choice((pi / 2, pi / 4, pi / 3))
    return sign * (random.choice((pi, 3.12, 3.05)) if kind < 0.63 else random.uniform(0.1, 2.4))


def _chain(random: Random, count: int, corner: Callable[[Random], float]) -> Shape:
    places, bulges, heading = [0j], [], random.uniform(-pi, pi)
    for row in range(count):
        heading += corner(random) if row else 0.0
        if random.random() < 0.55:
            places.append(places[-1] + rect(random.choice((0.02, 1.0, 1.0, 1.0)) * random.uniform(3.0, 60.0), heading))
            bulges.append(0.0)
            continue
        radius = random.choice((0.5, 3.0, 8.0, 25.0)) * random.uniform(0.8, 1.2)
        swept = random.choice((-1, 1)) * random.choice((0.3, 1.0, pi / 2, pi, 4.0)) * random.uniform(0.9, 1.1)
        places.append(places[-1] + rect(2.0 * radius * abs(sin(swept / 2.0)), heading + swept / 2.0))
        bulges.append(tan(swept / 4.0))
        heading += swept
    return places, bulges


# what is written


def program_file(case: Case, path: str, random: Random) -> str:
    """The program file of a case; `path` is CONTROL or BEST.  Some elements are typed by angle, radius or sweep."""
    lines = ["format = 1", f'units = "{case.unit}"', "", "[parameters]", *_fields(case.parameters)]
    lines += [f'path = "{path}"', "", "[setup]", *_fields(case.setup)]
    for number, diameter in ((1, case.diameter), (2, round(case.diameter * 0.75, 4))):
        lines += ["", "[[tool]]", f"number = {number}", 'type = "END MILL"', f"diameter = {diameter}"]
    for contour in case.contours:
        lines += ["", "[[block]]", 'kind = "MILL CONTOUR"', "tool = 1", f'cutter_comp = "{case.comp}"']
        lines += [f"x_start = {contour.start.real!r}", f"y_start = {contour.start.imag!r}", *_fields(case.start)]
        at = contour.start
        for row, element in enumerate(contour.elements):
            lines += ["", "[[block.segment]]", *_segment(at, element, case, random)]
            lines += [f"feed = {400.0 if case.unit == 'MM' else 16.0}"] if not row else []
            at = element.end
    return "\n".join([*lines, ""])


def _fields(fields: dict[str, object]) -> list[str]:
    return [
        f'{name} = "{value}"' if isinstance(value, str) else f"{name} = {value!r}" for name, value in fields.items()
    ]


def _segment(at: complex, element: Element, case: Case, random: Random) -> list[str]:
    end = [f"x_end = {element.end.real!r}", f"y_end = {element.end.imag!r}"]
    if element.center is None:
        way = element.end - at
        if random.random() < 0.03:
            # one end typed and the angle: the other is calculated
            return ['kind = "LINE"', end[abs(way.imag) > abs(way.real)], f"angle = {phase(way) * 360.0 / tau!r}"]
        return ['kind = "LINE"', *end]
    direction = f'direction = "{"CCW" if element.ccw else "CW"}"'
    radius = round(abs(at - element.center), case.decimals)
    if random.random() < 0.04 and radius > 0.0:
        return ['kind = "ARC"', direction, *end, f"radius = {radius!r}", f"choice = {random.choice((0, 1))}"]
    center = [f"x_center = {element.center.real!r}", f"y_center = {element.center.imag!r}"]
    return ['kind = "ARC"', direction, *end, *center]


def iso_program(case: Case, random: Random) -> str:
    """The first contour under G41 or G42 with tool 1, as most ISO controls read it, with leads that may not suit."""
    contour, side = case.contours[0], "G42" if "RIGHT" in case.comp else "G41"
    first = contour.elements[0]
    ahead = _direction(contour.start, first)
    lead = (
        case.diameter * random.choice((0.4, 1.0, 2.5)) * ahead * rect(1.0, random.choice((0.0, pi / 2, -pi / 2, 0.3)))
    )
    begin, end = contour.start - lead, contour.elements[-1].end + lead
    unit = "G21" if case.unit == "MM" else "G20"
    words = [f"{unit} G17 G40 G90 G91.1 G94", "T1 M6", f"G0 {_xy(begin)} Z5.", "G1 Z-1. F100."]
    words += [f"{side} D1 G1 {_xy(contour.start)}"]
    at = contour.start
    for element in contour.elements:
        if element.center is None:
            words.append(f"G1 {_xy(element.end)}")
        else:
            offset = element.center - at
            words.append(f"G{3 if element.ccw else 2} {_xy(element.end)} I{offset.real:.6f} J{offset.imag:.6f}")
        at = element.end
    return "\n".join([*words, f"G40 G1 {_xy(end)}", "G0 Z5.", "M30", ""])


def klartext_program(case: Case, random: Random) -> str:
    """The first contour under RL or RR with tool 1, in Klartext."""
    contour, side = case.contours[0], "RR" if "RIGHT" in case.comp else "RL"
    ahead = _direction(contour.start, contour.elements[0])
    lead = (
        case.diameter * random.choice((0.4, 1.0, 2.5)) * ahead * rect(1.0, random.choice((0.0, pi / 2, -pi / 2, 0.3)))
    )
    unit = "MM" if case.unit == "MM" else "INCH"
    words = [f"BEGIN PGM P {unit}", f"TOOL DEF 1 L+0 R+{case.diameter / 2:.4f}", "TOOL CALL 1 Z S3000 F600"]
    words += [f"L {_signed(contour.start - lead)} R0 FMAX", "L Z-1 FMAX", f"L {_signed(contour.start)} {side} F300"]
    for element in contour.elements:
        if element.center is None:
            words.append(f"L {_signed(element.end)}")
        else:
            words += [f"CC {_signed(element.center)}", f"C {_signed(element.end)} DR{'+' if element.ccw else '-'}"]
    words += [f"L {_signed(contour.elements[-1].end + lead)} R0 FMAX", "L Z+50 FMAX M30", f"END PGM P {unit}"]
    return "".join(f"{row} {text}\n" for row, text in enumerate(words))


def _direction(start: complex, element: Element) -> complex:
    way = element.end - start
    if element.center is not None:
        way = (start - element.center) * (1j if element.ccw else -1j)
    return way / abs(way) if way else 1.0 + 0j


def _xy(place: complex) -> str:
    return f"X{place.real:.6f} Y{place.imag:.6f}"


def _signed(place: complex) -> str:
    return f"X{place.real:+.6f} Y{place.imag:+.6f}"
