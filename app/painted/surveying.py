"""Surveying: what the start screen's files hold is found out behind it, one file after the other."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from app.painted.behind import Behind

if TYPE_CHECKING:
    from app.painted.application import CutcompApp
    from app.painted.survey import Facts


@dataclass(slots=True)
class Surveying:
    """The desk of this work; the pages and what reads the files are imported once the numeric library is there."""

    app: CutcompApp
    reading: Behind[Facts]

    @staticmethod
    def of(app: CutcompApp) -> Surveying:
        """Nothing asked for yet."""
        return Surveying(app, Behind(app, lambda facts: app.surveying.surveyed(facts)))

    def seek(self) -> None:
        """The next file of which nothing is known."""
        if not self.app.engine.ready or self.reading.busy:
            return
        from app.painted.screens.start import StartPage
        from app.painted.survey import facts_of

        page = self.app.desk.page
        if isinstance(page, StartPage) and (path := page.wanted) is not None:
            known = page.facts.get(path)
            self.reading.ask(lambda: facts_of(path, known))

    def surveyed(self, facts: Facts) -> None:
        """What is known of one file; dropped when the start screen is gone."""
        from app.painted.screens.start import StartPage

        desk = self.app.desk
        if isinstance(desk.page, StartPage):
            self.app.desk = replace(desk, pages=(*desk.pages[:-1], desk.page.knowing(facts)))
        self.seek()
        self.app.refresh_screen()
