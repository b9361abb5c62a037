"""The column of softkeys down the right edge."""

from __future__ import annotations

from functools import lru_cache
from textwrap import wrap
from typing import Final

from app.painted.screens.page import Softkeys
from app.painted.widgets.rows import Look, Row, Span

COUNT: Final = 8
WIDTH: Final = 21
"""Cells of the column with its frame."""
LABEL: Final = 15
"""Cells for a label."""


def softkey_rows(softkeys: Softkeys, height: int) -> tuple[Row, ...]:
    """F1 to F8 spread over the height, each label on one or two lines beside its key."""
    rows: list[Row] = [(Span("│", Look.FRAME),)] * height
    for number in range(1, COUNT + 1):
        top = (number - 1) * height // COUNT
        bottom = number * height // COUNT
        label = softkeys[number].label if number in softkeys else ""
        for row, line in zip(range(top, bottom), _lines(number, label), strict=False):
            rows[row] = line
    return tuple(rows)


@lru_cache(256)
def _lines(number: int, label: str) -> tuple[Row, ...]:
    key = Span(f"F{number}", Look.KEY if label else Look.DIM)
    lines = wrap(label, LABEL) or [""]
    first: Row = (Span("│ ", Look.FRAME), key, Span(f" {lines[0]}", Look.SOFTKEY))
    return (first, *((Span("│", Look.FRAME), Span(f"    {line}", Look.SOFTKEY)) for line in lines[1:]))
