"""Walking over the segments of a block, and the softkeys of its form, field by field."""

from __future__ import annotations

from functools import partial

from app.painted.messages import Close, Edit, Message, Move, Open, Say
from app.painted.screens import doors
from app.painted.screens.contour_cells import form_at
from app.painted.screens.page import Softkey, Softkeys
from app.painted.session import SEGMENT, Session, Tone
from core.pipeline.derived import Tag
from core.program.edit import FormPlace, choose, delete_segment, recalculate_lookahead
from core.units import Kind, from_mm, show


def advance(session: Session) -> tuple[Message, ...]:
    """To the next segment; behind the last one a new one is offered."""
    where = session.where
    if where.segment < len(session.block.segments):
        return (Move(FormPlace(where.block, where.segment + 1)),)
    return (Move(where), Open(partial(doors.new_segment, where.segment + 1)))


def back(session: Session) -> tuple[Message, ...]:
    """To the segment before."""
    where = session.where
    if where.segment == 0:
        return (Move(where), Say("START is the first segment."))
    return (Move(FormPlace(where.block, where.segment - 1)),)


def jump(session: Session, digits: str) -> tuple[Message, ...]:
    """To the segment of that number."""
    if not (digits.isascii() and digits.isdigit()):
        return (Say(f"{digits} is no segment number: type digits only, such as 3, then Enter.", Tone.ERROR),)
    number, last = int(digits), len(session.block.segments)
    if number <= last:
        return (Move(FormPlace(session.where.block, number)),)
    behind = f"the last one is {last}" if last else "there is only START yet"
    return (Say(f"There is no segment {number}: {behind}. Right arrow past the last adds one.", Tone.ERROR),)


def softkeys(session: Session, cursor: str) -> Softkeys:
    """F1 to F8 for the field with the cursor."""
    if cursor == SEGMENT:
        return _recalculating(session) | _segment_keys(session) | _common()
    if cursor == "lookahead":
        return _lookahead_keys(session) | {7: _draw(), 8: Softkey("EXIT", (Close(),))}
    return _recalculating(session) | _solution_keys(session) | _common()


def _recalculating(session: Session) -> dict[int, Softkey]:
    """F3 acts everywhere on START; its label stands where it would change something."""
    if session.where.segment:
        return {}
    typed = session.found.side is not None and session.found.lookahead.tag is Tag.USR
    return {3: Softkey("RECALCULATE LOOKAHEAD" if typed else "", recalculated(session))}


def _segment_keys(session: Session) -> dict[int, Softkey]:
    where = session.where
    deleted = Edit(delete_segment(session.program, where), f"DELETE SEGMENT {where.segment}, block {where.block}")
    insert: Message = Open(partial(doors.new_segment, where.segment))
    if where.segment == 0:
        insert = Say("START comes first: nothing goes before it.", Tone.ERROR)
    left = len(session.block.segments) - 1
    told = Say(f"Deleted segment {where.segment}, {form_at(session)}; {left} left. Ctrl+Z brings it back.")
    return {1: Softkey("DELETE SEGMENT", (deleted, told)), 2: Softkey("INSERT SEGMENT BEFORE", (insert,))}


def _lookahead_keys(session: Session) -> dict[int, Softkey]:
    table = Open(partial(doors.lookahead_table, session.found.lookahead.value))
    return {3: Softkey("RECALCULATE LOOKAHEAD", recalculated(session)), 4: Softkey("LOOKAHEAD TABLE", (table,))}


def recalculated(session: Session) -> tuple[Message, ...]:
    """F3 on START: the calculated look-ahead comes back."""
    if session.found.side is None:
        return (Say("CUTTER COMP. is ON: there is no look-ahead to calculate."),)
    outcome = recalculate_lookahead(session.program, session.where.block)
    done = Say(f"CUTCOMP LOOKAHEAD is calculated: CAL {session.found.lookahead.calculated}.")
    return (Edit(outcome, f"RECALCULATE LOOKAHEAD, block {session.where.block}"), done)


def _solution_keys(session: Session) -> dict[int, Softkey]:
    """Where two solutions fit, F1 and F2 pick one; the label says where each leads."""
    if session.segment is None:
        return {}
    solved = session.found.solved.segments[session.where.segment - 1]
    keys = {}
    centers = [piece.center for piece in solved.choices if hasattr(piece, "center")]
    apart = len(set(centers)) > 1
    for index, piece in enumerate(solved.choices):
        x, y = centers[index] if apart else piece.end
        texts = (show(from_mm(number, session.program.unit), Kind.LENGTH, session.program.unit) for number in (x, y))
        edit = Edit(
            choose(session.program, session.where, "choice", index), f"SOLUTION of segment {session.where.segment}"
        )
        keys[index + 1] = Softkey(f"SOLUTION {index + 1}  {' '.join(texts)}", (edit,))
    return keys


def _common() -> dict[int, Softkey]:
    return {
        4: Softkey("PROGRAM PARAMETERS", (Open(doors.parameters),)),
        5: Softkey("PART SETUP", (Open(doors.setup),)),
        6: Softkey("TOOL SETUP", (Open(doors.tools),)),
        7: _draw(),
        8: Softkey("EXIT", (Close(),)),
    }


def _draw() -> Softkey:
    return Softkey("DRAW", (Open(doors.draw),))
