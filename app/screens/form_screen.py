"""FormScreen is the base of screens with fields, from the first character typed to the accepted value."""

from __future__ import annotations

from abc import abstractmethod
from typing import Any, ClassVar, Final

from textual import on, work
from textual.binding import Binding, BindingType
from textual.widget import Widget
from textual.widgets import Input, Select
from textual.widgets.option_list import Option

from app.screens.base import BaseScreen
from app.screens.dialogs import ChooseLine
from app.screens.field_texts import prompt_of, unread_text, unusable
from app.session.messages import Sentence, Tone
from app.widgets.field import ChoiceField, Form, NumberField
from core.finding import Severity
from core.program.edit import Edited, Refused
from core.program.fields import Field, read_typed, text_refusal
from core.program.model import Number, Program, Unread
from core.program.solve.solved import Value
from core.units import Kind, printable, sentence

CALCULATOR_KINDS: Final = frozenset({Kind.LENGTH, Kind.ANGLE})

TONES: Final = {Severity.ERROR: Tone.ERROR, Severity.WARNING: Tone.WARNING}
"""The tones of the findings that a prompt reports."""
SOFTKEY_WAIT: Final = 2.0
"""Seconds after Esc in which a digit presses a softkey."""
OLD_VALUE: Final = "The old number is back. Esc again, then 1 to 8, presses a softkey."
ARMED_PROMPT: Final = "1 to 8 press the softkey now, as F1 to F8 do."


class FormScreen(BaseScreen):
    """A screen with a form.

    A field is taken when the cursor leaves it by key or click, on Enter, and before any softkey acts.
    The cursor stays on a number the field refuses and on text that cannot be read.
    """

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("tab,down", "step(1)", "Next field", show=False),
        Binding("shift+tab,up", "step(-1)", "Field before", show=False),
        Binding("enter", "enter", "Take the field", show=False),
        Binding("escape", "restore", "Old value back", show=False),
        *(Binding(f"{n}", f"armed_softkey({n})", f"F{n} after Esc", show=False, priority=True) for n in range(1, 9)),
        Binding("equals_sign", "calculator", "Calculator", show=False, priority=True),
    ]

    PALETTE_ACTIONS: ClassVar[tuple[tuple[str, str, str], ...]] = (
        ("CALCULATOR", "screen.calculator", "=: triangles, tangents, bolt circles, intersections"),
    )

    def __init__(self) -> None:
        super().__init__()
        self._armed: Widget | None = None
        self._sums: dict[str, dict[str, str]] = {}
        """The texts typed into each calculator case, by case and name."""
        self._unread: tuple[str, Program] | None = None
        """The last field with text that could not be read, and the program after that edit."""

    def form(self) -> Form:
        """Return the form on display."""
        return self.query_one(Form)

    @abstractmethod
    def fields(self) -> tuple[Field, ...]:
        """Return the fields that the cursor can go to, in order."""

    @abstractmethod
    def value(self, name: str) -> Value | str:
        """Return what the program holds in a field."""

    @abstractmethod
    def edited(self, field: Field, text: str) -> Edited:
        """Return the program after this text is typed or picked in a field."""

    def label(self, field: Field) -> str:
        """Return the undo label for an edit of this field."""
        return field.label

    def names(self) -> list[str]:
        """Return the names of the widgets that the cursor steps through, in order."""
        return [field.name for field in self.fields()]

    def widget(self, name: str) -> NumberField | ChoiceField | None:
        """Return the widget with this name."""
        return self.form().field(name)

    @property
    def current(self) -> NumberField | ChoiceField | None:
        """The field that has the cursor or whose list is open."""
        if self.focused is None:
            return None
        return next(
            (each for each in self.focused.ancestors_with_self if isinstance(each, NumberField | ChoiceField)), None
        )

    @property
    def current_field(self) -> Field | None:
        """The definition of that field."""
        widget = self.current
        return None if widget is None else self._field(widget.name or "")

    def _field(self, name: str) -> Field | None:
        return next((field for field in self.fields() if field.name == name), None)

    def focus_field(self, name: str) -> None:
        """Put the cursor on a field."""
        if (widget := self.widget(name)) is not None:
            self.set_focus(widget)

    # ---- taking what was typed

    def take(self) -> bool:
        """Take the text of the field with the cursor; return whether the cursor may move on."""
        widget, field = self.current, self.current_field
        if not isinstance(widget, NumberField) or field is None:
            return True
        return self.take_text(widget, field)

    def take_text(self, widget: NumberField, field: Field) -> bool:
        """Take the text of a field; return False if it is refused or cannot be read."""
        if not widget.edited:
            return True
        text = widget.value
        outcome = self.edited(field, text)
        if isinstance(outcome, Refused):
            if field.name == "lookahead":
                # in all other fields the text stays, so that it can be corrected
                widget.restore()
            self.say(outcome.text, Tone.ERROR)
            return False
        taken = self.host.apply(outcome, self.label(field))
        widget.restore()
        if not taken:
            return False
        typed = None if field.kind is Kind.TEXT else read_typed(text, field, self.current_session.program.unit)
        if isinstance(typed, Unread):
            self._unread = (field.name, self.current_session.program)
            self.say(unread_text(typed, field, self.current_session.program.unit), Tone.ERROR)
            return False
        return True

    @on(Input.Submitted)
    def _entered(self) -> None:
        self.action_accept()

    @on(Input.Changed)
    def _typing(self, event: Input.Changed) -> None:
        """Try out a half-typed number: the verdict and the drawings show what it would do."""
        widget, field = event.input, self._field(event.input.name or "")
        if widget is not self.current or not isinstance(widget, NumberField):
            return
        self.disarm()
        self.clear_notice()
        if field is None or field.kind is Kind.TEXT:
            return
        typed = read_typed(widget.value, field, self.current_session.program.unit) if widget.edited else None
        outcome: Any = self.edited(field, widget.value) if isinstance(typed, Number) else None
        self.host.try_out(None if outcome is None or isinstance(outcome, Refused) else outcome)
        self.refresh_frame()

    @on(Input.Blurred)
    def _take_left_field(self, event: Input.Blurred) -> None:
        """Take the text of a field that was left by a click; return to the field if that fails."""
        widget, field = event.input, self._field(event.input.name or "")
        if (
            isinstance(widget, NumberField)
            and widget.edited
            and field is not None
            and not self.take_text(widget, field)
        ):
            self.set_focus(widget)

    @on(Select.Changed)
    def _picked(self, event: Select.Changed) -> None:
        field, text = self._field(event.select.name or ""), event.value if isinstance(event.value, str) else ""
        if field is None or text == self.picked_text(field):
            return
        if not text and not self.may_be_blank(field) and isinstance(event.select, ChoiceField):
            # the blank line of the list was picked
            event.select.show(self.picked_text(field))
            return
        self.clear_notice()
        self.pick(field, text)

    def may_be_blank(self, _field: Field, /) -> bool:
        """Return whether this choice field may be blank."""
        return False

    def picked_text(self, field: Field) -> str:
        """Return the choice that the program holds."""
        return self.form().rows[field.name].cell.text

    def pick(self, field: Field, text: str) -> None:
        """Take a choice; if it is refused, show the old one again."""
        widget = self.widget(field.name)
        if not self.host.apply(self.edited(field, text), self.label(field)) and isinstance(widget, ChoiceField):
            widget.show(self.picked_text(field))

    @property
    def half_typed(self) -> bool:
        """True if the field with the cursor has typed text that has not been taken."""
        return isinstance(self.current, NumberField) and self.current.edited

    @property
    def half_typed_sentence(self) -> str:
        """The text that has not been taken, and its field."""
        widget, field = self.current, self.current_field
        if not isinstance(widget, NumberField) or field is None or not widget.edited:
            return ""
        return f"{printable(widget.value.strip())} in {field.label} is not taken yet."

    @on(ChoiceField.Unknown)
    def _no_choice(self, event: ChoiceField.Unknown) -> None:
        self.refuse_choice(event.typed)

    def refuse_choice(self, typed: str) -> None:
        """Say that what was typed is no choice."""
        self.say(f"{printable(typed)} is not a choice. Left and right change it.", Tone.ERROR)

    # ---- keys

    def action_step(self, by: int) -> None:
        """Take the field and go to the next or previous one, wrapping around."""
        self.clear_notice()
        if self.take() and (names := self.names()):
            here = names.index(self.current.name) if self.current is not None and self.current.name in names else -1
            self.focus_field(names[(here + by) % len(names)])

    def action_enter(self) -> None:
        """Take the field and go on; stay once on a choice if what was typed there is no choice."""
        widget = self.current
        if isinstance(widget, ChoiceField) and widget.refused:
            self.refuse_choice(widget.refused)
            widget.refused = ""
        else:
            self.action_accept()

    def action_accept(self) -> None:
        """Take the field and go to the next one."""
        self.action_step(1)

    def action_leave(self) -> None:
        """Restore the old value; if there is none to restore, close the screen."""
        if self.half_typed or self.last_is_unread:
            self.action_restore()
        else:
            self.app.call_later(self.app.run_action, "app.back")

    def action_restore(self) -> None:
        """Restore the old value; if there is none to restore, the next digit presses a softkey."""
        self.clear_notice()
        if self.half_typed or self.current is None:
            typed = self.half_typed
            self.forget_typed()
            if typed:
                self.say(OLD_VALUE)
            return
        if self.last_is_unread:
            self._undo_unread()
            self.say(OLD_VALUE)
            return
        self._armed = self.focused
        if isinstance(self.focused, NumberField):
            self.focused.softkey_digits = True
        self.say(ARMED_PROMPT)
        self.set_timer(SOFTKEY_WAIT, self.disarm)

    def _undo_unread(self) -> None:
        """Undo the edits that left unusable text in the field with the cursor, several if it was mistyped again."""
        field = self.current_field
        self.host.action_undo()
        while field is not None:
            session = self.current_session
            unread = unusable(self.value(field.name), field, session.program.unit) is not None
            if not unread or session.history.undo_label != self.label(field):
                return
            self.host.action_undo()

    @property
    def last_is_unread(self) -> bool:
        """True if the last edit left unreadable text in the field with the cursor."""
        field, program = self.current_field, self.current_session.program
        return self._unread is not None and field is not None and self._unread == (field.name, program)

    def disarm(self) -> None:
        """Let digits be typed again."""
        if isinstance(self._armed, NumberField):
            self._armed.softkey_digits = False
        self._armed = None
        if self.notice is not None and self.notice.text == ARMED_PROMPT:
            self.clear_notice()

    @property
    def armed(self) -> bool:
        """True if the next digit presses a softkey: Esc was just pressed here and nothing has been typed since."""
        return self._armed is not None and self._armed is self.focused and not self.half_typed

    def check_action(self, action: str, parameters: tuple[object, ...]) -> bool | None:
        """Let a digit press a softkey only while armed, and only if that softkey exists."""
        if action == "armed_softkey":
            return self.armed and self.SOFTKEYS[int(str(parameters[0])) - 1] is not None
        return super().check_action(action, parameters)

    async def action_armed_softkey(self, number: int) -> None:
        """Press the softkey of a digit that follows Esc."""
        self.disarm()
        await self.action_softkey(number)

    def forget_typed(self) -> None:
        """Show again what the program holds in the field."""
        if isinstance(self.current, NumberField):
            self.current.restore()
            self.host.try_out(None)
            self.refresh_frame()

    async def action_softkey(self, number: int) -> None:
        """Take the field, then press the softkey."""
        if self.take():
            await super().action_softkey(number)

    # ---- the calculator

    def action_calculator(self) -> None:
        """Open the calculator for the field with the cursor; in a text field, type the equals sign."""
        field, widget = self.current_field, self.current
        if isinstance(widget, NumberField) and field is not None and field.kind in CALCULATOR_KINDS:
            self._calculate(field, widget)
        elif isinstance(widget, NumberField) and field is not None and field.kind is Kind.TEXT:
            widget.insert_text_at_cursor("=")
        else:
            self.say("The calculator works on fields that take a length or an angle.")

    @work(exclusive=True, group="question")
    async def _calculate(self, field: Field, widget: NumberField) -> None:
        """Choose a calculator case and put its answer into a field, as if it had been typed."""
        # imported here: the form appears before the calculator is loaded
        from app.screens.calculator import Calculator
        from core.program.calculator import CASES, outputs_for

        cases = {case.name: case for case in CASES if outputs_for(case, field.kind)}
        rows = [Option(f" {each}", id=each) for each in cases]
        name = await self.app.push_screen_wait(ChooseLine("CALCULATOR", rows))
        if not name:
            return
        dialog = Calculator(cases[name], field, self.current_session.program.unit, self._sums.get(name, {}))
        text = await self.app.push_screen_wait(dialog)
        self._sums[name] = dialog.typed
        if text:
            widget.value, widget.cursor_position = text, len(text)

    # ---- the prompt line

    def prompt_text(self) -> Sentence:
        """Return what the field with the cursor takes, or what is wrong with it."""
        field, widget = self.current_field, self.current
        if field is None or widget is None:
            return Sentence("")
        if isinstance(widget, NumberField) and widget.edited:
            return self._half_typed(widget, field) or Sentence(self.prompt_of(field))
        trouble = unusable(self.value(field.name), field, self.current_session.program.unit)
        if trouble is not None:
            return Sentence(trouble, Tone.ERROR)
        return self.trouble(field) or Sentence(self.prompt_of(field))

    def prompt_of(self, field: Field) -> str:
        """Return the field's prompt as this screen has room for it."""
        return prompt_of(field, narrow=self.has_class("-narrow"))

    def _half_typed(self, widget: NumberField, field: Field) -> Sentence | None:
        """Return a note that the text is not a number yet and which value is still in use."""
        typed = None if field.kind is Kind.TEXT else read_typed(widget.value, field, self.current_session.program.unit)
        if not isinstance(typed, Unread):
            return None
        unused = widget.resting in ("", "?") or isinstance(self.value(field.name), Unread)
        still = "" if unused else f" Still using {widget.resting}."
        outside = text_refusal(widget.value, field, self.current_session.program.unit)
        return Sentence(f"{outside or f'{widget.value.strip()} is not a number.'}{still}")

    def trouble(self, field: Field) -> Sentence | None:
        """Return the first error or warning of any block about this field, which all blocks share."""
        derived = self.current_session.derived
        findings = (finding for block in derived.blocks for finding in block.findings if finding.severity in TONES)
        first = next((finding for finding in findings if finding.field == field.name), None)
        return None if first is None else Sentence(sentence(first, derived.program.unit), TONES[first.severity])
