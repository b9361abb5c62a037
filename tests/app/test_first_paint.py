"""What the first paint waits for: the screen that is seen, and none of those that are not."""

import re
import sys
from pathlib import Path

import pytest

from app.files import example
from tests.terminal import running

STARTED = """
import sys
from pathlib import Path
from app.__main__ import guarded
from app.application import CutcompApp

out = sys.argv.pop()

def ready(app):
    Path(out).write_text("\\n".join(sys.modules))
    app.exit()

CutcompApp.on_ready = ready
guarded()
"""
ROOT = Path(__file__).parents[2]
COMPILED = re.compile(r"^from dataclasses import .*\bdataclass\b", re.MULTILINE)
FORM = {"contour", "contour_cells", "contour_keys", "doors", "forms", "frame", "page", "plan", "program", "topics"}
LATER = {
    "app.filing",
    "app.guide",
    "app.recovery",
    "app.starting",
    "argparse",
    "core.program.journal",
    "core.program.tool_table",
    "hashlib",
    "importlib.resources",
    "numpy",
}


def loaded(tmp_path: Path, *arguments: str) -> set[str]:
    """The modules at the first paint of the program with these arguments."""
    out = tmp_path / "modules.txt"
    with running([sys.executable, "-c", STARTED, *arguments, str(out)]) as terminal:
        terminal.read(quiet=10.0)
        status = terminal.ended()
        while status is None:
            terminal.read(quiet=0.05, longest=0.05)
            status = terminal.ended()
    assert status == 0, terminal.text
    return set(out.read_text().splitlines())


def screens(modules: set[str]) -> set[str]:
    """The modules of the screens among them."""
    return {name.removeprefix("app.screens.") for name in modules if name.startswith("app.screens.")}


@pytest.fixture
def part(tmp_path: Path) -> str:
    path = tmp_path / "part.toml"
    path.write_text(example("pocket").read_text())
    return str(path)


def test_a_file_loads_the_form_and_the_list_below_it_alone(tmp_path: Path, part: str) -> None:
    modules = loaded(tmp_path, part)
    assert screens(modules) == FORM
    assert not modules & LATER


def test_without_a_file_the_start_screen_comes_too(tmp_path: Path) -> None:
    modules = loaded(tmp_path)
    assert screens(modules) == FORM | {"start"}
    assert "numpy" not in modules


def test_no_class_on_the_way_has_its_methods_compiled_at_once(tmp_path: Path, part: str) -> None:
    modules = [name for name in loaded(tmp_path, part) if name.split(".")[0] in ("app", "core")]
    paths = [ROOT.joinpath(*name.split(".")) for name in modules]
    sources = [path for one in paths for path in (one.with_suffix(".py"), one / "__init__.py") if path.exists()]
    assert len(sources) == len(modules)
    costly = [str(path.relative_to(ROOT)) for path in sources if COMPILED.search(path.read_text())]
    assert costly == []
