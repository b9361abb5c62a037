"""The themes are one table of roles and colors; TCSS and the drawing use only the roles, as `$c-role`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from textual.theme import BUILTIN_THEMES, Theme

DARK_THEME: Final = "cutcomp-dark"
LIGHT_THEME: Final = "cutcomp-light"
SIXTEEN_COLOR_THEME: Final = "cutcomp-16"
"""The theme with the terminal's own sixteen colors, or none if NO_COLOR is set."""

_ROLES: Final[Mapping[str, tuple[str, str, str]]] = {
    "bg": ("#10161d", "#fbfaf6", "ansi_default"),
    # gray enough to stay gray on a terminal with 256 colors
    "bar": ("#1d2227", "#e8eaec", "ansi_default"),
    "well": ("#23282e", "#eceef0", "ansi_default"),
    "frame": ("#5b6e81", "#7f8c99", "ansi_default"),
    "ink": ("#dce3ea", "#1d2733", "ansi_default"),
    "label": ("#9fb0c0", "#4a5a69", "ansi_default"),
    "value": ("#f4f7fa", "#0b1118", "ansi_default"),
    "cal": ("#7cc4ff", "#0b5cad", "ansi_cyan"),
    "usr": ("#ffb86b", "#a04a00", "ansi_yellow"),
    "def": ("#94a6b8", "#566575", "ansi_default"),
    "err": ("#ff8078", "#b3202c", "ansi_red"),
    "warn": ("#f2cc60", "#7a5600", "ansi_yellow"),
    "good": ("#86d992", "#1f6e34", "ansi_green"),
    "gouge": ("#ff6f91", "#b0164f", "ansi_red"),
    "uncut": ("#e3b341", "#855c00", "ansi_yellow"),
    "deleted": ("#d2a8ff", "#7440b8", "ansi_magenta"),
    "part": ("#eef2f6", "#121a23", "ansi_default"),
    "path": ("#4fc1d6", "#00697a", "ansi_cyan"),
    "cutter": ("#8797a8", "#5c6b79", "ansi_default"),
    "begin": ("#86d992", "#1f6e34", "ansi_green"),
    "focus": ("#7cc4ff", "#0b5cad", "ansi_default"),
}
"""The color of each role in the dark, the light, and the sixteen-color theme."""


def themes() -> tuple[Theme, ...]:
    """Return the three themes."""
    return tuple(_theme(name, column) for column, name in enumerate((DARK_THEME, LIGHT_THEME, SIXTEEN_COLOR_THEME)))


def _scrollbars(colors: Mapping[str, str]) -> dict[str, str]:
    """Return the colors of all scrollbars: the frame's color on the background."""
    bars = {name: colors["frame"] for name in ("scrollbar", "scrollbar-hover", "scrollbar-active")}
    pages = ("background", "background-hover", "background-active", "corner-color")
    return bars | {f"scrollbar-{name}": colors["bg"] for name in pages}


def _theme(name: str, column: int) -> Theme:
    colors = {role: each[column] for role, each in _ROLES.items()}
    ansi = name == SIXTEEN_COLOR_THEME
    # Textual's own style sheets fail on an ANSI theme without these variables
    base = BUILTIN_THEMES["ansi-dark"].variables if ansi else {}
    return Theme(
        name,
        ansi=ansi,
        dark=name != LIGHT_THEME,
        primary=colors["focus"],
        accent=colors["focus"],
        warning=colors["warn"],
        error=colors["err"],
        success=colors["good"],
        foreground=colors["ink"],
        background=colors["bg"],
        surface=colors["bar"],
        panel=colors["bar"],
        variables={**base, **_scrollbars(colors), **{f"c-{role}": color for role, color in colors.items()}},
    )
