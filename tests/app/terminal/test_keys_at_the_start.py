"""A hundred keys sent at once while the program is still starting all arrive in order and in their fields."""

import sys
from pathlib import Path

import pytest

from app.documents.files import load
from app.documents.programs import example
from core.program.model import LineSegment, Number
from tests.terminal import running

PAGE_DOWN, F4, F6, F7, F8 = "\x1b[6~", "\x1bOS", "\x1b[17~", "\x1b[18~", "\x1b[19~"
SAVE = "\x13"
LINES = (1, 3, 5, 6, 7, 9)
"""Segments of the pocket that are retyped."""


def keys() -> str:
    """Open the first program of HOME, retype six segments, and retype the last after visiting three screens."""
    typed, at = "\r", 0
    for number in LINES:
        typed += PAGE_DOWN * (number - at) + f"\t{number}.125\r{number}.5\r" + "\x1b[5~"
        at = number
    return f"{typed}{F6}{F8}{F4}{F8}{F7}{F8}\t{at}.125\r{at}.5\r{F7}{F8}"


@pytest.mark.timeout(130)
def test_a_hundred_keys_sent_before_the_first_paint_all_arrive(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    part = tmp_path / "part.toml"
    part.write_bytes(example("pocket").read_bytes())
    monkeypatch.setenv("PYTHONPATH", str(Path.cwd()))
    with running([sys.executable, "-m", "app"], cwd=str(tmp_path)) as terminal:
        terminal.send(keys().encode())
        terminal.until("MILL CONTOUR", longest=60)
        # not earlier: before the program takes over the terminal, Ctrl+S would stop its output
        terminal.send(SAVE.encode())
        terminal.until("Saved: part.toml", longest=100)
    segments = load(part).blocks[0].segments
    for number in LINES:
        segment = segments[number - 1]
        assert isinstance(segment, LineSegment)
        assert (segment.x_end, segment.y_end) == (Number(number + 0.125), Number(number + 0.5))
