"""Rows: what is painted again and what is not."""

from __future__ import annotations

import pytest

from app.painted.widgets.rows import Area, Look, Part, Span, _side_by_side, changed, composed, padded, plain, text_of


def test_equal_rows_cost_nothing_however_they_are_cut() -> None:
    assert changed(plain("abc"), plain("abc")) is None
    assert changed(plain("abc"), (Span("a"), Span("bc"))) is None


def test_only_the_cells_that_differ_are_painted() -> None:
    assert changed(plain("TOOL   1"), plain("TOOL   2")) == (7, 1)
    assert changed(plain("abcdef"), plain("aXcdYf")) == (1, 4)


def test_another_look_is_a_difference() -> None:
    assert changed(plain("abc"), (Span("a"), Span("b", Look.CURSOR), Span("c"))) == (1, 1)


def test_a_shorter_row_clears_the_rest() -> None:
    assert changed(plain("abcdef"), plain("abc")) == (3, 3)
    assert changed(plain("abc   "), plain("abc")) is None


def test_padding_gives_exactly_the_width() -> None:
    assert text_of(padded(plain("abc"), 5)) == "abc  "
    assert text_of(padded((Span("abc"), Span("def")), 4)) == "abcd"
    assert padded(plain("abc"), 0) == ()


@pytest.mark.parametrize("height", [0, 2, 5])
def test_lines_of_a_picture_taken_over_are_those_made_anew(height: int) -> None:
    body, beside = Area(2, 1, 4, 2), Area(8, 0, 3, 9)
    for focus in (0, 2):
        for rows in ((plain("ab"), plain("cdefgh"), plain("i", Look.HEAD)), (plain("ab"),), ()):
            parts = [Part(beside, (plain("1"), plain("23"))), Part(body, rows, focus), Part(Area(0, 0, 0, 5), rows)]
            kept = composed(parts, 12, height)
            _side_by_side.cache_clear()
            assert composed(parts, 12, height) == kept
            assert [len(text_of(row)) for row in kept] == [12] * height


def test_parts_stand_where_their_areas_are() -> None:
    parts = [
        Part(Area(8, 0, 3, 9), (plain("1"), plain("23"))),
        Part(Area(2, 1, 4, 1), (plain("abcdef"), plain("g")), 1),
    ]
    assert [text_of(row) for row in composed(parts, 12, 3)] == ["        1   ", "  g     23  ", "            "]
