"""Unexpected ends, through a real pty: signals, dropped links, blocked terminals."""

from __future__ import annotations

import os
import signal
import sys
import termios
import time
from contextlib import suppress
from pathlib import Path

import pytest

from app.documents.files import load
from app.documents.time_limits import EXIT_SECONDS
from app.documents.unsaved_work import read
from app.terminal.signals import GRACE_SECONDS
from core.program.history import History
from core.program.model import Number
from tests.app.test_safety_terminal import PROGRAM
from tests.terminal import Terminal, running

PATIENCE = 3.0
"""Seconds within which a program must end."""


@pytest.fixture
def part(tmp_path: Path) -> Path:
    return tmp_path / "part.toml"


def typed(terminal: Terminal) -> None:
    """Type one field and accept it, and type half of another."""
    terminal.until("MILL CONTOUR")
    terminal.send(b"7\t")
    terminal.until("undo 1")
    terminal.send(b"\t3")


def journaled_work(part: Path) -> History:
    """The work in the journal beside the program; no lock and no other file is left."""
    assert [child.name for child in part.parent.iterdir()] == [".part.toml.cutcomp-journal"]
    journal = read(part.with_name(".part.toml.cutcomp-journal"))
    assert journal is not None
    assert isinstance(journal.work, History)
    return journal.work


def ended(pid: int, longest: float = PATIENCE) -> int:
    """The exit status of a program whose terminal is not read."""
    since = time.monotonic()
    while time.monotonic() - since < longest:
        finished, code = os.waitpid(pid, os.WNOHANG)
        if finished:
            return os.waitstatus_to_exitcode(code)
        time.sleep(0.01)
    raise AssertionError("still running")


@pytest.mark.parametrize("number", [signal.SIGHUP, signal.SIGTERM, signal.SIGINT, signal.SIGQUIT])
def test_a_signal_ends_the_program_cleanly(part: Path, number: signal.Signals) -> None:
    with running([*PROGRAM, str(part)]) as terminal:
        before = termios.tcgetattr(terminal.fd)
        typed(terminal)
        assert termios.tcgetattr(terminal.fd) != before
        os.kill(terminal.pid, number)
        assert terminal.status(PATIENCE) == 128 + number
        assert termios.tcgetattr(terminal.fd) == before
        end = bytes(terminal.seen[-400:])
        assert b"\x1b[?1049l" in end, "the screen from before"
        assert b"\x1b[?25h" in end, "the cursor"
    assert journaled_work(part).program.blocks[0].tool == Number(7.0)


def test_ctrl_z_during_the_end_does_not_stop_the_program(part: Path) -> None:
    """Once the terminal is given back, Ctrl+Z would stop the program before it has ended."""
    with running([*PROGRAM, str(part)]) as terminal:
        typed(terminal)
        os.kill(terminal.pid, signal.SIGTERM)
        since = time.monotonic()
        while (status := terminal.ended()) is None and time.monotonic() - since < PATIENCE:
            with suppress(OSError):
                terminal.send(b"\x1a")
            terminal.read(quiet=0.0005, longest=0.001)
        assert status == 128 + signal.SIGTERM
    assert journaled_work(part).program.blocks[0].tool == Number(7.0)


def test_a_signal_after_a_save_leaves_no_journal(part: Path) -> None:
    with running([*PROGRAM, str(part)]) as terminal:
        terminal.until("MILL CONTOUR")
        terminal.send(b"7\t\x13")
        terminal.until("Saved")
        os.kill(terminal.pid, signal.SIGTERM)
        assert terminal.status(PATIENCE) == 143
    assert [child.name for child in part.parent.iterdir()] == ["part.toml"]
    assert load(part).blocks[0].tool == Number(7.0)


def drop(terminal: Terminal) -> None:
    """Close our end of the terminal for good; the descriptor stays in use until `running` ends."""
    null = os.open(os.devnull, os.O_RDWR)
    os.dup2(null, terminal.fd)
    os.close(null)


def test_a_dropped_link_ends_the_program(part: Path) -> None:
    with running([*PROGRAM, str(part)]) as terminal:
        typed(terminal)
        drop(terminal)
        assert ended(terminal.pid) == 128 + signal.SIGHUP
    assert journaled_work(part).program.blocks[0].tool == Number(7.0)


def test_a_dropped_link_is_noticed_without_a_signal(part: Path) -> None:
    """In its own session, the program gets no SIGHUP: its input just ends."""
    with running(["setsid", "--wait", *PROGRAM, str(part)]) as terminal:
        typed(terminal)
        since = time.monotonic()
        drop(terminal)
        lock = part.with_name(".part.toml.cutcomp-lock")
        while lock.exists() and time.monotonic() - since < PATIENCE:
            time.sleep(0.01)
    assert journaled_work(part).program.blocks[0].tool == Number(7.0)


def stall(terminal: Terminal, journal: Path) -> int:
    """Stop the output, as a dead line does, and type until the program no longer reacts.

    Returns the number of edits seen on disk, which depends on how often the program paints.
    """
    line = os.open(Path(f"/proc/{terminal.pid}/fd/0").readlink(), os.O_RDWR | os.O_NOCTTY)
    termios.tcflow(line, termios.TCOOFF)
    os.close(line)
    for count in range(1500):
        size = journal.stat().st_size if journal.exists() else 0
        os.write(terminal.fd, b"\x1b[A%d\t" % (count % 90 + 2))
        since = time.monotonic()
        while not journal.exists() or journal.stat().st_size == size:
            if time.monotonic() - since > PATIENCE:
                return count
            time.sleep(0.01)
        # time to paint after this key
        time.sleep(0.03)
    raise AssertionError("the terminal took everything")


def test_a_blocked_terminal_cannot_keep_the_program_alive(part: Path) -> None:
    """The event loop waits for the terminal forever, so none of its timers and callbacks runs."""
    with running([*PROGRAM, str(part)]) as terminal:
        before = termios.tcgetattr(terminal.fd)
        terminal.until("MILL CONTOUR")
        terminal.send(b"\t")
        edits = stall(terminal, part.with_name(".part.toml.cutcomp-journal"))
        since = time.monotonic()
        os.kill(terminal.pid, signal.SIGTERM)
        assert ended(terminal.pid, GRACE_SECONDS + PATIENCE) == 143
        assert time.monotonic() - since > 1.0, "the loop was not blocked: nothing was tested"
        assert termios.tcgetattr(terminal.fd) == before
    history = journaled_work(part)
    assert edits > 1, "few edits fit before the terminal is full, fewer on a busy machine"
    assert history.undo_count == edits
    assert history.undo_label == "TOOL of START, block 1"


HANGING = """
import os, sys, time
from pathlib import Path
from app.cli.screens import run

real = os.fsync
def hanging(handle):
    real(handle)
    if Path(sys.argv[1]).with_name("hang").exists():
        time.sleep(1000)
os.fsync = hanging
sys.exit(run(Path(sys.argv[1])))
"""


def test_a_hanging_folder_cannot_keep_the_program_alive(part: Path) -> None:
    hang = part.with_name("hang")
    with running([sys.executable, "-c", HANGING, str(part)]) as terminal:
        terminal.until("MILL CONTOUR")
        terminal.send(b"7\t")
        terminal.until("undo 1")
        hang.touch()
        journal = part.with_name(".part.toml.cutcomp-journal")
        size = journal.stat().st_size
        terminal.send(b"\x1b[A8\t")
        while journal.stat().st_size == size:
            time.sleep(0.01)
        os.kill(terminal.pid, signal.SIGTERM)
        assert ended(terminal.pid, GRACE_SECONDS + EXIT_SECONDS + PATIENCE) == 143
    assert read(journal).work.program.blocks[0].tool == Number(8.0)


def test_a_full_disk_is_reported_and_work_continues(part: Path) -> None:
    """No file may exceed three kilobytes, so a write to the journal fails in the middle of a line."""
    limited = ["bash", "-c", 'ulimit -f 3; exec "$@"', "bash", *PROGRAM, str(part)]
    with running(limited, environment={"PYTHONDONTWRITEBYTECODE": "1"}) as terminal:
        terminal.until("MILL CONTOUR")
        terminal.send(b"\t")
        for number in range(20):
            terminal.send(b"\x1b[A%d\t" % (number + 2))
            terminal.read(quiet=0.1)
            if "Not on disk" in terminal.text:
                break
        terminal.until("Not on disk")
        assert terminal.ended() is None
        terminal.send(b"\x1b[A77\t")
        terminal.until("77")
    data = part.with_name(".part.toml.cutcomp-journal").read_bytes()
    assert data.endswith(b"\n")
    assert len(data) <= 3072
    assert data.count(b"\n") > 1, "the journal never held an edit: nothing was tested"


def test_two_operators_of_one_file_both_keep_their_work(part: Path) -> None:
    with running([*PROGRAM, str(part)]) as first:
        first.until("MILL CONTOUR")
        first.send(b"7\t\x13")
        first.until("Saved")
        first.send(b"\x1b[Z8\t")
        first.until("undo 2")
        with running([*PROGRAM, str(part)]) as second:
            second.until("TAKE OVER")
            assert "has had this program open since" in " ".join(second.text.split())
            second.send(b"t")
            second.until("2 edits.")
            second.send(b"d")
            second.until("Kept as")
            second.send(b"9\t\x13")
            second.until("Saved")
            first.send(b"\x13")
            first.until("TAKEN OVER")
            first.send(b"k")
            first.until("part.mine-")
            deadline = time.monotonic() + 10
            while not (mine := [*part.parent.glob("part.mine-*.toml")]) and time.monotonic() < deadline:
                first.read(quiet=0.05)
    assert load(part).blocks[0].tool == Number(9.0)
    assert load(mine[0]).blocks[0].tool == Number(8.0)
