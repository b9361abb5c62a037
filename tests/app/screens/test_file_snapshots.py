"""How the screens of files look: HOME, IMPORT DRAWING, NC PROOF."""

from __future__ import annotations

import os
from datetime import UTC, datetime
from functools import partial
from pathlib import Path

import pytest
from pytest_textual_snapshot import SVGImageExtension
from syrupy.assertion import SnapshotAssertion

from app.app import CutcompApp
from app.documents.document import FileState, NcDocument
from core.pipeline.checking import Asked
from tests.app.screens.snapshots import NOON, app_on, differing
from tests.app.screens.test_import_drawing import Here
from tests.tool_tables import end_mills

DATA = Path(__file__).parents[2] / "data"
SAVED = datetime(2024, 1, 2, 12, tzinfo=UTC).timestamp()
PROOFS = {
    "square-80x24": (
        "nc/threeblock-square.nc",
        "threeblock",
        {"line": "down down", "finding": "tab down", "tool": "escape t"},
    ),
    "window-80x24": ("nc/rosettacnc-window.ngc", "rosettacnc:normal", {"typing": "enter down down G 1"}),
    "part-80x24": ("klartext/part.h", "klartext", {"large": "f7 n"}),
    "outside-132x43": ("nc/threeblock-outside.nc", "threeblock", {"line": "down", "compare": "v down"}),
}


@pytest.fixture(autouse=True)
def same_everywhere(monkeypatch: pytest.MonkeyPatch) -> None:
    """Noon of one day; drawings are read in this process."""
    monkeypatch.setattr(CutcompApp, "now", lambda _: NOON)
    monkeypatch.setattr("app.app.QUIET", 1000.0)
    monkeypatch.setattr("app.documents.drawing_files.Worker", Here)


@pytest.fixture
def pictures(snapshot: SnapshotAssertion) -> SnapshotAssertion:
    return snapshot.use_extension(SVGImageExtension)


@pytest.mark.parametrize("size", ["80x24", "132x43"])
async def test_home(size: str, pictures: SnapshotAssertion, part: Path) -> None:
    os.utime(part, (SAVED, SAVED))
    os.chdir("..")
    stages = {"home": "down down"}
    assert await differing(app_on("pocket"), size, stages, pictures, lambda app: app.show_folder(Path("shop"))) == []


@pytest.mark.parametrize("size", ["80x24", "132x43"])
async def test_import(size: str, pictures: SnapshotAssertion) -> None:
    def opened(app: CutcompApp) -> None:
        app.show_drawing(DATA / "dxf/d14-layers.dxf")

    assert await differing(app_on("pocket"), size, {"import": "down"}, pictures, opened) == []


@pytest.mark.parametrize("name", PROOFS)
async def test_proof(name: str, pictures: SnapshotAssertion) -> None:
    file, control, stages = PROOFS[name]
    document = NcDocument.read((DATA / file).read_bytes(), FileState(Path(Path(file).name)))
    asked = Asked(control, end_mills({1: 0.5}), shop=False, unit=None)
    show = partial(CutcompApp.show_nc, document=document, asked=asked)
    assert await differing(app_on("pocket"), name.rpartition("-")[2], stages, pictures, show) == []
