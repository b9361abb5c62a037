"""Dialogs of NC PROOF: the list of controls, and what every control does with a program."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, NamedTuple

from textual import on, work
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Vertical
from textual.content import Content
from textual.screen import ModalScreen
from textual.widgets import OptionList, Static
from textual.widgets.option_list import Option

from app.nc_proof.runs import Compared, Question, compare
from app.widgets.option_rows import OptionRows, control_rows
from app.widgets.plain import PlainText

if TYPE_CHECKING:
    from core.pipeline.checking import Answer


class ChooseControl(ModalScreen[str]):
    """The controls, each with a line about it; the result is a control's full name, empty for none."""

    BINDINGS: ClassVar[list[BindingType]] = [Binding("escape,f8,alt+8", "none", "Go back", show=False)]

    def __init__(self, here: str) -> None:
        super().__init__()
        self.here = here

    def compose(self) -> ComposeResult:
        """The list."""
        from core.controls.registry import choices

        with Vertical(id="controls-box", classes="wide-box"):
            yield OptionRows(*control_rows(choices()), id="controls")

    def on_mount(self) -> None:
        """The cursor on the control in use."""
        self.query_one("#controls-box").border_title = "CONTROL"
        controls = self.query_one("#controls", OptionList)
        rows = [row for row in range(controls.option_count) if controls.get_option_at_index(row).id == self.here]
        controls.highlighted = rows[0] if rows else 0

    @on(OptionList.OptionSelected)
    def _selected(self, event: OptionList.OptionSelected) -> None:
        self.dismiss(event.option_id or "")

    def action_none(self) -> None:
        """Go back."""
        self.dismiss("")


class Chosen(NamedTuple):
    """One of the controls compared, by its full name: the program runs on it, or its path is drawn `dotted`."""

    control: str
    dotted: bool


class CompareControls(ModalScreen["Chosen | None"]):
    """What every control does with a program; Enter takes one, Space draws its path dotted; None for neither."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("escape,f8,alt+8", "none", "Go back", show=False),
        Binding("space", "dotted", "Draw dotted", show=False),
    ]

    def __init__(self, question: Question) -> None:
        super().__init__()
        self.question = question
        self.answers: tuple[Answer, ...] = ()

    def compose(self) -> ComposeResult:
        """The list, empty until the controls have answered."""
        with Vertical(id="compare-box", classes="wide-box"):
            yield PlainText("Every control is running the program ...", id="compare-wait")
            yield OptionRows(id="compared")

    def on_mount(self) -> None:
        """Ask all controls."""
        box = self.query_one("#compare-box")
        box.border_title = "COMPARE CONTROLS"
        box.border_subtitle = "Enter takes a control, Space draws its path dotted"
        self._compare()

    @work(thread=True, exclusive=True, group="compare")
    def _compare(self) -> None:
        self.post_message(Compared(self.question, compare(self.question)))

    @on(Compared)
    def _compared(self, event: Compared) -> None:
        event.stop()
        self.query_one("#compare-wait").display = False
        self.answers = event.answers
        rows = self.query_one("#compared", OptionList)
        for answer in event.answers:
            good = "$c-warn" if answer.warnings else "$c-good"
            role = "$c-err" if answer.errors else "$c-label" if answer.moves is None else good
            outcome = answer.outcome if answer.errors else answer.outcome_and_warnings
            lines = [Content.assemble(f"{answer.name:<20}", (outcome, role))]
            more = answer.why_said or answer.parts
            lines += [Content.styled(f"    {more}", "$c-label")] if more else []
            rows.add_option(Option(Content("\n").join(lines), id=answer.control))
        rows.highlighted = 0
        rows.focus()

    @on(OptionList.OptionSelected)
    def _selected(self, event: OptionList.OptionSelected) -> None:
        self.dismiss(Chosen(event.option_id or "", dotted=False))

    def action_dotted(self) -> None:
        """Draw the path of the control with the cursor, unless it reads another language."""
        row = self.query_one("#compared", OptionList).highlighted
        if row is None:
            return
        answer = self.answers[row]
        if any(finding.code == "LANGUAGE" for finding in answer.findings):
            wait = self.query_one("#compare-wait", Static)
            wait.update(f"{answer.name} reads another language and has no path of this program to draw.")
            wait.display = True
        else:
            self.dismiss(Chosen(answer.control, dotted=True))

    def action_none(self) -> None:
        """Go back."""
        self.dismiss(None)
