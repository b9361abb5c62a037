"""Parameters: the numbered and named values that a program sets and reads, as its control keeps them.

A name belongs to the subprogram that set it, unless it begins with an underscore.  What the control itself keeps among
its parameters is looked up in the machine.
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum, auto
from typing import TYPE_CHECKING, Final

from core.controls.iso import machine_values
from core.controls.program_text import quoted

if TYPE_CHECKING:
    from core.controls.iso.machine import Machine


_LOCALS: Final = 30
_SYSTEM: Final = 5001
_LAST: Final = 5601
_TOOL_AND_PLACE: Final = range(5400, 5429)
_MACRO_SYSTEM: Final = 5000


class FaultError(Exception):
    """What cannot be worked out: the rule's id, a sentence, and where in the text being read."""

    def __init__(self, code: str, text: str, at: int) -> None:
        super().__init__(text)
        self.code = code
        self.text = text
        self.at = at


class Kept(Enum):
    """How a control keeps them."""

    NGC = auto()
    """As LinuxCNC: 1 to 30 are a subprogram's own; what was never set is 0."""
    MACRO_B = auto()
    """As RosettaCNC: what was never set is empty or stands in the control's own table; #0 always is empty."""


class Parameters:
    """The values of one run; `machine` is set by whoever runs it."""

    def __init__(self, kept: Kept) -> None:
        self.kept = kept
        self.machine: Machine | None = None
        self.numbered: dict[int, float] = {}
        self.names: dict[str, float] = {}
        self.shared: dict[str, float] = {}
        self.returned: float | None = None
        self._outer: list[tuple[dict[int, float], dict[str, float]]] = []

    def number(self, index: int, at: int) -> float | None:
        """A numbered value; None for one that counts as 0 because nothing set it."""
        if self.kept is Kept.MACRO_B:
            return self._variable(index, at)
        self._within(index, at)
        if index >= _SYSTEM:
            return self._system(f"#{index}", machine_values.numbered, index, at)
        if index <= _LOCALS and self._outer:
            return self.numbered.get(index, 0.0)
        return self.numbered.get(index)

    def _within(self, index: int, at: int) -> None:
        if not 1 <= index <= _LAST:
            raise FaultError("PARAMETER", f"#{index} is none of the parameters 1 to {_LAST}.", at)

    def _variable(self, index: int, at: int) -> float:
        if index >= _MACRO_SYSTEM:
            text = f"#{index} is a variable of the control, which is not known before it runs; write the number itself."
            raise FaultError("BEYOND", text, at)
        value = self.numbered.get(index)
        if value is None:
            text = f"#{index} is given no value before this; it is empty, or set at the control. Give it one."
            raise FaultError("PARAMETER", text, at)
        return value

    def _system(self, name: str, look: machine_values.Look, key: int | str, at: int) -> float:
        if self.machine is None:
            raise FaultError("BEYOND", f"{name} is not known here.", at)
        found = look(self.machine, key)
        if isinstance(found, str):
            raise FaultError("BEYOND", found, at)
        return found

    def named(self, name: str, at: int) -> float:
        """A named value; one that has none is a fault."""
        if name in machine_values.NAMES or name.startswith(("_HAL[", "_INI[")):
            if name in ("_VALUE", "_VALUE_RETURNED"):
                return self._result(name)
            if name == "_CALL_LEVEL":
                return float(len(self._outer))
            return self._system(f"#<{quoted(name.lower())}>", machine_values.named, name, at)
        value = self._scope(name).get(name)
        if value is None:
            text = f"#<{quoted(name.lower())}> is given no value before this; set it first."
            raise FaultError("PARAMETER", text, at)
        return value

    def _result(self, name: str) -> float:
        if name == "_VALUE":
            return self.returned or 0.0
        return 0.0 if self.returned is None else 1.0

    def exists(self, name: str) -> bool:
        """Whether a name has a value."""
        return name in machine_values.NAMES or name in self._scope(name)

    def _scope(self, name: str) -> dict[str, float]:
        return self.shared if name.startswith("_") else self.names

    def settable(self, key: int | str, at: int) -> None:
        """Refuses what a program cannot set."""
        if isinstance(key, str):
            if key in machine_values.NAMES or key.startswith(("_HAL[", "_INI[")):
                raise FaultError("PARAMETER", f"#<{quoted(key.lower())}> can only be read; choose another name.", at)
        elif self.kept is Kept.MACRO_B:
            if not 1 <= key < _MACRO_SYSTEM:
                raise FaultError("PARAMETER", f"#{key} can only be read; a program sets #1 to #4999.", at)
        else:
            self._within(key, at)
            if key in _TOOL_AND_PLACE:
                raise FaultError("PARAMETER", f"#{key} can only be read; choose another number.", at)
            if key >= _SYSTEM:
                text = f"#{key} changes the control itself, and what follows would be wrong; use the G code for it."
                raise FaultError("BEYOND", text, at)

    def set(self, key: int | str, value: float) -> None:
        """Gives a number or a name that is `settable` its value."""
        if isinstance(key, str):
            self._scope(key)[key] = value
        else:
            self.numbered[key] = value

    def enter(self, arguments: Sequence[float]) -> None:
        """A subprogram begins, with its own numbers 1 to 30 and its own names."""
        own = {index: value for index, value in self.numbered.items() if index <= _LOCALS}
        self._outer.append((own, self.names))
        self._locals(dict(enumerate(arguments, 1)))
        self.names = {}

    def leave(self, value: float | None) -> None:
        """A subprogram ends, and may return a value."""
        own, self.names = self._outer.pop()
        self._locals(own)
        self.returned = value

    def _locals(self, own: dict[int, float]) -> None:
        for index in range(1, _LOCALS + 1):
            self.numbered.pop(index, None)
        self.numbered.update(own)
