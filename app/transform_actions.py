"""TransformActions shifts, rotates or mirrors a block, or repeats segments, each as one edit."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final

from textual import work

from app.file_actions import FileActions
from app.screens.dialogs import NumberEntry, NumberForm
from app.session.formats import segment_numbers
from core.program import block_motion
from core.program.edit import Edited, Refused
from core.units import Kind, to_mm

X_ENTRY: Final = NumberEntry("X", Kind.LENGTH)
Y_ENTRY: Final = NumberEntry("Y", Kind.LENGTH)
CENTER_ENTRIES: Final = (NumberEntry("X CENTER", Kind.LENGTH), NumberEntry("Y CENTER", Kind.LENGTH))
ANGLE_ENTRY: Final = NumberEntry("ANGLE", Kind.ANGLE, "90")
COPIES_ENTRY: Final = NumberEntry("COPIES", Kind.COUNT, "1")


class TransformActions(FileActions):
    """The App's part for transforming shapes."""

    async def _edited(
        self, title: str, line: str, entries: Sequence[NumberEntry], edit: Callable[..., Edited]
    ) -> Edited | None:
        """Ask for numbers, in program units and degrees, and return the edit; None on Esc.  Call only in a worker."""

        def refusal(*numbers: float) -> str:
            edited = edit(*numbers)
            return edited.text if isinstance(edited, Refused) else ""

        form = NumberForm(title, [line], entries, self.session.program.unit, refusal)
        numbers = await self.push_screen_wait(form)
        return edit(*numbers) if numbers else None

    def _length(self, value: float) -> float:
        return to_mm(value, self.session.program.unit)

    def _shifted(self, x: float, y: float) -> block_motion.Motion:
        return block_motion.shift(self._length(x), self._length(y))

    def _rotated(self, x: float, y: float, angle: float) -> block_motion.Motion:
        return block_motion.rotation((self._length(x), self._length(y)), angle)

    def _mirrored(self, x: float, y: float, angle: float) -> block_motion.Motion:
        return block_motion.reflection((self._length(x), self._length(y)), angle)

    async def _block(
        self, title: str, line: str, entries: Sequence[NumberEntry], motion_of: Callable[..., block_motion.Motion]
    ) -> None:
        # taken later, a number would go into the transformed shape
        if not self.take_typed():
            return
        session = self.session.without_empty()
        program, number = session.program, session.place.block
        edited = await self._edited(
            title, line, entries, lambda *numbers: block_motion.transform_block(program, number, motion_of(*numbers))
        )
        if edited is not None and self.apply(edited, f"{title} {number}"):
            # messages about the previous edit no longer apply
            self.clear_notice()
            before, after = (each.blocks[number - 1] for each in (program, self.session.program))
            side = "" if after.cutter_comp is before.cutter_comp else f" CUTTER COMP. is {after.cutter_comp} now."
            retyped = segment_numbers(block_motion.no_longer_typed(before, after))
            points = f" Typed points replace the data of segments {retyped}." if retyped else ""
            self.notify(f"{title} {number} is done.{side}{points} Ctrl+Z undoes it.", timeout=4)

    @work(exclusive=True, group="question")
    async def action_shift_block(self) -> None:
        """Shift the block with the cursor."""
        await self._block("SHIFT BLOCK", "Distance to move in X and in Y.", (X_ENTRY, Y_ENTRY), self._shifted)

    @work(exclusive=True, group="question")
    async def action_rotate_block(self) -> None:
        """Rotate the block with the cursor about a point."""
        line = "Counterclockwise about the center, in degrees."
        await self._block("ROTATE BLOCK", line, (*CENTER_ENTRIES, ANGLE_ENTRY), self._rotated)

    @work(exclusive=True, group="question")
    async def action_mirror_block(self) -> None:
        """Mirror the block with the cursor about a line."""
        line = "About the line through X, Y at ANGLE; 90 swaps left and right."
        await self._block("MIRROR BLOCK", line, (X_ENTRY, Y_ENTRY, ANGLE_ENTRY), self._mirrored)

    @work(exclusive=True, group="question")
    async def action_repeat_shifted(self) -> None:
        """Repeat segments, each copy shifted from the one before."""
        await self._repeat("REPEAT, SHIFTED", (X_ENTRY, Y_ENTRY), self._shifted)

    @work(exclusive=True, group="question")
    async def action_repeat_rotated(self) -> None:
        """Repeat segments, each copy rotated about a point from the one before."""
        await self._repeat("REPEAT, ROTATED", (*CENTER_ENTRIES, ANGLE_ENTRY), self._rotated)

    async def _repeat(
        self, title: str, entries: Sequence[NumberEntry], motion_of: Callable[..., block_motion.Motion]
    ) -> None:
        # taken later, a number would go into the transformed shape
        if not self.take_typed():
            return
        session = self.session.without_empty()
        program, place = session.program, session.place

        def repeated(first: float, last: float, *numbers: float) -> Edited:
            *values, copies = numbers
            motion = motion_of(*values)
            return block_motion.repeat_segments(program, place.block, int(first), int(last), motion, int(copies))

        current = str(min(max(self.session.place.segment, 1), max(len(session.block.segments), 1)))
        segment_entries = (
            NumberEntry("FIRST SEGMENT", Kind.COUNT, current),
            NumberEntry("LAST SEGMENT", Kind.COUNT, current),
        )
        line = "The copies follow the last of these segments."
        edited = await self._edited(title, line, (*segment_entries, *entries, COPIES_ENTRY), repeated)
        if edited is not None and self.apply(edited, f"{title}, block {place.block}"):
            # messages about the previous edit no longer apply
            self.clear_notice()
