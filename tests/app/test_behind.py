"""One thread at a time, the last question first, and an error that is seen."""

from __future__ import annotations

from asyncio import sleep
from collections.abc import Callable
from threading import Event, Timer

import pytest
from textual.app import App

from app.painted.behind import Behind


def failing() -> int:
    raise ZeroDivisionError


async def run_through(behind: Behind[int], work: Callable[[], int]) -> None:
    """The App until this work is over."""
    async with behind.app.run_test():
        behind.ask(work)
        while behind.busy:
            await sleep(0)


async def test_of_what_is_asked_meanwhile_only_the_last_is_done() -> None:
    app, told, go = App[int](), list[str](), Event()
    async with app.run_test() as pilot:
        behind = Behind(app, told.append)

        def first() -> str:
            go.wait(10)
            return "first"

        behind.ask(first)
        behind.ask(lambda: "second")
        behind.ask(lambda: "third")
        assert behind.busy
        go.set()
        while behind.busy:
            await pilot.pause()
    assert told == ["first", "third"]


async def test_work_that_fails_ends_the_program_with_its_error_and_keeps_nothing_busy() -> None:
    app, told = App[int](), list[int]()
    behind = Behind(app, told.append)
    with pytest.raises(ZeroDivisionError):
        await run_through(behind, failing)
    assert app.return_code == 1
    assert not told
    assert not behind.busy


async def test_an_answer_that_cannot_be_taken_ends_the_program_too() -> None:
    app = App[int]()

    def untaken(answer: int) -> None:
        raise ZeroDivisionError(answer)

    behind = Behind(app, untaken)
    with pytest.raises(ZeroDivisionError):
        await run_through(behind, lambda: 1)
    assert not behind.busy


def test_work_that_ends_when_the_program_has_been_left_begins_no_more(caplog: pytest.LogCaptureFixture) -> None:
    told, go = list[int](), Event()

    class Left(App[int]):
        def on_mount(self) -> None:
            behind = Behind(self, told.append)

            def first() -> int:
                go.wait(10)
                return 1

            behind.ask(first)
            behind.ask(lambda: 2)
            self.set_timer(0.05, self.exit)

    late = Timer(0.3, go.set)
    late.start()
    Left().run(headless=True)
    assert not told
    assert not caplog.records
