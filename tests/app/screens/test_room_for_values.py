"""Every choice and the START of a segment are fully readable in their fields at 80x24."""

from __future__ import annotations

import pytest
from textual.widgets import Label

from app.screens.tools import ToolsScreen
from app.widgets.field import ChoiceField, FieldRow, NumberField, State
from tests.app.widget_pilot import Operator
from tests.core.program.run_files import program_of
from tests.core.program.test_calculated_runs import case_of, line

pytestmark = pytest.mark.asyncio(loop_scope="module")

ARROW = 2
"""Columns reserved for the arrow of a choice."""


async def test_every_choice_fits_into_its_field(user: Operator):
    for keys in ([], ["'1", "enter"], ["'2", "enter"], ["f4"], ["f8", "f6"]):
        await user.press(*keys)
        fields = [field for field in user.screen.query(ChoiceField) if field.region.width]
        assert fields, keys
        for field in fields:
            room = field.size.width - ARROW
            assert not [choice for choice in field.choices if len(choice) > room], field.name


async def test_every_number_has_room_for_the_mark_of_unreadable_text(user: Operator):
    for keys in ([], ["'1", "enter"], ["'2", "enter"], ["f4"], ["escape", "f5"]):
        await user.press(*keys)
        rows = [row for row in user.screen.query(FieldRow) if row.region.width and isinstance(row.input, NumberField)]
        assert rows, keys
        for row in rows:
            row.set_class(True, State.UNREAD)
        await user.settle()
        for row in rows:
            assert len(f"{row.cell.label} ERR") <= row.children[0].size.width, row.cell.label


async def test_the_start_of_a_segment_fits_beside_its_label(user: Operator):
    for x, y in ((100.0, 60.0), (-1234.5, -1234.25)):
        await user.begin(program_of(case_of(line(x_end=x, y_end=y), line(x_end=0, y_end=0))), 2)
        value = user.row("START").query_one(".value", Label)
        assert str(value.content) == f"{x:.3f} {y:.3f})"
        assert len(str(value.content)) <= value.size.width


async def test_a_number_that_does_not_fit_is_never_shown_as_another(user: Operator):
    await user.begin("plate-mm")
    await user.press("f6")
    for name, text in (("speed", "20000"), ("feed", "12000.0"), ("plunge_feed", "12000.0")):
        [field, *_] = [
            candidate for candidate in user.screen.query(NumberField) if (candidate.name or "").startswith(f"{name}@")
        ]
        assert len(text) <= field.content_size.width, name
    assert isinstance(user.screen, ToolsScreen)
    for typed, shown in {"2500": "2500.000", "25000": "25000.0>", "16": "16.000"}.items():
        user.screen.focus_field("diameter@0")
        await user.press(f"'{typed}", "enter")
        [field] = [candidate for candidate in user.screen.query(NumberField) if candidate.name == "diameter@0"]
        assert field.render_line(0).text.strip() == shown
