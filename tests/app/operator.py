"""An operator at the desk: presses keys and reads the screen, without a terminal."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from textual.keys import _character_to_key

from app.documents.programs import empty_program
from app.painted.desk import Desk
from app.painted.engine import Known
from app.painted.screens.draw import DrawPage
from app.painted.screens.frame import parts, picture
from app.painted.screens.page import Sketch
from app.painted.session import Session
from app.painted.surroundings import Surroundings
from app.painted.widgets.rows import text_of
from core.pipeline.outline import outline
from core.program.model import Block, Program, Segment

FROZEN = Surroundings(clock=lambda: "16:51", free=lambda: 16034847)


@dataclass
class Operator:
    """One desk; after every key what follows from the program is calculated, without geometry."""

    desk: Desk

    @staticmethod
    def at(program: Program | None = None) -> Operator:
        """An operator who has just started the program on this."""
        return Operator(Desk(Session.of(program or empty_program())))

    def press(self, *keys: str) -> Operator:
        """Keys by name, or single characters."""
        for key in keys:
            character = key if len(key) == 1 else " " if key == "space" else None
            name = _character_to_key(key) if len(key) == 1 else key
            self.desk = self.desk.press(name, character)
            if self.session.stale:
                self.desk = self.desk.knowing(outline(self.session.program))
        return self

    def type(self, *texts: str) -> Operator:
        """Texts, each followed by Enter."""
        for text in texts:
            self.press(*text, "enter")
        return self

    @property
    def session(self) -> Session:
        return self.desk.session

    @property
    def block(self) -> Block:
        return self.session.block

    @property
    def segments(self) -> tuple[Segment, ...]:
        return self.session.block.segments

    @property
    def said(self) -> str:
        """The sentence on the prompt line."""
        return " ".join(self.part("prompt").split())

    def typed(self, name: str) -> list[Any]:
        """What was typed into a field of every segment that has it."""
        return [getattr(segment, name) for segment in self.segments if hasattr(segment, name)]

    @property
    def sketch(self) -> Sketch:
        """The window of the DRAW screen."""
        assert isinstance(self.desk.page, DrawPage)
        return self.desk.page.sketch

    def screen(self, width: int = 80, height: int = 24) -> list[str]:
        """Everything on a terminal of this size, but for the drawing, line by line."""
        return [text_of(row) for row in picture(self.desk, Known(), FROZEN, width, height)]

    def part(self, name: str, width: int = 80, height: int = 24) -> str:
        """The text of one part of the screen."""
        part = parts(self.desk, Known(), FROZEN, width, height)[name]
        return "\n".join(text_of(row).rstrip() for row in part.rows)

    def saved(self) -> Operator:
        """The same operator, the program being as its file has it."""
        self.desk = replace(self.desk, session=replace(self.session, saved=self.session.program))
        return self
