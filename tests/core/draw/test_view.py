import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.draw.scene import Circle, Layer, Mark, Scene, Style, Symbol
from core.draw.view import View
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Turn


def test_a_wide_part_is_fitted_by_its_width():
    view = View.fit((0.0, 0.0, 92.0, 10.0), 100, 50)
    assert view.center == (46.0, 5.0)
    assert view.scale == pytest.approx(1.0)


def test_a_tall_part_is_fitted_by_its_height_in_cells_twice_as_high():
    view = View.fit((0.0, 0.0, 1.0, 92.0), 100, 50)
    assert view.scale == pytest.approx(1.0)


@pytest.mark.parametrize("bounds", [None, (5.0, 5.0, 5.0, 5.0), (-1e7, -1e7, 1e7, 1e7), (0.0, 0.0, 1e-12, 0.0)])
@pytest.mark.parametrize("size", [(0, 0), (1, 1), (80, 24)])
def test_any_bounds_fit_any_window(bounds, size):
    view = View.fit(bounds, *size)
    assert view.scale > 0.0


def test_pan_moves_by_parts_of_the_window():
    view = View((0.0, 0.0), 2.0).pan(0.5, -0.25, 40, 10)
    assert view.center == (40.0, -10.0)


@pytest.mark.parametrize(
    ("point", "center"),
    [
        ((30.0, 90.0), (30.0, 90.0)),
        ((-50.0, 200.0), (50 / 7, 100.0 - 50 / 7)),
        ((100.0, 0.0), (100.0 - 50 / 7, 50 / 7)),
    ],
)
def test_a_view_over_a_point_shows_little_beyond_the_part(point, center):
    """The window is 20 wide and high; a seventh of it, 20 / 7, may lie outside of the part."""
    view = View((1.0, 2.0), 1.0).centered_on(point, (0.0, 0.0, 100.0, 100.0), 20, 10)
    assert view.center == pytest.approx(center)
    assert view.scale == 1.0
    # a part that the window shows whole need not be in its middle
    assert view.centered_on((3.0, 4.0), (0.0, 0.0, 10.0, 4.0), 40, 40).center == (3.0, 4.0)


def test_zoom_keeps_the_center_and_stays_within_limits():
    view = View((3.0, 4.0), 2.0)
    assert view.zoom(4.0) == View((3.0, 4.0), 0.5)
    assert view.zoom(1e300).scale > 0.0
    assert view.zoom(1e-300).scale < 1e9


@given(st.floats(-100.0, 100.0), st.floats(-100.0, 100.0), st.floats(1e-3, 1e12))
def test_zoom_about_a_point_leaves_it_where_it_is(x, y, factor):
    view = View((3.0, 4.0), 2.0)
    at = view.cell((x, y), 80, 24)
    assert view.zoom(factor, (x, y)).cell((x, y), 80, 24) == pytest.approx(at, abs=1e-4)


def test_the_middle_of_the_window_is_the_center():
    assert View((3.0, 4.0), 2.0).at(20, 5, 40, 10) == (3.0, 4.0)
    assert View((3.0, 4.0), 2.0).at(21, 4, 40, 10) == (5.0, 8.0)


@given(st.floats(-1e4, 1e4), st.floats(-1e4, 1e4), st.floats(1e-3, 1e3))
def test_cell_is_the_inverse_of_at(column, row, scale):
    view = View((12.5, -7.0), scale)
    assert view.cell(view.at(column, row, 80, 24), 80, 24) == pytest.approx((column, row), abs=1e-6)


def test_bounds_take_in_arcs_circles_and_marks_and_pass_over_what_is_not_finite():
    half = Path.from_pieces([Arc((1.0, 0.0), (-1.0, 0.0), (0.0, 0.0), Turn.CCW)])
    broken = Path.from_pieces([Line((0.0, 0.0), (float("nan"), 0.0))])
    far = Path.from_pieces([Line((0.0, 0.0), (1e300, 0.0))])
    scene = Scene(
        (Layer(half, Style.SURFACE), Layer(broken, Style.PATH), Layer(far, Style.PATH)),
        (Circle((4.0, 0.0), 2.0),),
        (Mark((0.0, 9.0), Style.START, Symbol.START),),
    )
    assert scene.bounds == pytest.approx((-1.0, -2.0, 6.0, 9.0))
    assert Scene().bounds is None
    none = Layer(far, Style.DELETED, drawn=np.array([False]))
    assert Scene((none,)).bounds is None


def test_bounds_can_do_without_some_layers_and_reach_as_far_as_their_arcs():
    """An arc over the top and one round the right that begins before it: each tells the side that it passes."""
    over = Path.from_pieces([Arc((3.0, 4.0), (-3.0, 4.0), (0.0, 0.0), Turn.CCW), Line((-3.0, 4.0), (3.0, -4.0))])
    right = Path.from_pieces([Arc((3.0, -4.0), (4.0, 3.0), (0.0, 0.0), Turn.CCW)])
    wide = Path.from_pieces([Arc((-7.0, 0.0), (7.0, 0.0), (0.0, 0.0), Turn.CW)])
    scene = Scene((Layer(over, Style.SURFACE), Layer(wide, Style.UNCUT), Layer(right, Style.PATH)))
    assert scene.bounds == (-7.0, -4.0, 7.0, 7.0)
    assert scene.extent(without={Style.UNCUT}) == (-3.0, -4.0, 5.0, 5.0)
    assert scene.extent(without={Style.UNCUT, Style.PATH}) == (-3.0, -4.0, 3.0, 5.0)
    assert scene.extent(without=set(Style)) is None


def test_a_view_that_was_moved_off_the_part_no_longer_touches_it() -> None:
    bounds = (100.0, 50.0, 110.0, 54.0)
    assert View((125.0, 52.0), 1.0).is_near(bounds, 2.0)
    assert not View((126.0, 52.0), 1.0).is_near(bounds, 2.0)
    assert not View((105.0, 73.0), 1.0).is_near(bounds, 2.0)
