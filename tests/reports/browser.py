"""A headless Chromium driven over its own protocol: keys in, the terminal's bytes out, read by an emulator."""

from __future__ import annotations

import asyncio
import base64
import json
import shutil
import subprocess
import tempfile
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pyte

PROGRAMS = ("chromium", "chromium-browser", "google-chrome")
ENTER = {"key": "Enter", "code": "Enter", "windowsVirtualKeyCode": 13, "text": "\r"}
NAMED = {
    "enter": ENTER,
    "tab": {"key": "Tab", "code": "Tab", "windowsVirtualKeyCode": 9},
    "escape": {"key": "Escape", "code": "Escape", "windowsVirtualKeyCode": 27},
    "down": {"key": "ArrowDown", "code": "ArrowDown", "windowsVirtualKeyCode": 40},
    "pagedown": {"key": "PageDown", "code": "PageDown", "windowsVirtualKeyCode": 34},
    "delete": {"key": "Delete", "code": "Delete", "windowsVirtualKeyCode": 46},
    **{f"f{n}": {"key": f"F{n}", "code": f"F{n}", "windowsVirtualKeyCode": 111 + n} for n in range(1, 9)},
}


def chromium() -> str | None:
    """The browser's program, None where there is none."""
    return next((found for name in PROGRAMS if (found := shutil.which(name))), None)


@dataclass
class Browser:
    """One page; `screen` is what the program has sent to it."""

    socket: Any
    screen: pyte.Screen = field(default_factory=lambda: pyte.Screen(80, 24))
    sockets: list[str] = field(default_factory=list)
    answers: dict[int, asyncio.Future[Any]] = field(default_factory=dict)
    count: int = 0

    def __post_init__(self) -> None:
        self.stream = pyte.ByteStream(self.screen)

    async def listen(self) -> None:
        """Take what the browser says, for ever."""
        async for message in self.socket:
            told = message.json()
            if "id" in told:
                self.answers.pop(told["id"]).set_result(told.get("result", {}))
            elif told["method"] == "Network.webSocketCreated":
                self.sockets.append(told["params"]["url"])
            elif told["method"] == "Network.webSocketFrameReceived":
                self._frame(told["params"]["response"])
            elif told["method"] == "Network.webSocketFrameSent":
                self._sent(told["params"]["response"]["payloadData"])

    def _frame(self, response: dict[str, Any]) -> None:
        if response["opcode"] == 2:
            self.stream.feed(base64.b64decode(response["payloadData"]))

    def _sent(self, data: str) -> None:
        """The page tells its size in cells."""
        envelope = json.loads(data)
        if envelope[0] == "resize":
            self.screen.resize(envelope[1]["height"], envelope[1]["width"])

    async def ask(self, method: str, **values: object) -> Any:  # JSON of the browser's protocol
        """One command, and what it answers."""
        self.count += 1
        future = self.answers[self.count] = asyncio.get_running_loop().create_future()
        await self.socket.send_json({"id": self.count, "method": method, "params": values})
        return await asyncio.wait_for(future, 20)

    async def press(self, *keys: str) -> None:
        """Keys by name, or single characters; `ctrl+s` for a character with Ctrl."""
        for key in keys:
            held = 2 if key.startswith("ctrl+") else 0
            name = key.removeprefix("ctrl+")
            code = {"key": name, "code": f"Key{name.upper()}", "windowsVirtualKeyCode": ord(name[0].upper())}
            values = NAMED.get(name) or (code if held else {"key": name, "text": name})
            await self.ask("Input.dispatchKeyEvent", type="keyDown", modifiers=held, **values)
            await self.ask("Input.dispatchKeyEvent", type="keyUp", modifiers=held, **{**values, "text": ""})
            await asyncio.sleep(0.03)

    async def until(self, text: str, *, longest: float = 60.0) -> None:
        """Wait for a text on the screen; AssertionError with the screen if it never comes."""
        for _ in range(int(longest / 0.05)):
            if text in self.text:
                return
            await asyncio.sleep(0.05)
        raise AssertionError(f"{text!r} did not appear:\n{self.text}")

    @property
    def text(self) -> str:
        """The screen as lines of text."""
        return "\n".join(line.rstrip() for line in self.screen.display)

    async def picture(self, path: Path) -> None:
        """What a person at the browser sees."""
        answer = await self.ask("Page.captureScreenshot", format="png")
        path.write_bytes(base64.b64decode(answer["data"]))


@asynccontextmanager
async def browsing(program: str, address: str) -> AsyncIterator[Browser]:
    """A browser on this address; it is ended at the end."""
    import aiohttp

    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        arguments = [
            "--headless=new",
            "--no-sandbox",
            "--disable-gpu",
            "--window-size=1000,640",
            f"--user-data-dir={profile}",
        ]
        process = subprocess.Popen(
            [program, *arguments, "--remote-debugging-port=0", "about:blank"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        try:
            port = await _port(Path(profile) / "DevToolsActivePort")
            async with aiohttp.ClientSession() as session:
                async with session.get(f"http://127.0.0.1:{port}/json") as reply:
                    pages = [page for page in await reply.json() if page["type"] == "page"]
                async with session.ws_connect(pages[0]["webSocketDebuggerUrl"], max_msg_size=0) as socket:
                    browser = Browser(socket)
                    listening = asyncio.create_task(browser.listen())
                    await browser.ask("Network.enable")
                    await browser.ask("Page.enable")
                    await browser.ask("Emulation.setFocusEmulationEnabled", enabled=True)
                    await browser.ask("Page.navigate", url=address)
                    yield browser
                    listening.cancel()
        finally:
            process.terminate()
            process.wait(10)


async def _port(file: Path) -> int:
    """The browser writes its own port there."""
    for _ in range(1600):
        if file.exists() and (lines := file.read_text().splitlines()):
            return int(lines[0])
        await asyncio.sleep(0.05)
    raise AssertionError("the browser did not start")
