"""POST NC: the name of the NC file, what stands against posting, and the sentence that posts in spite of it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from textwrap import wrap
from typing import ClassVar, Self

from app.documents.naming import typed, with_suffix
from app.painted.messages import Close, Message, Post, Say, Swap
from app.painted.own_post import OwnPost, OwnPosted
from app.painted.screens.entry import EntryPage, entry_row
from app.painted.screens.page import Answer, Layout, Page, Softkey, Softkeys, Surface, View
from app.painted.screens.text import fitting
from app.painted.session import Said, Session, Tone
from app.painted.widgets.field import Editing
from app.painted.widgets.header import header
from app.painted.widgets.rows import Look, Row, Span, plain
from app.painted.widgets.verdict import UNKNOWN
from app.painted.widgets.words import length, numbers, placed, segment
from core.finding import Finding, Severity
from core.output.objections import OVERRIDABLE, OVERRIDE
from core.units import sentence


@dataclass(frozen=True, eq=False, slots=True)
class PostPage(EntryPage):
    """First the file's name in `entry`; then, with `path` known, the sentence that overrides.

    `asked` is for the control that compensates by itself, `told` what its program meets once that is known; None posts
    the path of the tool's center.
    """

    layout: ClassVar[Layout] = Layout.TEXT
    path: Path | None = None
    asked: OwnPost | None = None
    told: OwnPosted | None = None

    @property
    def control(self) -> str | None:
        """The control's full name."""
        return None if self.asked is None else self.asked.control

    @property
    def question(self) -> OwnPost | None:
        """Whether the control's program can be posted, until that is known."""
        return self.asked if self.told is None else None

    def hearing(self, answer: object) -> Page:
        """Whether it can; of a control chosen before nothing is told."""
        if not isinstance(answer, OwnPosted) or answer.asked is not self.asked:
            return self
        return replace(self, told=answer)

    @classmethod
    def of(cls, session: Session) -> Self:
        """The page with the program's name and the suffix .nc."""
        name = Path("part.nc") if session.file is None else session.file.with_suffix(".nc")
        return cls(Editing.of(str(name)))

    def softkeys(self, session: Session) -> Softkeys:
        """Post, or not; for whom."""
        keys = {1: Softkey("POST", self._posted(session).messages), 8: Softkey("CANCEL", (Close(),))}
        if self.path is None:
            before, on = self._stepped(session, -1), self._stepped(session, 1)
            keys |= {3: Softkey("NEXT CONTROL", on), 4: Softkey("CONTROL BEFORE", before)}
        return keys

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """Enter takes the name, or the sentence; up and down choose the control."""
        if self.path is None and key in ("up", "down"):
            return Answer(self, self._stepped(session, 1 if key == "down" else -1))
        return self._posted(session) if key == "enter" else self.typed(key, character)

    def softkeyed(self, session: Session, number: int, messages: tuple[Message, ...]) -> Answer:
        """POST is Enter."""
        return self._posted(session) if number == 1 else Answer(self, messages)

    def _stepped(self, session: Session, step: int) -> tuple[Message, ...]:
        """The next choice of control; their rules need the numeric library, which the start does not wait for."""
        from core.controls.registry import names

        choices = (None, *names())
        control = choices[(choices.index(self.control) + step) % len(choices)]
        asked = None if control is None else OwnPost(session.program, control)
        return (Swap(replace(self, asked=asked, told=None)),)

    def _posted(self, session: Session) -> Answer:
        text = self.entry.text.strip()
        if self.path is not None:
            return Answer(replace(self, fresh=True), self._overridden(text))
        if not text:
            return self.accepted((Say("Type a name for the NC file.", Tone.ERROR),))
        path = with_suffix(typed(text), ".nc")
        if self.control is None and (first := to_mend(session)):
            return self.accepted((Say(_mend(first, session), Tone.ERROR),))
        if self.control is None and errors(session):
            return Answer(replace(self, path=path, entry=Editing("", 0), fresh=False))
        if self.told is not None and self.told.against:
            told = placed(self.told.against[0], session.program.unit)
            return self.accepted((Say(f"Nothing was written: {told}", Tone.ERROR),))
        return self.accepted((Post(path, control=self.control, clear=self.told is not None),))

    def _overridden(self, text: str) -> tuple[Message, ...]:
        assert self.path is not None
        if text != OVERRIDE:
            return (Say(f"Nothing was written. Type {OVERRIDE} to post in spite of the findings, or Esc.", Tone.ERROR),)
        return (Post(self.path, override=text),)

    def view(self, session: Session, surface: Surface) -> View:
        """The name, the findings, and where they are errors the sentence."""
        against = errors(session)
        rows = [entry_row("FILE", self.entry, surface.width, fresh=self.replaced), (), *self._chosen()]
        said = Said("Type the name of the NC file, Enter posts. Up and down choose the control.")
        if self.asked is not None:
            if self.told is not None and self.told.against:
                said = Said(f"Nothing can be posted for {self.control}: what is listed is against it.", Tone.WARNING)
        elif self.path is not None:
            rows = [
                plain(f" FILE {self.path}"),
                entry_row("SAY", self.entry, surface.width, fresh=self.replaced),
            ]
            said = Said(
                f"Posting is refused. To post in spite of it, type {OVERRIDE} and Enter; the file will say so.",
                Tone.ERROR,
            )
        elif to_mend(session):
            said = Said("This cannot be posted yet: Esc goes back, mend what is named here.", Tone.WARNING)
        elif against:
            said = Said("Enter the name of the NC file. The findings stand against posting.", Tone.WARNING)
        told = _against(against, session, surface.width) if self.asked is None else self._met(session, surface.width)
        body = ((), *rows, (), *_unsaved(session), *_left(session))
        body = (*body, *fitting(told, surface.body - len(body), "And more: Ctrl+F on a block's form tells all."))
        return View(header("POST NC", plain(""), session, surface.width), body, said, 1)

    def _met(self, session: Session, width: int) -> tuple[Row, ...]:
        """What the program of the chosen control meets: what forbids it, or what is to be said with it."""
        if self.told is None:
            return tuple(_wrapped(f"What {self.control} refuses is being calculated.", width, Look.WARNING))
        unit = session.program.unit
        against = [row for one in self.told.against for row in _wrapped(f"!! {placed(one, unit)}", width, Look.ERROR)]
        if against:
            return tuple(against)
        notes = [
            row
            for one in self.told.notes
            for mark, look in [("i", Look.LABEL) if one.severity is Severity.INFO else ("!", Look.WARNING)]
            for row in _wrapped(f"{mark} {placed(one, unit)}", width, look)
        ]
        return (plain(" Nothing stands against posting.", Look.GOOD), *notes)

    def _chosen(self) -> tuple[Row, ...]:
        """The control, and what that means."""
        name, text = "none", "The tool center's path, without G41 or G42."
        if self.control is not None:
            name, text = (
                self.control,
                "The contour as typed; this control compensates it.",
            )
        return (Span(" CONTROL ", Look.HEAD), Span(name, Look.TYPED)), plain(f" {text}", Look.LABEL)


def errors(session: Session) -> tuple[tuple[int, Finding], ...]:
    """Block and finding of everything that stands against posting."""
    return tuple((found.number, finding) for found in session.derived.blocks for finding in found.errors)


def to_mend(session: Session) -> tuple[tuple[int, Finding], ...]:
    """What of it no words override: it has to be mended first."""
    return tuple(one for one in errors(session) if one[1].code not in OVERRIDABLE)


def _mend(left: tuple[tuple[int, Finding], ...], session: Session) -> str:
    """The first thing to mend, and how many more there are."""
    block, finding = left[0]
    more = f" {len(left) - 1} more are listed." if len(left) > 1 else ""
    return f"Nothing was written. Mend this first: {_where(block, finding)}: {_told(finding, session)}{more}"


def _where(block: int, finding: Finding) -> str:
    return f"block {block}" + (f", {segment(finding.segment)}" if finding.segment else "")


def _told(finding: Finding, session: Session) -> str:
    return sentence(finding, session.program.unit)


def _unsaved(session: Session) -> tuple[Row, ...]:
    return (plain(" The program is not saved: Esc, then Ctrl+S.", Look.WARNING),) if session.unsaved else ()


def _left(session: Session) -> tuple[Row, ...]:
    """One line on what the cutters leave uncut, one on the segments they delete."""
    unit, uncut, deleted = session.program.unit, list[str](), list[str]()
    for found in session.derived.blocks:
        work, where = found.paths, f"block {found.number}"
        if work is not None and work.verdict is not None and work.verdict.uncut:
            uncut.append(f"{where} {length(work.verdict.uncut_length, unit)}")
        if work is not None and work.compensated is not None and work.best is None:
            erased = numbers(work.compensated.deleted.segments.tolist())
            deleted += [f"{where} segments {erased}"] if erased else []
    told = (("UNCUT", uncut), ("DELETED", deleted))
    return tuple(plain(f" {word:<8}{', '.join(texts)}", Look.WARNING) for word, texts in told if texts)


def _against(against: tuple[tuple[int, Finding], ...], session: Session, width: int) -> tuple[Row, ...]:
    known = all(found.known for found in session.derived.blocks)
    clear = [plain(" Nothing stands against posting.", Look.GOOD)] if known and not against else []
    rows = clear if known else [UNKNOWN]
    for block, finding in (*against, *_warnings(session)):
        mark, look = ("!!", Look.ERROR) if finding.severity is Severity.ERROR else ("! ", Look.WARNING)
        rows += _wrapped(f"{mark} {_where(block, finding)}: {_told(finding, session)}", width, look)
    return tuple(rows)


def _warnings(session: Session) -> Iterator[tuple[int, Finding]]:
    """What is posted all the same, and should be known before."""
    for found in session.derived.blocks:
        yield from ((found.number, one) for one in found.findings if one.severity is Severity.WARNING)


def _wrapped(text: str, width: int, look: Look) -> list[Row]:
    """A sentence behind its mark."""
    return [plain(f" {line}", look) for line in wrap(text, max(width - 2, 8), subsequent_indent="   ")]
