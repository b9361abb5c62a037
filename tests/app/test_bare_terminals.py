"""Terminals without colors or UTF-8, through a real pseudo-terminal."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest
from textual.geometry import Region

from app.app import CutcompApp
from app.documents.lock import take
from app.documents.programs import example
from app.terminal.capabilities import ascii_only, characters, monochrome
from app.widgets.field import LineInput
from app.widgets.rows import OptionRows
from tests.app.documents.typist import ELSEWHERE
from tests.app.widget_pilot import SURROUNDINGS, Operator, operator, session_on
from tests.terminal import cutcomp, running

PROGRAM = cutcomp()
PENS = re.compile(rb"\x1b\[([0-9;]*)m")


def colored(data: bytes) -> set[bytes]:
    """Sequences that set a color, including the default foreground and background (39, 49)."""
    return {pen for pen in PENS.findall(data) if re.search(rb"(?:^|;)(?:[34][0-9]|9[0-7]|10[0-7])(?:;|$)", pen)}


@pytest.mark.parametrize(
    ("term", "locale"),
    [("vt100", "C.UTF-8"), ("xterm-mono", "C.UTF-8"), ("linux", "C")],
)
def test_a_terminal_without_colors_gets_none(tmp_path: Path, term: str, locale: str) -> None:
    """This covers a dialog with many tones and the form behind it."""
    part = Path(shutil.copy(example("pocket"), tmp_path / "part.toml"))
    take(part, ELSEWHERE)
    with running([*PROGRAM, str(part)], environment={"TERM": term, "LANG": locale}) as terminal:
        terminal.until("OPEN ALREADY", longest=30.0)
        terminal.read(quiet=0.3)
        terminal.send(b"l")
        terminal.until("GOUGE none", longest=30.0)
        terminal.send(b"\t\t\t\t")
        terminal.read(quiet=0.5)
        assert bool(colored(bytes(terminal.seen))) == (term == "linux")
        assert any(cell.reverse for row in terminal.screen.buffer.values() for cell in row.values())
        assert terminal.seen.isascii() == (term.startswith("vt") or locale == "C")


def test_requested_braille_is_drawn_even_on_a_vt100() -> None:
    arguments = [*PROGRAM, "--characters", "braille", "--example", "pocket"]
    with running(arguments, environment={"TERM": "vt100"}) as terminal:
        terminal.until("GOUGE none", longest=30.0)
        terminal.read(quiet=0.3)
        assert re.search("[\u2801-\u28ff]", terminal.text)


def marked_cells(field: LineInput) -> tuple[int, int]:
    """The numbers of reversed and of underlined cells of the field with the cursor, on a terminal without colors."""
    (strip,) = field.render_lines(Region(0, 0, field.size.width, 1))
    cells = [(len(text), style.reverse, style.underline) for text, style, _ in strip if style is not None]
    return sum(count for count, reverse, _ in cells if reverse), sum(count for count, _, line in cells if line)


async def test_without_colors_a_field_is_reversed_and_its_cursor_underlined() -> None:
    app = CutcompApp(session_on("pocket"), surroundings=SURROUNDINGS, few_colors=True)
    async with Operator.of(app) as user:
        seen = set()
        for _ in range(9):
            field = app.focused
            if isinstance(field, LineInput):
                seen.add(field.name)
                assert marked_cells(field) == (field.size.width - 1, 1)
            await user.press("tab")
        assert {"segment", "tool", "x_start"} <= seen
        await user.press("4", "2", "left")
        assert isinstance(app.focused, LineInput)
        assert marked_cells(app.focused) == (app.focused.size.width - 1, 1)


async def test_without_colors_the_screen_behind_a_dialog_stays_visible() -> None:
    app = CutcompApp(session_on("pocket"), surroundings=SURROUNDINGS, few_colors=True)
    async with Operator.of(app) as user:
        await user.press("tab", "7", "enter", "ctrl+q")
        assert app.screen.query("#question")
        assert "CONTOUR" in app.export_screenshot()
        answers = app.screen.query_one("#answers", OptionRows)
        rows = answers.render_lines(Region(0, 0, answers.size.width, answers.size.height))
        reversed_rows = [any(style is not None and style.reverse for _, style, _ in row) for row in rows]
        assert reversed_rows == [row == answers.highlighted for row in range(len(rows))], "only that with the cursor"


def test_a_too_small_terminal_is_reported_and_keys_still_work(tmp_path: Path) -> None:
    """On one cell, then on 20 by 5, keys still work; enlarged again, the terminal shows everything."""
    part = Path(shutil.copy(example("pocket"), tmp_path / "part.toml"))
    with running([*PROGRAM, str(part)], columns=1, rows=1) as terminal:
        while b"\x1b[?1049h" not in terminal.seen:
            terminal.read(quiet=0.2)
        terminal.read(quiet=0.5)
        for size in ((1, 1), (20, 5)):
            terminal.resize(*size)
            for key in (b"\t\t\t\t", b"\x1b[18~", b"+", b"\x1b[C", b"\x1b[18~", b"\x1b[19~", b"2.%d\r" % size[0]):
                terminal.send(key)
                terminal.read(quiet=0.1)
            assert terminal.ended() is None
            # back from Y START
            terminal.send(b"\x1b[Z" * 5)
        terminal.until("60x20", longest=30.0)
        terminal.resize(80, 24)
        terminal.until("GOUGE", longest=30.0)
        terminal.until("2.2000", longest=30.0)
        terminal.until("undo 2")


async def test_a_terminal_that_stays_too_small_shows_its_new_size() -> None:
    async with operator(size=(20, 5)) as user:
        assert user.prompt == "Window is 20x5; it needs 60x20."
        for width, height in ((59, 24), (80, 19)):
            await user.pilot.resize_terminal(width, height)
            await user.settle()
            assert user.prompt == f"Window is {width}x{height}; it needs 60x20."
        await user.pilot.resize_terminal(80, 24)
        await user.settle()
        assert "Window is" not in user.prompt


@pytest.mark.parametrize(
    ("environment", "known", "bare"),
    [
        ({"TERM": "vt100"}, 0, True),
        ({"TERM": "vt525"}, 8, False),
        ({"TERM": "xterm-mono"}, 0, True),
        ({"TERM": "something"}, 0, True),
        ({"TERM": "something"}, 8, False),
        ({"TERM": "vt100", "COLORTERM": "truecolor"}, 0, False),
        ({"TERM": "vt100", "TEXTUAL_COLOR_SYSTEM": "256"}, 0, False),
        # a system without a terminal table, or whose table lacks this terminal
        ({"TERM": "vt220-8"}, None, True),
        ({"TERM": "screen-m"}, None, True),
        ({"TERM": "something"}, None, False),
    ],
)
def test_which_terminals_have_no_colors(environment: dict[str, str], known: int | None, bare: bool) -> None:
    assert monochrome(environment, lambda _: known) is bare


@pytest.mark.parametrize(
    "name", ["xterm", "xterm-256color", "screen.xterm", "tmux", "linux", "putty", "vte", "ansi-color"]
)
def test_terminals_known_to_have_colors_need_no_table(name: str) -> None:
    def table(name: str) -> int | None:
        raise AssertionError(name)

    assert not monochrome({"TERM": name}, table)


def test_a_vt100_has_no_utf_8_but_a_monochrome_xterm_has() -> None:
    assert [ascii_only({"TERM": name}) for name in ("vt100", "vt220-8", "xterm-mono", "vte")] == [
        True,
        True,
        False,
        False,
    ]
    assert characters({"LANG": "C.UTF-8", "TERM": "vt100"}) == ("ascii", ("ascii",))
    assert characters({"LANG": "de_DE.ISO-8859-1", "TERM": "vt220"}) == ("iso8859-1", ("ascii",))
    assert characters({"LANG": "C.UTF-8", "TERM": "vt100"}, "ascii") == ("ascii", ("ascii",))
    assert characters({"LANG": "C.UTF-8", "TERM": "vt100"}, "block")[0] == "utf-8"
