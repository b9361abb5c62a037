"""Memory: the last answer to each question, so that a key pays only for what it changes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, TypeVar

Result = TypeVar("Result")


@dataclass(slots=True)
class Memory:
    """One answer to a question of each name, with what it was asked about."""

    answers: dict[str, tuple[tuple[Any, ...], Any]] = field(default_factory=dict)

    def last(self, name: str, kind: type[Result], begin: tuple[Any, ...]) -> Result | None:
        """The last answer where what it was about begins like this, whatever follows; else None."""
        about, answer = self.answers.get(name, ((), None))
        return answer if about[: len(begin)] == begin and isinstance(answer, kind) else None

    def recall(self, name: str, about: tuple[Any, ...], make: Callable[[], Result]) -> Result:
        """The answer, made again when it was asked about something else last."""
        known = self.answers.get(name)
        if known is None or known[0] != about:
            known = (about, make())
            self.answers[name] = known
        result: Result = known[1]
        return result
