"""Plan: which part of the terminal each part of a screen gets, for every size and layout."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Final

from app.painted.screens.page import Layout
from app.painted.widgets import softkeys
from app.painted.widgets.rows import NOWHERE, Area

NATIVE: Final = (80, 24)
"""Columns and rows at which everything stands without scrolling."""
WIDE: Final = 110
"""From so many columns on, the drawing stands beside the form in full height."""
LEFT: Final = 59
"""Columns of the form."""
BODY: Final = {Layout.FORM: 9, Layout.TABLE: 10}
"""Rows of the fields, and of the look-ahead table."""
VERDICT: Final = {Layout.FORM: 4, Layout.TABLE: 3}


@dataclass(frozen=True, slots=True)
class Plan:
    """The area of each part."""

    notice: Area = NOWHERE
    header: Area = NOWHERE
    body: Area = NOWHERE
    verdict: Area = NOWHERE
    drawing: Area = NOWHERE
    softkeys: Area = NOWHERE
    prompt: Area = NOWHERE
    status: Area = NOWHERE


@lru_cache(maxsize=8)
def plan(width: int, height: int, layout: Layout, told: int = 0) -> Plan:
    """The plan for a terminal of width x height cells; any size is allowed.

    On a small one what is told of the last key takes as many lines as it needs, until the next key.
    """
    small = width < NATIVE[0] or height < NATIVE[1]
    top = 1 if small and height > 1 else 0
    status = 1 if height >= 6 else 0
    prompt = 2 if height >= 8 else 1 if height >= 4 else 0
    if small and told > prompt:
        prompt = min(told, height)
        top, status = min(top, height - prompt), min(status, max(height - prompt - top, 0))
    room = max(height - top - status - prompt, 0)
    keys = softkeys.WIDTH if width >= NATIVE[0] else 0
    left = max(width - keys, 0)
    header = 2 if room >= 4 else 1 if room >= 2 else 0
    parts = _parts(layout, Area(0, top + header, left, room - header))
    return Plan(
        notice=Area(0, 0, width, top),
        header=Area(0, top, min(left, LEFT) if layout in BODY else left, header),
        softkeys=Area(left, top, keys, room),
        prompt=Area(0, top + room, width, prompt),
        status=Area(0, height - status, width, status),
        **_beside(parts, layout, left, top, room),
    )


def _parts(layout: Layout, area: Area) -> dict[str, Area]:
    """Body, verdict and drawing one under the other."""
    match layout:
        case Layout.TEXT:
            return {"body": area}
        case Layout.PROOF:
            return _listed(area)
        case Layout.DRAW:
            told = min(2, max(area.height - 3, 0))
            above = Area(area.x, area.y, area.width, area.height - told)
            return {"drawing": above, "verdict": Area(area.x, area.y + above.height, area.width, told)}
        case Layout.FORM | Layout.TABLE:
            body = min(BODY[layout], area.height)
            told = min(VERDICT[layout], area.height - body)
            drawn = area.height - body - told
            return {
                "body": Area(area.x, area.y, area.width, body),
                "verdict": Area(area.x, area.y + body, area.width, told),
                "drawing": Area(area.x, area.y + body + told, area.width, drawn),
            }


def _listed(area: Area) -> dict[str, Area]:
    """A listing with its findings below; the drawing beside the listing, on a wide terminal beside both."""
    told = min(max(area.height // 3, 1), area.height)
    above = area.height - told
    across = min(LEFT, area.width) if area.width + softkeys.WIDTH >= WIDE else max(area.width * 5 // 9, 1)
    below = across if area.width + softkeys.WIDTH >= WIDE else area.width
    return {
        "body": Area(area.x, area.y, across, above),
        "verdict": Area(area.x, area.y + above, below, told),
        "drawing": Area(area.x + across, area.y, area.width - across, area.height if below < area.width else above),
    }


def _beside(parts: dict[str, Area], layout: Layout, left: int, top: int, room: int) -> dict[str, Area]:
    """On a wide terminal the drawing goes to the right of the form, and the verdict gets the height."""
    if layout not in BODY or left + softkeys.WIDTH < WIDE:
        return parts
    body, verdict = parts["body"], parts["verdict"]
    return {
        "body": Area(0, body.y, LEFT, body.height),
        "verdict": Area(0, verdict.y, LEFT, max(top + room - verdict.y, 0)),
        "drawing": Area(LEFT, top, left - LEFT, room),
    }
