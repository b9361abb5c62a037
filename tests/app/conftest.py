"""Nothing of the machine may show in a picture: colors, themes and options of the environment are cleared."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

KEPT = "TEXTUAL_SNAPSHOT_"
"""The snapshot plugin's own, set before this is read when the tests are named by their top folder."""

for name in list(os.environ):
    if (name.startswith("TEXTUAL_") and not name.startswith(KEPT)) or name in ("NO_COLOR", "FORCE_COLOR"):
        del os.environ[name]
os.environ["COLUMNS"], os.environ["LINES"] = "80", "24"


@pytest.fixture
def tmp_path() -> Iterator[Path]:
    """A folder whose path is equally long on every machine: a line of the screen shows only part of a long one."""
    with TemporaryDirectory(prefix="cutcomp-", dir="/tmp", ignore_cleanup_errors=True) as folder:
        yield Path(folder)


@pytest.fixture(autouse=True)
def _patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is found must not depend on how busy the disk of the machine is."""
    monkeypatch.setattr("app.file_actions.DISK", 20.0)


@pytest.fixture(autouse=True)
def _own_state(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """What the program of a test keeps is nothing of the person who runs it, nor of another test."""
    with TemporaryDirectory(prefix="cutcomp-", ignore_cleanup_errors=True) as folder:
        monkeypatch.setenv("XDG_STATE_HOME", folder)
        yield


@pytest.fixture
def own(tmp_path: Path) -> Path:
    """A person's folder for journals."""
    return tmp_path / "own"


@pytest.fixture
def part(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The pocket example in a folder of its own, which is the current one."""
    # not before the environment is clear
    from app.documents.files import load, save
    from app.documents.programs import example

    path = tmp_path / "shop" / "part.toml"
    path.parent.mkdir()
    monkeypatch.chdir(path.parent)
    save(load(example("pocket")), path)
    return path
