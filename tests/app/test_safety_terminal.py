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


def test_a_byte_that_is_no_utf_8_ends_nothing(tmp_path: Path) -> None:
    """A degree sign from a Latin-1 terminal, and half a letter of UTF-8 before a key."""
    part = tmp_path / "part.toml"
    with running([*PROGRAM, str(part)]) as terminal:
        terminal.until("MILL CONTOUR")
        terminal.send(b"\xb0")
        terminal.send(b"\xff\xfe\xc3")
        terminal.send(b"\x1b")
        terminal.read(quiet=0.4)
        terminal.send(b"7\t\x13")
        terminal.until("Saved")
        terminal.send(b"\x11")
        assert terminal.status() == 0
    assert load(part).blocks[0].tool == Number(7.0)


@pytest.mark.parametrize("term", ["dumb", ""])
def test_a_terminal_without_a_cursor_is_refused_with_a_sentence(term: str) -> None:
    with running(PROGRAM, environment={"TERM": term}) as terminal:
        assert terminal.status() == 2
        assert terminal.text.startswith(f"cutcomp: the terminal says TERM={term}, which cannot place a cursor.")


def test_without_a_terminal_there_is_a_sentence() -> None:
    done = subprocess.run(PROGRAM, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.startswith("cutcomp: the screens need a terminal")
    assert "\x1b" not in done.stderr


def test_errors_into_a_file_are_no_terminal(tmp_path: Path) -> None:
    """The screens are painted on standard error."""
    with running(["sh", "-c", f"exec {' '.join(PROGRAM)} 2> {tmp_path / 'errors'}"]) as terminal:
        assert terminal.status() == 2
    assert (tmp_path / "errors").read_text().startswith("cutcomp: the screens need a terminal")


def test_no_color() -> None:
    """Cells without a style of their own end the program where colors are filtered out."""
    with running([*PROGRAM, "--example"], environment={"NO_COLOR": "1"}) as terminal:
        terminal.until("GOUGE none")
        terminal.send(b"\x1bOS\x1b[18~\t\t9\r\x1b7")
        terminal.read(quiet=0.5)
        assert terminal.ended() is None


LATIN = {"PYTHONIOENCODING": "latin-1", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0", "LC_ALL": "C"}


def test_a_locale_of_eight_bits_gets_a_drawing_in_ascii() -> None:
    """Braille would become the text of its escapes, six cells for one."""
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


def test_a_fault_of_our_own_ends_with_a_status_and_keeps_the_work(tmp_path: Path) -> None:
    part = tmp_path / "part.toml"
    with running([sys.executable, "-c", FAULTY, str(part)]) as terminal:
        terminal.until("MILL CONTOUR")
        terminal.send(b"7\t")
        terminal.until("undo 1")
        terminal.send(b"\x19")
        assert terminal.status() not in (0, None)
    assert [one.name for one in tmp_path.iterdir()] == [".part.toml.cutcomp-journal"]
    with running([*PROGRAM, str(part)]) as terminal:
        terminal.until("Block 1: TOOL 7, was 1.")


def test_text_of_a_file_never_moves_the_cursor_of_the_terminal(tmp_path: Path) -> None:
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
    done = subprocess.run([*PROGRAM, "path", str(part)], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "\x1b" not in done.stderr
    assert os.linesep in done.stderr


def spoilt(terminal: Terminal, text: str) -> None:
    """Somebody else writes on the screen."""
    terminal.stream.feed(b"\x1b[0m\x1b[2J\x1b[H$ ls\r\npart.nc\r\n$ fg\r\n")
    assert text not in terminal.text


def painted_whole(terminal: Terminal) -> None:
    """Wait until nothing of the first paint is still to come: it would write over what `spoilt` wrote."""
    terminal.until("GOUGE none")
    terminal.until("best 2")
    terminal.read(quiet=1.0)


def stopped(terminal: Terminal, number: signal.Signals) -> None:
    os.kill(terminal.pid, number)
    os.waitpid(terminal.pid, os.WUNTRACED)
    terminal.read(quiet=0.1)


@pytest.mark.parametrize("number", [signal.SIGTSTP, signal.SIGSTOP])
def test_behind_a_stop_the_whole_screen_comes_back_and_keys_arrive_once(number: signal.Signals) -> None:
    with running([*PROGRAM, "--example", "pocket"]) as terminal:
        painted_whole(terminal)
        before = terminal.text.splitlines()[:23]
        stopped(terminal, number)
        spoilt(terminal, "GOUGE none")
        os.kill(terminal.pid, signal.SIGCONT)
        terminal.until("GOUGE none")
        terminal.read(quiet=0.3)
        assert terminal.text.splitlines()[:23] == before
        terminal.send(b"\t\t\t\t12345")
        terminal.until("12345")


def test_a_screen_that_was_written_on_is_painted_again_by_a_key_or_a_size_that_is_the_same() -> None:
    with running([*PROGRAM, "--example", "pocket"]) as terminal:
        painted_whole(terminal)
        for ask in (lambda: terminal.send(b"\x0c"), lambda: os.kill(terminal.pid, signal.SIGWINCH)):
            spoilt(terminal, "GOUGE none")
            ask()
            terminal.until("GOUGE none")
            terminal.read(quiet=0.3)
            assert "$ ls" not in terminal.text
