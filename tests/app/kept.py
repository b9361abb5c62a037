"""An operator whose work is kept, and who may die at any moment."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from app.documents.lock import Owner, myself
from app.documents.programs import empty_program
from app.painted.desk import Desk
from app.painted.keeping import Keeping
from app.painted.opened import opened
from app.painted.screens.decide import Decide
from app.painted.session import Session
from core.pipeline.outline import outline
from tests.app.operator import Operator

TIME = "2025-03-04T06:05:00+01:00"
DEAD = Owner("ann", myself("").host, 2**22 + 17, "", "2025-03-04T06:00:00+01:00")
"""A process of this host that is dead whenever somebody looks."""
ELSEWHERE = Owner("bob", "office", 7, "", "2025-03-04T05:00:00+01:00")
"""A process of another host, which may always be alive."""


@dataclass
class Kept(Operator):
    """`keeping` is asked after every key, as the App does it."""

    keeping: Keeping

    def press(self, *keys: str) -> Kept:
        for key in keys:
            super().press(key)
            self.desk = self.keeping.keep(self.desk)
            if self.session.stale:
                self.desk = self.desk.knowing(outline(self.session.program))
        return self

    def type(self, *texts: str) -> Kept:
        for text in texts:
            self.press(*text, "enter")
        return self

    def killed(self) -> None:
        """kill -9: nothing is done any more; only the handle is closed, so that tests can have many."""
        if self.keeping.journal is not None:
            self.keeping.journal.close()


def started(own: Path, file: Path | None = None, me: Owner = DEAD, clock: str = TIME) -> Kept:
    """The program started on a file, or on none; `own` is the person's folder."""
    session = opened(file) if file is not None and file.exists() else Session.of(empty_program(), file)
    keeping = Keeping(me, own, lambda: clock)
    return Kept(keeping.keep(Desk(session)), keeping)


def names(path: Path) -> list[str]:
    """What lies beside a program."""
    return sorted(one.name for one in path.parent.iterdir() if one != path)


def asked(operator: Kept) -> str:
    """The words of the question that stands on the screen."""
    assert isinstance(operator.desk.page, Decide)
    return " ".join(operator.part("body").split())
