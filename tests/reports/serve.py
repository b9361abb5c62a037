"""`cutcomp serve` with a real browser that misbehaves: `python -m tests.reports.serve`.

First start with cold caches, a tab closed while it is painted, a server that is killed, 20 tabs.  It needs Chromium
and the extra `web`, and takes a minute.
"""

from __future__ import annotations

import argparse
import asyncio
import signal
import tempfile
import time
from pathlib import Path

from app.cli.web_server import MAX_PAGES
from tests.app.serving import none_left, server, some_children
from tests.reports.browser import browsing, chromium

LONGEST = 2.0
"""Seconds a program may outlive its page or its server."""
MOST_MEMORY = 250
"""Megabytes of one program."""
TABS = 20
FIRST_SCREEN = "NEW INCH"


def megabytes(process: int) -> int:
    """What a process holds in memory, 0 once it has ended."""
    try:
        lines = Path(f"/proc/{process}/status").read_text().splitlines()
    except OSError:
        return 0
    return next((int(line.split()[1]) // 1024 for line in lines if line.startswith("VmRSS")), 0)


async def first_start(program: str, folder: Path) -> str:
    """With caches that are empty: the first screen, and what its program holds."""
    cold = {"PYTHONPYCACHEPREFIX": str(folder / "caches")}
    async with server(folder, environment=cold) as (process, address):
        begun = time.monotonic()
        async with browsing(program, address) as browser:
            await browser.until(FIRST_SCREEN, longest=60)
            seconds, held = time.monotonic() - begun, max(map(megabytes, await some_children(process.pid)))
        assert held < MOST_MEMORY, held
        return f"first start with cold caches: HOME after {seconds:.1f} s, {held} MB"


async def closed_while_painting(program: str, folder: Path) -> str:
    """The browser goes at different moments of the start, caches cold each time."""
    waits = (0.0, 0.3, 0.8, 1.5, 3.0)
    for wait in waits:
        cold = {"PYTHONPYCACHEPREFIX": str(folder / f"caches {wait}")}
        async with server(folder, environment=cold) as (process, address):
            async with browsing(program, address):
                started = await some_children(process.pid)
                await asyncio.sleep(wait)
            assert await none_left(started, LONGEST) == [], wait
    return f"closed {', '.join(map(str, waits))} s after the start: no program outlives its page by {LONGEST:g} s"


async def killed(program: str, folder: Path) -> str:
    """The server goes with kill -9 while the page is painted."""
    async with server(folder) as (process, address), browsing(program, address) as browser:
        await browser.until(FIRST_SCREEN, longest=60)
        started = await some_children(process.pid)
        process.send_signal(signal.SIGKILL)
        assert await none_left(started, LONGEST) == []
    return f"server killed: no program outlives it by {LONGEST:g} s"


async def many_tabs(program: str, folder: Path) -> str:
    """20 tabs at once: as many programs as pages are allowed, none too large, none left at the end."""
    async with server(folder) as (process, address):
        async with browsing(program, address) as browser:
            await browser.until(FIRST_SCREEN, longest=60)
            for _ in range(TABS - 1):
                await browser.ask("Target.createTarget", url=address)
            started: list[int] = []
            for _ in range(120):
                started = await some_children(process.pid)
                if len(started) >= MAX_PAGES:
                    break
                await asyncio.sleep(0.5)
            await asyncio.sleep(5.0)
            started = await some_children(process.pid)
            held = list(map(megabytes, started))
        assert len(started) == MAX_PAGES, len(started)
        assert max(held) < MOST_MEMORY, held
        assert await none_left(started, LONGEST) == []
    return f"{TABS} tabs: {len(started)} programs of at most {max(held)} MB, none left {LONGEST:g} s after the browser"


async def report() -> list[str]:
    """Run it all; AssertionError when something is not as it should be."""
    program = chromium()
    assert program is not None, "there is no Chromium: apt-get install chromium"
    lines = []
    for each in (first_start, closed_while_painting, killed, many_tabs):
        with tempfile.TemporaryDirectory() as name:
            lines.append(await each(program, Path(name)))
            print(lines[-1], flush=True)
    return lines


if __name__ == "__main__":
    argparse.ArgumentParser("tests.reports.serve", description=__doc__).parse_args()
    asyncio.run(report())
