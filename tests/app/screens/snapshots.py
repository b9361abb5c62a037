"""Pictures of screens: an app goes from one to the next, and each is compared with its approved picture.

After an intended change, run `pytest tests/app/screens/test_*snapshots.py --snapshot-update`, then look at each
changed picture.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from datetime import UTC, datetime
from typing import Final

from syrupy.assertion import SnapshotAssertion

from app.app import CutcompApp
from core.program.edit import FormPlace
from core.program.model import Program
from tests.app.widget_pilot import SURROUNDINGS, Operator, session_on

SIZES: Final = {"60x20": (60, 20), "80x24": (80, 24), "132x43": (132, 43)}
NOON: Final = datetime(2026, 1, 2, 12, tzinfo=UTC)
CALCULATING: Final = (
    "compare", "derive", "drawing", "import", "post", "preview", "proof", "sheet", "survey", "table", "times"
)  # fmt: skip
"""The groups of workers that calculate; others wait for an answer."""
FONT: Final = re.compile(r"@font-face \{.*?\}", re.DOTALL)
"""The source of the font for a browser, which no picture needs."""


def app_on(start: str | Program, look: str = "") -> CutcompApp:
    """The app with an example or a program, in the light theme, with sixteen colors, with none, or in ASCII."""
    return CutcompApp(
        session_on(start),
        surroundings=SURROUNDINGS,
        few_colors=look in ("no-color", "sixteen"),
        light=look == "light",
        character_sets=("ascii",) if look == "ascii" else ("braille", "block", "ascii"),
    )


class Viewer(Operator):
    """An operator who waits for everything that is calculated."""

    calculating = CALCULATING
    patience = 0.0

    async def follow(self, keys: str) -> None:
        """Press keys; SEGMENT:FIELD moves the cursor there, and a quote begins typed text."""
        for key in keys.split():
            segment, colon, field = key.partition(":")
            if colon:
                self.app.move(FormPlace(1, int(segment)), field)
                await self.settle()
            else:
                await self.press(key)


Opened = Callable[[CutcompApp], None]
"""Opens something for the operator."""
Part = tuple[Opened | None, Mapping[str, str]]
"""What is opened, then the pictures, with the keys that lead to each from the previous one."""


def on(start: str | Program, stages: Mapping[str, str]) -> Part:
    """A sequence of pictures on the form of another program."""

    def begin(app: CutcompApp) -> None:
        app._uncover(0)
        app.switch_session(session_on(start))

    return begin, stages


async def differing(app: CutcompApp, size: str, parts: Sequence[Part], snapshot: SnapshotAssertion) -> list[str]:
    """Go from picture to picture; the names of those that differ."""
    wrong = []
    async with Viewer.of(app, SIZES[size]) as user:
        for opened, stages in parts:
            if opened is not None:
                opened(app)
                await user.settle()
            for name, keys in stages.items():
                await user.follow(keys)
                picture = FONT.sub("", app.export_screenshot(title="cutcomp", simplify=True))
                if snapshot(name=name) != picture:
                    wrong.append(name)
    return wrong
