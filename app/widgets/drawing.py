"""Drawing is a widget that shows a block's contour, paths and faults, or an NC program's, in character cells.

The scale bar is in the frame, where it covers nothing of the part.  A worker makes the picture, so that no key
waits for it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import groupby
from typing import TYPE_CHECKING, Any, ClassVar, Final, Protocol

from rich.segment import Segment
from textual import events, work
from textual.binding import Binding, BindingType
from textual.content import Content
from textual.geometry import Region, Size
from textual.message import Message
from textual.reactive import reactive
from textual.strip import Strip
from textual.widget import Widget

if TYPE_CHECKING:
    from core.draw.characters import Mode
    from core.draw.view import View
    from core.geometry.piece import Point
    from core.pipeline.plot import Drawn


ZOOM_FACTOR: Final = 1.25
PAN_SHARE: Final = 0.125
"""The fraction of the window by which one arrow key moves it."""
MAX_PAN_FACTOR: Final = 2.0
"""How far the window may move from the drawing, as a multiple of the drawing's larger side."""
LOOK_KEYS: Final[tuple[BindingType, ...]] = (
    Binding("plus,equals_sign", "zoom(1)", "Zoom in", show=False),
    Binding("minus", "zoom(-1)", "Zoom out", show=False),
    Binding("left", "pan(-1, 0)", "Move left", show=False),
    Binding("right", "pan(1, 0)", "Move right", show=False),
    Binding("up", "pan(0, 1)", "Move up", show=False),
    Binding("down", "pan(0, -1)", "Move down", show=False),
    Binding("m,M", "app.next_characters", "Characters", show=False),
)
"""The keys of a drawing that takes the cursor."""


class Drawable(Protocol):
    """Anything that can be drawn, a dataclass: a block of a program, or the scene of an NC program."""

    __dataclass_fields__: ClassVar[dict[str, Any]]

    @property
    def view(self) -> View | None:
        """The window that the operator zoomed to; None shows all."""

    def drawn(self, columns: int, rows: int, mode: Mode) -> Drawn | None:
        """Return the picture in columns x rows cells; None if there is nothing to see."""


LOOK_OF_STYLE: Final = {
    "background": "$c-label",
    "axis": "$c-frame",
    "part": "$c-part",
    "path": "$c-path",
    "lead": "$c-path",
    "rough": "$c-cutter",
    "deleted": "bold $c-deleted",
    "gouge": "bold $c-gouge",
    "uncut": "bold $c-uncut",
    "cutter": "$c-cutter",
    "start": "bold $c-begin",
    "current": "bold $c-focus",
    "scale": "$c-frame",
    "message": "$c-label",
    "number": "$c-label",
    "gouge-area": "$c-gouge",
    "uncut-area": "$c-uncut",
    "untaken": "$c-label",
}
"""The looks of core's drawing styles, in their order, as color roles of the theme.

They are not component classes: Textual would recompute eighteen styles at each change of a drawing's own style.
"""


class Drawing(Widget):
    """A picture of `subject` in `characters` (braille, block or ascii), with `heading` in the upper frame."""

    subject: reactive[Drawable | None] = reactive(None, repaint=False)
    characters: reactive[str] = reactive("braille", repaint=False)
    heading: reactive[str] = reactive("", repaint=False)

    @dataclass
    class Viewed(Message):
        """The window was zoomed or moved; None shows all."""

        view: View | None

    @dataclass
    class Picked(Message):
        """The drawing was clicked at a point, given in millimeters."""

        drawing: Drawing
        at: Point

    def __init__(self, *, id: str | None = None, classes: str | None = None) -> None:
        super().__init__(id=id, classes=classes)
        self.drawn: Drawn | None = None
        self.zoomed_about: Point | None = None
        """The point (mm) that stays in its place when zooming; None for the center of the window."""
        self._strips: list[Strip] = []
        self._made: tuple[object, ...] = ()

    def action_zoom(self, steps: int) -> None:
        """Zoom in by steps, or out if they are negative."""
        if self.drawn is not None and self.subject is not None:
            view = self.subject.view or self.drawn.view
            self.show_view(view.zoom(ZOOM_FACTOR**steps, self.zoomed_about))

    def action_pan(self, right: int, up: int) -> None:
        """Move the window by steps, but never far away from the drawing."""
        if self.drawn is not None and self.subject is not None:
            view = (self.subject.view or self.drawn.view).pan(PAN_SHARE * right, PAN_SHARE * up, *self.size)
            if view.is_near(self.drawn.bounds, MAX_PAN_FACTOR):
                self.show_view(view)

    def action_fit(self) -> None:
        """Show all of the subject."""
        self.show_view(None)

    def show_view(self, view: View | None) -> None:
        """Show another window of the subject; None shows all."""
        if self.subject is not None and view != self.subject.view:
            self.subject = replace(self.subject, view=view)
            self.post_message(self.Viewed(view))

    def on_mouse_scroll_up(self, event: events.MouseScrollUp) -> None:
        """Zoom in."""
        event.stop()
        self.action_zoom(1)

    def on_mouse_scroll_down(self, event: events.MouseScrollDown) -> None:
        """Zoom out."""
        event.stop()
        self.action_zoom(-1)

    def redraw(self) -> None:
        """Make the picture in a worker, unless it is already made or the drawing is hidden."""
        key = (self.subject, self.characters, self.size)
        if key == self._made or not self._seen:
            return
        self._made = key
        if self.subject is None:
            self._show(None)
        else:
            self._make(self.subject, self.size, self.characters)

    watch_subject = watch_characters = on_resize = on_show = redraw

    @property
    def _seen(self) -> bool:
        displayed = all(node.display for node in self.ancestors_with_self if isinstance(node, Widget))
        return self.is_attached and displayed and bool(self.size)

    # a worker with a program needs a description: else Textual formats the whole program before the next key
    @work(thread=True, exclusive=True, group="drawing", description="picture")
    def _make(self, subject: Drawable, size: Size, characters: str) -> None:
        # imported here: the first paint must not load numpy and shapely
        from core.draw.characters import Mode

        picture = subject.drawn(size.width, size.height, Mode(characters))
        self.app.call_from_thread(self._finished, (subject, characters, size), picture)

    def _finished(self, key: tuple[object, ...], picture: Drawn | None) -> None:
        """Show a picture from the worker, unless another one is wanted by now."""
        if key == self._made and self.is_attached:
            self._show(picture)

    def _show(self, picture: Drawn | None) -> None:
        self.drawn = picture
        self._frame()
        before, self._strips = self._strips, self._styled()
        if len(before) != len(self._strips):
            self.refresh()
            return
        for y, (old, new) in enumerate(zip(before, self._strips, strict=True)):
            if old != new:
                self.refresh(Region(0, y, self.size.width, 1))

    def _styled(self) -> list[Strip]:
        """Return the picture's rows as styled strips."""
        if self.drawn is None:
            return []
        base, parse = self.visual_style, self.app.stylesheet.parse_style
        looks = [(base + parse(look)).rich_style for look in LOOK_OF_STYLE.values()]
        rows = zip(self.drawn.picture.rows, self.drawn.picture.styles.tolist(), strict=True)
        strips = []
        for text, styles in rows:
            runs = ((style, list(cells)) for style, cells in groupby(range(len(text)), styles.__getitem__))
            strips.append(Strip([Segment(text[cells[0] : cells[-1] + 1], looks[style]) for style, cells in runs]))
        return strips

    def _frame(self) -> None:
        """Update the title and the scale bar; without a lower frame the bar is next to the title, if it fits."""
        bar = "" if self.drawn is None or self.has_class("-outline") else self.drawn.scale_bar
        framed = self.styles.border_bottom[0] not in ("", "none")
        together = f"{self.heading}   {bar}".strip()
        fits = len(together) + 4 <= self.size.width
        self.border_title = Content(together if not framed and fits else self.heading)
        self.border_subtitle = Content(bar if framed else "")

    watch_heading = _frame

    def notify_style_update(self) -> None:
        """Recolor the picture after a style change."""
        super().notify_style_update()
        if self.drawn is not None and self.is_attached:
            self._strips = self._styled()

    def render_line(self, y: int) -> Strip:
        """Return one row of the picture."""
        width, style = self.size.width, self.rich_style
        if y >= len(self._strips):
            return Strip.blank(width, style)
        return self._strips[y].adjust_cell_length(width, style)

    def on_click(self, event: events.Click) -> None:
        """Post the point that was clicked."""
        if self.drawn is not None and (at := event.get_content_offset(self)) is not None:
            point = self.drawn.view.at(at.x + 0.5, at.y + 0.5, *self.size)
            self.post_message(self.Picked(self, point))
