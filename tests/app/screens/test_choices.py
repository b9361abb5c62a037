"""Every choice can be read whole in its field at 80x24."""

from __future__ import annotations

import pytest

from app.widgets.field import ChoiceField
from tests.app.widget_pilot import operator

ARROW = 2
"""Columns that a choice leaves to its arrow."""


@pytest.mark.parametrize("keys", [[], ["'1", "enter"], ["'2", "enter"], ["f4"], ["f6"]])
async def test_every_choice_fits_into_its_field(keys: list[str]):
    async with operator() as one:
        await one.press(*keys)
        fields = [field for field in one.screen.query(ChoiceField) if field.region.width]
        assert fields
        for field in fields:
            room = field.size.width - ARROW
            assert not [choice for choice in field.choices if len(choice) > room], field.name
