"""An operator at the screens made of widgets: keys in, fields and sentences out."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any

from textual.pilot import Pilot

from app.app import CutcompApp
from app.documents.files import load
from app.documents.programs import example
from app.screens.base import BaseScreen
from app.session.session import Session
from app.widgets.field import FieldRow
from app.widgets.prompt import Prompt
from app.widgets.status import Surroundings
from core.program.model import Program

SURROUNDINGS = Surroundings(lambda: "12:00", lambda: 23 * 10**9)


class Operator:
    """Presses keys and reads the screen."""

    def __init__(self, app: CutcompApp, pilot: Pilot[int]) -> None:
        self.app, self.pilot = app, pilot

    async def press(self, *keys: str) -> None:
        """Keys one after the other; a text in quotes such as "'1.25" is typed letter by letter."""
        for key in keys:
            await self.pilot.press(*(key[1:] if key.startswith("'") else (key,)))
        await self.settle()

    async def settle(self) -> None:
        """Wait for everything that is worked out in threads."""
        for _ in range(4):
            working = [worker for worker in self.app.workers if worker.group in ("derive", "table")]
            if working:
                await self.app.workers.wait_for_complete(working)
            await self.pilot.pause()

    @property
    def screen(self) -> BaseScreen:
        """The screen in front."""
        assert isinstance(self.app.screen, BaseScreen)
        return self.app.screen

    @property
    def session(self) -> Session:
        """The session."""
        return self.app.session

    @property
    def prompt(self) -> str:
        """The sentence on the prompt line."""
        return self.screen.query_exactly_one(Prompt).sentence.text

    @property
    def at(self) -> str:
        """The name of the field with the cursor."""
        return "" if self.app.focused is None else self.app.focused.name or ""

    def row(self, name: str) -> FieldRow:
        """The row of a field that is displayed."""
        rows = [row for row in self.screen.query(FieldRow) if row.cell.name == name and row.parent.parent.display]
        assert len(rows) == 1, (name, rows)
        return rows[0]

    def value(self, name: str) -> str:
        """What a field shows."""
        widget: Any = self.row(name).input
        return self.row(name).cell.text if widget is None else str(widget.value)

    def tag(self, name: str) -> str:
        """The tag of a field."""
        return self.row(name).cell.tag


@asynccontextmanager
async def operator(start: str | Program = "pocket", size: tuple[int, int] = (80, 24)) -> AsyncIterator[Operator]:
    """An operator with an example or a program in front of him."""
    session = Session.of(load(example(start)), title=start) if isinstance(start, str) else Session.of(start)
    app = CutcompApp(session, surroundings=SURROUNDINGS)
    async with app.run_test(size=size) as pilot:
        one = Operator(app, pilot)
        await one.settle()
        yield one
