"""Properties that count how often they tested something.

A property whose strategy rarely makes what it is about passes without testing.  Such a one calls `exercised` where it
tests, with the name of what it tests, and `must_exercise` fails it where that happened in too few of its examples.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from functools import wraps
from typing import Any

_counted: Counter[str] = Counter()


def exercised(what: str = "") -> None:
    """Say that this example tests something, as often as it does so."""
    _counted[what] += 1


def must_exercise(share: float, *names: str) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Fail a property that did not test each of `names` in so large a share of its examples; it goes above `given`."""

    def decorated(test: Any) -> Callable[..., None]:
        examples = 0
        inner = test.hypothesis.inner_test

        @wraps(inner)
        def counted(*arguments: Any, **named: Any) -> Any:
            nonlocal examples
            examples += 1
            return inner(*arguments, **named)

        test.hypothesis.inner_test = counted

        @wraps(test)
        def checked(*arguments: Any, **named: Any) -> None:
            nonlocal examples
            examples = 0
            _counted.clear()
            test(*arguments, **named)
            for name in names or ("",):
                assert _counted[name] >= share * examples, (
                    f"{name or 'it'} was tested {_counted[name]} times in {examples} examples"
                )

        return checked

    return decorated
