"""This module makes the cells of the MILL CONTOUR form, for START and every kind of segment.

It also decides where Enter stops: at fields that need an answer; arrows reach the rest.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Final

from app.screens.field_texts import cell_of, unusable
from app.session.formats import counted, length
from app.session.session import Session
from app.widgets.field import Cell, State
from core.finding import Finding
from core.pipeline.derived import DerivedBlock, Tag
from core.program.fields import FIELDS_OF_FORM, SOLUTION, Field, Form, form_of
from core.program.model import Block, Number, Segment, Unread
from core.program.solve.solved import Solution, Solved, SolvedRun, SolvedSegment, Value, solution_at
from core.units import Unit

RIGHT_COLUMN: Final[Mapping[Form, frozenset[str]]] = {
    Form.START: frozenset({"plunge_feed", "speed", "peck_depth", "lookahead", "coolant"}),
    Form.LINE: frozenset({"length", "angle", "parallel", "offset", "feed", "tangent"}),
    Form.ARC: frozenset({"x_center", "y_center", "radius", "sweep", "start_angle", "feed", "tangent"}),
    Form.BLEND: frozenset({"feed"}),
    Form.CHAMFER: frozenset({"feed"}),
}
"""The fields in the right column of each form; all others are in the left one."""
MISSING_CODES: Final = frozenset({"MISSING", "TOOL_VALUE"})
"""The findings on blank fields of START that are needed."""
PERMANENT_STOPS: Final[Mapping[Form, frozenset[str]]] = {
    Form.START: frozenset({"cutter_comp", "x_start", "y_start"}),
    Form.LINE: frozenset({"x_end", "y_end"}),
    Form.ARC: frozenset({"direction", "x_end", "y_end"}),
    Form.BLEND: frozenset({"radius"}),
    Form.CHAMFER: frozenset({"length"}),
}
"""The fields at which Enter always stops."""
UNLESS_CALCULATED: Final = frozenset({"x_center", "y_center", "radius"})
"""The fields of an ARC at which Enter stops unless they are calculated."""


def form_at(session: Session) -> Form:
    """Return the form of the segment with the cursor."""
    return Form.START if session.segment is None else form_of(session.segment)


def fields_at(session: Session) -> tuple[Field, ...]:
    """Return the visible fields of that form, in cursor order."""
    return tuple(field for field in _every_field(form_at(session)) if _visible(session, field))


def _every_field(form: Form) -> tuple[Field, ...]:
    return (*FIELDS_OF_FORM[form], SOLUTION) if form in (Form.LINE, Form.ARC) else FIELDS_OF_FORM[form]


def _visible(session: Session, field: Field) -> bool:
    match field.name:
        case "lookahead":
            return session.derived_block.side is not None
        case "choice":
            return solution_here(session) is not None
        case _:
            return True


def cells_at(session: Session) -> tuple[Cell, ...]:
    """Return every cell of that form, including those not visible now."""
    form, unit, missing = form_at(session), session.program.unit, missing_fields(session)
    cells = [
        _cell(session, field, int(field.name in RIGHT_COLUMN[form]), unit, needed=field.name in missing)
        for field in _every_field(form)
    ]
    extra: Iterator[Cell] = (
        _tool_cells(session.derived_block, unit) if session.segment is None else _end_cells(session, form, unit)
    )
    # START keeps the order of the control; COOLANT, which the control does not have, comes last
    last = [cell for cell in cells if cell.name == "coolant"]
    return (*(cell for cell in cells if cell.name != "coolant"), *extra, *last)


def _cell(session: Session, field: Field, column: int, unit: Unit, *, needed: bool) -> Cell:
    visible = _visible(session, field)
    if field.name == "choice":
        solution = solution_here(session)
        text = "" if solution is None or solution.taken is None else solution.label
        labels = () if solution is None else solution.labels
        state = State.NEEDED if solution is not None and solution.taken is None else State.TYPED
        full = "" if solution is None else solution.label
        return Cell("choice", field.label, text, column, state, "", full, labels, visible, folds=True)
    if field.name == "coolant":
        solved = session.derived_block.solved
        state = State.TYPED if solved.coolant_origin is None else State.USUAL
        tag = str(solved.coolant_origin or "")
        return Cell("coolant", field.label, str(solved.coolant), 1, state, tag, choices=field.choices)
    overrides = field.name == "lookahead" and session.derived_block.lookahead.tag is Tag.USR
    value = value_at(session, field.name)
    return cell_of(field, value, unit, column, needed=needed, overrides=overrides, visible=visible)


def solution_here(session: Session) -> Solution | None:
    """Return the solutions to choose from at the segment with the cursor; None if there is no choice."""
    return None if session.segment is None else solution_at(session.derived_block.solved, session.place.segment)


def value_at(session: Session, name: str) -> Value | str:
    """Return the typed or calculated value of a field of that form."""
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
    value: Value = values.get(name, getattr(typed, name))
    return value


def _lookahead(block: DerivedBlock) -> Value:
    typed = block.block.lookahead
    if isinstance(typed, Unread):
        return typed
    value = float(block.lookahead.value)
    return Number(value) if block.lookahead.tag is Tag.USR else Solved(value)


def missing_fields(session: Session) -> tuple[str, ...]:
    """Return the blank fields of a segment of which one more is needed; on START, all of those that are needed."""
    if session.segment is not None:
        return solved_segment(session).missing
    findings = session.derived_block.solved.findings
    return tuple(finding.field for finding in findings if finding.code in MISSING_CODES and finding.field)


def solved_segment(session: Session) -> SolvedSegment:
    """Return the solved segment with the cursor."""
    return session.derived_block.solved.segments[session.place.segment - 1]


def run_here(session: Session) -> SolvedRun | None:
    """Return the run that contains the segment with the cursor, if any."""
    return session.derived_block.solved.run_of(session.place.segment)


def run_label(session: Session) -> str:
    """Return `RUN 2-4` for a run, with the number of missing values if known; empty outside a run."""
    run = run_here(session)
    if run is None or run.first == run.last:
        return ""
    more = f"  {counted(run.missing, 'more value')}" if run.missing and run.taken is None else ""
    return f"RUN {run.first}-{run.last}{more}"


def run_trouble(session: Session) -> Finding | None:
    """Return why the run at the cursor has no answer; the finding may belong to another of its segments."""
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
    """Yield the segment's start, on the line SOLUTION uses if there is a choice, and a blend's or chamfer's end."""
    solved = solved_segment(session)
    start = "" if solved.start is None else f"{length(solved.start[0], unit)} {length(solved.start[1], unit)}"
    visible = bool(start) and solution_here(session) is None
    yield replace(_read_only("START", start, 0, visible=visible), folds=True)
    if form in (Form.BLEND, Form.CHAMFER):
        end = None if solved.piece is None else solved.piece.end
        yield _read_only("X END", "" if end is None else length(end[0], unit), 1, visible=end is not None)
        yield _read_only("Y END", "" if end is None else length(end[1], unit), 1, visible=end is not None)


def _read_only(label: str, text: str, column: int, *, visible: bool = True) -> Cell:
    return Cell(label, f"({label}", f"{text})", column, State.READ_ONLY, visible=visible)


# ---- where Enter stops


def next_stop(session: Session, name: str) -> str | None:
    """Return the next field after `name` at which Enter stops; None after the last one."""
    fields = fields_at(session)
    names = [field.name for field in fields]
    after = fields[names.index(name) + 1 :] if name in names else fields
    return next((field.name for field in after if stops(session, field)), None)


def unanswered(session: Session) -> str | None:
    """Return the first field that still needs an answer: it is blank and needed, or unusable; None if there is none."""
    return next((field.name for field in fields_at(session) if _needs_answer(session, field)), None)


def stops(session: Session, field: Field) -> bool:
    """Return whether Enter stops at a field."""
    form = form_at(session)
    if field.name in PERMANENT_STOPS[form] or _needs_answer(session, field):
        return True
    if form is Form.ARC and field.name in UNLESS_CALCULATED:
        return not isinstance(value_at(session, field.name), Solved)
    solution = solution_here(session)
    return field.name == "choice" and solution is not None and solution.taken is None


def run_stops(session: Session) -> bool:
    """Return whether the run at the cursor has no answer and later segments cannot give one."""
    run = run_here(session)
    if run is None or run.taken is not None or run.code == "PICK_SOLUTION":
        return False
    last = session.block.segments[run.last - 1]
    ends = (getattr(last, "x_end", None), getattr(last, "y_end", None))
    return run.code != "MISSING" or all(isinstance(end, Number) for end in ends)


def run_lacks(session: Session) -> bool:
    """Return whether more values would help the run at the cursor: too few, or not solvable from these yet."""
    run = run_here(session)
    return run is not None and run.code in ("MISSING", "NOT_YET")


def _needs_answer(session: Session, field: Field) -> bool:
    value = value_at(session, field.name)
    if isinstance(value, Unread) or unusable(value, field, session.program.unit) is not None:
        return True
    return value is None and field.name in missing_fields(session)
