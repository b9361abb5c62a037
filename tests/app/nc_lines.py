"""Replace, insert and delete lines of an NC text as NC PROOF does: with all lines of the listing at once."""

from __future__ import annotations

from app.documents.nc_text import NcText


def changed(text: NcText, row: int, line: str) -> NcText:
    """The text with one line replaced."""
    return text.with_texts([*text.texts[:row], line, *text.texts[row + 1 :]])


def inserted(text: NcText, row: int, line: str) -> NcText:
    """The text with a line inserted before `row`, or after the last."""
    return text.with_texts([*text.texts[:row], line, *text.texts[row:]])


def deleted(text: NcText, row: int) -> NcText:
    """The text without one line."""
    return text.with_texts([*text.texts[:row], *text.texts[row + 1 :]])
