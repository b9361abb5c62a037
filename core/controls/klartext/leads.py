"""APPR and DEP blocks apply and cancel compensation along a lead."""

from __future__ import annotations

import re
from math import radians
from typing import Final

from core.controls.compensation.elements import Element, offset_point
from core.controls.compensation.recorder import side_of
from core.controls.klartext.center_path import ProgrammedStep, Role
from core.controls.klartext.lead_curves import Lead, LeadShape, departure
from core.controls.klartext.m_functions import functions
from core.controls.klartext.path_functions import POLAR_WORDS, check_pole_plane, end_point, straight_element
from core.controls.klartext.reader import Block
from core.controls.klartext.state import AXIS_WORDS, COMMON_WORDS, State, Words
from core.controls.moves import solid

_FORM: Final = re.compile(r"[ \t]*(P?)(LT|LN|CT|LCT)(?![A-Z])", re.ASCII)
_NEEDED_WORDS: Final = {
    LeadShape.LT: ("LEN",),
    LeadShape.LN: ("LEN",),
    LeadShape.CT: ("CCA", "R"),
    LeadShape.LCT: ("R",),
}


def approach(state: State, block: Block) -> None:
    """APPR LT, LN, CT, LCT and their polar forms: pass on the lead to the contour's first point."""
    shape, polar, words = _read(state, block, "APPR")
    end = end_point(state, words, polar=polar)
    state.chosen_side(words)
    _check_side(state, block, shape)
    lead = _lead(state, shape, words)
    before = state.before
    rapid, feed = state.chosen_feed(words)
    functions(state, words)
    state.moving(block, rapid=rapid, feed=feed)
    state.apply(block)
    element = straight_element(state, block, end, rapid=rapid, feed=feed)
    state.position, state.last = end, None
    plane, hand = state.plane, _hand(state, state.side)
    state.push(ProgrammedStep(Role.APPROACH, element, state.offset, plane, lead=lead, hand=hand, before=before))


def depart(state: State, block: Block) -> None:
    """DEP LT, LN, CT, LCT and PLCT: pass on the lead away from the contour's last point; cancel compensation."""
    shape, polar, words = _read(state, block, "DEP")
    _check_side(state, block, shape)
    last = state.last
    if last is None:
        state.log.stop("HE7", "DEP needs a contour element directly before it. Write an L or C block first.", block)
    lead = _lead(state, shape, words)
    goal = _goal(state, words, shape, last, lead, polar=polar)
    rapid, feed = state.chosen_feed(words)
    functions(state, words)
    state.moving(block, rapid=rapid, feed=feed)
    element = straight_element(state, block, goal, rapid=rapid, feed=feed)._replace(start_direction=last.end_direction)
    hand = _hand(state, state.applied)
    state.push(ProgrammedStep(Role.DEPARTURE, element, state.offset, state.plane, lead=lead, hand=hand))
    state.position, state.last, state.side = goal, None, 0
    state.release()


def _read(state: State, block: Block, name: str) -> tuple[LeadShape, bool, Words]:
    """Return the shape of a lead, True if its point is polar, and its words."""
    lead = _FORM.match(block.body)
    if lead is None or (name == "DEP" and lead[1] and lead[2] != "LCT"):
        text = f"{name} needs its shape: LT, LN, CT or LCT{', or with polar coordinates PLT ...' * (name == 'APPR')}."
        state.log.stop("WORD", text, block)
    shape, polar = LeadShape(lead[2]), bool(lead[1])
    if polar:
        check_pole_plane(state, block)
    coordinates = POLAR_WORDS if polar else frozenset(AXIS_WORDS)
    return shape, polar, state.words(block.after(lead.end()), COMMON_WORDS | coordinates | set(_NEEDED_WORDS[shape]))


def _check_side(state: State, block: Block, shape: LeadShape) -> None:
    if shape in (LeadShape.LN, LeadShape.CT) and not (state.side or state.applied):
        text = f"{block.head} {shape} has no side without compensation. Write RL or RR with it."
        state.log.stop("HE4", text, block.at("R0"))
    if shape is LeadShape.LCT and not (state.side or state.applied):
        text = "cutcomp assumes this uncompensated arc is on the same side of the contour as the free point."
        state.log.inform("INTERPRETED", text, block)


def _lead(state: State, shape: LeadShape, words: Words) -> Lead:
    for name in _NEEDED_WORDS[shape]:
        if name not in words:
            state.log.stop("LEAD", f"{words.block.head} {shape} needs {name}. Write it with a number.", words.block)
    length = state.length(words, "LEN") if "LEN" in words else 0.0
    radius = state.length(words, "R") if "R" in words else 0.0
    angle = state.number(words, "CCA") if "CCA" in words else 0.0
    if length < 0.0 or ("LEN" in words and not length):
        state.log.stop("LEAD", "LEN must be above 0.", words.at("LEN"))
    if "R" in words and (not radius or (radius < 0.0 and shape is LeadShape.LCT)):
        least = "must be above 0" if shape is LeadShape.LCT else "cannot be 0"
        state.log.stop("LEAD", f"The radius of {words.block.head} {shape} {least}.", words.at("R"))
    if "CCA" in words and not 0.0 < angle <= 360.0:
        state.log.stop("LEAD", "CCA must be above 0, up to 360 degrees. The sign of R flips the arc.", words.at("CCA"))
    return Lead(shape, length, radius, radians(angle))


def _goal(state: State, words: Words, shape: LeadShape, last: Element, lead: Lead, *, polar: bool) -> list[float]:
    """Return where a departure ends: the programmed point for LCT, else the end of the lead itself."""
    end = end_point(state, words, polar=polar)
    point, height = state.flat(end)
    if shape is LeadShape.LCT:
        return end
    here = state.flat(state.position)[0]
    if point != here:
        state.log.stop("WORD", f"DEP {shape} ends where its lead ends. Only DEP LCT takes an end point.", words.block)
    start = offset_point(here, last.end_direction, state.offset)
    curve = departure(lead, start, here, last.end_direction, _hand(state, state.applied))
    return list(solid(*(curve.point if curve else here), height, state.plane))


def _hand(state: State, side: int) -> int:
    """Return the side of the tool, which a negative radius flips."""
    return side_of(state.offset).sign if state.offset else side
