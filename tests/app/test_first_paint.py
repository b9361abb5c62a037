"""The first paint waits only for the screen in front, not for the other screens."""

import sys
from pathlib import Path

import pytest

from app.documents.programs import example
from tests.terminal import running

STARTED = """
import sys
from pathlib import Path
from app.__main__ import guarded
from app.app import CutcompApp
from app.terminal.driver import TerminalDriver

out = Path(sys.argv.pop())
write = TerminalDriver.write

def writing(driver, data):
    if ("MILL CONTOUR" in data or "\u2500" in data) and not out.exists():
        out.write_text("\\n".join(sys.modules))
    write(driver, data)

def standing(app):
    app.set_timer(0.01, app.exit)

TerminalDriver.write, CutcompApp.on_ready = writing, standing
guarded()
"""
FORCED = """
import os
import sys
from pathlib import Path
from app.__main__ import guarded
from app.app import CutcompApp
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
FORM = {"base", "block_actions", "contour", "contour_cells", "dialogs", "field_texts", "form_screen"}
LATER = {
    "app.cli.commands",
    "app.nc_proof.screen",
    "argparse",
    "numpy",
    "shapely",
}


def loaded(tmp_path: Path, *arguments: str) -> set[str]:
    """The modules at the first paint of the program with these arguments."""
    return set(reported(STARTED, tmp_path, *arguments))


def reported(script: str, tmp_path: Path, *arguments: str) -> list[str]:
    """The lines that the script writes when it starts the program with these arguments."""
    out = tmp_path / "told.txt"
    with running([sys.executable, "-c", script, *arguments, str(out)]) as terminal:
        terminal.read(quiet=10.0)
        assert terminal.status(longest=60.0) == 0
    return out.read_text().splitlines()


def screens(modules: set[str]) -> set[str]:
    """The screen modules among these."""
    return {name.removeprefix("app.screens.") for name in modules if name.startswith("app.screens.")}


@pytest.fixture
def part(tmp_path: Path) -> str:
    path = tmp_path / "part.toml"
    path.write_text(example("pocket").read_text())
    return str(path)


def test_opening_a_file_loads_only_the_form(tmp_path: Path, part: str) -> None:
    modules = loaded(tmp_path, part)
    assert screens(modules) == FORM
    assert modules & LATER == set()


def test_home_loads_no_other_screen(tmp_path: Path) -> None:
    """Its workers, which read the folder meanwhile, may load more before the paint."""
    modules = loaded(tmp_path)
    assert screens(modules) == {*FORM, "home"}
    assert "app.nc_proof.screen" not in modules


def test_only_the_lock_is_synced_to_disk_before_the_first_paint(tmp_path: Path, part: str) -> None:
    forced = reported(FORCED, tmp_path, part)
    before, after = forced[: forced.index("PAINT")], forced[forced.index("PAINT") + 1 :]
    assert [Path(name).name for name in before] == [".part.toml.cutcomp-lock"]
    assert any("settings" in name for name in after)
