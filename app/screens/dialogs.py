"""Dialogs ask questions on top of the screen that they concern."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from textwrap import fill
from typing import Any, ClassVar, Final, TypeVar

from textual import events, on
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, Vertical
from textual.content import Content
from textual.screen import ModalScreen
from textual.widget import Widget
from textual.widgets import Input, OptionList, Static
from textual.widgets.option_list import Option

from app.documents.questions import GO_BACK, Answer
from app.widgets.field import LineInput
from app.widgets.plain import PlainLabel, PlainText
from app.widgets.rows import NamedRows, OptionRows
from core.units import Kind, Unit, Unreadable, parse

TALL = 16
"""Rows of the terminal from which a question has blank lines."""
ANSWER_WIDTH: Final = 46
"""Cells of an answer's line; what has no room goes below its first word."""
LINES_UP_AND_DOWN: Final[list[BindingType]] = [
    Binding("down", "app.focus_next", "Next", show=False),
    Binding("up", "app.focus_previous", "Before", show=False),
]
Result = TypeVar("Result")


class Dialog(ModalScreen[Result]):
    """A framed box on top of the screen that it concerns; Esc and F8 return `NOTHING`."""

    BINDINGS: ClassVar[list[BindingType]] = [Binding("escape,f8,alt+8", "none", "Go back", show=False)]
    NOTHING: ClassVar[Any] = ""

    def __init__(self, title: str, *, classes: str = "") -> None:
        super().__init__()
        self.question, self._box_classes = title, classes

    def compose(self) -> ComposeResult:
        """Lay out the box."""
        with Vertical(id="question", classes=self._box_classes):
            yield from self.compose_box()

    @abstractmethod
    def compose_box(self) -> ComposeResult:
        """Yield the widgets in the box."""

    def on_mount(self) -> None:
        """Set the title."""
        self.query_one("#question").border_title = self.question

    def action_none(self) -> None:
        """Go back."""
        self.dismiss(self.NOTHING)


class Question(Dialog[str]):
    """A question: its title, what would be lost, and the answers; the result is the word of the chosen answer.

    `safe` is the word of the preselected answer.  Esc and F8 answer GO BACK.
    """

    BINDINGS: ClassVar[list[BindingType]] = [Binding("ctrl+q", "none", "Go back", show=False)]
    NOTHING: ClassVar[str] = GO_BACK

    def __init__(self, title: str, lines: Sequence[str], answers: Sequence[Answer], safe: str) -> None:
        super().__init__(title)
        self.lines, self.safe = tuple(lines), safe
        self.answers = (*answers, Answer(GO_BACK, "nothing changes"))

    def compose_box(self) -> ComposeResult:
        """Lay out what would be lost, then one answer per line."""
        yield PlainText("\n".join(self.lines), id="loss")
        yield OptionRows(*(Option(_line(answer), id=answer.word) for answer in self.answers), id="answers")

    def on_mount(self) -> None:
        """Preselect the safe answer."""
        words = [answer.word for answer in self.answers]
        self.query_one(OptionList).highlighted = words.index(self.safe)

    @property
    def _box(self) -> Widget | None:
        """The frame; None before it is mounted and once the dialog is closing."""
        return next(iter(self.query("#question")), None)

    @property
    def readable(self) -> bool:
        """True if the whole question fits the terminal; otherwise the only answer accepted is GO BACK."""
        box = self._box
        return (
            box is not None and self.region.contains_region(box.region) and box.virtual_size.height <= box.size.height
        )

    @on(events.Resize)
    def _resized(self) -> None:
        if self._box is not None:
            self._box.set_class(self.size.height < TALL, "-tight")
            self.call_after_refresh(self._show_title)

    def _show_title(self) -> None:
        if self._box is not None:
            self._box.border_title = self.question if self.readable else "A QUESTION: MAKE THE WINDOW LARGER"

    @on(OptionList.OptionSelected)
    def _selected(self, event: OptionList.OptionSelected) -> None:
        if self.readable or event.option_id == GO_BACK:
            self.answer(event.option_id or GO_BACK)

    def on_key(self, event: events.Key) -> None:
        """Give the answer whose word begins with the letter."""
        letter = (event.character or "").upper()
        words = (answer.word for answer in self.answers[:-1] if letter and answer.word.startswith(letter))
        word = next(words, None)
        if word is not None and self.readable:
            event.stop()
            self.answer(word)

    def answer(self, word: str) -> None:
        """Close with the word of the chosen answer."""
        self.dismiss(word)


class Steps(Question):
    """A question at the top of the screen whose answers can be given again and again until Esc.

    `step` does what an answer says and returns the new line, or None where the answer closes the question.
    """

    def __init__(
        self, title: str, line: str, answers: Sequence[Answer], end: str, step: Callable[[str], str | None]
    ) -> None:
        super().__init__(title, [line], answers, answers[0].word)
        self.answers = (*answers, Answer(GO_BACK, end))
        self.step = step

    def answer(self, word: str) -> None:
        """Do the step and keep the cursor on it, so that Enter repeats it."""
        line = None if word == GO_BACK else self.step(word)
        if line is None:
            self.dismiss(word)
            return
        self.query_one("#loss", Static).update(line)
        self.query_one(OptionList).highlighted = [answer.word for answer in self.answers].index(word)


def _line(answer: Answer) -> str:
    key = "Esc" if answer.word == GO_BACK else answer.word[0]
    words = f" {key:<4}{answer.word}{f', {answer.effect}' if answer.effect else ''}"
    # a file's name must not look like two
    return fill(words, ANSWER_WIDTH, subsequent_indent=" " * 5, break_on_hyphens=False)


class Phrase(Dialog[str]):
    """A question that is answered by typing a phrase; Esc and F8 return an empty one.

    If `refusal` returns a text for a phrase, it is shown below and the question stays open.
    """

    def __init__(self, title: str, lines: Sequence[str], refusal: Callable[[str], str] | None = None) -> None:
        super().__init__(title)
        self.lines, self.refusal = tuple(lines), refusal

    def compose_box(self) -> ComposeResult:
        """Lay out the question, then the input line."""
        yield PlainText("\n".join(self.lines), id="loss")
        yield LineInput(id="phrase", compact=True)
        yield PlainText(id="phrase-trouble")

    @on(Input.Submitted)
    def _submitted(self, event: Input.Submitted) -> None:
        if self.refusal is not None and (refused := self.refusal(event.value)):
            self.query_one("#phrase-trouble", Static).update(refused)
        else:
            self.dismiss(event.value)


@dataclass(frozen=True, slots=True)
class NumberEntry:
    """A line of a small form: its label, its kind of number, its initial text, and its largest value, if limited.

    If `most` is given, the smallest value is zero.
    """

    label: str
    kind: Kind
    text: str = "0"
    most: float | None = None

    def read(self, text: str, unit: Unit) -> float | Unreadable:
        """Read a number in program units."""
        value = parse(text, self.kind, unit)
        if self.most is not None and isinstance(value, float) and not 0.0 <= value <= self.most:
            return Unreadable(f"{self.label} is from 0 to {self.most:g} {unit}.")
        return value


class NumberForm(Dialog[tuple[float, ...]]):
    """A form for a few numbers; Enter on the last one takes them, Esc and F8 return an empty tuple.

    Unreadable text keeps the cursor and an error appears below, as does what `refusal` returns for all numbers.
    """

    BINDINGS: ClassVar[list[BindingType]] = LINES_UP_AND_DOWN
    NOTHING: ClassVar[tuple[float, ...]] = ()

    def __init__(
        self,
        title: str,
        lines: Sequence[str],
        entries: Sequence[NumberEntry],
        unit: Unit,
        refusal: Callable[..., str] | None = None,
    ) -> None:
        super().__init__(title)
        self.lines, self.entries, self.unit = tuple(lines), tuple(entries), unit
        self.refusal = refusal

    def compose_box(self) -> ComposeResult:
        """Lay out the explanation, then one line per number."""
        yield PlainText("\n".join(self.lines), id="loss")
        for number, entry in enumerate(self.entries):
            with Horizontal(classes="field"):
                yield PlainLabel(entry.label, classes="label")
                yield LineInput(entry.text, id=f"number-{number}", classes="number", compact=True)
        yield PlainText(id="number-trouble")

    def on_mount(self) -> None:
        """Show the keys in the frame."""
        self.query_one("#question").border_subtitle = "Enter: next   Esc: back"

    @on(Input.Submitted)
    def _submitted(self, event: Input.Submitted) -> None:
        """Read the number and go to the next one; after the last one, read all of them again."""
        inputs, trouble = list(self.query(Input)), self.query_one("#number-trouble", Static)
        here, numbers = inputs.index(event.input), []
        last = here + 1 == len(inputs)
        for at in range(0 if last else here, here + 1):
            value = self.entries[at].read(inputs[at].value, self.unit)
            if isinstance(value, Unreadable):
                inputs[at].focus()
                trouble.update(value.reason)
                return
            numbers.append(value)
        refused = self.refusal(*numbers) if last and self.refusal is not None else ""
        trouble.update(refused)
        if not last:
            inputs[here + 1].focus()
        elif not refused:
            self.dismiss(tuple(numbers))


class ChooseLine(Dialog[str]):
    """A list to choose from, with the cursor on option `here`; the result is an option's id, empty on Esc and F8.

    Letters and digits move the cursor to the next option whose text or id begins with them.
    """

    def __init__(self, title: str, options: Sequence[Option], here: str = "", *, classes: str = "") -> None:
        super().__init__(title, classes=classes)
        self.options, self.here = tuple(options), here

    def compose_box(self) -> ComposeResult:
        """Lay out the list."""
        yield NamedRows(*self.options, id="answers")

    def on_mount(self) -> None:
        """Put the cursor on option `here`, else on the first one."""
        ids = [option.id for option in self.options]
        if ids:
            self.query_one(OptionList).highlighted = ids.index(self.here) if self.here in ids else 0

    @on(OptionList.OptionSelected)
    def _selected(self, event: OptionList.OptionSelected) -> None:
        self.dismiss(event.option_id or "")

    # in the frame, since the box may cover the prompt

    @on(OptionList.OptionHighlighted)
    def _moved(self) -> None:
        self.query_one("#question").border_subtitle = ""

    @on(NamedRows.Unknown)
    def _unknown(self, event: NamedRows.Unknown) -> None:
        self.query_one("#question").border_subtitle = f"No line begins with {event.letters}"


class ChooseSeveral(Dialog["frozenset[str] | None"]):
    """A list for choosing several rows: Space marks, Enter takes the marked rows; Esc and F8 return None.

    `chosen` holds the rows that are marked at first.
    """

    BINDINGS: ClassVar[list[BindingType]] = [Binding("space", "mark", "Mark", show=False)]
    NOTHING: ClassVar[None] = None

    def __init__(self, title: str, rows: Sequence[str], chosen: Collection[str]) -> None:
        super().__init__(title)
        self.rows, self.chosen = tuple(rows), set(chosen)

    def compose_box(self) -> ComposeResult:
        """Lay out the list."""
        yield PlainText("Space marks, Enter takes what is marked.", id="loss")
        yield OptionRows(*(Option(self._marked(row)) for row in self.rows), id="answers")

    def on_mount(self) -> None:
        """Put the cursor on the first row."""
        self.query_one(OptionList).highlighted = 0 if self.rows else None

    def _marked(self, row: str) -> Content:
        return Content(f"[{'x' if row in self.chosen else ' '}] {row}")

    def action_mark(self) -> None:
        """Mark or unmark the row with the cursor."""
        answers = self.query_one(OptionList)
        if (at := answers.highlighted) is not None:
            self.chosen ^= {self.rows[at]}
            answers.replace_option_prompt_at_index(at, self._marked(self.rows[at]))

    @on(OptionList.OptionSelected)
    def _selected(self) -> None:
        self.dismiss(frozenset(self.chosen))
