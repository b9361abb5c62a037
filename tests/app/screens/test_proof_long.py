"""NC PROOF on programs of very many lines."""

from __future__ import annotations

from dataclasses import replace

from app.documents.nc_text import NcText
from app.documents.programs import empty_program
from app.painted.desk import Desk
from app.painted.screens.proof import ProofPage
from app.painted.session import Session
from tests.app.operator import Operator
from tests.app.prover import SQUARE
from tests.tool_tables import end_mills


def test_a_long_program_is_run_first_and_judged_then() -> None:
    page = ProofPage.of(NcText.read(SQUARE + b"(x)\n" * 2100), control="threeblock")
    page = replace(page, asked=replace(page.asked, tools=end_mills({1: 0.5})))
    first = page.hearing(page.asked.answer())
    assert isinstance(first, ProofPage)
    assert first.told.proof.run.stretches
    assert not first.told.proof.results
    desk = replace(Desk(Session.of(empty_program())), pages=(first,))
    assert "not known yet: being judged" in "\n".join(Operator(desk).screen())
    rest = first.question
    assert rest is first.told.rest is not None
    second = first.hearing(rest.answer())
    assert isinstance(second, ProofPage)
    assert second.question is None
    assert second.told.answer.outcome.startswith("gouges by 0.0075")
    assert not first.told.answer.outcome.startswith("gouges")


def test_a_long_program_is_walked_through_quickly() -> None:
    text = b"G20 G90 G1 F5\n" + b"".join(b"X%d Y%d\n" % (index, index % 7) for index in range(100_000))
    page = ProofPage.of(NcText.read(text), control="linuxcnc")
    desk = replace(Desk(Session.of(empty_program())), pages=(page,))
    for key in ("pagedown", "end", "up", "home"):
        desk = desk.press(key)
        assert len(Operator(desk).screen()) == 24
    assert not page.asked.small
