"""Ruling: whether a path is clean, which is known long before all that there is to say of one that is not."""

from __future__ import annotations

from collections.abc import Callable

from core.verify.verdict import Verdict


class Ruling:
    """A verdict that is completed when it is read first; `clean` is what the verdict will say of itself.

    While a number is typed nobody reads more of a look-ahead table's paths than that they gouge.  Two threads that read
    it at once may both complete it: the same way.
    """

    __slots__ = ("_verdict", "_work", "clean")

    def __init__(self, work: Callable[[], Verdict], *, clean: bool) -> None:
        self.clean = clean
        self._work: Callable[[], Verdict] | None = work
        self._verdict: Verdict | None = None

    @staticmethod
    def of(verdict: Verdict) -> Ruling:
        """One whose verdict is there already."""
        return Ruling(lambda: verdict, clean=verdict.clean)

    @property
    def verdict(self) -> Verdict:
        """All that is to be said of the path."""
        return self.complete()

    def complete(self) -> Verdict:
        """The verdict, worked out unless it was before."""
        work = self._work
        if self._verdict is None and work is not None:
            self._verdict = work()
        # what it was made of is not needed again
        self._work = None
        assert self._verdict is not None
        return self._verdict
