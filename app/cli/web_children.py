"""This module keeps a served page's program from outliving the page or the server, and from piling up data."""

from __future__ import annotations

import asyncio
import logging
import os
import shlex
from collections.abc import Coroutine
from contextlib import suppress
from typing import Final

from textual_serve.app_service import AppService

from app.cli import lifeline
from app.cli.lifeline import GRACE_SECONDS

MAX_UNREAD_SECONDS: Final = 15.0
"""Seconds that a page or its program may leave unread what it is sent; then the program is killed."""
MAX_COMPLAINT_BYTES: Final = 16_384
"""The most bytes of a program's standard error that are logged; the rest is read and dropped."""
WIDTHS: Final = (20, 500)
HEIGHTS: Final = (5, 200)
"""The fewest and the most cells of a page.  A page that has not measured its font yet asks for any number, and a
program that paints 100,000 lines takes gigabytes."""
log = logging.getLogger("cutcomp.serve")


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
                env=self._build_environment(width=width, height=height) | {lifeline.LIFELINE_VARIABLE: str(read_end)},
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
