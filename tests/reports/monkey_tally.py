"""What a monkey did and saw, counted, and the report of it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from app.screens.page import Page
from tests.reports.monkey_keys import Coverage

PAGE: Final = 4096
MEGABYTE: Final = 1024 * 1024


@dataclass
class Tally:
    """What was done and seen; `memory` in bytes after so many keys."""

    keys: int = 0
    looks: int = 0
    lives: int = 0
    deaths: int = 0
    edits: int = 0
    coverage: Coverage = field(default_factory=Coverage)
    memory: list[tuple[int, int]] = field(default_factory=list)
    wrong: list[str] = field(default_factory=list)

    def remember(self) -> None:
        """How much memory is used now."""
        self.memory.append((self.keys, resident()))


def resident() -> int:
    """Bytes of memory of this process."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * PAGE


def screens(page: type[Page] = Page) -> Iterator[str]:
    """Names of all screens there are: the pages that say what stands on them."""
    for kind in page.__subclasses__():
        yield from screens(kind)
        if kind.view is not Page.view and kind.__name__ not in ("FormPage", "EntryPage", "TextPage"):
            yield kind.__name__


def report(tally: Tally, seconds: float) -> Iterator[str]:
    """The result, and what it rests on."""
    every = set(screens())
    reached = every & set(tally.coverage.screens)
    yield f"{tally.keys} keys, {tally.edits} edits, {tally.looks} looks, {tally.lives} lives, {tally.deaths} deaths"
    yield f"{1000 * seconds / max(tally.keys, 1):.2f} ms a key"
    yield f"screens {len(reached)} of {len(every)}{_named(every - reached)}"
    pressed = tally.coverage.seen - set(tally.coverage.missing())
    missing = {f"{name} F{number} {words}".rstrip() for name, number, words in tally.coverage.missing()}
    yield f"softkeys {len(pressed)} of {len(tally.coverage.seen)}{_named(missing)}"
    quarter = max(len(tally.memory) // 4, 1)
    first, last = (
        sorted(one for _, one in part)[quarter // 2] for part in (tally.memory[:quarter], tally.memory[-quarter:])
    )
    yield f"memory {first / MEGABYTE:.1f} MB in the first quarter, {last / MEGABYTE:.1f} MB in the last"
    yield from (f"WRONG: {text}" for text in tally.wrong[:20])
    yield f"failures {len(tally.wrong)}"


def _named(names: set[str]) -> str:
    return f", not {', '.join(sorted(names))}" if names else ""
