"""The words with which an operator posts a path in spite of the verdict, and what they can override."""

from __future__ import annotations

from typing import Final

OVERRIDE: Final = "POST WITH GOUGE"
"""What an operator must say, word for word, to have a path posted that the verdict is against."""

OVERRIDABLE: Final = frozenset({"GOUGE", "BLEND_GOUGES", "ROUGH_GOUGES", "WRONG_SIDE"})
"""Findings on a path that is whole and known; whatever is unread, missing or undetermined can never be overridden."""
