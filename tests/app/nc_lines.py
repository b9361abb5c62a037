"""Lines of an NC text typed over, inserted and deleted, as NC PROOF takes them: all lines of the listing at once."""

from __future__ import annotations

from app.documents.nc_text import NcText


def changed(text: NcText, row: int, line: str) -> NcText:
    """Another text in a line."""
    return text.with_texts([*text.texts[:row], line, *text.texts[row + 1 :]])


def inserted(text: NcText, row: int, line: str) -> NcText:
    """A new line before a line, or after the last."""
    return text.with_texts([*text.texts[:row], line, *text.texts[row:]])


def deleted(text: NcText, row: int) -> NcText:
    """Without a line."""
    return text.with_texts([*text.texts[:row], *text.texts[row + 1 :]])
