"""What the App does to whole shapes: a block moved, rotated or mirrored, segments repeated, each as one edit."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Sequence
from typing import Final

from textual import work
from textual.app import App

from app.screens.dialogs import NumberEntry, NumberForm
from app.session.session import Session
from core.program import transform
from core.program.edit import Edited
from core.units import Kind, to_mm

X: Final = NumberEntry("X", Kind.LENGTH)
Y: Final = NumberEntry("Y", Kind.LENGTH)
CENTER: Final = (NumberEntry("X CENTER", Kind.LENGTH), NumberEntry("Y CENTER", Kind.LENGTH))
ANGLE: Final = NumberEntry("ANGLE", Kind.ANGLE, "90")
COPIES: Final = NumberEntry("COPIES", Kind.COUNT, "1")


class TransformActions(App[int]):
    """The App's side of shapes."""

    session: Session

    @abstractmethod
    def apply(self, edited: Edited, label: str) -> bool:
        """Take an edit, or say why it is refused."""

    @abstractmethod
    def quiet(self) -> None:
        """The prompts again, on every screen."""

    async def _numbers(self, title: str, line: str, entries: Sequence[NumberEntry]) -> tuple[float, ...]:
        """The numbers that are typed, in program units and degrees; empty for none.  Only in a worker."""
        return await self.push_screen_wait(NumberForm(title, [line], entries, self.session.program.unit))

    def _length(self, value: float) -> float:
        return to_mm(value, self.session.program.unit)

    def _block(self, motion: transform.Motion, label: str) -> None:
        number = self.session.place.block
        edited = transform.transform_block(self.session.program, number, motion)
        if self.apply(edited, f"{label} {number}"):
            self.notify(f"{label} {number}. Ctrl+Z brings it back.", timeout=4)

    @work(exclusive=True, group="question")
    async def action_shift_block(self) -> None:
        """Move the block with the cursor."""
        numbers = await self._numbers("SHIFT BLOCK", "How far, in X and Y.", (X, Y))
        if numbers:
            self._block(transform.moved(*map(self._length, numbers)), "SHIFT BLOCK")

    @work(exclusive=True, group="question")
    async def action_rotate_block(self) -> None:
        """Turn the block with the cursor about a point."""
        line = "Counter-clockwise about a point, in degrees."
        numbers = await self._numbers("ROTATE BLOCK", line, (*CENTER, ANGLE))
        if numbers:
            x, y, angle = numbers
            self._block(transform.rotated((self._length(x), self._length(y)), angle), "ROTATE BLOCK")

    @work(exclusive=True, group="question")
    async def action_mirror_block(self) -> None:
        """Mirror the block with the cursor in a line."""
        line = "In the line through X, Y at ANGLE: 90 swaps left and right."
        numbers = await self._numbers("MIRROR BLOCK", line, (X, Y, ANGLE))
        if numbers:
            x, y, angle = numbers
            self._block(transform.mirrored((self._length(x), self._length(y)), angle), "MIRROR BLOCK")

    @work(exclusive=True, group="question")
    async def action_repeat_shifted(self) -> None:
        """Repeat segments, each copy moved on."""
        await self._repeat("REPEAT, SHIFTED", (X, Y), lambda x, y: transform.moved(self._length(x), self._length(y)))

    @work(exclusive=True, group="question")
    async def action_repeat_rotated(self) -> None:
        """Repeat segments, each copy turned on about a point."""
        await self._repeat(
            "REPEAT, ROTATED",
            (*CENTER, ANGLE),
            lambda x, y, angle: transform.rotated((self._length(x), self._length(y)), angle),
        )

    async def _repeat(
        self, title: str, entries: Sequence[NumberEntry], motion_of: Callable[..., transform.Motion]
    ) -> None:
        place = self.session.place
        here = str(max(place.segment, 1))
        which = (NumberEntry("FIRST SEGMENT", Kind.COUNT, here), NumberEntry("LAST SEGMENT", Kind.COUNT, here))
        line = "Copies stand after the last of these segments."
        numbers = await self._numbers(title, line, (*which, *entries, COPIES))
        if not numbers:
            return
        first, last, *values, copies = numbers
        edited = transform.repeat_segments(
            self.session.program, place.block, int(first), int(last), motion_of(*values), int(copies)
        )
        if self.apply(edited, f"{title}, block {place.block}"):
            # what was said of the edit before is over
            self.quiet()
