"""One field of a form: its label, its tag, and the widget that takes its value."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, ClassVar

from rich.segment import Segment
from textual import events
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal
from textual.content import Content
from textual.geometry import Size
from textual.markup import escape
from textual.message import Message
from textual.reactive import Reactive, var
from textual.strip import Strip
from textual.widgets import Input, Label, Select

from app.widgets.plain import PlainLabel, PlainText

MAX_TYPED: int = 200
"""Characters a field takes; more is a key that got stuck."""


LISTED: frozenset[str] = frozenset({"tool", "finish_tool", "lookahead"})
"""Numbers that have a list: tools, look-ahead values."""


class State(StrEnum):
    """What a field's value is; the value is the style class of its row."""

    TYPED = "-typed"
    CALCULATED = "-cal"
    USUAL = "-def"
    OVERRIDDEN = "-usr"
    NEEDED = "-needed"
    UNREAD = "-err"
    READ_ONLY = "-fixed"


@dataclass(frozen=True, slots=True)
class Cell:
    """A field as the form shows it.

    `full` is the text with every digit that was typed: the field shows it while it has the cursor.  `choices` are the
    texts of a field that is picked from a list, in order; `text` is one of them, or empty, and then `full` is shown.
    A field that `folds` gives its line away while it is not visible; its choices may change.
    """

    name: str
    label: str
    text: str
    column: int
    state: State = State.TYPED
    tag: str = ""
    full: str = ""
    choices: tuple[str, ...] = ()
    visible: bool = True
    folds: bool = False


class LineInput(Input):
    """A line of text whose cursor does not blink: a terminal at rest gets no bytes."""

    cursor_blink: Reactive[bool] = var(False, init=False)


class NumberField(LineInput):
    """A line of text whose value stands at the right edge, as on the control.

    `resting` is what the program holds; the value differs from it only while something is being typed.
    """

    letters: str = ""
    """Letters that are no part of a number: as the first character they are commands to the screen."""
    virtual_size: Reactive[Size] = Reactive(Size(0, 0), repaint=False)
    """The width of the text: its room in the form is fixed, so that a digit lays out nothing."""

    def __init__(self, name: str, text: str = "", full: str = "", *, id: str | None = None) -> None:
        # the style sheet makes it one line high; classes for that and for validity would style each field three times
        super().__init__(text, name=name, id=id, max_length=MAX_TYPED, validate_on=())
        self.resting, self.full = text, full or text
        self._untouched = False
        self.softkey_digits = False
        """Digits are softkeys and not typed."""

    @dataclass
    class Letter(Message):
        """A letter that is a command was typed."""

        letter: str

    def on_key(self, event: events.Key) -> None:
        """A letter that is a command is not typed."""
        self._untouched = False
        letter = (event.character or "").lower()
        if letter and letter in self.letters and not self.edited:
            event.stop()
            event.prevent_default()
            self.post_message(self.Letter(letter))

    @property
    def edited(self) -> bool:
        """Something has been typed that the program does not hold."""
        return self.value.strip() not in (self.resting.strip(), self.full.strip())

    def check_consume_key(self, key: str, character: str | None) -> bool:
        """Every printable key is typed, but ? asks for help, = calculates, and Space lists what a field takes."""
        if key in ("question_mark", "equals_sign") or (key == "space" and self.name in LISTED):
            return False
        if self.softkey_digits and key in tuple("12345678"):
            return False
        return super().check_consume_key(key, character)

    def show(self, text: str, full: str = "") -> None:
        """Show what the program holds; a half-typed text stays."""
        edited = self.edited
        self.resting, self.full = text, full or text
        if not edited:
            self.restore()

    def restore(self) -> None:
        """Forget what has been typed."""
        text = self.full if self.has_focus else self.resting
        if self.value != text:
            with self.prevent(Input.Changed):
                self.value = text
        if self.has_focus:
            self.select_all()

    def on_mouse_up(self) -> None:
        """The first click selects the value, as keys that bring the cursor do; another one goes into the text."""
        if self._untouched:
            self._untouched = False
            self.select_all()

    def on_focus(self) -> None:
        """Show every digit while the field has the cursor."""
        self._untouched = True
        if self.value == self.resting != self.full:
            with self.prevent(Input.Changed):
                self.value = self.full

    def on_blur(self) -> None:
        """Show the digits of the form again."""
        if not self.edited and self.value != self.resting:
            with self.prevent(Input.Changed):
                self.value = self.resting

    def render_line(self, y: int) -> Strip:
        """The text at the right edge, with a cell for the cursor while the field has it.

        Of a text that has no room there the first characters stand, and a sign that there are more.
        """
        room = self.size.width
        if not self.has_focus and len(self.value) >= room > 0:
            shown = self.value if len(self.value) == room else f"{self.value[: room - 1]}>"
            return Strip([Segment(shown, self.rich_style)])
        strip = super().render_line(y)
        cursor = 1 if self.has_focus else 0
        blank = max(self.size.width - max(len(self.value), 1) - cursor - (1 - cursor), 0)
        if not blank:
            return strip
        return Strip([Segment(" " * blank, self.rich_style), *strip.crop(0, self.size.width - blank)])


class ChoiceField(Select[str], inherit_bindings=False):
    """A choice: Space lists, left and right step, letters spell."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("space", "spell_or_list", "List", show=False),
        Binding("left", "step(-1)", "Choice before", show=False),
        Binding("right", "step(1)", "Next choice", show=False),
        Binding("delete,backspace", "blank", "Blank again", show=False),
    ]

    @dataclass
    class Blanked(Message):
        """The choice is to be blank again, which not every field can be."""

        name: str

    @dataclass
    class Unknown(Message):
        """A letter was typed that no choice begins with."""

        name: str
        letter: str

    def __init__(
        self, name: str, choices: Sequence[str], text: str = "", *, prompt: str = "", blank: bool = False
    ) -> None:
        self.choices = tuple(choices)
        self._spelled = ""
        super().__init__(
            [(choice, choice) for choice in choices],
            prompt=escape(prompt) or "?",
            value=text if text in self.choices else Select.NULL,
            allow_blank=blank or text not in self.choices,
            compact=True,
            name=name,
        )

    def show(self, text: str, choices: Sequence[str] = (), prompt: str = "") -> None:
        """Show the choice that the program holds, among other choices where they have changed, or the prompt."""
        with self.prevent(Select.Changed):
            if prompt:
                self.prompt = escape(prompt)
            if choices and tuple(choices) != self.choices:
                self.choices = tuple(choices)
                self.set_options([(choice, choice) for choice in choices])
            value: Any = text if text in self.choices else Select.NULL
            if value != self.value:
                self.value = value

    def action_step(self, by: int) -> None:
        """Go to the next choice, or to the one before."""
        here = self.choices.index(self.value) if self.value in self.choices else -1 if by > 0 else 0
        self.value = self.choices[(here + by) % len(self.choices)]

    def action_spell_or_list(self) -> None:
        """Open the list; between two words of a choice that is being spelled the blank belongs to it."""
        spelled = f"{self._spelled} "
        if self._spelled and self._choice_spelled(spelled) is not None:
            self._spelled = spelled
        else:
            self.action_show_overlay()

    def action_blank(self) -> None:
        """Take back what was picked."""
        self.post_message(self.Blanked(self.name or ""))

    def on_blur(self) -> None:
        """Begin another word the next time."""
        self._spelled = ""

    def on_key(self, event: events.Key) -> None:
        """Letters spell a choice: one goes to the next choice that begins with it, more go on spelling."""
        if event.character is None or not event.character.isalnum():
            return
        event.stop()
        letter = event.character.upper()
        for spelled in (self._spelled + letter, letter):
            choice = self._choice_spelled(spelled)
            if choice is not None:
                self._spelled, self.value = spelled, choice
                return
        self._spelled = ""
        self.post_message(self.Unknown(self.name or "", letter))

    def _choice_spelled(self, spelled: str) -> str | None:
        here = self.choices.index(self.value) if self.value in self.choices else -1
        # the first letter goes on from the choice that is held, a longer beginning may stay on it
        first = here + 1 if len(spelled) == 1 else max(here, 0)
        order = (*self.choices[first:], *self.choices[:first])
        return next((choice for choice in order if choice.startswith(spelled)), None)


class FieldLabel(PlainText):
    """A field's label at the left of its room and its tag at the right; one widget, since most fields have no tag."""

    def __init__(self, cell: Cell) -> None:
        super().__init__(classes="label")
        self.cell = cell

    def show(self, cell: Cell) -> None:
        """Show another tag."""
        self.cell = cell
        self.refresh()

    def render(self) -> Content:
        """Label, blanks, tag."""
        label, tag = self.cell.label, self.cell.tag
        if not tag:
            return Content(label)
        blank = max(self.size.width - len(label) - len(tag) - 1, 1)
        return Content.assemble(label, " " * blank, (tag, f"bold $c{self.cell.state}"))


class FieldRow(Horizontal):
    """A field with its label and its tag."""

    def __init__(self, cell: Cell) -> None:
        super().__init__(classes=f"field {cell.state}")
        self.cell = cell
        self._stand(cell)

    def _stand(self, cell: Cell) -> None:
        """Show the row or hide it; one that folds takes no room then."""
        if cell.folds:
            self.display = cell.visible
        else:
            self.visible = cell.visible

    def compose(self) -> ComposeResult:
        """Label, tag, value."""
        cell = self.cell
        yield FieldLabel(cell)
        if cell.state is State.READ_ONLY:
            yield PlainLabel(cell.text, classes="value")
        elif cell.choices or cell.folds:
            yield ChoiceField(cell.name, cell.choices, cell.text, prompt=cell.full, blank=cell.folds)
        else:
            yield NumberField(cell.name, cell.text, cell.full)

    @property
    def input(self) -> NumberField | ChoiceField | None:
        """The widget that takes the value, None of a row that only shows one."""
        last = self.children[-1] if self.children else None
        return last if isinstance(last, NumberField | ChoiceField) else None

    def show(self, cell: Cell) -> None:
        """Show what has changed, and nothing else."""
        before, self.cell = self.cell, cell
        if not self.children:
            # not composed yet: it will be with this cell
            self.set_classes(f"field {cell.state}")
            self._stand(cell)
            return
        if cell.state is not before.state:
            self.remove_class(before.state)
            self.add_class(cell.state)
        if cell.visible is not before.visible:
            self._stand(cell)
        if cell.tag != before.tag:
            self.query_one(FieldLabel).show(cell)
        match self.input:
            case NumberField() as field:
                field.show(cell.text, cell.full)
            case ChoiceField() as field:
                field.show(cell.text, cell.choices, cell.full)
            case None if cell.text != before.text:
                self.query_one(".value", Label).update(cell.text, layout=False)
