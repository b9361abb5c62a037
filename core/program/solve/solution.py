"""This module lists what SOLUTION steps through: the answers of a run, or the two solutions of a single segment.

The shortest answer of a run comes first; a single segment's two solutions keep their documented order.
"""

from __future__ import annotations

from dataclasses import dataclass

from core.geometry.piece import Piece
from core.program.solve.solved import RunAnswer, SolvedBlock


@dataclass(frozen=True, slots=True)
class Solution:
    """The answers at a segment.

    `number` is the segment whose `choice` or pick selects one; `taken` is the index of the one in force, or None.
    """

    number: int
    answers: tuple[RunAnswer, ...]
    taken: int | None

    @property
    def label(self) -> str:
        """The text in the field, such as `2 of 4`, or `? of 4` if none is taken."""
        return f"{'?' if self.taken is None else self.taken + 1} of {len(self.answers)}"

    @property
    def labels(self) -> tuple[str, ...]:
        """The text in the field for each answer."""
        return tuple(f"{index} of {len(self.answers)}" for index in range(1, len(self.answers) + 1))


def solution_at(block: SolvedBlock, number: int) -> Solution | None:
    """Return the solutions to choose from at a segment; None if there is no choice."""
    run = block.run_of(number)
    if run is not None and (len(run.answers) > 1 or (run.answers and run.taken is None)):
        return Solution(run.first, run.answers, run.taken)
    if not 1 <= number <= len(block.segments):
        return None
    segment = block.segments[number - 1]
    if len(segment.choices) < 2:
        return None
    answers = tuple(RunAnswer(((number, piece),), piece.length, choice) for choice, piece in enumerate(segment.choices))
    taken = None if segment.sharp is None else segment.choices.index(segment.sharp)
    return Solution(number, answers, taken)


def untaken_pieces(block: SolvedBlock, number: int) -> tuple[tuple[Piece, ...], ...]:
    """Return the pieces of the answers not taken at a segment, none until one is taken; a drawing shows them dotted."""
    solution = solution_at(block, number)
    if solution is None or solution.taken is None:
        return ()
    others = (answer for index, answer in enumerate(solution.answers) if index != solution.taken)
    return tuple(tuple(piece for _, piece in answer.pieces) for answer in others)
