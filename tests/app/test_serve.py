"""`cutcomp serve`: who may connect, what a page may request, and how the programs behind the pages end."""

from __future__ import annotations

import asyncio
import hmac
import json
import os
import shlex
import signal
import sys
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("textual_serve", reason="the extra web is not installed")

import aiohttp

from app.cli import web_server
from app.cli.web_server import FULL_TEXT, MAX_PAGES, ScreenServer
from tests.app.serving import children, free_port, none_left, server, some_children

SECRET = "a-secret-of-the-test"
QUIET = [
    sys.executable,
    "-c",
    "import os; print('__GANGLION__', flush=True)\nwhile b'quit' not in os.read(0, 9999): pass",
]
"""A program that paints nothing and ends on request."""


@asynccontextmanager
async def served(monkeypatch: pytest.MonkeyPatch, words: list[str]) -> AsyncIterator[Site]:
    """A server in this process whose pages start the given program."""
    from aiohttp.test_utils import TestServer

    monkeypatch.setattr("app.cli.web_server.command", lambda _: shlex.join(words))
    others = children(os.getpid())
    port = free_port()
    server = TestServer(await ScreenServer(None, "127.0.0.1", port, SECRET).app(), host="127.0.0.1", port=port)
    await server.start_server()
    async with aiohttp.ClientSession() as session:
        try:
            yield Site(session, f"http://127.0.0.1:{port}", others)
        finally:
            await server.close()


class Site:
    """A browser's view of what is served."""

    def __init__(self, session: aiohttp.ClientSession, root: str, others: list[int]) -> None:
        self.session, self.root, self.others = session, root, others

    async def programs(self) -> list[int]:
        """The programs of its pages, once there are any; earlier child processes are excluded."""
        return await some_children(os.getpid(), self.others)

    async def get(self, path: str) -> aiohttp.ClientResponse:
        answer = await self.session.get(f"{self.root}{path}")
        await answer.read()
        return answer

    async def page(self, path: str = f"/{SECRET}/ws") -> aiohttp.ClientWebSocketResponse:
        return await self.session.ws_connect(f"{self.root}{path}", origin=self.root)


async def test_without_the_secret_nothing_is_served_and_no_program_starts(monkeypatch: pytest.MonkeyPatch) -> None:
    async with served(monkeypatch, QUIET) as site:
        for path in ("/", "/static/js/textual.js", "/another-secret-of-/", "/%ff/", "/download/x"):
            assert (await site.get(path)).status == 404, path
        for path in ("/ws", "/another-secret-of-/ws"):
            with pytest.raises(aiohttp.WSServerHandshakeError) as error:
                await site.page(path)
            assert error.value.status == 404, path


async def test_other_pages_cannot_frame_this_one(monkeypatch: pytest.MonkeyPatch) -> None:
    async with served(monkeypatch, QUIET) as site:
        for path in ("", "static/js/textual.js"):
            answer = await site.get(f"/{SECRET}/{path}")
            assert answer.status == 200
            assert answer.headers["X-Frame-Options"] == "DENY"
            assert "frame-ancestors 'none'" in answer.headers["Content-Security-Policy"]
            assert answer.headers["Referrer-Policy"] == "no-referrer"


async def test_the_secret_is_compared_in_constant_time(monkeypatch: pytest.MonkeyPatch) -> None:
    compared: list[bytes] = []
    same = hmac.compare_digest

    def compare(given: bytes, secret: bytes) -> bool:
        compared.append(secret)
        return same(given, secret)

    monkeypatch.setattr(hmac, "compare_digest", compare)
    async with served(monkeypatch, QUIET) as site:
        for path in ("/", f"/{SECRET}/", f"/{SECRET}/static/js/textual.js", "/ws"):
            await site.get(path)
    assert compared == [SECRET.encode()] * 4


async def test_a_page_beyond_the_limit_gets_a_sentence_and_no_program(monkeypatch: pytest.MonkeyPatch) -> None:
    async with served(monkeypatch, QUIET) as site:
        pages = [await site.page() for _ in range(MAX_PAGES)]
        answer = await site.get(f"/{SECRET}/")
        assert (answer.status, await answer.text()) == (503, FULL_TEXT)
        extra = await site.page()
        assert FULL_TEXT in (await extra.receive_bytes()).decode()
        await pages[0].close()
        for _ in range(40):
            if (await site.get(f"/{SECRET}/")).status == 200:
                break
            await asyncio.sleep(0.1)
        assert (await site.get(f"/{SECRET}/")).status == 200


async def test_connecting_and_leaving_are_logged(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level("INFO", "cutcomp.serve")
    async with served(monkeypatch, QUIET) as site:
        await (await site.page()).close()
    assert [record.getMessage() for record in caplog.records] == ["connected: 127.0.0.1", "closed: 127.0.0.1"]
    assert SECRET not in caplog.text


ECHO = """
import os, sys
def paint(data): sys.stdout.buffer.write(b"D" + len(data).to_bytes(4, "big") + data); sys.stdout.buffer.flush()
print("__GANGLION__", flush=True)
paint(f"{os.environ['COLUMNS']}x{os.environ['ROWS']}".encode())
while b"quit" not in (data := os.read(0, 9999)): paint(data)
"""
FLOOD = """
import os, sys
os.write(2, b"." * 5_000_000)
print("__GANGLION__", flush=True)
while True: os.write(1, b"D" + (60_000).to_bytes(4, "big") + b"." * 60_000)
"""
"""A program that fills all its pipes, reads nothing, and does not end on request."""


def python(program: str) -> list[str]:
    return [sys.executable, "-c", program]


async def test_a_requested_size_is_limited(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without limits, a page of 5 columns and 100,000 lines used a gigabyte per minute."""
    async with served(monkeypatch, python(ECHO)) as site:
        page = await site.page(f"/{SECRET}/ws?width=0&height=9999999")
        assert await page.receive_bytes() == b"20x200"
        await page.send_json(["resize", {"width": 30_000, "height": -4}])
        sent = await page.receive_bytes()
        assert json.loads(sent[5:]) == {"type": "resize", "width": 500, "height": 5}


async def test_a_program_ends_when_its_page_reads_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(web_server, "MAX_UNREAD_SECONDS", 0.5)
    async with served(monkeypatch, python(FLOOD)) as site:
        reader, writer = await asyncio.open_connection("127.0.0.1", int(site.root.rpartition(":")[2]), limit=1024)
        writer.write(handshake(site.root))
        await reader.readline()
        started = await site.programs()
        assert await none_left(started, 5.0) == []
        writer.close()


async def test_a_program_that_reads_no_keys_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(web_server, "MAX_UNREAD_SECONDS", 0.5)
    deaf = "import time; print('__GANGLION__', flush=True); time.sleep(60)"
    async with served(monkeypatch, python(deaf)) as site:
        page = await site.page()
        started = await site.programs()
        await page.send_json(["stdin", "a" * 1_000_000])
        assert await none_left(started, 5.0) == []


async def test_only_the_beginning_of_a_programs_errors_is_logged(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    async with served(monkeypatch, python(FLOOD)) as site:
        page = await site.page()
        await page.receive_bytes()
        started = await site.programs()
        await page.close()
        assert await none_left(started, 5.0) == []
    complaints = [len(record.getMessage()) for record in caplog.records if record.levelname == "ERROR"]
    assert complaints == [web_server.MAX_COMPLAINT_BYTES]


def handshake(root: str) -> bytes:
    """The request with which a browser connects."""
    lines = (
        f"GET /{SECRET}/ws HTTP/1.1",
        f"Host: {root.removeprefix('http://')}",
        f"Origin: {root}",
        "Connection: Upgrade",
        "Upgrade: websocket",
        "Sec-WebSocket-Version: 13",
        "Sec-WebSocket-Key: MDEyMzQ1Njc4OWFiY2RlZg==",
    )
    return ("\r\n".join(lines) + "\r\n\r\n").encode()


@pytest.mark.skipif(not Path("/proc/self/task").is_dir(), reason="needs /proc to find the programs")
@pytest.mark.parametrize(
    ("number", "painted"),
    [(signal.SIGKILL, False), (signal.SIGKILL, True), (signal.SIGTERM, True), (signal.SIGINT, False)],
    ids=["killed", "killed when painted", "ended when painted", "Ctrl+C"],
)
async def test_programs_end_with_their_server(number: int, *, painted: bool, tmp_path: Path) -> None:
    async with server(tmp_path) as (process, address), aiohttp.ClientSession() as session:
        page = await session.ws_connect(f"{address}ws", origin=address.rsplit("/", 2)[0])
        started = await some_children(process.pid)
        if painted:
            await painted_page(page)
        process.send_signal(number)
        assert await none_left([*started, process.pid], 2.0) == []
        await page.close()


async def test_a_program_ends_with_its_page(tmp_path: Path) -> None:
    async with server(tmp_path) as (process, address), aiohttp.ClientSession() as session:
        for painted in (False, True):
            page = await session.ws_connect(f"{address}ws", origin=address.rsplit("/", 2)[0])
            started = await some_children(process.pid)
            if painted:
                await painted_page(page)
            await page.close()
            assert await none_left(started, 2.0) == []


async def painted_page(page: Any) -> None:
    """Read until the program has painted something."""
    size = 0
    while size < 1500:
        size += len(await page.receive_bytes(timeout=20))
