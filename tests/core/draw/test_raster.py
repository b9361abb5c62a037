from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import cos, hypot, sin, tau

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely.geometry import box

from core.draw.characters import Mode
from core.draw.raster import chords, draw
from core.draw.scene import Area, Circle, Label, Layer, Mark, Scene, Style, Symbol
from core.draw.view import View
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Point, Turn
from core.units import Unit


def lines(*points: Point) -> Path:
    return Path.from_pieces([Line(a, b) for a, b in pairwise(points)])


def only(path: Path, style: Style = Style.SURFACE, *, dashed: bool = False) -> Scene:
    return Scene((Layer(path, style, dashed),), axes=False)


def rows(scene: Scene, view: View, columns: int, height: int, mode: Mode) -> list[str]:
    return list(draw(scene, view, columns, height, mode).rows)


VIEW = View((0.0, 0.0), 1.0)
SQUARE = only(lines((-2, -2), (2, -2), (2, 2), (-2, 2), (-2, -2)))
DIAMOND = only(lines((0, -3), (3, 0), (0, 3), (-3, 0), (0, -3)))
ROUND = Scene(circles=(Circle((0.0, 0.0), 3.2),), axes=False)
SLOT = Scene(
    (Layer(lines((1, 1), (8, 1)), Style.PATH), Layer(lines((3, -1), (3, 3)), Style.LEAD)),
    (),
    (
        Mark((8, 1), Style.START, Symbol.ARROW, (1, 0)),
        Mark((1, 1), Style.START, Symbol.START),
        Mark((3, 3), Style.GOUGE, Symbol.GOUGE),
        Mark((5, 3), Style.START, Symbol.ARROW, (1, 1)),
    ),
    Unit.MM,
)
SLOT_VIEW = View((4.0, 1.0), 0.5)


@pytest.mark.parametrize(
    ("scene", "mode", "expected"),
    [
        (SQUARE, Mode.BRAILLE, ["        ", "  ⡏⠉⠉⠉⡇ ", "  ⡇   ⡇ ", "  ⠉⠉⠉⠉⠁ "]),
        (SQUARE, Mode.BLOCK, ["        ", "  █▀▀▀█ ", "  █   █ ", "  ▀▀▀▀▀ "]),
        (SQUARE, Mode.ASCII, ["        ", "  +---+ ", "  |   | ", "  +---+ "]),
        (DIAMOND, Mode.BRAILLE, ["   ⢀⢄   ", " ⢀⠔⠁ ⠑⢄ ", " ⠑⢄  ⢀⠔⠁", "   ⠑⠔⠁  "]),
        (DIAMOND, Mode.BLOCK, ["    ▄   ", "  ▄▀ ▀▄ ", " ▀▄   ▄▀", "   ▀▄▀  "]),
        (DIAMOND, Mode.ASCII, ["    +   ", "  // \\\\ ", " +\\   /+", "   \\+/  "]),
        (ROUND, Mode.BRAILLE, [" ⢀⡤⠒⠢⠤⡀ ", "⢠⠃    ⠱⡀", "⠘⡄    ⡰⠁", " ⠈⠓⠤⠔⠒⠁ "]),
        (ROUND, Mode.BLOCK, [" ▄▄▀▀▄▄ ", "▄▀    ▀▄", "▀▄    ▄▀", " ▀▀▄▄▀▀ "]),
    ],
)
def test_small_scenes_are_drawn_exactly(scene, mode, expected):
    assert rows(scene, VIEW, 8, 4, mode) == expected


@pytest.mark.parametrize(
    ("mode", "expected"),
    [
        (
            Mode.BRAILLE,
            [
                "  Y     !   ↗       ",
                "        ⡇           ",
                "  ⠃ S⠤⠤⠤⡧⠤⠤⠤⠤⠤⠤⠤⠤⠤→ ",
                "⠤   ⠤   ⡧   ⠤   ⠤  X",
                "  ⠃     ⠇           ",
            ],
        ),
        (
            Mode.BLOCK,
            [
                "  Y     !   >       ",
                "        :           ",
                "  ▀ S...:.........> ",
                "▄   ▄   :   ▄   ▄  X",
                "  ▀     :           ",
            ],
        ),
        (
            Mode.ASCII,
            [
                "  Y     !   >       ",
                "        .           ",
                "  | S.............> ",
                "-   -   .   -   -  X",
                "  |     .           ",
            ],
        ),
    ],
)
def test_marks_and_axes_are_drawn(mode, expected):
    assert rows(SLOT, SLOT_VIEW, 20, 5, mode) == expected


def test_every_cell_has_the_style_of_the_last_item_in_it():
    styles = draw(SLOT, SLOT_VIEW, 20, 5, Mode.BRAILLE).styles
    assert styles.dtype == np.uint8
    assert styles.shape == (5, 20)
    assert styles[2].tolist() == [0, 0, 1, 0, 10, 3, 3, 3, 4, 3, 3, 3, 3, 3, 3, 3, 3, 3, 10, 0]
    assert styles[0, 8] == Style.GOUGE
    assert styles[3, 19] == Style.AXIS


def test_the_dots_of_a_layer_stay_lit_under_a_later_layer():
    lower, upper = Layer(lines((-4, 0.3), (4, 0.3)), Style.SURFACE), Layer(lines((-4, -0.8), (4, -0.8)), Style.PATH)
    both = draw(Scene((lower, upper), axes=False), View((0.0, -1.0), 1.0), 8, 2, Mode.BRAILLE)
    assert both.rows[0] == "⣒" * 8
    assert set(both.styles[0].tolist()) == {Style.PATH}


@pytest.mark.parametrize(("degrees", "character"), [(22, "-"), (23, "/"), (67, "/"), (68, "|")])
def test_a_line_has_the_character_nearest_to_its_direction_in_cells(degrees, character):
    angle = degrees * tau / 360
    across, up = 3 * cos(angle), 6 * sin(angle)
    picture = rows(only(lines((-across, -up), (across, up))), VIEW, 8, 8, Mode.ASCII)
    assert set("".join(picture)) == {" ", character}


@pytest.mark.parametrize(
    ("mode", "expected"),
    [
        (Mode.ASCII, ["........", "--------"]),
        (Mode.BLOCK, ["........", "▀▀▀▀▀▀▀▀"]),
    ],
)
def test_a_center_path_differs_from_the_surface_without_colors(mode, expected):
    surface, path = Layer(lines((-4, -0.5), (4, -0.5)), Style.SURFACE), Layer(lines((-4, 0.5), (4, 0.5)), Style.PATH)
    assert rows(Scene((surface, path), axes=False), VIEW, 8, 2, mode) == expected


@pytest.mark.parametrize(("mode", "surface"), [(Mode.ASCII, "-"), (Mode.BLOCK, "▀")])
def test_the_surface_character_stays_under_a_center_path(mode, surface):
    along = lines((-4, 1.5), (4, 1.5))
    both = draw(Scene((Layer(along, Style.SURFACE), Layer(along, Style.PATH)), axes=False), VIEW, 8, 2, mode)
    assert both.rows[0] == surface * 8
    assert set(both.styles[0].tolist()) == {Style.PATH}


def test_deleted_surface_is_a_dotted_line_in_braille():
    deleted = Layer(lines((-4, 1.5), (4, 1.5)), Style.DELETED, dashed=True)
    surface = Layer(deleted.path, Style.SURFACE)
    dotted, line = (draw(Scene((layer,), axes=False), VIEW, 8, 2, Mode.BRAILLE).rows[0] for layer in (deleted, surface))
    lit = [sum((ord(cell) - 0x2800).bit_count() for cell in row if cell != " ") for row in (dotted, line)]
    assert 0 < lit[0] <= 0.6 * lit[1]
    assert " " not in dotted


@pytest.mark.parametrize("mode", [Mode.BLOCK, Mode.ASCII])
def test_deleted_surface_keeps_its_own_character_under_other_layers(mode):
    along = lines((-4, 1.5), (4, 1.5))
    deleted = Layer(lines((-2, 1.5), (2, 1.5)), Style.DELETED, dashed=True)
    surface, uncut, current = (Layer(along, style) for style in (Style.SURFACE, Style.UNCUT, Style.CURRENT))
    picture = draw(Scene((surface, uncut, deleted), axes=False), VIEW, 8, 2, mode)
    assert picture.rows[0].count("#") in (4, 5)
    assert {Style(style) for style in picture.styles[0].tolist()} == {Style.UNCUT, Style.DELETED}
    assert "#" not in "".join(draw(Scene((surface, uncut), axes=False), VIEW, 8, 2, mode).rows)
    over = draw(Scene((surface, deleted, current), axes=False), VIEW, 8, 2, mode)
    assert over.rows[0].count("#") == picture.rows[0].count("#")
    assert set(over.styles[0].tolist()) == {Style.CURRENT}


@pytest.mark.parametrize("mode", list(Mode))
@pytest.mark.parametrize(("style", "part"), [(Style.GOUGE_AREA, 1 / 2), (Style.UNCUT_AREA, 1 / 4)])
def test_an_area_is_shaded_within_its_region_and_below_lines(mode, style, part):
    region = box(-2.0, -2.0, 2.0, 2.0)
    picture = draw(Scene(areas=(Area(region, style),), axes=False), VIEW, 8, 4, mode)
    shaded = [[cell != " " for cell in row] for row in picture.rows]
    assert shaded == [[2 <= column < 6 and 1 <= row < 3 for column in range(8)] for row in range(4)]
    assert set(picture.styles[1:3, 2:6].ravel().tolist()) == {style}
    if mode is Mode.BRAILLE:
        dots = sum((ord(cell) - 0x2800).bit_count() for row in picture.rows for cell in row if cell != " ")
        assert dots == 8 * 8 * part
    wall = Layer(lines((-4, 0.5), (4, 0.5)), Style.SURFACE)
    assert set(draw(Scene((wall,), areas=(Area(region, style),), axes=False), VIEW, 8, 4, mode).styles[1].tolist()) == {
        Style.SURFACE
    }


@pytest.mark.parametrize("center", [(0.0, 0.0), (10.0, -7.0)])
@pytest.mark.parametrize(("style", "row"), [(Style.GOUGE_AREA, "  ⢕⢕⢕⢕  "), (Style.UNCUT_AREA, "  ⠅⡂⠅⡂  ")])
def test_the_dots_of_an_area_are_a_chessboard_or_every_fourth_wherever_it_lies(center, style, row):
    x, y = center
    scene = Scene(areas=(Area(box(x - 2.0, y - 2.0, x + 2.0, y + 2.0), style),), axes=False)
    assert rows(scene, View(center, 1.0), 8, 4, Mode.BRAILLE) == [" " * 8, row, row, " " * 8]


def test_an_uncut_wall_is_two_dots_thick():
    lit = []
    for style in (Style.SURFACE, Style.UNCUT):
        text = "".join(rows(only(lines((-4, 0.1), (4, 0.1)), style), VIEW, 10, 2, Mode.BRAILLE)).replace(" ", "")
        lit.append(sum((ord(cell) - 0x2800).bit_count() for cell in text))
    assert lit[1] >= 1.8 * lit[0]


def test_a_label_is_beside_its_point_and_never_on_a_line():
    label = Label((0.0, 0.0), "12", (0.0, 1.0))
    assert rows(Scene(labels=(label,), axes=False), VIEW, 8, 6, Mode.ASCII)[1] == "   12   "
    wall = Layer(lines((-4, 2.5), (4, 2.5)), Style.SURFACE)
    assert "12" not in "".join(rows(Scene((wall,), labels=(label,), axes=False), VIEW, 8, 6, Mode.ASCII))


@pytest.mark.parametrize(
    ("x", "expected"),
    [(-3.5, "12      "), (-4.5, "        "), (2.5, "      12"), (3.5, "        ")],
)
def test_a_label_that_does_not_fit_is_left_out(x, expected):
    label = Label((x, 0.0), "12", (0.0, 1.0))
    assert rows(Scene(labels=(label,), axes=False), VIEW, 8, 6, Mode.ASCII)[1] == expected


def test_a_dashed_line_has_gaps():
    assert rows(only(lines((-8, 0.5), (8, 0.5)), dashed=True), VIEW, 16, 2, Mode.ASCII)[0] == "-- -- -- -- -- -"


def test_dashes_continue_across_the_pieces_of_a_path():
    whole = rows(only(lines((-8, 0.5), (8, 0.5)), dashed=True), VIEW, 16, 2, Mode.BRAILLE)
    steps = lines(*((number / 4, 0.5) for number in range(-32, 33)))
    assert rows(only(steps, dashed=True), VIEW, 16, 2, Mode.BRAILLE) == whole


@pytest.mark.parametrize("mode", list(Mode))
@pytest.mark.parametrize("columns", range(4))
@pytest.mark.parametrize("height", range(4))
def test_tiny_windows_have_pictures_of_their_size(mode, columns, height):
    for scene in (SLOT, Scene(), ROUND):
        picture = draw(scene, View.fit(scene.bounds, columns, height), columns, height, mode)
        assert [len(row) for row in picture.rows] == [columns] * height
        assert picture.styles.shape == (height, columns)


def test_an_empty_scene_is_blank_except_for_its_axes():
    assert rows(Scene(axes=False), VIEW, 3, 2, Mode.BRAILLE) == ["   ", "   "]
    assert rows(Scene(), View((0.0, 0.5), 1.0), 9, 2, Mode.ASCII) == ["    |    ", "-   +   -"]


@pytest.mark.parametrize("mode", list(Mode))
@settings(max_examples=100)
@given(st.floats(-9, 9), st.floats(-9, 9), st.floats(0.1, 3.0))
def test_axes_lie_on_lines_from_edge_to_edge(mode, x, y, scale):
    view = View((x, y), scale)
    axes = draw(Scene(), view, 15, 7, mode)
    across, up = lines((x - 99, 0), (x + 99, 0)), lines((0, y + 99), (0, y - 99))
    whole = draw(Scene((Layer(across, Style.PATH), Layer(up, Style.PATH)), axes=False), view, 15, 7, mode)
    assert not (whole.styles[axes.styles == Style.AXIS] == Style.BACKGROUND).any()
    # dashes light no dot beside the line
    under = Scene((Layer(across, Style.PATH), Layer(up, Style.PATH)))
    assert draw(under, view, 15, 7, mode).rows == whole.rows


@pytest.mark.parametrize("mode", list(Mode))
@pytest.mark.parametrize("zoom", [1e-12, 1e-6, 1e-3, 1e3, 1e6, 1e9, 1e300])
def test_every_zoom_has_a_picture(mode, zoom):
    view = SLOT_VIEW.zoom(zoom)
    assert [len(row) for row in rows(SLOT, view, 20, 5, mode)] == [20] * 5


@pytest.mark.parametrize("mode", list(Mode))
@pytest.mark.parametrize("zoom", [1.0, 5.0])
def test_parts_of_a_layer_look_like_separate_layers(mode, zoom):
    path, drawn = SLOT.layers[0].path, np.array([True, False, True, True])
    zigzag = lines((1, 1), (3, 2), (5, 0), (7, 2), (8, 0))
    layer = Layer(zigzag, Style.DELETED, dashed=True, drawn=drawn)
    joined = replace(SLOT, layers=(Layer(path, Style.PATH), layer))
    layers = (Layer(part, Style.DELETED, dashed=True) for part in layer.parts)
    separate = replace(SLOT, layers=(Layer(path, Style.PATH), *layers))
    pictures = [draw(scene, SLOT_VIEW.zoom(zoom), 20, 5, mode) for scene in (joined, separate)]
    assert pictures[0].rows == pictures[1].rows
    assert pictures[0].styles.tolist() == pictures[1].styles.tolist()
    assert joined.bounds == separate.bounds


def test_a_huge_arc_near_the_window_is_exact():
    """Within the window an arc with a radius of ten kilometers looks like its tangent."""
    radius = 1e7
    wide = only(Path.from_pieces([Arc((0.0, -0.25), (0.0, -0.25), (0.0, radius - 0.25), Turn.CCW)]))
    straight = only(lines((-100, -0.25), (100, -0.25)))
    assert rows(wide, VIEW, 30, 6, Mode.BRAILLE) == rows(straight, VIEW, 30, 6, Mode.BRAILLE)


def test_points_that_are_not_finite_are_left_out():
    nan = lines((-2, 0.5), (float("nan"), 0.5), (0, float("inf")), (1e300, 0.5), (2, 0.5))
    assert rows(only(nan), VIEW, 8, 2, Mode.BRAILLE) == ["        ", "        "]
    both = Scene((*only(nan).layers, *SQUARE.layers), marks=(Mark((float("nan"), 0.0), Style.START, Symbol.START),))
    assert rows(replace(both, axes=False), VIEW, 8, 4, Mode.BLOCK) == rows(SQUARE, VIEW, 8, 4, Mode.BLOCK)


@pytest.mark.parametrize("mode", list(Mode))
def test_a_line_through_the_window_has_no_gaps(mode):
    for angle in np.linspace(0.0, tau / 2, 97).tolist():
        x, y = 1e6 * cos(angle), 1e6 * sin(angle)
        lit = np.array([list(row) for row in rows(only(lines((-x, -y), (x, y))), VIEW, 31, 15, mode)]) != " "
        steep = abs(y) * 31 > abs(x) * 30
        assert lit.any(axis=1 if steep else 0).all()


def dots(scene: Scene, view: View, columns: int, height: int) -> list[Point]:
    """The centers of all lit braille dots, in millimeters."""
    places = {0: (0, 0), 1: (0, 1), 2: (0, 2), 3: (1, 0), 4: (1, 1), 5: (1, 2), 6: (0, 3), 7: (1, 3)}
    middles = []
    for row, text in enumerate(rows(scene, view, columns, height, Mode.BRAILLE)):
        for column, character in enumerate(text):
            code = 0 if character == " " else ord(character) - 0x2800
            for bit, (across, down) in places.items():
                if code >> bit & 1:
                    middles.append(view.at(column + across / 2 + 0.25, row + down / 4 + 0.125, columns, height))
    return middles


@given(
    radius=st.floats(0.1, 1e6),
    begin=st.floats(0, tau),
    # an arc whose ends are equal but for rounding may be empty or a circle
    sweep=st.floats(0.01, tau - 0.01),
    turn=st.sampled_from([Turn.CW, Turn.CCW]),
    at=st.floats(0, 1),
)
@settings(derandomize=True, max_examples=150, deadline=None)
def test_every_dot_of_an_arc_lies_on_it_and_none_is_missing(radius, begin, sweep, turn, at):
    """Dots are half a millimeter wide here; the window looks at one place of the arc."""

    def place(angle: float) -> Point:
        return radius * cos(angle), radius * sin(angle)

    end = begin + turn * sweep
    path = Path.from_pieces([Arc(place(begin), place(end), (0.0, 0.0), turn)])
    seen = place(begin + turn * at * sweep)
    found = dots(only(path), View(seen, 1.0), 24, 12)
    assert min(hypot(x - seen[0], y - seen[1]) for x, y in found) < 0.75
    for x, y in found:
        assert abs(hypot(x, y) - radius) < 0.75
        turned = (turn * (np.arctan2(y, x) - begin)) % tau
        beyond = min(max(turned - sweep, 0.0), tau - turned)
        assert beyond * radius < 1.5


def test_an_arc_that_misses_the_window_has_no_chords() -> None:
    """The box of the arc contains the window, but the arc itself is not near."""
    around = Path.from_pieces([Arc((50.0, 0.0), (-50.0, 0.0), (0.0, 0.0), Turn.CCW)])
    assert not len(chords([Layer(around, Style.PATH)], View((0.0, 0.0), 1.0), 20, 10).starts)
    assert len(chords([Layer(around, Style.PATH)], View((0.0, 45.0), 1.0), 20, 10).starts)


@pytest.mark.parametrize("turn", [Turn.CW, Turn.CCW])
def test_only_the_part_of_an_arc_near_the_window_is_divided(turn: Turn) -> None:
    """An arc of radius 500 passes the center of a 20 by 20 window and continues for a quarter circle."""
    around = Path.from_pieces([Arc((0.0, turn * -500.0), (0.0, turn * 500.0), (0.0, 0.0), turn)])
    near = chords([Layer(around, Style.PATH)], View((500.0, 0.0), 1.0), 20, 10)
    assert 20.0 < np.abs(near.runs).sum() < 40.0
