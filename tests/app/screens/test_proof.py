"""NC PROOF as an operator uses it: keys pressed, the screen read, files looked at."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from app.desk import Desk
from app.files import empty_program
from app.listing import Listing
from app.messages import Load
from app.screens.proof import ProofPage
from app.screens.proof_compare import ComparePage
from app.screens.proof_files import opening
from app.screens.proof_tool import read_tool
from app.session import Session
from core.controls.tools import CutterTool, ToolTable
from core.units import Unit
from tests.app.operator import Operator

DATA = Path(__file__).parents[2] / "data" / "nc"
SQUARE = (DATA / "threeblock-square.nc").read_bytes()
CORNER = b"G20 G17 G40 G90 F10\nT1 M6\nG0 X-2 Y-2\nG41 D1 G1 X0 Y-1\nX0 Y2\nX2\nY0\nX-1\nG40 G1 X-2\nM30\n"


class Prover(Operator):
    """An operator whose questions are answered after every key."""

    @staticmethod
    def of(data: bytes, control: str, file: Path | None = None, *, tool: float | None = 0.5) -> Prover:
        page = ProofPage.of(Listing.read(data), file, control=control, alone=True)
        tools = ToolTable() if tool is None else ToolTable.diameters({1: tool})
        page = replace(page, asked=replace(page.asked, tools=tools))
        desk = replace(Desk(Session.of(empty_program())), pages=(page,))
        return Prover(desk).heard()

    def heard(self) -> Prover:
        while (question := self.desk.page.question) is not None:
            self.desk = self.desk.told(question.answer())
        return self

    def press(self, *keys: str) -> Prover:
        for key in keys:
            super().press(key)
            self.heard()
        return self

    @property
    def page(self) -> ProofPage:
        return next(page for page in self.desk.pages if isinstance(page, ProofPage))

    @property
    def lines(self) -> list[str]:
        return [self.page.listing.text(row) for row in range(len(self.page.listing))]


def square(control: str = "threeblock", file: Path | None = None) -> Prover:
    return Prover.of(SQUARE, control, file)


def test_the_listing_stands_beside_the_findings() -> None:
    screen = "\n".join(square().screen())
    assert "NC PROOF  threeblock  tools 1=0.5" in screen
    assert "gouges by 0.1045 at line 3" in screen
    assert "  1 >N10G0G90X-1.Y1.T1M6" in screen
    assert "  3! N21G1X0Y0F20." in screen
    assert "FINDINGS  1 of 3" in screen
    assert "F8 EXIT" in screen


def test_the_prompt_tells_the_finding_of_the_cursors_line() -> None:
    assert square().press("down", "down").said.startswith("!! GOUGE: The cutter gouges the surface of line 7 by 0.1045")


def test_findings_lead_to_their_lines() -> None:
    prover = square().press("tab", "down")
    assert prover.page.row == 2
    assert prover.said.startswith("!! GOUGE")
    assert prover.press("enter").page.telling is False
    assert prover.press("n").page.row == 3
    assert prover.press("n").said == "There is no further finding."
    assert prover.press("p").page.row == 2


def test_a_line_is_typed_and_the_verdict_follows() -> None:
    prover = square().press(*["down"] * 6, "enter", *["backspace"] * 6, *"N25Y.3", "enter")
    assert prover.lines[6] == "N25Y.3"
    assert prover.page.row == 7
    assert prover.page.unsaved
    assert "gouges by 0.1045" not in "\n".join(prover.screen())


def test_esc_leaves_a_line_as_it_was() -> None:
    prover = square().press("enter", *"abc", "escape")
    assert prover.page.listing.data == SQUARE
    assert not prover.page.unsaved


def test_lines_are_put_in_and_taken_out_and_brought_back() -> None:
    prover = square().press("down", "i", *"G4 P1", "enter")
    assert prover.lines[1:3] == ["G4 P1", "N20G41Y0Z0"]
    assert prover.press("up", "x").lines[1] == "N20G41Y0Z0"
    prover.press("u", "u", "u")
    assert prover.page.listing.data == SQUARE
    assert prover.press("u").said == "There is nothing to undo."
    prover.press("r", "r")
    assert prover.lines[1] == "G4 P1"
    assert prover.press("ctrl+z").lines[1] == ""
    assert prover.press("ctrl+y").lines[1] == "G4 P1"


def test_softkeys_do_what_their_letters_do() -> None:
    prover = square().press("f1")
    assert prover.lines[0] == "N20G41Y0Z0"
    prover.press("f7", "f1")
    assert prover.lines[0].startswith("N10")
    assert prover.press("f7", "f3").page.control == "rosettacnc:nist"
    assert prover.press("f7", "f3").page.control == "threeblock"


def test_a_softkey_takes_the_line_being_typed_first() -> None:
    prover = square().press("enter", *"X", "f3")
    assert prover.lines[0].endswith("X")
    assert prover.page.control == "rosettacnc:nist"


def test_behind_the_last_line_and_in_an_empty_program() -> None:
    prover = Prover.of(b"", "linuxcnc").press("x")
    assert prover.said == "There is no line."
    prover.press("i", *"M30", "enter")
    assert prover.page.listing.data == b"M30\n"
    prover.press("o", *"M2", "enter")
    assert prover.lines == ["M30", "M2"]


def test_the_control_is_changed_and_all_are_compared() -> None:
    prover = Prover.of(CORNER, "rosettacnc:nist").press("v")
    assert isinstance(prover.desk.page, ComparePage)
    text = "\n".join(prover.screen())
    assert "> rosettacnc:nist" in text
    assert "by the contour" in text
    prover.press(*["down"] * 4, "enter")
    assert prover.page.control == "nine-series:b" == prover.page.told.proof.run.control


def test_another_diameter_changes_the_verdict() -> None:
    prover = square()
    assert prover.page.told.answer.outcome == "gouges by 0.1045 at line 3"
    prover.press("t", *"1=.2", "enter")
    assert prover.page.told.answer.outcome != "gouges by 0.1045 at line 3"
    assert "tools 1=0.2" in "\n".join(prover.screen())
    assert prover.press(">").page.asked.tools.get(1).diameter == pytest.approx(0.201)
    assert prover.press("<", "<").page.asked.tools.get(1).diameter == pytest.approx(0.199)


def test_a_tool_nobody_gave_is_asked_for() -> None:
    prover = Prover.of(SQUARE, "threeblock", tool=None)
    assert "B5-TOOL" in "\n".join(prover.screen())
    assert prover.press("<").said == "Tool 1 has no diameter here yet: t gives it one."
    assert prover.press("t", *".5", "enter").page.told.answer.outcome == "gouges by 0.1045 at line 3"


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


def test_saving_writes_the_file_and_only_what_was_changed(tmp_path: Path) -> None:
    file = tmp_path / "part.nc"
    file.write_bytes(SQUARE.replace(b"\n", b"\r\n"))
    prover = Prover.of(file.read_bytes(), "threeblock", file).press("x", "s")
    assert prover.said.startswith("Saved:")
    assert file.read_bytes() == SQUARE.replace(b"\n", b"\r\n").split(b"\r\n", 1)[1]
    assert not prover.page.unsaved
    assert prover.page.fresh
    assert prover.press("u").page.unsaved


def test_saving_under_another_name_asks_before_it_replaces(tmp_path: Path) -> None:
    other = tmp_path / "other.nc"
    prover = square().press("S", *str(other), "enter")
    assert other.read_bytes() == SQUARE
    assert prover.page.file == other
    other.write_bytes(b"theirs")
    prover.press("s")
    assert "THE FILE HAS CHANGED" in "\n".join(prover.screen())
    prover.press("escape")
    assert other.read_bytes() == b"theirs"
    prover.press("s", "r")
    assert other.read_bytes() == SQUARE


def test_what_cannot_be_written_is_said_and_nothing_is_lost(tmp_path: Path) -> None:
    prover = square("threeblock", tmp_path / "none" / "part.nc").press("x", "s")
    assert "not saved" in prover.said
    assert prover.page.unsaved


def test_leaving_with_changes_is_asked_about() -> None:
    prover = square().press("f8")
    assert prover.desk.exit
    prover = square().press("x", "f8")
    assert "LEAVE?" in "\n".join(prover.screen())
    assert prover.press("escape").desk.exit is False
    assert prover.press("ctrl+q", "l").desk.exit


def test_a_line_of_signs_a_terminal_obeys_shows_none_of_them() -> None:
    prover = Prover.of(b"G1 X1\x1b[2J\x07\tY2\n" + b"x" * 5000 + b"\n\xc2\x9b31m\n", "linuxcnc")
    assert all(line.isprintable() for line in prover.screen())
    prover.press("enter")
    assert all(line.isprintable() for line in prover.screen())


def test_lines_of_any_length_and_with_any_signs_can_be_changed() -> None:
    prover = Prover.of(b"\tG1 X1\x07\r\n" + b"x" * 5000 + b"\r\nM30\r\n", "linuxcnc")
    prover.press("enter", *" Y2", "enter")
    assert prover.page.listing.data.startswith(b"\tG1 X1\x07 Y2\r\nxx")
    assert prover.page.row == 1
    prover.press("enter", "home", "delete", "(", "end", ")")
    assert max(map(len, prover.screen())) <= 80
    prover.press("enter", "s")
    assert prover.lines[1] == f"({'x' * 4999})"


def test_a_line_the_file_cannot_hold_is_refused() -> None:
    prover = Prover.of(b"(\xe9)\nG1 X1\n", "linuxcnc").press("enter", "\u2192", "enter")
    assert "latin-1" in prover.said
    assert prover.page.editing is not None


def test_pasted_text_gives_no_orders() -> None:
    prover = square()
    prover.desk = prover.desk.paste("xxx")
    assert prover.page.listing.data == SQUARE
    prover.press("enter")
    prover.desk = prover.desk.paste("(a)\n(b)")
    assert prover.press("enter").lines[0] == "N10G0G90X-1.Y1.T1M6(a)"


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
    assert prover.press("0").page.sketch.zoom == 1.0
    assert prover.press("n").page.row == 2
    assert prover.press("escape").page.large is False


def test_the_program_screens_open_an_nc_file(tmp_path: Path) -> None:
    file = tmp_path / "part.nc"
    file.write_bytes(b"0 BEGIN PGM P MM\n1 END PGM P MM\n")
    desk = Desk(Session.of(empty_program())).take(Load(file))
    assert isinstance(desk.page, ProofPage)
    assert desk.page.control == "klartext"
    assert not desk.press("f8").exit


def test_a_file_is_chosen_from_a_folder(tmp_path: Path) -> None:
    (tmp_path / "b.nc").write_bytes(SQUARE)
    (tmp_path / "a.toml").write_text("format = 1\n")
    session = replace(Session.of(empty_program()), file=tmp_path / "a.toml")
    prover = Prover(Desk(session)).press("f8", "f7", "f7", "f5")
    text = "\n".join(prover.screen())
    assert "b.nc" in text
    assert "a.toml" not in text
    assert isinstance(prover.press("down", "enter").desk.page, ProofPage)
    assert "line 3" not in prover.said


def test_what_is_no_file_is_a_sentence(tmp_path: Path) -> None:
    desk = opening(tmp_path)(Desk(Session.of(empty_program())))
    assert "is not opened" in desk.session.said.text


def test_unsaved_lines_are_not_lost_to_another_program(tmp_path: Path) -> None:
    (tmp_path / "a.toml").write_text('format = 1\nunits = "IN"\n')
    prover = square().press("x")
    desk = prover.desk.take(Load(tmp_path / "a.toml"))
    assert isinstance(desk.page, ProofPage)
    assert "not saved" in desk.session.said.text


@pytest.mark.parametrize("size", [(1, 1), (5, 3), (20, 5), (40, 12), (79, 23), (80, 24), (132, 43), (200, 60)])
def test_every_size_is_painted(size: tuple[int, int]) -> None:
    for prover in (square(), square().press("d"), square().press("v"), square().press("t"), Prover.of(b"", "klartext")):
        screen = prover.screen(*size)
        assert len(screen) == size[1]


def test_a_long_program_is_run_first_and_judged_then() -> None:
    page = ProofPage.of(Listing.read(SQUARE + b"(x)\n" * 2100), control="threeblock")
    page = replace(page, asked=replace(page.asked, tools=ToolTable.diameters({1: 0.5})))
    first = page.hearing(page.asked.answer())
    assert isinstance(first, ProofPage)
    assert first.told.proof.run.stretches
    assert not first.told.proof.results
    desk = replace(Desk(Session.of(empty_program())), pages=(first,))
    assert "not known yet: being judged" in "\n".join(Operator(desk).screen())
    rest = first.question
    assert rest is first.told.rest is not None
    second = first.hearing(rest.answer())
    assert isinstance(second, ProofPage)
    assert second.question is None
    assert second.told.answer.outcome.startswith("gouges by 0.1045")
    assert not first.told.answer.outcome.startswith("gouges")


def test_a_long_program_is_walked_through_quickly() -> None:
    text = b"G20 G90 G1 F5\n" + b"".join(b"X%d Y%d\n" % (index, index % 7) for index in range(100_000))
    page = ProofPage.of(Listing.read(text), control="linuxcnc")
    desk = replace(Desk(Session.of(empty_program())), pages=(page,))
    for key in ("pagedown", "end", "up", "home"):
        desk = desk.press(key)
        assert len(Operator(desk).screen()) == 24
    assert not page.asked.small
