"""A field's text while it is being typed: a line of text with a caret, as plain values."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

LONGEST: Final = 200
"""Characters a field takes; more is a key that got stuck."""


@dataclass(frozen=True, slots=True)
class Editing:
    """The text typed so far; the caret stands before character `caret`.  It takes no more than `most` characters."""

    text: str
    caret: int
    most: int = LONGEST

    @staticmethod
    def of(text: str, most: int = LONGEST) -> Editing:
        """This text, with the caret behind it."""
        return Editing(text, len(text), most)

    def insert(self, characters: str) -> Editing:
        """Characters put in at the caret; control characters are left out."""
        clean = "".join(character for character in characters if character.isprintable())
        text = self.text[: self.caret] + clean + self.text[self.caret :]
        return self if len(text) > self.most else replace(self, text=text, caret=self.caret + len(clean))

    def backspace(self) -> Editing:
        """The character before the caret taken away."""
        before = max(self.caret - 1, 0)
        return replace(self, text=self.text[:before] + self.text[self.caret :], caret=before)

    def delete(self) -> Editing:
        """The character at the caret taken away."""
        return replace(self, text=self.text[: self.caret] + self.text[self.caret + 1 :])

    def at(self, caret: int) -> Editing:
        """The caret moved, within the text."""
        return replace(self, caret=min(max(caret, 0), len(self.text)))


def press(editing: Editing | None, shown: str, key: str, character: str | None) -> Editing | None:
    """What a key makes of a field that shows `shown`; None where the key is none of editing.

    The first character typed replaces what the field shows; backspace and delete then empty it; the arrows left and
    right, Home and End take the text that stands there to change it in the middle.
    """
    match key:
        case "backspace":
            return Editing("", 0) if editing is None else editing.backspace()
        case "delete":
            return Editing("", 0) if editing is None else editing.delete()
        case "left" | "right" | "home" | "end":
            return _moved(Editing.of(shown) if editing is None else editing, key)
        case _ if character is not None and len(character) == 1 and character.isprintable():
            return (editing or Editing("", 0)).insert(character)
        case _:
            return None


def _moved(editing: Editing, key: str) -> Editing:
    steps = {"left": editing.caret - 1, "right": editing.caret + 1, "home": 0, "end": len(editing.text)}
    return editing.at(steps[key])


def window(editing: Editing, width: int) -> tuple[str, int]:
    """The part of the text that fits in `width` cells with the caret in it, and the caret's column there."""
    room = max(width - 1, 1)
    first = max(0, editing.caret - room)
    return editing.text[first : first + max(width, 1)], editing.caret - first
