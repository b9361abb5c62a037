"""Advice: what is said beside a path and its verdict, after them and never late for a key.

The look-ahead table comes with the path where it takes less than another picture.  What a better path would cut and
what the contour needs take longer: they follow in threads, and where they have nothing to say the screen stays as it
is.  Both are told of what has been accepted alone: of a half-typed number they are found out once no key has come for a
while, so that Enter has them.
"""

from __future__ import annotations

from dataclasses import dataclass
from time import perf_counter, sleep
from typing import TYPE_CHECKING, Final

from app.painted.behind import Behind

if TYPE_CHECKING:
    from asyncio import TimerHandle

    from app.painted.application import CutcompApp
    from core.advice.block_paths import BlockPaths
    from core.pipeline.derived import DerivedBlock
    from core.program.model import Program

QUIET: Final = 0.05
"""Seconds without a key behind which a half-typed number is advised on: that takes longer than a picture."""
AT_ONCE: Final = 0.05
"""The part of the engine's limit for which a path waits for its table: a picture of their own takes no less."""
ONE_PICTURE: Final = 0.5
"""The part of it in which path and table come together: what was measured may have been a smaller contour's."""
SMALL: Final = 0.25
"""The part of it in which a small contour's notes come with them."""

About = tuple["BlockPaths | None", int]
"""The paths and the calculated look-ahead that needs are about."""


@dataclass(slots=True)
class Advice:
    """The desks of the table, the notes and the needs of the block that is shown."""

    app: CutcompApp
    tabling: Behind[None]
    noting: Behind[None]
    needing: Behind[None]
    resting: TimerHandle | None = None
    about: About | None = None
    """What the needs of the block that is shown are about."""

    @staticmethod
    def of(app: CutcompApp) -> Advice:
        """Nothing asked for yet."""

        def followed(_: None) -> None:
            # what is known by now is shown before what else there is to find out is begun
            app.refresh_screen()
            notes = app.engine.notes
            app.advice.seek()
            if app.engine.notes is not notes:
                app.refresh_screen()

        return Advice(app, Behind(app, followed), Behind(app, followed), Behind(app, followed))

    @property
    def behind(self) -> tuple[Behind[None], ...]:
        """Its desks."""
        return self.tabling, self.noting, self.needing

    def seek(self) -> None:
        """Whatever is not known yet of the block that is shown."""
        if self.resting is not None:
            self.resting.cancel()
        self.noting.forget()
        self.needing.forget()
        self.about = about_of(self.app.shown.found)
        self._tabulate()
        if self.app.trial is None:
            self._advise()
        elif self.app.return_code is None and self._lacks:
            self.resting = self.app.after(QUIET, self._rested)

    @property
    def _lacks(self) -> bool:
        """Whether there is anything to find out about the block that is shown, now that its table is there."""
        engine, found = self.app.engine, self.app.shown.found
        return engine.lacks_notes(found) or engine.lacks_needs(found)

    def _rested(self) -> None:
        """No key has come for a while.  A half-typed number may lead to the path in force: then all of it is shown."""
        notes = self.app.engine.notes
        self._advise()
        if self.app.engine.notes is not notes:
            self.app.refresh_screen()

    def _advise(self) -> None:
        """What a better path would cut, and what the contour needs."""
        self._note()
        self._need()

    def _tabulate(self) -> None:
        """The look-ahead table, kept until the block changes."""
        engine, found, program = self.app.engine, self.app.shown.found, self.app.shown.program
        if engine.tabulated(found):
            self.tabling.forget()
        elif self._at_once:
            engine.keep_table(found, program)
        elif self.tabling.doing is not found.paths:
            told = self.app.trial is None
            self.tabling.ask(lambda: self._keep(found, program, told=told), found.paths)

    @property
    def _at_once(self) -> bool:
        """Whether the table takes no longer than a picture: the last one did not, and its paths came as fast."""
        engine = self.app.engine
        return engine.small("table", AT_ONCE) and engine.fast("derive", "table", part=ONE_PICTURE)

    def _keep(self, found: DerivedBlock, program: Program, *, told: bool) -> None:
        """The table, and small notes with it where they are told: a picture for each of the two takes longer."""
        engine = self.app.engine
        engine.keep_table(found, program)
        if told and engine.small("notes", SMALL) and engine.fast("notes", part=SMALL):
            engine.keep_notes(found)

    def _note(self) -> None:
        """What a better path would cut: at once or with the table where that is small, else behind it."""
        engine, found = self.app.engine, self.app.shown.found
        if not engine.lacks_notes(found):
            return
        if engine.fast("derive", "table", "notes", part=SMALL):
            engine.keep_notes(found)
        elif found.paths not in (self.noting.doing, self.tabling.doing):
            self.noting.ask(lambda: engine.keep_notes(found), found.paths)

    def _need(self) -> None:
        """What the contour needs where CAL is not clean: why, and what would help, tried one after the other."""
        engine, found, program = self.app.engine, self.app.shown.found, self.app.shown.program
        if self.app.return_code is not None or not engine.lacks_needs(found):
            return
        about, since = about_of(found), self.app.touched
        if self.needing.doing != about:
            self.needing.ask(lambda: engine.keep_needs(found, program, lambda: self._wanted(about, since)), about)

    def _wanted(self, about: About, since: float) -> bool:
        """Asked by the thread between two tries: it waits while keys come, and ends when another path is shown.

        The desk is not looked at from there: a key may just have given it a block of which nothing is derived yet.
        """
        while self.app.touched != since and (left := self.app.touched + QUIET - perf_counter()) > 0:
            sleep(left)
        return self.app.return_code is None and self.about == about


def about_of(found: DerivedBlock) -> About:
    """What tells the needs of one block from those of another."""
    return found.paths, found.lookahead.calculated
