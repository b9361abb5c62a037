"""The cells of the MILL CONTOUR form: START and the LINE, ARC and BLEND ARC segments."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Final

from app.screens.values import cell_of
from app.session.session import Session
from app.session.words import counted, length
from app.widgets.field import Cell, State
from core.finding import Finding
from core.pipeline.derived import DerivedBlock, Tag
from core.program.fields import SOLUTION, TABLES, Field, Form, form_of
from core.program.model import Block, Number, Segment, Unread
from core.program.solve.solution import Solution, solution_at
from core.program.solve.solved import Solved, SolvedRun, SolvedSegment, Value
from core.units import Unit

RIGHT_COLUMN: Final[Mapping[Form, frozenset[str]]] = MappingProxyType(
    {
        Form.START: frozenset({"plunge_feed", "speed", "peck_depth", "lookahead", "coolant"}),
        Form.LINE: frozenset({"length", "angle", "parallel", "offset", "feed", "tangent"}),
        Form.ARC: frozenset({"x_center", "y_center", "radius", "sweep", "start_angle", "feed", "tangent"}),
        Form.BLEND: frozenset({"feed"}),
        Form.CHAMFER: frozenset({"feed"}),
    }
)
"""The fields that stand in the right column of their form; the others stand in the left one."""


def form_at(session: Session) -> Form:
    """The form of the segment with the cursor."""
    return Form.START if session.segment is None else form_of(session.segment)


def fields_at(session: Session) -> tuple[Field, ...]:
    """The fields shown there, in the order in which the cursor goes through them."""
    return tuple(field for field in _every_field(form_at(session)) if _visible(session, field))


def _every_field(form: Form) -> tuple[Field, ...]:
    return (*TABLES[form], SOLUTION) if form in (Form.LINE, Form.ARC) else TABLES[form]


def _visible(session: Session, field: Field) -> bool:
    match field.name:
        case "lookahead":
            return session.derived_block.side is not None
        case "choice":
            return solution_here(session) is not None
        case _:
            return True


def cells_at(session: Session) -> tuple[Cell, ...]:
    """Every cell of the form there, also those that are not visible just now."""
    form, unit, missing = form_at(session), session.program.unit, missing_fields(session)
    cells = [
        _cell(session, field, int(field.name in RIGHT_COLUMN[form]), unit, needed=field.name in missing)
        for field in _every_field(form)
    ]
    extra: Iterator[Cell] = (
        _tool_cells(session.derived_block, unit) if session.segment is None else _end_cells(session, form, unit)
    )
    # the lines of START stand as on the control: what the control does not have comes last
    own = [cell for cell in cells if cell.name == "coolant"]
    return (*(cell for cell in cells if cell.name != "coolant"), *extra, *own)


def _cell(session: Session, field: Field, column: int, unit: Unit, *, needed: bool) -> Cell:
    visible = _visible(session, field)
    if field.name == "choice":
        solution = solution_here(session)
        text = "" if solution is None or solution.taken is None else solution.label
        labels = () if solution is None else solution.labels
        state = State.NEEDED if solution is not None and solution.taken is None else State.TYPED
        shown = "" if solution is None else solution.label
        return Cell("choice", field.label, text, column, state, "", shown, labels, visible, folds=True)
    if field.name == "coolant":
        return _coolant_cell(session, field)
    overrides = field.name == "lookahead" and session.derived_block.lookahead.tag is Tag.USR
    value = value_at(session, field.name)
    return cell_of(field, value, unit, column, needed=needed, overrides=overrides, visible=visible)


def _coolant_cell(session: Session, field: Field) -> Cell:
    solved = session.derived_block.solved
    text, origin = str(solved.coolant), solved.coolant_origin
    state = State.TYPED if origin is None else State.USUAL
    return Cell("coolant", field.label, text, 1, state, str(origin or ""), choices=field.choices)


def solution_here(session: Session) -> Solution | None:
    """What there is to choose at the segment with the cursor; None where there is no choice."""
    return None if session.segment is None else solution_at(session.derived_block.solved, session.place.segment)


def value_at(session: Session, name: str) -> Value | str:
    """What a field holds there: typed or calculated."""
    block, segment = session.derived_block, session.segment
    typed: Block | Segment = session.block if segment is None else segment
    if name in ("cutter_comp", "direction"):
        return str(getattr(typed, name))
    if name == "coolant":
        return str(block.solved.coolant)
    if name == "tangent":
        return "YES" if getattr(typed, name) else "NO"
    if name == "lookahead":
        return _lookahead(block)
    values = block.solved.values if segment is None else solved_segment(session).values
    held: Value = values.get(name, getattr(typed, name))
    return held


def _lookahead(block: DerivedBlock) -> Value:
    typed = block.block.lookahead
    if isinstance(typed, Unread):
        return typed
    value = float(block.lookahead.value)
    return Number(value) if block.lookahead.tag is Tag.USR else Solved(value)


def missing_fields(session: Session) -> tuple[str, ...]:
    """The blank fields of which the contour needs one more, or all on START."""
    if session.segment is not None:
        return solved_segment(session).missing
    findings = session.derived_block.solved.findings
    return tuple(finding.field for finding in findings if finding.code == "MISSING" and finding.field)


def solved_segment(session: Session) -> SolvedSegment:
    """What became of the segment with the cursor."""
    return session.derived_block.solved.segments[session.place.segment - 1]


def run_here(session: Session) -> SolvedRun | None:
    """The run of which the segment with the cursor is a part."""
    return session.derived_block.solved.run_of(session.place.segment)


def run_label(session: Session) -> str:
    """`RUN 2-4` in a run, and how many values it needs while that is known."""
    run = run_here(session)
    if run is None or run.first == run.last:
        return ""
    more = f"  {counted(run.missing, 'more value')}" if run.missing and run.taken is None else ""
    return f"RUN {run.first}-{run.last}{more}"


def run_trouble(session: Session) -> Finding | None:
    """Why the run of the segment with the cursor has no answer; it may stand at another segment."""
    run = run_here(session)
    if run is None or run.taken is not None:
        return None
    segments = session.derived_block.solved.segments[run.first - 1 : run.last]
    return next((each for segment in segments for each in segment.findings if each.code == run.code), None)


def _tool_cells(block: DerivedBlock, unit: Unit) -> Iterator[Cell]:
    diameter = block.solved.tool_diameter
    yield _read_only("TOOL DIAMETER", "" if diameter is None else length(diameter, unit), 1)
    yield _read_only("TYPE", block.solved.tool_type, 1)


def _end_cells(session: Session, form: Form, unit: Unit) -> Iterator[Cell]:
    """Where the segment starts, on the line that SOLUTION takes where there is a choice, and a corner's end."""
    solved = solved_segment(session)
    start = "" if solved.start is None else f"{length(solved.start[0], unit)} {length(solved.start[1], unit)}"
    shown = bool(start) and solution_here(session) is None
    yield replace(_read_only("START", start, 0, visible=shown), folds=True)
    if form in (Form.BLEND, Form.CHAMFER):
        end = None if solved.piece is None else solved.piece.end
        yield _read_only("X END", "" if end is None else length(end[0], unit), 1, visible=end is not None)
        yield _read_only("Y END", "" if end is None else length(end[1], unit), 1, visible=end is not None)


def _read_only(label: str, text: str, column: int, *, visible: bool = True) -> Cell:
    return Cell(label, f"({label}", f"{text})", column, State.READ_ONLY, visible=visible)
