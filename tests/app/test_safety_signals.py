"""Ends that nobody asked for, through a real pty: signals, dropped links, terminals that take nothing."""

from __future__ import annotations

import os
import signal
import termios
import time
from contextlib import suppress
from pathlib import Path

import pytest

from app.documents.files import load
from app.documents.left_overs import read
from app.terminal.signals import GRACE
from core.program.history import History
from core.program.model import Number
from tests.app.test_safety_terminal import PROGRAM
from tests.terminal import Terminal, running

PATIENCE = 3.0
"""Seconds within which a program must have ended."""


@pytest.fixture
def part(tmp_path: Path) -> Path:
    return tmp_path / "part.toml"


def typed(terminal: Terminal) -> None:
    """One field accepted, one half typed."""
    terminal.until("MILL CONTOUR")
    terminal.send(b"7\t")
    terminal.until("undo 1")
    terminal.send(b"\t3")


def left(part: Path) -> History:
    """What the journal beside the program holds; there is no lock any more, and nothing else."""
    assert [one.name for one in part.parent.iterdir()] == [".part.toml.cutcomp-journal"]
    found = read(part.with_name(".part.toml.cutcomp-journal"))
    assert found is not None
    assert isinstance(found.work, History)
    return found.work


def ended(pid: int, longest: float = PATIENCE) -> int:
    """The exit status of a program whose terminal nobody reads."""
    begun = time.monotonic()
    while time.monotonic() - begun < longest:
        done, code = os.waitpid(pid, os.WNOHANG)
        if done:
            return os.waitstatus_to_exitcode(code)
        time.sleep(0.01)
    raise AssertionError("still running")


@pytest.mark.parametrize("number", [signal.SIGHUP, signal.SIGTERM, signal.SIGINT, signal.SIGQUIT])
def test_a_signal_ends_the_program_in_order(part: Path, number: signal.Signals) -> None:
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
    assert left(part).program.blocks[0].tool == Number(7.0)


def test_an_undo_typed_at_the_end_does_not_stop_the_end(part: Path) -> None:
    """Ctrl+Z means a stop again once the terminal is given back, before the program has ended."""
    with running([*PROGRAM, str(part)]) as terminal:
        typed(terminal)
        os.kill(terminal.pid, signal.SIGTERM)
        begun = time.monotonic()
        while (status := terminal.ended()) is None and time.monotonic() - begun < PATIENCE:
            with suppress(OSError):
                terminal.send(b"\x1a")
            terminal.read(quiet=0.0005, longest=0.001)
        assert status == 128 + signal.SIGTERM
    assert left(part).program.blocks[0].tool == Number(7.0)


def test_a_signal_with_everything_saved_leaves_nothing(part: Path) -> None:
    with running([*PROGRAM, str(part)]) as terminal:
        terminal.until("MILL CONTOUR")
        terminal.send(b"7\t\x13")
        terminal.until("Saved")
        os.kill(terminal.pid, signal.SIGTERM)
        assert terminal.status(PATIENCE) == 143
    assert [one.name for one in part.parent.iterdir()] == ["part.toml"]
    assert load(part).blocks[0].tool == Number(7.0)


def drop(terminal: Terminal) -> None:
    """Close our end of the terminal for good; its number stays taken, for the end of `running`."""
    null = os.open(os.devnull, os.O_RDWR)
    os.dup2(null, terminal.fd)
    os.close(null)


def test_a_dropped_link_ends_the_program(part: Path) -> None:
    with running([*PROGRAM, str(part)]) as terminal:
        typed(terminal)
        drop(terminal)
        assert ended(terminal.pid) == 128 + signal.SIGHUP
    assert left(part).program.blocks[0].tool == Number(7.0)


def test_a_dropped_link_is_noticed_without_a_signal(part: Path) -> None:
    """In a session of its own the program gets no SIGHUP: its input just ends."""
    with running(["setsid", "--wait", *PROGRAM, str(part)]) as terminal:
        typed(terminal)
        begun = time.monotonic()
        drop(terminal)
        lock = part.with_name(".part.toml.cutcomp-lock")
        while lock.exists() and time.monotonic() - begun < PATIENCE:
            time.sleep(0.01)
    assert left(part).program.blocks[0].tool == Number(7.0)


def stall(terminal: Terminal, journal: Path) -> int:
    """Output is stopped, as by a line that has died; type until the program does nothing with it any more.

    Returns how many keys' edits were seen on the disk; how many that are depends on how often the program paints.
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
        # time for the picture of this key
        time.sleep(0.03)
    raise AssertionError("the terminal took everything")


def test_a_terminal_that_takes_nothing_cannot_keep_the_program_alive(part: Path) -> None:
    """The event loop waits for the terminal for ever: no timer and no callback of it runs any more."""
    with running([*PROGRAM, str(part)]) as terminal:
        before = termios.tcgetattr(terminal.fd)
        terminal.until("MILL CONTOUR")
        terminal.send(b"\t")
        kept = stall(terminal, part.with_name(".part.toml.cutcomp-journal"))
        begun = time.monotonic()
        os.kill(terminal.pid, signal.SIGTERM)
        assert ended(terminal.pid, GRACE + PATIENCE) == 143
        assert time.monotonic() - begun > 1.0, "the loop was not blocked: nothing was tested"
        assert termios.tcgetattr(terminal.fd) == before
    found = left(part)
    assert kept > 5
    assert found.undo_count == kept
    assert found.undo_label == "TOOL of START, block 1"


def test_a_disk_that_takes_nothing_is_told_and_the_work_goes_on(part: Path) -> None:
    """No file may grow beyond one kilobyte: the journal stops in the middle of a line."""
    limited = ["bash", "-c", 'ulimit -f 1; exec "$@"', "bash", *PROGRAM, str(part)]
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
    assert len(data) <= 1024


def test_two_operators_with_one_file(part: Path) -> None:
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
            second.until("Block 1: TOOL 8, was 7.")
            second.send(b"d")
            second.until("Kept as")
            second.send(b"9\t\x13")
            second.until("Saved")
            first.send(b"\x13")
            first.until("TAKEN OVER")
            first.send(b"k")
            first.until("part.mine-")
            written = time.monotonic() + 10
            while not (mine := [*part.parent.glob("part.mine-*.toml")]) and time.monotonic() < written:
                first.read(quiet=0.05)
    assert load(part).blocks[0].tool == Number(9.0)
    assert load(mine[0]).blocks[0].tool == Number(8.0)
