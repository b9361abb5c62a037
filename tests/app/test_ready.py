"""READY on POST and on the setup sheet is followed by the segments that the look-ahead deletes, if any."""

from __future__ import annotations

from dataclasses import replace

import pytest
from textual.widgets import Static

from app.documents.files import load
from app.documents.programs import example
from core.program.model import Number, PathChoice, Program
from tests.app.widget_pilot import Operator

pytestmark = pytest.mark.asyncio(loop_scope="module")

READY_ALONE = "READY to post.\n"
READY_BUT = "READY to post. Know before you run it:"


def program(name: str, lookahead: int, path: PathChoice = PathChoice.CONTROL) -> Program:
    """An example with a look-ahead and a path."""
    example_program = load(example(name))
    blocks = tuple(replace(block, lookahead=Number(float(lookahead))) for block in example_program.blocks)
    return replace(example_program, blocks=blocks, parameters=replace(example_program.parameters, path=path))


async def text_of(user: Operator, widget: str) -> str:
    """The text of a widget once all calculations are done."""
    await user.finish()
    return str(user.screen.query_one(widget, Static).content)


@pytest.mark.parametrize(
    ("name", "lookahead", "path", "deleted"),
    [
        ("pocket", 8, PathChoice.CONTROL, "9"),
        ("notch", 3, PathChoice.CONTROL, "2-4"),
        ("pocket", 8, PathChoice.BEST, ""),
        ("flange", 2, PathChoice.CONTROL, ""),
    ],
)
async def test_ready_names_the_segments_that_the_look_ahead_deletes(
    user: Operator, name: str, lookahead: int, path: PathChoice, deleted: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    # without the search for advice, which takes time
    monkeypatch.setattr("app.derivation_actions.ADVICE_DELAY", 1000.0)
    await user.begin(program(name, lookahead, path))
    user.app.action_post()
    await user.settle()
    findings = await text_of(user, "#post-findings")
    assert "Ready to post." in findings
    assert [line[line.index("DELETED") :] for line in findings.splitlines() if "DELETED" in line] == (
        [f"DELETED block 1 segments {deleted}"] if deleted else []
    )
    await user.press("f8")
    user.app.action_sheet()
    await user.settle()
    sheet = await text_of(user, "#sheet-text")
    numbers = {"9": "SEGMENT 9", "2-4": "SEGMENTS 2, 3, 4"}
    top = [line for line in sheet.split("TOOLS")[0].splitlines() if "DELETED" in line]
    assert top == ([f"  ! Block 1: DELETED BY THE LOOK-AHEAD: {numbers[deleted]}"] if deleted else [])
    assert READY_BUT in sheet or (READY_ALONE in sheet and not deleted)
