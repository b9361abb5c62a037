"""Texts as they are: what was typed, and what a file holds, may have brackets, which Textual takes for markup."""

from __future__ import annotations

from textual.visual import VisualType
from textual.widgets import Label, Static


class PlainText(Static):
    """Lines as wide as their room."""

    def __init__(self, content: VisualType = "", *, id: str | None = None, classes: str | None = None) -> None:
        super().__init__(content, id=id, classes=classes, markup=False)


class PlainLabel(Label):
    """A line as wide as its text."""

    def __init__(self, content: VisualType = "", *, id: str | None = None, classes: str | None = None) -> None:
        super().__init__(content, id=id, classes=classes, markup=False)
