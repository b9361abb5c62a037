"""A monkey at the keyboard: `python -m tests.reports.monkey --keys 100000 --seed 1`.

Random keys go to the real App without a terminal, on programs, on HOME and on NC programs, on terminals of all sizes.
No key may raise; every few keys, when nothing is being calculated, the form must show what somebody makes who knows
the session alone, what was derived must belong to the program, the cursor must be in the form, the program must come
back equal from its file's text, and what is not saved from its journal, be it a program or an NC text.
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
import traceback
from collections.abc import Callable, Iterator
from contextlib import chdir
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar, Final
from unittest.mock import patch

from textual import events
from textual.errors import NoWidget
from textual.keys import _character_to_key
from textual.pilot import Pilot

from app.app import CutcompApp
from app.documents import programs as files
from app.documents.document import ContourDocument
from app.documents.document_service import DocumentService, Opened, Trouble
from app.documents.journal import Journal, Kind
from app.documents.lock import take
from app.documents.nc_text import NcText
from app.documents.settings import Settings, SettingsFile
from app.documents.unsaved_work import unsaved_work_on
from app.file_actions import session_of
from app.nc_proof.screen import ProofScreen
from app.screens.base import BaseScreen
from app.screens.contour import ContourScreen
from app.screens.contour_cells import cells_at
from app.screens.form_screen import FormScreen
from app.widgets.field import FieldRow
from core.program.file.read import loads
from core.program.file.write import dumps
from core.program.history import History
from tests.app.documents.typist import DEAD, ELSEWHERE, TIME
from tests.app.widget_pilot import SURROUNDINGS
from tests.reports.kill_parts import contour_work
from tests.reports.monkey_keys import Coverage, Monkey, Typist

ROOT: Final = Path(__file__).parents[2]
EVERY: Final = 20
"""Keys between two looks at everything."""
LIFE: Final = 300
"""Keys until another program is begun."""
LARGEST: Final = 40
"""Segments of a program; a larger one is given up, so that a key stays fast."""
NC: Final = "G20 G17 G90\nT1 M6\nG41 D1 G1 X0 Y0 F10\nX2\nY1\nX0\nY0\nG40 X-1\nM30\n"
TABLE: Final = "T1 P1 D0.5 ;end mill\nT2 P2 D0.25\nT3 P3 Dx ;not a number\n"
SMALLEST_TERMINAL: Final = (60, 20)
"""Columns and rows from which on a screen has room."""
PAGE: Final = 4096
MEGABYTE: Final = 1024 * 1024


@dataclass
class Tally:
    """What was done and seen; `acted` counts keys after which something was different; `memory` bytes after keys."""

    keys: int = 0
    acted: int = 0
    looks: int = 0
    lives: int = 0
    deaths: int = 0
    edits: int = 0
    coverage: Coverage = field(default_factory=Coverage)
    memory: list[tuple[int, int]] = field(default_factory=list)
    wrong: list[str] = field(default_factory=list)

    def remember(self) -> None:
        """How much memory is used now."""
        self.memory.append((self.keys, int(Path("/proc/self/statm").read_text().split()[1]) * PAGE))


class Observed(CutcompApp):
    """The App; leaving it ends a life and not the process."""

    CSS_PATH: ClassVar[str] = str(ROOT / "app" / "app.tcss")
    left = False

    def exit(self, *_: Any, **__: Any) -> None:
        self.left = True


def screens(kind: type[BaseScreen] = BaseScreen) -> Iterator[str]:
    """Names of all screens that can be reached: those that no other is made of."""
    below = [one for one in kind.__subclasses__() if one.__module__.startswith("app.")]
    for one in below:
        yield from screens(one)
    if not below:
        yield kind.__name__


def report(tally: Tally, seconds: float, seed: int) -> Iterator[str]:
    """The result, and what it rests on."""
    every = set(screens())
    reached = every & set(tally.coverage.screens)
    yield f"seed {seed}: {tally.keys} keys, {tally.acted} did something, {tally.edits} edits, {tally.looks} looks"
    yield f"{tally.lives} lives, {tally.deaths} deaths, {1000 * seconds / max(tally.keys, 1):.2f} ms a key"
    yield f"screens {len(reached)} of {len(every)}{_named(every - reached)}"
    pressed = tally.coverage.seen - set(tally.coverage.missing())
    missing = {f"{name} F{number} {words}".rstrip() for name, number, words in tally.coverage.missing()}
    yield f"softkeys {len(pressed)} of {len(tally.coverage.seen)}{_named(missing)}"
    if tally.memory:
        quarter = max(len(tally.memory) // 4, 1)
        first, last = (
            sorted(one for _, one in part)[quarter // 2] for part in (tally.memory[:quarter], tally.memory[-quarter:])
        )
        yield f"memory {first / MEGABYTE:.1f} MB in the first quarter, {last / MEGABYTE:.1f} MB in the last"
    yield from (f"WRONG: {text}" for text in tally.wrong[:20])
    yield f"failures {len(tally.wrong)}"


def _named(names: set[str]) -> str:
    return f", not {', '.join(sorted(names))}" if names else ""


def event_of(key: str) -> events.Key:
    """A key as the terminal's driver sends it."""
    if len(key) == 1:
        return events.Key(key if key.isalnum() and key.isascii() else _character_to_key(key), key)
    return events.Key(key, {"space": " ", "tab": "\t", "enter": "\r", "backspace": "\x7f", "escape": "\x1b"}.get(key))


@dataclass
class Life:
    """One program from its beginning to its end: the App, its service, the monkey."""

    app: Observed
    pilot: Pilot[int]
    service: DocumentService
    monkey: Monkey
    tally: Tally
    trail: list[str] = field(default_factory=list)

    async def go_on(self, keys: int) -> None:
        """Keys until the life is over."""
        last = self.tally.keys + keys
        while self.tally.keys < last and self.lives:
            for key in self.monkey.keys(self.app):
                if self.lives:
                    await self.press(key)

    @property
    def lives(self) -> bool:
        """Whether it goes on: nobody has left, nothing has been raised, the program is not too large."""
        program = self.app.session.program
        large = sum(len(block.segments) for block in program.blocks) > LARGEST or len(program.blocks) > 5
        return self.app.is_running and not self.app.left and not large

    def seen(self) -> tuple[object, ...]:
        """What a key may change."""
        app, focused = self.app, self.app.focused
        said = app.screen.notice if isinstance(app.screen, BaseScreen) else None
        held = [getattr(focused, name, None) for name in ("value", "cursor_position", "cursor_row", "highlighted")]
        text = [screen.document for screen in app.screen_stack if isinstance(screen, ProofScreen)]
        # a listing has no value: its place stands for it
        place = getattr(focused, "cursor_location", None)
        history, cursor = app.session.history, app.session.cursor
        return (app.screen, focused, said, *held, place, history, cursor, app.characters, app.screen.classes, *text)

    async def press(self, key: str) -> None:
        """One key, and now and then a look at everything."""
        app = self.app
        before, history = self.seen(), app.session.history
        self.monkey.coverage.look(app.screen)
        key = self.monkey.caged(app, key)
        self.monkey.coverage.press(app.screen, key)
        self.trail.append(key)
        app.post_message(event_of(key))
        await self.pilot.pause()
        self.tally.keys += 1
        self.tally.acted += any(
            one is not other and one != other for one, other in zip(before, self.seen(), strict=False)
        )
        self.tally.edits += app.session.history is not history
        if self.tally.keys % EVERY == 0 and self.lives:
            await self.look()

    async def look(self) -> None:
        """The form, the derived, the file's text, the journals; then somebody else may have written the file."""
        await self.settle()
        if not self.lives:
            return
        self.tally.looks += 1
        session = self.app.session
        if session.derived.program is not session.program:
            self.wrong("what was derived is of another program")
        for trouble in (*form_troubles(self.app), *self.lost()):
            self.wrong(trouble)
        if loads(dumps(session.program), "monkey") != session.program:
            self.wrong("the program does not come back from its file's text")
        self.monkey.meddle(session.file)
        if self.monkey.chance.random() < 0.1:
            await self.pilot.resize_terminal(*self.monkey.size())

    async def settle(self) -> None:
        """Until nothing is worked out that the form shows."""
        for _ in range(4):
            working = [worker for worker in self.app.workers if worker.group in ("derive", "table")]
            if working:
                await self.app.workers.wait_for_complete(working)
            await self.pilot.pause()

    def lost(self) -> Iterator[str]:
        """Work that is not saved and cannot be had back with its undo."""
        app = self.app
        documents: list[Any] = [app.document, *(proof.document for proof in app.proofs)]
        for document in documents:
            if not document.unsaved or document.file.holder is not None:
                continue
            kind = Kind.CONTOUR if isinstance(document, ContourDocument) else Kind.NC
            left = unsaved_work_on(document.file.path, kind, self.service.state)
            kept = [journal.work for _, journal in left if isinstance(journal, Journal)]
            if not any(same(work, document) for work in kept):
                yield f"the journal does not bring back the {'program' if kind is Kind.CONTOUR else 'NC text'}"

    def wrong(self, what: str) -> None:
        """Something is not as it must be; the last keys lead there."""
        self.tally.wrong.append(f"{type(self.app.screen).__name__}: {what} after {' '.join(self.trail[-40:])}")


def same(work: History | NcText, document: Any) -> bool:
    """Whether a journal holds what a document holds, with as much to undo."""
    if isinstance(work, History):
        return contour_work(work) == contour_work(document.history)
    return work.lines == document.text.lines and len(work.past) == len(document.text.past)


def form_troubles(app: CutcompApp) -> Iterator[str]:
    """What a form shows otherwise than the session has it, and a cursor that is nowhere."""
    screen = app.screen
    if isinstance(screen, FormScreen) and screen.names() and not in_sight(app):
        yield f"the cursor is nowhere, the focus on {app.focused} at {app.size}"
    if not isinstance(screen, ContourScreen):
        return
    if not screen.half_typed and app.displayed is not app.session:
        yield "a number is tried out that nobody types"
    shown = {row.cell.name or row.cell.label: row for row in screen.form().query(FieldRow)}
    # while a number is half-typed the others show what it would do
    for cell in cells_at(app.displayed if screen.half_typed else app.session):
        row = shown.get(cell.name or cell.label)
        if row is None or not cell.visible or (screen.half_typed and screen.current is row.input):
            continue
        there = row.cell
        if (there.text, there.state, there.tag) != (cell.text, cell.state, cell.tag):
            yield f"{cell.label} shows {there.text!r} {there.tag} instead of {cell.text!r} {cell.tag}"


def in_sight(app: CutcompApp) -> bool:
    """Whether the field with the cursor is seen; on a terminal that is too small nothing need be."""
    if app.focused is None or not app.focused.display:
        return False
    room = app.size.width >= SMALLEST_TERMINAL[0] and app.size.height >= SMALLEST_TERMINAL[1]
    try:
        return not room or bool(app.screen.find_widget(app.focused).visible_region)
    except NoWidget:
        return False


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
    monkey: Monkey
    tally: Tally

    async def live(self, number: int, keys: int, died: Path | None) -> Path | None:
        """One life; the file of a document that was left with its work unsaved."""
        shop = furnished(self.folder / "shop" / str(number)) if died is None else died.parent
        with chdir(shop):
            service = DocumentService(DEAD, self.folder / "own", lambda: TIME)
            app = self._begun(service, shop, died)
            trail: list[str] = []
            try:
                async with app.run_test(size=self.monkey.size()) as pilot:
                    life = Life(app, pilot, service, self.monkey, self.tally, trail)
                    await life.settle()
                    await life.go_on(keys)
            except Exception as error:  # noqa: BLE001 - whatever is raised is what is looked for
                where = traceback.extract_tb(error.__traceback__)[-1]
                told = f"{type(error).__name__}: {error} ({Path(where.filename).name}:{where.lineno})"
                self.tally.wrong.append(f"{told} after {' '.join(trail[-40:])}")
            self.tally.lives += 1
            return self._ended(app, service)

    def _ended(self, app: Observed, service: DocumentService) -> Path | None:
        """The end: in order, or with work left behind."""
        documents: list[Any] = [*(proof.document for proof in app.proofs), app.document] if app.screen_stack else []
        unsaved = [one.file.path for one in documents if one.unsaved and one.file.path is not None]
        service.stop()
        self.tally.deaths += bool(unsaved)
        file = next(iter(unsaved), None)
        return file if file is not None and self.folder in file.absolute().parents and not app.left else None

    def _begun(self, service: DocumentService, shop: Path, died: Path | None) -> Observed:
        """The program started: on a file, on none, on an example, on an NC program; on work that was left behind."""
        start = self.monkey.start()
        file = (
            shop / ("part.nc" if start == "proof" else "pocket.toml") if start in ("file", "locked", "proof") else None
        )
        file = died.absolute() if died is not None else file
        if start == "locked" and died is None and file is not None:
            take(file, ELSEWHERE)
        opened: Opened[Any] | Trouble = (
            service.open(file) if file else service.example("notch") if start == "example" else service.new(offers=True)
        )
        if isinstance(opened, Trouble):
            opened = service.new()
        document = opened.document if isinstance(opened.document, ContourDocument) else service.new().document
        return Observed(
            session_of(document),
            surroundings=SURROUNDINGS,
            service=service,
            opened=opened,
            settings_file=SettingsFile(self.folder / "settings.toml", Settings()),
            home=start == "none" and died is None,
        )


def run(keys: int, seed: int) -> Tally:
    """So many random keys."""
    return lived(keys, lambda cage, coverage: Monkey(random.Random(seed), cage, coverage))


def typed(*keys: str) -> Tally:
    """These keys, typed at a program."""
    return lived(len(keys), lambda cage, coverage: Typist(random.Random(1), cage, coverage, [*keys]))


def lived(keys: int, presses: Callable[[Path, Coverage], Monkey]) -> Tally:
    """So many keys; all files in a folder of its own, which is gone afterwards."""
    tally = Tally()
    with tempfile.TemporaryDirectory() as name:
        cage = Path(name).resolve()
        shutil.copytree(files.examples(), cage / "examples")
        own = {"XDG_CONFIG_HOME": f"{cage}/config", "XDG_STATE_HOME": f"{cage}/own", "HOME": name}
        with patch.dict(os.environ, own):
            place = Cage(cage, presses(cage, tally.coverage), tally)
            died = None
            while tally.keys < keys:
                died = asyncio.run(place.live(tally.lives, min(LIFE, keys - tally.keys), died))
                tally.remember()
    return tally


def main() -> int:
    """Print the report; exit status 1 when anything was wrong."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--keys", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    begun = time.perf_counter()
    tally = run(options.keys, options.seed)
    print("\n".join(report(tally, time.perf_counter() - begun, options.seed)))
    return 1 if tally.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
