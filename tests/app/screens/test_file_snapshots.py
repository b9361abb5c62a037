"""The looks of the file screens: HOME, IMPORT DRAWING, NC PROOF."""

from __future__ import annotations

import os
from collections.abc import Mapping
from datetime import UTC, datetime
from functools import partial
from pathlib import Path

import pytest
from pytest_textual_snapshot import SVGImageExtension
from syrupy.assertion import SnapshotAssertion

from app.app import CutcompApp
from app.documents.document import FileState, NcDocument
from core.pipeline.checking import CheckRequest
from tests.app.screens.snapshots import NOON, Part, app_on, differing
from tests.app.screens.test_import_drawing import InlineWorker
from tests.tool_tables import end_mills

DATA = Path(__file__).parents[2] / "data"
SAVED = datetime(2024, 1, 2, 12, tzinfo=UTC).timestamp()


def folder(app: CutcompApp) -> None:
    """HOME."""
    app.show_folder(Path("shop"))


def drawing(app: CutcompApp) -> None:
    """IMPORT DRAWING."""
    app.show_drawing(DATA / "dxf/d14-layers.dxf")


def proof(file: str, control: str, stages: Mapping[str, str]) -> Part:
    """NC PROOF of a file on a control."""
    document = NcDocument.read((DATA / file).read_bytes(), FileState(Path(Path(file).name)))
    check_request = CheckRequest(control, end_mills({1: 0.5}), shop=False, unit=None)
    return partial(CutcompApp.show_nc, document=document, check_request=check_request), stages


HOME_AND_IMPORT: list[Part] = [(folder, {"home": "down down"}), (drawing, {"import": "down"})]
SQUARE = {"line": "down down", "finding": "tab down", "tool": "escape t"}
WALKS = {
    "80x24": [
        *HOME_AND_IMPORT,
        proof("nc/threeblock-square.nc", "threeblock", SQUARE),
        proof("klartext/part.h", "klartext", {"large": "f7 n"}),
        proof("nc/rosettacnc-window.ngc", "rosettacnc:normal", {"typing": "enter down down G 1"}),
    ],
    "132x43": [
        *HOME_AND_IMPORT,
        proof("nc/threeblock-outside.nc", "threeblock", {"proof": "down", "compare": "v down"}),
    ],
}


@pytest.fixture(autouse=True)
def same_everywhere(monkeypatch: pytest.MonkeyPatch) -> None:
    """Set the time to noon of one day and read drawings in this process."""
    monkeypatch.setattr(CutcompApp, "now", lambda _: NOON)
    monkeypatch.setattr("app.derivation_actions.ADVICE_DELAY", 1000.0)
    monkeypatch.setattr("app.screens.import_drawing.Worker", InlineWorker)


@pytest.fixture
def pictures(snapshot: SnapshotAssertion) -> SnapshotAssertion:
    return snapshot.use_extension(SVGImageExtension)


@pytest.mark.parametrize("size", WALKS)
async def test_files(size: str, pictures: SnapshotAssertion, part: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    os.utime(part, (SAVED, SAVED))
    monkeypatch.chdir(part.parent.parent)
    assert await differing(app_on("pocket"), size, WALKS[size], pictures) == []
