"""The MILL CONTOUR screen: START and the segments of one block, keyed in field by field."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

from app.painted.messages import Edit, Move, Say
from app.painted.screens import contour_keys
from app.painted.screens.contour_cells import cells_at, fields_at, form_at, value_at
from app.painted.screens.forms import FormPage, prompt_of
from app.painted.screens.page import Answer, Softkeys, Surface, View
from app.painted.session import SEGMENT, Said, Session, Tone
from app.painted.widgets.field import press
from app.painted.widgets.form import cursor_line, form_rows
from app.painted.widgets.header import block_line, header, segment_line
from app.painted.widgets.rows import Row
from app.painted.widgets.verdict import NOT_YET
from core.finding import Finding, Severity
from core.program.edit import FormPlace, choose, type_field
from core.program.fields import SEGMENT_PROMPT, Field, read_typed
from core.program.solve.solved import Value
from core.units import Kind, sentence

WALK: Final = {"pageup": -1, "pagedown": 1, "left": -1, "right": 1}
FIRST_SEGMENT: Final = "Use ENTER to edit START, then right arrow or Page Down for the first segment."


@dataclass(frozen=True, eq=False, slots=True)
class Contour(FormPage):
    """A block's form; the cursor is the session's own.

    `added`: the segment was made by the last key, a letter.  Who ends that letter with Enter, as everything else here,
    would be on the second field without knowing it, and the next number would become Y END instead of X END: a wrong
    path that nobody sees.  So this one Enter goes nowhere and says so; whoever meant to go on presses it again.
    On DIRECTION, which shows its choice and takes no number, Enter takes what is shown as anywhere else.
    `held`: it has just done so.  Up then stays as well: it goes back over the Enter that was not taken.
    """

    added: bool = False
    held: bool = False

    def fields(self, session: Session) -> tuple[Field, ...]:
        """The fields of START or of the segment."""
        return fields_at(session)

    def cursor(self, session: Session) -> str:
        """The session's field, or SEGMENT where that is not shown (as the look-ahead while comp is ON)."""
        return SEGMENT if self.field(session) is None else session.field

    def field(self, session: Session) -> Field | None:
        """The session's field where that is shown."""
        return next((one for one in fields_at(session) if one.name == session.field), None)

    def moved(self, session: Session, name: str) -> Answer:
        """The session's cursor on another field."""
        return Answer(self, (Move(session.where, name),))

    def value(self, session: Session, name: str) -> Value | str:
        """What the field holds."""
        return value_at(session, name)

    def typed(self, session: Session, name: str) -> Value | str:
        """What was typed there, whatever was calculated."""
        held: Value | str = getattr(session.block if session.segment is None else session.segment, name)
        return held

    def edit(self, session: Session, one: Field, text: str) -> Edit:
        """The text read and put into the field."""
        typed = read_typed(text, one, session.program.unit)
        return Edit(type_field(session.program, session.where, one.name, typed), _label(one, session.where))

    def pick(self, session: Session, one: Field, choice: str) -> Answer:
        """CUTTER COMP., DIRECTION or a solution picked."""
        outcome = choose(session.program, session.where, one.name, choice)
        return Answer(self, (Edit(outcome, _label(one, session.where)),))

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """The first keys behind a new segment, then any key."""
        page, one = self._at_rest, self.field(session)
        if one is not None and self.added and key == "enter" and one.kind is not Kind.CHOICE:
            told = f"The cursor is still on {one.label}: type it, or Enter again goes on."
            return Answer(replace(page, held=True), (Say(told),))
        if one is not None and self.held and key in ("up", "shift+tab"):
            return Answer(page, (Say(f"{one.label} has the cursor: type it. Up again goes to SEGMENT."),))
        return page._pressed(key, character, session)

    def settle(self, session: Session) -> Answer:
        """The half-typed text taken; a half-typed segment number is forgotten."""
        page = self._at_rest
        if self.cursor(session) == SEGMENT:
            return Answer(page._without_text())
        return FormPage.settle(page, session)

    @property
    def _at_rest(self) -> Contour:
        """The page without what holds for the first key behind a new segment."""
        return replace(self, added=False, held=False) if self.added or self.held else self

    def _pressed(self, key: str, character: str | None, session: Session) -> Answer | None:
        """Walking from segment to segment, then what the field under the cursor does."""
        if key in ("pageup", "pagedown"):
            return self._walked(session, WALK[key])
        if key in ("ctrl+home", "ctrl+end"):
            there = 0 if key == "ctrl+home" else len(session.block.segments)
            return self._gone(session, FormPlace(session.where.block, there))
        if self.cursor(session) == SEGMENT:
            return self._segment_key(key, character, session)
        if key == "enter" and self.cursor(session) == self.fields(session)[-1].name and _leads_on(session):
            return self._finished(session)
        return FormPage.press(self, key, character, session)

    def _beyond(self, session: Session, key: str) -> Answer:
        """The next field round; SEGMENT stands before the first."""
        names = [SEGMENT, *(one.name for one in self.fields(session))]
        step = -1 if key in ("up", "shift+tab") else 1
        there = names[(names.index(self.cursor(session)) + step) % len(names)]
        return self._without_text().moved(session, there)

    def _finished(self, session: Session) -> Answer:
        """Enter on the last field of a segment: on to the next one.  On START only while there is none yet."""
        settled = self.settle(session)
        if any(isinstance(message, Say) for message in settled.messages):
            return settled
        beyond = contour_keys.advance(session)
        return Answer(settled.page, (*settled.messages, *beyond))

    def _walked(self, session: Session, step: int) -> Answer:
        settled = self.settle(session) if self.cursor(session) != SEGMENT else Answer(self._without_text())
        if any(isinstance(message, Say) for message in settled.messages):
            return settled
        there = contour_keys.advance(session) if step > 0 else contour_keys.back(session)
        return Answer(settled.page, (*settled.messages, *there))

    def _gone(self, session: Session, where: FormPlace) -> Answer:
        settled = self.settle(session)
        if any(isinstance(message, Say) for message in settled.messages):
            return settled
        return Answer(settled.page, (*settled.messages, Move(where)))

    def _segment_key(self, key: str, character: str | None, session: Session) -> Answer | None:
        """On SEGMENT: digits and Enter go to a segment, the arrows walk."""
        bare = self._without_text()
        if key in ("left", "right"):
            return bare._walked(session, WALK[key])
        if key == "enter" and self.editing is not None and self.editing.text:
            return Answer(bare, contour_keys.jump(session, self.editing.text))
        if key in ("enter", "tab", "down", "up", "shift+tab"):
            return bare._beyond(session, key)
        if key == "backspace" or (character is not None and character.isprintable() and character not in "? "):
            editing = press(self.editing, "", key, character)
            return Answer(replace(self, editing=editing if editing and editing.text else None))
        return None

    def softkeys(self, session: Session) -> Softkeys:
        """The softkeys of the field with the cursor."""
        return contour_keys.softkeys(session, self.cursor(session))

    def view(self, session: Session, surface: Surface) -> View:
        """The form as it stands."""
        one, cells = self.field(session), cells_at(session)
        cursor = SEGMENT if one is None else one.name
        return View(
            header(block_line(session), self._segment_line(session, on_it=one is None), session, surface.width),
            ((), *form_rows(cells, cursor, self.editing, surface.width), ()),
            self._prompt(session, one),
            1 + cursor_line(cells, cursor, surface.width),
        )

    def _segment_line(self, session: Session, *, on_it: bool) -> Row:
        typed = self.editing.text if on_it and self.editing is not None else None
        number = str(session.where.segment) if typed is None else typed
        return segment_line(number, form_at(session), cursor=on_it, typing=typed is not None)

    def _prompt(self, session: Session, one: Field | None) -> Said:
        if one is None:
            return Said(SEGMENT_PROMPT if session.block.segments else FIRST_SEGMENT)
        return self.reason(session) or _trouble(session, one) or Said(prompt_of(one))

    def help(self, session: Session) -> tuple[str, ...]:
        """The field's help, or that of SEGMENT."""
        return FormPage.help(self, session) or ("SEGMENT", SEGMENT_PROMPT)


def _trouble(session: Session, one: Field) -> Said | None:
    """An error that names this field; warnings stand with the verdict, so that the prompt stays."""
    for finding in session.found.findings if session.block.segments else _unmissed(session):
        if finding.field != one.name or finding.severity is not Severity.ERROR:
            continue
        if int(finding.segment or 0) == session.where.segment:
            tone = Tone.WARNING if finding.code in NOT_YET else Tone.ERROR
            return Said(sentence(finding, session.program.unit), tone)
    return None


def _unmissed(session: Session) -> list[Finding]:
    """What is to be said of a START without segments: not yet that it is incomplete."""
    return [one for one in session.found.findings if one.code not in NOT_YET]


def _leads_on(session: Session) -> bool:
    """Enter on the last field goes to the next segment; behind START only where that is the first one to be made."""
    return session.where.segment > 0 or not session.block.segments


def _label(one: Field, where: FormPlace) -> str:
    place = "START" if where.segment == 0 else f"segment {where.segment}"
    return f"{one.label} of {place}, block {where.block}"
