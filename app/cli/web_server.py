"""This module is the server of `cutcomp serve`; the packages that it needs come with the extra `web`.

No page's program outlives the page or the server, and none piles up data.
"""

from __future__ import annotations

import asyncio
import logging
import os
import secrets
import shlex
from collections.abc import Coroutine
from contextlib import suppress
from pathlib import Path
from typing import Any, Final

import textual_serve.server
from aiohttp import web
from aiohttp.typedefs import Handler, Middleware
from textual_serve.app_service import AppService
from textual_serve.server import Server

from app.cli.lifeline import GRACE_SECONDS, LIFELINE_VARIABLE
from app.cli.web import address, command, from_served_page, has_secret, page_for_browser

MAX_PAGES: Final = 8
"""The most pages at a time; each is a process of its own."""
FULL_TEXT: Final = f"{MAX_PAGES} pages are open, and there is room for no more. Close one, then load this page again."
FULL_TEXT_SECONDS: Final = 600.0
"""Seconds that a page shows this sentence."""
CHECK_SECONDS: Final = 0.5
"""Seconds between two checks that a page is still there."""
MAX_UNREAD_SECONDS: Final = 15.0
"""Seconds that a page or its program may leave unread what it is sent; then the program is killed."""
MAX_COMPLAINT_BYTES: Final = 16_384
"""The most bytes of a program's standard error that are logged; the rest is read and dropped."""
WIDTHS: Final = (20, 500)
HEIGHTS: Final = (5, 200)
"""The fewest and the most cells of a page.  A page that has not measured its font yet asks for any number, and a
program that paints 100,000 lines takes gigabytes."""
HEADERS: Final = {
    "X-Frame-Options": "DENY",
    "Content-Security-Policy": "default-src 'self' 'unsafe-inline' data:; frame-ancestors 'none'; base-uri 'none'",
    "Referrer-Policy": "no-referrer",
}
"""Keep the page out of other pages' frames, content from elsewhere out of it, and its address secret."""
log = logging.getLogger("cutcomp.serve")


def serve(file: Path | None, host: str, port: int) -> None:
    """Serve until Ctrl+C; raise OSError if the address cannot be served."""
    # the screens are found from any current folder, and nothing in that folder is taken for them
    root = str(Path(__file__).parents[2])
    os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, (root, os.environ.get("PYTHONPATH"))))
    secret = secrets.token_urlsafe(24)
    server = ScreenServer(file, host, port, secret)
    server.initialize_logging()
    text = f"Open {address(host, port)}/{secret}/\nPress Ctrl+C to end."
    web.run_app(
        server.app(),
        host=host,
        port=port,
        # printed once it listens; a log of every request would repeat the secret
        print=lambda _: print(text, flush=True),
        access_log=None,
        shutdown_timeout=GRACE_SECONDS,
    )


class ScreenServer(Server):
    """Serves the screens on a file, behind a secret: at most `MAX_PAGES` at a time, none outliving its connection."""

    def __init__(self, file: Path | None, host: str, port: int, secret: str) -> None:
        super().__init__(command(file), host, port, title="cutcomp", public_url=address(host, port))
        module: Any = textual_serve.server
        # textual-serve runs the program of each page with this class
        module.AppService = Service
        self.secret = secret
        self._open = set[asyncio.Future[web.WebSocketResponse]]()
        self._refused = set[asyncio.Future[web.WebSocketResponse]]()

    async def app(self) -> web.Application:
        """Return page, socket, downloads and static files below a path that only the printed address names."""
        outer = web.Application(middlewares=[self._guarded()])
        outer.on_response_prepare.append(_add_headers)
        outer.add_subapp(f"/{self.secret}", await self._make_app())
        return outer

    def _guarded(self) -> Middleware:
        @web.middleware
        async def guard(request: web.Request, handler: Handler) -> web.StreamResponse:
            if not has_secret(request.path, self.secret):
                raise web.HTTPNotFound
            return await handler(request)

        return guard

    async def on_startup(self, _: web.Application) -> None:
        """Print nothing: textual-serve's own greeting names an address without the secret."""

    async def on_shutdown(self, _: web.Application) -> None:
        """End all pages, and wait until they have ended."""
        for patience in (GRACE_SECONDS + 0.2, 0.3):
            pages = self._open | self._refused
            for page in pages:
                # the second time, this ends the wait for the browser to close the connection
                page.cancel()
            if pages:
                await asyncio.wait(pages, timeout=patience)

    @property
    def full(self) -> bool:
        """True if there is no more room."""
        return len(self._open) >= MAX_PAGES

    async def handle_index(self, request: web.Request) -> web.StreamResponse:
        """Return the page; refuse it if there is no more room."""
        if self.full:
            raise web.HTTPServiceUnavailable(text=FULL_TEXT)
        answer = await super().handle_index(request)
        assert isinstance(answer, web.Response)
        answer.text = page_for_browser(answer.text or "", self.public_url, request.headers.get("Host", ""))
        return answer

    async def handle_websocket(self, request: web.Request) -> web.WebSocketResponse:
        """Serve a page's connection from its beginning to its end; refuse it to pages from elsewhere."""
        headers = request.headers
        if not from_served_page(headers.get("Host", ""), headers.get("Origin", ""), self.host, self.port):
            raise web.HTTPForbidden
        full = self.full
        log.log(logging.WARNING if full else logging.INFO, "%s: %s", "refused" if full else "connected", request.remote)
        pages = self._refused if full else self._open
        page = asyncio.ensure_future(_refuse_in_page(request) if full else super().handle_websocket(request))
        pages.add(page)
        try:
            while not page.done():
                await asyncio.wait({page}, timeout=CHECK_SECONDS)
                if request.transport is None:
                    # the connection is gone, whatever the page waits for
                    page.cancel()
            return await page
        finally:
            page.cancel()
            pages.discard(page)
            log.info("closed: %s", request.remote)


async def _add_headers(_: web.Request, response: web.StreamResponse) -> None:
    response.headers.update(HEADERS)


async def _refuse_in_page(request: web.Request) -> web.WebSocketResponse:
    """Say in the page that there is no room for it; a refused connection would only look broken."""
    socket = web.WebSocketResponse()
    await socket.prepare(request)
    await socket.send_bytes(f"\x1b[2J\x1b[H{FULL_TEXT}\r\n".encode())
    with suppress(TimeoutError):
        # until the page is closed: when the connection ends, the page covers the sentence
        await asyncio.wait_for(socket.receive(), FULL_TEXT_SECONDS)
    await socket.close()
    return socket


# ---- the program of a page


def limited_size(width: int, height: int) -> tuple[int, int]:
    """Return the size that a page asks for, limited to what a screen can be."""
    return max(WIDTHS[0], min(width, WIDTHS[1])), max(HEIGHTS[0], min(height, HEIGHTS[1]))


async def complaint(errors: asyncio.StreamReader) -> None:
    """Read a program's standard error to its end; log the beginning."""
    text = b""
    while data := await errors.read(4096):
        text = (text + data)[:MAX_COMPLAINT_BYTES]
    if text:
        log.error("%s", text.decode("utf-8", "replace"))


class Service(AppService):
    """textual-serve's service of one page, with a child process that cannot outlive it."""

    lifeline: int | None = None
    complaint: asyncio.Task[None] | None = None

    async def start(self, width: int, height: int) -> None:
        """Start the program on a screen of the size that the page asks for."""
        await super().start(*limited_size(width, height))

    async def set_terminal_size(self, width: int, height: int) -> None:
        """Tell the program the page's new size."""
        await super().set_terminal_size(*limited_size(int(width), int(height)))

    async def send_bytes(self, data: bytes) -> bool:
        """Send keys to the program; return True if they were sent.  A program that does not take them is killed."""
        return await self._send_or_kill(super().send_bytes(data))

    async def send_meta(self, data: dict[str, str | int | bool | None]) -> bool:
        """Send anything but keys, in the same way as `send_bytes`."""
        return await self._send_or_kill(super().send_meta(data))

    async def _send_or_kill(self, sending: Coroutine[None, None, bool]) -> bool:
        try:
            return await asyncio.wait_for(sending, MAX_UNREAD_SECONDS)
        except TimeoutError:
            log.warning("a program has taken nothing for %d seconds: it ends", MAX_UNREAD_SECONDS)
            self._kill()
            return False

    async def _open_app_process(self, width: int = 80, height: int = 24) -> asyncio.subprocess.Process:
        pipe = asyncio.subprocess.PIPE
        read_end, self.lifeline = os.pipe()
        try:
            self._process = process = await asyncio.create_subprocess_exec(
                *shlex.split(self.command),
                stdin=pipe,
                stdout=pipe,
                stderr=pipe,
                env=self._build_environment(width=width, height=height) | {LIFELINE_VARIABLE: str(read_end)},
                pass_fds=(read_end,),
            )
        finally:
            os.close(read_end)
        self._stdin = process.stdin
        assert process.stderr is not None
        self.complaint = asyncio.create_task(complaint(process.stderr))
        # the base class would keep all of that output in memory
        process.stderr = asyncio.StreamReader()
        process.stderr.feed_eof()
        return process

    async def on_data(self, payload: bytes) -> None:
        """Send what the program has painted to its page; kill the program if the page does not read it."""
        try:
            await asyncio.wait_for(super().on_data(payload), MAX_UNREAD_SECONDS)
        except TimeoutError:
            log.warning("a page has read nothing for %d seconds: its program ends", MAX_UNREAD_SECONDS)
            self._kill()
            raise ConnectionResetError from None

    def _kill(self) -> None:
        if self._process is not None and self._process.returncode is None:
            with suppress(ProcessLookupError):
                self._process.kill()

    async def stop(self) -> None:
        """Ask the program to end; kill it after `GRACE_SECONDS`, since one whose output is not read cannot answer."""
        try:
            await asyncio.wait_for(super().stop(), GRACE_SECONDS)
        except TimeoutError:
            self._task = None
        finally:
            self._kill()
            if self.lifeline is not None:
                os.close(self.lifeline)
                self.lifeline = None
            if self._process is not None and self._process.stdout is not None:
                # asyncio counts a program as ended only when all its output has been read
                await self._process.stdout.read()
                await self._process.wait()
            if self.complaint is not None:
                await self.complaint
