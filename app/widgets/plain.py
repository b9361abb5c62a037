"""This module shows text literally: typed text and files may have brackets, which Textual takes for markup."""

from __future__ import annotations

from textual.visual import VisualType
from textual.widgets import Label, Static


class PlainText(Static):
    """Lines of text as wide as their container."""

    def __init__(self, content: VisualType = "", *, id: str | None = None, classes: str | None = None) -> None:
        super().__init__(content, id=id, classes=classes, markup=False)


class PlainLabel(Label):
    """A line of text as wide as the text."""

    def __init__(self, content: VisualType = "", *, id: str | None = None, classes: str | None = None) -> None:
        super().__init__(content, id=id, classes=classes, markup=False)
