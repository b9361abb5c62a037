"""NC PROOF as an operator uses it: keys pressed, the screen read."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from app.documents.programs import empty_program
from app.painted.screens.page import Surface
from app.painted.screens.proof import ProofPage
from app.painted.screens.proof_compare import ComparePage
from app.painted.screens.proof_tool import read_tool
from app.painted.session import Session
from app.painted.widgets.rows import Look
from core.controls.control_tools import CutterTool
from core.finding import Finding, Severity
from core.program.edit import insert_block
from core.units import Unit, sentence
from tests.app.operator import Operator
from tests.app.prover import CORNER, CROSSED, SQUARE, Prover, square


def test_the_listing_stands_beside_the_findings() -> None:
    screen = "\n".join(square().screen())
    assert "NC PROOF  threeblock  tools 1=0.5" in screen
    assert "gouges by 0.0075 at line 3" in screen
    assert "  1 >N10G0G90X-1.Y1.T1M6" in screen
    assert "  3! N21G1X0Y0F20." in screen
    assert "FINDINGS  1 of 3" in screen
    assert "F8 EXIT" in screen


def test_the_prompt_tells_the_finding_of_the_cursors_line() -> None:
    assert square().press("down", "down").said.startswith("!! GOUGE: The cutter gouges the surface of line 4 by 0.0075")


def test_findings_lead_to_their_lines() -> None:
    prover = square().press("tab", "down")
    assert prover.page.row == 2
    assert prover.said.startswith("!! GOUGE")
    assert prover.press("enter").page.telling is False
    assert prover.press("n").page.row == 3
    assert prover.press("n").said == "There is no further finding."
    assert prover.press("p").page.row == 2


def marked(prover: Prover) -> tuple[str, str]:
    """The count over the findings, and the code of the one that has the mark, as they stand on the screen."""
    count, *rows = prover.part("verdict").splitlines()
    return count.strip(), next(word for row in rows if row.startswith("> ") for word in row.split() if word.isupper())


def test_every_finding_is_told_by_its_own_text_though_several_are_in_one_line() -> None:
    prover = Prover.of(CROSSED, "linuxcnc").press("home")
    assert [one.line for one in prover.page.findings] == [1, 3, 3, 3, 7, 7, 9]
    codes = [one.code for one in prover.page.findings]
    assert codes == ["UNIT", "GOUGE", "UNCUT", "CROSSES", "GOUGE", "WRONG-SIDE", "TOOL"]
    for number, one in enumerate(prover.page.findings, 1):
        if number > 1:
            prover.press("n")
        count, code = marked(prover)
        assert count.startswith(f"FINDINGS  {number} of 7")
        assert code == one.code
        assert prover.said.lstrip("! ") == f"{one.code}: {sentence(one, Unit.MM)}"
    assert prover.press("n").said == "There is no further finding."
    for one in reversed(prover.page.findings[:-1]):
        assert prover.press("p").said.lstrip("! ").startswith(f"{one.code}: {sentence(one, Unit.MM)}")


def test_no_finding_is_marked_where_the_prompt_tells_none() -> None:
    prover = Prover.of(CROSSED, "linuxcnc").press("g", "5", "enter")
    assert prover.said.startswith("Enter types in the line")
    count, *rows = prover.part("verdict").splitlines()
    assert count.startswith(" FINDINGS  7 ")
    assert not any(row.startswith(">") for row in rows)
    assert marked(prover.press("n"))[0].startswith("FINDINGS  5 of 7")
    assert marked(prover.press("g", "5", "enter", "p"))[0].startswith("FINDINGS  4 of 7")
    assert prover.said.startswith("! CROSSES")
    assert marked(prover.press("g", "5", "enter", "tab"))[0].startswith("FINDINGS  4 of 7")


def test_the_mark_goes_with_the_cursor_to_what_is_told_of_its_line() -> None:
    prover = Prover.of(CROSSED, "linuxcnc").press("g", "7", "enter")
    assert marked(prover)[0].startswith("FINDINGS  5 of 7")
    prover.press("g", "3", "enter")
    assert marked(prover)[0].startswith("FINDINGS  2 of 7")
    assert prover.said.startswith("!! GOUGE")
    assert prover.press("c", "C").said.startswith("Tried on")
    assert marked(prover)[0].startswith("FINDINGS  2 of 7")


def test_a_finding_that_is_in_no_line_is_gone_to_like_the_others() -> None:
    prover = Prover.of(CROSSED, "linuxcnc")
    page, told = prover.page, prover.page.told
    assert told is not None
    assert told.answer is not None
    more = Finding("GOUGE", Severity.ERROR, "There are 5 more gouges, none of them deeper.")
    told = replace(told, answer=replace(told.answer, findings=(more, *told.answer.findings)))
    prover.desk = replace(prover.desk, pages=(replace(page, told=told, at=1),))
    assert prover.press("p").said == "!! GOUGE: There are 5 more gouges, none of them deeper."
    assert prover.press("p").said == "There is no further finding."
    assert prover.press("n").said.startswith("UNIT")
    assert prover.press("n").said.startswith("!! GOUGE: The cutter")


@pytest.mark.parametrize("size", [(80, 24), (132, 43)])
def test_the_list_of_findings_shows_each_whole(size: tuple[int, int]) -> None:
    prover = Prover.of(CROSSED, "linuxcnc").press("n", "n", "n", "ctrl+f")
    findings = prover.page.findings
    text = " ".join(prover.part("body", *size).split())
    for one in findings:
        assert f"{one.code}: {sentence(one, Unit.MM)}" in text
    assert "> ! 3:" in text
    assert "4 of 7" in prover.part("header", *size)
    assert prover.press("up", "up", "enter").page.at == 1
    assert prover.desk.page is prover.page
    assert prover.page.row == 2


def test_a_long_list_of_findings_keeps_the_marked_one_in_sight() -> None:
    prover = Prover.of(CROSSED, "linuxcnc")
    told = prover.page.told
    assert told is not None
    assert told.answer is not None
    text = "The side changes here, and each part is judged by its own side alone: " * 3 + "write G40 between them."
    findings = tuple(
        Finding("SIDES", Severity.WARNING, f"{at}. {text}", line=1 + at // 5, column=1) for at in range(30)
    )
    told = replace(told, answer=replace(told.answer, findings=findings))
    prover.desk = replace(prover.desk, pages=(replace(prover.page, told=told, at=0),))
    assert prover.press("home").part("prompt").endswith("…")
    assert "Ctrl+F shows them whole" in prover.part("verdict")
    prover.press("f")
    for at, one in enumerate(findings):
        text = " ".join(prover.part("body").split())
        assert text.partition("> ")[2].startswith(f"! {one.line}:1 SIDES: {one.text}")
        assert f"{at + 1} of {len(findings)}" in prover.part("header")
        prover.press("down")
    assert prover.press("home", "escape").desk.page is prover.page


def test_the_list_follows_the_answer_and_changes_nothing_below_it() -> None:
    prover = Prover.of(CROSSED, "linuxcnc")
    asked = prover.page.asked
    desk = prover.desk.press("enter").press("(", "(").press("ctrl+f")
    assert not isinstance(desk.page, ProofPage)
    assert "of the text before" in " ".join(Operator(desk).screen())
    prover.desk = desk
    assert "of the text before" not in " ".join(prover.heard().screen())
    assert prover.page.asked is not asked
    lines = prover.lines
    for key in ("ctrl+z", "ctrl+s", "ctrl+f", "x"):
        assert prover.press(key).lines == lines
        assert not isinstance(prover.desk.page, ProofPage)
    assert Prover.of(b"M2\n", "linuxcnc").press("ctrl+f").said == "There are no findings."


def test_the_title_counts_moves_and_stretches_in_whole_words() -> None:
    long = square(file=Path("a-very-long-name-of-a-part.nc"))
    assert "line 3; 11 moves" in long.screen(132, 43)[1]
    for width in range(80, 133):
        shown = square(file=Path("square.nc")).screen(width, 24)[1].partition("square.nc")[0].strip()
        assert shown.endswith(("moves", "contour", "compensated stretch", "line 3")), shown
    assert "; 11 moves, 1 compensated stretch " in square(file=Path("square.nc")).screen(132, 43)[1]
    assert "; 11 moves, 1 contour " in square(file=Path("a.nc")).screen(80, 24)[1]


def test_softkeys_do_what_their_letters_do() -> None:
    prover = square().press("f1")
    assert prover.lines[0] == "N20G41Y0Z0"
    prover.press("f7", "f1")
    assert prover.lines[0].startswith("N10")
    assert prover.press("f7", "f3").page.control == "rosettacnc:nist"
    assert prover.press("f7", "f3").page.control == "threeblock"


def test_the_control_is_changed_and_all_are_compared() -> None:
    prover = Prover.of(CORNER, "rosettacnc:nist").press("v")
    assert isinstance(prover.desk.page, ComparePage)
    text = "\n".join(prover.screen(80, 40))
    assert "> rosettacnc:nist" in text
    assert "by the contour" in text
    prover.press(*["down"] * 4, "enter")
    assert prover.page.control == "nine-series:b" == prover.page.told.proof.run.control


@pytest.mark.parametrize("key", ["ctrl+z", "ctrl+y", "ctrl+s"])
def test_what_lies_below_the_comparison_is_not_changed_unseen(key: str) -> None:
    prover = Prover.of(CORNER, "rosettacnc:nist")
    session = Session.of(empty_program())
    session = session.apply(insert_block(session.program, 1), "new block")
    prover.desk = replace(prover.desk, session=session)
    prover.press("v", key)
    assert prover.desk.session.history is session.history
    assert isinstance(prover.desk.page, ComparePage)
    assert prover.said == "Esc goes back to the listing first."


def test_another_diameter_changes_the_verdict() -> None:
    prover = square()
    assert prover.page.told.answer.outcome == "gouges by 0.0075 at line 3"
    prover.press("t", *"1=.2", "enter")
    assert prover.page.told.answer.outcome != "gouges by 0.0075 at line 3"
    assert "tools 1=0.2" in "\n".join(prover.screen())
    assert prover.press(">").page.asked.tools.get(1).diameter == pytest.approx(0.201)
    assert prover.press("<", "<").page.asked.tools.get(1).diameter == pytest.approx(0.199)


def test_a_tool_nobody_gave_is_asked_for() -> None:
    prover = Prover.of(SQUARE, "threeblock", tool=None)
    assert "B5-TOOL" in "\n".join(prover.screen())
    assert prover.press("<").said == "Tool 1 has no diameter here yet: t gives it one."
    assert prover.press("t", *".5", "enter").page.told.answer.outcome == "gouges by 0.0075 at line 3"


@pytest.mark.parametrize(
    ("text", "diameter", "number"), [("2=.5", 0.5, 2), ("1/4", 0.25, 7), ("12.7mm", 0.5, 7), ("3=-.5", -0.5, 3)]
)
def test_diameters_are_typed_as_on_the_form(text: str, diameter: float, number: int) -> None:
    tool = read_tool(text, 7, Unit.IN)
    assert isinstance(tool, CutterTool)
    assert tool.number == number
    assert tool.diameter == pytest.approx(diameter)


@pytest.mark.parametrize("text", ["", "x", "1=", "1=2=3", "1e9", "99999"])
def test_what_is_no_diameter_is_said(text: str) -> None:
    assert isinstance(read_tool(text, 7, Unit.IN), str)


def test_a_line_is_gone_to() -> None:
    assert square().press("g", "7", "enter").page.row == 6
    assert square().press("g", "9", "9", "enter").page.row == 8
    assert square().press("g", "x", "enter").said == "!! Type the number of a line."


def test_a_late_answer_to_an_earlier_text_is_dropped() -> None:
    prover = square()
    late = prover.page.asked
    desk = prover.desk.press("x", "x")
    page = desk.page
    assert isinstance(page, ProofPage)
    assert not page.fresh
    assert "of the text before" in " ".join(Operator(desk).screen())
    dropped = desk.told(late.answer()).page
    assert isinstance(dropped, ProofPage)
    assert not dropped.fresh


def test_the_drawing_alone_moves_and_zooms() -> None:
    prover = square().press("d", "right", "+")
    assert prover.page.sketch.dx == pytest.approx(0.125 * 1.25)
    assert prover.page.sketch.zoom == pytest.approx(1.25)
    prover.press("n")
    assert (prover.page.row, prover.page.sketch.dx) == (2, 0.0)
    assert prover.page.sketch.zoom == pytest.approx(1.25)
    assert prover.press("0").page.sketch.zoom == 1.0
    assert prover.press("escape").page.large is False


@pytest.mark.parametrize("size", [(1, 1), (5, 3), (20, 5), (40, 12), (79, 23), (80, 24), (132, 43), (200, 60)])
def test_every_size_is_painted(size: tuple[int, int]) -> None:
    for prover in (square(), square().press("d"), square().press("v"), square().press("t"), Prover.of(b"", "klartext")):
        screen = prover.screen(*size)
        assert len(screen) == size[1]


def test_no_number_is_cut_on_the_table_of_controls_or_in_the_header() -> None:
    text = b"T1 M6\nG0 X1.5 Y0.5\nG1 F10.\nG41 X2. Y0.5\nX3.\nY2.\nX0.\nY0.5\nX2.\nG40 X1.5 Y1.2\nM2\n"
    prover = Prover.of(text, "rosettacnc:easy")
    outcome = prover.page.told.answer.outcome
    header = prover.screen()[1].strip()
    told = header.rpartition("  ")[0].removesuffix(" …").split()
    assert told == outcome.split()[: len(told)]
    assert "…" in header
    seen = " ".join(line.split("│")[0].strip() for line in prover.press("v").screen(80, 40))
    compared = prover.desk.page
    assert isinstance(compared, ComparePage)
    for row in compared.rows:
        assert row.outcome in seen
        assert row.parts in seen


def test_a_run_that_compensates_nothing_does_not_look_clean() -> None:
    page = (
        Prover.of(b"T1\nG0 X1. Y1.\nG41 X1.5 Y.8\nG1 X2. Y.5 F10.\nX3.\nY2.\nG40 X1.5\nM2\n", "threeblock")
        .press("t", *"1=0", "enter")
        .page
    )
    _, (outcome, *_) = page.view(Session.of(empty_program()), Surface()).header
    assert "nothing compensated" in outcome.text
    assert outcome.look is Look.WARNING


def test_help_bears_the_name_of_the_nc_file() -> None:
    assert "part.nc" in square(file=Path("part.nc")).press("?").part("header")
    assert "no name" in square().press("?").part("header")
    assert "part.nc" in square(file=Path("part.nc")).press("v", "ctrl+g").part("header")
