"""The guided first part: an operator who follows the prompt, and one who does not."""

from __future__ import annotations

import re
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path

from app.app import CutcompApp
from app.documents.document_service import DocumentService
from app.documents.files import load
from app.file_actions import session_of
from core.pipeline.derive import derive
from core.program.model import CutterComp
from tests.app.widget_pilot import SURROUNDINGS, Operator

KEYS = {"Page Down": "pagedown", "Page Up": "pageup", "Ctrl+S": "ctrl+s", "Ctrl+Home": "ctrl+home"}


@asynccontextmanager
async def guided(folder: Path) -> AsyncIterator[Operator]:
    """An operator who has started the guide."""
    service = DocumentService(state=folder / "own")
    opened = service.new()
    app = CutcompApp(session_of(opened.document), surroundings=SURROUNDINGS, service=service, opened=opened)
    async with Operator.of(app) as user:
        app.action_guide()
        await user.settle()
        yield user
        await user.settle()
    service.stop()


async def obey(user: Operator) -> None:
    """Press only what the guide says."""
    text = user.prompt.removeprefix("GUIDE ").strip()
    if typed := re.search(r": type (\S+), then Enter", text):
        await user.press(f"'{typed[1]}", "enter")
    elif "press L until LEFT" in text:
        await user.press("l")
    elif text.startswith("Type a name"):
        await user.press("ctrl+u", "'plate", "enter")
    elif arrows := re.match(r"(Down|Up) (\d+) times", text):
        await user.press(*[arrows[1].lower()] * int(arrows[2]))
    elif key := re.search(r"\b(Ctrl\+S|Ctrl\+Home|Page Down|Page Up|F8|F3|F1|Enter|Down|Up)\b", text):
        await user.press(KEYS.get(key[1], key[1].lower()))
    else:
        assert "being calculated" in text


async def test_following_the_guide_leads_to_a_posted_file_even_after_wrong_keys(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    async with guided(tmp_path) as user:
        await user.press("tab", "7", "enter", "pagedown")
        for _ in range(70):
            if not user.app.guided:
                break
            await obey(user)
        await user.settle()
        assert user.prompt == "Posted. Typed, checked, saved, posted: that is the whole way."
    program = load(tmp_path / "plate.toml")
    (block,) = derive(program).blocks
    assert program.blocks[0].cutter_comp is CutterComp.LEFT
    assert (block.solved.closed, block.findings) == (True, ())
    assert (tmp_path / "plate.nc").exists()


async def test_escape_ends_the_guide_and_keeps_the_plate(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    async with guided(tmp_path) as user:
        assert user.prompt.startswith("GUIDE  ")
        await user.press("enter", "l", "enter", "1", "escape")
        assert user.app.guided
        await user.press("escape")
        assert not user.app.guided
        assert user.session.block.cutter_comp is CutterComp.LEFT
        await user.press("tab")
        assert not user.prompt.startswith("GUIDE")
