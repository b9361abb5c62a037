"""The session, what workers derive from its program, and the screens that follow both."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from textual import on, work
from textual.reactive import var
from textual.timer import Timer
from textual.worker import get_current_worker

from app.screens.base import BaseScreen
from app.screens.contour import ContourScreen
from app.session.derivation import Request, advised, derived, lookahead_table
from app.session.messages import ProgramDerived, TableMade, Tone
from app.session.session import Session
from app.session.work import Work
from app.work_actions import WorkActions
from core.pipeline.derived import DerivedBlock
from core.program.model import Program
from core.progress import Stopped

if TYPE_CHECKING:
    from app.nc_proof.screen import ProofScreen
    from core.advice.lookahead_table import Table

QUIET = 0.2
"""Seconds without a key after which it is looked for what would help: a key never waits for that."""


class DerivationActions(WorkActions):
    """The App's side of what follows from the program: paths and verdict, look-ahead table, advice.

    `session` is the work as it has been accepted.  `shown` is what verdict and drawings show: the same, or the session
    as a half-typed number would make it.
    """

    session: var[Session] = var(lambda: Session.of(Program()), init=False)
    shown: var[Session] = var(lambda: Session.of(Program()), init=False)
    guided: var[bool] = var(default=False, init=False)
    """The prompt leads through a first part; Esc ends it."""
    characters: var[str] = var("braille", init=False)
    """The set of characters that drawings and signs are made of."""

    _wanted: Request | None = None
    _deriving: tuple[Request, Work] | None = None
    _making_table: tuple[DerivedBlock, Work] | None = None
    stopped: Program | DerivedBlock | None = None
    """What is not worked out since Esc has stopped it: all of a program, or the look-ahead table of a block."""
    _advice_timer: Timer | None = None
    _unit_mentioned = _unit_settled = False

    def say(self, text: str, tone: Tone = Tone.PLAIN) -> None:
        """A sentence on the prompt line of the screen in front, or of the one under a dialog."""
        screens = self._screens()
        if screens:
            screens[-1].say(text, tone)

    def try_out(self, program: Program | None) -> None:
        """Show what a half-typed number would do; None for nothing half-typed."""
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
        """Have a program derived; of several that wait only the newest is, and one nobody waits for is given up."""
        running = self._deriving
        if running is None:
            self._deriving = running = request, self.begin_work(self._calculation_stopped)
            self._derive_in_thread(*running)
        elif running[0].program is not request.program or running[1].stopped:
            self._wanted = request
            if running[0].trial or not request.trial:
                running[1].stopped = True

    # described, as every worker that takes a program: else Textual writes all of it down, before the next key
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
        """INCH or MM? as a sentence, empty where the part's size is as usual or nothing is known of it."""
        from core.pipeline.unit_question import unit_question
        from core.units import sentence

        question = unit_question(self.session.derived)
        return "" if question is None else sentence(question, self.session.program.unit)

    def _mention_unit(self) -> None:
        """Ask for the unit on the form, once for a program."""
        if not self._unit_mentioned and isinstance(self.screen, ContourScreen) and (text := self._unit_question()):
            self._unit_mentioned = True
            self.say(f"{text} UNITS is in PROGRAM PARAMETERS.", Tone.WARNING)

    def _make_table(self) -> None:
        """Have the look-ahead table of the block in front made, where it is not known yet."""
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
        try:
            self.post_message(TableMade(block, lookahead_table(block, program, work)))
        except Stopped:
            self.post_message(TableMade(None, None))

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
        """Esc has stopped the derivation or the table: it is begun again by an edit, or when it is asked for."""
        block = self.session.derived_block
        self.stopped = block if block.known else self.session.program
        self.say("Stopped. Any edit calculates again, or Ctrl+K and CALCULATE.", Tone.WARNING)

    def end_guide(self, text: str) -> None:
        """The prompt is the screens' own again; says so where it was not."""
        if self.guided:
            self.guided = False
            self.say(text)

    def watch_session(self, session: Session) -> None:
        """All screens follow the session."""
        for screen in self._screens():
            screen.follow(session)

    def watch_shown(self, shown: Session) -> None:
        """So they do what half-typed numbers would do."""
        for screen in self._screens():
            screen.follow_shown(shown)

    def watch_characters(self, characters: str) -> None:
        """All screens draw with these characters."""
        for screen in self._screens():
            screen.draw_with(characters)
            screen.show_signs()

    def _screens(self) -> list[BaseScreen]:
        return [screen for screen in self.screen_stack if isinstance(screen, BaseScreen)]

    def watch_guided(self) -> None:
        """The prompt changes at once."""
        if isinstance(self.screen, BaseScreen):
            self.screen.refresh_frame()

    def action_calculate(self) -> None:
        """Begin again what Esc has stopped."""
        self.stopped = None
        if self.session.derived_block.known:
            self._make_table()
        else:
            self._derive(Request(self.session.program))

    def _advise_later(self) -> None:
        """Stop looking for what would help; begin again once no key has come for a while."""
        self.workers.cancel_group(self, "advice")
        if self._advice_timer is not None:
            self._advice_timer.stop()
        self._advice_timer = self.set_timer(QUIET, self._advise) if self.is_running else None

    def _advise(self) -> None:
        """Have notes added to the look-ahead table of the block in front, where they are not known yet."""
        table, block = self.session.lookahead_table, self.session.derived_block
        if table is not None and not table.complete and self.shown is self.session and self._deriving is None:
            self._advise_in_thread(block, self.session.program, table)

    @work(thread=True, group="advice", exclusive=True, description="advice")
    def _advise_in_thread(self, block: DerivedBlock, program: Program, table: Table) -> None:
        worker = get_current_worker()
        for noted in advised(block, program, table, lambda: not worker.is_cancelled):
            if not worker.is_cancelled:
                self.post_message(TableMade(block, noted, advised=True))

    def _uncover(self, depth: int) -> None:
        """The screen at a depth of the stack to the front; those over it are closed."""
        for _ in self.screen_stack[depth + 1 :]:
            self.pop_screen()

    def begin(self, session: Session) -> None:
        """Work on another program from now on, or on the same one under another name."""
        same = session.program is self.session.program and session.derived is self.session.derived
        if session.program is not self.session.program:
            self.guided = self._unit_mentioned = self._unit_settled = False
            self.quiet()
        self.session = self.shown = session
        if not same:
            self._derive(Request(session.program))

    def quiet(self) -> None:
        """The prompts again, on every screen."""
        for screen in self._screens():
            screen.quiet()

    def take_typed(self) -> bool:
        """Take what is half-typed on the screen in front; False where it is refused."""
        return not isinstance(self.screen, BaseScreen) or self.screen.take()

    @property
    def proof(self) -> ProofScreen | None:
        """NC PROOF, where it is in front."""
        proofs = self.proofs
        return proofs[-1] if proofs and proofs[-1] is self.screen else None

    @property
    def proofs(self) -> list[ProofScreen]:
        """Every NC PROOF that is open."""
        if "app.nc_proof.screen" not in sys.modules:
            # to ask loads no control and no numpy before the first paint
            return []
        from app.nc_proof.screen import ProofScreen

        return [screen for screen in self.screen_stack if isinstance(screen, ProofScreen)]
