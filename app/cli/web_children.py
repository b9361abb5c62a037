"""The programs a served page starts end with their page and with the server, however it ends."""

from __future__ import annotations

import asyncio
import ctypes
import os
import shlex
import signal
import sys
from collections.abc import Callable
from contextlib import suppress
from importlib import import_module
from typing import Any, Final

GRACE: Final = 1.0
"""Seconds a program has to end by itself after its page is closed; the journal keeps what was typed."""
PR_SET_PDEATHSIG: Final = 1
"""From prctl(2): the signal a process gets when its parent ends."""


def dies_with_parent() -> Callable[[], None] | None:
    """What a new child runs before its program, so that it is killed with its parent; None where there is no prctl."""
    if sys.platform != "linux":
        return None
    prctl = ctypes.CDLL(None, use_errno=True).prctl
    parent = os.getpid()

    def bind() -> None:
        prctl(PR_SET_PDEATHSIG, int(signal.SIGKILL), 0, 0, 0)
        if os.getppid() != parent:  # the parent ended before the call
            os._exit(1)

    return bind


def service() -> Any:  # noqa: ANN401  # the class comes with the extra package
    """textual-serve's service of one page, whose child cannot outlive it; ImportError without the package."""
    base: Any = import_module("textual_serve.app_service").AppService

    class Service(base):  # type: ignore[misc]
        async def _open_app_process(self, width: int = 80, height: int = 24) -> asyncio.subprocess.Process:
            pipe = asyncio.subprocess.PIPE
            self._process = process = await asyncio.create_subprocess_exec(
                *shlex.split(self.command),
                stdin=pipe,
                stdout=pipe,
                stderr=pipe,
                env=self._build_environment(width=width, height=height),
                preexec_fn=dies_with_parent(),
            )
            self._stdin = process.stdin
            return process

        async def stop(self) -> None:
            """Ask the program to end; kill it after GRACE, as one whose output nobody reads cannot answer."""
            try:
                await asyncio.wait_for(super().stop(), GRACE)
            except TimeoutError:
                self._task = None
            finally:
                if self._process is not None and self._process.returncode is None:
                    with suppress(ProcessLookupError):
                        self._process.kill()

    return Service
