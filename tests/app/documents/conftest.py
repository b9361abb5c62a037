"""Both kinds of document, each in its own folder."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.documents.files import load, save
from app.documents.programs import example
from tests.app.documents.typist import NC


@pytest.fixture(params=["contour program", "NC text"])
def file(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A document of either kind; its folder is the current one."""
    folder = tmp_path / "shop"
    folder.mkdir()
    monkeypatch.chdir(folder)
    if request.param == "NC text":
        (folder / "part.nc").write_bytes(NC)
        return folder / "part.nc"
    save(load(example("pocket")), folder / "part.toml")
    return folder / "part.toml"
