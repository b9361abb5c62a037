"""Terminals through a real pty: any byte, any locale, no color, no cursor, none at all."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from app.documents.files import load
from core.program.model import Number
from tests.terminal import Terminal, cutcomp, running

PROGRAM = cutcomp()


def test_bytes_that_are_not_utf_8_do_not_end_the_program(tmp_path: Path) -> None:
    """The bytes are a degree sign from a Latin-1 terminal and half a UTF-8 letter before a key."""
    part = tmp_path / "part.toml"
    with running([*PROGRAM, str(part)]) as terminal:
        terminal.until("MILL CONTOUR")
        terminal.send(b"\xb0")
        terminal.send(b"\xff\xfe\xc3")
        terminal.send(b"\x1b")
        terminal.until("The old number is back")
        terminal.send(b"7\t\x13")
        terminal.until("Saved")
        terminal.send(b"\x11")
        assert terminal.status() == 0
    assert load(part).blocks[0].tool == Number(7.0)


@pytest.mark.parametrize("term", ["dumb", ""])
def test_a_terminal_without_cursor_addressing_is_refused(term: str) -> None:
    with running(PROGRAM, environment={"TERM": term}) as terminal:
        assert terminal.status() == 2
        assert terminal.text.startswith(f"cutcomp: the terminal says TERM={term}, which cannot place a cursor.")


def test_a_start_without_a_terminal_is_refused() -> None:
    result = subprocess.run(PROGRAM, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    assert result.returncode == 2
    assert result.stdout == ""
    assert result.stderr.startswith("cutcomp: the screens need a terminal")
    assert "\x1b" not in result.stderr


def test_a_start_with_standard_error_in_a_file_is_refused(tmp_path: Path) -> None:
    """The screens are painted on standard error."""
    with running(["sh", "-c", f"exec {' '.join(PROGRAM)} 2> {tmp_path / 'errors'}"]) as terminal:
        assert terminal.status() == 2
    assert (tmp_path / "errors").read_text().startswith("cutcomp: the screens need a terminal")


def test_no_color_does_not_end_the_program() -> None:
    """Cells without their own style would end the program when colors are filtered out."""
    with running([*PROGRAM, "--example"], environment={"NO_COLOR": "1"}) as terminal:
        terminal.until("GOUGE none")
        terminal.send(b"\x1bOS\x1b[18~\t\t9\r\x1b7")
        terminal.read(quiet=0.5)
        assert terminal.ended() is None


LATIN = {"PYTHONIOENCODING": "latin-1", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0", "LC_ALL": "C"}


def test_an_eight_bit_locale_gets_an_ascii_drawing() -> None:
    """Braille would be written as escapes, six cells for one."""
    with running([*PROGRAM, "--example"], environment=LATIN) as terminal:
        terminal.until("GOUGE none")
        terminal.read(quiet=0.5)
        assert terminal.text.isascii()
        assert "\\u" not in terminal.text
        edge = {line[59] for line in terminal.text.splitlines()[:21]}
        assert len(edge) == 1, terminal.text


FAULTY = """
import sys
from pathlib import Path
from app.app import CutcompApp

def faulty(self):
    raise RuntimeError("a fault of our own")
CutcompApp.action_redo = faulty

from app.cli.screens import run
sys.exit(run(Path(sys.argv[1])))
"""


def test_an_internal_fault_ends_with_an_error_status_and_keeps_the_work(tmp_path: Path) -> None:
    part = tmp_path / "part.toml"
    with running([sys.executable, "-c", FAULTY, str(part)]) as terminal:
        terminal.until("MILL CONTOUR")
        terminal.send(b"7\t")
        terminal.until("undo 1")
        terminal.send(b"\x19")
        assert terminal.status() not in (0, None)
    assert [child.name for child in tmp_path.iterdir()] == [".part.toml.cutcomp-journal"]
    with running([*PROGRAM, str(part)]) as terminal:
        terminal.until("1 edit.")
        terminal.send(b"r")
        terminal.until("Your work is back")
        terminal.send(b"\x13")
        terminal.until("Saved")
    assert load(part).blocks[0].tool == Number(7.0)


def test_control_characters_of_a_file_are_left_out(tmp_path: Path) -> None:
    """Control characters in unread text and in the name of the file are left out."""
    part = tmp_path / "pa\x1b[2Jrt.toml"
    part.write_text(
        'format = 1\nunits = "IN"\n[[block]]\nkind = "MILL CONTOUR"\ncutter_comp = "ON"\n'
        '[block.unread]\nx_start = "2\\u001b[2J\\u009b5\\u0007"\n'
    )
    with running([*PROGRAM, str(part)]) as terminal:
        terminal.until("pa[2Jrt")
        terminal.until("2[2J5")
    with running([*PROGRAM, "path", str(part)]) as terminal:
        assert terminal.status() in (0, 1)
        assert "\x1b" not in terminal.text
    part.write_text("format = 2\n")
    result = subprocess.run([*PROGRAM, "path", str(part)], capture_output=True, text=True, check=False)
    assert result.returncode == 2
    assert "\x1b" not in result.stderr
    assert os.linesep in result.stderr


def spoilt(terminal: Terminal, text: str) -> None:
    """Another program writes on the screen."""
    terminal.stream.feed(b"\x1b[0m\x1b[2J\x1b[H$ ls\r\npart.nc\r\n$ fg\r\n")
    assert text not in terminal.text


def painted_whole(terminal: Terminal) -> None:
    """Wait for the end of the first paint, which would overwrite the text of `spoilt`."""
    terminal.until("GOUGE none")
    terminal.until("best 2")
    terminal.read(quiet=1.0)


def stopped(terminal: Terminal, number: signal.Signals) -> None:
    os.kill(terminal.pid, number)
    os.waitpid(terminal.pid, os.WUNTRACED)
    terminal.read(quiet=0.1)


def test_a_spoilt_screen_is_repainted_after_a_stop_and_on_request_and_keys_arrive_once() -> None:
    with running([*PROGRAM, "--example", "pocket"]) as terminal:
        painted_whole(terminal)
        before = terminal.text.splitlines()[:23]
        for number in (signal.SIGTSTP, signal.SIGSTOP):
            stopped(terminal, number)
            spoilt(terminal, "GOUGE none")
            os.kill(terminal.pid, signal.SIGCONT)
            terminal.until("GOUGE none")
            terminal.read(quiet=0.3)
            assert terminal.text.splitlines()[:23] == before, number
        for repaint in (lambda: terminal.send(b"\x0c"), lambda: os.kill(terminal.pid, signal.SIGWINCH)):
            spoilt(terminal, "GOUGE none")
            repaint()
            terminal.until("GOUGE none")
            terminal.read(quiet=0.3)
            assert "$ ls" not in terminal.text
        terminal.send(b"\t\t\t\t12345")
        terminal.until("12345")
