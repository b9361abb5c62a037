"""This module adds key sequences to Textual: Esc and a digit for a softkey, PuTTY's VT100+ and SCO function keys.

Textual has no public way to add a sequence, so only this module writes into its table; a test types every sequence
into a pseudo-terminal.
"""

from __future__ import annotations

from enum import StrEnum
from typing import Final, cast

from textual._ansi_sequences import ANSI_SEQUENCES_KEYS
from textual.keys import Keys

SOFTKEYS: Final = (Keys.F1, Keys.F2, Keys.F3, Keys.F4, Keys.F5, Keys.F6, Keys.F7, Keys.F8)
VT100_PLUS: Final = "PQRSTUVW"
"""PuTTY in VT100+ mode sends ESC O and these letters for F1 to F8; Textual knows the first four."""

SCO_KEYS: Final = {
    "N": Keys.F2,
    "P": Keys.F4,
    "Q": Keys.F5,
    "R": Keys.F6,
    "S": Keys.F7,
    "T": Keys.F8,
    "G": Keys.PageDown,
}
"""PuTTY in SCO mode sends ESC [ and these letters.  Its F1 begins like a mouse click, and its F3 is what other
terminals send when their window loses the focus: for these two the operator types Esc and the digit."""


class AtOnce(StrEnum):
    """Esc and a digit in one packet, named as Textual names Alt and the digit from terminals with a newer protocol."""

    ALT_1 = "alt+1"
    ALT_2 = "alt+2"
    ALT_3 = "alt+3"
    ALT_4 = "alt+4"
    ALT_5 = "alt+5"
    ALT_6 = "alt+6"
    ALT_7 = "alt+7"
    ALT_8 = "alt+8"


def teach() -> None:
    """Add the sequences to Textual's table."""
    table = cast("dict[str, tuple[StrEnum | Keys, ...]]", ANSI_SEQUENCES_KEYS)
    for number, both in enumerate(AtOnce, 1):
        table[f"\x1b{number}"] = (both,)
    for key, letter in zip(SOFTKEYS, VT100_PLUS, strict=True):
        table[f"\x1bO{letter}"] = (key,)
    for letter, key in SCO_KEYS.items():
        table[f"\x1b[{letter}"] = (key,)
    # this is how Enter arrives if it was pressed before the screens had the terminal
    table["\n"] = (Keys.Enter,)
