"""This module holds PROGRAM PARAMETERS, such as unit, blends, allowances and posted path, and PART SETUP."""

from __future__ import annotations

from typing import ClassVar, Final

from textual import on, work
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, Vertical
from textual.events import DescendantFocus
from textual.widgets import Select

from app.documents.questions import Answer
from app.screens.dialogs import Question
from app.screens.field_texts import cell_of
from app.screens.form_screen import FormScreen
from app.session.messages import Sentence, Tone
from app.session.session import Session
from app.widgets.field import Cell, ChoiceField, Form
from app.widgets.plain import PlainLabel
from app.widgets.softkeys import Softkey
from core.program.edit import Edited, set_parameter, set_path_choice, set_setup, set_unit
from core.program.fields import PARAMETERS, SETUP, Field, default_value, read_typed
from core.program.model import PathChoice
from core.program.solve.solved import Origin, Solved, Value
from core.units import Kind, Unit, show

UNITS: Final = Field(
    "unit",
    "UNITS",
    Kind.CHOICE,
    "Unit of the program. Another one converts every typed length and feed.",
    choices=tuple(unit.value for unit in Unit),
)
ROWS: Final = 6
"""Fields per column."""


class SettingsForm(FormScreen):
    """A screen with one form of program-wide fields; a blank field shows its default value, tagged DEF."""

    NAME: ClassVar[str] = ""
    FIELDS: ClassVar[tuple[Field, ...]] = ()
    BINDINGS: ClassVar[list[BindingType]] = [Binding("escape", "leave", "Back", show=False)]
    SOFTKEYS: ClassVar[tuple[Softkey | None, ...]] = (
        *(None,) * 6,
        Softkey("DRAW", "app.draw", "DRAW"),
        Softkey("BACK", "app.back", "BACK"),
    )

    def __init__(self, field: str = "") -> None:
        super().__init__()
        self._first_field = field or self.FIELDS[0].name

    def compose_body(self) -> ComposeResult:
        """Lay out the title and the form."""
        with Vertical(id="settings", classes="panel -bare"):
            with Horizontal(classes="head"):
                yield PlainLabel(self.NAME, classes="head-title")
            yield Form(self._cells(self.current_session.program.unit))

    def on_mount(self) -> None:
        """Put the cursor on the field that the screen was opened for, else on the first one."""
        self.focus_field(self._first_field)

    def fields(self) -> tuple[Field, ...]:
        """Return the fields."""
        return self.FIELDS

    def _cells(self, unit: Unit) -> tuple[Cell, ...]:
        return tuple(self._cell(field, number // ROWS, unit) for number, field in enumerate(self.FIELDS))

    def _cell(self, field: Field, column: int, unit: Unit) -> Cell:
        typed, default = self.value(field.name), default_value(field.name, unit)
        value = Solved(default, Origin.USUAL) if typed is None and default is not None else typed
        return cell_of(field, value, unit, column)

    def show_session(self, session: Session) -> None:
        """Show the current values."""
        self.form().show(self._cells(session.program.unit))

    def prompt_text(self) -> Sentence:
        """Return the prompt, with the default value of a blank field."""
        sentence, field = super().prompt_text(), self.current_field
        unit = self.current_session.program.unit
        usual = None if field is None else default_value(field.name, unit)
        if field is None or usual is None or sentence.text != field.prompt:
            return sentence
        return Sentence(f"{sentence.text} Blank: {show(usual, field.kind, unit)}.")


class ParametersScreen(SettingsForm):
    """The parameters of the program; a change of unit must be confirmed once the field is taken."""

    NAME: ClassVar[str] = "PROGRAM PARAMETERS"
    FIELDS: ClassVar[tuple[Field, ...]] = (UNITS, *PARAMETERS)

    def value(self, name: str) -> Value | str:
        """Return the unit, the path, or a number."""
        if name == "unit":
            return str(self.current_session.program.unit)
        value: Value = getattr(self.current_session.program.parameters, name)
        return str(value) if name == "path" else value

    def edited(self, field: Field, text: str) -> Edited:
        """Return the program with this parameter."""
        program = self.current_session.program
        if field.name == "path":
            return set_path_choice(program, PathChoice(text))
        return set_parameter(program, field.name, read_typed(text, field, program.unit))

    def pick(self, field: Field, text: str) -> None:
        """Take PATH at once; UNITS converts the whole program, so it waits until the field is taken."""
        if field is not UNITS:
            super().pick(field, text)

    @property
    def _new_unit(self) -> Unit | None:
        """The unit that UNITS shows, if it is not the program's."""
        widget = self.widget(UNITS.name)
        text = widget.value if isinstance(widget, ChoiceField) else None
        return None if text is None or text == self.current_session.program.unit else Unit(str(text))

    @on(Select.Changed)
    def _unit_picked(self) -> None:
        self.refresh_frame()

    def prompt_text(self) -> Sentence:
        """Return the prompt; while UNITS waits, what Enter does."""
        unit = self._new_unit
        if unit is None or self.current_field is not UNITS:
            return super().prompt_text()
        return Sentence(f"Enter converts every typed length and feed to {unit}.", Tone.WARNING)

    def take(self) -> bool:
        """Take the field; a new unit is converted after a question."""
        unit = self._new_unit
        if unit is None:
            return super().take()
        self._convert(unit)
        return False

    @work(exclusive=True, group="question")
    async def _convert(self, unit: Unit) -> None:
        session = self.current_session
        lines = [f"Convert every typed length and feed from {session.program.unit} to {unit}?"]
        answer = await self.app.push_screen_wait(Question("UNITS", lines, [Answer("CONVERT")], "GO BACK"))
        if answer == "CONVERT":
            self.host.apply(set_unit(session.program, unit), f"UNITS {unit}")
        else:
            self._keep_unit()

    def _keep_unit(self) -> None:
        """Show the program's unit again, and say so."""
        unit, widget = self.current_session.program.unit, self.widget(UNITS.name)
        if isinstance(widget, ChoiceField):
            widget.show(str(unit))
            self.say(f"UNITS stays {unit}.")

    @on(DescendantFocus)
    def _left_by_click(self) -> None:
        if self._new_unit is not None and self.current is not None and self.current.name != UNITS.name:
            self._keep_unit()

    def action_leave(self) -> None:
        """Keep the unit; if none waits, restore the old value or close the screen."""
        if self._new_unit is not None:
            self._keep_unit()
        else:
            super().action_leave()


class PartSetupScreen(SettingsForm):
    """The part's name, the work offset and the safe height."""

    NAME: ClassVar[str] = "PART SETUP"
    FIELDS: ClassVar[tuple[Field, ...]] = SETUP

    def value(self, name: str) -> Value | str:
        """Return a text or a number."""
        value: Value | str = getattr(self.current_session.program.setup, name)
        return value

    def edited(self, field: Field, text: str) -> Edited:
        """Return the program with this text or number."""
        program = self.current_session.program
        return set_setup(
            program, field.name, text.strip() if field.kind is Kind.TEXT else read_typed(text, field, program.unit)
        )
