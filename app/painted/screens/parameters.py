"""PROGRAM PARAMETERS: blends, finish allowances, PROFILE passes, clearances, the posted path, and the unit."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

from app.painted.messages import Close, Edit, Open
from app.painted.screens.ask import Ask
from app.painted.screens.forms import FormPage, cell_of, prompt_of
from app.painted.screens.page import Answer, Softkey, Softkeys, Surface, View
from app.painted.session import Said, Session
from app.painted.widgets.form import Cell, State, cursor_line, form_rows
from app.painted.widgets.header import header
from app.painted.widgets.rows import plain
from core.program.edit import set_parameter, set_path_choice, set_unit
from core.program.fields import PARAMETERS, Field, default_value, read_typed
from core.program.model import PathChoice
from core.program.solve.solved import Value
from core.units import Kind, Unit, show

UNITS: Final = Field(
    "unit",
    "UNITS",
    Kind.CHOICE,
    "Select the unit of the program. Changing it converts every typed length and feed.",
    choices=tuple(unit.value for unit in Unit),
)
FIELDS: Final = (UNITS, *PARAMETERS)


@dataclass(frozen=True, eq=False, slots=True)
class ParametersPage(FormPage):
    """The parameters; a blank shows the default in force with the tag DEF."""

    name: str = UNITS.name

    def fields(self, session: Session) -> tuple[Field, ...]:
        """UNITS first, then the parameters."""
        return FIELDS

    def cursor(self, session: Session) -> str:
        """The field with the cursor."""
        return self.name

    def moved(self, session: Session, name: str) -> Answer:
        """The cursor on another field."""
        return Answer(replace(self, name=name))

    def value(self, session: Session, name: str) -> Value | str:
        """What the field holds."""
        if name == "unit":
            return str(session.program.unit)
        held = getattr(session.program.parameters, name)
        return str(held) if name == "path" else held

    def edit(self, session: Session, one: Field, text: str) -> Edit:
        """The text read and put into the field."""
        return Edit(set_parameter(session.program, one.name, read_typed(text, one, session.program.unit)), one.label)

    def pick(self, session: Session, one: Field, choice: str) -> Answer:
        """PATH is taken at once; another unit is asked about first, since it converts the whole program."""
        if one is not UNITS:
            return Answer(self, (Edit(set_path_choice(session.program, PathChoice(choice)), one.label),))
        if choice == session.program.unit:
            return Answer(self)
        edit = Edit(set_unit(session.program, Unit(choice)), f"UNITS {choice}")
        question = f"Convert every typed length and feed of this program from {session.program.unit} to {choice}?"
        ask = Ask("UNITS", (question,), (("c", f"CONVERT TO {choice}", (Close(), edit)),))
        return Answer(self, (Open(ask),))

    def escape(self, session: Session) -> Answer | None:
        """The half-typed text forgotten, else back."""
        return FormPage.escape(self, session) or Answer(self, (Close(),))

    def softkeys(self, session: Session) -> Softkeys:
        """Only the way back."""
        return {8: Softkey("EXIT", (Close(),))}

    def cells(self, session: Session) -> tuple[Cell, ...]:
        """The unit and the path at the right, lengths at the left, the rest at the right."""
        return tuple(self._cell(session, one, index) for index, one in enumerate(FIELDS))

    def _cell(self, session: Session, one: Field, index: int) -> Cell:
        column, line = divmod(index, 6)
        held, unit = self.value(session, one.name), session.program.unit
        cell = cell_of(one, held, unit, column, line)
        usual = default_value(one.name, unit)
        if held is not None or usual is None:
            return cell
        return cell._replace(text=show(usual, one.kind, unit), tag="DEF", state=State.CALCULATED)

    def view(self, session: Session, surface: Surface) -> View:
        """The form as it stands."""
        cells, one = self.cells(session), self.field(session)
        trouble = self.reason(session) or self.shared_trouble(session)
        return View(
            header("PROGRAM PARAMETERS", plain(""), session, surface.width),
            ((), *form_rows(cells, self.name, self.editing, surface.width)),
            trouble or Said(_prompt(one, session.program.unit) if one else ""),
            1 + cursor_line(cells, self.name, surface.width),
        )


def _prompt(one: Field, unit: Unit) -> str:
    usual = default_value(one.name, unit)
    return prompt_of(one) if usual is None else f"{one.prompt} Blank is {show(usual, one.kind, unit)}."
