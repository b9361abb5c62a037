"""The program in a real pseudo-terminal: keys as terminals send them, invalid bytes, and idleness."""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

import pytest

from app.documents.programs import example
from app.terminal.driver import VT100_PLUS
from tests.terminal import Terminal, cutcomp, running

ROOT = Path(__file__).parents[2]
ESC = b"\x1b"
CLOCK = 200
"""Bytes for a clock that may change its minute meanwhile."""
TITLES = {4: "PROGRAM PARAMETERS", 5: "PART SETUP", 6: "TOOL SETUP", 7: "zoom", 8: "1 block"}
"""The text on the screen after each softkey pressed on SEGMENT."""


@contextmanager
def on_example(folder: Path, name: str = "overrun-square", more: Mapping[str, str] | None = None) -> Iterator[Terminal]:
    """The program on a copy of an example, once its first verdict is shown."""
    file = folder / f"{name}.toml"
    shutil.copy(example(name), file)
    base = {"HOME": str(folder), "XDG_STATE_HOME": str(folder), "XDG_DATA_HOME": str(folder), "PYTHONPATH": str(ROOT)}
    with running(cutcomp(str(file)), environment={**base, **(more or {})}, cwd=str(folder)) as terminal:
        terminal.until("MILL CONTOUR", longest=30.0)
        terminal.until("best", longest=30.0)
        yield terminal


def test_a_folder_shows_its_files(tmp_path: Path) -> None:
    folder = tmp_path / "jobs"
    folder.mkdir()
    shutil.copy(example("notch"), folder / "bracket.toml")
    environment = {"XDG_STATE_HOME": str(tmp_path), "XDG_CONFIG_HOME": str(tmp_path), "PYTHONPATH": str(ROOT)}
    with running(cutcomp("jobs"), environment=environment, cwd=str(tmp_path)) as terminal:
        terminal.until("bracket", longest=30.0)
        assert f" {folder} " in terminal.text


def function_keys() -> dict[str, tuple[bytes, int]]:
    """Sequences of F4 to F8 in xterm, the Linux console, PuTTY's VT100+ mode, and as Esc with a digit."""
    xterm = {4: b"OS", 5: b"[15~", 6: b"[17~", 7: b"[18~", 8: b"[19~"}
    return {
        **{f"xterm F{number}": (ESC + code, number) for number, code in xterm.items()},
        **{f"console F{number}": (ESC + b"[[" + bytes([64 + number]), number) for number in (4, 5)},
        **{f"VT100+ F{number}": (ESC + b"O" + VT100_PLUS[number - 1].encode(), number) for number in xterm},
        **{f"Esc {number}": (ESC + str(number).encode(), number) for number in xterm},
    }


def test_every_sequence_of_a_function_key_presses_its_softkey(tmp_path: Path) -> None:
    with on_example(tmp_path) as terminal:
        for name, (sequence, number) in function_keys().items():
            terminal.send(sequence)
            try:
                terminal.until(TITLES[number])
            except AssertionError:
                pytest.fail(f"{name}:\n{terminal.text}")
            terminal.send(b"\r" if number == 8 else ESC + b"8")
            terminal.until("SEGMENT >")


def test_f3_of_xterm_restores_the_calculated_look_ahead(tmp_path: Path) -> None:
    with on_example(tmp_path) as terminal:
        terminal.until("CUTCOMP LOOKAHEAD CAL      2")
        terminal.send(b"\t" * 11 + b"4\r")
        terminal.until("CUTCOMP LOOKAHEAD USR      4")
        terminal.until("deletes segments 2-3")
        terminal.send(ESC + b"OR")
        terminal.until("CUTCOMP LOOKAHEAD CAL      2")
        terminal.send(ESC)
        terminal.until("1 to 8 press the softkey now")
        terminal.send(b"6")
        terminal.until("TOOL SETUP")
        terminal.until("DIAMETER")


def test_bytes_that_are_not_utf_8_do_not_end_the_program(tmp_path: Path) -> None:
    with on_example(tmp_path) as terminal:
        terminal.send(b"\t\t\t\t")
        for digit, data in enumerate((b"\xb0", b"\xff", b"\xc3(", b"\x80\x81\x82"), 1):
            terminal.send(b"7" + data)
            terminal.read(quiet=0.2)
            assert terminal.ended() is None, data
            terminal.send(b"\x7f\x7f\x7f\x7f\x7f8.%d\r" % digit)
            terminal.until(f"8.{digit}000")
            terminal.send(b"\x1b[A")


@pytest.mark.parametrize("more", [{"NO_COLOR": "1"}, {"TERM": "xterm"}], ids=str)
def test_letters_and_the_cursor_are_visible(tmp_path: Path, more: dict[str, str]) -> None:
    with on_example(tmp_path, more=more) as terminal:
        terminal.send(b"\t\t\t\t")
        terminal.read(quiet=0.5)
        line = terminal.screen.buffer[5]
        label, cursor = line[1], line[25]
        assert (label.data, cursor.data) == ("X", "0")
        assert all(cell.fg != cell.bg or cell.fg == "default" for cell in (label, cursor))
        assert (cursor.bg, cursor.reverse) != (label.bg, label.reverse)


def test_the_hidden_cursor_is_on_the_field_and_an_idle_terminal_gets_no_bytes(tmp_path: Path) -> None:
    """At the end Ctrl+Q asks, and discarding ends the program with status 0."""
    with on_example(tmp_path) as terminal:
        assert terminal.screen.cursor.y == 1
        terminal.send(ESC + b"[17~")
        terminal.until("TOOL SETUP")
        terminal.read(quiet=0.7)
        assert (terminal.screen.cursor.x, terminal.screen.cursor.y) == (3, 2)
        terminal.send(ESC + b"[19~")
        terminal.until("SEGMENT >")
        terminal.read(quiet=0.7)
        assert terminal.screen.cursor.y == 1
        assert sum(terminal.read(quiet=0.1, longest=0.1).count for _ in range(12)) <= CLOCK
        terminal.send(b"\t9\r\x11")
        terminal.until("QUIT?")
        terminal.send(b"d")
        assert terminal.status() == 0


def test_an_unusable_file_gives_one_sentence_and_status_2(tmp_path: Path) -> None:
    (tmp_path / "bad.toml").write_text("format = 1\nunits = 'IN'\nshape = 3\n")
    environment = {"PYTHONPATH": str(ROOT), "HOME": str(tmp_path)}
    with running(cutcomp(str(tmp_path / "bad.toml")), environment=environment) as terminal:
        assert terminal.status() == 2
        assert "line 3" in terminal.text
        assert "shape" in terminal.text
