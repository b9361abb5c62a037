"""What may stand where a file is expected."""

from __future__ import annotations

import os
import socket
from pathlib import Path

THINGS = {"pipe": "a pipe", "folder": "a folder", "socket": "a socket", "device": "a device"}
"""What `put_something` makes, and what a sentence calls it."""
ENDLESS = 10**13
"""Bytes of a file without end: nothing but a hole."""


def put_something(path: Path, what: str) -> None:
    """Make this in a file's place."""
    match what:
        case "pipe":
            os.mkfifo(path)
        case "folder":
            path.mkdir()
        case "full folder":
            path.mkdir()
            (path / "somebody's").touch()
        case "socket":
            with socket.socket(socket.AF_UNIX) as one:
                here = Path.cwd()
                os.chdir(path.parent)
                try:
                    # the whole path may be too long for a socket
                    one.bind(path.name)
                finally:
                    os.chdir(here)
        case "device":
            path.symlink_to("/dev/zero")
        case "endless":
            path.touch()
            os.truncate(path, ENDLESS)
        case _:
            raise ValueError(what)
