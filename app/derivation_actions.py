"""DerivationActions keeps the session, derives its program in workers, and shows their progress and results."""

from __future__ import annotations

from asyncio import to_thread
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, cast

from textual import on, work
from textual.app import App
from textual.reactive import var
from textual.timer import Timer

from app.screens.base import BaseScreen
from app.screens.contour import ContourScreen
from app.session.messages import TableRowsJudged, Tone
from app.session.session import Session
from app.session.work import SECONDS_BEFORE_PROGRESS, Work, advised, derived, while_wanted
from core.pipeline.derived import DerivedBlock
from core.program.model import Program
from core.progress import Stopped

if TYPE_CHECKING:
    from app.nc_proof.screen import ProofScreen
    from core.advice.lookahead_table import Row, Table

ADVICE_DELAY = 0.2
"""Seconds without a key before the search for advice starts, so that no key waits for it."""


class DerivationActions(App[int]):
    """The App's part for long work and for what is derived from the program: paths and verdict, table, advice.

    `session` holds all accepted edits.  `displayed` is what verdict and drawings show: the same session, or the one
    that a half-typed number would make.
    """

    session: var[Session] = var(lambda: Session.of(Program()), init=False)
    displayed: var[Session] = var(lambda: Session.of(Program()), init=False)
    guided: var[bool] = var(default=False, init=False)
    """Whether the prompt guides through a first part; Esc ends the guide."""
    characters: var[str] = var("braille", init=False)
    """The character set of drawings and signs."""

    _works: tuple[Work, ...] = ()
    _deriving: Program | None = None
    """The program that is being derived."""
    stopped: Program | DerivedBlock | None = None
    """What Esc has stopped: the calculation of a program, or of a block's look-ahead table."""
    _advice_timer: Timer | None = None
    _unit_mentioned = _unit_settled = False
    part_is_drawn = False
    """Whether all contours of the program are from a drawing whose unit is known."""

    def say(self, text: str, tone: Tone = Tone.PLAIN) -> None:
        """Show a sentence on the prompt line of the screen in front, or of the one under a dialog."""
        screens = self._screens()
        if screens:
            screens[-1].say(text, tone)

    # ---- long work, its progress and its end

    @contextmanager
    def working(self, on_stop: Callable[[], None]) -> Iterator[Work]:
        """Show the progress of work in a thread; `on_stop` is called if Esc stops it.

        The thread then raises Stopped at its next report, and also if the worker that waits for it is canceled.
        """
        work, timer = Work(on_stop), self.set_interval(SECONDS_BEFORE_PROGRESS, self.show_work)
        self._works = (*self._works, work)
        try:
            yield work
        finally:
            timer.stop()
            self._end_work(work)

    def _end_work(self, work: Work) -> None:
        work.stopped = True
        self._works = tuple(each for each in self._works if each is not work)
        self.show_work()

    @property
    def longest_work(self) -> Work | None:
        """The work that has run longest, if it has run long enough to be shown."""
        return next((each for each in self._works if each.long), None)

    def show_work(self) -> None:
        """Show the progress of the longest work on the screen in front."""
        for screen in self.screen_stack[-1:]:
            if isinstance(screen, BaseScreen):
                screen.show_work(self.longest_work)

    def check_action(self, action: str, parameters: tuple[object, ...]) -> bool | None:
        """Let Esc stop work only if some has run long enough; otherwise Esc goes to the screen."""
        if action == "stop_work":
            return any(each.stoppable for each in self._works)
        return super().check_action(action, parameters)

    def action_stop_work(self) -> None:
        """Stop all work that has run long enough."""
        for each in self._works:
            if each.stoppable:
                self._end_work(each)
                each.on_stop()

    # ---- the program, its table, and advice

    def try_out(self, program: Program | None) -> None:
        """Show what a half-typed number would do; None when nothing is half-typed."""
        self._advise_later()
        if program is not None:
            self._derive(program)
            return
        if self.displayed is not self.session:
            self.displayed = self.session
        if self._deriving is not self.session.program:
            self._deriving = None
            self.workers.cancel_group(self, "derive")
            if not all(block.complete for block in self.session.derived.blocks):
                self._derive(self.session.program)

    def _derive(self, program: Program) -> None:
        """Derive a program in place of any other."""
        if self._deriving is not program:
            self._deriving = program
            self._derive_in_thread(program)

    # a worker with a program needs a description: else Textual formats the whole program before the next key
    @work(exclusive=True, group="derive", description="derive")
    async def _derive_in_thread(self, program: Program) -> None:
        with suppress(Stopped), self.working(self._calculation_stopped) as work:
            result = await to_thread(derived, program, work)
            self._deriving = None
            if program is self.session.program:
                self.session = self.displayed = self.session.with_derived(result)
                if (
                    not self._unit_mentioned
                    and isinstance(self.screen, ContourScreen)
                    and (text := self._unit_question())
                ):
                    self._unit_mentioned = True
                    self.say(f"{text} UNITS is in PROGRAM PARAMETERS.", Tone.WARNING)
                self._make_table()
            else:
                self.displayed = self.session.with_trial(result)

    def _unit_question(self) -> str:
        """Return the question INCH or MM?; empty if the part's size is usual or unknown."""
        from core.pipeline.unit_question import unit_question
        from core.units import sentence

        question = unit_question(self.session.derived, drawn=self.part_is_drawn)
        return "" if question is None else sentence(question, self.session.program.unit)

    def _make_table(self) -> None:
        """Make the look-ahead table of the block with the cursor, if it is not known yet."""
        block, table = self.session.derived_block, self.session.table
        if not block.complete or self.stopped is block or (table and table[0] is block):
            self._advise_later()
        else:
            self._make_table_in_thread(block, self.session.program)

    @work(exclusive=True, group="table", description="table")
    async def _make_table_in_thread(self, block: DerivedBlock, program: Program) -> None:
        # loaded by now: the block is complete
        from core.pipeline.derive import look_ahead_table

        def report_rows(rows: tuple[Row, ...]) -> None:
            self.post_message(TableRowsJudged(block, rows))

        with suppress(Stopped), self.working(self._calculation_stopped) as work:
            table = await to_thread(look_ahead_table, block, program, progress=work, report_rows=report_rows)
            self._show_table(block, table)
            self._advise_later()

    @on(TableRowsJudged)
    def _show_judged_rows(self, message: TableRowsJudged) -> None:
        """Show the values that are judged while the others are still being calculated, if that takes long."""
        if self.is_running and self.longest_work is not None and isinstance(self.screen, ContourScreen):
            self.screen.show_rows(message.block, message.rows)

    def _show_table(self, block: DerivedBlock, table: Table | None) -> None:
        trial = self.displayed is not self.session
        self.session = self.session.with_table(block, table)
        if not trial:
            self.displayed = self.session

    def _calculation_stopped(self) -> None:
        """Note what Esc has stopped; an edit or CALCULATE starts it again."""
        block = self.session.derived_block
        self._deriving = None
        self.stopped = block if block.complete else self.session.program
        self.say("Stopped. Any edit calculates again, or Ctrl+K and CALCULATE.", Tone.WARNING)

    def end_guide(self, text: str) -> None:
        """End the guide if it is on, and show this text."""
        if self.guided:
            self.guided = False
            self.say(text)

    def watch_session(self, session: Session) -> None:
        """Update all screens after the session has changed."""
        for screen in self._screens():
            screen.follow(session)

    def watch_displayed(self, displayed: Session) -> None:
        """Update all screens after the session on display has changed."""
        for screen in self._screens():
            screen.follow_displayed(displayed)

    def watch_characters(self, characters: str) -> None:
        """Redraw all screens with these characters."""
        for screen in self._screens():
            screen.draw_with(characters)
            screen.show_signs()

    def _screens(self) -> list[BaseScreen]:
        return [screen for screen in self.screen_stack if isinstance(screen, BaseScreen)]

    def watch_guided(self) -> None:
        """Update the prompt at once."""
        if isinstance(self.screen, BaseScreen):
            self.screen.refresh_frame()

    def action_calculate(self) -> None:
        """Restart what Esc has stopped."""
        self.stopped = None
        if self.session.derived_block.complete:
            self._make_table()
        else:
            self._derive(self.session.program)

    def _advise_later(self) -> None:
        """Stop the search for advice, and start it again after a pause."""
        self.workers.cancel_group(self, "advice")
        if self._advice_timer is not None:
            self._advice_timer.stop()
        self._advice_timer = self.set_timer(ADVICE_DELAY, self._advise) if self.is_running else None

    def _advise(self) -> None:
        """Add notes to the look-ahead table of the block with the cursor in a worker, if they are not known yet."""
        table, block = self.session.lookahead_table, self.session.derived_block
        if table is not None and not table.complete and self.displayed is self.session and self._deriving is None:
            self._advise_in_thread(block, self.session.program, table)

    @work(group="advice", exclusive=True, description="advice")
    async def _advise_in_thread(self, block: DerivedBlock, program: Program, table: Table) -> None:
        notes = advised(block, program, table, while_wanted())
        with suppress(Stopped):
            while (noted := await to_thread(next, notes, None)) is not None:
                self._show_table(block, noted)

    def _uncover(self, depth: int) -> None:
        """Bring the screen at `depth` of the stack to the front; close those above it."""
        for _ in self.screen_stack[depth + 1 :]:
            self.pop_screen()

    def switch_session(self, session: Session) -> None:
        """Switch to the session of another program, or of the same one under a new name."""
        same = session.program is self.session.program and session.derived is self.session.derived
        if session.program is not self.session.program:
            self.guided = self._unit_mentioned = self._unit_settled = self.part_is_drawn = False
            self.clear_notice()
        self.session = self.displayed = session
        if not same:
            self._derive(session.program)

    def clear_notice(self) -> None:
        """Show the prompt again on every screen."""
        for screen in self._screens():
            screen.clear_notice()

    def take_typed(self) -> bool:
        """Take what is half-typed on the screen in front; return False if it is refused."""
        return not isinstance(self.screen, BaseScreen) or self.screen.take()

    @property
    def proof(self) -> ProofScreen | None:
        """The NC PROOF screen in front; None if another screen is."""
        proofs = self.proofs
        return proofs[-1] if proofs and proofs[-1] is self.screen else None

    @property
    def proofs(self) -> list[ProofScreen]:
        """Every open NC PROOF screen."""
        # by a mark: importing the class would load the controls and numpy before the first paint
        screens = [screen for screen in self.screen_stack if isinstance(screen, BaseScreen) and screen.SHOWS_NC_TEXT]
        return [cast("ProofScreen", screen) for screen in screens]
