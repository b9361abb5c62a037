"""The App under a pilot: keys in, session and picture out."""

from __future__ import annotations

import gc
import sys
from math import inf

import pytest
from textual.events import Key

from app.painted.application import CutcompApp
from app.painted.engine import Known, derived_again
from app.painted.screens.frame import Frame, picture
from app.painted.widgets.painted import Rows
from app.painted.widgets.rows import Row, text_of
from core.pipeline.derived import Derived
from core.program.model import Number, Program
from tests.app.operator import FROZEN
from tests.app.pilots import app_on, loaded, rested, typed


def lines(app: CutcompApp) -> list[str]:
    """What stands on the terminal."""
    return [text_of(row).rstrip() for row in app.screen.query_one(Rows).rows]


def shown(app: CutcompApp, part: str) -> str:
    return next((line for line in lines(app) if part in line), "")


async def test_the_seeds_own_screen_cal_usr_and_f3() -> None:
    app = app_on("overrun-square")
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        assert "CAL      2" in shown(app, "LOOKAHEAD")
        await pilot.press(*["tab"] * 11)
        await typed(pilot, ["4"])
        assert "USR      4" in shown(app, "LOOKAHEAD")
        assert app.desk.session.block.lookahead == Number(4.0)
        assert shown(app, "DELETED").startswith(" DELETED 2-3  by 1 and 4 at X -0.2500 Y -0.2500")
        await pilot.press("f3")
        assert "CAL      2" in shown(app, "LOOKAHEAD")


async def test_the_verdict_follows_within_the_same_key_even_while_typing() -> None:
    app = app_on("pocket")
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        assert "GOUGE none" in shown(app, "UNCUT")
        await pilot.press(*["tab"] * 11, "1")
        assert "GOUGE   0.2500" in shown(app, "GOUGE")
        assert app.desk.session.block.lookahead is None
        await pilot.press("escape")
        assert "GOUGE none" in shown(app, "UNCUT")


async def test_a_picture_is_a_fresh_drawing_of_the_desk_after_any_keys() -> None:
    app = app_on("pocket")
    keys = ["tab", "7", "enter", "f6", "f2", "1", "f8", "pagedown", "right", "f7", "+", "m", "f8", "f8", "f3", "up"]
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        for key in keys:
            await pilot.press(key)
            known = app.engine.known(app.shown.found, app.trial)
            fresh = Known(known.table, known.ready, trial=known.trial)
            assert app.screen.query_one(Rows).rows == picture(app.desk, fresh, FROZEN, 80, 24)


async def test_a_slow_machine_shows_the_form_at_once_and_the_verdict_later() -> None:
    app = app_on("pocket")
    app.engine.limit = -1.0
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        await pilot.press(*["tab"] * 11)
        await typed(pilot, ["1"])
        assert "USR      1" in shown(app, "LOOKAHEAD")
        await rested(pilot)
        assert "GOUGE   0.2500" in shown(app, "GOUGE")
        assert not app.desk.session.stale


@pytest.mark.parametrize("limit", [inf, -1.0], ids=["fast", "slow"])
async def test_what_was_tried_out_while_it_was_typed_is_not_derived_again(
    limit: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    done: list[Program] = []

    def counted(program: Program, before: Derived) -> Derived:
        done.append(program)
        return derived_again(program, before)

    app = app_on("pocket")
    app.engine.limit = limit
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        monkeypatch.setattr("app.painted.engine.derived_again", counted)
        await pilot.press(*["tab"] * 11, "1", "enter", "tab")
        await rested(pilot)
        assert len(done) == 1
        assert app.desk.session.block.lookahead == Number(1.0)
        # a point behind a whole number, a digit taken back, undo, redo
        await pilot.press("up", "1", ".", "0", "backspace", "enter", "ctrl+z", "ctrl+y")
        await rested(pilot)
        assert len(done) == 1
        assert not app.desk.session.stale
        assert app.desk.session.found.known
        assert app.desk.session.found.block is app.desk.session.block
        assert "GOUGE   0.2500" in shown(app, "GOUGE")


async def test_keys_that_come_at_once_are_painted_together(monkeypatch: pytest.MonkeyPatch) -> None:
    app, painted = app_on("pocket"), list[str]()
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        await pilot.press(*["tab"] * 4)
        show = Frame.show

        def counted(frame: Frame, rows: tuple[Row, ...]) -> None:
            show(frame, rows)
            painted.append(shown(app, "X START"))

        monkeypatch.setattr(Frame, "show", counted)
        app._painted = inf
        for key in "2.125":
            app.screen.post_message(Key(key, key))
        await pilot.pause()
        assert len(painted) == 1
        assert painted[0].split()[2] == "2.125"
        assert app.trial is not None
        assert app.trial.block.x_start == Number(2.125)
        fresh = Known(app.engine.known(app.shown.found, None).table, ready=True, trial=app.trial)
        assert app.screen.query_one(Rows).rows == picture(app.desk, fresh, FROZEN, 80, 24)


async def test_nothing_takes_the_focus_and_the_screen_is_never_changed() -> None:
    app = app_on("pocket")
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        await pilot.press("tab", "tab", "f6", "f8")
        assert app.focused is None
        assert len(app.screen_stack) == 1
        assert isinstance(app.screen, Frame)


@pytest.mark.parametrize("size", [(20, 5), (1, 1), (3, 2), (79, 23), (80, 24), (200, 60)])
async def test_every_size_works_and_loses_nothing(size: tuple[int, int]) -> None:
    app = app_on("pocket")
    async with app.run_test(size=size) as pilot:
        await loaded(pilot)
        await pilot.press("tab", "9", "enter", "f7", "+", "f8", "f8", "f6", "f8", "enter", "f6", "f8")
        assert app.desk.session.block.tool == Number(9.0)
        assert [len(text_of(row)) for row in app.screen.query_one(Rows).rows] == [size[0]] * size[1]


async def test_a_small_terminal_says_so_and_shows_the_field_that_is_typed() -> None:
    app = app_on("pocket")
    async with app.run_test(size=(20, 5)) as pilot:
        await loaded(pilot)
        await pilot.press("tab", "tab", "tab", "tab", "3", ".", "2")
        assert lines(app)[0] == "20x5: make it 80x24"
        assert shown(app, "X ST").split()[-1] == "3.2"


async def test_another_size_moves_everything_to_its_place() -> None:
    app = app_on("pocket")
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        await pilot.resize_terminal(132, 43)
        await pilot.pause()
        assert len(lines(app)) == 43
        assert "F8 EXIT" in shown(app, "F8")
        await pilot.resize_terminal(80, 24)
        await pilot.pause()
        assert len(lines(app)) == 24


async def test_leaving_ends_with_status_0() -> None:
    app = app_on("pocket")
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        await pilot.press("f8", "f8")
    assert app.return_code == 0


async def test_a_key_waits_a_millisecond_for_its_turn_beside_what_is_calculated() -> None:
    before = sys.getswitchinterval()
    try:
        sys.setswitchinterval(0.005)
        app = app_on("pocket")
        async with app.run_test(size=(80, 24)) as pilot:
            await loaded(pilot)
            assert sys.getswitchinterval() == pytest.approx(0.001)
    finally:
        sys.setswitchinterval(before)


async def test_the_collector_works_again_once_the_first_screen_stands() -> None:
    gc.disable()
    app = app_on("pocket")
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        assert gc.isenabled()
