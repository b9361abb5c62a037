"""Moves and findings of a called file count for the line of their own call."""

from __future__ import annotations

from core.controls import registry
from core.controls.control_run import ControlRun
from core.controls.judging.judged_findings import judged_findings
from core.controls.judging.judged_runs import judge_run
from core.finding import Severity
from tests.core.controls.hand import findings_of
from tests.tool_tables import end_mills

SQUARE = "G41{d} G1 X0. Y-10.\nY50.\nX50.\nY20.\nX40.\nY0.\nX-10.\nG40 X-20. Y-20.\n"
"""A step of 10 in a wall; a tool of 24 gouges it on the controls that let it."""

MAIN = "G21 G17 G40 G90 F400\nT1 M6\nG0 X-20. Y-20.\nG1 Z-2.\n{call}\nG52 X100.\nG0 X-20. Y-20.\n{call}\nG52 X0\nM2\n"


def run_with(files: dict[int | str, str], text: str, control: str) -> ControlRun:
    def library(name: int | str) -> tuple[str, bytes] | None:
        return (f"{name}.nc", files[name].encode()) if name in files else None

    run = registry.run(text.encode(), control, end_mills({1: 10.0}), library=library)
    assert isinstance(run, ControlRun)
    return run


def fanuc_files() -> dict[int | str, str]:
    return {100: f"O100\n{SQUARE.format(d=' D1')}M99\n"}


def linuxcnc_files() -> dict[int | str, str]:
    return {"wall": f"o<wall> sub\no1 if [1]\n{SQUARE.format(d='')}o1 endif\no<wall> endsub\n"}


def test_two_calls_of_a_file_have_their_own_lines() -> None:
    for files, call, control in (
        (fanuc_files(), "M98 P100", "fanuc:a"),
        (fanuc_files(), "G65 P100", "haas:a"),
        (linuxcnc_files(), "o<wall> call", "linuxcnc"),
    ):
        run = run_with(files, MAIN.format(call=call), control)
        assert run.stopped_at is None, run.findings
        first, second = run.stretches
        assert {*first.programmed.lines[1:].tolist()} == {5}
        assert {*second.programmed.lines[1:].tolist()} == {8}
        lines = [finding.line for finding in judged_findings(judge_run(run)) if finding.severity is not Severity.INFO]
        assert lines.count(5) == lines.count(8)


def test_a_repeated_call_in_a_loop_adds_the_file_once() -> None:
    text = "G21 G90 F9\n#1=0\nWHILE [#1 LT 50] DO1\nM98 P7\n#1=#1+1\nEND1\nM30\n"
    run = run_with({7: "O7\nG91 G1 X1.\nG90\nM99\n"}, text, "fanuc:a")
    assert run.moves.points[-1, 0] == 50.0
    assert {*run.moves.lines[1:].tolist()} == {4}


def test_findings_of_both_calls_are_reported() -> None:
    text = "G21 G90 F9\nG1 X1.\nM98 P7\nM98 P7\nM30\n"
    run = run_with({7: "O7\nG41 D0 G1 X9.\nG40 X1.\nM99\n"}, text, "fanuc:a")
    told = [(finding.line, finding.text.partition(":")[0]) for finding in findings_of(run, "FN-D0")]
    assert told == [(3, "7.nc line 2"), (4, "7.nc line 2")]


def test_a_program_in_a_called_file_is_found_for_each_call() -> None:
    text = "G21 G90 F9\nM98 P7\nM98 P7\nM98 P8\nM30\n"
    run = run_with({7: "O7\nG91 G1 X1.\nM98 P8\nM99\nO8\nG1 Y1.\nM99\n"}, text, "fanuc:a")
    assert run.stopped_at is None, run.findings
    assert run.moves.lines[1:].tolist()[:4] == [2, 2, 3, 3]
    assert run.moves.points[-1].tolist() == [2.0, 3.0, 0.0]
