"""Run `cutcomp serve` as a process and find the programs it starts, for tests and reports."""

from __future__ import annotations

import asyncio
import os
import socket
import subprocess
import sys
from collections.abc import AsyncIterator, Sequence
from contextlib import asynccontextmanager
from pathlib import Path

ROOT = Path(__file__).parents[2]


def free_port() -> int:
    with socket.socket() as server:
        server.bind(("127.0.0.1", 0))
        return int(server.getsockname()[1])


def children(process: int) -> list[int]:
    """The running programs that a process has started."""
    path = Path(f"/proc/{process}/task/{process}/children")
    return [int(word) for word in path.read_text().split() if alive(int(word))]


def alive(process: int) -> bool:
    """Whether a process exists and is not a zombie."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


async def none_left(processes: list[int], longest: float) -> list[int]:
    """The processes still alive after `longest` seconds; returns early when none is left."""
    for _ in range(int(longest / 0.05)):
        if not any(map(alive, processes)):
            break
        await asyncio.sleep(0.05)
    return [process for process in processes if alive(process)]


async def some_children(process: int, others: Sequence[int] = ()) -> list[int]:
    """The programs a process has started besides `others`, once there are any."""
    for _ in range(200):
        if started := [child for child in children(process) if child not in others]:
            return started
        await asyncio.sleep(0.05)
    raise AssertionError("no program was started")


@asynccontextmanager
async def server(
    folder: Path, environment: dict[str, str] | None = None
) -> AsyncIterator[tuple[subprocess.Popen[bytes], str]]:
    """`cutcomp serve` as a separate process, and the address it has printed."""
    code = "from app.__main__ import main; main(['serve', '--port', "
    base = {"PYTHONPATH": str(ROOT), "XDG_CONFIG_HOME": str(folder), "XDG_STATE_HOME": str(folder)}
    process = subprocess.Popen(
        [sys.executable, "-c", f"{code}'{free_port()}'])"],
        cwd=folder,
        env=os.environ | base | (environment or {}),
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    )
    assert process.stdout is not None
    try:
        line = await asyncio.to_thread(process.stdout.readline)
        assert line.startswith(b"Open http://")
        yield process, line.decode().split()[-1]
    finally:
        process.kill()
        process.wait()
        process.stdout.close()
