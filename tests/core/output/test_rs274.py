"""Posted programs, run by LinuxCNC's own interpreter: it accepts them and moves as the passes say."""

from __future__ import annotations

import re
from itertools import pairwise
from math import cos, hypot, pi, sin
from pathlib import Path as File

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from core.comp.compensated import CenterPath
from core.controls.write.contour_pass import CenterMove
from core.controls.write.written_program import Posted
from core.geometry.piece import Arc, Line, Piece, Point, Turn
from core.output.nc import center_path_program
from core.output.passes import Cutter, Job, passes
from core.units import Unit
from tests import rs274
from tests.core.output.jobs import INCH, arc, floors, job, path_of, polyline

SCALE = {Unit.IN: INCH, Unit.MM: 1.0}
TOOLS = {1: 0.5, 2: 0.25}


def posted(one: Job, unit: Unit, name: str = "PART") -> str:
    found = center_path_program([one], unit, name=name)
    assert isinstance(found, Posted), found
    return found.text


def expected(one: Job, unit: Unit) -> list[tuple[float, ...]]:
    """x, y, z, center and turn of every motion that moves, in program units; an arc's turn is 1 or -1."""
    found = [_row(motion, SCALE[unit]) for each in passes(one) for motion in each.motions]
    return found[:1] + [row for before, row in pairwise(found) if row[:3] != before[:3] or row[5]]


def _row(motion: CenterMove, scale: float) -> tuple[float, ...]:
    center = motion.center if motion.turn is not Turn.NONE else (0.0, 0.0)
    return (*(value / scale for value in (motion.x, motion.y, motion.z, *center)), float(motion.turn))


def run_on_rs274(text: str, folder: File) -> rs274.Ran:
    found = rs274.run(text, TOOLS, folder)
    assert found.accepted, f"{found.said}\n{text}"
    return found


def same(one: Job, unit: Unit, folder: File) -> None:
    """The interpreter's moves are the passes' motions to four decimals."""
    found, wanted = run_on_rs274(posted(one, unit), folder).moves[1:], expected(one, unit)
    assert len(found) == len(wanted)
    for move, want in zip(found, wanted, strict=True):
        assert move[1:] == pytest.approx(want, abs=0.6e-4)


PARTS = {
    "lines": polyline((0, 0), (2, 0), (2, 2), (0, 2), (0, 0)),
    "both turns": path_of(
        arc((0, 0), (1, 1), (0, 1), Turn.CCW),
        arc((1, 1), (2, 2), (2, 1), Turn.CW),
        *polyline((2, 2), (1 / 3, 1 / 7)),
    ),
    "full circle": path_of(arc((1, 0), (1, 0), (0.25, 0), Turn.CCW)),
    "full circle clockwise": path_of(arc((1, 0), (1, 0), (0.25, 0), Turn.CW), *polyline((1, 0), (2, 1))),
    "more than half a turn": path_of(arc((1, 0), (0, -1), (0, 0), Turn.CCW)),
    "far away": polyline((3937.1, -3937.3), (3937.9, -3936.1), (-3937.7, 1.23456)),
}


@pytest.mark.parametrize("unit", list(Unit))
@pytest.mark.parametrize("name", list(PARTS))
def test_the_interpreter_moves_as_the_passes_say(name, unit, tmp_path):
    same(job(PARTS[name]), unit, tmp_path)


@pytest.mark.parametrize("unit", list(Unit))
def test_a_finish_tool_with_blend_moves(unit, tmp_path):
    contour = polyline((1, 1), (3, 1), (3, 2))
    blend_in = path_of(arc((0.875, 1.125), (1, 1), (1, 1.125), Turn.CCW))
    blend_out = path_of(arc((3, 2), (2.875, 2.125), (2.875, 2), Turn.CCW))
    one = job(
        contour,
        finish=(CenterPath(contour, blend_in, blend_out),),
        rough=(CenterPath(contour, blend_in, offset=0.5),),
        finisher=Cutter(2, 0.25 * INCH, "END MILL"),
        finish_tool=2,
        finish_z=0.254,
    )
    wanted, found = expected(one, unit), run_on_rs274(posted(one, unit), tmp_path)
    change = next(index for index, call in enumerate(found.calls) if call.startswith("CHANGE_TOOL(2)"))
    assert found.calls[change - 1].startswith("STOP_SPINDLE")
    places = [move[1:] for move in found.moves]
    seconds = len([motion for each in passes(one) if each.finishing for motion in each.motions])
    places = places[1 : -seconds - 1] + places[-seconds:]
    for place, want in zip(places, wanted, strict=True):
        assert place == pytest.approx(want, abs=0.6e-4)


def test_a_ramp_and_a_helix(tmp_path):
    path = path_of(*polyline((0, 0), (1, 0)), arc((1, 0), (1, 0), (1, 0.5), Turn.CCW))
    low, high = floors(2)
    climbs = (low.__class__(1, -6.35, -2.54, 254.0), high.__class__(2, -2.54, 0.0, 254.0))
    for peck in (0.0, 0.1 * INCH):
        same(job(path, floors=climbs, peck_depth=peck), Unit.IN, tmp_path)


@pytest.mark.parametrize("unit", list(Unit))
@pytest.mark.parametrize("sweep", [1e-6, 1e-3, 0.1, 2.0, 4.0, 2 * pi - 1e-6])
def test_tiny_arcs_are_accepted_and_never_become_circles(sweep, unit, tmp_path):
    """Read as written, the path is as long as meant, to a few last digits for each line."""
    texts = []
    for radius in (1e-5, 1e-4, 3e-4, 1e-3, 0.005, 0.01, 0.03, 0.1):
        for piece in (_swept((1.0, 1.0), 0.1, radius, sweep), _swept((1.0, 1.0), 2.0, radius, -sweep)):
            texts.append(posted(job(path_of(piece), peck_depth=0.0), unit))
            length, lines = measured(texts[-1])
            digit = 1e-5 if unit is Unit.IN else 1e-4
            assert abs(length - piece.length / SCALE[unit]) <= 6 * digit * max(lines, 1), radius
    assert all(text.endswith("M30\n") for text in texts)
    # one after the other as one program
    run_on_rs274("".join(text.removesuffix("M30\n") for text in texts) + "M30\n", tmp_path)


def measured(text: str) -> tuple[float, int]:
    """Length in XY of the G1, G2 and G3 lines, and their number."""
    place, total, count = (0.0, 0.0), 0.0, 0
    for line in text.splitlines():
        words = dict(re.findall(r"([XYIJ])(-?[\d.]+)", line)) if re.match(r"G[0-3] ", line) else {}
        end = (float(words.get("X", place[0])), float(words.get("Y", place[1])))
        if "I" in words:
            center = (place[0] + float(words["I"]), place[1] + float(words["J"]))
            total += Arc(place, end, center, Turn.CW if line.startswith("G2") else Turn.CCW).length
        elif words and not line.startswith("G0"):
            total += hypot(end[0] - place[0], end[1] - place[1])
        count += bool(words) and not line.startswith("G0")
        place = end
    return total, count


def _swept(start: Point, angle: float, radius: float, sweep: float) -> Arc:
    center = (start[0] - radius * cos(angle), start[1] - radius * sin(angle))
    end = (center[0] + radius * cos(angle + sweep), center[1] + radius * sin(angle + sweep))
    return Arc(start, end, center, Turn.CCW if sweep > 0 else Turn.CW)


def test_hostile_names_are_harmless(tmp_path):
    found = run_on_rs274(posted(job(PARTS["lines"]), Unit.IN, name="x) G0 Z-5 (MSG, \n M2 % LOGOPEN,/tmp/x"), tmp_path)
    assert len(found.moves) == 1 + len(expected(job(PARTS["lines"]), Unit.IN))


def test_the_interpreter_refuses_a_tool_its_table_does_not_have(tmp_path):
    rs274.require()
    found = rs274.run(posted(job(PARTS["lines"]), Unit.IN), {9: 0.5}, tmp_path)
    assert not found.accepted
    assert "tool 1" in found.said


steps = st.tuples(
    st.floats(0.05, 20.0),
    st.floats(0, 2 * pi),
    st.one_of(st.none(), st.floats(0.1, 2 * pi - 0.1), st.floats(-2 * pi + 0.1, -0.1)),
)
"""Arcs whose ends are so far apart that none of them is written as lines or as two halves."""


@given(moves=st.lists(steps, min_size=1, max_size=25), unit=st.sampled_from(list(Unit)))
@settings(
    derandomize=True,
    max_examples=60,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
def test_any_joined_path_is_run_as_it_is(moves, unit, tmp_path):
    same(job(path_of(*joined_pieces(moves)), peck_depth=0.0), unit, tmp_path)


def joined_pieces(moves: list[tuple[float, float, float | None]]) -> list[Piece]:
    """Lines of a length and direction, arcs of a radius, first direction from the center, and sweep."""
    place: Point = (10.0, -20.0)
    found: list[Piece] = []
    for size, angle, sweep in moves:
        if sweep is None:
            found.append(Line(place, (place[0] + size * cos(angle), place[1] + size * sin(angle))))
        else:
            found.append(_swept(place, angle, size, sweep))
        place = found[-1].end
    return found
