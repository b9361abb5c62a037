"""A terminal's screen as a PNG: letters from a packaged font, braille and half blocks drawn as what they mean."""

from __future__ import annotations

from importlib.resources import files
from io import BytesIO
from pathlib import Path
from typing import Any

import pyte
from PIL import Image, ImageDraw, ImageFont

CELL = (10, 20)
PAPER, INK = "#101418", "#d8dee4"
NAMED = {
    "black": "#000000",
    "red": "#cd3131",
    "green": "#0dbc79",
    "brown": "#e5e510",
    "blue": "#2472c8",
    "magenta": "#bc3fbc",
    "cyan": "#11a8cd",
    "white": "#e5e5e5",
    "brightblack": "#666666",
    "brightred": "#f14c4c",
    "brightgreen": "#23d18b",
    "brightbrown": "#f5f543",
    "brightyellow": "#f5f543",
    "brightblue": "#3b8eea",
    "brightmagenta": "#d670d6",
    "brightcyan": "#29b8db",
    "brightwhite": "#ffffff",
}
STROKES = {"✓": ((1, 11, 4, 15), (4, 15, 9, 5)), "✖": ((1, 5, 8, 15), (1, 15, 8, 5))}
"""Signs that the font has not, as strokes in a cell."""
BRAILLE_DOTS = ((0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (0, 3), (1, 3))


def save_picture(screen: pyte.Screen, path: Path) -> None:
    """Write the screen as a PNG."""
    width, height = CELL
    image = Image.new("RGB", (screen.columns * width, screen.lines * height), PAPER)
    draw = ImageDraw.Draw(image)
    font = _font()
    for row in range(screen.lines):
        for column in range(screen.columns):
            _cell(draw, font, screen.buffer[row][column], column * width, row * height)
    image.save(path, optimize=True)


def _font() -> ImageFont.FreeTypeFont:
    data = files("fontpkg_jetbrains_mono").joinpath("files", "JetBrainsMono[wght].ttf")
    return ImageFont.truetype(BytesIO(data.read_bytes()), 16)


def _color(name: str, default: str) -> str:
    if name == "default":
        return default
    return NAMED.get(name, f"#{name}")


def _cell(draw: ImageDraw.ImageDraw, font: ImageFont.FreeTypeFont, cell: Any, x: int, y: int) -> None:
    width, height = CELL
    ink, paper = _color(cell.fg, INK), _color(cell.bg, PAPER)
    if cell.reverse:
        ink, paper = paper, ink
    draw.rectangle((x, y, x + width - 1, y + height - 1), fill=paper)
    if "\u2800" <= cell.data <= "\u28ff":
        _braille(draw, ord(cell.data) - 0x2800, x, y, ink)
    elif cell.data in "▀▄█":
        top, bottom = (0 if cell.data != "▄" else height // 2), (height if cell.data != "▀" else height // 2)
        draw.rectangle((x, y + top, x + width - 1, y + bottom - 1), fill=ink)
    elif cell.data in STROKES:
        for left, top, right, bottom in STROKES[cell.data]:
            draw.line((x + left, y + top, x + right, y + bottom), fill=ink, width=2)
    elif cell.data.strip():
        draw.text((x, y - 1), cell.data, fill=ink, font=font, stroke_width=0.3 if cell.bold else 0)
    if cell.strikethrough:
        draw.line((x, y + height // 2, x + width - 1, y + height // 2), fill=ink)
    if cell.underscore:
        draw.line((x, y + height - 2, x + width - 1, y + height - 2), fill=ink)


def _braille(draw: ImageDraw.ImageDraw, bits: int, x: int, y: int, ink: str) -> None:
    for bit, (column, row) in enumerate(BRAILLE_DOTS):
        if bits >> bit & 1:
            left, top = x + 1 + 5 * column, y + 1 + 5 * row
            draw.rectangle((left, top, left + 2, top + 2), fill=ink)
