"""An operator on NC PROOF whose questions are answered at once."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from app.documents.nc_text import NcText
from app.documents.programs import empty_program
from app.painted.desk import Desk
from app.painted.screens.proof import ProofPage
from app.painted.session import Session
from core.controls.control_tools import ToolTable
from tests.app.operator import Operator
from tests.tool_tables import end_mills

DATA = Path(__file__).parents[1] / "data" / "nc"
SQUARE = (DATA / "threeblock-square.nc").read_bytes()
CROSSED = SQUARE.replace(b"X-1.Y1.T1M6", b"X-8.Y1.T1M6")
"""The square with a first move longer than itself, which is no over-run: the contour crosses itself."""
CORNER = b"G20 G17 G40 G90 F10\nT1 M6\nG0 X-2 Y-2\nG41 D1 G1 X0 Y-1\nX0 Y2\nX2\nY0\nX-1\nG40 G1 X-2\nM30\n"


class Prover(Operator):
    """An operator whose questions are answered after every key."""

    @staticmethod
    def of(data: bytes, control: str, file: Path | None = None, *, tool: float | None = 0.5) -> Prover:
        page = ProofPage.of(NcText.read(data), file, control=control, alone=True)
        tools = ToolTable() if tool is None else end_mills({1: tool})
        page = replace(page, asked=replace(page.asked, tools=tools))
        desk = replace(Desk(Session.of(empty_program())), pages=(page,))
        return Prover(desk).heard()

    def heard(self) -> Prover:
        while (question := self.desk.page.question) is not None:
            self.desk = self.desk.told(question.answer())
        return self

    def press(self, *keys: str) -> Prover:
        for key in keys:
            super().press(key)
            self.heard()
        return self

    @property
    def page(self) -> ProofPage:
        return next(page for page in self.desk.pages if isinstance(page, ProofPage))

    @property
    def lines(self) -> list[str]:
        return [self.page.listing.text(row) for row in range(len(self.page.listing))]


def square(control: str = "threeblock", file: Path | None = None) -> Prover:
    return Prover.of(SQUARE, control, file)
