"""NC programs checked on controls: what stops them and which option helps."""

from __future__ import annotations

from core.controls.control_tools import CutterTool, ToolTable
from core.pipeline.checking import Asked, answer


def asked(control: str, *tools: CutterTool) -> Asked:
    return Asked(control, ToolTable.of(*tools), shop=False, unit=None)


def test_a_missing_diameter_stops_the_run_and_names_the_option_that_gives_it() -> None:
    row = answer(b"G21 F100.\nG41 D3 G1 X10. Y0\nX20.\nM30\n", asked("fanuc:a"))
    assert row.stopped_at == 2
    assert row.why is not None
    assert row.why.text.endswith("On the command line: --tool 3=DIAMETER.")
    assert row.why in row.findings


def test_a_program_with_its_tool_runs_to_its_end() -> None:
    row = answer(b"G21 F100.\nG41 D3 G1 X10. Y0\nX20.\nG40 X30.\nM30\n", asked("fanuc:a", CutterTool(3, 10.0)))
    assert (row.stopped_at, row.why) == (None, None)
