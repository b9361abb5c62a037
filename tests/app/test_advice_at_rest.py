"""When advice is sought: with the path, behind it in a thread, or once no key has come for a while."""

from __future__ import annotations

import pytest

from app.painted.engine import FAST
from core.finding import Finding, Severity
from core.pipeline import derive as stages
from core.pipeline.derived import DerivedBlock
from tests.app.pilots import app_on, at_rest, lines, loaded, until

FURTHER = Finding("BETTER", Severity.INFO, "A better path would cut more.")
TO_X_END = ("1", "enter", "tab")


async def test_what_a_better_path_would_cut_is_found_out_at_rest_and_told_with_enter(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    app, asked = app_on("pocket"), list[DerivedBlock]()

    def better(found: DerivedBlock) -> tuple[Finding, ...]:
        asked.append(found)
        return (FURTHER,)

    async with app.run_test(size=(132, 43)) as pilot:
        await loaded(pilot)
        await at_rest(pilot, app)
        monkeypatch.setattr(stages, "better_path", better)
        await pilot.press(*TO_X_END)
        for key in "3.5":
            app.key(key, key)
            assert not asked
        await until(pilot, lambda: bool(asked) and not app.engine.lacks_notes(app.shown.found))
        await at_rest(pilot, app)
        assert app.trial is not None
        assert FURTHER.text not in lines(app)
        await pilot.press("enter")
        assert FURTHER.text in lines(app)
        assert [found.paths for found in asked] == [app.shown.found.paths]


@pytest.mark.parametrize(
    ("took", "at_once"),
    [
        ({"derive": 0.001, "table": 0.001}, True),
        ({"derive": 0.001, "table": 0.01}, False),
        ({"derive": 0.001}, False),
        ({"derive": 0.03, "table": 0.001}, False),
    ],
    ids=["small", "large", "never measured", "that of a smaller contour"],
)
async def test_a_path_waits_for_a_table_that_is_known_to_be_small(took: dict[str, float], at_once: bool) -> None:
    app = app_on("pocket")
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        await at_rest(pilot, app)
        app.engine.limit, app.engine.took = FAST, took
        app.engine.tables = ()
        app.advice.seek()
        assert app.engine.tabulated(app.shown.found) is at_once
        assert app.advice.tabling.busy is not at_once
        await at_rest(pilot, app)
        assert app.engine.tabulated(app.shown.found)


async def test_behind_a_table_notes_are_found_out_in_its_thread_only_where_they_are_told() -> None:
    app = app_on("pocket")
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        await at_rest(pilot, app)
        found, program = app.shown.found, app.shown.program
        for told in (False, True):
            app.engine.took = {"notes": 0.0}
            app.engine.tables, app.engine.notes = (), ()
            app.advice._keep(found, program, told=told)
            assert app.engine.lacks_notes(found) is not told


async def test_while_a_number_is_typed_no_notes_of_an_older_path_are_waited_for() -> None:
    app = app_on("pocket")
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        await at_rest(pilot, app)
        begun = list[int]()
        app.advice.noting.busy = True
        app.advice.noting.waiting = (lambda: begun.append(1)), None
        await pilot.press(*TO_X_END, "3")
        assert app.advice.noting.waiting is None
        app.advice.noting.busy = False
        await at_rest(pilot, app)
        assert not begun


async def test_nobody_rests_for_what_is_known_already_or_once_the_program_is_left() -> None:
    app = app_on("pocket")
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        await pilot.press(*TO_X_END, "3")
        await until(pilot, lambda: not app.engine.lacks_notes(app.shown.found))
        await at_rest(pilot, app)
        app.advice.resting = None
        app.advice.seek()
        assert app.advice.resting is None
        app.engine.notes = ()
        app.advice.seek()
        assert app.advice.resting is not None
        app.advice.resting.cancel()
        app.advice.resting, app._return_code = None, 0
        app.advice.seek()
        assert app.advice.resting is None
        app._return_code = None


async def test_a_half_typed_number_that_leads_to_the_path_in_force_shows_its_notes_at_rest(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    app = app_on("pocket")
    async with app.run_test(size=(132, 43)) as pilot:
        await loaded(pilot)
        await at_rest(pilot, app)
        app.engine.limit, app.engine.notes = 1e6, ()
        monkeypatch.setattr(stages, "better_path", lambda _: (FURTHER,))
        # of another depth the paths are the same
        await pilot.press(*["tab"] * 7, "-", ".", "3")
        assert app.trial is not None
        assert app.shown.found.paths is app.desk.session.found.paths
        await until(pilot, lambda: FURTHER.text in lines(app))


async def test_a_number_typed_while_the_program_is_left_is_not_painted_any_more() -> None:
    app = app_on("pocket")
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        await pilot.press(*TO_X_END, "3")
    assert not app.screen_stack
    # what a clock does that has run down meanwhile
    app.advice._rested()
    app.refresh_screen()


async def test_what_fails_when_its_time_has_come_ends_the_program_with_its_error() -> None:
    app = app_on("pocket")

    def fail() -> None:
        raise ZeroDivisionError

    async def through() -> None:
        async with app.run_test(size=(80, 24)) as pilot:
            await loaded(pilot)
            app.after(0.0, fail)
            await until(pilot, lambda: app.return_code is not None)

    with pytest.raises(ZeroDivisionError):
        await through()
    assert app.return_code == 1
