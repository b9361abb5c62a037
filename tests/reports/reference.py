"""The App without a terminal and without threads: what must stand on the screen after every key."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterable
from typing import Any

from textual.keys import _character_to_key

from app.painted.application import CutcompApp
from app.painted.desk import Desk
from app.painted.engine import Engine
from app.painted.session import Session
from app.painted.widgets.rows import Row, text_of
from core.pipeline.derived import Derived
from tests.app.operator import FROZEN


class Reference(CutcompApp):
    """The same App: what it would do in threads is done at once, nothing is painted, nobody leaves."""

    def __init__(self, session: Session, keep: Callable[[Desk], Desk] = lambda desk: desk) -> None:
        super().__init__(session, FROZEN, Engine(), keep)
        self.left = False
        for desk in self.behind:
            desk.begin = at_once
        program = session.program
        self._loading.ask(lambda: self.engine.load(program))

    def _loaded(self, derived: Derived) -> None:
        """Many live in one process, one after the other: what those before have left is collected."""
        super()._loaded(derived)
        gc.unfreeze()

    def call_later(self, callback: Callable[..., Any], *arguments: Any, **named: Any) -> bool:
        """Errors of a desk."""
        callback(*arguments, **named)
        return True

    def refresh_screen(self, width: int = 0, height: int = 0) -> None:
        del width, height

    def after(self, *_: Any, **__: Any) -> Any:
        """Nothing runs out here: the digit behind Esc is the next key, and nobody rests while a number is typed."""

    def exit(self, *_: Any, **__: Any) -> None:
        self.left = True

    def press(self, *keys: str) -> Reference:
        """Keys by name, or single characters."""
        for key in keys:
            self.key(name_of(key), character_of(key))
        return self

    def rows(self, width: int = 80, height: int = 24) -> tuple[Row, ...]:
        """The screen with its looks."""
        return self.picture(width, height)

    def lines(self, width: int = 80, height: int = 24) -> list[str]:
        """The screen's text."""
        return [text_of(row) for row in self.rows(width, height)]

    def fresh(self, width: int = 80, height: int = 24) -> list[str]:
        """The screen's text as one who remembers nothing but the desk draws it."""
        other = Reference(self.desk.session)
        other.desk = self.desk
        other.key_less()
        return other.lines(width, height)

    def key_less(self) -> None:
        """Everything calculated that the desk asks for, without a key.

        First without what is being typed: what the contour needs is asked for before a field is typed into, and holds
        for a number that leaves the contour as it is.
        """
        self._derive()
        self.trial = None
        self.advice.seek()
        self._advance()


def name_of(key: str) -> str:
    """A key's name as Textual has it."""
    return key if len(key) > 1 or key.isalnum() else _character_to_key(key)


def character_of(key: str) -> str | None:
    """The character a key types, None for a key that types none."""
    return " " if key == "space" else key if len(key) == 1 else None


def keys_of(*texts: str | Iterable[str]) -> tuple[str, ...]:
    """Names stay whole, lists are spread: keys_of("tab", [*"1.5"], "enter")."""
    return tuple(key for text in texts for key in ((text,) if isinstance(text, str) else text))


def at_once(work: Callable[[], Callable[[], None]]) -> None:
    """In place of a thread."""
    work()()
