"""This module says which controls have a code or a syntax that the current one lacks, for that one's alarm."""

from __future__ import annotations

from collections.abc import Container, Mapping
from typing import Final

LINUXCNC: Final = "LinuxCNC"
ROSETTACNC: Final = "RosettaCNC"
NINE_SERIES: Final = "Allen-Bradley 9/Series"
THREEBLOCK: Final = "three-block"
FANUC: Final = "Fanuc"
HAAS: Final = "Haas"

CONTROLS_WITH_CODE: Final[Mapping[int, tuple[str, ...]]] = {
    **dict.fromkeys((70, 80, 431, 432, 611, 901, 911, 922, 923), (LINUXCNC,)),
    **dict.fromkeys((411, 421, 591, 592, 593), (LINUXCNC, ROSETTACNC)),
    921: (LINUXCNC, NINE_SERIES),
    390: (NINE_SERIES, FANUC),
    391: (NINE_SERIES,),
    **dict.fromkeys((440, 450), (THREEBLOCK,)),
    **dict.fromkeys((500, 690), (ROSETTACNC, FANUC, HAAS)),
    **dict.fromkeys((610, 640, 960, 970, 980, 520, 530, 100), (LINUXCNC, NINE_SERIES, FANUC, HAAS)),
    **dict.fromkeys((700, 710), (THREEBLOCK, NINE_SERIES)),
}
"""G codes in tenths that not every control has, and the controls that have them."""

TOOL_DATA: Final[Mapping[int, tuple[str, ...]]] = {
    **dict.fromkeys((1, 10, 11), (LINUXCNC, FANUC, HAAS)),
    **dict.fromkeys((12, 13), (FANUC, HAAS)),
}
"""The controls on which G10 sets a tool's data, by the L of the block."""

CONTROLS_WITH_EXPRESSIONS: Final = (LINUXCNC, ROSETTACNC, FANUC, HAAS)
"""The controls with parameters and expressions."""

FREE_ASSIGNMENT: Final = (ROSETTACNC, FANUC, HAAS)
"""The controls that need no brackets right of the equal sign."""

HIGH_PARAMETERS: Final = (FANUC,)
"""The controls with parameters from #10000 on."""

CONTROLS_WITH_JUMPS: Final = (FANUC, HAAS)
"""The controls with IF, GOTO, WHILE and DO."""

OFFSETS_ANYWHERE: Final = (NINE_SERIES, FANUC, HAAS)
"""The controls that take D and H in any block, also with T."""


LATHE_CYCLES: Final = frozenset((700, 710, 720, 730, 740, 750, 760))
"""G codes that call a lathe cycle if the block has U, W, or both P and Q."""


def lathe_cycle(number: int, letters: Container[str]) -> str:
    """Return the sentence that a code with these words is a lathe's, "" if it need not be."""
    if number in LATHE_CYCLES and ("U" in letters or "W" in letters or ("P" in letters and "Q" in letters)):
        return f"G{number / 10:g} is a cycle of lathes. cutcomp checks programs of mills."
    return ""


def only_on(controls: tuple[str, ...]) -> str:
    """Return the sentence that names the controls that have something, "" without any."""
    if not controls:
        return ""
    names = " and ".join((", ".join(controls[:-1]), controls[-1])) if len(controls) > 1 else controls[0]
    return f"{names} {'have' if len(controls) > 1 else 'has'} it."


D_AND_H_ANYWHERE: Final = f"{only_on(OFFSETS_ANYWHERE).removesuffix('.')} in any block."
