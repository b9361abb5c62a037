"""`cutcomp serve`: the screens in a browser.  There is no login, so the address holds a secret and is of this machine.

A page of somebody else's, open in the same browser, must not reach the screens either: a connection whose Origin or
Host is not the served address is refused.
"""

from __future__ import annotations

import hmac
import logging
import os
import re
import secrets
import shlex
import sys
from collections.abc import Awaitable, Callable
from importlib import import_module
from ipaddress import ip_address
from pathlib import Path
from typing import Any, Final
from urllib.parse import urlsplit

from app.cli.web_children import service

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
HEADERS: Final = {
    "X-Frame-Options": "DENY",
    "Content-Security-Policy": "default-src 'self' 'unsafe-inline' data:; frame-ancestors 'none'; base-uri 'none'",
    "Referrer-Policy": "no-referrer",
}
"""No page of another's around this one, nothing from elsewhere in it, its address told to nobody."""
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
    module: Any = import_module("textual_serve.server")
    # the screens are found wherever the server was started, and nothing of that folder is taken for them
    root = str(Path(__file__).parents[2])
    os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, (root, os.environ.get("PYTHONPATH"))))
    module.AppService = service()
    # the log of every request would repeat the secret
    logging.getLogger("aiohttp.access").setLevel(logging.WARNING)
    server = module.Server(command(file), host, port, title="cutcomp", public_url=address(host, port))
    server.handle_index = _own_page(server.handle_index, host, port)
    server.handle_websocket = _limited(_own_pages_only(server.handle_websocket, host, port))
    secret = secrets.token_urlsafe(24)
    server.on_startup = _announce(f"{address(host, port)}/{secret}/")
    server._make_app = _behind_secret(server._make_app, secret)
    server.serve()


def _announce(page: str) -> Callable[[Any], Awaitable[None]]:
    async def announce(_: object) -> None:
        print(f"Open {page}\nPress Ctrl+C to end.", flush=True)

    return announce


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


def _limited(handle: Callable[[Any], Awaitable[Any]]) -> Callable[[Any], Awaitable[Any]]:
    """At most SESSIONS pages at a time; each is logged with its address."""
    full = import_module("aiohttp.web").HTTPServiceUnavailable
    log = logging.getLogger("cutcomp.serve")
    count = 0

    async def limited(request: Any) -> Any:  # noqa: ANN401
        nonlocal count
        if count >= SESSIONS:
            log.warning("refused %s: %d pages are open", request.remote, count)
            raise full(text=f"{SESSIONS} pages are open; close one first.")
        count += 1
        log.info("connected: %s", request.remote)
        try:
            return await handle(request)
        finally:
            count -= 1
            log.info("closed: %s", request.remote)

    return limited


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


def _own_page(handle: Callable[[Any], Awaitable[Any]], host: str, port: int) -> Callable[[Any], Awaitable[Any]]:
    async def page(request: Any) -> Any:  # noqa: ANN401  # as above
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
