"""IMPORT TOOL TABLE by keys: what is asked, what is refused, and what Ctrl+Z brings back."""

from __future__ import annotations

from textual.widgets import Static

from app.screens.dialogs import Question
from app.screens.import_tools import ImportToolsScreen
from core.program.model import Number
from tests.app.widget_pilot import Operator, operator


async def import_table(user: Operator) -> None:
    """Open the screen and press Enter: it proposes tool.tbl of the folder."""
    user.patience = 0.0
    await user.app.run_action("app.import_tools")
    await user.settle()
    assert isinstance(user.app.screen, ImportToolsScreen)
    await user.press("enter")


def faults(user: Operator) -> str:
    return str(user.app.screen.query_one("#table-faults", Static).content)


async def test_a_tool_that_differs_is_named_with_both_diameters_before_it_is_replaced(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "tool.tbl").write_text("T1 P1 D0.375 ;half inch, ground\nT7 P7 D0.125\n")
    async with operator() as user:
        known = user.session.program.tools
        await import_table(user)
        assert isinstance(user.app.screen, Question)
        lines = [str(line) for line in user.app.screen.lines]
        assert lines[0] == "Tools: 2. New: 1. Changed: 1."
        before, after = lines[1].split(" becomes ")
        assert ("0.500" in before, "0.375" in after) == (True, True), lines
        await user.press("i")
        assert [tool.diameter for tool in user.session.program.tools if tool.number in (1, 7)] == [
            Number(0.375),
            Number(0.125),
        ]
        await user.press("ctrl+z")
        assert user.session.program.tools == known


async def test_a_table_with_a_fault_changes_nothing_and_lists_line_and_column(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "tool.tbl").write_text("T1 P1 D0.375\nT2 P2 Dwide\n")
    async with operator() as user:
        known = user.session.program
        await import_table(user)
        assert user.prompt == "Nothing was imported. Correct the lines that are listed."
        assert faults(user).startswith(" line 2, column ")
        assert user.session.program is known


async def test_a_table_that_is_not_there_is_named(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    async with operator() as user:
        await import_table(user)
        assert user.prompt == "tool.tbl cannot be read: there is no such file or folder. Check the name."
        assert isinstance(user.app.screen, ImportToolsScreen)
