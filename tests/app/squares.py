"""The note's own contour, keyed in."""

from __future__ import annotations

from tests.app.operator import Operator

START = ("1", "", "0", "-1", "0", "0", "-.25", "20", "300", "0")


def square() -> Operator:
    """START of the note's own screen, and four lines."""
    operator = Operator.at().press("enter").type("1").press("r").type("", "0", "-1", "0", "0", "-.25", "20", "300", "0")
    operator.press("pagedown")
    for x, y in (("2", "0"), ("2", "2"), ("0", "2"), ("0", "-1")):
        operator.press("l").type(x, y, "", "", "", "10")
    return operator.press("escape", "ctrl+home")


def look_ahead(operator: Operator) -> str:
    line = next(line for line in operator.part("body").splitlines() if "LOOKAHEAD" in line)
    return " ".join(line.split()[-2:])
