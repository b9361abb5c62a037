"""Esc on a field, and Esc as the prefix of a digit: what is typed behind it is never swallowed."""

from __future__ import annotations

import asyncio

import pytest
from textual.pilot import Pilot

from app.painted.desk import ARMED
from app.painted.screens.parameters import ParametersPage
from app.painted.screens.tools import ToolsPage
from core.program.model import Number, Unread
from tests.app.operator import Operator
from tests.app.pilots import app_on, loaded
from tests.app.squares import square

X_START = ("tab", "tab", "tab", "tab")


def test_esc_on_a_field_marked_err_brings_back_what_stood_there_and_the_next_number_is_taken_whole() -> None:
    operator = square().press(*X_START).type("1o")
    operator.press("escape")
    assert operator.block.x_start == Number(-1.0)
    assert operator.said == "X START: 1o is taken back, -1 stands again."
    assert not operator.desk.armed
    assert operator.type("2.5").block.x_start == Number(2.5)


def test_esc_on_a_field_marked_err_goes_back_over_every_text_that_could_not_be_read_and_over_other_fields() -> None:
    operator = square().press(*X_START).type("0.123456789012345").press("up").type("1o").press("tab", "tab").type("7")
    operator.press("up", "up", "up").type("2o").press("escape")
    assert operator.block.x_start == Number(0.123456789012345)
    assert operator.block.z_start == Number(7.0)
    held = operator.press("ctrl+z").block.x_start
    assert isinstance(held, Unread)
    assert held.text == "2o"


def test_a_field_that_was_blank_is_blank_again() -> None:
    operator = Operator.at().press("enter", "tab", "tab", "tab").type("1o").press("escape")
    assert operator.block.x_start is None
    assert operator.said == "X START: 1o is taken back, the field is blank."


@pytest.mark.parametrize("between", [("ctrl+home", "right", "f1"), ("f4", "right", "c", "escape")])
def test_behind_an_edit_that_makes_the_field_another_one_it_is_blank(between: tuple[str, ...]) -> None:
    operator = square().press("3", "enter", "tab").type("1o")
    operator.press(*between)
    names = [segment.x_end for segment in operator.segments if hasattr(segment, "x_end")]
    number = next(index for index, held in enumerate(names, 1) if isinstance(held, Unread))
    operator.press("ctrl+home", *str(number), "enter", "tab", "escape")
    assert operator.typed("x_end")[number - 1] is None


def test_on_the_other_forms_esc_takes_back_first_and_leaves_then() -> None:
    operator = Operator.at().press("f4", "tab").type("x")
    assert isinstance(operator.desk.page, ParametersPage)
    operator.press("escape")
    assert isinstance(operator.desk.page, ParametersPage)
    assert "is taken back" in operator.said
    assert not isinstance(operator.press("escape").desk.page, ParametersPage)
    operator = Operator.at().press("f6", "f2").type("0.5").press("shift+tab").type("x").press("escape")
    assert isinstance(operator.desk.page, ToolsPage)
    assert operator.session.program.tools[0].diameter == Number(0.5)


def test_a_digit_without_a_softkey_is_typed() -> None:
    operator = square().press(*X_START, "escape")
    assert operator.said == ARMED
    assert operator.type("21.5").block.x_start == Number(21.5)
    assert operator.press("up", "ctrl+k").type("2.5").block.x_start == Number(2.5)


def test_a_softkey_without_a_label_does_not_take_the_digit() -> None:
    operator = square().press(*X_START, "escape")
    assert operator.type("3.5").block.x_start == Number(3.5)


@pytest.mark.parametrize("prefix", ["escape", "ctrl+k"])
def test_esc_again_ends_the_prefix(prefix: str) -> None:
    operator = square().press("1", "enter", prefix)
    assert operator.said == ARMED
    operator.press("escape")
    assert operator.said != ARMED
    operator.press("1")
    assert len(operator.segments) == 4


def test_the_prefix_ends_by_itself_and_takes_only_its_own_words_along() -> None:
    operator = square().press("3", "enter", "9", "escape", "escape")
    assert operator.desk.armed
    operator.desk = operator.desk.disarmed()
    assert operator.said != ARMED
    operator.press("1")
    assert len(operator.segments) == 4
    told = square().press("1", "enter", "f1").desk
    assert told.disarmed() is told


def test_pasted_digits_are_no_softkeys() -> None:
    operator = square().press("1", "enter", "escape")
    operator.desk = operator.desk.paste("1")
    assert len(operator.segments) == 4


def test_esc_and_a_digit_at_once_are_the_softkey_or_both_keys() -> None:
    operator = square().press("1", "enter", "alt+1")
    assert len(operator.segments) == 3
    operator = square().press(*X_START, "alt+2").type(".5")
    assert operator.block.x_start == Number(2.5)
    operator = square().press(*X_START, "9", "alt+2").type(".5")
    assert operator.block.x_start == Number(2.5)


async def test_the_time_for_the_digit_is_over_after_a_while(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.painted.application.ARMED_FOR", 0.05)
    app = app_on("pocket")
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        before = len(app.desk.session.block.segments)
        await pilot.press("pagedown", "escape")
        await _disarmed(pilot)
        await pilot.press("1")
        assert len(app.desk.session.block.segments) == before


async def test_another_key_ends_the_wait(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.painted.application.ARMED_FOR", 60.0)
    app = app_on("pocket")
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        before = len(app.desk.session.block.segments)
        await pilot.press("pagedown", "escape", "1")
        assert len(app.desk.session.block.segments) == before - 1
        assert app._arming is None


async def test_a_second_esc_counts_from_its_own_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.painted.application.ARMED_FOR", 0.4)
    app = app_on("pocket")
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        await pilot.press("escape")
        first = app._arming
        await pilot.press("tab", "escape")
        assert first is not None
        assert first.cancelled()
        assert app._arming is not None
        assert not app._arming.cancelled()


async def _disarmed(pilot: Pilot[int]) -> None:
    while pilot.app.desk.armed:  # type: ignore[attr-defined]
        await asyncio.sleep(0.01)
