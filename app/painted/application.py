"""The App: owns the one desk, hands keys to it, and has it painted."""

from __future__ import annotations

import gc
import sys
from asyncio import TimerHandle, get_running_loop
from collections.abc import Callable
from time import perf_counter
from typing import Any, ClassVar, Final

from textual import events
from textual.app import App

from app.painted.advice import Advice
from app.painted.behind import Behind, raised
from app.painted.desk import Desk
from app.painted.engine import Engine, bearing
from app.painted.screens.frame import Frame, heard, picture
from app.painted.screens.page import Question
from app.painted.session import Session
from app.painted.surroundings import Surroundings, real
from app.painted.surveying import Surveying
from app.painted.widgets.rows import Row
from core.pipeline.derived import Derived
from core.pipeline.outline import outline

MINUTE: Final = 60.0
SECOND: Final = 1.0
"""Clock and free memory are asked for no more often: to read them takes a hundredth of a key."""
ARMED_FOR: Final = 2.0
"""Seconds in which a digit behind a lone Esc is a softkey; slow links part the two by some 0.3."""
FRAME: Final = 1 / 60
"""Seconds in which nobody sees more than one picture."""
TURN: Final = 0.001
"""Seconds that a thread goes on calculating while a key or a picture on its way out waits for its turn: they are handed
from thread to thread three times, and Python's own five milliseconds each are a picture late."""
AGAIN: Final = "ctrl+l"
"""The key that paints everything again, as in every program of a terminal."""


class CutcompApp(App[int], inherit_bindings=False, inherit_css=False):
    """The screens.  The only place where the session changes hands.

    `keep` puts on the disk what a key has changed, before the next key is read.
    """

    CSS_PATH = "app.tcss"
    TITLE = "cutcomp"
    ENABLE_COMMAND_PALETTE = False
    BINDINGS: ClassVar = []

    def __init__(
        self,
        session: Session,
        around: Surroundings | None = None,
        engine: Engine | None = None,
        keep: Callable[[Desk], Desk] = lambda desk: desk,
        *,
        few_colors: bool | None = None,
    ) -> None:
        # known before anything is built: the filter that takes all colors away depends on it
        super().__init__(ansi_color=few_colors)
        self.keep = keep
        self.desk = keep(Desk(session))
        self.trial: Session | None = None
        self.around = around or real()
        self.engine = engine or Engine()
        self.advice, self.surveying = Advice.of(self), Surveying.of(self)
        # when the last key came and when one asked for the surroundings, and these as they are told
        self.touched, self.asked, self.then = 0.0, 0.0, self.around.now()
        self._loading = Behind(self, self._loaded)
        self._deriving = Behind(self, self._derived)
        self._trying = Behind(self, self._tried)
        self._asking: Behind[object] = Behind(self, self._answered)
        self._asked: Question | None = None
        self._arming: TimerHandle | None = None
        self._late = False
        self._painted = 0.0

    @property
    def behind(self) -> tuple[Behind[Any], ...]:
        """The desks of all that is calculated in threads."""
        own = (self._loading, self._deriving, self._trying, self._asking)
        return (*own, self.surveying.reading, *self.advice.behind)

    @property
    def shown(self) -> Session:
        """The session as the screens show it: with a half-typed number tried out, if there is one."""
        return self.trial or self.desk.session

    def get_default_screen(self) -> Frame:
        """The frame."""
        return Frame()

    def on_ready(self) -> None:
        """Once the first screen stands, fetch what it did not need."""
        # what came with the imports stays: the collector need not look through it ever again
        gc.freeze()
        gc.enable()
        sys.setswitchinterval(TURN)
        self.set_interval(MINUTE, self._tick)
        self.desk = self.keep(self.desk)
        program = self.desk.session.program
        self._loading.ask(lambda: self.engine.load(program))

    async def on_event(self, event: events.Event) -> None:
        """Keys and pasted text go to the desk as they come: in the screen's queue they would wait for another turn."""
        if isinstance(event, events.Key):
            self.key(event.key, event.character)
        elif isinstance(event, events.Paste):
            self.paste(event.text)
        else:
            await super().on_event(event)

    def key(self, key: str, character: str | None) -> None:
        """A key was pressed."""
        self._touch()
        if key == AGAIN:
            self.paint_again()
        elif self._heard(key):
            self.desk = self.keep(self.desk.press(key, character))
            self._wait_for_digit()
            self._advance()

    def paste(self, text: str) -> None:
        """Text was pasted."""
        self._touch()
        if self._heard(""):
            self.desk = self.keep(self.desk.paste(text))
            self._advance()

    def _heard(self, key: str) -> bool:
        """Whether a key, or pasted text as an empty one, may do anything: behind the key that leaves none does."""
        return not self.desk.exit and heard(self.desk, key, *self.size)

    def _touch(self) -> None:
        now = perf_counter()
        if now - self.asked >= SECOND:
            self.asked, self.then = now, self.around.now()
        self.touched = now

    def _tick(self) -> None:
        """The clock goes on."""
        self.then = self.around.now()
        self.refresh_screen()

    def _wait_for_digit(self) -> None:
        """Behind a lone Esc, so long and no longer."""
        if self._arming is not None:
            self._arming.cancel()
        self._arming = self.after(ARMED_FOR, self._disarm) if self.desk.armed else None

    def after(self, seconds: float, call: Callable[[], None]) -> TimerHandle:
        """Have this called once; one of Textual's timers is a task, which takes ten times as long with every key."""

        def called() -> None:
            try:
                call()
            except Exception as error:  # noqa: BLE001  # raised again in the App
                self.call_later(raised, error)

        return get_running_loop().call_later(seconds, called)

    def _disarm(self) -> None:
        self.desk = self.desk.disarmed()
        self.refresh_screen()

    def paint_again(self) -> None:
        """All of the terminal, whatever others have written on it."""
        from app.terminal.driver import TerminalDriver

        if isinstance(self._driver, TerminalDriver):
            self._driver.anew()
        else:
            self.refresh()

    def refresh_screen(self, width: int = 0, height: int = 0) -> None:
        """Paint what changed, on a terminal of this size if one is given; too late there is no screen any more."""
        frame = self.screen if self.screen_stack else None
        if isinstance(frame, Frame) and frame.is_mounted:
            frame.show(self.picture(width or self.size.width, height or self.size.height))

    def picture(self, width: int, height: int) -> tuple[Row, ...]:
        """The terminal as it is now."""
        known = self.engine.known(self.shown.found, self.trial, self.desk.session.found)
        return picture(self.desk, known, self.then, width, height)

    def _advance(self) -> None:
        """After every change of the desk: derive what is stale, paint, or leave."""
        if self.desk.exit:
            self.exit(0)
            return
        self._derive()
        if self._hurried():
            self.trial = None
            if not self._late:
                self._late = True
                self.call_later(self._caught_up)
            return
        self._proceed()

    def _hurried(self) -> bool:
        """Whether the next key waits already, and what was painted last has hardly been seen.

        Keys that come at once, pasted or over a link that held them back, are painted together: a slow link would
        carry every screen between them.
        """
        waiting = any(one.message_queue_size for one in (self, *self.screen_stack[-1:]))
        return waiting and perf_counter() - self._painted < FRAME

    def _caught_up(self) -> None:
        """Behind the keys that waited."""
        if self._late and not self.desk.exit:
            self._proceed()

    def _proceed(self) -> None:
        """What follows from the program as it is, and its picture."""
        self._late = False
        self._try()
        self.advice.seek()
        self.surveying.seek()
        self._ask()
        self.refresh_screen()
        self._painted = perf_counter()

    def _loaded(self, derived: Derived) -> None:
        # the numeric library stays as well
        gc.freeze()
        self.engine.ready = True
        self._derived(derived)
        self._advance()

    def _derive(self) -> None:
        """Everything that follows from the program: now while it is fast, else in a thread."""
        session = self.desk.session
        self._deriving.forget()
        if not session.stale and all(found.known for found in session.derived.blocks):
            return
        program, before = session.program, session.derived
        if (held := self.engine.held(program)) is not None:
            self.desk = self.desk.knowing(held)
            return
        if self.engine.fast("derive"):
            self.desk = self.desk.knowing(self.engine.derive(program, before))
            return
        if session.stale:
            self.desk = self.desk.knowing(outline(program))
        # what is on its way already, of the program or of the number just accepted, is not begun again
        if self.engine.ready and program not in (self._deriving.doing, self._trying.doing):
            self._deriving.ask(lambda: self.engine.derive(program, before), program)

    def _derived(self, derived: Derived) -> None:
        """A result from a thread; one for another program than that of now is dropped."""
        program = self.desk.session.program
        self.desk = self.desk.knowing(bearing(derived, program) if derived.program == program else derived)
        self.advice.seek()
        self.refresh_screen()

    def _try(self) -> None:
        """While a number is being typed, what it would do: with every key, or as soon as it is calculated."""
        session = self.desk.session
        program = self.desk.page.preview(session)
        self.trial = None
        self._trying.forget()
        if program is None or not self.engine.ready:
            return
        before = session.derived
        if (held := self.engine.held(program)) is not None:
            self.trial = session.trying(held)
        elif self.engine.fast("derive"):
            self.trial = session.trying(self.engine.derive(program, before))
        elif self._trying.doing != program:
            self._trying.ask(lambda: self.engine.derive(program, before), program)

    def _tried(self, derived: Derived) -> None:
        """A late trial is shown while the same number still stands in the field; by now it may have been accepted."""
        if derived.program == self.desk.session.program:
            self._derived(derived)
        if self.desk.page.preview(self.desk.session) == derived.program:
            self.trial = self.desk.session.trying(derived)
            self.advice.seek()
            self.refresh_screen()

    def _ask(self) -> None:
        """What the page that is seen wants calculated: now while that is fast, else in a thread."""
        question = self.desk.page.question
        if question is None or question is self._asked or not self.engine.ready:
            return
        self._asked = question
        if question.small and self.engine.fast("ask"):
            self.desk = self.desk.told(self.engine.timed("ask", question.answer))
        else:
            self._asking.ask(lambda: self.engine.timed("ask", question.answer))

    def _answered(self, answer: object) -> None:
        """An answer from a thread; pages that ask something else by now drop it."""
        self.desk = self.desk.told(answer)
        self.refresh_screen()
