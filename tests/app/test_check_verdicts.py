"""The verdicts of `check` on over-runs at corners, arcs with two radii, and moves that cannot be judged."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from app.cli.check import check
from core.controls.control_names import display_name

THREEBLOCK = """G70G90
N10G0G90X-1.Y1.T1M6
N20G41Y.25Z0
N21G1X-.5Y0F20.
N22X1.5
N23Y-1.5
N24X0
N25Y.4
N26G0G40X-1.Y1.
M2
"""

ISO = """G20 G90 G17 F20.
T1 M6
G0 X-2. Y0.25
G41 D1
G1 X-1. Y0.
X1.5
Y-1.5
X0.
Y1.
G40
G1 X-1. Y3.
M2
"""

KLARTEXT = """BEGIN PGM P INCH
TOOL DEF 1 L+0 R+0.25
TOOL CALL 1 Z S1000
L X-1 Y+1 R0 FMAX
L Z-1 R0 FMAX
L X-0.5 Y+0 RL F100
L X+1.5
L Y-1.5
L X+0
L Y+0.5
L X-1 Y+1 R0
END PGM P INCH
"""

PROGRAMS = {
    "threeblock": THREEBLOCK,
    "rosettacnc:nist": ISO,
    "rosettacnc:easy": ISO,
    "rosettacnc:normal": ISO,
    "nine-series:a": ISO,
    "nine-series:b": ISO,
    "klartext": KLARTEXT,
    "linuxcnc": ISO,
}


def checked(
    capsys: pytest.CaptureFixture[str], folder: Path, text: str, control: str
) -> tuple[int, list[dict[str, object]], str]:
    """The exit status, the findings, and the line that states the outcome."""
    file = folder / "program.nc"
    file.write_text(text)
    arguments = [str(file), "--control", control, "--tool", "1=.5"]
    status = check([*arguments, "--json"])
    findings = json.loads(capsys.readouterr().out)["results"][0]["findings"]
    assert check(arguments) == status
    return status, findings, capsys.readouterr().out.splitlines()[-1]


def rules(findings: list[dict[str, object]]) -> list[object]:
    return [finding["rule"] for finding in findings]


@pytest.mark.parametrize("control", PROGRAMS)
def test_an_over_run_at_a_corner_is_reported_once_as_a_lead(
    control: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    status, findings, outcome = checked(capsys, tmp_path, PROGRAMS[control], control)
    codes = rules(findings)
    assert codes.count("OVER_RUN") == 1, findings
    assert "GOUGE" not in codes
    assert "CROSSES" not in codes
    (over_run,) = [finding for finding in findings if finding["rule"] == "OVER_RUN"]
    assert over_run["severity"] == "info"
    assert "X 0.0000 Y 0.0000" in str(over_run["text"])
    assert status == 0, findings
    assert f"{display_name(control)}: runs;" in outcome


BENT = """G21 G90 G17 G40
T1 M6
G0 X-20. Y-20.
G43 H1 Z5.
G1 Z-5. F200.
G41 D1 G1 X-12. Y-15.
X0. Y-5.
Y40.
X40.
Y0.
X-15.
G40 X-30. Y0.
M30
"""


@pytest.mark.parametrize("control", ["fanuc:a", "fanuc:b", "haas:a", "linuxcnc", "nine-series:a"])
def test_an_over_run_is_a_warning_when_compensation_starts_a_move_earlier(
    control: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    status, findings, outcome = checked(capsys, tmp_path, BENT, control)
    (over_run,) = [finding for finding in findings if finding["rule"] == "OVER_RUN"]
    assert over_run["severity"] == "warning"
    assert over_run["line"] == 7
    text = "Over-run at X 0.000 Y 0.000. Taken for lead beyond it: lines 7, 8 and 11."
    assert str(over_run["text"]).startswith(text)
    assert {"GOUGE", "CROSSES"}.isdisjoint(rules(findings)), findings
    assert status == 0, findings
    assert f"{display_name(control)}: runs, 1 warning (OVER_RUN);" in outcome


OPEN = """G21 G90 G17 G40
T1 M6
G0 X-30. Y20.
G43 H1 Z5.
G1 Z-5. F200.
G41 D1 G1 X-10. Y10.
G3 X0. Y20. R10.
G1 Y50.
X80.
Y0.
X{end}
Y25.
{lead_out}
G40 G1 X-30.
M30
"""


@pytest.mark.parametrize("end", ["5.", "2.", ".2", "-3."])
def test_a_lead_arc_across_the_first_wall_of_an_open_contour_gouges(
    end: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """The last wall should end at X0, on the first wall."""
    text = OPEN.format(end=end, lead_out=f"G3 X{float(end) - 10.0:.1f} Y35. R10.")
    status, findings, _ = checked(capsys, tmp_path, text, "fanuc:a")
    assert "GOUGE" in rules(findings)
    assert "OVER_RUN" not in rules(findings)
    assert status == 1


def test_an_over_run_along_most_of_its_line_is_a_warning(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    text = OPEN.format(end="5.", lead_out="X-10.").replace("G3 X0. Y20. R10.\n", "").replace("X-10. Y10.", "X0. Y20.")
    _, findings, _ = checked(capsys, tmp_path, text, "fanuc:a")
    (over_run,) = [finding for finding in findings if finding["rule"] == "OVER_RUN"]
    assert over_run["severity"] == "warning"
    assert "Taken for lead beyond it: lines 7 and 12." in str(over_run["text"])


SEED = """N10G0G90X-1.Y1.T1M6
N20G41{offset}Y0Z0
N21G1X0Y0F20.
N22X1.5
N23Y-1.5
N24X0
N25Y.1
N26G0G40X-1.Y1.
N30{end}
"""

KLARTEXT_SEED = """BEGIN PGM P INCH
TOOL DEF 1 L+0 R+0.25
TOOL CALL 1 Z S1000
L X-1 Y+1 R0 FMAX
L Z-1 R0 FMAX
L X-1 Y+0 RL F100
L X+0
L X+1.5
L Y-1.5
L X+0
L Y+0.1
L X-1 Y+1 R0
END PGM P INCH
"""

SEEDS = {
    "rosettacnc:easy": SEED.format(offset="", end="M2"),
    "rosettacnc:normal": SEED.format(offset="", end="M2"),
    "nine-series:a": SEED.format(offset="D1", end="M2"),
    "nine-series:b": SEED.format(offset="D1", end="M2"),
    "klartext": KLARTEXT_SEED,
    "linuxcnc": SEED.format(offset="", end="M2"),
}


@pytest.mark.parametrize("control", SEEDS)
def test_an_over_run_past_the_start_corner_is_a_lead(
    control: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """These controls also treat the move to the corner as a lead, so nothing is gouged."""
    status, findings, outcome = checked(capsys, tmp_path, SEEDS[control], control)
    (over_run,) = [finding for finding in findings if finding["rule"] == "OVER_RUN"]
    assert over_run["severity"] == "info"
    assert {"GOUGE", "CROSSES", "UNCUT"}.isdisjoint(rules(findings)), findings
    assert status == 0, findings
    assert f"{display_name(control)}: runs;" in outcome


def test_an_entry_that_nicks_the_corner_is_a_gouge_of_that_depth(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """The control goes straight from (-1, 0) to (0, 0.25): it passes (0, 0) at 0.25 / sqrt(1.0625)."""
    text = SEED.format(offset="", end="T2M6")
    status, findings, outcome = checked(capsys, tmp_path, text, "threeblock")
    (gouge,) = [finding for finding in findings if finding["rule"] == "GOUGE"]
    assert gouge["text"] == "The cutter gouges the surface of line 4 by 0.0075 at X 0.0000 Y 0.0000."
    assert gouge["line"] == 3
    assert "OVER_RUN" in rules(findings)
    assert "CROSSES" not in rules(findings)
    assert status == 1
    assert "three-block: gouges by 0.0075 at line 3;" in outcome


@pytest.mark.parametrize("control", ["linuxcnc", "rosettacnc:easy", "nine-series:a"])
def test_an_over_run_that_cuts_the_part_is_an_error(
    control: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """The last move runs up to the corner and then into the part."""
    text = ISO.replace("X0.\nY1.\n", "X0.\nY0.5\nX0.7 Y-0.7\n")
    assert text != ISO
    status, findings, outcome = checked(capsys, tmp_path, text, control)
    errors = {(finding["rule"], finding["line"]) for finding in findings if finding["severity"] == "error"}
    assert {("GOUGE", 10), ("WRONG-SIDE", 10)} <= errors, findings
    assert "OVER_RUN" not in rules(findings)
    assert status == 1, findings
    assert "gouges by 0.2500 at line 9" in outcome


ARC = """G20 G90 G17 F20.
T1 M6
G0 X-2. Y-2.
G41 D1
G1 X-1. Y-1.5
G1 Y0.
G2 X{end} Y0. I1. J0.
G1 Y-1.
G40
G1 X3. Y-2.
M2
"""

KLARTEXT_ARC = """BEGIN PGM P MM
TOOL DEF 1 L+0 R+5
TOOL CALL 1 Z S1000
L X-40 Y+0 R0 FMAX
L Z-1 R0 FMAX
L X-20 Y-20 RL F100
L Y+0
CC X+0 Y+0
C X+{end} Y+0 DR-
L Y-20
L X+40 Y-30 R0
END PGM P MM
"""


@pytest.mark.parametrize(
    ("control", "text", "difference", "severity"),
    [
        ("linuxcnc", ARC.format(end="1.0003"), "with 0.0003 extra", "info"),
        ("linuxcnc", ARC.format(end="1.0009"), "with 0.0009 extra", "warning"),
        ("rosettacnc:normal", ARC.format(end="1.0003"), "with 0.0003 extra", "info"),
        ("nine-series:a", ARC.format(end="1.0003"), "with 0.0003 extra", "info"),
        ("klartext", KLARTEXT_ARC.format(end="20.01"), "with 0.010 extra", "info"),
        ("klartext", KLARTEXT_ARC.format(end="20.015"), "with 0.015 extra", "warning"),
    ],
)
def test_an_arc_with_two_radii_is_judged_and_their_difference_reported(
    control: str, text: str, difference: str, severity: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    status, findings, outcome = checked(capsys, tmp_path, text, control)
    assert "UNJUDGED" not in rules(findings)
    (radii,) = [finding for finding in findings if finding["rule"] == "ARC_RADII"]
    assert radii["severity"] == severity
    assert radii["line"] == (9 if control == "klartext" else 7)
    assert difference in str(radii["text"])
    assert status == 0
    assert "runs" in outcome


@pytest.mark.parametrize(
    ("control", "text"),
    [
        ("linuxcnc", ARC.format(end="1.5")),
        ("rosettacnc:normal", ARC.format(end="1.01")),
        ("nine-series:a", ARC.format(end="1.01")),
        ("klartext", KLARTEXT_ARC.format(end="20.02")),
    ],
)
def test_an_arc_whose_radii_differ_too_much_for_the_control_is_an_alarm(
    control: str, text: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    status, findings, outcome = checked(capsys, tmp_path, text, control)
    assert status == 1
    assert "UNJUDGED" not in rules(findings)
    assert "alarms at line" in outcome


def test_a_program_that_cannot_be_judged_is_never_reported_to_run(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """Coordinates this large leave too few digits to judge."""
    text = ARC.format(end="1.").replace("G1 Y-1.\n", "G1 Y-1.\nG1 X1. Y-900000.\n")
    status, findings, outcome = checked(capsys, tmp_path, text, "linuxcnc")
    (unjudged,) = [finding for finding in findings if finding["rule"] == "UNJUDGED"]
    assert unjudged["severity"] == "error"
    assert "its numbers are none" not in str(unjudged["text"])
    assert status == 1
    assert "runs" not in outcome
    assert "cannot be judged" in outcome
