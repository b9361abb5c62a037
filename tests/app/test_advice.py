"""What is said beside the path: it follows, it is never late for a key, and where it is nothing, nothing is painted."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import count
from math import inf
from threading import Event

import pytest

from app.documents.files import load
from app.documents.programs import example
from app.painted.advice import about_of
from app.painted.application import CutcompApp
from app.painted.screens.frame import Frame
from app.painted.surroundings import Surroundings
from app.painted.widgets.rows import Row
from core.advice.why_not_clean import Advice
from core.finding import Finding, Severity
from core.pipeline import derive as stages
from core.pipeline.derived import DerivedBlock
from core.program.edit import FormPlace
from core.program.model import Program
from tests.app.pilots import app_on, at_rest, lines, loaded, until
from tests.reports.reference import Reference

FURTHER = Finding("BETTER", Severity.INFO, "A better path would cut more.")
TO_X_END = ("1", "enter", "tab")


def slow_notes(app: CutcompApp) -> None:
    """Path and table come with the key, notes always behind it."""
    app.engine.limit = 1e6
    app.engine.took["notes"] = 1e7


async def test_notes_follow_the_verdict_and_nobody_says_before_that_there_are_none(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    app, go = app_on("pocket"), Event()

    def better(_: DerivedBlock) -> tuple[Finding, ...]:
        assert go.wait(10)
        return (FURTHER,)

    async with app.run_test(size=(132, 43)) as pilot:
        await loaded(pilot)
        await at_rest(pilot, app)
        slow_notes(app)
        monkeypatch.setattr(stages, "better_path", better)
        await pilot.press(*TO_X_END, "3", ".", "5", "enter")
        assert "UNCUT" in lines(app)
        assert "look-ahead 1" in lines(app)
        assert FURTHER.text not in lines(app)
        await pilot.press("ctrl+f")
        assert "more to say is being calculated" in lines(app)
        go.set()
        await until(pilot, lambda: FURTHER.text in lines(app))
        await at_rest(pilot, app)
        assert "being calculated" not in lines(app)
        await pilot.press("escape")
        assert FURTHER.text in lines(app)


async def test_what_has_nothing_to_say_changes_nothing_on_the_screen(monkeypatch: pytest.MonkeyPatch) -> None:
    memory, shown, go = count(1), list[tuple[Row, ...]](), Event()
    app = app_on("pocket")
    app.around = Surroundings(lambda: "16:51", lambda: next(memory))
    show = Frame.show

    def kept(frame: Frame, rows: tuple[Row, ...]) -> None:
        shown.append(rows)
        show(frame, rows)

    def better(_: DerivedBlock) -> tuple[Finding, ...]:
        assert go.wait(10)
        return ()

    async with app.run_test(size=(132, 43)) as pilot:
        await loaded(pilot)
        await at_rest(pilot, app)
        slow_notes(app)
        monkeypatch.setattr(stages, "better_path", better)
        monkeypatch.setattr(Frame, "show", kept)
        await pilot.press(*TO_X_END, "3")
        await until(pilot, lambda: app.advice.noting.busy)
        painted = len(shown)
        go.set()
        await until(pilot, lambda: not app.engine.lacks_notes(app.shown.found))
        await at_rest(pilot, app)
        assert not app.engine.lacks_notes(app.shown.found)
        assert all(rows == shown[painted - 1] for rows in shown[painted:])


async def test_small_notes_come_in_one_picture_with_a_table_that_comes_behind_the_key(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    app, shown = app_on("pocket"), list[tuple[Row, ...]]()
    show = Frame.show

    def kept(frame: Frame, rows: tuple[Row, ...]) -> None:
        shown.append(rows)
        show(frame, rows)

    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        await at_rest(pilot, app)
        app.engine.limit = 1.0
        app.engine.took |= {"table": 1e7, "notes": 0.0}
        await pilot.press(*TO_X_END, "3")
        # as if the number had been typed too fast to be tried out
        app.engine.derived = ()
        monkeypatch.setattr(Frame, "show", kept)
        await pilot.press("enter")
        await until(pilot, lambda: app.engine.tabulated(app.shown.found))
        await at_rest(pilot, app)
        assert not app.engine.lacks_notes(app.shown.found)
        assert len(shown) == 2  # that of the key, and that of all that follows


class Remedies:
    """`needs`, counted; each waits between two tries until it may go on."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.begun, self.given_up, self.go = list[Program](), list[Program](), Event()
        self.own = stages.advice_for_block
        monkeypatch.setattr(stages, "advice_for_block", self.needs)

    def needs(self, found: DerivedBlock, program: Program, table: None, *, wanted: Callable[[], bool]) -> Advice | None:
        self.begun.append(program)
        assert self.go.wait(10)
        if not wanted():
            self.given_up.append(program)
            return None
        return self.own(found, program, table, wanted=wanted)


async def test_remedies_are_given_up_for_a_newer_path_and_only_those_of_the_last_are_told(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    app = app_on("notch")
    async with app.run_test(size=(132, 43)) as pilot:
        await loaded(pilot)
        await at_rest(pilot, app)
        tried = Remedies(monkeypatch)
        await pilot.press(*TO_X_END, *"2.5", "enter")
        first = app.desk.session.program
        await until(pilot, lambda: first in tried.begun)
        await pilot.press("up", *"2.6", "enter")
        last = app.desk.session.program
        tried.go.set()
        await at_rest(pilot, app)
        await until(pilot, lambda: not app.engine.lacks_needs(app.shown.found))
        assert first in tried.given_up
        assert tried.begun[-1] == last
        assert last not in tried.given_up
        assert all(one.work is not None for one in app.engine.needs)
        assert "CAL 2 gouges" in lines(app)


async def test_what_a_half_typed_number_needs_is_found_out_at_rest_and_told_with_enter(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    app = app_on("notch")
    async with app.run_test(size=(132, 43)) as pilot:
        await loaded(pilot)
        await at_rest(pilot, app)
        tried = Remedies(monkeypatch)
        tried.go.set()
        await pilot.press(*TO_X_END)
        for key in "2.5":
            app.key(key, key)
            assert not tried.begun
        await until(pilot, lambda: not app.engine.lacks_needs(app.shown.found))
        await at_rest(pilot, app)
        assert app.trial is not None
        assert "CAL 2 gouges" not in lines(app)
        done = list(tried.begun)
        assert done == [app.trial.program]
        await pilot.press("enter")
        assert app.trial is None
        assert "CAL 2 gouges" in lines(app)
        assert tried.begun == done


async def test_the_thread_of_the_remedies_never_looks_at_a_desk_of_which_nothing_is_derived_yet() -> None:
    app = app_on("notch")
    async with app.run_test(size=(132, 43)) as pilot:
        await loaded(pilot)
        await at_rest(pilot, app)
        about, desk = about_of(app.shown.found), app.desk
        # as between a key that makes a block and what is derived of it
        app.desk = replace(desk, session=replace(desk.session, where=FormPlace(2)))
        assert app.advice._wanted(about, app.touched)
        assert not app.advice._wanted((None, 2), app.touched)
        app.desk = desk


async def test_leaving_waits_for_no_remedy(monkeypatch: pytest.MonkeyPatch) -> None:
    app = app_on("notch")
    tried = Remedies(monkeypatch)
    async with app.run_test(size=(132, 43)) as pilot:
        await loaded(pilot)
        await until(pilot, lambda: bool(tried.begun))
        app.exit(0)
        tried.go.set()
        await until(pilot, lambda: bool(tried.given_up))
    assert tried.given_up == tried.begun
    assert len(tried.begun) == 1


@pytest.mark.parametrize("limit", [inf, -1.0], ids=["fast", "slow"])
async def test_a_fast_and_a_slow_machine_come_to_the_same_screen(limit: float) -> None:
    program = load(example("notch"))
    app = app_on(program)
    async with app.run_test(size=(132, 43)) as pilot:
        await loaded(pilot)
        app.engine.limit = limit
        await pilot.press(*TO_X_END, *"2.5", "enter")
        await until(pilot, lambda: app.desk.session.found.known and app.engine.tabulated(app.shown.found))
        await at_rest(pilot, app)
        await until(pilot, lambda: not app.engine.lacks_needs(app.shown.found))
        await at_rest(pilot, app)
        fresh = Reference(app.desk.session)
        fresh.desk = app.desk
        fresh.key_less()
        assert lines(app).splitlines() == fresh.lines(132, 43)


def test_the_surroundings_of_a_moment_stay_as_they_were() -> None:
    ticks = count()
    around = Surroundings(lambda: str(next(ticks)), lambda: next(ticks))
    then = around.now()
    assert (then.clock(), then.free()) == (then.clock(), then.free())
    assert replace(around).clock() != then.clock()
