"""`cutcomp serve`: the screens in a browser.  There is no login, so the address holds a secret and is of this machine.

A page of somebody else's, open in the same browser, must not reach the screens either: a connection whose Origin or
Host is not the served address is refused.
"""

from __future__ import annotations

import asyncio
import hmac
import logging
import os
import re
import secrets
import shlex
import sys
from collections.abc import Awaitable, Callable
from contextlib import suppress
from importlib import import_module
from ipaddress import ip_address
from pathlib import Path
from typing import Any, Final
from urllib.parse import urlsplit

from app.cli.lifeline import GRACE

LOCAL: Final = ("127.0.0.1", "::1", "localhost")
MISSING: Final = "the browser needs one more package: install cutcomp[web], or textual-serve beside cutcomp."
NO_LOGIN: Final = "There is no login: whoever has the address works as you, on your files."


FOCUS: Final = """<script>
const look = setInterval(() => {
  const typed = document.querySelector("textarea");
  if (typed) typed.focus();
  if (typed && document.activeElement === typed) clearInterval(look);
}, 100);
</script>"""
"""Without it the first key needs a click or Tab: the terminal in the page does not take the keys by itself."""


ELSEWHERE: Final = re.compile(r"<link[^>]*https?://fonts\.[^>]*>")
"""A type from another machine: without the internet the page would wait for it."""
SESSIONS: Final = 8
"""Pages at a time; each is a process of its own."""
FULL: Final = f"{SESSIONS} pages are open, and there is room for no more. Close one, then load this page again."
FULL_SHOWN: Final = 600.0
"""Seconds that this sentence stands in a page."""
LOOK: Final = 0.5
"""Seconds between two looks whether a page is still there."""
HEADERS: Final = {
    "X-Frame-Options": "DENY",
    "Content-Security-Policy": "default-src 'self' 'unsafe-inline' data:; frame-ancestors 'none'; base-uri 'none'",
    "Referrer-Policy": "no-referrer",
}
"""No page of another's around this one, nothing from elsewhere in it, its address told to nobody."""
log = logging.getLogger("cutcomp.serve")
_NAME: Final = re.compile(r"[\w.:\[\]-]+", re.ASCII)


def refusal(host: str, *, allow_network: bool) -> str:
    """Why an address is not served, empty for one that is."""
    if allow_network or is_local(host):
        return ""
    return f"{host} can be reached by others. {NO_LOGIN} Say --allow-network if that is what you want."


def is_local(host: str) -> bool:
    """Whether an address can be reached from this machine only."""
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return host.lower() == "localhost"


def command(file: Path | None) -> str:
    """What a browser's connection starts; no word of it can be more to a shell than a word."""
    words = [sys.executable, "-P", "-m", "app"]
    return shlex.join(words if file is None else [*words, "--", str(file.absolute())])


def serve(file: Path | None, host: str, port: int) -> None:
    """Serve until Ctrl+C; ImportError without the package for it."""
    # the screens are found wherever the server was started, and nothing of that folder is taken for them
    root = str(Path(__file__).parents[2])
    os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, (root, os.environ.get("PYTHONPATH"))))
    secret = secrets.token_urlsafe(24)
    server = site(file, host, port, secret)
    server.initialize_logging()
    words = f"Open {address(host, port)}/{secret}/\nPress Ctrl+C to end."
    import_module("aiohttp.web").run_app(
        server._make_app(),
        host=host,
        port=port,
        # said once it listens; the log of every request would repeat the secret
        print=lambda _: print(words, flush=True),
        access_log=None,
        shutdown_timeout=GRACE,
    )


def site(file: Path | None, host: str, port: int, secret: str) -> Any:  # noqa: ANN401  # comes with the extra package
    """The server of the screens on a file, behind a secret; ImportError without the package for it."""
    module: Any = import_module("textual_serve.server")
    module.AppService = import_module("app.cli.web_children").Service
    server = module.Server(command(file), host, port, title="cutcomp", public_url=address(host, port))
    pages = Pages(server.handle_websocket)
    server.handle_index = _own_page(server.handle_index, host, port, pages)
    server.handle_websocket = _own_pages_only(pages.connect, host, port)
    server.on_startup = _nothing
    server.on_shutdown = pages.end
    server._make_app = _behind_secret(server._make_app, secret)
    return server


async def _nothing(_: object) -> None:
    """In place of the package's own greeting, which names an address without the secret."""


def knows(path: str, secret: str) -> bool:
    """Whether a request's path begins with the secret; compared in constant time."""
    return hmac.compare_digest(path.lstrip("/").partition("/")[0].encode(), secret.encode())


def _behind_secret(make: Callable[[], Awaitable[Any]], secret: str) -> Callable[[], Awaitable[Any]]:
    """Page, socket, downloads and static files below a path that only the printed address names."""
    web = import_module("aiohttp.web")

    @web.middleware  # type: ignore[untyped-decorator]
    async def guard(request: Any, handler: Callable[[Any], Awaitable[Any]]) -> Any:  # noqa: ANN401  # as below
        if not knows(request.path, secret):
            raise web.HTTPNotFound
        return await handler(request)

    async def headers(_: object, response: Any) -> None:  # noqa: ANN401
        response.headers.update(HEADERS)

    async def app() -> Any:  # noqa: ANN401
        outer = web.Application(middlewares=[guard])
        outer.on_response_prepare.append(headers)
        outer.add_subapp(f"/{secret}", await make())
        return outer

    return app


class Pages:
    """The pages that are open: at most SESSIONS at a time, each logged with its address, none behind its connection."""

    def __init__(self, handle: Callable[[Any], Awaitable[Any]]) -> None:
        self._handle = handle
        self._open: set[asyncio.Future[Any]] = set()
        self._refused: set[asyncio.Future[Any]] = set()

    @property
    def full(self) -> bool:
        """Whether there is room for no more."""
        return len(self._open) >= SESSIONS

    async def connect(self, request: Any) -> Any:  # noqa: ANN401  # as above
        """A page's connection, from its beginning to its end."""
        full = self.full
        log.log(logging.WARNING if full else logging.INFO, "%s: %s", "refused" if full else "connected", request.remote)
        pages = self._refused if full else self._open
        page = asyncio.ensure_future(_last_words(request) if full else self._handle(request))
        pages.add(page)
        try:
            while not page.done():
                await asyncio.wait({page}, timeout=LOOK)
                if request.transport is None:
                    # whatever it waits for: nobody is there any more
                    page.cancel()
            return await page
        finally:
            page.cancel()
            pages.discard(page)
            log.info("closed: %s", request.remote)

    async def end(self, _: object) -> None:
        """End all of them, and wait until they have."""
        for patience in (GRACE + 0.2, 0.3):
            pages = self._open | self._refused
            for page in pages:
                # the second time, what waits for a browser's good-bye
                page.cancel()
            if pages:
                await asyncio.wait(pages, timeout=patience)


async def _last_words(request: Any) -> Any:  # noqa: ANN401
    """Say in the page that there is no room for it; a refused connection would only look broken."""
    socket = import_module("aiohttp.web").WebSocketResponse()
    await socket.prepare(request)
    await socket.send_bytes(f"\x1b[2J\x1b[H{FULL}\r\n".encode())
    with suppress(TimeoutError):
        # until the page is closed: at the end of its connection it would cover the sentence
        await asyncio.wait_for(socket.receive(), FULL_SHOWN)
    await socket.close()
    return socket


def address(host: str, port: int) -> str:
    """What is typed into the browser."""
    return f"http://{f'[{host}]' if ':' in host else host}:{port}"


def _own_pages_only(handle: Callable[[Any], Awaitable[Any]], host: str, port: int) -> Callable[[Any], Awaitable[Any]]:
    forbidden = import_module("aiohttp.web").HTTPForbidden

    async def guarded(request: Any) -> Any:  # noqa: ANN401  # the server's own types come with the extra package
        if not welcome(request.headers.get("Host", ""), request.headers.get("Origin", ""), host, port):
            raise forbidden
        return await handle(request)

    return guarded


def _own_page(
    handle: Callable[[Any], Awaitable[Any]], host: str, port: int, pages: Pages
) -> Callable[[Any], Awaitable[Any]]:
    full = import_module("aiohttp.web").HTTPServiceUnavailable

    async def page(request: Any) -> Any:  # noqa: ANN401  # as above
        if pages.full:
            raise full(text=FULL)
        answer = await handle(request)
        answer.text = adapted(answer.text, address(host, port), request.headers.get("Host", ""))
        return answer

    return page


def adapted(page: str, served: str, asked: str) -> str:
    """The page as it works here: the address it was asked for under, no type from another machine, keys at once.

    The server writes the address it listens on into the page; a browser that was told another name of the same
    machine would connect from one to the other and be refused, and 0.0.0.0 is nobody's address.
    """
    here = urlsplit(served).netloc
    page = ELSEWHERE.sub("", page)
    if _NAME.fullmatch(asked):
        page = page.replace(f"//{here}/", f"//{asked}/")
    return page.replace("</body>", f"{FOCUS}</body>")


def welcome(asked: str, origin: str, host: str, port: int) -> bool:
    """Whether a connection comes from the page that was served: its Host and Origin headers are the same address.

    On this machine's own address the name must be one of this machine's too, whatever a name server says.
    """
    if urlsplit(origin).netloc != asked or not asked:
        return False
    name, at = urlsplit(f"//{asked}").hostname, urlsplit(f"//{asked}").port or 80
    return at == port and name is not None and (not is_local(host) or name in LOCAL)
