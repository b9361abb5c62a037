"""Rows: what is painted again and what is not."""

from __future__ import annotations

from app.widgets.rows import Look, Span, changed, padded, plain, text_of


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
