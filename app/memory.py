"""Memory: the last answer to each question, so that a key pays only for what it changes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from core.records import dataclass, field

Result = TypeVar("Result")


@dataclass(slots=True)
class Memory:
    """One answer to a question of each name, with what it was asked about."""

    answers: dict[str, tuple[tuple[Any, ...], Any]] = field(default_factory=dict)

    def last(self, name: str, kind: type[Result]) -> Result | None:
        """The last answer whatever it was about; None when there is none."""
        answer = self.answers[name][1] if name in self.answers else None
        return answer if isinstance(answer, kind) else None

    def recall(self, name: str, about: tuple[Any, ...], make: Callable[[], Result]) -> Result:
        """The answer, made again when it was asked about something else last."""
        known = self.answers.get(name)
        if known is None or known[0] != about:
            known = (about, make())
            self.answers[name] = known
        result: Result = known[1]
        return result
