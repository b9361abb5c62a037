"""DerivationActions keeps the session, derives its program in workers, and updates the screens."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING, cast

from textual import on, work
from textual.reactive import var
from textual.timer import Timer
from textual.worker import get_current_worker

from app.screens.base import BaseScreen
from app.screens.contour import ContourScreen
from app.session.derivation import Request, advised, derived, lookahead_table
from app.session.messages import ProgramDerived, RowsKnown, TableMade, Tone
from app.session.session import Session
from app.session.work import Work
from app.work_actions import WorkActions
from core.pipeline.derived import DerivedBlock
from core.program.model import Program
from core.progress import Stopped

if TYPE_CHECKING:
    from app.nc_proof.screen import ProofScreen
    from core.advice.lookahead_table import Row, Table

QUIET = 0.2
"""Seconds without a key before the search for advice starts, so that no key waits for it."""


class DerivationActions(WorkActions):
    """The App's part for what is derived from the program: paths and verdict, look-ahead table, advice.

    `session` holds all accepted edits.  `shown` is what verdict and drawings show: the same session, or the one
    that a half-typed number would make.
    """

    session: var[Session] = var(lambda: Session.of(Program()), init=False)
    shown: var[Session] = var(lambda: Session.of(Program()), init=False)
    guided: var[bool] = var(default=False, init=False)
    """Whether the prompt guides through a first part; Esc ends the guide."""
    characters: var[str] = var("braille", init=False)
    """The character set of drawings and signs."""

    _wanted: Request | None = None
    _deriving: tuple[Request, Work] | None = None
    _making_table: tuple[DerivedBlock, Work] | None = None
    stopped: Program | DerivedBlock | None = None
    """What Esc has stopped: the calculation of a program, or of a block's look-ahead table."""
    _advice_timer: Timer | None = None
    _unit_mentioned = _unit_settled = False

    def say(self, text: str, tone: Tone = Tone.PLAIN) -> None:
        """Show a sentence on the prompt line of the screen in front, or of the one under a dialog."""
        screens = self._screens()
        if screens:
            screens[-1].say(text, tone)

    def try_out(self, program: Program | None) -> None:
        """Show what a half-typed number would do; None when nothing is half-typed."""
        self._advise_later()
        if program is not None:
            self._derive(Request(program, trial=True))
            return
        if self.shown is not self.session:
            self.shown = self.session
        if self._wanted is not None and self._wanted.trial:
            self._wanted = None
        if self._deriving is not None and self._deriving[0].trial:
            self._deriving[1].stopped = True
        if not self.session.derived_block.known and self._wanted is None:
            self._derive(Request(self.session.program))

    def _derive(self, request: Request) -> None:
        """Derive a program in a worker; only the newest waiting request is kept, and an outdated run is stopped."""
        running = self._deriving
        if running is None:
            self._deriving = running = request, self.begin_work(self._calculation_stopped)
            self._derive_in_thread(*running)
        elif running[0].program is not request.program or running[1].stopped:
            self._wanted = request
            if running[0].trial or not request.trial:
                running[1].stopped = True

    # a worker with a program needs a description: else Textual formats the whole program before the next key
    @work(thread=True, group="derive", description="derive")
    def _derive_in_thread(self, request: Request, work: Work) -> None:
        try:
            result = derived(request, work)
        except Stopped:
            result = None
        self.post_message(ProgramDerived(result, request.trial))

    @on(ProgramDerived)
    def _program_derived(self, message: ProgramDerived) -> None:
        if not self.is_running:
            # the screens are gone
            return
        stopped = False
        if self._deriving is not None:
            stopped = self._deriving[1].stopped
            self.end_work(self._deriving[1])
        self._deriving, wanted, self._wanted, result = None, self._wanted, None, None if stopped else message.derived
        if result is not None and result.program is self.session.program:
            self.session = self.session.knowing(result)
            if wanted is None or not wanted.trial:
                self.shown = self.session
                self._mention_unit()
        elif result is not None and message.trial and wanted is None:
            self.shown = self.session.trying(result)
        if wanted is not None:
            self._derive(wanted)
        else:
            self._make_table()

    def _unit_question(self) -> str:
        """Return the question INCH or MM?; empty if the part's size is usual or unknown."""
        from core.pipeline.unit_question import unit_question
        from core.units import sentence

        question = unit_question(self.session.derived)
        return "" if question is None else sentence(question, self.session.program.unit)

    def _mention_unit(self) -> None:
        """Mention a doubtful unit on the form, once per program."""
        if not self._unit_mentioned and isinstance(self.screen, ContourScreen) and (text := self._unit_question()):
            self._unit_mentioned = True
            self.say(f"{text} UNITS is in PROGRAM PARAMETERS.", Tone.WARNING)

    def _make_table(self) -> None:
        """Make the look-ahead table of the block with the cursor in a worker, if it is not known yet."""
        block, running = self.session.derived_block, self._making_table
        if running is not None and running[0] is not block:
            running[1].stopped = True
        known = not block.known or self.stopped is block or (self.session.table and self.session.table[0] is block)
        if running is not None or known:
            self._advise_later()
            return
        self._making_table = block, self.begin_work(self._calculation_stopped)
        self._make_table_in_thread(block, self.session.program, self._making_table[1])

    @work(thread=True, group="table", description="table")
    def _make_table_in_thread(self, block: DerivedBlock, program: Program, work: Work) -> None:
        def known(rows: tuple[Row, ...]) -> None:
            if work.long:
                self.post_message(RowsKnown(block, rows))

        try:
            self.post_message(TableMade(block, lookahead_table(block, program, known, work)))
        except Stopped:
            self.post_message(TableMade(None, None))

    @on(RowsKnown)
    def _rows_known(self, message: RowsKnown) -> None:
        """Show the values that are judged while the others are still being calculated."""
        if self.is_running and isinstance(self.screen, ContourScreen):
            self.screen.show_rows(message.block, message.rows)

    @on(TableMade)
    def _table_made(self, message: TableMade) -> None:
        if not self.is_running:
            return
        if not message.advised and self._making_table is not None:
            self.end_work(self._making_table[1])
            self._making_table = None
        if message.block is not None:
            trial = self.shown is not self.session
            self.session = self.session.with_table(message.block, message.table)
            if not trial:
                self.shown = self.session
        if not message.advised:
            self._make_table()

    def _calculation_stopped(self) -> None:
        """Note what Esc has stopped; an edit or CALCULATE starts it again."""
        block = self.session.derived_block
        self.stopped = block if block.known else self.session.program
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

    def watch_shown(self, shown: Session) -> None:
        """Update all screens after the session on display has changed."""
        for screen in self._screens():
            screen.follow_shown(shown)

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
        if self.session.derived_block.known:
            self._make_table()
        else:
            self._derive(Request(self.session.program))

    def _advise_later(self) -> None:
        """Stop the search for advice, and start it again after a pause."""
        self.workers.cancel_group(self, "advice")
        if self._advice_timer is not None:
            self._advice_timer.stop()
        self._advice_timer = self.set_timer(QUIET, self._advise) if self.is_running else None

    def _advise(self) -> None:
        """Add notes to the look-ahead table of the block with the cursor in a worker, if they are not known yet."""
        table, block = self.session.lookahead_table, self.session.derived_block
        if table is not None and not table.complete and self.shown is self.session and self._deriving is None:
            self._advise_in_thread(block, self.session.program, table)

    @work(thread=True, group="advice", exclusive=True, description="advice")
    def _advise_in_thread(self, block: DerivedBlock, program: Program, table: Table) -> None:
        worker = get_current_worker()

        def check(_: float) -> None:
            if worker.is_cancelled:
                raise Stopped

        with suppress(Stopped):
            for noted in advised(block, program, table, check):
                check(1.0)
                self.post_message(TableMade(block, noted, advised=True))

    def _uncover(self, depth: int) -> None:
        """Bring the screen at `depth` of the stack to the front; close those above it."""
        for _ in self.screen_stack[depth + 1 :]:
            self.pop_screen()

    def begin(self, session: Session) -> None:
        """Switch to the session of another program, or of the same one under a new name."""
        same = session.program is self.session.program and session.derived is self.session.derived
        if session.program is not self.session.program:
            self.guided = self._unit_mentioned = self._unit_settled = False
            self.quiet()
        self.session = self.shown = session
        if not same:
            self._derive(Request(session.program))

    def quiet(self) -> None:
        """Show the prompt again on every screen."""
        for screen in self._screens():
            screen.quiet()

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
