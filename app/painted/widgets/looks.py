"""The colors of every look, one table for terminals of many colors and one for those of sixteen, or none.

They stand here and not in the style sheet, which would be read and matched look by look before the first screen.
One accent (blue) for the cursor and the softkeys; color never says anything that a mark or a word does not say.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from types import MappingProxyType
from typing import Final

from rich.style import Style

from app.painted.widgets.rows import Look

INK: Final = "#d7dde3"
QUIET: Final = "#8a97a3"
FAINT: Final = "#55616c"
ACCENT: Final = "#7fb2e5"
BAD: Final = "#ff8a80"
CARE: Final = "#e6c07b"
FINE: Final = "#98c793"
GONE: Final = "#c9a0e6"
PAPER: Final = "#12171c"

MANY: Final[Mapping[Look, str]] = MappingProxyType(
    {
        Look.PLAIN: INK,
        Look.LABEL: QUIET,
        Look.HEAD: f"bold {INK}",
        Look.DIM: QUIET,
        Look.TYPED: INK,
        Look.CALCULATED: f"italic {ACCENT}",
        Look.READ_ONLY: QUIET,
        Look.TAG: ACCENT,
        Look.CURSOR: f"{PAPER} on {ACCENT}",
        Look.CARET: f"underline {INK}",
        Look.ERROR: f"bold {BAD}",
        Look.WARNING: CARE,
        Look.GOOD: FINE,
        Look.KEY: f"bold {ACCENT}",
        Look.SOFTKEY: INK,
        Look.FRAME: FAINT,
        Look.AXIS: FAINT,
        Look.SURFACE: INK,
        Look.PATH: ACCENT,
        Look.LEAD: FINE,
        Look.RAPID: QUIET,
        Look.DELETED: f"bold {GONE}",
        Look.GOUGE: f"bold {BAD}",
        Look.UNCUT: CARE,
        Look.CUTTER: QUIET,
        Look.START: f"bold {FINE}",
        Look.CURRENT: f"bold {CARE}",
        Look.SCALE: QUIET,
    }
)
FEW: Final[Mapping[Look, str]] = MappingProxyType(
    {
        Look.HEAD: "bold default",
        Look.CALCULATED: "cyan",
        Look.TAG: "cyan",
        Look.CURSOR: "reverse default",
        Look.CARET: "underline default",
        Look.ERROR: "bold red",
        Look.WARNING: "yellow",
        Look.GOOD: "green",
        Look.KEY: "bold cyan",
        Look.AXIS: "dim default",
        Look.SURFACE: "bold default",
        Look.PATH: "cyan",
        Look.LEAD: "green",
        Look.DELETED: "bold blue",
        Look.GOUGE: "bold red",
        Look.UNCUT: "yellow",
        Look.START: "bold green",
        Look.CURRENT: "bold magenta",
    }
)
"""The terminal's own colors, so that surface, path and cutter stay apart on any of them; its own ink for the rest.
No italics: GNU screen shows them in reverse, as the cursor."""


@lru_cache(None)
def style_of(look: Look, *, few_colors: bool) -> Style:
    """How a look is written; its paper is that of the screen where it has none of its own."""
    written, paper = (FEW.get(look, "default"), "default") if few_colors else (MANY[look], PAPER)
    return Style.parse(written if " on " in written else f"{written} on {paper}")
