"""Words of another control: the alarm names the controls that have them, and those controls run them."""

from __future__ import annotations

import pytest

from core.controls.control_run import ControlRun
from core.controls.iso import code_support
from core.controls.registry import CONTROLS
from core.finding import Severity
from tests.core.controls.hand import findings_of, lines_and_ends, run_of

HAVE = {
    code_support.LINUXCNC: "linuxcnc",
    code_support.ROSETTACNC: "rosettacnc",
    code_support.NINE_SERIES: "nine-series",
    code_support.FANUC: "fanuc",
    code_support.HAAS: "haas",
    code_support.THREEBLOCK: "threeblock",
}
ISO = ("threeblock", "rosettacnc", "nine-series", "linuxcnc")

NOT_FOLLOWED = {
    "rosettacnc": "G51 G65 G66 G68",
    "nine-series": "G14.1 G16 G51.1 G68",
    "linuxcnc": "G5 G5.1 G5.2 G5.3 G6 G6.1 G6.2 G28.1 G30.1 G33 G33.1 G70 G71 G71.1 G71.2 G72 G72.1 G72.2 G76",
    "fanuc": "G2.1 G2.2 G2.3 G2.4 G3.1 G3.2 G3.3 G3.4 G6.2 G7 G7.1 G12.1 G13.1 G29 G33 G37 G43.1 G43.4 G43.5 "
    "G45 G46 G47 G48 G66.1 G68.2 G68.3 G68.4",
    "haas": "G12 G13 G35 G36 G70 G71 G72 G100 G101 G107 G136 G141 G143 G150 G174 G184 G234 G254 G255",
}
"""Codes that a control has and whose path cutcomp does not know."""

WITHOUT_EFFECT = {
    "threeblock": "G43 G49",
    "rosettacnc": "G43 G49 G50 G61 G64 G69",
    "nine-series": "G14 G15 G43 G49 G50.1 G61 G64 G69",
    "linuxcnc": "G8 G61 G61.1 G64",
    "fanuc": "G5 G5.1 G8 G9 G11 G22 G23 G27 G43 G44 G49 G60 G61 G62 G63 G64 G67",
    "haas": "G103 G187",
}
"""Codes that do not change the path in the plane."""


def alarm(run: ControlRun) -> str:
    """The text of the alarm that stops a run, or an empty text."""
    if run.stopped_at is None:
        return ""
    return next(finding.text for finding in reversed(run.findings) if finding.severity is Severity.ERROR)


@pytest.mark.parametrize("code", code_support.CONTROLS_WITH_CODE)
def test_controls_named_for_a_code_have_it(code: int) -> None:
    for name in code_support.CONTROLS_WITH_CODE[code]:
        dialect = CONTROLS[HAVE[name]].dialect
        assert dialect is not None
        assert code in dialect.codes, name


@pytest.mark.parametrize(
    ("control", "codes", "names"),
    [
        ("threeblock", "G7 G8 G43.1 G43.2 G61.1 G90.1 G91.1 G92.2 G92.3", "LinuxCNC has it."),
        ("threeblock", "G41.1 G42.1 G59.1 G59.2 G59.3", "LinuxCNC and RosettaCNC have it."),
        ("threeblock", "G92.1", "LinuxCNC and Allen-Bradley 9/Series have it."),
        ("threeblock", "G39", "Allen-Bradley 9/Series and Fanuc have it."),
        ("threeblock", "G39.1", "Allen-Bradley 9/Series has it."),
        ("threeblock", "G50 G69", "RosettaCNC, Fanuc and Haas have it."),
        (
            "threeblock",
            "G10 G52 G53 G61 G64 G96 G97 G98",
            "LinuxCNC, Allen-Bradley 9/Series, Fanuc and Haas have it.",
        ),
        ("rosettacnc", "G44 G45", "three-block has it."),
        ("rosettacnc", "G70 G71", "three-block and Allen-Bradley 9/Series have it."),
    ],
)
def test_the_alarm_for_a_code_names_the_controls_that_have_it(control: str, codes: str, names: str) -> None:
    for code in codes.split():
        assert alarm(run_of(f"G20 F9.\n{code}\nM2\n", control)).endswith(f"write the control's code. {names}"), code


@pytest.mark.parametrize("control", NOT_FOLLOWED)
def test_codes_that_are_not_followed_stop_the_run(control: str) -> None:
    for code in NOT_FOLLOWED[control].split():
        run = run_of(f"G20 G17 F9.\n{code} X1.\nM30\n", control)
        assert (run.stopped_at, [finding.code for finding in run.findings][-1]) == (2, "BEYOND"), code


@pytest.mark.parametrize("control", WITHOUT_EFFECT)
def test_codes_without_effect_in_the_plane_are_accepted(control: str) -> None:
    for code in WITHOUT_EFFECT[control].split():
        run = run_of(f"G20 G17 F9.\n{code}\nG1 X1.\nM30\n", control)
        assert (run.stopped_at, lines_and_ends(run)) == (None, [(1.0, 0.0)]), code


@pytest.mark.parametrize("code", ["G61.1", "G90.1", "G91.1"])
def test_linuxcnc_runs_its_path_modes_and_other_controls_name_linuxcnc(code: str) -> None:
    for control in ISO:
        run = run_of(f"G20 G17 F9.\n{code}\nG1 X1.\nM2\n", control)
        assert (alarm(run).endswith("LinuxCNC has it.")) == (control != "linuxcnc"), control


@pytest.mark.parametrize("control", ["linuxcnc", "rosettacnc"])
def test_d_alone_names_the_controls_that_have_it_in_any_block(control: str) -> None:
    run = run_of("G20 G17 F9.\nD1 X1.\nM30\n", control)
    assert alarm(run).endswith(" Allen-Bradley 9/Series, Fanuc and Haas have it in any block.")


@pytest.mark.parametrize("control", ["rosettacnc", "nine-series"])
def test_g10_l1_names_the_controls_that_set_tool_data(control: str) -> None:
    assert "LinuxCNC, Fanuc and Haas have it." in alarm(run_of("G20 F9.\nG10 L1 P1 R.1\nG1 X1.\nM2\n", control))


@pytest.mark.parametrize("control", ["rosettacnc", "linuxcnc"])
@pytest.mark.parametrize("line", ["G1 X#10001", "#10001=2"])
def test_a_parameter_of_10000_or_more_names_fanuc(control: str, line: str) -> None:
    run = run_of(f"G20 F9.\n{line}\nM2\n", control)
    assert (run.stopped_at, alarm(run).endswith("Fanuc has it.")) == (2, True)


def test_d_and_h_next_to_t_take_effect_on_the_nine_series() -> None:
    run = run_of("G20 G17 F9.\nT1 M6 D1 H1\nG41 G1 X1.\nX3.\n", "nine-series", t1=0.5)
    assert lines_and_ends(run) == [(1.0, 0.25), (3.0, 0.25)]
    assert not findings_of(run, "UNUSED")


@pytest.mark.parametrize("control", ["threeblock", "rosettacnc", "linuxcnc"])
def test_the_alarm_for_d_next_to_t_names_controls_that_accept_it(control: str) -> None:
    run = run_of("G20 G17 F9.\nT1 M6 D1\nG1 X1.\n", control, t1=0.5)
    assert run.stopped_at == 2
    assert "Allen-Bradley 9/Series, Fanuc and Haas have it in any block." in alarm(run)


def test_d_of_a_tool_that_is_not_loaded_is_an_alarm_on_threeblock() -> None:
    text = "G20 G17 F9.\nT{}\nG1 G41 X1. D1\nX3.\nX4.Y1.\nX4.Y5.\nG40 X9.\n"
    other_tool, same_tool = (run_of(text.format(number), "threeblock", t1=0.5, t2=0.25) for number in (2, 1))
    assert (other_tool.stopped_at, findings_of(other_tool, "CODE")[0].line) == (3, 3)
    assert not findings_of(same_tool, "CODE")


def test_h_next_to_t_names_controls_that_accept_it() -> None:
    assert "Fanuc and Haas have it in any block." in alarm(
        run_of("G20 F9.\nT1 M6 H1\nG1 X1.\nM2\n", "linuxcnc", t1=0.5)
    )
    (unused,) = findings_of(run_of("G20 F9.\nT1 M6 H1\nG1 X1.\nM2\n", "rosettacnc", t1=0.5), "UNUSED")
    assert "Fanuc and Haas have it." in unused.text


def test_rosettacnc_needs_no_brackets_right_of_the_equal_sign() -> None:
    run = run_of("G21 F100\n#1=2\n#2=#1+3*4-[1]/2\n#3=SQRT[#1+2]*2\nG1 X#2 Y#3\nM30\n", "rosettacnc")
    assert lines_and_ends(run) == [(13.5, 4.0)]


def test_linuxcnc_refuses_an_expression_without_brackets_at_its_operator() -> None:
    run = run_of("G21 F100\n#1=2\n#2=#1+3\nM2\n", "linuxcnc")
    assert [(finding.line, finding.column) for finding in findings_of(run, "MACRO")] == [(3, 6)]
    assert "RosettaCNC, Fanuc and Haas have it." in alarm(run)


@pytest.mark.parametrize("control", ["threeblock", "nine-series"])
def test_expressions_name_the_controls_that_evaluate_them(control: str) -> None:
    assert "LinuxCNC, RosettaCNC, Fanuc and Haas have it." in alarm(run_of("G20 F9.\n#1=2+3\n", control))


@pytest.mark.parametrize("line", ["IF [#1 EQ 2] GOTO 5", "WHILE [#1 LT 3] DO 1", "GOTO 7", "DO1"])
@pytest.mark.parametrize("control", ISO)
def test_jumps_name_the_controls_that_follow_them(control: str, line: str) -> None:
    run = run_of(f"G20 F9.\n{line}\nM2\n", control)
    assert (run.stopped_at, alarm(run).endswith("Fanuc and Haas have it.")) == (2, True)


@pytest.mark.parametrize("control", ["linuxcnc", "threeblock"])
@pytest.mark.parametrize("block", ["G68 X0 Y0 R30", "G65 P1601 A60. D1", "G12 I.3 K1. Q.2 D1"])
def test_a_code_that_the_control_lacks_is_reported_before_its_words(block: str, control: str) -> None:
    run = run_of(f"G20 F9\nG0 X1.\n{block}\nM2\n", control, t1=0.5)
    (finding,) = findings_of(run, "CODE")
    assert (finding.line, finding.severity) == (3, Severity.ERROR)
    assert finding.text.startswith(f"cutcomp does not know {block.split()[0]} on this control.")
