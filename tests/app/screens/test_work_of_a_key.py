"""Costs a key must avoid: a description of the whole program, and another layout of the screen."""

from __future__ import annotations

import pytest
from textual.geometry import Region

from app.widgets.field import NumberField
from core.pipeline.derived import DerivedBlock
from core.program.model import Program
from tests.app.widget_pilot import operator


async def test_no_worker_describes_the_program(monkeypatch: pytest.MonkeyPatch) -> None:
    """Textual describes a worker by all its arguments unless told otherwise: one second for 2,000 segments."""
    described: list[str] = []

    def describe(self: object) -> str:
        described.append(type(self).__name__)
        return ""

    for kind in (Program, DerivedBlock):
        monkeypatch.setattr(kind, "__repr__", describe)
    async with operator() as user:
        await user.press("pagedown", "tab", "'1.5", "enter", "f4", "f8", "f8", "f8")
    assert described == []


async def test_typing_a_digit_causes_no_layout(monkeypatch: pytest.MonkeyPatch) -> None:
    layouts: list[bool] = []
    refresh = NumberField.refresh

    def counted(self: NumberField, *regions: Region, layout: bool = False, **options: bool) -> NumberField:
        layouts.append(layout)
        return refresh(self, *regions, layout=layout, **options)

    async with operator() as user:
        await user.press("pagedown", "tab", "1")
        monkeypatch.setattr(NumberField, "refresh", counted)
        await user.press("2", "3")
    assert layouts
    assert not any(layouts)
