"""A program under proof: where the cutter is, and what is drawn."""

from __future__ import annotations

from dataclasses import replace

import pytest

from core.controls.control_tools import ToolTable
from core.controls.judging.judged_runs import judge_run
from core.controls.moves import Plane
from core.controls.registry import NO_TOOLS, UnknownControl, resolve, run
from core.draw.scene import Scene, Style
from core.pipeline.nc_proof import (
    Proof,
    cutter_at_line,
    dotted_path,
    fixed_scene,
    scene_at_line,
)
from core.units import Unit
from tests.tool_tables import end_mills

SQUARE = b"""G20 G17 G40 G90 F10
T1 M6
G0 X-1 Y-1
(nothing moves here)
G41 D1 G1 X0 Y-0.5
G1 X0 Y2
G1 X2 Y2
G40 G1 X3 Y3
G0 X-1
M30
"""
TOOLS = end_mills({1: 0.5})


def proof(text: bytes = SQUARE, control: str = "nine-series:a", tools: ToolTable = TOOLS) -> Proof:
    done = run(text, control, tools)
    return Proof(done, judge_run(done))


def styles(scene: Scene) -> set[Style]:
    return {layer.style for layer in scene.layers}


def test_the_cutter_stands_where_the_line_leaves_it() -> None:
    found = proof()
    (x, y), _ = cutter_at_line(found, 6)
    assert (x / 25.4, y / 25.4) == pytest.approx((-0.25, 2.25))
    assert cutter_at_line(found, 9)[0] == pytest.approx((-25.4, 76.2))


def test_a_line_without_moves_leaves_the_cutter_where_it_was() -> None:
    found = proof()
    assert cutter_at_line(found, 4)[0] == cutter_at_line(found, 3)[0] == pytest.approx((-25.4, -25.4))
    assert cutter_at_line(found, 1)[0] == (0.0, 0.0)
    assert cutter_at_line(found, 10)[0] == cutter_at_line(found, 9)[0]


def test_the_cutter_has_the_radius_of_its_stretch() -> None:
    found = proof()
    scene = scene_at_line(fixed_scene(found), found, 6)
    assert [circle.radius for circle in scene.circles] == pytest.approx([6.35])
    assert scene.unit is Unit.IN


def test_surface_center_path_rapids_and_the_cursors_moves_are_drawn() -> None:
    found = proof()
    ground = fixed_scene(found)
    assert {Style.SURFACE, Style.PATH, Style.RAPID} <= styles(ground)
    assert Style.LEAD not in styles(ground)
    assert Style.LEAD in styles(fixed_scene(proof(b"G20 G90 G1 X1 F5\nM30\n")))
    assert Style.LEAD in styles(fixed_scene(replace(found, results=())))
    assert Style.CURRENT not in styles(ground)
    assert Style.CURRENT in styles(scene_at_line(ground, found, 6))
    assert Style.CURRENT not in styles(scene_at_line(ground, found, 4))


def test_feed_moves_next_to_a_stretch_are_drawn_whole() -> None:
    """The moves of the stretch itself, entry and exit among them, are drawn as its center path."""
    text = SQUARE.replace(b"G41 D1", b"G1 X-2 Y-1\nX-1.5 Y-1\nG41 D1").replace(b"G0 X-1\n", b"G1 X4 Y3\n")
    before, after = (layer.path for layer in fixed_scene(proof(text)).layers if layer.style is Style.LEAD)
    assert (before.points / 25.4).round(9).tolist() == [[-1.0, -1.0], [-2.0, -1.0], [-1.5, -1.0]]
    assert (after.points / 25.4).round(9).tolist() == [[3.0, 3.0], [4.0, 3.0]]


def test_the_feed_moves_of_a_run_are_dotted_on_the_plane_of_another() -> None:
    other = proof(control="linuxcnc")
    dotted = dotted_path(other, Plane.XY)
    assert all(layer.dashed and layer.style is Style.UNTAKEN for layer in dotted)
    assert sum(len(layer.path) for layer in dotted) == (~other.run.moves.rapid[1:]).sum() > 0


def test_without_compensation_there_is_a_place_and_no_cutter() -> None:
    found = proof(b"G20 G90 G0 X1 Y1\nG1 X2 F5\nM30\n")
    scene = scene_at_line(fixed_scene(found), found, 2)
    assert not scene.circles
    assert [mark.at for mark in scene.marks][-1] == pytest.approx((50.8, 25.4))


def test_the_plane_of_the_first_stretch_is_drawn() -> None:
    text = b"G20 G90 G18 F10\nT1 M6\nG0 X0 Z-1\nG41 D1 G1 X0 Z0\nG1 Z2\nG1 X3\nG40 G1 X4 Z4\nM30\n"
    found = proof(text)
    assert found.plane is Plane.ZX
    assert cutter_at_line(found, 3)[0] == pytest.approx((-25.4, 0.0))


@pytest.mark.parametrize("text", [b"", b"\x00\xff\xfe", b"G1 X", b"G41\n" * 5, bytes(range(256))])
def test_any_text_can_be_drawn(text: bytes) -> None:
    for control in ("threeblock", "rosettacnc:nist", "nine-series:b", "klartext", "linuxcnc"):
        found = proof(text, control, NO_TOOLS)
        assert scene_at_line(fixed_scene(found), found, 1).marks


def test_an_unknown_control_is_reported() -> None:
    assert isinstance(resolve("siemens"), UnknownControl)
