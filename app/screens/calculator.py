"""Calculator solves one of the shop's usual cases over the form; the chosen answer goes into the field."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from textual import on
from textual.app import ComposeResult
from textual.binding import BindingType
from textual.containers import Horizontal
from textual.widgets import Input, OptionList, Static

from app.screens.dialogs import LINES_UP_AND_DOWN, Dialog
from app.widgets.plain import PlainLabel, PlainText
from app.widgets.rows import OptionRows
from core.program.calculator import Case, Quantity, Refusal, calculate, field_text, outputs_for
from core.program.fields import Field
from core.units import Unit


class Calculator(Dialog[str]):
    """The inputs of a case and its answers; the result is the text of the chosen answer, empty for none.

    `typed` holds the typed texts by input name.
    """

    BINDINGS: ClassVar[list[BindingType]] = LINES_UP_AND_DOWN

    def __init__(self, case: Case, field: Field, unit: Unit, typed: Mapping[str, str]) -> None:
        super().__init__(f"{case.name}: {field.label}")
        self.case, self.field, self.unit = case, field, unit
        self.typed = dict(typed)
        self._texts: list[str] = []

    def compose_box(self) -> ComposeResult:
        """Lay out one line per input, then the answers, then the error."""
        for quantity in self.case.inputs:
            with Horizontal(classes="field"):
                yield PlainLabel(quantity.label, classes="label")
                yield Input(self.typed.get(quantity.name, ""), name=quantity.name, compact=True, classes="number")
        yield OptionRows(id="answers")
        yield PlainText(id="number-trouble")

    def on_mount(self) -> None:
        """Calculate with the texts of the last time."""
        self._show()

    @on(Input.Changed)
    def _typing(self, event: Input.Changed) -> None:
        self.typed[event.input.name or ""] = event.value
        self._show()

    def _show(self) -> None:
        """Show the answers for the typed texts, or why there are none."""
        results = calculate(self.case, self.typed, self.unit)
        refused = isinstance(results, Refusal)
        self.query_one("#number-trouble", Static).update(results.text if isinstance(results, Refusal) else "")
        answers = () if isinstance(results, Refusal) else results
        rows = [
            (quantity, field_text(answer[quantity.name], self.unit), number)
            for number, answer in enumerate(answers, 1)
            for quantity in outputs_for(self.case, self.field.kind)
            if quantity.name in answer and not self.typed.get(quantity.name, "").strip()
        ]
        self._texts = [text for _, text, _ in rows]
        options = self.query_one(OptionList)
        options.clear_options()
        of = f" of {len(answers)}" if len(answers) > 1 else ""
        options.add_options([f" {row.label:<18}{text:>14}   {number if of else ''}{of}" for row, text, number in rows])
        options.display = not refused
        options.highlighted = next((at for at, (row, _, _) in enumerate(rows) if self._fits(row)), 0) if rows else None

    def _fits(self, quantity: Quantity) -> bool:
        """Return whether an answer suits the field: X for X END, RADIUS for RADIUS."""
        name = self.field.name
        return quantity.name == name or (name[1] == "_" and quantity.name.startswith(name[:2]))

    @on(Input.Submitted)
    def _submitted(self, event: Input.Submitted) -> None:
        """Go to the next input; after the last one, to the answers or to the faulty input."""
        inputs = list(self.query(Input))
        after = inputs[inputs.index(event.input) + 1 :]
        results = calculate(self.case, self.typed, self.unit)
        if isinstance(results, Refusal):
            faulty = next((each for each in inputs if each.name == results.name), event.input)
            (after[0] if after else faulty).focus()
        elif after and not self.case.optional:
            after[0].focus()
        else:
            self.query_one(OptionList).focus()

    @on(OptionList.OptionSelected)
    def _selected(self, event: OptionList.OptionSelected) -> None:
        self.dismiss(self._texts[event.option_index])
