"""This module holds the calculations that the App runs in threads, and Work, which tracks the progress of one."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from time import monotonic
from typing import TYPE_CHECKING, Final

from textual.worker import get_current_worker

from app.session.formats import segment_numbers
from core.pipeline.derived import Derived, DerivedBlock
from core.program.model import Program
from core.progress import Progress, Stopped, silent

if TYPE_CHECKING:
    from core.advice.lookahead_table import Table

SECONDS_BEFORE_PROGRESS: Final = 0.3
"""Seconds after which the progress of work is shown."""
SECONDS_BEFORE_STOP: Final = 1.0
"""Seconds after which Esc stops work."""


@dataclass(eq=False, slots=True)
class Work:
    """One piece of work; the thread calls it with the fraction done, the screen reads that and may stop it.

    `on_stop` is called when Esc stops the work, so that nothing waits for the result.
    """

    on_stop: Callable[[], None]
    begun: float = field(default_factory=monotonic)
    done: float = 0.0
    stopped: bool = False

    def __call__(self, done: float) -> None:
        """Record the fraction done, 0 to 1; raise Stopped if the work has been stopped."""
        if self.stopped:
            raise Stopped
        self.done = done

    @property
    def long(self) -> bool:
        """True if the work has run long enough for its progress to be shown."""
        return monotonic() - self.begun >= SECONDS_BEFORE_PROGRESS

    @property
    def stoppable(self) -> bool:
        """True if the work has run long enough for Esc to stop it."""
        return monotonic() - self.begun >= SECONDS_BEFORE_STOP

    @property
    def text(self) -> str:
        """The progress, and whether Esc stops the work."""
        stops = ", Esc stops" if self.stoppable else ""
        return f"working {round(100 * min(self.done, 1.0))} %{stops}"


def while_wanted() -> Progress:
    """Return a progress callback that raises Stopped once the current worker is canceled."""
    worker = get_current_worker()

    def check(_: float) -> None:
        if worker.is_cancelled:
            raise Stopped

    return check


# ---- the calculations


def derived(program: Program, progress: Progress = silent) -> Derived:
    """Derive a program; this imports the numeric libraries, which the first paint must not load."""
    from core.pipeline.derive import derive

    return derive(program, progress)


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
