"""Two operators of one program, through real pseudo-terminals: killed work is offered again to its owner.

What a take-over and an unreadable lock do is tested in `documents/test_unsaved_work.py` and `documents/test_lock.py`.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from app.documents.files import load
from core.program.model import Number
from tests.app.test_safety_terminal import PROGRAM
from tests.terminal import Terminal, running

PATIENCE = 60.0
"""Seconds that a busy machine may take for a step."""


@contextmanager
def operator(part: Path, login: str) -> Iterator[Terminal]:
    """The program run under a login with its own state folder."""
    state = part.parent.parent / login
    environment = {"LOGNAME": login, "XDG_STATE_HOME": str(state), "XDG_CONFIG_HOME": str(state)}
    with running([*PROGRAM, part.name], environment=environment, cwd=str(part.parent)) as terminal:
        yield terminal


def killed(terminal: Terminal) -> None:
    """kill -9 and wait, because a zombie counts as running."""
    os.kill(terminal.pid, signal.SIGKILL)
    terminal.status(PATIENCE)


def tool(terminal: Terminal, number: str, undo: int) -> None:
    """Type TOOL, wherever the cursor is."""
    terminal.send(b"\x1b[1;5H\t" + number.encode() + b"\t")
    terminal.until(f"undo {undo}", longest=PATIENCE)


def saved(terminal: Terminal) -> None:
    terminal.send(b"\x13")
    terminal.until("Saved", longest=PATIENCE)
    terminal.send(b"\x11")
    assert terminal.status(PATIENCE) == 0


def test_anns_work_is_offered_to_bob_and_to_ann_again_after_bob_saves(part: Path) -> None:
    with operator(part, "ann") as ann:
        ann.until("MILL CONTOUR", longest=PATIENCE)
        tool(ann, "7", 1)
        killed(ann)
    with operator(part, "bob") as bob:
        bob.until("part.toml by ann", longest=PATIENCE)
        bob.send(b"l")
        bob.until("Kept for ann", longest=PATIENCE)
        tool(bob, "9", 1)
        saved(bob)
    assert load(part).blocks[0].tool == Number(9.0)
    with operator(part, "ann") as ann:
        ann.until("1 edit.", longest=PATIENCE)
        ann.send(b"r")
        ann.until("Your work is back", longest=PATIENCE)
        saved_over(ann)
    assert load(part).blocks[0].tool == Number(7.0)


def saved_over(terminal: Terminal) -> None:
    """Save over a file written since the work began; both versions are kept."""
    terminal.send(b"\x13")
    terminal.until("CHANGED MEANWHILE", longest=PATIENCE)
    terminal.send(b"y")
    terminal.until("Saved", longest=PATIENCE)
