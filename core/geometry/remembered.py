"""Remembered: what a formula yielded for a few pieces, for when it is asked the same again.

With each key of an edit a path is measured anew, and what few of its pairs need a long formula are nearly always where
the edit is not: the same numbers are asked for again, and the same numbers are the answer.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any, Final

from numpy.typing import NDArray

from core.geometry.piece_arrays import Given, PieceArrays

FEW: Final = 50
"""Pieces of which the answer is kept: more of them are seldom all as they were, and take more room."""

KEPT: Final = 64
"""Answers that are kept, those asked for last: a key asks for those of the path and of up to twenty look-aheads."""

Answer = tuple[NDArray[Any], ...]


class _Asked:
    """A formula and what it is given, equal to another one if every bit of both is."""

    __slots__ = ("bits", "formula", "given")

    def __init__(self, formula: Callable[..., Answer], given: tuple[Given, ...]) -> None:
        self.formula, self.given = formula, given
        self.bits = (formula, *(bits for one in given for bits in _bits(one)))

    def __hash__(self) -> int:
        return hash(self.bits)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Asked) and self.bits == other.bits


def _bits(given: Given) -> tuple[bytes, ...]:
    """All that a formula may use; the row a piece has in its path is not among it."""
    if not isinstance(given, PieceArrays):
        return (given.tobytes(),)
    points = given.start.tobytes(), given.vector.tobytes(), given.arm.tobytes()
    sizes = given.angle.tobytes(), given.radius.tobytes(), given.length.tobytes(), given.slack.tobytes()
    return (*points, given.turn.tobytes(), *sizes)


def remembered(formula: Callable[..., Answer]) -> Callable[..., Answer]:
    """The same formula of pieces (n) and of arrays (n,), which must not use the pieces' `rows`.

    Its answers, arrays that cannot be written to, are kept where the pieces are few.
    """

    def asked(*given: Given) -> Answer:
        return formula(*given) if len(given[0]) > FEW else _answer(_Asked(formula, given))

    return asked


@lru_cache(maxsize=KEPT)
def _answer(asked: _Asked) -> Answer:
    answer = asked.formula(*asked.given)
    for array in answer:
        array.setflags(write=False)
    return answer
