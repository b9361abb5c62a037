"""LinuxCNC's own interpreter as a client of posted programs.

Every run has a home folder of its own: interpreters side by side would share a file there and stop without a word.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path as File

import pytest

WITNESS = shutil.which("rs274")
MOVE = re.compile(r"(STRAIGHT_TRAVERSE|STRAIGHT_FEED|ARC_FEED|SET_FEED_RATE)\(([^)]*)\)")
SAYS = "rs274 is not installed (Debian and Ubuntu: apt install linuxcnc-uspace)"


@dataclass(frozen=True)
class Ran:
    """What the interpreter did: `moves` are (name, x, y, z, cx, cy, turns), in program units; a line has no center."""

    accepted: bool
    said: str
    moves: tuple[tuple[str, float, float, float, float, float, int], ...]
    feeds: tuple[float, ...]
    calls: tuple[str, ...]


def require() -> None:
    """Say that the interpreter is missing; on a build machine that is a failure."""
    if WITNESS is None:
        pytest.fail(SAYS) if os.environ.get("CI") else pytest.skip(SAYS)


def process(program: File, table: File, output: int = subprocess.PIPE) -> subprocess.CompletedProcess[str]:
    """Run a file with the file of a tool table; the program's folder is the interpreter's home."""
    assert WITNESS is not None, SAYS
    return subprocess.run(
        [WITNESS, "-g", "-t", str(table), str(program)],
        env={**os.environ, "HOME": str(program.parent)},
        cwd=program.parent,
        stdout=output,
        stderr=subprocess.PIPE,
        text=True,
        timeout=60,
        check=False,
    )


def run(text: str, tools: Mapping[int, float], folder: File) -> Ran:
    """Run a program with a table of tools (number to diameter, in inches as the interpreter reads it)."""
    require()
    table, program = folder / "tool.tbl", folder / "program.ngc"
    table.write_text("".join(f"T{number} P{number} D{diameter:.6f} Z0\n" for number, diameter in tools.items()))
    program.write_text(text, encoding="ascii")
    ended = process(program, table)
    found = [(name, [float(value) for value in values.split(",")]) for name, values in MOVE.findall(ended.stdout)]
    return Ran(
        ended.returncode == 0 and "PROGRAM_END" in ended.stdout,
        ended.stderr,
        tuple(_move(name, values) for name, values in found if name != "SET_FEED_RATE"),
        tuple(values[0] for name, values in found if name == "SET_FEED_RATE"),
        tuple(line.split(None, 2)[-1] for line in ended.stdout.splitlines() if line.strip()),
    )


def _move(name: str, values: list[float]) -> tuple[str, float, float, float, float, float, int]:
    if name != "ARC_FEED":
        return name, values[0], values[1], values[2], 0.0, 0.0, 0
    return name, values[0], values[1], values[5], values[2], values[3], int(values[4])
