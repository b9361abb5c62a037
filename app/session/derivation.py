"""This module holds the calculations that the App's workers run in the background."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from app.session.formats import segment_numbers
from core.pipeline.derived import Derived, DerivedBlock
from core.program.model import Program
from core.progress import Progress, silent

if TYPE_CHECKING:
    from core.advice.lookahead_table import Row, Table


def derived(program: Program, progress: Progress = silent) -> Derived:
    """Derive a program; this imports the numeric libraries, which the first paint must not load."""
    from core.pipeline.derive import derive

    return derive(program, progress)


def lookahead_table(
    block: DerivedBlock, program: Program, report_rows: Callable[[tuple[Row, ...]], None], progress: Progress = silent
) -> Table | None:
    """Return the effect of every look-ahead value on a block; None if there is nothing to compensate.

    Call `report_rows` with all rows so far whenever some are complete.
    """
    from core.pipeline.derive import look_ahead_table

    return look_ahead_table(block, program, progress, report_rows)


def advised(block: DerivedBlock, program: Program, table: Table, progress: Progress) -> Iterator[Table]:
    """Yield the table with notes as they are found: first remedies, then what a better path would cut.

    Call `progress` before each remedy and before the better path; it may raise Stopped.
    """
    from core.pipeline.derive import advice_for_block, better_path

    advice = advice_for_block(block, program, table, progress)
    if advice:
        yield replace(table, notes=advice)
    progress(1.0)
    yield replace(table, notes=(*advice, *better_path(block)), complete=True)


def times_in_words(derived: Derived) -> tuple[str, dict[int, str]]:
    """Return the total time, and the cut, rapid and total times of each postable block, as texts."""
    from core.output.passes import block_times, minutes_text, program_times, times_text
    from core.pipeline.jobs import jobs

    ready = {block.number for block in derived.blocks if block.postable}
    posted = [job for job in jobs(derived) if job.block in ready]
    total = f"{minutes_text(program_times(posted, posted[0].rapid_rate).total)} total" if posted else ""
    if posted and len(posted) < len(derived.blocks):
        # which blocks come first: a narrow screen cuts the end off
        numbers = segment_numbers(job.block for job in posted)
        total = f"{'block' if len(posted) == 1 else 'blocks'} {numbers}: {total}"
    return total, {job.block: times_text(block_times(job, job.rapid_rate)) for job in posted}
