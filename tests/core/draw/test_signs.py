import pytest

from core.draw.characters import arrow, round_length, scale_bar
from core.units import Unit


@pytest.mark.parametrize(
    ("most", "length", "decimals"),
    [(1.0, 1.0, 0), (0.99, 0.5, 1), (1.99, 1.0, 0), (2.0, 2.0, 0), (49.9, 20.0, 0), (0.003, 0.002, 3), (7e5, 5e5, 0)],
)
def test_round_lengths_are_1_2_or_5(most, length, decimals):
    found, places = round_length(most)
    assert found == pytest.approx(length)
    assert places == decimals


def test_a_bar_in_inches():
    assert scale_bar(25.4 / 20, 40, Unit.IN, "|-|") == "|---------| 0.5 IN"


def test_a_bar_in_millimeters():
    assert scale_bar(2.0, 40, Unit.MM, "├─┤") == "├─────────┤ 20 MM"


def test_a_bar_is_never_shorter_than_a_cell():
    assert scale_bar(0.6, 1, Unit.MM, "|-|") == "|| 0.5 MM"


@pytest.mark.parametrize(
    ("direction", "head"),
    [((1, 0), "0"), ((1, 1), "1"), ((0, 1), "2"), ((-1, 0), "4"), ((-1, -0.0), "4"), ((0, -1), "6"), ((1, -1), "7")],
)
def test_arrow_heads_point_along_the_travel(direction, head):
    assert arrow(direction, "01234567") == head
