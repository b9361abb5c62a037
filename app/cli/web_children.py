"""The programs a served page starts end with their page and with the server, however it ends, and pile nothing up."""

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
from app.cli.lifeline import GRACE

UNREAD: Final = 15.0
"""Seconds a page may leave what is sent to it unread; its program ends then."""
LARGEST_COMPLAINT: Final = 16_384
"""Bytes of what a program writes on its standard error that are logged; the rest is read and dropped."""
WIDTHS: Final = (20, 500)
HEIGHTS: Final = (5, 200)
"""Cells of a page.  One that has not measured its type yet asks for any number, and a program that paints 100,000
lines takes gigabytes."""
log = logging.getLogger("cutcomp.serve")


def cells(width: int, height: int) -> tuple[int, int]:
    """The size a page asks for, within what a screen can be."""
    return max(WIDTHS[0], min(width, WIDTHS[1])), max(HEIGHTS[0], min(height, HEIGHTS[1]))


async def complaint(errors: asyncio.StreamReader) -> None:
    """Read what a program writes on its standard error to its end; log the beginning."""
    text = b""
    while data := await errors.read(4096):
        text = (text + data)[:LARGEST_COMPLAINT]
    if text:
        log.error("%s", text.decode("utf-8", "replace"))


class Service(AppService):
    """textual-serve's service of one page, whose child cannot outlive it."""

    lifeline: int | None = None
    complaint: asyncio.Task[None] | None = None

    async def start(self, width: int, height: int) -> None:
        """Start the program, on a screen of the size the page asks for."""
        await super().start(*cells(width, height))

    async def set_terminal_size(self, width: int, height: int) -> None:
        """Tell the program the size the page has now."""
        await super().set_terminal_size(*cells(int(width), int(height)))

    async def send_bytes(self, data: bytes) -> bool:
        """Keys to the program, which ends when it takes none; whether they were sent."""
        return await self._taken(super().send_bytes(data))

    async def send_meta(self, data: dict[str, str | int | bool | None]) -> bool:
        """As `send_bytes`, with what is no key."""
        return await self._taken(super().send_meta(data))

    async def _taken(self, sending: Coroutine[None, None, bool]) -> bool:
        try:
            return await asyncio.wait_for(sending, UNREAD)
        except TimeoutError:
            log.warning("a program has taken nothing for %d seconds: it ends", UNREAD)
            self._kill()
            return False

    async def _open_app_process(self, width: int = 80, height: int = 24) -> asyncio.subprocess.Process:
        pipe = asyncio.subprocess.PIPE
        held, self.lifeline = os.pipe()
        try:
            self._process = process = await asyncio.create_subprocess_exec(
                *shlex.split(self.command),
                stdin=pipe,
                stdout=pipe,
                stderr=pipe,
                env=self._build_environment(width=width, height=height) | {lifeline.VARIABLE: str(held)},
                pass_fds=(held,),
            )
        finally:
            os.close(held)
        self._stdin = process.stdin
        assert process.stderr is not None
        self.complaint = asyncio.create_task(complaint(process.stderr))
        # the base class would keep all of it in memory
        process.stderr = asyncio.StreamReader()
        process.stderr.feed_eof()
        return process

    async def on_data(self, payload: bytes) -> None:
        """What the program has painted, to its page; the program ends when the page does not read it."""
        try:
            await asyncio.wait_for(super().on_data(payload), UNREAD)
        except TimeoutError:
            log.warning("a page has read nothing for %d seconds: its program ends", UNREAD)
            self._kill()
            raise ConnectionResetError from None

    def _kill(self) -> None:
        if self._process is not None and self._process.returncode is None:
            with suppress(ProcessLookupError):
                self._process.kill()

    async def stop(self) -> None:
        """Ask the program to end; kill it after GRACE, as one whose output nobody reads cannot answer."""
        try:
            await asyncio.wait_for(super().stop(), GRACE)
        except TimeoutError:
            self._task = None
        finally:
            self._kill()
            if self.lifeline is not None:
                os.close(self.lifeline)
                self.lifeline = None
            if self._process is not None and self._process.stdout is not None:
                # asyncio counts a program as ended when all it has written is read
                await self._process.stdout.read()
                await self._process.wait()
            if self.complaint is not None:
                await self.complaint
