"""What the first paint waits for: the screen that is seen, and none of those that are not."""

import subprocess
import sys
from pathlib import Path

import pytest

from app.documents.programs import example
from tests.terminal import running

STARTED = """
import sys
from pathlib import Path
from app import __main__
from app.cli import screens as main

out = Path(sys.argv.pop())
guarded = main.guarded

def ready(app):
    out.write_text("\\n".join(sys.modules))
    app.exit()

def hooked(*given, **named):
    # not before the program itself has imported it
    from app.painted.application import CutcompApp

    CutcompApp.on_ready = ready
    return guarded(*given, **named)

main.guarded = hooked
__main__.guarded()
"""
FORCED = """
import os
import sys
from pathlib import Path
from app.__main__ import guarded
from app.painted.application import CutcompApp
from app.terminal.driver import TerminalDriver

out = Path(sys.argv.pop())
fsync, write, ready = os.fsync, TerminalDriver.write, CutcompApp.on_ready
forced = []

def forcing(handle):
    forced.append(os.readlink(f"/proc/self/fd/{handle}"))
    fsync(handle)

def writing(driver, data):
    if "MILL CONTOUR" in data and not out.exists():
        out.write_text("\\n".join([*forced, "PAINT"]))
    write(driver, data)

def standing(app):
    ready(app)
    out.write_text("\\n".join([out.read_text(), *forced]))
    app.exit()

os.fsync, TerminalDriver.write, CutcompApp.on_ready = forcing, writing, standing
guarded()
"""
ROOT = Path(__file__).parents[2]
FORM = {"contour", "contour_cells", "contour_keys", "doors", "forms", "frame", "page", "plan", "program"}
LATER = {
    "app.painted.filing",
    "app.painted.guide",
    "app.painted.recovery",
    "app.painted.starting",
    "app.cli.commands",
    "argparse",
    "app.painted.journal",
    "hashlib",
    "importlib.resources",
    "numpy",
    "ssl",
    "textual.widgets._select",
    "textual.widgets._tree",
}


def loaded(tmp_path: Path, *arguments: str) -> set[str]:
    """The modules at the first paint of the program with these arguments."""
    return set(told(STARTED, tmp_path, *arguments))


def told(script: str, tmp_path: Path, *arguments: str) -> list[str]:
    """The lines that a script writes which starts the program with these arguments."""
    out = tmp_path / "told.txt"
    with running([sys.executable, "-c", script, *arguments, str(out)]) as terminal:
        terminal.read(quiet=10.0)
        status = terminal.ended()
        while status is None:
            terminal.read(quiet=0.05, longest=0.05)
            status = terminal.ended()
    assert status == 0, terminal.text
    return out.read_text().splitlines()


def screens(modules: set[str]) -> set[str]:
    """The modules of the screens among them."""
    return {name.removeprefix("app.painted.screens.") for name in modules if name.startswith("app.painted.screens.")}


@pytest.fixture
def part(tmp_path: Path) -> str:
    path = tmp_path / "part.toml"
    path.write_text(example("pocket").read_text())
    return str(path)


def test_a_file_loads_the_form_and_the_list_below_it_alone(tmp_path: Path, part: str) -> None:
    modules = loaded(tmp_path, part)
    assert screens(modules) == FORM
    assert modules & LATER == set()


def test_without_a_file_the_start_screen_comes_too(tmp_path: Path) -> None:
    modules = loaded(tmp_path)
    assert screens(modules) == FORM | {"start"}
    assert "numpy" not in modules


def test_no_more_than_the_lock_is_forced_to_the_disk_before_the_first_paint(tmp_path: Path, part: str) -> None:
    forced = told(FORCED, tmp_path, part)
    before, behind = forced[: forced.index("PAINT")], forced[forced.index("PAINT") + 1 :]
    assert [Path(name).name for name in before] == [".part.toml.cutcomp-lock"]
    assert any("settings" in name for name in behind)


def test_what_textual_collects_for_others_is_there_when_it_is_asked_for() -> None:
    asked = """
from app.painted.beforehand import prepare
prepare()
import sys, textual.app, textual._types
assert "textual.widgets._tree" not in sys.modules
from textual.types import IgnoreReturnCallbackType
assert "textual.widgets._tree" not in sys.modules
from textual.types import DirEntry
import textual.types
from textual.widgets._directory_tree import DirEntry as real
assert DirEntry is real is textual.types.DirEntry
assert IgnoreReturnCallbackType is textual.types.IgnoreReturnCallbackType
try:
    from textual.types import Nothing
except ImportError:
    print("as ever")
assert "ssl" not in sys.modules
import ssl
assert ssl.create_default_context()
"""
    done = subprocess.run([sys.executable, "-c", asked], cwd=ROOT, capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == ("as ever\n", "")
