"""FormPage: what every screen with fields has in common, from the first character typed to the accepted value."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

from app.painted.messages import Edit, Say
from app.painted.screens.page import Answer, Page
from app.painted.session import Said, Session, Tone
from app.painted.widgets.field import Editing, press
from app.painted.widgets.form import Cell, State
from core.finding import Severity
from core.pipeline.derived import Tag
from core.program.edit import Refused
from core.program.fields import (
    SOLUTION,
    TYPE_AGAIN,
    Field,
    read_typed,
    text_refusal,
    unread_reason,
    unread_sentence,
    value_refusal,
)
from core.program.model import Number, Program, Relative, Unread
from core.program.solve.solved import Solved, Value
from core.units import Kind, Unit, sentence, show

FORWARD = ("enter", "tab", "down")
BACK = ("shift+tab", "up")
SHORT = 20
"""Characters of a text that is quoted."""


@dataclass(frozen=True, eq=False, slots=True)
class FormPage(Page):
    """A page with fields.

    `editing` is the half-typed text of the field with the cursor, `spelled` the letters typed into a choice so far.
    """

    editing: Editing | None = None
    spelled: str = ""

    def fields(self, session: Session) -> tuple[Field, ...]:
        """The fields the cursor can go to, in order."""
        raise NotImplementedError

    def cursor(self, session: Session) -> str:
        """The name of the field with the cursor."""
        raise NotImplementedError

    def moved(self, session: Session, name: str) -> Answer:
        """The cursor on another field."""
        raise NotImplementedError

    def value(self, session: Session, name: str) -> Value | str:
        """What a field holds: a number typed or calculated, or a choice's or a text's words."""
        raise NotImplementedError

    def typed(self, session: Session, name: str) -> Value | str:
        """What was typed into a field, of a program that nothing was derived from."""
        return self.value(session, name)

    def edit(self, session: Session, one: Field, text: str) -> Edit:
        """The edit that puts an accepted text into a field."""
        raise NotImplementedError

    def pick(self, session: Session, one: Field, choice: str) -> Answer:
        """A choice taken."""
        raise NotImplementedError

    def field(self, session: Session) -> Field | None:
        """The field with the cursor, None when the cursor is on none."""
        name = self.cursor(session)
        return next((one for one in self.fields(session) if one.name == name), None)

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """A key on a field: typing, picking, accepting, moving."""
        one = self.field(session)
        # a text may hold a question mark, but hardly begins with one
        if one is None or (character == "?" and (one.kind is not Kind.TEXT or self.editing is None)):
            return None
        if key in FORWARD or key in BACK:
            return self.accepted(session, key)
        if one.kind is Kind.CHOICE:
            return self._choice_key(session, one, key, character)
        shown = self.text(session, one) if self.editing is None else ""
        editing = press(self.editing, shown, key, character)
        return None if editing is None else Answer(replace(self, editing=editing))

    def accepted(self, session: Session, key: str) -> Answer:
        """The half-typed text taken, and the cursor moved unless the text was refused or cannot be read."""
        settled = self.settle(session)
        if any(isinstance(message, Say) for message in settled.messages):
            return settled
        beyond = self._beyond(session, key)
        return Answer(beyond.page, (*settled.messages, *beyond.messages))

    def settle(self, session: Session) -> Answer:
        """The half-typed text taken, the cursor where it is."""
        one, editing = self.field(session), self.editing
        done = self._without_text()
        if one is None or editing is None or editing.text.strip() == self.text(session, one):
            return Answer(done)
        edit = self.edit(session, one, editing.text)
        if isinstance(edit.outcome, Refused):
            # a look-ahead that is none leaves the old one, and nothing but the sentence tells of it; anything else
            # refused stays to be mended
            gone = one.name == "lookahead"
            return Answer(done if gone else self, (Say(edit.outcome.text, Tone.ERROR, stays=gone),))
        unread = None if one.kind is Kind.TEXT else read_typed(editing.text, one, session.program.unit)
        if isinstance(unread, Unread):
            return Answer(done, (edit, Say(_unread_sentence(unread, one, session.program.unit), Tone.ERROR)))
        return Answer(done, (edit,))

    def preview(self, session: Session) -> Program | None:
        """A number that can be read already is tried out while it is being typed."""
        one, editing = self.field(session), self.editing
        if one is None or editing is None or one.kind is Kind.TEXT or editing.text == self.text(session, one):
            return None
        if not isinstance(read_typed(editing.text, one, session.program.unit), Number):
            return None
        outcome = self.edit(session, one, editing.text).outcome
        return None if isinstance(outcome, Refused) else outcome

    def escape(self, session: Session) -> Answer | None:
        """The half-typed text forgotten: the field shows what it held.  Without one: what cannot be read taken back."""
        return self._reread(session) if self.editing is None else Answer(self._without_text())

    def forgetting(self) -> Self:
        """A number typed into one field never becomes that of another."""
        return self._without_text()

    def text(self, session: Session, one: Field) -> str:
        """What a field shows, in full where the form's decimals would lose some of what was typed."""
        held = self.value(session, one.name)
        if isinstance(held, Number):
            shown = show(held.value, one.kind, session.program.unit)
            return shown if float(shown) == held.value else f"{held.value:.12g}"
        return shown_text(held, one, session.program.unit)

    def _beyond(self, session: Session, key: str) -> Answer:
        names = [one.name for one in self.fields(session)]
        step = 1 if key in FORWARD else -1
        there = names[(names.index(self.cursor(session)) + step) % len(names)]
        return self._without_text().moved(session, there)

    def _without_text(self) -> Self:
        return replace(self, editing=None, spelled="")

    def _choice_key(self, session: Session, one: Field, key: str, character: str | None) -> Answer | None:
        held = str(self.value(session, one.name) or "")
        spelled = spelling(one, self.spelled, character)
        chosen = spelled_choice(one, held, spelled) if spelled else stepped_choice(one, held, key)
        if chosen is None and character is not None and character.isalnum():
            told = f"{one.label} has no choice with {character.upper()}: {', '.join(one.choices)}."
            return Answer(self._without_text(), (Say(told, Tone.ERROR),))
        return None if chosen is None else replace(self, spelled=spelled).pick(session, one, chosen)

    def _reread(self, session: Session) -> Answer | None:
        """A field marked ERR as it was before, or blank where nobody knows; None for any other field."""
        one = self.field(session)
        bad = None if one is None else self.typed(session, one.name)
        if one is None or not isinstance(bad, Unread) or session.guard.looking:
            return None
        from app.painted.screens.earlier import last_good

        text = last_good(session, one, self.typed)
        edit = self.edit(session, one, text)
        if isinstance(edit.outcome, Refused):
            return None
        now = f"{text} stands again" if text else "the field is blank"
        return Answer(self._without_text(), (edit, Say(f"{one.label}: {_short(bad.text)} is taken back, {now}.")))

    def reason(self, session: Session) -> Said | None:
        """Why the field with the cursor cannot be used as it stands, or that what is being typed does not count."""
        one = self.field(session)
        held = None if one is None else self.value(session, one.name)
        text = None if one is None else unusable(held, one, session.program.unit)
        return self._not_counted(session, one) if text is None else Said(text, Tone.ERROR)

    def _not_counted(self, session: Session, one: Field | None) -> Said | None:
        """Whose path and verdict are shown while there is half a text in the field that cannot be tried out."""
        if one is None or self.editing is None or one.kind is Kind.TEXT:
            return None
        typed, held = self.editing.text, self.text(session, one)
        if typed.strip() == held or isinstance(read_typed(typed, one, session.program.unit), Number | Relative):
            return None
        told = f"{_short(typed)} does not count" if typed.strip() else "A blank does not count before Enter"
        return Said(f"{told}: path and verdict are still those of {held or 'before'}.")

    def shared_trouble(self, session: Session) -> Said | None:
        """What the verdict on any block says of the field with the cursor, which belongs to all of them."""
        one, tones = self.field(session), {Severity.ERROR: Tone.ERROR, Severity.WARNING: Tone.WARNING}
        findings = (each for found in session.derived.blocks for each in found.findings if each.severity in tones)
        told = next((each for each in findings if one is not None and each.field == one.name), None)
        return None if told is None else Said(sentence(told, session.program.unit), tones[told.severity])

    def help(self, session: Session) -> tuple[str, ...]:
        """The prompt of the field, its range, and the keys that change it."""
        one = self.field(session)
        if one is None:
            return ()
        from app.painted.screens.field_help import field_help

        return field_help(one, session.program.unit)


def prompt_of(one: Field) -> str:
    """The field's prompt; a choice names its choices and how they are picked."""
    if one.kind is not Kind.CHOICE:
        return one.prompt
    if one == SOLUTION:
        return f"{one.prompt} Space steps, F1 and F2 pick."
    return f"{one.prompt} Space steps, letters spell: {', '.join(one.choices)}."


def _short(text: str) -> str:
    """What was typed, for a sentence that has to say more."""
    return text.strip() if len(text.strip()) <= SHORT else f"{text.strip()[:SHORT]}..."


def unusable(held: Value | str, one: Field, unit: Unit) -> str | None:
    """Why a field cannot be used as it stands: a text that cannot be read, a number that it does not take."""
    if isinstance(held, Unread):
        return _unread_sentence(held, one, unit)
    return value_refusal(one, held.value, unit) if isinstance(held, Number | Relative) else None


def _unread_sentence(unread: Unread, one: Field, unit: Unit) -> str:
    if outside := text_refusal(unread.text, one, unit):
        return outside
    if unread_reason(unread.text, one, unit) == TYPE_AGAIN:
        return f"{unread.text.strip()} has not been taken yet: type it again."
    return unread_sentence(unread)


def stepped_choice(one: Field, held: str, key: str) -> str | None:
    """The choice that an arrow or the space bar goes to."""
    choices = one.choices
    here = choices.index(held) if held in choices else -1
    if key in ("right", "space"):
        return choices[(here + 1) % len(choices)]
    if key == "left":
        return choices[(here - 1) % len(choices)] if here >= 0 else choices[-1]
    return None


def spelling(one: Field, before: str, character: str | None) -> str:
    """The letters of a choice typed so far, with this one: those that a choice begins with, else this one alone."""
    if character is None or not character.isprintable():
        return ""
    longer, alone = (before + character).upper(), character.upper()
    for text in (longer, alone):
        if text.strip() and any(choice.startswith(text) for choice in one.choices):
            return text
    return ""


def spelled_choice(one: Field, held: str, spelled: str) -> str:
    """A first letter goes to the next choice that begins with it, more letters to the one that is being spelled."""
    here = one.choices.index(held) if held in one.choices else -1
    ahead = (*one.choices[here + 1 :], *one.choices[: here + 1])
    order = ahead if len(spelled) == 1 else (held, *one.choices)
    return next(choice for choice in order if choice.startswith(spelled))


def shown_text(held: Value | str, one: Field, unit: Unit) -> str:
    """A value as a form prints it."""
    match held:
        case None:
            return ""
        case str(text):
            return text
        case Unread(text, _):
            return text
        case Relative(value):
            return f"I{show(value, one.kind, unit)}"
        case Number(value) | Solved(value):
            return show(value, one.kind, unit)


def cell_of(one: Field, held: Value | str, unit: Unit, column: int, line: int, *, needed: bool = False) -> Cell:
    """A field's cell with the tag and the state that its value gives it."""
    text = shown_text(held, one, unit)
    choice = one.kind is Kind.CHOICE
    match held:
        case Unread() | Number() | Relative() if unusable(held, one, unit) is not None:
            return Cell(one.name, one.label, text, column, line, State.UNREAD, "ERR", choice)
        case Solved():
            return Cell(one.name, one.label, text, column, line, State.CALCULATED, Tag.CAL, choice)
        case None if needed:
            return Cell(one.name, one.label, "?", column, line, State.NEEDED, "", choice)
        case _:
            return Cell(one.name, one.label, text, column, line, State.TYPED, "", choice)
