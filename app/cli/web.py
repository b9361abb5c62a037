"""This module decides what `cutcomp serve` serves, and to whom; with no login, the address is local and secret.

A page from elsewhere, open in the same browser, must not reach the screens either: a connection whose Origin or Host
is not the served address is refused.
"""

from __future__ import annotations

import errno
import hmac
import re
import shlex
import socket
import sys
from ipaddress import ip_address
from pathlib import Path
from typing import Final
from urllib.parse import urlsplit

LOCAL_HOSTS: Final = ("127.0.0.1", "::1", "localhost")
MISSING_PACKAGE_TEXT: Final = (
    "the browser needs one more package: install cutcomp[web], or textual-serve beside cutcomp."
)
NO_LOGIN: Final = "There is no login: whoever has the address works as you, on your files."

FOCUS_SCRIPT: Final = """<script>
const look = setInterval(() => {
  const typed = document.querySelector("textarea");
  if (typed) typed.focus();
  if (typed && document.activeElement === typed) clearInterval(look);
}, 100);
</script>"""
"""Focuses the terminal in the page, which does not take keys by itself until a click or Tab."""

ELSEWHERE: Final = re.compile(r"<link[^>]*https?://fonts\.[^>]*>")
"""A link to a font on another machine: without the internet the page would wait for it."""
_NAME: Final = re.compile(r"[\w.:\[\]-]+", re.ASCII)


def refusal(host: str, *, allow_network: bool) -> str:
    """Return why an address is not served; empty if it is."""
    if allow_network or is_local(host):
        return ""
    return f"{host} can be reached by others. {NO_LOGIN} Add --allow-network if you want that."


def is_local(host: str) -> bool:
    """True if an address can be reached from this machine only."""
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return host.lower() == "localhost"


def command(file: Path | None) -> str:
    """Return the command that a browser's connection starts, quoted so that a shell takes each word literally."""
    words = [sys.executable, "-P", "-m", "app"]
    return shlex.join(words if file is None else [*words, "--", str(file.absolute())])


def has_secret(path: str, secret: str) -> bool:
    """True if a request's path begins with the secret; the comparison takes constant time."""
    return hmac.compare_digest(path.lstrip("/").partition("/")[0].encode(), secret.encode())


def address(host: str, port: int) -> str:
    """Return the URL of the server, without the secret."""
    return f"http://{f'[{host}]' if ':' in host else host}:{port}"


def why_not_served(error: OSError | UnicodeError) -> str:
    """Return why an address cannot be served, and the remedy; `error` is from the system or from encoding the name."""
    if isinstance(error, UnicodeError | socket.gaierror):
        return "no such machine is known. Check --host."
    if error.errno == errno.EADDRINUSE:
        return "another program uses this port. Choose another one with --port."
    if error.errno == errno.EADDRNOTAVAIL:
        return "this is not an address of this machine. Check --host."
    if error.errno in (errno.EACCES, errno.EPERM):
        return "the system keeps this port for itself. Choose one above 1023 with --port."
    return f"{error.strerror or 'the system refuses'}. Choose another --host or --port."


def page_for_browser(page: str, served: str, host_header: str) -> str:
    """Return the page with the address in the browser's Host header, no fonts from elsewhere, and the focus set.

    The server writes the address it listens on into the page; a browser that knows the machine by another name would
    connect from one address to the other and be refused, and 0.0.0.0 is no machine's address.
    """
    listening = urlsplit(served).netloc
    page = ELSEWHERE.sub("", page)
    if _NAME.fullmatch(host_header):
        page = page.replace(f"//{listening}/", f"//{host_header}/")
    return page.replace("</body>", f"{FOCUS_SCRIPT}</body>")


def from_served_page(host_header: str, origin: str, host: str, port: int) -> bool:
    """True if a connection comes from the served page: its Host and Origin headers have the same address.

    If the served address is local, the name must be a local one too, whatever a name server says.
    """
    try:
        if urlsplit(origin).netloc != host_header or not host_header:
            return False
        name, host_port = urlsplit(f"//{host_header}").hostname, urlsplit(f"//{host_header}").port or 80
    except ValueError:
        # an address that cannot be read
        return False
    return host_port == port and name is not None and (not is_local(host) or name in LOCAL_HOSTS)
