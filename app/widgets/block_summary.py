"""BlockSummary says in a few lines what a block is: its contour, its tool, its limits and the verdict on it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from textual.content import Content

from app.session.formats import counted, length
from app.widgets.plain import PlainText
from app.widgets.verdict import MARKS_OF_CHARACTERS, Case, chips
from core.program.model import Number
from core.units import Unit

if TYPE_CHECKING:
    from core.pipeline.derived import DerivedBlock

NAME_WIDTH = 10
"""Cells of the column with the names of the lines."""
TEXT_WIDTH = 49
"""Cells for the text after it, beside a drawing."""


class BlockSummary(PlainText):
    """The lines on one block; empty without one."""

    def show(self, block: DerivedBlock | None, unit: Unit, characters: str, times: str = "") -> None:
        """Show a block, with its cut, rapid and total times if they are known."""
        lines = [] if block is None else about(block, unit, characters)
        lines += [("TIME", Content(times))] if times else []
        texts = [Content.assemble((f"{name:<{NAME_WIDTH}}", "$c-label"), text) for name, text in lines]
        self.update(Content("\n").join(texts), layout=False)


def about(block: DerivedBlock, unit: Unit, characters: str) -> list[tuple[str, Content]]:
    """Return the names and texts of the lines on a block, lengths in program units."""
    path = "" if block.side is None else f"  {block.lookahead.tag} {block.lookahead.value}"
    lines = [
        (f"BLOCK {block.number}", f"MILL CONTOUR  {block.block.cutter_comp}{path}"),
        ("CONTOUR", _contour(block, unit)),
    ]
    diameter = block.solved.tool_diameter
    tool = "no diameter" if diameter is None else f"{block.solved.tool_type}  {length(diameter, unit)}"
    number = block.block.tool.value if isinstance(block.block.tool, Number) else None
    lines += [("TOOL" if number is None else f"TOOL {number:g}", tool), ("LIMITS", _limits(block, unit))]
    contents = [(name, Content(text)) for name, text in lines if text]
    return [*contents, ("VERDICT", chips(Case(block, None, unit), MARKS_OF_CHARACTERS[characters], width=TEXT_WIDTH))]


def _contour(block: DerivedBlock, unit: Unit) -> str:
    text = counted(len(block.block.segments), "segment")
    pieces = [piece for _, piece in block.solved.pieces]
    if not pieces:
        return text
    closed = "closed" if block.solved.closed else "open"
    return f"{text}, {closed}, {length(sum(piece.length for piece in pieces), unit)} long"


def _limits(block: DerivedBlock, unit: Unit) -> str:
    """Return the smallest and largest X and Y of the contour; empty if its path is not known."""
    if block.paths is None:
        return ""
    left, bottom, right, top = block.paths.surface.boxes
    ranges = (("X", float(left.min()), float(right.max())), ("Y", float(bottom.min()), float(top.max())))
    return "   ".join(f"{axis} {length(low, unit)} to {length(high, unit)}" for axis, low, high in ranges)
