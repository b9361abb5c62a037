"""What holds for any compensated contour: against the conversational side's own offset, and in the mirror."""

from __future__ import annotations

from math import atan2, copysign, cos, hypot, pi, sin

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from core.comp.compensate import compensate
from core.controls.control_run import ControlRun
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Point, Side, Turn
from core.verify.judge import judge
from tests.core.controls.klartext.klartext_runs import runs

LEG = st.tuples(st.floats(-1.8, 1.8), st.floats(12, 60), st.sampled_from([0, 1, -1]), st.floats(0.3, 2.0))
LEGS = st.lists(LEG, min_size=1, max_size=4)
FAR = 900.0


def pieces_of(legs: list[tuple[float, float, int, float]]) -> list[Piece]:
    """Lines and arcs one after the other, each at an angle to the one before it."""
    pieces: list[Piece] = []
    at, heading = (0.0, 0.0), 0.0
    for bend, size, turn, sweep in legs:
        heading += bend
        if not turn:
            end = (at[0] + size * cos(heading), at[1] + size * sin(heading))
            pieces.append(Line(at, end))
        else:
            center = (at[0] - turn * size * sin(heading), at[1] + turn * size * cos(heading))
            begin = atan2(at[1] - center[1], at[0] - center[0])
            end = (center[0] + size * cos(begin + turn * sweep), center[1] + size * sin(begin + turn * sweep))
            pieces.append(Arc(at, end, center, Turn(turn)))
            heading += turn * sweep
        at = end
    return pieces


def spot(point: Point, flip: int = 1) -> str:
    return f"X{point[0]:+.12f} Y{flip * point[1]:+.12f}"


def programmed(pieces: list[Piece], side: Side, flip: int = 1) -> ControlRun:
    """The pieces run by the control, with `flip` -1 in the mirror of the X axis."""
    word = "RL" if (side is Side.LEFT) == (flip == 1) else "RR"
    blocks = [f"L X{-FAR} Y{-FAR * flip} R0 FMAX", f"L {spot(pieces[0].start, flip)} {word} F100"]
    for piece in pieces:
        if isinstance(piece, Arc):
            blocks.append(f"CC {spot(piece.center, flip)}")
            blocks.append(f"C {spot(piece.end, flip)} DR{'+' if piece.turn * flip > 0 else '-'}")
        else:
            blocks.append(f"L {spot(piece.end, flip)}")
    return runs(*blocks, f"L X{FAR} Y{FAR * flip} R0", radius=4.0)


def contour_path(made: ControlRun) -> Path:
    """The compensated moves without entry and exit."""
    return made.moves.part(2, len(made.moves) - 1).path()


@settings(max_examples=60, deadline=None, derandomize=True)
@given(LEGS, st.sampled_from(list(Side)))
def test_where_the_look_ahead_deletes_nothing_the_paths_are_one(
    legs: list[tuple[float, float, int, float]], side: Side
) -> None:  # fmt: skip
    pieces = pieces_of(legs)
    other = compensate(Path.from_pieces(pieces), side, 4.0, 1, closed=False)
    assume(not len(other.deleted) and not bool(other.bridged.any()) and not other.findings)
    made = programmed(pieces, side)
    assume(made.stopped_at is None)
    path = contour_path(made)
    # The control looks at neighbors only; where its path gouges the two rules may differ.
    assume(judge(Path.from_pieces(pieces), side, 4.0, path).clean)
    assert path.turns.tolist() == other.path.turns.tolist()
    assert float(np.abs(path.points - other.path.points).max()) < 1e-6


@settings(max_examples=40, deadline=None, derandomize=True)
@given(LEGS, st.sampled_from(list(Side)))
def test_in_the_mirror_everything_is_the_same(legs: list[tuple[float, float, int, float]], side: Side) -> None:
    pieces = pieces_of(legs)
    made, other = programmed(pieces, side), programmed(pieces, side, -1)
    assert made.stopped_at == other.stopped_at
    assert made.moves.turns.tolist() == (-other.moves.turns).tolist()
    assert np.allclose(made.moves.points * (1, -1, 1), other.moves.points, rtol=0.0, atol=1e-7)


@settings(max_examples=60, deadline=None, derandomize=True)
@given(LEGS, st.sampled_from(list(Side)))
def test_every_corner_of_the_path_is_a_radius_or_more_from_the_corner_it_comes_from(
    legs: list[tuple[float, float, int, float]], side: Side
) -> None:  # fmt: skip
    pieces = pieces_of(legs)
    made = programmed(pieces, side)
    assume(made.stopped_at is None)
    corners = {2 + 3: pieces[0].start}
    line = 5
    for piece in pieces:
        line += 2 if isinstance(piece, Arc) else 1
        corners[line] = piece.end
    for move in list(made.moves)[2:-1]:
        x, y = corners[move.line]
        assert hypot(move.point[0] - x, move.point[1] - y) > 4.0 - 1e-6


@settings(max_examples=60, deadline=None, derandomize=True)
@given(
    st.floats(0, 2 * pi), st.floats(20, 60), st.floats(0.2, 0.8), st.booleans(), st.integers(2, 4),
    st.sampled_from(["RL", "RR"]),
)  # fmt: skip
def test_tangent_arcs_with_rounded_coordinates_raise_no_alarm(
    angle: float, radius: float, share: float, outside: bool, decimals: int, side: str
) -> None:
    # Their radii at the joint differ by the rounding; the offsets have to meet all the same.
    small = max(share * radius, 8.0)
    joint = (radius * cos(angle), radius * sin(angle))
    reach = (radius + small) / radius if outside else (radius - small) / radius
    center = (joint[0] * reach, joint[1] * reach)
    swept = -1.0 if outside else 1.0
    begin = atan2(joint[1] - center[1], joint[0] - center[0])
    end = (center[0] + small * cos(begin + swept), center[1] + small * sin(begin + swept))
    start = (radius * cos(angle - 1), radius * sin(angle - 1))
    before = (start[0] + 20 * sin(angle - 1), start[1] - 20 * cos(angle - 1))
    sign = copysign(1.0, swept)
    behind = (end[0] - sign * 20 * sin(begin + swept), end[1] + sign * 20 * cos(begin + swept))

    def at(point: Point) -> str:
        return f"X{point[0]:+.{decimals}f} Y{point[1]:+.{decimals}f}"

    blocks = [f"L {at(before)} {side} F100", f"L {at(start)}", "CC X+0 Y+0", f"C {at(joint)} DR+"]
    blocks += [f"CC {at(center)}", f"C {at(end)} DR{'-' if outside else '+'}", f"L {at(behind)}"]
    made = runs("L X-900 Y-900 R0 FMAX", *blocks, "L X+900 Y+900 R0", radius=3.0)
    assert made.stopped_at is None, made.findings
