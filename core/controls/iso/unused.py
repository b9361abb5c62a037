"""Words that nothing in their block takes: told, since a control may do something with them that is not followed here.

LinuxCNC refuses such words itself; this is for the other word-address controls.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Final

from core.controls.iso.words import SWITCHES, Block
from core.finding import Severity

if TYPE_CHECKING:
    from core.controls.iso.machine import Machine


_ALWAYS: Final = frozenset("NOXYZFST")
_AXES_ELSE: Final = frozenset("ABCUVW")
"""Told as axes."""

_BY_G: Final[Mapping[int, str]] = MappingProxyType(
    {
        40: "PXU",
        100: "LPR",
        400: "DIJK",
        411: "DL",
        421: "DL",
        410: "DI",
        420: "DI",
        430: "H",
        490: "H",
        640: "P",
        960: "D",
    }
)
_BY_M: Final[Mapping[int, str]] = MappingProxyType({980: "PL"})
_ARC: Final = "IJKR"
_CYCLE: Final = "RQPLIJK"


def tell(machine: Machine, block: Block) -> None:
    """Tells of each word of a block that nothing takes."""
    words = block.words
    if _ALWAYS.issuperset(words):
        return
    taken = set(_ALWAYS | _AXES_ELSE)
    for code in block.g:
        taken.update(_BY_G.get(code, ""))
    for code in block.m:
        taken.update(_BY_M.get(code, ""))
    if machine.mode in (20, 30):
        taken.update(_ARC)
    elif machine.mode not in (0, 10, 800, None):
        taken.update(_CYCLE)
    if machine.dialect.d_anywhere or not SWITCHES.isdisjoint(block.g):
        taken.add("D")
    left = [letter for letter in words if letter not in taken]
    if left:
        names = " and ".join(left)
        text = f"Nothing in this block takes {names} here; what the control does with it is not followed."
        machine.log.tell(Severity.WARNING, "UNUSED", text, block.line, block.column("".join(left)))
