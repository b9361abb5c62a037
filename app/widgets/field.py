"""This module holds the form and its fields: a label, a tag, and the widget that takes the value."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, ClassVar, Final

from rich.segment import Segment
from textual import events
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, Vertical
from textual.content import Content
from textual.geometry import Size
from textual.markup import escape
from textual.message import Message
from textual.reactive import Reactive, var
from textual.strip import Strip
from textual.widgets import Input, Label, Select

from app.widgets.plain import PlainLabel, PlainText

MAX_TYPED: int = 200
"""The most characters that a field takes; more come from a stuck key."""

NUMBER_SIGNS: Final = "+-./"
"""The signs of a number, which is no choice."""
LISTED_FIELDS: frozenset[str] = frozenset({"tool", "finish_tool", "lookahead"})
"""Number fields that open a list with Space: tools and look-ahead."""


class State(StrEnum):
    """The state of a field; the value is the style class of its row."""

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

    `full` is the text with every digit; a number field shows it while it has the cursor.  `choices` are the texts of
    a field that is picked from a list, in order; `text` is one of them, or empty, and then `full` is shown.
    A field that `folds` gives up its line while it is not visible; its choices may change.
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
    """An input line whose cursor does not blink, so that an idle terminal gets no bytes."""

    cursor_blink: Reactive[bool] = var(False, init=False)


class NumberField(LineInput):
    """An input line whose text is right-aligned, as on the control.

    `resting` and `full` are the value that the program holds, as the form prints it and with every digit.
    """

    letters: str = ""
    """Letters that are not part of a number; as the first character they are commands to the screen."""
    virtual_size: Reactive[Size] = Reactive(Size(0, 0), repaint=False)
    """The width of the text; it changes no layout, since the field's width in the form is fixed."""

    def __init__(self, name: str, text: str = "", full: str = "", *, id: str | None = None) -> None:
        # the style sheet sets the height: style classes for it and for validity would restyle each field three times
        super().__init__(text, name=name, id=id, max_length=MAX_TYPED, validate_on=())
        self.resting, self.full = text, full or text
        self._untouched = False
        self.softkey_digits = False
        """True while the digits 1 to 8 are softkeys and are not typed."""

    @dataclass
    class Letter(Message):
        """A command letter was typed."""

        letter: str

    def on_key(self, event: events.Key) -> None:
        """Post a command letter instead of typing it, unless the text is being edited."""
        self._untouched = False
        letter = (event.character or "").lower()
        if letter and letter in self.letters and not self.edited:
            event.stop()
            event.prevent_default()
            self.post_message(self.Letter(letter))

    @property
    def edited(self) -> bool:
        """True if the text differs from what the program holds."""
        return self.value.strip() not in (self.resting.strip(), self.full.strip())

    def check_consume_key(self, key: str, character: str | None) -> bool:
        """True if a key is typed: any printable one except ?, =, Space in a field with a list, and softkey digits."""
        if key in ("question_mark", "equals_sign") or (key == "space" and self.name in LISTED_FIELDS):
            return False
        if self.softkey_digits and key in tuple("12345678"):
            return False
        return super().check_consume_key(key, character)

    def show(self, text: str, full: str = "") -> None:
        """Show the value that the program holds; text that is being edited stays."""
        edited = self.edited
        self.resting, self.full = text, full or text
        if not edited:
            self.restore()

    def restore(self) -> None:
        """Discard what has been typed."""
        self._put(self.full if self.has_focus else self.resting)
        if self.has_focus:
            self.select_all()

    def _put(self, text: str) -> None:
        """Show a text that nobody has typed."""
        if self.value != text:
            with self.prevent(Input.Changed):
                self.value = text

    def on_mouse_up(self) -> None:
        """Select the value at the first click, as when a key brings the cursor; later clicks go into the text."""
        if self._untouched:
            self._untouched = False
            self.select_all()

    def on_focus(self) -> None:
        """Show every digit while the field has the cursor."""
        self._untouched = True
        if self.value == self.resting:
            self._put(self.full)

    def on_blur(self) -> None:
        """Show the digits of the form again."""
        if not self.edited:
            self._put(self.resting)

    def render_line(self, y: int) -> Strip:
        """Return the text right-aligned, with a cell for the cursor while the field has it.

        Without the cursor, a text that is too long is cut, and > marks the cut.
        """
        width = self.size.width
        if not self.has_focus and len(self.value) >= width > 0:
            text = self.value if len(self.value) == width else f"{self.value[: width - 1]}>"
            return Strip([Segment(text, self.rich_style)])
        strip = super().render_line(y)
        cursor = 1 if self.has_focus else 0
        blank = max(self.size.width - max(len(self.value), 1) - cursor - (1 - cursor), 0)
        if not blank:
            return strip
        return Strip([Segment(" " * blank, self.rich_style), *strip.crop(0, self.size.width - blank)])


class ChoiceField(Select[str], inherit_bindings=False):
    """A field with choices: Space opens the list, left and right step, letters select."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("space", "spell_or_list", "List", show=False),
        Binding("left", "step(-1)", "Choice before", show=False),
        Binding("right", "step(1)", "Next choice", show=False),
        Binding("delete,backspace", "blank", "Blank again", show=False),
    ]

    @dataclass
    class Blanked(Message):
        """The operator wants the choice blank again, which not every field allows."""

        name: str

    @dataclass
    class Unknown(Message):
        """Text was typed that is the beginning of no choice."""

        name: str
        typed: str

    def __init__(
        self, name: str, choices: Sequence[str], text: str = "", *, prompt: str = "", blank: bool = False
    ) -> None:
        self.choices = tuple(choices)
        self._spelled = ""
        self.refused = ""
        """What has been typed since the last choice, if no choice begins with it."""
        super().__init__(
            [(choice, choice) for choice in choices],
            prompt=escape(prompt) or "?",
            value=text if text in self.choices else Select.NULL,
            allow_blank=blank or text not in self.choices,
            compact=True,
            name=name,
        )

    def show(self, text: str, choices: Sequence[str] = (), prompt: str = "") -> None:
        """Show the choice that the program holds; replace the choices and the prompt if new ones are given."""
        with self.prevent(Select.Changed):
            if prompt:
                self.prompt = escape(prompt)
            if choices and tuple(choices) != self.choices:
                self.choices = tuple(choices)
                self.set_options([(choice, choice) for choice in choices])
            value: Any = text if text in self.choices else Select.NULL
            if value != self.value:
                # another one than was spelled, for example after an undo
                self.value, self._spelled = value, ""

    def action_step(self, by: int) -> None:
        """Go to the next or previous choice."""
        self.refused = ""
        here = self.choices.index(self.value) if self.value in self.choices else -1 if by > 0 else 0
        self.value = self.choices[(here + by) % len(self.choices)]

    def action_spell_or_list(self) -> None:
        """Open the list; but a space within a choice that is being spelled continues the spelling."""
        spelled = f"{self._spelled} "
        if self._spelled and self._choice_spelled(spelled) is not None:
            self._spelled = spelled
        else:
            self.action_show_overlay()

    def action_blank(self) -> None:
        """Post that the choice is to be blank again."""
        self.refused = ""
        self.post_message(self.Blanked(self.name or ""))

    def on_blur(self) -> None:
        """Forget the letters typed so far."""
        self._spelled = self.refused = ""

    def on_key(self, event: events.Key) -> None:
        """Select by letters: one goes to the next choice that begins with it, more of them spell it out."""
        if event.character is None or not (event.character.isalnum() or event.character in NUMBER_SIGNS):
            return
        event.stop()
        letter = event.character.upper()
        for spelled in (self._spelled + letter, letter):
            choice = self._choice_spelled(spelled)
            if choice is not None:
                self._spelled, self.value, self.refused = spelled, choice, ""
                return
        self.refused, self._spelled = f"{self.refused or self._spelled}{letter}", ""
        self.post_message(self.Unknown(self.name or "", self.refused))

    def _choice_spelled(self, spelled: str) -> str | None:
        current = self.choices.index(self.value) if self.value in self.choices else -1
        # the first letter searches after the current choice; several letters may match the current one too
        first = current + 1 if len(spelled) == 1 else max(current, 0)
        order = (*self.choices[first:], *self.choices[:first])
        return next((choice for choice in order if choice.startswith(spelled)), None)


class FieldLabel(PlainText):
    """A field's label, left-aligned, and its tag, right-aligned; one widget, since most fields have no tag."""

    def __init__(self, cell: Cell) -> None:
        super().__init__(classes="label")
        self.cell = cell

    def show(self, cell: Cell) -> None:
        """Show the label and the tag of a cell."""
        self.cell = cell
        self.refresh()

    def render(self) -> Content:
        """Return the label, blanks and the tag."""
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
        self._set_visible(cell)

    def _set_visible(self, cell: Cell) -> None:
        """Show or hide the row; a hidden row that folds takes no space."""
        if cell.folds:
            self.display = cell.visible
        else:
            self.visible = cell.visible

    def compose(self) -> ComposeResult:
        """Yield the label with the tag, and the widget of the value."""
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
        """The widget that takes the value; None if the row is read-only or not composed yet."""
        last = self.children[-1] if self.children else None
        return last if isinstance(last, NumberField | ChoiceField) else None

    def show(self, cell: Cell) -> None:
        """Show a cell; update only what has changed."""
        before, self.cell = self.cell, cell
        if not self.children:
            # not composed yet: compose will use this cell
            self.set_classes(f"field {cell.state}")
            self._set_visible(cell)
            return
        if cell.state is not before.state:
            self.remove_class(before.state)
            self.add_class(cell.state)
        if cell.visible is not before.visible:
            self._set_visible(cell)
        if cell.tag != before.tag:
            self.query_one(FieldLabel).show(cell)
        match self.input:
            case NumberField() as field:
                field.show(cell.text, cell.full)
            case ChoiceField() as field:
                field.show(cell.text, cell.choices, cell.full)
            case None if cell.text != before.text:
                self.query_one(".value", Label).update(cell.text, layout=False)


class Form(Horizontal):
    """Fields in two columns, in the order of their cells; the set of names never changes."""

    def __init__(self, cells: Sequence[Cell]) -> None:
        super().__init__(classes="fields")
        self.rows = {cell.name: FieldRow(cell) for cell in cells}

    def compose(self) -> ComposeResult:
        """Yield the columns."""
        last = max(row.cell.column for row in self.rows.values())
        for column in range(1 + last):
            with Vertical(classes=f"column {'-first' if not column else ''} {'-last' if column == last else ''}"):
                yield from (row for row in self.rows.values() if row.cell.column == column)

    def show(self, cells: Sequence[Cell]) -> None:
        """Show these cells; only rows that differ are updated."""
        for cell in cells:
            row = self.rows[cell.name]
            if row.cell != cell:
                row.show(cell)

    def field(self, name: str) -> NumberField | ChoiceField | None:
        """Return the field of this name; None if it is hidden or read-only, or if there is none."""
        row = self.rows.get(name)
        return row.input if row is not None and row.cell.visible else None
