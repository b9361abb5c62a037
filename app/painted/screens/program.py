"""PROGRAM: the list of blocks, and everything that is done to a whole program."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Final

from app.painted.messages import Browse, Do, Edit, Leave, Message, Move, Open, Save, Say, Swap
from app.painted.screens import doors
from app.painted.screens.contour import Contour
from app.painted.screens.page import Answer, Page, Softkey, Softkeys, Surface, View
from app.painted.session import Said, Session
from app.painted.widgets.header import header
from app.painted.widgets.rows import Look, Row, Span, plain
from core.finding import Severity
from core.pipeline.derived import DerivedBlock
from core.program.edit import FormPlace, copy_block, delete_block, insert_block, move_block
from core.program.model import Number, Program

if TYPE_CHECKING:
    from app.painted.desk import Desk

PROMPT: Final = "Enter edits the block, up and down go from block to block. Insert, copy, move or delete by softkey."


@dataclass(frozen=True, eq=False, slots=True)
class ProgramPage(Page):
    """The blocks; `set` is which set of softkeys is shown."""

    set: int = 0

    def softkeys(self, session: Session) -> Softkeys:
        """Three sets; F7 goes round."""
        return (_first, _second, _third)[self.set](self, session)

    def covered(self) -> ProgramPage:
        """Whoever comes back finds the first set."""
        return replace(self, set=0)

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """Up and down over the blocks, Enter into one."""
        at, last = session.where.block, len(session.program.blocks)
        there = {"up": at - 1, "down": at + 1, "home": 1, "end": last, "pageup": 1, "pagedown": last}.get(key)
        if there is not None:
            return Answer(self, (Move(FormPlace(min(max(there, 1), last))),))
        return Answer(self, (Move(session.where), Open(Contour()))) if key in ("enter", "right") else None

    def help(self, session: Session) -> tuple[str, ...]:
        """What a program is made of."""
        return (
            "PROGRAM",
            "A program is a list of blocks; a MILL CONTOUR block is one outline with its tool.",
            "VERDICT tells of each: clean, uncut (material stays), warning, GOUGE, not ready (something is missing or "
            "cannot be used: nothing is posted).",
            "F7 MORE shows further softkeys: moving blocks, SAVE AS, PROGRAM PARAMETERS, PART SETUP, TOOL SETUP, then "
            "the start screen, the setup sheet and the guided first part.",
        )

    def view(self, session: Session, surface: Surface) -> View:
        """One line a block."""
        at, blocks = session.where.block, session.derived.blocks
        rows = [_block_row(found, on_it=found.number == at) for found in blocks]
        room = max(surface.body - 2, 1)
        top = max(0, min(at - 1 - room // 2, len(rows) - room))
        title = plain(f" {len(rows)} block{'s' if len(rows) != 1 else ''}", Look.LABEL)
        return View(
            header("PROGRAM", title, session, surface.width),
            ((), _headings(), *rows[top : top + room]),
            Said(PROMPT),
            2 + at - 1 - top,
        )


def _headings() -> Row:
    return plain(f"  {'BLOCK':<7}{'KIND':<14}{'CUTTER COMP.':<15}{'TOOL':>4}{'SEG':>5}  {'VERDICT'}", Look.LABEL)


def _block_row(found: DerivedBlock, *, on_it: bool) -> Row:
    tool = f"{found.block.tool.value:g}" if isinstance(found.block.tool, Number) else "?"
    text = f"{found.number:>5}  MILL CONTOUR  {found.block.cutter_comp:<15}{tool:>4}{len(found.block.segments):>5}"
    word, look = verdict_word(found)
    mark = "> " if on_it else "  "
    return (Span(mark, Look.TAG), Span(f"{text}", Look.CURSOR if on_it else Look.TYPED), Span(f"  {word}", look))


def verdict_word(found: DerivedBlock) -> tuple[str, Look]:
    """The verdict on a block in one word."""
    if not found.known:
        return "...", Look.DIM
    if found.errors:
        gouges = any(finding.code.endswith(("GOUGE", "GOUGES")) for finding in found.errors)
        return ("GOUGE" if gouges else "not ready"), Look.ERROR
    if any(finding.severity is Severity.WARNING for finding in found.findings):
        return "warning", Look.WARNING
    uncut = found.paths is not None and found.paths.verdict is not None and found.paths.verdict.uncut
    return ("uncut", Look.WARNING) if uncut else ("clean", Look.GOOD)


def _first(page: ProgramPage, session: Session) -> Softkeys:
    at, program = session.where.block, session.program
    behind = Edit(insert_block(program, at + 1), f"INSERT BLOCK {at + 1}")
    told = Say(f"Deleted block {at}. Ctrl+Z brings it back.")
    return {
        1: Softkey("DELETE BLOCK", (Edit(delete_block(program, at), f"DELETE BLOCK {at}"), told)),
        2: Softkey("INSERT BLOCK BEHIND", (behind, Move(FormPlace(at + 1)), Open(Contour()))),
        3: Softkey("COPY BLOCK", (Edit(copy_block(program, at), f"COPY BLOCK {at}"), Move(FormPlace(at + 1)))),
        4: Softkey("OPEN", (Browse(),)),
        5: Softkey("SAVE", save_messages(session)),
        6: Softkey("POST NC", (Open(partial(doors.post, session)),)),
        7: Softkey("MORE", (Swap(replace(page, set=1)),)),
        8: Softkey("EXIT", (Leave(),)),
    }


def _second(page: ProgramPage, session: Session) -> Softkeys:
    at, program = session.where.block, session.program
    return {
        1: Softkey("MOVE BLOCK UP", _moved(program, at, at - 1, "UP")),
        2: Softkey("MOVE BLOCK DOWN", _moved(program, at, at + 1, "DOWN")),
        3: Softkey("SAVE AS", (Open(partial(doors.save_as, session)),)),
        4: Softkey("PROGRAM PARAMETERS", (Open(doors.parameters),)),
        5: Softkey("PART SETUP", (Open(doors.setup),)),
        6: Softkey("TOOL SETUP", (Open(doors.tools),)),
        7: Softkey("MORE", (Swap(replace(page, set=2)),)),
        8: Softkey("EXIT", (Leave(),)),
    }


def _moved(program: Program, at: int, to: int, way: str) -> tuple[Message, ...]:
    if not 1 <= to <= len(program.blocks):
        return (Say(f"Block {at} is the {'first' if to < 1 else 'last'} one: it cannot move {way.lower()}."),)
    return (Edit(move_block(program, at, to), f"MOVE BLOCK {at} {way}"), Move(FormPlace(to)))


def _third(page: ProgramPage, session: Session) -> Softkeys:
    return {
        1: Softkey("START SCREEN", (Do(shown),)),
        2: Softkey("SETUP SHEET", (Open(partial(doors.sheet, session)),)),
        3: Softkey("KEYS AND HELP", (Open(partial(doors.keys_and_help, page.help(session))),)),
        4: Softkey("GUIDED FIRST PART", (Do(guide_on),)),
        5: Softkey("NC PROOF", (Do(proving),)),
        7: Softkey("MORE", (Swap(replace(page, set=0)),)),
        8: Softkey("EXIT", (Leave(),)),
    }


def shown(desk: Desk) -> Desk:
    """The start screen on top."""
    from app.painted import starting

    return starting.shown(desk)


def guide_on(desk: Desk) -> Desk:
    """The guided first part, or its end."""
    from app.painted import guide

    return guide.turned(desk)


def proving(desk: Desk) -> Desk:
    """The NC files to choose one from."""
    from app.painted.screens.proof_files import browsing

    return browsing()(desk)


def save_messages(session: Session) -> tuple[Message, ...]:
    """SAVE: under the program's name, or asking for one."""
    return (Save(),) if session.file is not None else (Open(partial(doors.save_as, session)),)
