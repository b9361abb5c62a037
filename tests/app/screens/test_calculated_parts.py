"""Five drawings keyed in at 80x24 from their dimensions alone, posted and run by LinuxCNC; one killed and restored.

The coordinates are compared with an independent calculation: closed formulas for each figure.
"""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import acos, atan2, cos, dist, hypot, isclose, pi, sin, tan
from pathlib import Path

import pytest

from app.documents.files import load, save
from core.pipeline.derive import derive
from core.pipeline.post import post_center_path
from core.program.edit import new_block
from core.program.fields import FIELDS_OF_FORM, Form
from core.program.model import Number, Program, Tool
from core.units import Unit
from tests.app.widget_pilot import Operator
from tests.rs274 import Ran, run
from tests.terminal import Terminal, cutcomp, running

PATIENCE = 60.0
BYTES = {"tab": b"\t", "enter": b"\r", "pageup": b"\x1b[5~", "pagedown": b"\x1b[6~", "space": b" "}
"""What a terminal sends for the named keys."""
BACK_TAB, SAVE = b"\x1b[Z", b"\x13"
FEED = 444.0
Keys = tuple[str, ...]
Point = tuple[float, float]


# keys


def start(x: float, y: float, side: str = "") -> Keys:
    """The keys that fill in START from TOOL on and move the cursor to X END of segment 1."""
    return ("enter", *side, "enter", f"'{x:g}", "enter", f"'{y:g}", "enter", "'-5", "enter")


def fields(form: Form, typed: dict[str, float | bool]) -> Keys:
    """The keys that fill in a segment from its first field; Space toggles TANGENT, and SOLUTION, reached by Enter."""
    names = [field.name for field in FIELDS_OF_FORM[form]]
    at, keys = 0, list[str]()
    for name in sorted(typed.keys() - {"choice"}, key=names.index):
        keys += ["tab"] * (names.index(name) - at)
        keys.append("space" if name == "tangent" else f"'{typed[name]:g}")
        at = names.index(name)
    return (*keys, "enter", "space") if "choice" in typed else tuple(keys)


def line(**typed: float | bool) -> Keys:
    return fields(Form.LINE, typed)


def arc(direction: str, **typed: float | bool) -> Keys:
    return ("a", *direction, *fields(Form.ARC, typed))


def blend(radius: float) -> Keys:
    return ("b", f"'{radius:g}")


def sent(keys: Keys) -> bytes:
    """The bytes that a terminal sends for keys."""
    return b"".join(BYTES.get(key) or key.removeprefix("'").encode() for key in keys)


# the drawings


@dataclass(frozen=True)
class Drawing:
    """The keys, and the expected moves: the end of a line, or (center, end) of an arc."""

    keys: Keys
    segments: int
    moves: Callable[[], Sequence[Point | tuple[Point, Point]]]


def rounded_corner() -> list[Point | tuple[Point, Point]]:
    """Lines at 30 and 300 degrees through (0, 0) and (100, 0), rounded by 5: the half angle between them is 45."""
    a, b = pi / 6.0, 5.0 * pi / 3.0
    first = 100.0 * sin(-b) / sin(a - b)
    corner = (first * cos(a), first * sin(a))
    inside = (pi - abs((b - a + pi) % (2.0 * pi) - pi)) / 2.0
    back = 5.0 / tan(inside)
    touch = (corner[0] - back * cos(a), corner[1] - back * sin(a))
    leave = (corner[0] + back * cos(b), corner[1] + back * sin(b))
    center = (touch[0] + 5.0 * sin(a), touch[1] - 5.0 * cos(a))
    return [touch, (center, leave), (100.0, 0.0)]


def square_fillet() -> list[Point | tuple[Point, Point]]:
    """A fillet of radius 10 between the X axis and the line X 60."""
    return [(50.0, 0.0), ((50.0, 10.0), (60.0, 10.0)), (60.0, 40.0)]


def third_corner(first: Point, second: Point, a: float, b: float, side: float) -> Point:
    """The point a from the first and b from the second, to the left (1) or right (-1), by the law of cosines."""
    between = dist(first, second)
    angle = side * acos((a * a + between * between - b * b) / (2.0 * a * between))
    heading = atan2(second[1] - first[1], second[0] - first[0]) + angle
    return first[0] + a * cos(heading), first[1] + a * sin(heading)


def between(first: Point, second: Point, part: float) -> Point:
    return first[0] + part * (second[0] - first[0]), first[1] + part * (second[1] - first[1])


def three_arcs() -> list[Point | tuple[Point, Point]]:
    """A CW arc of 30 tangent to CCW arcs of 20 about (0, 20) and 15 about (80, 30); its center is outside both."""
    first, last = (0.0, 20.0), (80.0, 30.0)
    center = third_corner(first, last, 50.0, 45.0, -1.0)
    return [
        (first, between(first, center, 20.0 / 50.0)),
        (center, between(last, center, 15.0 / 45.0)),
        (last, (80.0, 45.0)),
    ]


def cam() -> list[Point | tuple[Point, Point]]:
    """Base circle 20 about (0, 0), nose 8 about (30, 0), flanks of 60 around both; the cutter path is 3 outside."""
    base, nose = (0.0, 0.0), (30.0, 0.0)
    low, high = (third_corner(base, nose, 40.0, 52.0, side) for side in (1.0, -1.0))
    joints = [
        between(low, base, 63.0 / 40.0),
        between(low, nose, 63.0 / 52.0),
        between(high, nose, 63.0 / 52.0),
        between(high, base, 63.0 / 40.0),
    ]
    return [(base, joints[0]), (low, joints[1]), (nose, joints[2]), (high, joints[3])]


def slot() -> list[Point | tuple[Point, Point]]:
    """A slot 12 wide at 60 degrees about (40, 30), open at the edge Y 60 of a 100 by 60 plate."""
    along, across = (cos(pi / 3.0), sin(pi / 3.0)), (sin(pi / 3.0), -cos(pi / 3.0))
    right = (40.0 + 6.0 * across[0], 30.0 + 6.0 * across[1])
    left = (40.0 - 6.0 * across[0], 30.0 - 6.0 * across[1])
    mouth = [(x + (60.0 - y) * along[0] / along[1], 60.0) for x, y in (right, left)]
    corners: list[Point | tuple[Point, Point]] = [(100.0, 0.0), (100.0, 60.0), mouth[0], right, ((40.0, 30.0), left)]
    return [*corners, mouth[1], (0.0, 60.0), (0.0, 0.0)]


PAGE_DOWN: Keys = ("pagedown",)
DRAWINGS = {
    "rounded corner": Drawing(
        start(0, 0) + line(angle=30) + PAGE_DOWN + blend(5) + PAGE_DOWN + line(x_end=100, y_end=0, angle=300),
        3,
        rounded_corner,
    ),
    "square fillet": Drawing(
        start(0, 0)
        + line(angle=0)
        + PAGE_DOWN
        + arc("ccw", radius=10, tangent=True)
        + PAGE_DOWN
        + line(x_end=60, y_end=40, angle=90, tangent=True),
        3,
        square_fillet,
    ),
    "three arcs": Drawing(
        start(0, 0)
        + arc("ccw", x_center=0, y_center=20, radius=20)
        + PAGE_DOWN
        + arc("cw", radius=30, tangent=True)
        + PAGE_DOWN
        + arc("ccw", x_end=80, y_end=45, x_center=80, y_center=30, radius=15, tangent=True, choice=True),
        3,
        three_arcs,
    ),
    "cam": Drawing(
        start(-20, 0, "r")
        + arc("ccw", x_center=0, y_center=0, radius=20)
        + PAGE_DOWN
        + arc("ccw", radius=60, tangent=True)
        + PAGE_DOWN
        + arc("ccw", x_center=30, y_center=0, radius=8, tangent=True)
        + PAGE_DOWN
        + arc("ccw", radius=60, tangent=True)
        + PAGE_DOWN
        + arc("ccw", x_end=-20, y_end=0, x_center=0, y_center=0, radius=20, tangent=True, choice=True),
        5,
        cam,
    ),
    "angled slot": Drawing(
        start(0, 0)
        + line(x_end=100, y_end=0)
        + PAGE_DOWN
        + line(x_end=100, y_end=60)
        + PAGE_DOWN
        + line(angle=180)
        + PAGE_DOWN
        + line(angle=240)
        + PAGE_DOWN
        + arc("cw", x_center=40, y_center=30, radius=6, tangent=True)
        + PAGE_DOWN
        + line(angle=60, tangent=True)
        + PAGE_DOWN
        + line(x_end=0, y_end=60, angle=180)
        + PAGE_DOWN
        + line(x_end=0, y_end=0),
        8,
        slot,
    ),
}


# the machine


def new_program() -> Program:
    """An empty contour for a cutter of 6 mm."""
    tools = (Tool(1, "END MILL", Number(6.0), speed=Number(3000.0), plunge_feed=Number(100.0)),)
    return Program(Unit.MM, tools=tools, blocks=(new_block(Program(Unit.MM, tools=tools)),))


def wait_for_file(terminal: Terminal, path: Path, holds: Callable[[Program], bool]) -> None:
    """Wait until the file satisfies `holds`, reading the screen output meanwhile."""
    since = time.monotonic()
    while not holds(load(path)):
        assert time.monotonic() - since < PATIENCE, terminal.text
        terminal.read(quiet=0.05, longest=0.2)


def key_in(path: Path, environment: dict[str, str], drawing: Drawing) -> None:
    """Key in the drawing, save it, type one more number, and kill the program before that is saved."""
    with running(cutcomp(str(path)), environment=environment) as terminal:
        terminal.until("MILL CONTOUR", longest=PATIENCE)
        terminal.read(quiet=0.3)
        terminal.send(sent((*drawing.keys, "tab")) + SAVE)
        wait_for_file(terminal, path, lambda program: len(program.blocks[0].segments) >= drawing.segments)
        # FEED and TANGENT are the last fields
        back = sent(("pageup",) * (drawing.segments - 1)) + BACK_TAB * 2
        terminal.send(back + sent((f"'{FEED:g}", "tab")))
        terminal.until("444.0", longest=PATIENCE)
        terminal.until("not saved", longest=PATIENCE)
        os.kill(terminal.pid, signal.SIGKILL)


def restore(path: Path, environment: dict[str, str]) -> None:
    with running(cutcomp(str(path)), environment=environment) as terminal:
        terminal.until("RESTORE", longest=PATIENCE)
        terminal.send(b"r")
        terminal.until("Your work is back", longest=PATIENCE)
        terminal.send(SAVE)
        wait_for_file(terminal, path, lambda program: program.blocks[0].segments[0].feed == Number(FEED))


def milled(ran: Ran) -> list[Point | tuple[Point, Point]]:
    """The feed moves in the XY plane: the end of a line, or (center, end) of an arc."""
    feeds = [move for move in ran.moves if move[0] != "STRAIGHT_TRAVERSE"]
    return [(x, y) if not turns else ((cx, cy), (x, y)) for _, x, y, _, cx, cy, turns in feeds]


def nearest(expected: Point | tuple[Point, Point], moves: Sequence[Point | tuple[Point, Point]]) -> float:
    """The distance to the nearest move of the same kind."""
    return min(
        (apart(expected, move) for move in moves if isinstance(move[0], tuple) is isinstance(expected[0], tuple)),
        default=float("inf"),
    )


def apart(first: Point | tuple[Point, Point], second: Point | tuple[Point, Point]) -> float:
    return max(abs(a - b) for a, b in zip(flat(first), flat(second), strict=True))


def flat(move: Point | tuple[Point, Point]) -> list[float]:
    return [number for part in move for number in (part if isinstance(part, tuple) else (part,))]


def runs_as_drawn(program: Program, drawing: Drawing, folder: Path) -> None:
    """The posted program makes the moves of the drawing on LinuxCNC."""
    derived = derive(program)
    assert [finding.code for finding in derived.block(1).errors] == []
    ran = run(post_center_path(derived, name="PART").text, {1: 6.0 / 25.4}, folder)
    assert ran.accepted, ran.said
    moves = milled(ran)
    for expected in drawing.moves():
        assert nearest(expected, moves) < 2e-3, (expected, moves)


@pytest.mark.asyncio(loop_scope="module")
@pytest.mark.parametrize("name", DRAWINGS)
async def test_a_drawing_keyed_in_from_its_dimensions_is_milled_correctly(
    user: Operator, name: str, tmp_path: Path
) -> None:
    await user.begin(new_program())
    await user.press(*DRAWINGS[name].keys, "tab")
    save(user.session.program, tmp_path / "part.toml")
    runs_as_drawn(load(tmp_path / "part.toml"), DRAWINGS[name], tmp_path)


def test_a_calculated_run_comes_back_after_a_kill(tmp_path: Path) -> None:
    drawing, environment = (
        DRAWINGS["rounded corner"],
        {"XDG_STATE_HOME": str(tmp_path), "XDG_CONFIG_HOME": str(tmp_path)},
    )
    path = tmp_path / "part.toml"
    save(new_program(), path)
    key_in(path, environment, drawing)
    restore(path, environment)
    runs_as_drawn(load(path), drawing, tmp_path)


def test_the_expected_points_agree_with_hand_calculations() -> None:
    """By hand, the corner of the lines at 30 and 300 degrees is (75, 43.301270)."""
    touch, (center, leave), _ = rounded_corner()
    assert touch == pytest.approx((70.669873, 40.801270), abs=1e-6)
    assert center == pytest.approx((73.169873, 36.471143), abs=1e-6)
    assert leave == pytest.approx((77.5, 38.971143), abs=1e-6)
    assert three_arcs()[0][1] == pytest.approx((18.413365, 12.193081), abs=1e-6)
    assert all(isclose(hypot(*flat(move)[-2:]), 23.0) for move in (cam()[0], cam()[3]))
