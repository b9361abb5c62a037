"""What `cutcomp serve` serves, and to whom.  There is no login, so the address holds a secret and is of this machine.

A page of somebody else's, open in the same browser, must not reach the screens either: a connection whose Origin or
Host is not the served address is refused.
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


def knows(path: str, secret: str) -> bool:
    """Whether a request's path begins with the secret; compared in constant time."""
    return hmac.compare_digest(path.lstrip("/").partition("/")[0].encode(), secret.encode())


def address(host: str, port: int) -> str:
    """What is typed into the browser."""
    return f"http://{f'[{host}]' if ':' in host else host}:{port}"


def why_not_served(error: OSError | UnicodeError) -> str:
    """Why an address cannot be listened on, and the remedy; `error` is what the system or the name's coding said."""
    if isinstance(error, UnicodeError | socket.gaierror):
        return "no such machine is known. Check --host."
    if error.errno == errno.EADDRINUSE:
        return "another program uses this port. Choose another one with --port."
    if error.errno == errno.EADDRNOTAVAIL:
        return "this is not an address of this machine. Check --host."
    if error.errno in (errno.EACCES, errno.EPERM):
        return "the system keeps this port for itself. Choose one above 1023 with --port."
    return f"{error.strerror or 'the system refuses'}. Choose another --host or --port."


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
