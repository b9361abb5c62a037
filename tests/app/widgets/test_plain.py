"""No text is read as Textual markup, because a file may contain brackets anywhere."""

from __future__ import annotations

import re
from pathlib import Path

import app
from app.app import CutcompApp
from app.documents.files import load
from app.documents.programs import example
from app.session.session import Session
from tests.app.widget_pilot import SURROUNDINGS

OWN = Path(app.__file__).parent / "widgets/plain.py"


def test_only_plain_py_uses_textual_static_and_label() -> None:
    sources = [path for path in OWN.parents[1].rglob("*.py") if path != OWN]
    assert len(sources) > 50
    uses = re.compile(r"(?<![\w.])(Static|Label)\(|class \w+\((Static|Label)\)")
    assert [path.name for path in sources if uses.search(path.read_text(encoding="utf-8"))] == []


async def test_brackets_in_a_message_stay() -> None:
    program = CutcompApp(Session.of(load(example("notch"))), surroundings=SURROUNDINGS)
    async with program.run_test(notifications=True) as pilot:
        program.notify("Saved: c[/d]a.toml")
        await pilot.pause()
        [toast] = program.screen.query("Toast")
        assert "c[/d]a.toml" in str(toast.render())
        # as QUIT does: later results from threads are dropped
        program.exit()
