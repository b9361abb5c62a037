"""What a key must not cost: neither a description of the whole program nor another layout of the screen."""

from __future__ import annotations

import pytest
from textual.geometry import Region

from app.widgets.field import NumberField
from core.pipeline.derived import DerivedBlock
from core.program.model import Program
from tests.app.widget_pilot import operator


async def test_no_worker_writes_the_program_down(monkeypatch: pytest.MonkeyPatch) -> None:
    """A worker without a description gets one of all its arguments: a second for 2,000 segments."""
    written: list[str] = []

    def written_down(self: object) -> str:
        written.append(type(self).__name__)
        return ""

    for kind in (Program, DerivedBlock):
        monkeypatch.setattr(kind, "__repr__", written_down)
    async with operator() as user:
        await user.press("pagedown", "tab", "'1.5", "enter", "f4", "f8", "f8", "f8")
    assert written == []


async def test_a_digit_lays_out_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[bool] = []
    refresh = NumberField.refresh

    def counted(self: NumberField, *regions: Region, layout: bool = False, **options: bool) -> NumberField:
        asked.append(layout)
        return refresh(self, *regions, layout=layout, **options)

    async with operator() as user:
        await user.press("pagedown", "tab", "1")
        monkeypatch.setattr(NumberField, "refresh", counted)
        await user.press("2", "3")
    assert asked
    assert not any(asked)
