"""A monkey at the keyboard: `python -m tests.reports.monkey --keys 100000 --seed 1`.

Random keys go to the App itself, without a terminal and without threads, on programs, on the start screen and on NC
programs; a part goes through Textual.  After every few keys the screen must be that which somebody draws who knows
nothing but the desk, the program must come back equal from its file's text, and what is not saved from its journal,
be it a program or an NC file under proof.
Now and then the program dies, or its file is somebody else's or written by them; work is offered back as on any day.
"""

from __future__ import annotations

import argparse
import asyncio
import os
import random
import shutil
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import chdir
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Final
from unittest.mock import patch

from app.cli.screens import begin, closed, keep_settings
from app.documents import programs as files
from app.documents.lock import take
from app.documents.nc_text import NcText
from app.painted import filing
from app.painted.engine import Engine
from app.painted.keeping import Keeping
from app.painted.nc_journal import found_in
from app.painted.nc_keeping import NcKeeping, proofs
from app.painted.places import read
from app.painted.screens.page import Page
from app.painted.screens.proof import ProofPage
from app.painted.screens.proof_files import read as read_listing
from app.painted.session import Session
from app.painted.widgets.rows import Look, Row
from core.pipeline.outline import outline
from core.program.file.read import loads
from core.program.file.write import dumps
from tests.app.kept import DEAD, ELSEWHERE, TIME
from tests.app.pilots import app_on, loaded
from tests.reports.monkey_keys import Coverage, Monkey
from tests.reports.reference import Reference

SIZES: Final = ((80, 24), (80, 24), (132, 43), (110, 30), (59, 20), (20, 5), (1, 1))
EVERY: Final = 20
"""Keys between two looks at everything."""
LIFE: Final = 1000
"""Keys until another program is begun."""
LARGEST: Final = 40
"""Segments of a program; a larger one is given up, so that a key stays fast."""
NC: Final = "G20 G17 G90\nT1 M6\nG41 D1 G1 X0 Y0 F10\nX2\nY1\nX0\nY0\nG40 X-1\nM30\n"
TABLE: Final = "T1 P1 D0.5 ;end mill\nT2 P2 D0.25\nT3 P3 Dx ;not a number\n"
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


def cells(rows: tuple[Row, ...]) -> list[list[tuple[str, Look]]]:
    """A screen's characters with their looks, however they are put together."""
    return [[(character, span.look) for span in row for character in span.text] for row in rows]


@dataclass
class Life:
    """One program from its beginning to its end: the App, what keeps its work, and one who knows only the desk."""

    app: Reference
    keeping: Keeping
    nc_keeping: NcKeeping
    forgetful: Reference
    monkey: Monkey
    tally: Tally
    trail: list[str] = field(default_factory=list)

    @property
    def session(self) -> Session:
        return self.app.desk.session

    def go_on(self, keys: int) -> None:
        """Keys until the life is over."""
        last = self.tally.keys + keys
        while self.tally.keys < last and not self.app.left and not self.too_large:
            for key in self.monkey.keys(self.app.desk):
                if not self.app.left:
                    self.press(key)

    @property
    def too_large(self) -> bool:
        program = self.session.program
        return sum(len(block.segments) for block in program.blocks) > LARGEST or len(program.blocks) > 5

    def press(self, key: str) -> None:
        """One key, and now and then a look at everything."""
        desk = self.app.desk
        self.monkey.coverage.look(desk)
        key = self.monkey.caged(desk, key)
        self.monkey.coverage.press(desk, key)
        self.trail.append(key)
        self.app.press(key)
        self.tally.keys += 1
        self.tally.edits += self.session.history is not desk.session.history
        if self.tally.keys % EVERY == 0 and not self.app.left:
            self.look()

    def look(self) -> None:
        """The screen, the file's text, the journal; then somebody else may have written the file."""
        self.tally.looks += 1
        width, height = self.monkey.chance.choice(SIZES)
        shown, fresh = cells(self.app.rows(width, height)), cells(self.drawn_anew(width, height))
        for number, (one, other) in enumerate(zip(shown, fresh, strict=True)):
            if one != other or len(one) != width:
                self.wrong(f"{width}x{height} line {number}: {text(one)!r}, drawn anew {text(other)!r}")
                break
        if loads(dumps(self.session.program), "monkey") != self.session.program:
            self.wrong("the program does not come back from its file's text")
        if not self.kept():
            self.wrong("the journal does not bring back the program")
        if not self.listings_kept():
            self.wrong("the journal does not bring back the NC file")
        self.monkey.meddle(self.session.file)

    def drawn_anew(self, width: int, height: int) -> tuple[Row, ...]:
        """The screen as one draws it who remembers nothing and derives everything from the program."""
        other, desk = self.forgetful, self.app.desk
        other.engine, other.trial, other._asked = Engine(ready=True), None, None
        bare = replace(desk.session, derived=outline(desk.session.program))
        other.desk = replace(desk, session=bare)
        other.key_less()
        return other.rows(width, height)

    def kept(self) -> bool:
        """Whether what is not saved can be had back with its undo."""
        if not self.session.unsaved or self.keeping.journal is None or self.keeping.failing:
            return not self.session.unsaved or self.keeping.failing or not self.session.history.past
        found = read(self.keeping.journal.path)
        return found is not None and found.history == self.session.history

    def listings_kept(self) -> bool:
        """Whether the NC files under proof can be had back where they are not saved."""
        for page in proofs(self.app.desk):
            one = self.nc_keeping.kept.get(page.opening)
            if page.file is None or not page.unsaved:
                continue
            if one is None or one.journal is None:
                return False
            found = found_in(one.journal.path.read_bytes())
            if found is None or found.damaged or not same_text(found.listing, page.listing):
                return False
        return True

    @property
    def file(self) -> Path | None:
        """The file that the next life may find work on."""
        listings = (page.file for page in proofs(self.app.desk) if page.unsaved)
        return next(listings, None) or self.session.file

    def wrong(self, what: str) -> None:
        """Something is not as it must be; the last keys lead there."""
        self.tally.wrong.append(f"{type(self.app.desk.page).__name__}: {what} after {' '.join(self.trail[-30:])}")

    def die(self) -> None:
        """kill -9: only the handles are closed."""
        self.tally.deaths += 1
        for journal in (self.keeping.journal, *(one.journal for one in self.nc_keeping.kept.values())):
            if journal is not None:
                journal.close()


def same_text(one: NcText, other: NcText) -> bool:
    """Whether two listings are the same, with as much to undo."""
    return one.lines == other.lines and len(one.past) == len(other.past)


def text(line: list[tuple[str, Look]]) -> str:
    """A line's characters."""
    return "".join(character for character, _ in line)


def furnished(folder: Path) -> Path:
    """A folder with programs, one that is broken, an NC program and a tool table."""
    folder.mkdir(parents=True)
    for name in ("pocket", "plate-mm"):
        shutil.copy(files.example(name), folder / f"{name}.toml")
    (folder / "broken.toml").write_text("format = 1\nunits = 3\n")
    (folder / "part.nc").write_text(NC)
    (folder / "tool.tbl").write_text(TABLE)
    (folder / "deeper").mkdir()
    return folder


@dataclass
class Cage:
    """Where the monkey lives: its folder, and the programs that the next life may find."""

    folder: Path
    forgetful: Reference
    monkey: Monkey
    tally: Tally

    def live(self, number: int, keys: int, died: Path | None) -> Path | None:
        """One life; the file of a program that died with its work unsaved."""
        shop = furnished(self.folder / "shop" / str(number)) if died is None else died.parent
        with chdir(shop):
            life = self._begun(shop, died)
            try:
                life.go_on(keys)
            except BaseException:
                print(f"life {number}: {' '.join(life.trail[-60:])}", file=sys.stderr)
                raise
            self.tally.lives += 1
            file = life.file
            if life.app.left or file is None or self.monkey.chance.random() < 0.5:
                closed(life.keeping, life.nc_keeping)
                return None
            life.die()
            return file if self.folder in file.parents else None

    def _begun(self, shop: Path, died: Path | None) -> Life:
        """The program started: on a file, on none, on an example, on an NC program; on work that was left behind."""
        own = self.folder / "own"
        keeping, nc_keeping = Keeping(DEAD, own, lambda: TIME), NcKeeping(DEAD, own, lambda: TIME)
        start = self.monkey.chance.choice(("file", "none", "example", "locked", "proof", "proof"))
        if died is not None:
            start = "proof" if files.is_nc(died) else "file"
        listing = (died or shop / "part.nc") if start == "proof" else None
        file = (died or shop / "pocket.toml") if start in ("file", "locked") else None
        if start == "locked" and file is not None:
            take(file, ELSEWHERE)
        session = begin(file, "notch" if start == "example" else None)
        app = Reference(session, lambda desk: nc_keeping.keep(keeping.keep(desk)))
        keep_settings(app, first=start == "none")
        if listing is not None:
            page: Page = ProofPage.of(read_listing(listing), listing, alone=True)
            app.desk = nc_keeping.keep(replace(app.desk, pages=(page,)))
        return Life(app, keeping, nc_keeping, self.forgetful, self.monkey, self.tally)


def run(keys: int, seed: int) -> Tally:
    """So many keys; all files in a folder of its own, which is gone afterwards."""
    tally = Tally()
    with tempfile.TemporaryDirectory() as name:
        cage = Path(name).resolve()
        shutil.copytree(files.examples(), cage / "examples")
        own = {"XDG_CONFIG_HOME": f"{cage}/config", "XDG_STATE_HOME": f"{cage}/own", "HOME": name}
        # filing has the name of its own
        one, other = (patch.object(module, "examples", lambda: cage / "examples") for module in (files, filing))
        with patch.dict(os.environ, own), one, other:
            forgetful = Reference(Session.of(files.empty_program()))
            place = Cage(cage, forgetful, Monkey(random.Random(seed), cage, tally.coverage), tally)
            died = None
            while tally.keys < keys:
                died = place.live(tally.lives, min(LIFE, keys - tally.keys), died)
                tally.remember()
    return tally


async def through_textual(keys: int, seed: int) -> list[str]:
    """Keys through Textual itself: what its widget holds is what is drawn anew; returns what was wrong."""
    wrong: list[str] = []
    monkey = Monkey(random.Random(seed), Path("/nowhere"))
    app = app_on("pocket")
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        for number in range(keys):
            key = monkey.keys(app.desk)[0]
            safe = key not in ("ctrl+q", "ctrl+s", "ctrl+o", "f8") and len(app.desk.pages) < 4
            await pilot.press(_textual(key) if safe else "escape")
            if number % 5 == 4:
                wrong += differing(app.screen.query_one("Rows").rows, app.picture(80, 24), key)  # type: ignore[attr-defined]  # the one widget
    return wrong


def _textual(key: str) -> str:
    return key if key.isprintable() else "x"


def differing(shown: tuple[Row, ...], fresh: tuple[Row, ...], key: str) -> list[str]:
    """The first line that differs, in words."""
    pairs = zip(cells(shown), cells(fresh), strict=True)
    return [f"after {key}: {text(one)!r} instead of {text(other)!r}" for one, other in pairs if one != other][:1]


def main() -> int:
    """Print the report; exit status 1 when anything was wrong."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--keys", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--through-textual", type=int, default=500, help="keys that go through Textual")
    options = parser.parse_args()
    begun = time.perf_counter()
    tally = run(options.keys, options.seed)
    seconds = time.perf_counter() - begun
    tally.wrong += asyncio.run(through_textual(options.through_textual, options.seed))
    print("\n".join(report(tally, seconds)))
    return 1 if tally.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
