"""Every way to start the screens: in a terminal, and as the child of a server for browsers."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.terminal import running

PROGRAM = [sys.executable, "-m", "app"]
NC = "G20 G90 G17\nG0 X0 Y0\nT1 M6\nM30\n"


@pytest.mark.parametrize(
    ("arguments", "seen"),
    [
        ((), ("overrun-square",)),
        (("--example", "pocket"), ("MILL CONTOUR", "of 11")),
        (("new", "--light"), ("MILL CONTOUR", "new.toml does not exist yet")),
        (("part.nc",), ("NC PROOF", "linuxcnc", "G0 X0 Y0")),
        (("proof", "part.nc", "--control", "fanuc", "--tool", "1=.375"), ("NC PROOF", "fanuc", "1=0.375")),
    ],
)
def test_the_arguments_choose_the_first_screen(
    arguments: tuple[str, ...], seen: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "part.nc").write_text(NC)
    monkeypatch.setenv("PYTHONPATH", str(Path.cwd()))
    monkeypatch.chdir(tmp_path)
    with running([*PROGRAM, *arguments]) as terminal:
        for text in seen:
            terminal.until(text, longest=30)


def test_a_new_file_is_not_called_saved(tmp_path: Path) -> None:
    with running([*PROGRAM, str(tmp_path / "new.toml")]) as terminal:
        terminal.until("saving makes it")
        assert "saved" not in terminal.text.splitlines()[-1]


def test_proof_refuses_a_contour_program(tmp_path: Path) -> None:
    part = tmp_path / "part.toml"
    part.write_text(Path("app/examples/pocket.toml").read_text())
    result = subprocess.run([*PROGRAM, "proof", part], capture_output=True, text=True, check=False)
    assert result.returncode == 2
    assert "is a program, not an NC file" in result.stderr


def test_the_child_of_a_server_needs_no_terminal() -> None:
    environment = {
        **os.environ,
        "TEXTUAL_DRIVER": "textual.drivers.web_driver:WebDriver",
        "COLUMNS": "80",
        "ROWS": "24",
    }
    child = subprocess.Popen(
        [*PROGRAM, "--example", "pocket"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment
    )
    try:
        data = b""
        while b"MILL CONTOUR" not in data:
            chunk = os.read(child.stdout.fileno(), 65536)
            assert chunk, data
            data += chunk
    finally:
        child.send_signal(signal.SIGTERM)
        child.stdin.close()
        child.stdout.close()
        child.wait(10)


def test_the_mouse_option_takes_clicks_and_the_palette_releases_them() -> None:
    with running([*PROGRAM, "--example", "pocket", "--mouse"]) as terminal:
        terminal.until("of 11", longest=30)
        terminal.read(quiet=0.5)
        assert b"\x1b[?1006h" in terminal.seen
        # the softkey F6 TOOL SETUP, in column 64 and row 11
        terminal.send(b"\x1b[<0;64;11M\x1b[<0;64;11m")
        terminal.until("TOOL SETUP   ", "1 tool", longest=10)
        assert b"\x1b[?1006l" not in terminal.seen
        terminal.send(b"\x0bmouse")
        terminal.until("clicks act here", longest=10)
        terminal.send(b"\r")
        terminal.until("terminal's again", longest=10)
        assert b"\x1b[?1006l" in terminal.seen
