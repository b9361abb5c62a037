"""This module is the server of `cutcomp serve`; the packages that it needs come with the extra `web`."""

from __future__ import annotations

import asyncio
import logging
import os
import secrets
from collections.abc import Awaitable, Callable
from contextlib import suppress
from pathlib import Path
from typing import Any, Final

import textual_serve.server
from aiohttp import web
from aiohttp.typedefs import Handler, Middleware
from textual_serve.server import Server

from app.cli.lifeline import GRACE_SECONDS
from app.cli.web import address, command, from_served_page, has_secret, page_for_browser
from app.cli.web_children import Service

MAX_PAGES: Final = 8
"""The most pages at a time; each is a process of its own."""
FULL_TEXT: Final = f"{MAX_PAGES} pages are open, and there is room for no more. Close one, then load this page again."
FULL_TEXT_SECONDS: Final = 600.0
"""Seconds that a page shows this sentence."""
CHECK_SECONDS: Final = 0.5
"""Seconds between two checks that a page is still there."""
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
    """Serves the screens on a file, behind a secret."""

    def __init__(self, file: Path | None, host: str, port: int, secret: str) -> None:
        super().__init__(command(file), host, port, title="cutcomp", public_url=address(host, port))
        module: Any = textual_serve.server
        # textual-serve runs the program of each page with this class
        module.AppService = Service
        self.secret = secret
        self.pages = Pages(super().handle_websocket)

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
        """End all pages."""
        await self.pages.end()

    async def handle_index(self, request: web.Request) -> web.StreamResponse:
        """Return the page; refuse it if there is no more room."""
        if self.pages.full:
            raise web.HTTPServiceUnavailable(text=FULL_TEXT)
        answer = await super().handle_index(request)
        assert isinstance(answer, web.Response)
        answer.text = page_for_browser(answer.text or "", self.public_url, request.headers.get("Host", ""))
        return answer

    async def handle_websocket(self, request: web.Request) -> web.WebSocketResponse:
        """Serve a page's connection; refuse it to pages from elsewhere."""
        headers = request.headers
        if not from_served_page(headers.get("Host", ""), headers.get("Origin", ""), self.host, self.port):
            raise web.HTTPForbidden
        return await self.pages.connect(request)


async def _add_headers(_: web.Request, response: web.StreamResponse) -> None:
    response.headers.update(HEADERS)


class Pages:
    """The open pages: at most `MAX_PAGES` at a time, each logged with its address, none outliving its connection."""

    def __init__(self, handle: Callable[[web.Request], Awaitable[web.WebSocketResponse]]) -> None:
        self._handle = handle
        self._open = set[asyncio.Future[web.WebSocketResponse]]()
        self._refused = set[asyncio.Future[web.WebSocketResponse]]()

    @property
    def full(self) -> bool:
        """True if there is no more room."""
        return len(self._open) >= MAX_PAGES

    async def connect(self, request: web.Request) -> web.WebSocketResponse:
        """Serve a page's connection from its beginning to its end."""
        full = self.full
        log.log(logging.WARNING if full else logging.INFO, "%s: %s", "refused" if full else "connected", request.remote)
        pages = self._refused if full else self._open
        page = asyncio.ensure_future(_refuse_in_page(request) if full else self._handle(request))
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

    async def end(self) -> None:
        """End all pages, and wait until they have ended."""
        for patience in (GRACE_SECONDS + 0.2, 0.3):
            pages = self._open | self._refused
            for page in pages:
                # the second time, this ends the wait for the browser to close the connection
                page.cancel()
            if pages:
                await asyncio.wait(pages, timeout=patience)


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
