"""Haas mills are `haas:a` and `:b`, by setting 43; with `-yasnac` (setting 58) every outside corner is an arc.

They compensate as Fanuc mills do, with their own alarms.  They look across many more blocks without movement, and a
program that ends under compensation is an alarm.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Final

from core.controls.compensation.corner_rules import Outside
from core.controls.control_run import Place
from core.controls.iso.dialect import CodeAction, Dialect, codes
from core.controls.iso.flow import MakeControl
from core.controls.iso.machine import LEFT_OPEN
from core.controls.iso.macro_b_machine import HAAS_SYSTEMS
from core.controls.iso.reader import Block
from core.controls.makers import fanuc
from core.controls.makers.fanuc_vectors import Alarms, VectorRules
from core.controls.moves import Plane
from core.geometry.piece import Side

DIALECT: Final[Dialect] = replace(
    fanuc.DIALECT,
    cycle_r_needed=False,
    codes=codes(
        *fanuc.CODE_GROUPS,
        ("system", CodeAction.SYSTEM, (1540, *HAAS_SYSTEMS)),
        ("once", CodeAction.MODE, (1030, 1870)),
        ("once", CodeAction.UNSUPPORTED, (120, 130, 350, 360, 700, 710, 720, 1000, 1010, 1070, 1360, 1410, 1430)),
        ("once", CodeAction.UNSUPPORTED, (1500, 1740, 1840, 2340, 2540, 2550)),
    ),
    homes_all=True,
    m97_calls=True,
    scales_axes=False,
    program_names=False,
    g54_takes_p=False,
    least_increment_setting="with setting 162 off",
    diameters_apart=True,
    macro_codes="parameters 91 to 100",
)

BLOCKS_READ: Final = 80
"""Two more than the blocks without movement that the control looks across; its manuals do not give the number."""


class Haas(fanuc.Fanuc):
    """Compensation of a Haas mill."""

    alarms = Alarms(arc="H340", arc_off="H341", no_meeting="H342", crossing="H342", point="H342")

    def compensation_on(self, side: Side, block: Block) -> None:
        """G41 and G42: start compensation; warn outside G17, where older controls have none."""
        if self.plane is not Plane.XY:
            self.log.warn("H344", "Older Haas controls compensate in G17 only (alarm 344).", block.at_side())
        super().compensation_on(side, block)

    def assumed_parameters(self) -> str:
        """Return the sentence about the settings and about what the manuals do not say."""
        return (
            "cutcomp assumes settings 43 and 58 as this control's name says, 40 DIAMETER and 44 = 0; that the control "
            f"looks across {BLOCKS_READ - 2} blocks without movement; and D0 as a cancel, as on older controls."
        )

    def after_too_many(self, block: Block) -> None:
        """Stop at too many blocks; only warn of one that ends a Fanuc's look-ahead by itself, as Haas does not say."""
        if self.motionless <= BLOCKS_READ - 2:
            what = "a stop, a move of no length or a move to the machine's zero"
            text = f"The manuals do not say whether the control looks past {what} under compensation."
            if not self.log.has("HAAS-STOP"):
                self.log.warn("HAAS-STOP", f"{text} cutcomp assumes that it does.", block)
            return
        text = f"More than {BLOCKS_READ - 2} blocks without movement in the plane stand before the next move."
        self.log.stop("H350", f"{text} Remove some.", block)

    def left_open(self, place: Place) -> None:
        """Stop the run: the program ends under compensation."""
        self.log.stop("H349", LEFT_OPEN, place)


VARIANTS: Final[Mapping[str, MakeControl]] = {
    f"{kind}{corners}": partial(
        Haas, rules=VectorRules(type_a=kind == "a", outside=outside, blocks_read=BLOCKS_READ, point_arcs=False)
    )
    for kind in ("a", "b")
    for corners, outside in (("", Outside.LINES), ("-yasnac", Outside.ARC))
}
"""The variants, the default first."""
