"""Long work: the status line or a bar shows its progress, Esc stops it, and it can be started again."""

from __future__ import annotations

from contextlib import asynccontextmanager
from threading import Event
from time import monotonic, sleep
from typing import Any

import pytest
from textual.widgets import Label, ProgressBar, Static

import app.derivation_actions as app_module
import app.nc_proof.compare_controls as dialogs_module
import app.nc_proof.runs as proof_module
import app.screens.post as post_module
import core.pipeline.derive as derive_module
from app.documents.document import NcDocument
from app.documents.nc_text import NcText
from app.session import work
from app.widgets.status import Progress, Prompt, Status
from core.program.edit import FormPlace
from core.progress import Stopped
from tests.app.widget_pilot import Operator, operator


@pytest.fixture(autouse=True)
def at_once(monkeypatch):
    """Work counts as long as soon as it starts."""
    monkeypatch.setattr(work, "SECONDS_BEFORE_PROGRESS", 0.0)
    monkeypatch.setattr(work, "SECONDS_BEFORE_STOP", 0.0)
    monkeypatch.setattr("app.derivation_actions.SECONDS_BEFORE_PROGRESS", 0.02)


class Slow:
    """Work that stays at 40 % until it may go on."""

    def __init__(self, monkeypatch, module, name):
        self.real, self.go, self.stopped = getattr(module, name), Event(), False
        self.options: dict[str, Any] = {}
        monkeypatch.setattr(module, name, self)

    def __call__(self, *arguments, progress=None, **options):
        self.options = options
        report = progress or arguments[-1]
        while not self.go.is_set():
            try:
                report(0.4)
            except Stopped:
                self.stopped = True
                raise
            sleep(0.005)
        return self.real(*arguments) if progress is None else self.real(*arguments, progress=progress, **options)


def status(user: Operator) -> str:
    return str(user.screen.query_one(Status).query_one("#units").render())


async def until_status_shows(user: Operator, text: str) -> None:
    """Wait until the status line contains this text."""
    while text not in status(user):
        await user.pilot.pause(0.01)


async def bar(user: Operator, percent: int) -> None:
    """Wait until a bar in the place of the prompt shows this much, and that Esc stops the work."""
    progress, prompt = user.screen.query_one(Progress), user.screen.query_one(Prompt)
    done, stops = progress.query_one(ProgressBar), progress.children[-1]
    while not (progress.display and stops.visible and done.percentage and round(100 * done.percentage) == percent):
        await user.pilot.pause(0.01)
    assert str(progress.query_children(Label).last().content) == "Esc stops"
    assert not prompt.display
    assert "Free:" in status(user)


async def test_a_long_derivation_shows_its_progress_and_escape_stops_it(monkeypatch):
    async with operator() as user:
        slow = Slow(monkeypatch, app_module, "derived")
        await user.send(*["tab"] * 4, "2", ".", "1", "enter")
        await until_status_shows(user, "working 40 %, Esc stops")
        verdict = user.screen.query_one("#verdict")
        assert "working 40 %" in str(verdict.border_title)
        await user.press("escape")
        assert slow.stopped
        assert "Free:" in status(user)
        assert "stopped" in str(verdict.border_title)
        assert user.prompt == "Stopped. Any edit calculates again, or Ctrl+K and CALCULATE."
        slow.go.set()
        user.app.action_calculate()
        await user.settle()
        assert user.session.derived_block.complete
        assert "stopped" not in str(verdict.border_title)


async def test_an_abandoned_half_typed_number_leaves_the_program_calculated(monkeypatch):
    async with operator() as user:
        slow = Slow(monkeypatch, app_module, "derived")
        await user.send("tab", "2", "enter")
        await until_status_shows(user, "working 40 %")
        await user.send("down", "4")
        slow.go.set()
        await user.press("tab", "ctrl+z", "ctrl+z")
        assert user.session.derived_block.complete
        assert user.app.displayed is user.session


async def test_a_stopped_look_ahead_table_is_made_on_request(monkeypatch):
    async with operator() as user:
        slow = Slow(monkeypatch, derive_module, "look_ahead_table")
        await user.send(*["tab"] * 4, "2", ".", "1", "enter")
        await until_status_shows(user, "working 40 %, Esc stops")
        await user.press("escape")
        assert slow.stopped
        assert user.session.lookahead_table is None
        slow.go.set()
        user.app.action_calculate()
        await user.settle()
        assert user.session.lookahead_table is not None


async def test_the_strip_shows_the_values_that_are_judged_while_the_others_are_not(monkeypatch):
    async with operator() as user:
        rows = user.session.lookahead_table.rows
        slow = Slow(monkeypatch, derive_module, "look_ahead_table")
        await user.send(*["tab"] * 4, "2", ".", "1", "enter")
        await until_status_shows(user, "working 40 %, Esc stops")
        strip = user.screen.query_one("#strip", Static)
        assert "✖" not in str(strip.content)
        slow.options["report_rows"](rows[:1])
        while "✖" not in str(strip.content):
            await user.pilot.pause(0.01)
        slow.go.set()


async def test_a_block_that_the_cursor_goes_to_gets_its_look_ahead_table():
    async with operator("flange") as user:
        for block in (1, 2):
            user.app.move(FormPlace(block))
            await user.settle()
            assert user.session.lookahead_table is not None, block


@asynccontextmanager
async def posting(monkeypatch):
    """An operator at POST NC while the text is being made and is at 40 %."""
    async with operator() as user:
        slow = Slow(monkeypatch, post_module, "nc_text")
        user.app.action_post()
        await user.pilot.pause()
        await bar(user, 40)
        yield user, slow


async def test_escape_stops_posting_and_enter_makes_the_text_again(monkeypatch):
    async with posting(monkeypatch) as (user, slow):
        await user.press("escape")
        assert slow.stopped
        # a later result for the same program arrives
        user.screen.show_session(user.session)
        assert "Stopped. Enter makes the NC text." in str(user.screen.query_one("#post-findings").render())
        slow.go.set()
        await user.press("enter")
        assert isinstance(user.screen, post_module.PostScreen)
        while user.screen.made is None:
            await user.pilot.pause(0.01)
        assert "Free:" in status(user)


@pytest.mark.parametrize("typed", ["", "9"])
async def test_enter_posts_once_the_text_is_made_unless_the_name_changes(monkeypatch, tmp_path, typed):
    monkeypatch.chdir(tmp_path)
    async with posting(monkeypatch) as (user, slow):
        await user.press("enter")
        assert user.prompt == "The NC text is still being made and is posted when it is ready. Esc stops it."
        await user.press(*typed)
        slow.go.set()
        await user.settle()
        await user.pilot.pause(0.2)
        await user.settle()
        assert [path.suffix for path in tmp_path.iterdir()] == ([] if typed else [".nc"])


async def test_the_program_can_end_while_an_nc_text_is_made(monkeypatch):
    async with posting(monkeypatch) as (_, slow):
        pass
    deadline = monotonic() + 5
    while not slow.stopped and monotonic() < deadline:
        sleep(0.005)
    assert slow.stopped


async def test_escape_stops_a_run_of_a_control_and_the_outcome_says_so(monkeypatch):
    async with operator() as user:
        slow = Slow(monkeypatch, proof_module, "run")
        user.app.show_nc(NcDocument(NcText.read(b"G21 G1 X1 F9\nM30\n")))
        await user.pilot.pause()
        await bar(user, 20)
        await user.press("escape")
        assert slow.stopped
        assert user.screen.query_one(Prompt).display
        assert not user.screen.query_one(Progress).display
        assert "stopped" in str(user.screen.query_one("#proof-outcome").render())
        assert type(user.screen).__name__ == "ProofScreen"


async def test_escape_from_the_comparison_stops_the_controls(monkeypatch):
    async with operator() as user:
        slow = Slow(monkeypatch, dialogs_module, "compare")
        user.app.show_nc(NcDocument(NcText.read(b"G21 G1 X1 F9\nM30\n")))
        await user.settle()
        await user.send("v")
        while not isinstance(user.app.screen, dialogs_module.CompareControls):
            await user.pilot.pause(0.01)
        waiting = user.app.screen.query_one("#compare-wait", Static)
        while "working 40 %" not in str(waiting.content):
            await user.pilot.pause(0.01)
        await user.send("escape")
        while not slow.stopped:
            await user.pilot.pause(0.01)
        assert type(user.app.screen).__name__ == "ProofScreen"
