"""Look-ahead table: what becomes of a block's path at every value, and what would mend it."""

from __future__ import annotations

from collections.abc import Callable

from core.advice.lookahead_table import Table, Trial, table_of
from core.advice.remedies import always
from core.advice.why_not_clean import Needs, needs_of
from core.pipeline.derived import DerivedBlock
from core.pipeline.parameters import parameter, stocks
from core.program.model import Program


def look_ahead_table(block: DerivedBlock, program: Program) -> Table | None:
    """The table of a derived block; None for ON and while there is nothing to compensate."""
    trial = trial_of(block, program)
    return None if trial is None else table_of(trial)


def trial_of(block: DerivedBlock, program: Program) -> Trial | None:
    """What a derived block cuts; None for ON and while there is nothing to compensate."""
    if block.work is None or block.side is None or block.radius is None:
        return None
    return Trial(
        block.work.surface,
        block.side,
        block.radius,
        block.solved.closed,
        parameter(program, "blend_offset"),
        parameter(program, "blend_overlap"),
        () if block.solved.tool_diameter is None else stocks(block, program),
        None if block.solved.finish_diameter is None else (block.solved.tool_diameter or 0.0) / 2,
    )


def needs(
    block: DerivedBlock, program: Program, table: Table | None = None, *, wanted: Callable[[], bool] = always
) -> Needs | None:
    """What a derived block needs; `table` is its look-ahead table where that is known.  None where there is none.

    `wanted` is asked before each remedy is tried: where it says no, the rest is not tried and the answer is None.
    """
    trial = trial_of(block, program)
    if trial is None:
        return None
    return needs_of(trial, block.lookahead.calculated, table or table_of(trial), wanted)
