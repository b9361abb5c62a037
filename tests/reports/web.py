"""The screens in a browser by keys alone, from the start screen to a posted file: `python -m tests.reports.web [PNG]`.

It needs Chromium (`apt-get install chromium`) and the extra `web`.
"""

from __future__ import annotations

import argparse
import asyncio
import os
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import urlsplit

from tests.reports.browser import browsing, chromium

ROOT = Path(__file__).parents[2]


def free_port() -> int:
    """A port nobody listens on."""
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        port: int = one.getsockname()[1]
        return port


def printed_address(process: subprocess.Popen[bytes], printed: Path) -> str:
    """The address the server prints once it listens; AssertionError when it stops or prints none within a minute."""
    for _ in range(1200):
        # a line that is not whole yet may hold half an address
        for line in printed.read_text().splitlines(keepends=True):
            for word in line.split():
                if line.endswith("\n") and word.startswith("http://"):
                    return word
        assert process.poll() is None, f"the server stopped: {printed.read_text()}"
        time.sleep(0.05)
    raise AssertionError(f"the server printed no address: {printed.read_text()}")


@contextmanager
def serving(folder: Path, port: int) -> Iterator[str]:
    """`cutcomp serve` in a folder, with settings of its own; the address it printed."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "XDG_CONFIG_HOME": str(folder / "config")}
    environment["XDG_STATE_HOME"] = environment["XDG_DATA_HOME"] = str(folder / "state")
    printed = folder / "serve.log"
    with printed.open("wb") as output:
        process = subprocess.Popen(
            [sys.executable, "-m", "app", "serve", "--port", str(port)],
            cwd=folder,
            env=environment,
            stdout=output,
            stderr=subprocess.DEVNULL,
        )
    try:
        yield printed_address(process, printed)
    finally:
        process.terminate()
        process.wait(10)


async def keyed(program: str, page: str, folder: Path, picture: Path | None) -> list[str]:
    """A plate keyed in by the guide's words; what was seen on the way."""
    seen = []
    async with browsing(program, page) as browser:
        await browser.until("GUIDED", longest=60.0)
        seen.append(f"start screen, {browser.screen.columns}x{browser.screen.lines}")
        # not F7, which Chromium keeps to itself
        await asyncio.sleep(1.0)
        await browser.press("ctrl+k", "7")
        await browser.until("GUIDE  Enter")
        await browser.press("enter", "l", "enter", *"1", "enter", *"0", "enter", *"-.25", "enter")
        await browser.press("5", "enter", *"1000", "enter")
        await browser.until("LINE")
        for x, y in ("00", "01", "21", "20", "10"):
            await browser.press(x, "enter", y, "enter")
        await browser.until("GOUGE none")
        seen.append("plate keyed in, GOUGE none")
        if picture is not None:
            await browser.picture(picture)
        await browser.press("ctrl+s")
        await browser.until("SAVE AS")
        await browser.press(*"plate", "enter")
        await browser.until("Saved")
        await browser.press("f8")
        await browser.until("PROGRAM")
        await browser.press("f3")
        await browser.until("POST NC")
        await browser.press("enter")
        await browser.until("Posted")
        seen.append(f"posted, {len((folder / 'plate.nc').read_text().splitlines())} lines")
    return seen


def foreign_page(page: str) -> int:
    """The status a connection from somebody else's page gets."""
    served = urlsplit(page)
    lines = (
        f"GET {served.path}ws HTTP/1.1",
        f"Host: {served.netloc}",
        "Origin: http://elsewhere.example",
        "Connection: Upgrade",
        "Upgrade: websocket",
        "Sec-WebSocket-Version: 13",
        "Sec-WebSocket-Key: MDEyMzQ1Njc4OWFiY2RlZg==",
    )
    with socket.create_connection(("127.0.0.1", served.port or 80), 10) as one:
        one.sendall(("\r\n".join(lines) + "\r\n\r\n").encode())
        return int(one.recv(100).split()[1])


def report(picture: Path | None = None) -> list[str]:
    """Run it all; AssertionError when something is not as it should be."""
    program = chromium()
    assert program is not None, "there is no Chromium: apt-get install chromium"
    with tempfile.TemporaryDirectory() as name:
        folder, port = Path(name), free_port()
        with serving(folder, port) as page:
            assert foreign_page(page) == 403
            return ["another page's connection is refused (403)", *asyncio.run(keyed(program, page, folder, picture))]


if __name__ == "__main__":
    parser = argparse.ArgumentParser("tests.reports.web", description=__doc__)
    parser.add_argument("picture", type=Path, nargs="?", help="a PNG file to write")
    print("\n".join(report(parser.parse_args().picture)))
