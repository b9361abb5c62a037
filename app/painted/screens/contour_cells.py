"""The cells of the MILL CONTOUR form: START and the LINE, ARC and BLEND ARC segments."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import lru_cache
from types import MappingProxyType
from typing import Final

from app.painted.screens.forms import cell_of
from app.painted.session import Session
from app.painted.widgets.form import Cell, State
from core.pipeline.derived import DerivedBlock, Tag
from core.program.fields import SOLUTION, TABLES, Field, Form, form_of
from core.program.model import Block, Number, Segment, Unread
from core.program.solve.block import ZERO_IF_BLANK
from core.program.solve.solved import Solved, SolvedSegment, Value
from core.units import Kind, Unit, from_mm, show

_START: Final[Mapping[str, tuple[int, int]]] = MappingProxyType(
    {
        "tool": (0, 0),
        "cutter_comp": (0, 1),
        "finish_tool": (0, 2),
        "x_start": (0, 3),
        "y_start": (0, 4),
        "z_start": (0, 5),
        "z_bottom": (0, 6),
        "plunge_feed": (1, 0),
        "speed": (1, 1),
        "peck_depth": (1, 2),
        "lookahead": (1, 3),
    }
)
_LINE: Final[Mapping[str, tuple[int, int]]] = MappingProxyType(
    {
        "x_end": (0, 0),
        "y_end": (0, 1),
        "z_end": (0, 2),
        "length": (1, 0),
        "angle": (1, 1),
        "feed": (1, 2),
        "choice": (1, 3),
    }
)
_ARC: Final[Mapping[str, tuple[int, int]]] = MappingProxyType(
    {
        "direction": (0, 0),
        "x_end": (0, 1),
        "y_end": (0, 2),
        "z_end": (0, 3),
        "x_center": (1, 0),
        "y_center": (1, 1),
        "radius": (1, 2),
        "sweep": (1, 3),
        "feed": (1, 4),
        "choice": (1, 5),
    }
)
_BLEND: Final[Mapping[str, tuple[int, int]]] = MappingProxyType({"radius": (0, 0), "feed": (1, 0)})

PLACES: Final[Mapping[Form, Mapping[str, tuple[int, int]]]] = MappingProxyType(
    {
        Form.START: _START,
        Form.LINE: _LINE,
        Form.ARC: _ARC,
        Form.BLEND: _BLEND,
        Form.CHAMFER: {"length": (0, 0), "feed": (1, 0)},
    }
)
"""Column and line of every field on its form."""


def form_at(session: Session) -> Form:
    """The form of the segment with the cursor."""
    segment = session.segment
    return Form.START if segment is None else form_of(segment)


def fields_at(session: Session) -> tuple[Field, ...]:
    """The fields shown there, in the order in which the cursor goes through them."""
    form = form_at(session)
    # the fields that tie segments to each other have no place on these screens
    table = tuple(one for one in TABLES[form] if one.name in PLACES[form])
    if form is Form.START:
        return table if session.found.side is not None else tuple(one for one in table if one.name != "lookahead")
    return (*table, SOLUTION) if len(_solved(session).choices) > 1 else table


def value_at(session: Session, name: str) -> Value | str:
    """What a field holds there."""
    return _held(*_there(session), name)


def _there(session: Session) -> tuple[DerivedBlock, Block | Segment, Mapping[str, Value]]:
    """The block, what was typed there, and what became of it."""
    found, segment = session.found, session.segment
    if segment is None:
        return found, session.block, found.solved.values
    return found, segment, _solved(session).values


def _held(found: DerivedBlock, typed: Block | Segment, values: Mapping[str, Value], name: str) -> Value | str:
    if name in ("cutter_comp", "direction"):
        return str(getattr(typed, name))
    if name == "choice":
        picked = getattr(typed, name)
        return "" if picked is None else str(picked)
    if name == "lookahead":
        return _lookahead(found)
    held: Value = values.get(name, getattr(typed, name))
    return held


def _lookahead(found: DerivedBlock) -> Value:
    typed = found.block.lookahead
    if isinstance(typed, Unread):
        return typed
    value = float(found.lookahead.value)
    return Number(value) if found.lookahead.tag is Tag.USR else Solved(value)


def cells_at(session: Session) -> tuple[Cell, ...]:
    """Every cell of the form there, the read-only ones too."""
    places, unit = PLACES[form_at(session)], session.program.unit
    missing, there = _missing(session), _there(session)
    cells = (
        _cell(one, _held(*there, one.name), unit, places[one.name], needed=one.name in missing)
        for one in fields_at(session)
    )
    extra = _start_extra(session.found, unit) if session.segment is None else _segment_extra(_solved(session), unit)
    return (*cells, *extra)


def _missing(session: Session) -> tuple[str, ...]:
    """The blank fields of which the contour needs one more, or all on START."""
    if session.segment is not None:
        return _solved(session).missing
    return tuple(one.field for one in session.found.solved.findings if one.code == "MISSING" and one.field)


@lru_cache(256)
def _cell(one: Field, held: Value | str, unit: Unit, place: tuple[int, int], *, needed: bool) -> Cell:
    cell = cell_of(one, held, unit, *place, needed=needed)
    if one.name == "lookahead" and cell.state is State.TYPED:
        return cell._replace(tag=str(Tag.USR))
    if one.name in ZERO_IF_BLANK and cell.state is State.CALCULATED:
        return cell._replace(tag="DEF")
    if one.name == "choice":
        return cell._replace(text=f"{int(cell.text) + 1} of 2" if cell.text else "?")
    return cell


def _start_extra(found: DerivedBlock, unit: Unit) -> Iterator[Cell]:
    diameter = found.solved.tool_diameter
    yield _read_only("TOOL DIAMETER", "" if diameter is None else _length(diameter, unit), 1, 4)
    yield _read_only("TYPE", found.solved.tool_type, 1, 5)


def _segment_extra(solved: SolvedSegment, unit: Unit) -> Iterator[Cell]:
    if solved.start is not None:
        yield _read_only("X START", _length(solved.start[0], unit), 0, 5)
        yield _read_only("Y START", _length(solved.start[1], unit), 0, 6)
    if "x_end" not in solved.values and solved.piece is not None:
        yield _read_only("X END", _length(solved.piece.end[0], unit), 1, 5)
        yield _read_only("Y END", _length(solved.piece.end[1], unit), 1, 6)


def _read_only(label: str, text: str, column: int, line: int) -> Cell:
    return Cell(label, label, text, column, line, State.READ_ONLY)


def _length(millimeters: float, unit: Unit) -> str:
    return show(from_mm(millimeters, unit), Kind.LENGTH, unit)


def _solved(session: Session) -> SolvedSegment:
    return session.found.solved.segments[session.where.segment - 1]
