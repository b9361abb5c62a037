"""Prompts fit the two lines that they have on the narrowest screen."""

from __future__ import annotations

from textwrap import wrap

import pytest

from app.nc_proof.screen import EDITING_PROMPT, READING_PROMPT
from app.screens import draw, home
from app.screens.field_texts import prompt_of
from core.program.fields import FIELDS_OF_FORM, LOOKAHEAD_PROMPT, SHORT_LOOKAHEAD_PROMPT, Field
from tests.app.widget_pilot import operator

ROOM = 58
"""Cells of a line of the prompt at 60 columns."""
FIELDS = {field.name: field for fields in FIELDS_OF_FORM.values() for field in fields}


def lines(prompt: str) -> int:
    return len(wrap(prompt, ROOM))


@pytest.mark.parametrize("field", FIELDS.values(), ids=FIELDS)
def test_the_prompt_of_a_field_fits(field: Field) -> None:
    assert lines(prompt_of(field, narrow=True)) <= 2
    assert len(wrap(prompt_of(field), ROOM + 20)) <= 2


@pytest.mark.parametrize("prompt", [draw.PROMPT, home.PROMPT, READING_PROMPT, EDITING_PROMPT])
def test_the_prompt_of_a_screen_fits(prompt: str) -> None:
    assert lines(prompt) <= 2


async def test_the_look_ahead_has_a_short_prompt_at_60_columns_and_the_control_s_own_at_80() -> None:
    async with operator("pocket", (60, 20)) as user:
        await user.begin("pocket", 0, "lookahead")
        assert user.prompt == SHORT_LOOKAHEAD_PROMPT
        await user.pilot.resize_terminal(80, 24)
        await user.settle()
        assert user.prompt == LOOKAHEAD_PROMPT
