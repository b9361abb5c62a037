"""The listing of NC PROOF marks the lines that have findings."""

from __future__ import annotations

from textual.app import App, ComposeResult

from app.nc_proof.listing import Listing
from core.finding import Severity


class Shown(App[None]):
    def compose(self) -> ComposeResult:
        yield Listing()


async def test_a_line_painted_before_its_finding_arrives_is_marked():
    async with Shown().run_test() as pilot:
        listing = pilot.app.query_one(Listing)
        listing.load_text("G1\nX1\nX2")
        await pilot.pause()

        def bold(row: int) -> bool:
            return any("X" in text and style is not None and style.bold for text, style, _ in listing.render_line(row))

        assert (bold(1), bold(2)) == (False, False)
        listing.marks = {3: Severity.INFO}
        await pilot.pause()
        assert (bold(1), bold(2)) == (False, True)
