"""What the kill report types: a contour program and an NC text, with the work there must be after every edit."""

from __future__ import annotations

import random
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from difflib import unified_diff
from pathlib import Path
from typing import Any, Final

from app.documents.document import ContourDocument, FileState
from app.documents.journal import Journal
from app.documents.nc_text import NcText
from app.documents.programs import empty_program
from app.file_actions import session_of
from app.screens.contour import NEW_SEGMENTS
from app.screens.contour_cells import RIGHT_COLUMN, fields_at, form_at, value_at
from app.session.session import Session
from core.program.edit import Edited, FormPlace, Refused, delete_segment, insert_segment, is_empty, type_field
from core.program.fields import read_typed
from core.program.file.write import dumps
from core.program.history import History
from core.program.model import Number, Program
from core.units import Kind

BYTES: Final = {
    "tab": b"\t",
    "shift+tab": b"\x1b[Z",
    "enter": b"\r",
    "up": b"\x1b[A",
    "down": b"\x1b[B",
    "home": b"\x1b[1~",
    "end": b"\x1b[4~",
    "pageup": b"\x1b[5~",
    "ctrl+home": b"\x1b[1;5H",
    "ctrl+end": b"\x1b[1;5F",
    "f1": b"\x1bOP",
    "ctrl+z": b"\x1a",
    "ctrl+y": b"\x19",
    "ctrl+s": b"\x13",
}
"""What a terminal sends for a key that is no character."""
NC: Final = b"G20 G17\r\nT1 M6\r\nG0 X0 Y0\r\nG1 X1.\r\nY1.\r\nX0\r\nY0\r\nM30\r\n"

Work = tuple[Any, ...]
"""Everything that can be undone and redone, for comparing."""


def bytes_of_key(key: str) -> bytes:
    """A key as bytes."""
    return BYTES.get(key) or key.encode()


@dataclass
class State:
    """The work after an edit; `shown` tells whether a screen shows it, `sure` that it is on the disk by then."""

    work: Work
    shown: Callable[[str], bool]
    sure: bool = True


@dataclass
class Part:
    """One document on its way through many crashes: its file, and its states since the start of the program.

    `acknowledged` is the index of the last state that the `screen` of the program had shown.
    """

    file: Path
    states: list[State] = field(default_factory=list)
    acknowledged: int = 0
    screen: str = ""

    def possible(self) -> list[Work]:
        """What may come back."""
        return [state.work for state in self.states[self.acknowledged :]]

    def acknowledge(self, text: str) -> None:
        """The first state from the last acknowledged one on that the screen may be showing."""
        for index in range(self.acknowledged, len(self.states)):
            if self.states[index].shown(text):
                last = index if self.states[index].sure else index - 1
                if last > self.acknowledged:
                    self.acknowledged, self.screen = last, text
                return

    # ---- what each kind of document has

    READY = ""
    """What stands on the screen when it can be typed into."""

    def begin(self, journal: Journal | None) -> None:
        """Go on from a journal, or from the file."""
        raise NotImplementedError

    def saving(self) -> None:
        """What a save does to the document before it writes it."""

    def next_keys(self, chance: random.Random) -> list[str]:
        """What the operator does next; the states that follow from it are added."""
        raise NotImplementedError

    def prepare(self) -> list[str]:
        """Keys after the start."""
        return []

    def saved_work(self) -> object:
        """What the file holds, without what can be undone."""
        raise NotImplementedError

    def content(self, work: Work) -> object:
        """What a file with this work holds."""
        raise NotImplementedError

    def work_of(self, journal: Journal) -> Work:
        """The work of a journal."""
        raise NotImplementedError

    def missing(self, found: object) -> str:
        """What the acknowledged state has otherwise, in words."""
        raise NotImplementedError


def shown_counts(text: str) -> tuple[int, int]:
    """How much the screen says can be undone and redone."""
    last = text.rstrip().splitlines()[-1] if text.strip() else ""
    undo, redo = (re.search(rf"\b{name} (\d+)", last) for name in ("undo", "redo"))
    return int(undo[1]) if undo else 0, int(redo[1]) if redo else 0


class ContourPart(Part):
    """A contour program; every edit begins on START, so that only its own fields count."""

    READY = "MILL CONTOUR"

    def begin(self, journal: Journal | None) -> None:
        document = ContourDocument.of(self._program(), FileState(self.file))
        self.session = session_of(document if journal is None else document.restored(journal))
        self.states, self.acknowledged = [], 0
        self._add()

    def _program(self) -> Program:
        if not self.file.exists():
            return empty_program()
        return ContourDocument.read(self.file.read_bytes(), FileState(self.file)).program

    def _add(self) -> None:
        history = self.session.history
        counts = history.undo_count, history.redo_count
        self.states.append(State(contour_work(history), lambda text: shown_counts(text) == counts))

    def saved_work(self) -> object:
        return self._program()

    def content(self, work: Work) -> object:
        return work[0]

    def work_of(self, journal: Journal) -> Work:
        assert isinstance(journal.work, History)
        return contour_work(journal.work)

    def missing(self, found: object) -> str:
        wanted = self.states[self.acknowledged].work[0]
        assert isinstance(found, Program)
        lines = unified_diff(dumps(found).splitlines(), dumps(wanted).splitlines(), "found", "wanted", n=0, lineterm="")
        return "\n".join(lines) or "The same program with another history."

    def next_keys(self, chance: random.Random) -> list[str]:
        kind = chance.choices(
            ("number", "segment", "delete", "undo", "redo", "save", "rubbish"), (10, 4, 1, 2, 1, 1, 1)
        )
        match kind[0]:
            case "number":
                return self._number(chance, f"{chance.uniform(-5, 20):.{chance.randint(1, 4)}f}")
            case "rubbish":
                return self._number(chance, "2..5")
            case "segment":
                return self._segment(chance.choice("lab"))
            case "delete":
                return self._delete()
            case "undo":
                return self._turn(undo=True, times=chance.randint(1, 4))
            case "redo":
                return self._turn(undo=False, times=chance.randint(1, 4))
            case _:
                self.saving()
                return ["ctrl+s"]

    def saving(self) -> None:
        self._take(self.session.without_empty())

    def _number(self, chance: random.Random, text: str) -> list[str]:
        """A text into a field of the left column before SOLUTION, which comes and goes and would take the digits."""
        last = len(self.session.block.segments)
        on_start = last == 0 or chance.random() < 0.5
        session = self._at(0 if on_start else last)
        fields = [each for each in fields_at(session) if each.name not in RIGHT_COLUMN[form_at(session)]]
        index = chance.choice([at for at, each in enumerate(fields) if each.kind not in (Kind.CHOICE, Kind.TEXT)])
        name = fields[index].name
        typed = read_typed(text, fields[index], session.program.unit)
        edited = type_field(session.program, session.place, name, typed)
        same = isinstance(typed, Number) and typed == value_at(session, name)
        if isinstance(edited, Refused) or same:
            return []
        self._take(session)
        self._edit(edited, f"{fields[index].label} of {'START' if on_start else f'segment {last}'}, block 1")
        begins_in_field = session.segment is not None and is_empty(session.segment)
        tabs = index if begins_in_field else index + 1
        return ["ctrl+home" if on_start else "ctrl+end", *["tab"] * tabs, *text, "tab"]

    def _at(self, segment: int) -> Session:
        """The cursor on another segment; a new one in which nothing was typed is gone then."""
        session = self.session
        if session.place.segment != segment:
            session = session.without_empty()
        return session.at(FormPlace(1, segment))

    def _take(self, session: Session) -> None:
        """A state more where the program is another one."""
        before, self.session = self.session, session
        if session.history is not before.history:
            self._add()

    def _edit(self, edited: Edited, label: str) -> None:
        if not isinstance(edited, Refused):
            self._take(self.session.with_program(edited, label))

    def _segment(self, letter: str) -> list[str]:
        """A new segment after the last one, or another kind of one in which nothing is typed."""
        last = len(self.session.block.segments)
        self._take(self._at(last))
        segment, place, program, new = self.session.segment, self.session.place, self.session.program, NEW_SEGMENTS
        if segment is None or not is_empty(segment):
            self._edit(insert_segment(program, FormPlace(1, last + 1), new[letter]()), f"new segment {last + 1}")
            self._take(self._at(last + 1))
            return ["ctrl+end", letter]
        without = delete_segment(program, place)
        assert not isinstance(without, Refused)
        self._edit(insert_segment(without, place, new[letter]()), "another kind of segment")
        # an empty segment begins in its first field; SEGMENT is before it
        return ["ctrl+end", "shift+tab", letter]

    def _delete(self) -> list[str]:
        last = len(self.session.block.segments)
        if not last:
            return []
        self._take(self._at(last))
        self._edit(delete_segment(self.session.program, FormPlace(1, last)), "delete")
        return ["ctrl+end", "f1"]

    def _turn(self, *, undo: bool, times: int) -> list[str]:
        for _ in range(times):
            self._take(self.session.undone() if undo else self.session.redone())
        return ["ctrl+z" if undo else "ctrl+y"] * times


def contour_work(history: History) -> Work:
    """The program with all before and after it, whatever the edits are called."""
    past, future = (tuple(step.program for step in steps) for steps in (history.past, history.future))
    return history.program, past, future


class NcPart(Part):
    """An NC text under NC PROOF; every edit begins on the first line."""

    READY = "NC PROOF"

    def begin(self, journal: Journal | None) -> None:
        text = NcText.read(self.file.read_bytes()) if journal is None else journal.work
        assert isinstance(text, NcText)
        self.text, self.count = text, 100 * len(text.past)
        self.states, self.acknowledged = [], 0
        self._add(sure=True)

    def _add(self, *, sure: bool) -> None:
        """The text as it is now.

        A text that undo has brought must show its counts too, since a half-typed number may look the same.
        """
        lines = [line.rstrip() for line in self.text.texts if line.strip()]
        counts = (len(self.text.past), len(self.text.future)) if sure else None

        def shown(text: str) -> bool:
            return shown_lines(text) == lines and counts in (None, shown_counts(text))

        self.states.append(State(nc_work(self.text), shown, sure))

    def prepare(self) -> list[str]:
        return ["f1"]

    def saved_work(self) -> object:
        return self.file.read_bytes()

    def content(self, work: Work) -> object:
        return work[0]

    def work_of(self, journal: Journal) -> Work:
        assert isinstance(journal.work, NcText)
        return nc_work(journal.work)

    def missing(self, found: object) -> str:
        return f"{found!r} instead of {self.states[self.acknowledged].work[0]!r}"

    def next_keys(self, chance: random.Random) -> list[str]:
        kind = chance.choices(("type", "split", "undo", "redo", "save"), (10, 2, 2, 1, 1))[0]
        match kind:
            case "type":
                return self._type(chance)
            case "split" if len(self.text.texts) < 14:
                return self._split(chance)
            case "undo" | "redo":
                return self._turn(undo=kind == "undo", times=chance.randint(1, 3))
            case _:
                return ["ctrl+s"]

    def _take(self, row: int, *lines: str) -> None:
        """Other lines in place of one."""
        texts = [*self.text.texts]
        texts[row : row + 1] = lines
        self.text = self.text.with_texts(texts)
        self._add(sure=False)

    def _type(self, chance: random.Random) -> list[str]:
        """A number before a line: taken when the cursor leaves it."""
        row = chance.randrange(len(self.text.texts) - 1)
        self.count += 1
        return self.type_before(row, f"N{self.count} ")

    def type_before(self, row: int, number: str) -> list[str]:
        """A number before a line, in place of one that it has."""
        old = self.text.text(row)
        rest = old.partition(" ")[2] if old.startswith("N") else old
        self._take(row, f"{number}{rest}")
        gone = len(old) - len(rest)
        return ["pageup", *["down"] * row, "home", *["\x1b[3~"] * gone, *number, "down"]

    def _split(self, chance: random.Random) -> list[str]:
        """A new line after another: two edits."""
        row = chance.randrange(len(self.text.texts) - 1)
        self.count += 1
        here = self.text.text(row)
        self._take(row, here, "")
        self._take(row + 1, f"M0 {self.count}")
        return ["pageup", *["down"] * row, "end", "enter", *f"M0 {self.count}", "up"]

    def _turn(self, *, undo: bool, times: int) -> list[str]:
        for _ in range(times):
            text = self.text.undo() if undo else self.text.redo()
            if text is not self.text:
                self.text = text
                self._add(sure=True)
        return ["ctrl+z" if undo else "ctrl+y"] * times


def nc_work(text: NcText) -> Work:
    """The lines, all lines that can be had by undo, and how many can be had by redo."""
    content, earlier = "".join(text.lines).encode(text.encoding), []
    before = text
    while before.past:
        before = before.undo()
        earlier.append(before.lines)
    return content, tuple(earlier), len(text.future)


def shown_lines(text: str) -> list[str]:
    """The lines of the listing that are not empty."""
    rows = (re.match(r" *\d+  ?(.{0,24}?)(?:  .*|[^ -~].*|)$", line) for line in text.splitlines())
    return [row[1].rstrip() for row in rows if row is not None and row[1].strip()]
