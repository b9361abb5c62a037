"""The looks of MILL CONTOUR and the screens around it, with the sizes, colors and signs of terminals."""

from __future__ import annotations

import pytest
from pytest_textual_snapshot import SVGImageExtension
from syrupy.assertion import SnapshotAssertion

from app.app import CutcompApp
from tests.app.screens.snapshots import NOON, Part, app_on, differing, on
from tests.app.screens.test_run_form import golden
from tests.core.program.run_files import program_of
from tests.core.program.test_calculated_runs import case_of, ccw, line

FORM = {
    "start": "",
    "lookahead_field": "0:lookahead",
    "half_typed": "1",
    "unreadable": "escape 0:x_start '1..5 enter",
    "line": "ctrl+z 7:x_end",
    "arc": "8:direction",
    "blend_arc": "4:radius",
    "segments": "f9",
    "findings": "f9 f10",
    "new_segment": "f10 ctrl+end pagedown",
    "help": "7:x_end ?",
    "palette": "f8 ctrl+k l o",
}
WIDE_FORM = {"start": "", "line": "7:x_end", "arc": "8:direction", "help": "?"}
AROUND = {
    "lookahead_table": "0:lookahead space",
    "draw": "f8 8:segment f7",
    "tools": "f8 f6",
    "tool_speed": "tab tab tab '-5 tab tab",
    "part_setup": "f8 f5",
    "parameters": "f8 f4",
    "sheet": "f8 ctrl+k 'setup space s enter",
    "program": "f8 f8",
    "leave": "enter 0:x_start 9 ctrl+q",
}
WIDE_AROUND = {
    "lookahead_table": "escape 0:lookahead space",
    "draw": "f8 8:segment f7",
    "tools": "f8 f6",
    "sheet": "f8 ctrl+k 'setup space s enter",
    "program": "f8 f8",
}
GOUGE = {"gouge": "2:segment", "draw_finding": "f7 n", "post": "f8 f8 f3"}
NARROW = {
    "start": "",
    "line": "7:x_end",
    "lookahead_table": "0:lookahead space",
    "program": "f8 f8",
    "post": "f3",
    "leave": "f8 enter 0:x_start 9 ctrl+q",
}
LOOKS = {
    "no-color": {"gouge": "2:segment", "unreadable": "0:x_start '1..5 enter", "leave": "9 ctrl+q"},
    "ascii": {"gouge": "2:segment", "draw": "f7", "lookahead_table": "f8 0:lookahead space"},
    "sixteen": {"gouge": "2:segment", "unreadable": "0:x_start '1..5 enter", "leave": "9 ctrl+q"},
    "light": {"gouge": "2:segment", "lookahead_table": "0:lookahead space"},
}
MISSING = case_of(line(angle=0), ccw(tangent=True), line(tangent=True, angle=90, x_end=60, y_end=40))
USR = on("overrun-square", {"usr": "0:lookahead 4 enter"})
RUNS = (
    on(program_of(MISSING), {"missing": "2:radius"}),
    on(golden("c05"), {"solution": "2:choice", "calculator": "2:x_end =", "calculator_case": "down enter"}),
)
WALKS: dict[str, tuple[str, list[Part]]] = {
    "form-80x24": ("pocket", [(None, FORM)]),
    "around-80x24": ("pocket", [(None, AROUND)]),
    "others-80x24": ("notch", [(None, GOUGE), on("plate-mm", {"millimeters": "2:segment"}), USR, *RUNS]),
    "form-132x43": ("pocket", [(None, WIDE_FORM | WIDE_AROUND)]),
    "others-132x43": ("notch", [(None, GOUGE), USR, on(golden("c05"), {"solution": "2:choice"})]),
    "form-60x20": ("pocket", [(None, NARROW)]),
}


@pytest.fixture(autouse=True)
def same_everywhere(monkeypatch: pytest.MonkeyPatch) -> None:
    """Set the time to noon of one day and turn off the search for advice, which takes time."""
    monkeypatch.setattr(CutcompApp, "now", lambda _: NOON)
    monkeypatch.setattr("app.derivation_actions.ADVICE_DELAY", 1000.0)


@pytest.fixture
def pictures(snapshot: SnapshotAssertion) -> SnapshotAssertion:
    return snapshot.use_extension(SVGImageExtension)


@pytest.mark.parametrize("name", WALKS)
async def test_screens(name: str, pictures: SnapshotAssertion) -> None:
    start, parts = WALKS[name]
    assert await differing(app_on(start), name.rpartition("-")[2], parts, pictures) == []


@pytest.mark.parametrize("look", LOOKS)
async def test_looks(look: str, pictures: SnapshotAssertion, monkeypatch: pytest.MonkeyPatch) -> None:
    if look == "no-color":
        monkeypatch.setenv("NO_COLOR", "1")
    assert await differing(app_on("notch", look), "80x24", [(None, LOOKS[look])], pictures) == []
