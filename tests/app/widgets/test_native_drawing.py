from __future__ import annotations

from dataclasses import dataclass, field, replace
from threading import Event

import pytest
from textual.app import App, ComposeResult

from app.documents.files import load
from app.documents.programs import example
from app.theme import DARK_THEME, themes
from app.widgets.drawing import LOOK_OF_STYLE, Drawing
from core.draw.characters import Mode
from core.draw.scene import Style
from core.draw.view import View
from core.pipeline.derive import derive
from core.pipeline.plot import Drawn, Subject


@pytest.fixture(scope="module")
def pocket() -> Subject:
    derived = derive(load(example("pocket")))
    return Subject(derived.block(1), derived.program.unit, 0)


class Shown(App[None]):
    CSS = """
    Drawing { width: 60; height: 18; border: round white; }
    .hidden { display: none; }
    """

    def __init__(self) -> None:
        super().__init__()
        for theme in themes():
            self.register_theme(theme)
        self.theme = DARK_THEME

    def compose(self) -> ComposeResult:
        yield Drawing(id="part")


async def settled(app: Shown) -> list[str]:
    await app.workers.wait_for_complete()
    drawing = app.query_one(Drawing)
    return ["".join(part.text for part in drawing.render_line(y)) for y in range(drawing.size.height)]


def test_every_style_has_a_look():
    names = {"SURFACE": "part", "RAPID": "rough"}
    assert list(LOOK_OF_STYLE) == [names.get(style.name, style.name.lower().replace("_", "-")) for style in Style]


async def test_a_subject_is_drawn_with_a_scale_bar_in_the_frame(pocket):
    app = Shown()
    async with app.run_test() as pilot:
        drawing = app.query_one(Drawing)
        drawing.heading, drawing.subject = "DRAWING  whole part", pocket
        rows = await settled(app)
        await pilot.pause()
        assert any("x" in row for row in rows)
        assert "S" in "".join(rows)
        assert (drawing.border_title, str(drawing.border_subtitle)) == ("DRAWING  whole part", "├────────┤ 1 IN")
        assert all(len(row) == 58 for row in rows)


async def test_nothing_is_drawn_without_a_subject(pocket):
    app = Shown()
    async with app.run_test():
        assert not "".join(await settled(app)).strip()
        app.query_one(Drawing).subject = pocket
        assert "".join(await settled(app)).strip()
        app.query_one(Drawing).subject = None
        assert not "".join(await settled(app)).strip()


async def test_a_hidden_drawing_is_drawn_only_once_shown(pocket):
    app = Shown()
    async with app.run_test() as pilot:
        drawing = app.query_one(Drawing)
        drawing.add_class("hidden")
        await pilot.pause()
        drawing.subject = pocket
        await settled(app)
        assert drawing.drawn is None
        drawing.remove_class("hidden")
        while drawing.drawn is None:
            await pilot.pause()
        assert "".join(await settled(app)).strip()


@dataclass
class SlowWhenNarrow:
    """A subject whose picture in few columns waits for `go`."""

    subject: Subject
    columns: int
    view: View | None = None
    go: Event = field(default_factory=Event)
    over: Event = field(default_factory=Event)

    def drawn(self, columns: int, rows: int, mode: Mode) -> Drawn | None:
        if columns < self.columns:
            self.go.wait(20.0)
            self.over.set()
        return self.subject.drawn(columns, rows, mode)


async def test_a_late_picture_of_another_size_is_dropped(pocket):
    app = Shown()
    async with app.run_test() as pilot:
        drawing = app.query_one(Drawing)
        slow = SlowWhenNarrow(pocket, 58)
        drawing.styles.width = 40
        await pilot.pause()
        drawing.subject = slow
        await pilot.pause()
        drawing.styles.width = 60
        while drawing.drawn is None:
            await pilot.pause()
        current = drawing.drawn
        slow.go.set()
        while not slow.over.is_set():
            await pilot.pause()
        for _ in range(20):
            await pilot.pause(0.01)
        assert drawing.drawn is current


async def test_changing_the_characters_redraws_the_subject(pocket):
    app = Shown()
    async with app.run_test():
        drawing = app.query_one(Drawing)
        drawing.subject = pocket
        await settled(app)
        drawing.characters = "ascii"
        assert "".join(await settled(app)).isascii()


async def test_a_click_reports_the_point_in_millimeters(pocket):
    picked = []

    class Clicked(Shown):
        def on_drawing_picked(self, message: Drawing.Picked) -> None:
            picked.append(message.at)

    app = Clicked()
    async with app.run_test() as pilot:
        drawing = app.query_one(Drawing)
        drawing.subject = pocket
        rows = await settled(app)
        row = next(y for y, text in enumerate(rows) if "S" in text)
        await pilot.click(Drawing, offset=(rows[row].index("S") + 1, row + 1))
        x, y = picked[0]
        assert (x, y) == pytest.approx((2.0 * 25.4, 0.25 * 25.4), abs=2.0 * drawing.drawn.view.scale)


async def test_a_loupe_shows_4_6_radii_around_a_place_shifted_toward_the_part(pocket):
    app = Shown()
    async with app.run_test():
        drawing = app.query_one(Drawing)
        drawing.subject = replace(pocket, near=(0.25 * 25.4, 3.5 * 25.4))
        await settled(app)
        view, rows = drawing.drawn.view, drawing.size.height
        assert view.scale * rows * 2.0 == pytest.approx(4.6 * pocket.block.radius)
        assert view.center[0] > 0.25 * 25.4
