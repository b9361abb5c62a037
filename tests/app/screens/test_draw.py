"""DRAW enlarged: the cutter, or what else is marked, stays in the window."""

from __future__ import annotations

from dataclasses import replace

import pytest

from app.documents.files import load
from app.documents.programs import example
from app.painted.screens.page import Sketch
from app.painted.session import Session
from app.painted.widgets.drawing import view_of
from core.draw.scene import Scene, Style
from core.geometry.piece import Point
from core.pipeline.derive import derive
from core.pipeline.plot import block_scene
from tests.app.operator import Operator

SIZE = (59, 18)


def drawing(name: str = "pocket") -> Operator:
    operator = Operator.at(load(example(name)))
    operator.desk = operator.desk.knowing(derive(operator.session.program))
    return operator.press("f7")


def scene_of(operator: Operator) -> Scene:
    session: Session = operator.session
    return block_scene(session.found, session.where.segment, session.program.unit)


def cell(scene: Scene, sketch: Sketch, at: Point) -> tuple[float, float]:
    """Where a point stands, in parts of the window."""
    view = view_of(scene, sketch, *SIZE)
    assert view is not None
    column, row = view.cell(at, *SIZE)
    return column / SIZE[0], row / SIZE[1]


def cutter(operator: Operator) -> tuple[float, float]:
    scene = scene_of(operator)
    (circle,) = scene.circles
    return cell(scene, operator.sketch, circle.center)


def seen(place: tuple[float, float]) -> bool:
    return all(0.0 <= part <= 1.0 for part in place)


@pytest.mark.parametrize("name", ["pocket", "flange", "notch", "overrun-square"])
def test_enlarging_and_walking_keep_the_cutter_in_the_window(name: str) -> None:
    operator = drawing(name)
    for _ in operator.segments:
        before = cutter(operator)
        assert seen(before)
        operator.press("+", "+", "+")
        assert cutter(operator) == pytest.approx(before)
        operator.press("n")
    while operator.session.where.segment:
        assert seen(cutter(operator.press("p")))


def test_walking_brings_the_cutter_back_where_the_arrows_have_lost_it() -> None:
    operator = drawing().press(*["+"] * 6, *["right"] * 12)
    assert not seen(cutter(operator))
    assert seen(cutter(operator.press("n")))
    assert operator.sketch.zoom == pytest.approx(1.25**6)
    operator.press(*["left"] * 12, "f2")
    assert seen(cutter(operator))


def test_behind_an_arrow_the_middle_of_the_window_stays() -> None:
    operator = drawing().press("+", "+", "+", "up", "left")
    scene = scene_of(operator)
    view = view_of(scene, operator.sketch, *SIZE)
    assert view is not None
    operator.press("+", "+", "-", "+", "+")
    assert cell(scene, operator.sketch, view.center) == pytest.approx((0.5, 0.5))
    assert operator.said.startswith("+ - zoom on the middle")
    assert operator.press("0").said.startswith("+ - zoom on the cutter")


def test_the_whole_drawing_is_as_it_was() -> None:
    operator = drawing()
    whole = view_of(scene_of(operator), Sketch(), *SIZE)
    operator.press("+", "+", "left", "+", "home")
    assert view_of(scene_of(operator), operator.sketch, *SIZE) == whole


def test_without_a_cutter_it_is_the_segment_then_start_then_the_middle_that_stays() -> None:
    operator = drawing().press("n", "n")
    near, scene = Sketch(zoom=40.0), replace(scene_of(operator), circles=())
    (current,) = (layer for layer in scene.layers if layer.style is Style.CURRENT)
    (x0, y0), (x1, y1) = current.path.points.tolist()
    assert seen(cell(scene, near, ((x0 + x1) / 2, (y0 + y1) / 2)))
    scene = replace(scene, layers=tuple(layer for layer in scene.layers if layer.style is not Style.CURRENT))
    (start,) = (mark.at for mark in scene.marks if mark.style is Style.START and mark.symbol.name == "START")
    assert seen(cell(scene, near, start))
    bare = replace(scene, marks=())
    view, whole = view_of(bare, near, *SIZE), view_of(bare, Sketch(), *SIZE)
    assert view is not None
    assert whole is not None
    assert view.center == whole.center
