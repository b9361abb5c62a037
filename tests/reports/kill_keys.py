"""What an operator types before the program is killed, and what a terminal sends for it."""

from __future__ import annotations

import random

from tests.app.operator import Operator

BYTES = {
    "tab": b"\t",
    "enter": b"\r",
    "up": b"\x1b[A",
    "down": b"\x1b[B",
    "shift+tab": b"\x1b[Z",
    "pageup": b"\x1b[5~",
    "pagedown": b"\x1b[6~",
    "backspace": b"\x7f",
    "delete": b"\x1b[3~",
    "ctrl+z": b"\x1a",
    "ctrl+y": b"\x19",
    "ctrl+s": b"\x13",
}
"""What a terminal sends for a key that is no character."""
MOVES = ("tab", "tab", "tab", "down", "up", "shift+tab", "pageup", "pagedown")


def keys(chance: random.Random, operator: Operator) -> list[str]:
    """What an operator does next."""
    kind = chance.choices(("number", "move", "segment", "undo", "redo", "save", "rubbish"), (10, 5, 3, 2, 1, 1, 1))[0]
    match kind:
        case "number":
            text = f"{chance.uniform(-5, 20):.{chance.randint(0, 4)}f}"
            return [*text, chance.choice(("enter", "tab", "down"))]
        case "segment":
            count = len(operator.session.block.segments) - operator.session.where.segment + 1
            return [*["pagedown"] * count, chance.choice("lab")]
        case "undo" | "redo":
            return ["ctrl+z" if kind == "undo" else "ctrl+y"] * chance.randint(1, 4)
        case "save":
            return ["ctrl+s"]
        case "rubbish":
            return [*"2..5", "tab"]
        case _:
            return [chance.choice(MOVES) for _ in range(chance.randint(1, 3))]


def sent(key: str) -> bytes:
    """A key as bytes."""
    return BYTES.get(key) or key.encode()
