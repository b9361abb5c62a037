from __future__ import annotations

import re
from math import cos, hypot, pi, sin, tau
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.draw.scene import Circle, Layer, Mark, Scene, Style, Symbol, contour_scene
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Turn
from core.output.svg import outline, svg
from core.units import Unit

SPACE = "{http://www.w3.org/2000/svg}"
CORNER = Path.from_pieces([Line((0, 0), (4, 0)), Arc((4, 0), (5, 1), (4, 1), Turn.CCW), Line((5, 1), (5, 3))])


def drawing(scene: Scene, title: str = "PART") -> ElementTree.Element:
    return ElementTree.fromstring(svg(scene, title=title))


def paths(scene: Scene, style: str) -> list[str]:
    return [element.attrib["d"] for element in drawing(scene).iter(f"{SPACE}path") if element.attrib["class"] == style]


def test_y_is_up_and_arcs_are_arcs():
    scene = Scene((Layer(CORNER, Style.SURFACE),), axes=False)
    assert paths(scene, "surface")[0] == "M0 0 L4 0 A1 1 0 0 0 5 -1 L5 -3"


@pytest.mark.parametrize(("turn", "flag"), [(Turn.CCW, 0), (Turn.CW, 1)])
def test_the_sweep_flag_is_that_of_a_flipped_drawing(turn, flag):
    quarter = Arc((1, 0), (0, 1) if turn is Turn.CCW else (0, -1), (0, 0), turn)
    assert outline(quarter).startswith(f"A1 1 0 0 {flag} 0 ")


def test_a_full_circle_is_two_halves():
    assert outline(Arc((1, 0), (1, 0), (0, 0), Turn.CCW)) == "A1 1 0 0 0 -1 0 A1 1 0 0 0 1 0"


def test_dashed_layers_have_the_dashed_class():
    assert "\n.dashed { stroke-dasharray: 6 4 }\n" in svg(Scene(), title="A")
    assert "\n.rapid { stroke: #7a8894; stroke-width: 0.8px; stroke-dasharray: 2 3 }\n" in svg(Scene(), title="A")
    scene = Scene((Layer(CORNER, Style.DELETED, dashed=True),))
    assert len(paths(scene, "deleted dashed")) == 1


def test_the_legend_names_only_drawn_items():
    scene = contour_scene(CORNER, path=CORNER, cutter=((1, 1), 0.5), unit=Unit.MM)
    words = [element.text for element in drawing(scene).iter(f"{SPACE}text")]
    assert words == ["PART", "part surface", "center path", "blend moves", "cutter", "start, direction", "1 MM"]


def test_the_cutter_is_a_circle():
    (circle,) = drawing(Scene(circles=(Circle((3, 4), 0.5),))).iter(f"{SPACE}circle")
    assert [circle.attrib[name] for name in ("cx", "cy", "r", "class")] == ["3", "-4", "0.5", "cutter"]


@pytest.mark.parametrize("title", ["<script>alert(1)</script>", 'a & b "c"', "]]>", "line\nbreak\x00\x1b", "Ø 12"])
def test_no_text_becomes_markup(title):
    root = drawing(Scene((Layer(CORNER, Style.SURFACE),)), title)
    assert {element.tag for element in root.iter()} <= {
        f"{SPACE}{name}" for name in ("svg", "title", "style", "rect", "path", "circle", "text")
    }
    shown = root.find(f"{SPACE}title")
    assert shown is not None
    assert shown.text == "".join(character if character.isprintable() else " " for character in title)


def test_the_view_box_contains_everything():
    scene = contour_scene(CORNER, cutter=((5, 3), 2.0), unit=Unit.IN)
    x, y, wide, high = map(float, drawing(scene).attrib["viewBox"].split())
    assert x < 0
    assert x + wide > 7
    assert y < -5
    assert y + high > 0


def test_empty_scenes_and_scenes_with_invalid_numbers_are_drawn():
    nan = Path.from_pieces([Line((0, 0), (1, 0)), Line((1, 0), (float("nan"), 0)), Line((0, 0), (2, 2))])
    broken = Scene(
        (Layer(nan, Style.SURFACE),),
        (Circle((0, 0), float("nan")),),
        (Mark((float("inf"), 0), Style.START, Symbol.START), Mark((0, 0), Style.START, Symbol.ARROW, (0.0, 0.0))),
    )
    for scene in (Scene(), Scene(unit=Unit.IN), broken):
        markup = svg(scene, title="")
        ElementTree.fromstring(markup)
        assert "nan" not in markup
        assert "inf" not in markup
    assert paths(broken, "surface")[0] == "M0 0 L1 0"


TALL = Path.from_pieces([Line((-20, -10), (80, -10)), Line((80, -10), (80, 90))])


def drawn(scene: Scene) -> list[str]:
    """The lines of a drawing, without the style sheet."""
    return [
        line for line in svg(scene, title="A").splitlines() if line.startswith(("<svg", "<rect", "<path", "<c", "<te"))
    ]


def test_a_whole_drawing_is_written():
    """For 100 mm the margin is 6, letters 2.4, a line of the legend 3.84; axes extend 3 beyond the drawing."""
    arrow = Mark((0, 0), Style.START, Symbol.ARROW, (0.0, 2.0))
    marks = (arrow, Mark((10, 20), Style.GOUGE, Symbol.GOUGE), Mark((50, 60), Style.LEAD, Symbol.PLUNGE))
    layers = (Layer(TALL, Style.SURFACE), Layer(TALL, Style.DELETED, dashed=True))
    assert drawn(Scene(layers, (Circle((30, 40), 5.0),), marks, Unit.MM)) == [
        '<svg xmlns="http://www.w3.org/2000/svg" width="960" height="1223.314286" viewBox="-26 -99.84 112 142.72">',
        '<rect x="-26" y="-99.84" width="100%" height="100%" fill="#ffffff"/>',
        '<path class="axis" d="M-23 0 L83 0"/>',
        '<path class="axis" d="M0 13 L0 -93"/>',
        '<path class="surface" d="M-20 10 L80 10 L80 -90"/>',
        '<path class="deleted dashed" d="M-20 10 L80 10 L80 -90"/>',
        '<circle class="cutter" cx="30" cy="-40" r="5"/>',
        '<path class="start" d="M-0.864 0.576 L0 -0.96 L0.864 0.576"/>',
        '<path class="gouge" d="M9.16 -19.16 L10.84 -20.84 M9.16 -20.84 L10.84 -19.16"/>',
        '<circle class="lead" cx="50" cy="-60" r="0.84"/>',
        '<text x="-20" y="-96" font-size="2.88">A</text>',
        '<path class="surface" d="M-20 19.04 L-10.4 19.04"/>',
        '<text x="-8" y="19.84" font-size="2.4">part surface</text>',
        '<path class="lead" d="M-20 22.88 L-10.4 22.88"/>',
        '<text x="-8" y="23.68" font-size="2.4">blend moves</text>',
        '<path class="deleted" d="M-20 26.72 L-10.4 26.72"/>',
        '<text x="-8" y="27.52" font-size="2.4">deleted segments</text>',
        '<path class="gouge" d="M-20 30.56 L-10.4 30.56"/>',
        '<text x="-8" y="31.36" font-size="2.4">gouge</text>',
        '<path class="cutter" d="M-20 34.4 L-10.4 34.4"/>',
        '<text x="-8" y="35.2" font-size="2.4">cutter</text>',
        '<path class="start" d="M-20 38.24 L-10.4 38.24"/>',
        '<text x="-8" y="39.04" font-size="2.4">start, direction</text>',
        '<path class="scale" d="M60 19.84 L60 17.44 M80 19.84 L80 17.44 M60 18.64 L80 18.64"/>',
        '<text x="60" y="22.72" font-size="2.4">20 MM</text>',
    ]


def test_the_scale_bar_of_an_inch_drawing_is_half_an_inch():
    """A quarter of 100 mm is 0.98 in: the bar is half an inch, 12.7 mm."""
    assert drawn(Scene((Layer(TALL, Style.SURFACE),), unit=Unit.IN))[-2:] == [
        '<path class="scale" d="M67.3 19.84 L67.3 17.44 M80 19.84 L80 17.44 M67.3 18.64 L80 18.64"/>',
        '<text x="67.3" y="22.72" font-size="2.4">0.5 IN</text>',
    ]


def test_axes_outside_the_drawing_are_left_out():
    away = Path.from_pieces([Line((10, 10), (20, 30))])
    assert paths(Scene((Layer(away, Style.SURFACE),)), "axis") == []
    over_x = Path.from_pieces([Line((10, -10), (20, 30))])
    assert paths(Scene((Layer(over_x, Style.SURFACE),)), "axis") == ["M8.8 0 L21.2 0"]
    over_y = Path.from_pieces([Line((-10, 10), (30, 20))])
    assert paths(Scene((Layer(over_y, Style.SURFACE),)), "axis") == ["M0 -8.8 L0 -21.2"]
    touching = Path.from_pieces([Line((0, 0), (100, 50))])
    assert paths(Scene((Layer(touching, Style.SURFACE),)), "axis") == ["M-3 0 L103 0", "M0 3 L0 -53"]
    assert paths(Scene((Layer(touching, Style.SURFACE),), axes=False), "axis") == []


def test_each_part_of_a_layer_is_drawn_separately():
    scene = Scene((Layer(CORNER, Style.UNCUT, drawn=np.array([True, False, True])),), axes=False)
    assert paths(scene, "uncut")[:-1] == ["M0 0 L4 0", "M5 -1 L5 -3"]


@given(
    radius=st.floats(0.01, 1e4),
    begin=st.floats(0, tau),
    sweep=st.floats(0.01, tau - 1e-6),
    turn=st.sampled_from([Turn.CW, Turn.CCW]),
)
@settings(derandomize=True, max_examples=150)
def test_halves_of_arcs_join_on_the_circle(radius, begin, sweep, turn):
    """No arc exceeds half a turn, so its radius, flags and end define it; each end is on the circle."""
    end = begin + turn * sweep
    arc = Arc((radius * cos(begin), radius * sin(begin)), (radius * cos(end), radius * sin(end)), (0.0, 0.0), turn)
    parts = re.findall(r"A\S+ \S+ 0 0 (\d) (\S+) (\S+)", outline(arc))
    assert len(parts) == (2 if sweep > pi + 1e-9 else 1) or abs(sweep - pi) < 1e-6
    for flag, x, y in parts:
        assert flag == ("0" if turn is Turn.CCW else "1")
        assert abs(hypot(float(x), float(y)) - radius) < 2e-6
    assert hypot(float(parts[-1][1]) - arc.end[0], -float(parts[-1][2]) - arc.end[1]) < 2e-6
