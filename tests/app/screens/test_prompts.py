"""Prompts fit the two lines that they have on the narrowest screen."""

from __future__ import annotations

from textwrap import wrap

import pytest

from app.nc_proof.screen import EDITING_PROMPT, READING_PROMPT
from app.screens import draw, home
from app.screens.field_texts import prompt_of
from core.program.fields import FIELDS_OF_FORM, LOOKAHEAD_PROMPT, Field

ROOM = 58
"""Cells of a line of the prompt at 60 columns."""
FIELDS = {field.name: field for fields in FIELDS_OF_FORM.values() for field in fields}


def lines(prompt: str) -> int:
    return len(wrap(prompt, ROOM))


@pytest.mark.parametrize("field", FIELDS.values(), ids=FIELDS)
def test_the_prompt_of_a_field_fits(field: Field) -> None:
    # the sentence of the control itself stays word for word; what is cut off after it stands in HELP
    prompt = prompt_of(field)
    assert lines(prompt) <= 2 or prompt.startswith(LOOKAHEAD_PROMPT)


@pytest.mark.parametrize("prompt", [draw.PROMPT, home.PROMPT, READING_PROMPT, EDITING_PROMPT])
def test_the_prompt_of_a_screen_fits(prompt: str) -> None:
    assert lines(prompt) <= 2
