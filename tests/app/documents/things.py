"""Things that may stand where a file is expected."""

from __future__ import annotations

import os
import socket
from pathlib import Path

THINGS = {"pipe": "a pipe", "folder": "a folder", "socket": "a socket", "device": "a device"}
"""The things that `put_something` makes, and their names in sentences."""
ENDLESS = 10**13
"""Bytes of an endless file: one large hole."""


def put_something(path: Path, what: str) -> None:
    """Put this in a file's place."""
    match what:
        case "pipe":
            os.mkfifo(path)
        case "folder":
            path.mkdir()
        case "full folder":
            path.mkdir()
            (path / "somebody's").touch()
        case "socket":
            with socket.socket(socket.AF_UNIX) as server:
                folder = Path.cwd()
                os.chdir(path.parent)
                try:
                    # the full path may be too long for a socket
                    server.bind(path.name)
                finally:
                    os.chdir(folder)
        case "device":
            path.symlink_to("/dev/zero")
        case "endless":
            path.touch()
            os.truncate(path, ENDLESS)
        case _:
            raise ValueError(what)
