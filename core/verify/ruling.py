"""Ruling: whether a path is clean, which is known long before all that there is to say of one that is not."""

from __future__ import annotations

from collections.abc import Callable

from core.verify.verdict import Verdict


class Ruling:
    """A verdict that is completed when it is read first; `clean` is what the verdict will say of itself.

    Most paths of a look-ahead table gouge, and nobody reads more of them than that they do.  Two threads that read it
    at once may both complete it: the same way.
    """

    __slots__ = ("_complete", "_verdict", "clean")

    def __init__(self, complete: Callable[[], Verdict], *, clean: bool) -> None:
        self.clean = clean
        self._complete: Callable[[], Verdict] | None = complete
        self._verdict: Verdict | None = None

    @staticmethod
    def of(verdict: Verdict) -> Ruling:
        """One whose verdict is there already."""
        return Ruling(lambda: verdict, clean=verdict.clean)

    @property
    def verdict(self) -> Verdict:
        """All that is to be said of the path."""
        complete = self._complete
        if self._verdict is None and complete is not None:
            self._verdict = complete()
        # what it was made of is not needed again
        self._complete = None
        assert self._verdict is not None
        return self._verdict
