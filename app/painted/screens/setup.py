"""PART SETUP: the part's name, the work offset and the safe height of the posted program."""

from __future__ import annotations

from dataclasses import dataclass, replace

from app.painted.messages import Close, Edit
from app.painted.screens.forms import FormPage, cell_of
from app.painted.screens.page import Answer, Softkey, Softkeys, Surface, View
from app.painted.session import Said, Session
from app.painted.widgets.form import Cell, State, cursor_line, form_rows
from app.painted.widgets.header import header
from app.painted.widgets.rows import plain
from core.program.edit import set_setup
from core.program.fields import SETUP, Field, default_value, read_typed
from core.program.solve.solved import Value
from core.units import Kind, show


@dataclass(frozen=True, eq=False, slots=True)
class SetupPage(FormPage):
    """Three fields; a blank shows the default in force with the tag DEF."""

    name: str = SETUP[0].name

    def fields(self, session: Session) -> tuple[Field, ...]:
        """The fields of PART SETUP."""
        return SETUP

    def cursor(self, session: Session) -> str:
        """The field with the cursor."""
        return self.name

    def moved(self, session: Session, name: str) -> Answer:
        """The cursor on another field."""
        return Answer(replace(self, name=name))

    def value(self, session: Session, name: str) -> Value | str:
        """What the field holds."""
        held: Value | str = getattr(session.program.setup, name)
        return held

    def edit(self, session: Session, one: Field, text: str) -> Edit:
        """The text put into the field, read as a number where the field is one."""
        value = text.strip() if one.kind is Kind.TEXT else read_typed(text, one, session.program.unit)
        return Edit(set_setup(session.program, one.name, value), one.label)

    def escape(self, session: Session) -> Answer | None:
        """The half-typed text forgotten, else back."""
        return FormPage.escape(self, session) or Answer(self, (Close(),))

    def softkeys(self, session: Session) -> Softkeys:
        """Only the way back."""
        return {8: Softkey("EXIT", (Close(),))}

    def cells(self, session: Session) -> tuple[Cell, ...]:
        """One under the other."""
        return tuple(self._cell(session, one, line) for line, one in enumerate(SETUP))

    def _cell(self, session: Session, one: Field, line: int) -> Cell:
        held, unit = self.value(session, one.name), session.program.unit
        cell = cell_of(one, held, unit, 0, line)
        usual = default_value(one.name, unit)
        if held is not None or usual is None:
            return cell
        return cell._replace(text=show(usual, one.kind, unit), tag="DEF", state=State.CALCULATED)

    def view(self, session: Session, surface: Surface) -> View:
        """The form as it stands."""
        cells, one = self.cells(session), self.field(session)
        return View(
            header("PART SETUP", plain(""), session, surface.width),
            ((), *form_rows(cells, self.name, self.editing, surface.width)),
            self.reason(session) or self.shared_trouble(session) or Said(one.prompt if one else ""),
            1 + cursor_line(cells, self.name, surface.width),
        )
