"""Deletes, inserts, copies and moves blocks, on the screens that show one, and recalculates their look-ahead."""

from __future__ import annotations

from typing import Final

from textual import work

from app.documents.questions import GO_BACK, Answer
from app.screens.base import BaseScreen
from app.screens.dialogs import Question
from app.screens.field_texts import shown_text
from core.program.edit import (
    SHARED_FIELDS,
    FormPlace,
    Refused,
    copy_block,
    delete_block,
    insert_block,
    move_block,
    recalculate_lookahead,
    share_values,
)
from core.program.fields import Form, field_of
from core.program.model import Number, Program, Unread
from core.units import Kind, show

COPY_AND_MOVE: Final = (
    ("COPY BLOCK", "screen.copy_block", "C on PROGRAM"),
    ("MOVE BLOCK UP", "screen.move_block(-1)", "Ctrl+Up on PROGRAM"),
    ("MOVE BLOCK DOWN", "screen.move_block(1)", "Ctrl+Down on PROGRAM"),
    ("SAME VALUES IN ALL BLOCKS", "screen.share_values", "tool, depths, speed of this block"),
)
INSERT_AND_DELETE: Final = (
    ("INSERT BLOCK AFTER", "screen.insert_block", "F2 on PROGRAM"),
    ("DELETE BLOCK", "screen.delete_block", "F1 on PROGRAM"),
)
"""Name, action and hint of what these screens do with the block with the cursor, in the palette."""


class BlockActions(BaseScreen):
    """What is done with the block with the cursor, each as one edit; a new segment that is still empty is left out."""

    @property
    def chosen(self) -> int:
        """The number of the block with the cursor."""
        return self.current_session.place.block

    def _taken(self) -> Program | None:
        """Take what is half-typed and return the program without an empty new segment; None if it is refused."""
        return self.current_session.without_empty().program if self.take() else None

    def edit_block(self, number: int, field: str) -> None:
        """Open the form of a block with the cursor on a field of START."""
        self.host.move(FormPlace(number), field)
        self.app.call_later(self.app.run_action, "app.contour")

    def action_insert_block(self) -> None:
        """Insert a block after the one with the cursor and open its form."""
        program, at = self._taken(), self.chosen + 1
        if program is not None and self.host.apply(insert_block(program, at), f"INSERT BLOCK {at}"):
            self.edit_block(at, "tool")
            self.notify(depths_kept(self.current_session.program, at), timeout=6)

    def action_delete_block(self) -> None:
        """Delete the block with the cursor."""
        program, at = self._taken(), self.chosen
        if program is not None and self.host.apply(delete_block(program, at), f"DELETE BLOCK {at}"):
            self.notify(f"Deleted block {at}. Ctrl+Z brings it back.", timeout=3)

    def action_copy_block(self) -> None:
        """Insert a copy of the block with the cursor after it, and go there."""
        program, at = self._taken(), self.chosen
        if program is not None and self.host.apply(copy_block(program, at), f"COPY BLOCK {at}"):
            self.host.move(FormPlace(at + 1))
            self.say(f"Block {at + 1} is a copy of block {at}.")

    def action_move_block(self, by: int) -> None:
        """Move the block with the cursor up or down by one."""
        program, at, to = self._taken(), self.chosen, self.chosen + by
        segment = self.current_session.place.segment
        if program is None:
            return
        if not 1 <= to <= len(program.blocks):
            self.say(f"Block {at} is the {'first' if by < 0 else 'last'} one.")
        elif self.host.apply(move_block(program, at, to), f"MOVE BLOCK {at} {'UP' if by < 0 else 'DOWN'}"):
            self.host.move(FormPlace(to, segment))
            self.say(f"Block {at} is block {to} now.")

    def action_recalculate(self) -> None:
        """Restore the calculated look-ahead of the block with the cursor."""
        session, number = self.current_session, self.chosen
        recalculated = recalculate_lookahead(session.program, number)
        if self.host.apply(recalculated, f"RECALCULATE LOOKAHEAD, block {number}"):
            self.say(f"CUTCOMP LOOKAHEAD is calculated: CAL {session.derived.block(number).lookahead.calculated}.")

    @work(exclusive=True, group="question")
    async def action_share_values(self) -> None:
        """Give the tool, depths, speed, plunge feed and coolant of this block to all others, after a question."""
        program, at = self._taken(), self.chosen
        if program is None:
            return
        every, blank = (share_values(program, at, only_blank=only_blank) for only_blank in (False, True))
        if isinstance(every, Refused):
            self.say(every.text)
            return
        answers = [Answer("ALL", "replaces what they have")]
        if not isinstance(blank, Refused):
            answers.append(Answer("BLANK", "only what they leave blank"))
        lines = [f"Into all other blocks, from block {at}:", shared_words(program, at)]
        title = "SAME VALUES IN ALL BLOCKS"
        word = await self.app.push_screen_wait(Question(title, lines, answers, GO_BACK))
        if word != GO_BACK and self.host.apply(every if word == "ALL" else blank, title):
            which = "All blocks" if word == "ALL" else "The blank fields of all blocks"
            self.notify(f"{which} have the values of block {at} now. Ctrl+Z undoes it.", timeout=5)


def shared_words(program: Program, at: int) -> str:
    """Return the fields of block `at` that all blocks can have, each with its value."""
    block, words = program.blocks[at - 1], []
    for name in SHARED_FIELDS:
        field, value = field_of(Form.START, name), getattr(block, name)
        if value is None:
            words.append(f"{field.label} blank")
        elif not isinstance(value, Unread):
            words.append(f"{field.label} {shown_text(value, field, program.unit)}")
    return ", ".join(words)


def depths_kept(program: Program, at: int) -> str:
    """Return what new block `at` has taken from the block before it, with the depths, as its cut may be shallower."""
    block, unit = program.blocks[at - 1], program.unit
    fields = (("Z BOTTOM", block.z_bottom), ("PECK DEPTH", block.peck_depth))
    depths = [f"{name} {show(typed.value, Kind.LENGTH, unit)}" for name, typed in fields if isinstance(typed, Number)]
    return f"Tool, feeds and depths as in block {at - 1}{': ' if depths else ''}{', '.join(depths)}."
