"""Drawings rounded to 3 to 6 decimals with tangent arcs give closed best paths and clean verdicts.

The round trip from a drawing to segments, to the program of a control, and back gives the same contour.
"""

from __future__ import annotations

import random
from dataclasses import replace
from itertools import pairwise
from math import atan2, cos, hypot, pi, sin, sqrt, tan

import numpy as np
import pytest

from core.comp.best_path.best_path import best_path
from core.controls.control_tools import CutterTool, table_of
from core.controls.write.written_program import Posted
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Point, Side, Turn
from core.importing.contour import Contour, ContourKind, fitted_contour, reversed_contour
from core.importing.nc import read_nc
from core.importing.nc_contour import nc_blocks
from core.importing.segments import block_of, with_contours
from core.pipeline.derive import derive
from core.pipeline.post import post_control_program
from core.program.model import Number, Program, Tool
from core.program.solve.block import solve_block
from core.units import Unit
from core.verify.judge import judge
from tests.core.importing.drawings import dxf, ellipse, entity, line, listed

SEEDS = range(6)


def rounded_polygon(seed: int) -> tuple[Piece, ...]:
    """A star-shaped polygon with all corners rounded by tangent arcs, as in CAD drawings."""
    rng = random.Random(f"rounded {seed}")
    count = rng.randint(4, 9)
    corners = []
    for number in range(count):
        angle = 2 * pi * (number + 0.5 * rng.random()) / count
        reach = rng.uniform(40.0, 60.0)
        corners.append((reach * cos(angle), reach * sin(angle)))
    return _filleted(corners, [rng.uniform(2.0, 6.0) for _ in corners])


def _filleted(corners: list[Point], radii: list[float]) -> tuple[Piece, ...]:
    arcs = []
    for row, corner in enumerate(corners):
        before, after = corners[row - 1], corners[(row + 1) % len(corners)]
        arcs.append(_fillet(before, corner, after, radii[row]))
    pieces: list[Piece] = []
    for arc, following in pairwise([*arcs, arcs[0]]):
        pieces += [arc, Line(arc.end, following.start)]
    return tuple(pieces)


def _fillet(before: Point, corner: Point, after: Point, radius: float) -> Arc:
    """The arc tangent to both sides of a corner."""
    u, v = (_unit(corner, point) for point in (before, after))
    half = atan2(abs(u[0] * v[1] - u[1] * v[0]), u[0] * v[0] + u[1] * v[1]) / 2.0
    reach = radius / tan(half)
    start, end = ((corner[0] + reach * side[0], corner[1] + reach * side[1]) for side in (u, v))
    middle = (u[0] + v[0], u[1] + v[1])
    size = hypot(*middle)
    depth = sqrt(radius**2 + reach**2)
    center = (corner[0] + middle[0] / size * depth, corner[1] + middle[1] / size * depth)
    left = u[0] * v[1] - u[1] * v[0] > 0.0
    return Arc(start, end, center, Turn.CW if left else Turn.CCW)


def _unit(start: Point, end: Point) -> Point:
    size = hypot(end[0] - start[0], end[1] - start[1])
    return (end[0] - start[0]) / size, (end[1] - start[1]) / size


def contour_of(pieces: tuple[Piece, ...], decimals: int) -> Contour:
    """The contour of a drawing of these pieces."""
    contours = listed(dxf(*(entity(piece, decimals) for piece in pieces))).contours
    assert len(contours) == 1
    return contours[0]


def typed_surface(contour: Contour) -> Path:
    """The contour as typed on the form."""
    program = Program(unit=Unit.MM)
    solved = solve_block(block_of(contour, program).block, program)
    return Path.from_pieces([piece for _, piece in solved.pieces])


@pytest.mark.parametrize("decimals", [3, 4, 5, 6])
def test_a_rounded_drawing_has_closed_best_paths_and_clean_verdicts(decimals: int) -> None:
    judged = 0
    for seed in SEEDS:
        pieces = rounded_polygon(seed)
        exact, rounded = (typed_surface(contour_of(pieces, count)) for count in (12, decimals))
        for side in Side:
            true_path = best_path(exact, side, 5.0, closed=True)
            best = best_path(rounded, side, 5.0, closed=True)
            assert len(best.loops) == len(true_path.loops), (seed, side)
            assert all(best.closed), (seed, side)
            verdict = judge(rounded, side, 5.0, best.loops)
            assert (verdict.judged, verdict.gouges, verdict.wrong_side) == (True, (), ()), (seed, side)
            judged += 1
    assert judged == 2 * len(SEEDS)


def test_imported_numbers_have_the_digits_of_the_form() -> None:
    for seed in SEEDS:
        contour = contour_of(rounded_polygon(seed), 12)
        for unit, decimals in ((Unit.MM, 3), (Unit.IN, 4)):
            item = block_of(contour, Program(unit=unit))
            assert item.moved <= 0.00254
            if item.decimals == decimals:
                values = [segment.x_end.value for segment in item.block.segments]
                assert values == [round(value, decimals) for value in values]
            assert item.block.segments[-1].x_end == item.block.x_start


def test_arcs_too_small_for_the_digits_of_the_form_get_more_digits_and_a_note() -> None:
    corners = [(0.0, 0.0), (40.0, 1.0), (41.0, 30.0), (1.0, 29.0)]
    contour = contour_of(_filleted(corners, [0.02] * 4), 12)
    assert contour.drawn == 8
    item = block_of(contour, Program(unit=Unit.IN))
    assert item.decimals == 6
    assert item.moved <= 0.0001
    assert item.notes == ("Chain 1 has 6 decimals: with 4 it would move too far, or not close.",)


@pytest.mark.parametrize(
    "control", ["linuxcnc", "klartext", "threeblock", "rosettacnc:easy", "nine-series:a", "fanuc:a"]
)
def test_a_drawing_posted_and_read_back_is_the_same_contour(control: str) -> None:
    contour = contour_of(rounded_polygon(3), 6)
    tool = Tool(1, diameter=Number(8.0), speed=Number(3000.0), plunge_feed=Number(100.0))
    empty = Program(unit=Unit.MM, tools=(tool,))
    program, _ = with_contours(empty, [contour])
    program = replace(program, blocks=(replace(program.blocks[0], z_bottom=Number(-5.0)),))
    derived = derive(program)
    posted = post_control_program(derived, name="part", control=control)
    assert isinstance(posted, Posted), posted
    read = read_nc(posted.text.encode(), control, table_of(CutterTool(1, 8.0, unit=Unit.MM)))
    back, _ = nc_blocks(Program(unit=Unit.MM), read)
    surfaces = [[piece for _, piece in solve_block(made.blocks[0], made).pieces] for made in (program, back)]
    assert len(surfaces[0]) == len(surfaces[1])
    for one, other in zip(*surfaces, strict=True):
        assert type(one) is type(other)
        for share in (0.0, 0.5, 1.0):
            assert one.point_at(share) == pytest.approx(other.point_at(share), abs=0.001)


@pytest.mark.parametrize("unit", list(Unit))
def test_a_contour_of_arcs_closes_and_is_clean(unit: Unit) -> None:
    diameter = Number(1.0 if unit is Unit.MM else 0.04)
    empty = Program(unit=unit, tools=(Tool(1, diameter=diameter, speed=Number(3000.0), plunge_feed=Number(20.0)),))
    for seed in SEEDS:
        rng = random.Random(f"ellipse {seed}")
        center, axis = ((rng.uniform(-80.0, 80.0), rng.uniform(-80.0, 80.0)) for _ in range(2))
        contour = listed(dxf(ellipse(center, axis, rng.uniform(0.3, 0.95)))).contours[0]
        assert all(isinstance(piece, Arc) for piece in contour.pieces)
        program, (made,) = with_contours(empty, [contour])
        program = replace(program, blocks=(replace(program.blocks[0], z_bottom=Number(-1.0)),))
        codes = {finding.code for finding in derive(program).blocks[0].findings}
        assert not codes & {"GOUGE", "NEARLY_CLOSED"}, (seed, made.decimals, codes)


@pytest.mark.parametrize("unit", list(Unit))
def test_a_start_on_a_slanted_line_makes_no_inside_corner(unit: Unit) -> None:
    """Rounded toward the part, START would be an inside corner of a few microns, which the path does not avoid."""
    diameter = Number(8.0 if unit is Unit.MM else 0.3)
    empty = Program(unit=unit, tools=(Tool(1, diameter=diameter, speed=Number(3000.0), plunge_feed=Number(20.0)),))
    for degrees in range(1, 60, 2):
        corners = [(30.0 * cos(at), 30.0 * sin(at)) for at in (degrees * pi / 180 + k * pi / 3 for k in range(7))]
        contour = listed(dxf(*(line(start, end) for start, end in pairwise(corners)))).contours[0]
        for each in (contour, reversed_contour(contour), replace(contour, kind=ContourKind.HOLE)):
            program, (made,) = with_contours(empty, [each])
            program = replace(program, blocks=(replace(program.blocks[0], z_bottom=Number(-1.0)),))
            codes = {finding.code for finding in derive(program).blocks[0].findings}
            assert not codes & {"GOUGE", "BLEND_GOUGES", "BACKWARDS"}, (degrees, each.kind, codes)
            assert not made.notes


def test_a_curve_of_2000_lines_becomes_few_arcs() -> None:
    at = np.linspace(0.0, 2.0 * pi, 2001)
    points = [(float(40 * cos(t) + 6 * cos(3 * t)), float(25 * sin(t))) for t in at]
    points[-1] = points[0]
    contour = listed(dxf(*(line(start, end) for start, end in pairwise(points)))).contours[0]
    assert contour.drawn == 2000
    fitted = fitted_contour(contour, 0.005)
    assert fitted.fitted is not None
    assert fitted.drawn <= 80
    assert fitted.fitted.deviation <= 0.005
    samples = np.array([complex(*piece.point_at(share)) for piece in fitted.pieces for share in np.linspace(0, 1, 40)])
    curve = 40 * np.cos(at) + 6 * np.cos(3 * at) + 25j * np.sin(at)
    middles = (curve[1:] + curve[:-1]) / 2
    every = np.concatenate((curve, middles))
    nearest = [float(np.abs(every - sample).min()) for sample in samples[::7]]
    # the points of the curve are up to 0.07 mm apart
    assert max(nearest) <= 0.05
