"""NC PROOF: keys go in; the listing, the verdict and the file come out."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from threading import Event
from time import sleep
from typing import Any

import pytest
from textual.events import MouseScrollUp
from textual.widgets import Input, Label, OptionList, Static

from app.app import CutcompApp
from app.documents.document_service import DocumentService, Opened
from app.documents.files import load
from app.documents.nc_text import NcText
from app.documents.programs import example
from app.file_actions import session_of
from app.nc_proof.compare_controls import CompareControls
from app.nc_proof.listing import Listing
from app.nc_proof.runs import Result, RunRequest, first_tool, header_tools, likely_control, read_tools, run
from app.nc_proof.screen import ProofScreen, read_tool
from app.screens.base import OpeningScreen
from app.screens.dialogs import Question
from app.screens.home import HomeScreen
from app.session.work import Work
from app.widgets.drawing import Drawing
from app.widgets.status import Status
from core.controls.control_tools import CutterTool
from core.controls.write.written_program import Posted
from core.draw.scene import Style
from core.finding import Severity
from core.pipeline.checking import CheckRequest
from core.pipeline.derive import derive
from core.pipeline.nc_proof import cutter_at_line
from core.pipeline.post import post_control_program
from core.progress import Progress
from core.units import Unit
from tests.app.documents.typist import ELSEWHERE
from tests.app.test_file_actions import DEAD
from tests.app.widget_pilot import SURROUNDINGS, Operator

PROGRAM = b"G20 G17 F10\r\nG1 X0 Y-1\nG42 D1 X1 Y1;\nX3\nY3\nG40 X0\nM2\n"


class Proof(Operator):
    """An operator at NC PROOF."""

    calculating = ("proof", "dotted", "compare", "derive", "table", "drawing")

    @property
    def proof(self) -> ProofScreen:
        assert isinstance(self.app.screen, ProofScreen)
        return self.app.screen

    @property
    def outcome(self) -> str:
        return str(self.proof.query_one("#proof-outcome", Static).content)

    @property
    def line(self) -> int:
        return self.proof.query_one(Listing).row + 1

    def findings(self) -> list[str]:
        options = self.proof.query_one("#proof-findings", OptionList)
        return [str(options.get_option_at_index(row).prompt) for row in range(options.option_count)]


def drawn(user: Proof, name: str) -> set[Style]:
    """The styles in a drawing as displayed."""
    picture = user.proof.query_one(f"#{name}", Drawing).drawn
    assert picture is not None
    return {Style(number) for number in picture.picture.styles.ravel().tolist()}


@asynccontextmanager
async def at_proof(
    tmp_path, data: bytes = PROGRAM, check_request: CheckRequest | None = None, size: tuple[int, int] = (80, 24)
) -> AsyncIterator[Proof]:
    (tmp_path / "p.nc").write_bytes(data)
    service = DocumentService(state=tmp_path / "own")
    opening = service.open(tmp_path / "p.nc")
    assert isinstance(opening, Opened)
    session = session_of(service.new().document)
    app = CutcompApp(session, surroundings=SURROUNDINGS, service=service, opened=opening, check_request=check_request)
    async with Proof.of(app, size) as user:
        yield user
        await user.settle()
    service.stop()


async def with_tool(user: Proof, text: str = "1=.25") -> None:
    await user.press("t")
    await user.send(*text)
    await user.press("enter")


async def test_an_unknown_tool_stops_the_control_until_its_diameter_is_typed(tmp_path):
    async with at_proof(tmp_path) as user:
        assert user.outcome == "✖ ALARM line 3: tool 1 not in table. T adds it."
        assert " T gives tool 1 its diameter." in user.proof.result.answer.stop.text
        await user.press("n")
        assert user.prompt.endswith(" T gives tool 1 its diameter.")
        await with_tool(user)
        assert "gouges by 0.1250" in user.outcome
        assert "1=0.25" in str(user.proof.query_one("#proof-tools", Label).content)
        await with_tool(user, "1=.251")
        assert "gouges by 0.1255" in user.outcome


async def test_an_nc_text_opens_over_no_form_that_could_be_typed_into(tmp_path, monkeypatch):
    in_front = []
    ready = CutcompApp.on_ready

    def on_ready(app: CutcompApp) -> None:
        in_front.append((type(app.screen), app.focused))
        ready(app)

    monkeypatch.setattr(CutcompApp, "on_ready", on_ready)
    async with at_proof(tmp_path) as user:
        assert user.screen is user.proof
    assert in_front == [(OpeningScreen, None)]


async def test_the_findings_name_the_largest_tool_that_fits(tmp_path):
    """The slot is 0.4 wide and open at the top."""
    slot = (
        b"G20 G90 G40 F20.\nG0 X-1. Y-1.\nT1 M6\nG41 D1 G1 X0. Y0.\nY2.\nX.3\nY1.\nX.7\nY2.\nX2.\nY0.\nX-.5\nG40 X-1.\n"
    )
    advice = "Tool 1 is too big; the largest that does not gouge: 0.3999."
    async with at_proof(tmp_path, slot) as user:
        await with_tool(user, "1=.5")
        fault, fits = user.findings()[-2:]
        assert fault.startswith("✖ 9: The cutter does not fit")
        assert fits == f"i 9: {advice}"
        await with_tool(user, "1=.3999")
        assert not any("too big" in finding for finding in user.findings())


async def test_page_keys_do_nothing_when_the_findings_have_no_room(tmp_path):
    async with at_proof(tmp_path) as user:
        await user.pilot.resize_terminal(20, 5)
        await user.press("tab")
        await with_tool(user)
        await user.press("pagedown", "pageup")
        assert "gouges by 0.1250" in user.outcome


async def test_the_listing_takes_no_keys_while_the_drawing_hides_it(tmp_path):
    """A closing dialog does not return the focus to the hidden listing; F7 shows the listing again."""
    async with at_proof(tmp_path) as user:
        listing = user.proof.query_one(Listing)
        await user.press("enter", "f7")
        assert listing.read_only
        await with_tool(user)
        await user.press("tab", "x", "down")
        assert (user.app.focused, user.line) == (None, 1)
        await user.press("f7")
        assert user.app.focused is listing
        await user.press("f7", "f1", "'N1 ")
        assert listing.document.get_line(0).startswith("N1 G20")
        assert listing.region


async def test_next_finding_brings_its_place_into_an_enlarged_drawing(tmp_path):
    async with at_proof(tmp_path) as user:
        await with_tool(user)
        await user.press("f7", "+", "+")
        for _ in range(2):
            before = user.line
            await user.press("n")
            assert user.line != before
            assert user.proof.window_view is not None
            assert user.proof.window_view.center == cutter_at_line(user.proof.result.proof, user.line)[0]


async def test_the_wheel_zooms_about_the_cutter(tmp_path):
    async with at_proof(tmp_path) as user:
        await with_tool(user)
        await user.press("down", "down")
        drawing = user.proof.query_one("#proof-drawing", Drawing)
        cutter = cutter_at_line(user.proof.result.proof, user.line)[0]
        before = drawing.drawn.view.cell(cutter, *drawing.size)
        x, y, *_ = drawing.content_region
        user.app.post_message(MouseScrollUp(None, x, y, 0, 0, 0, False, False, False))
        await user.settle()
        assert user.proof.window_view == drawing.subject.view
        assert user.proof.window_view.cell(cutter, *drawing.size) == pytest.approx(before)
        await user.press("0")
        assert user.proof.window_view is drawing.subject.view is None


async def test_the_new_program_beside_an_nc_text_can_be_saved(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    async with at_proof(tmp_path) as user:
        (tmp_path / "a.nc").write_bytes(PROGRAM)
        await user.press("f8")
        assert isinstance(user.app.screen, HomeScreen)
        assert user.app.screen.chosen.path == tmp_path / "p.nc"
        await user.press("escape", "ctrl+s", "'new", "enter")
        assert [file.suffix for file in tmp_path.glob("new*")] == [".toml"]
        assert not user.app.document.unsaved


async def test_n_and_p_step_through_the_findings_from_the_gravest_one(tmp_path):
    async with at_proof(tmp_path) as user:
        await with_tool(user)
        options = user.proof.query_one("#proof-findings", OptionList)
        lines = [finding.line for finding in user.proof.result_findings]
        weights = [finding.severity for finding in user.proof.result_findings]
        assert lines == [int(text.split()[1].rstrip(":")) for text in user.findings()]
        assert weights[0] is not Severity.ERROR
        assert options.highlighted == weights.index(Severity.ERROR)
        await user.press("n")
        assert user.line == lines[0]
        assert user.findings()[0].endswith(f"{lines[0]}: {user.prompt}")
        await user.press("n", "p")
        assert user.line == lines[0]
        await user.press("p")
        assert user.prompt == "No earlier finding."
        await with_tool(user, "1=.251")
        assert user.line == lines[options.highlighted], "the chosen one stays highlighted after another run"


async def test_enter_on_a_finding_goes_to_its_line_and_f10_to_the_findings_and_back(tmp_path):
    async with at_proof(tmp_path) as user:
        await with_tool(user)
        await user.press("f10")
        assert user.app.focused is not None
        assert user.app.focused.id == "proof-findings"
        await user.press("home", "enter")
        assert isinstance(user.app.focused, Listing)
        assert user.line == user.proof.result_findings[0].line
        await user.press("f10", "f10")
        assert isinstance(user.app.focused, Listing)


async def test_a_listing_that_somebody_else_has_open_is_not_edited(tmp_path):
    theirs = DocumentService(state=tmp_path / "theirs", me=ELSEWHERE)
    (tmp_path / "p.nc").write_bytes(PROGRAM)
    assert isinstance(theirs.open(tmp_path / "p.nc"), Opened)
    async with at_proof(tmp_path) as user:
        await user.press("escape", "enter")
        assert user.prompt == "Somebody else has this file open. SAVE AS (Ctrl+K) makes a copy of your own."
        await user.press("x", "down")
        assert user.proof.document.text.data == PROGRAM
    theirs.stop()


async def test_letters_change_nothing_until_the_listing_is_edited(tmp_path):
    async with at_proof(tmp_path) as user:
        title, name = user.proof.query_one("#proof-mode", Label), user.proof.query_one("#proof-file", Label)
        await user.press("x", "y")
        assert not user.proof.document.unsaved
        assert (str(title.content), str(name.content)) == ("NC PROOF", "p.nc")
        await user.press("n", "enter")
        assert (str(title.content), str(name.content)) == ("NC EDIT", "p.nc")
        assert user.prompt.startswith("Editing.")
        await user.press("x")
        assert str(name.content) == "p.nc *", "the name marks a line being typed as unsaved"
        assert "not saved" in str(user.proof.query_one(Status).query_one("#undo", Label).content)
        await user.press("backspace")
        assert str(name.content) == "p.nc"
        await user.press("escape")
        assert str(title.content) == "NC PROOF"
        await user.press(*["up"] * 6, "enter", "x")
        assert not user.proof.document.unsaved
        await user.press("down")
        assert user.proof.document.text.text(0) == "xG20 G17 F10"
        await user.press("ctrl+z")
        assert user.proof.document.text.data == PROGRAM
        await user.press("ctrl+y", "escape", "ctrl+s")
        assert (tmp_path / "p.nc").read_bytes() == b"x" + PROGRAM


async def test_undo_takes_back_only_the_line_being_typed(tmp_path):
    async with at_proof(tmp_path, b"G21\nG0 X1\nM2\n") as user:
        await user.press("enter", "a", "down", "home", "b")
        await user.press("ctrl+z")
        assert user.proof.document.text.data == b"aG21\nG0 X1\nM2\n"
        await user.press("ctrl+z")
        assert user.proof.document.text.data == b"G21\nG0 X1\nM2\n"
        await user.press("ctrl+y", "ctrl+y", "ctrl+y")
        assert user.proof.document.text.data == b"aG21\nbG0 X1\nM2\n"
        assert user.prompt == "There is nothing to redo."


async def test_an_edited_line_is_journaled_when_the_cursor_leaves_it(tmp_path):
    async with at_proof(tmp_path) as user:
        await user.press("enter", "x", "down")
        assert (tmp_path / ".p.nc.cutcomp-journal").exists()
        await user.press("escape", "f8")
        assert isinstance(user.app.screen, Question)
        await user.press("d")
        assert not isinstance(user.app.screen, ProofScreen)
        assert (tmp_path / "p.nc").read_bytes() == PROGRAM
        assert not (tmp_path / ".p.nc.cutcomp-journal").exists()


async def test_a_posted_program_opens_with_the_control_and_the_tools_of_its_header(tmp_path):
    plate = derive(load(example("plate-mm")))
    async with at_proof(tmp_path) as user:
        for control in ("fanuc:a", "haas:a", "klartext", "nine-series:b", "rosettacnc:normal"):
            posted = post_control_program(plate, name="plate", control=control)
            assert isinstance(posted, Posted), posted
            path = tmp_path / f"{control.partition(':')[0]}.nc"
            path.write_bytes(posted.text.encode())
            user.app.open_file(path)
            await user.settle()
            assert user.proof.request.control == control
            assert "runs" in user.outcome, control
            assert user.app.settings.tools_of(path) == "", control
            if control != "klartext":
                assert user.prompt.endswith("It has the tools that its header names."), control


def test_tools_in_the_comments_of_another_program_are_not_taken_for_a_header():
    comments = b"(UNITS INCH)\n(TOOL 1 DIAMETER 0.5000: THE SAME)\n"
    assert not header_tools(NcText.read(b"O1\n" + comments))
    ours = b"(WRITTEN BY CUTCOMP FOR fanuc:b: THE CONTOUR)\n" + comments
    assert header_tools(NcText.read(ours)) == {1: CutterTool(1, 0.5, unit=Unit.IN)}


async def test_tools_of_the_last_time_come_before_those_of_the_header(tmp_path):
    posted = post_control_program(derive(load(example("overrun-square"))), name="square", control="fanuc:a")
    assert isinstance(posted, Posted), posted
    async with at_proof(tmp_path, posted.text.encode()) as user:
        assert user.proof.request.tools.get(1) == CutterTool(1, 0.5, unit=Unit.IN)
        await with_tool(user, "1=.625")
        await with_tool(user, "2=6mm")
        saved_tools = user.app.settings.tools_of(tmp_path / "p.nc")
        assert saved_tools == "1=0.625in 2=0.23622047244094488in"
        await user.press("f8")
        user.app.open_file(tmp_path / "p.nc")
        await user.settle()
        assert user.proof.request.tools == read_tools(saved_tools)
        assert user.proof.request.tools.get(1) == CutterTool(1, 0.625, unit=Unit.IN)
        assert "last time" in user.prompt


def test_damaged_tools_of_the_last_time_are_left_out():
    assert read_tools("1=..5in 0=x 2=5 3=-5e-1in x") == {3: CutterTool(3, -0.5, unit=Unit.IN)}


async def test_a_letter_jumps_to_the_control_whose_name_begins_with_it(tmp_path):
    async with at_proof(tmp_path) as user:
        assert user.proof.request.control == "linuxcnc"
        for letters, control in (("hh", "haas:a"), ("fanuc:b", "fanuc:b"), ("tx", "threeblock")):
            await user.press("c", *letters, "enter")
            assert user.proof.request.control == control
        assert user.app.settings.control == "threeblock"


async def test_letters_that_begin_no_control_are_said_to(tmp_path):
    async with at_proof(tmp_path) as user:
        await user.press("c", "q")
        box = user.app.screen.query_one("#question")
        assert box.border_subtitle == "No line begins with Q"
        await user.press("h")
        assert box.border_subtitle == ""
        await user.press("a", "x")
        assert box.border_subtitle == "No line begins with HAX"
        await user.press("down")
        assert box.border_subtitle == ""


def test_the_last_chosen_control_is_used_for_the_next_program():
    text = NcText.read(PROGRAM)
    assert likely_control(text, "threeblock") == "threeblock"
    assert likely_control(text, "klartext") == likely_control(text, "of no shop") == "linuxcnc"
    assert likely_control(NcText.read(b"BEGIN PGM A MM\n"), "threeblock") == "klartext"


async def test_all_controls_are_compared_and_one_can_be_chosen(tmp_path):
    async with at_proof(tmp_path) as user:
        await with_tool(user)
        await user.press("v")
        assert isinstance(user.app.screen, CompareControls)
        await user.settle()
        rows = user.app.screen.query_one("#compared", OptionList)
        assert rows.option_count >= 8
        assert rows.get_option_at_index(0).id == "linuxcnc"
        prompts = {option.id: str(option.prompt) for option in rows.options}
        wrapped = [line for prompt in prompts.values() for line in prompt.split("\n")[1:]]
        assert wrapped
        assert all(line.startswith("    ") and len(line) <= rows.size.width for line in wrapped)
        prompts = {control: " ".join(prompt.split()) for control, prompt in prompts.items()}
        assert any("differs from linuxcnc" in prompt for prompt in prompts.values())
        assert "Write T and the number." in prompts["threeblock"]
        assert not any("On the command line" in prompt for prompt in prompts.values())
        chosen = rows.get_option_at_index(1).id
        await user.press("down", "enter")
        assert user.proof.request.control == chosen


async def dot(user: Proof, control: str) -> None:
    """Draw the path of a control dotted, chosen in the list that V opens."""
    await user.press("v")
    rows = user.app.screen.query_one("#compared", OptionList)
    rows.highlighted = rows.get_option_index(control)
    await user.press("space")


async def test_the_path_of_another_control_is_drawn_dotted(tmp_path):
    async with at_proof(tmp_path) as user:
        await with_tool(user, "1=.75")
        for size in ((80, 24), (200, 60)):
            await user.pilot.resize_terminal(*size)
            await user.settle()
            result = user.proof.result
            await dot(user, "fanuc:a")
            assert user.proof.result is result, "its own run is not made again"
            assert user.prompt == "Dotted: fanuc:a gouges by 0.3750 at line 6. B removes it."
            assert str(user.proof.query_one("#proof-control", Label).content) == "linuxcnc, dotted fanuc:a"
            assert Style.UNTAKEN in drawn(user, "proof-drawing")
            dotted = user.proof.query_one("#proof-dotted", Drawing)
            assert bool(dotted.region) == (size == (200, 60))
            if dotted.region:
                assert Style.UNTAKEN not in drawn(user, "proof-dotted")
                assert dotted.heading == "fanuc:a: gouges by 0.3750 at line 6"
            await user.press("b")
            assert user.proof.result is result
            assert str(user.proof.query_one("#proof-control", Label).content) == "linuxcnc"
            assert Style.UNTAKEN not in drawn(user, "proof-drawing")
            assert not user.proof.query_one("#proof-dotted", Drawing).region
            assert not user.prompt.startswith("Dotted:"), "the sentence goes with the path"


async def test_the_dotted_path_follows_text_tool_and_control(tmp_path):
    async with at_proof(tmp_path) as user:
        await with_tool(user, "1=.75")
        await dot(user, "fanuc:a")

        def dotted_end() -> tuple[str, list[float]]:
            assert user.proof.dotted is not None
            result = user.proof.dotted
            return result.request.control, result.proof.run.moves.points.max(axis=0).round(3).tolist()[:2]

        assert dotted_end() == ("fanuc:a", [85.725, 76.2])
        await with_tool(user, "1=.25")
        assert dotted_end() == ("fanuc:a", [79.375, 76.2])
        for _ in range(4):
            await user.press("down")
        await user.press("enter", "end", "backspace", "5", "escape")
        assert dotted_end() == ("fanuc:a", [79.375, 127.0])
        await dot(user, "haas:a")
        assert dotted_end()[0] == "haas:a"
        user.proof.query_one(Listing).focus()
        await dot(user, "linuxcnc")
        assert "already" in user.prompt
        await user.press("c")
        user.app.screen.query_one("#answers", OptionList).highlighted = 0
        await user.press("enter")
        assert user.app._works == ()


async def test_stopping_the_dotted_run_leaves_the_verdict_unchanged(tmp_path, monkeypatch):
    async with at_proof(tmp_path) as user:
        await with_tool(user, "1=.75")
        before, started = user.outcome, Event()

        def endless(*arguments: Any) -> Result:
            started.set()
            while True:
                arguments[-1](0.5)
                sleep(0.001)

        monkeypatch.setattr("app.nc_proof.runs.run_dotted", endless)
        monkeypatch.setattr(Work, "stoppable", True)
        await user.press("v")
        # not user.press: it would wait for the endless run
        await user.pilot.press("down", "space")
        while not started.is_set():
            await user.pilot.pause(0.02)
        await user.pilot.press("escape")
        await user.settle()
        assert user.outcome == before
        assert "Stopped" in user.prompt
        assert str(user.proof.query_one("#proof-control", Label).content) == "linuxcnc"
        assert user.app._works == ()


async def test_a_control_of_another_language_draws_no_dotted_path(tmp_path):
    async with at_proof(tmp_path) as user:
        await with_tool(user)
        await dot(user, "klartext")
        assert isinstance(user.app.screen, CompareControls)
        assert "another language" in str(user.app.screen.query_one("#compare-wait", Static).content)
        await user.press("escape", "b")
        assert "draws its path dotted" in user.prompt


async def test_the_tool_dialog_asks_for_the_tool_that_the_control_lacks(tmp_path):
    text = b"(BRACKET 4417)\nG20 G17 F10\nT2 M6\nG1 X0 Y-1\nG42 D5 X1 Y1\nX3\nY3\nG40 X0\nM2\n"
    async with at_proof(tmp_path, text) as user:
        assert first_tool(user.proof.document.text) == 2
        await with_tool(user, "2")
        (trouble,) = user.app.screen.query("#phrase-trouble").results(Static)
        assert str(trouble.content) == "2 is the number of the tool. For a diameter of 2, type 2=2."
        await user.press("escape")
        await with_tool(user, ".25")
        assert user.proof.request.tools.get(2) == CutterTool(2, 0.25, unit=Unit.IN)
        await user.press("t")
        assert "5=.5" in str(user.app.screen.query_one("#loss", Static).content)
        await user.press(*"x", "enter")
        assert "type a number" in str(user.app.screen.query_one("#phrase-trouble", Static).content)
        await user.press("backspace", *".25", "enter")
        assert user.proof.request.tools.get(5) == CutterTool(5, 0.25, unit=Unit.IN)
        assert user.prompt == "Tool 5: diameter 0.25 IN."
        await user.press("t", *"5=", "enter")
        assert list(user.proof.request.tools) == [2]
        assert user.app.settings.tools_of(tmp_path / "p.nc") == "2=0.25in"


async def test_a_diameter_is_in_the_unit_that_the_program_names_below_the_line_where_it_stops(tmp_path):
    async with at_proof(tmp_path, b"T1 M6\nG20 G17 F10\nG1 X0 Y-1\nM2\n") as user:
        await user.press("t")
        assert "Tool and diameter in IN" in str(user.app.screen.query_one("#loss", Static).content)
        await user.press(*".5", "enter")
        assert user.proof.request.tools.get(1) == CutterTool(1, 0.5, unit=Unit.IN)


async def test_a_klartext_tool_gets_its_diameter_by_name(tmp_path):
    text = (
        b'0 BEGIN PGM A MM\n1 TOOL CALL "Rough D10" Z S3000 F500\n2 L X-20 Y-20 Z-5 R0 FMAX\n'
        b"3 L X+0 Y+0 RL F300\n4 L Y+50\n5 L X+50\n6 L X+70 Y+50 R0\n7 END PGM A MM\n"
    )
    async with at_proof(tmp_path, text) as user:
        await with_tool(user, "10")
        assert user.proof.request.tools == {"ROUGH D10": CutterTool("ROUGH D10", 10.0, unit=Unit.MM)}
        assert user.prompt == "Tool ROUGH D10: diameter 10 MM."
        assert user.proof.result.answer.stopped_at is None
        saved_tools = user.app.settings.tools_of(tmp_path / "p.nc")
        assert read_tools(saved_tools) == user.proof.request.tools
        await with_tool(user, "rough d10=12")
        assert user.proof.request.tools.get("ROUGH D10").diameter == 12.0
        await with_tool(user, "Rough D10=")
        assert not user.proof.request.tools
        assert user.proof.result.answer.missing == "ROUGH D10"


async def test_a_diameter_is_shown_with_its_unit_when_the_program_uses_another(tmp_path):
    async with at_proof(tmp_path) as user:
        await with_tool(user, "1=.25")
        tools = user.proof.query_one("#proof-tools", Label)
        assert str(tools.content) == "tools 1=0.25"
        await user.press("enter", "home", "right", "right", "backspace", "1", "down")
        assert user.proof.unit is Unit.MM
        assert str(tools.content) == "tools 1=0.25in"


async def test_a_new_name_without_a_suffix_takes_the_suffix_of_the_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    async with at_proof(tmp_path) as user:
        await user.app.run_action("app.save_as")
        await user.settle()
        user.app.screen.query_one("#entry", Input).value = "other"
        await user.press("enter")
        assert (tmp_path / "other.nc").read_bytes() == PROGRAM


async def test_home_over_an_nc_text_shows_its_folder_and_esc_there_opens_no_empty_form(tmp_path, monkeypatch):
    monkeypatch.chdir("/")
    async with at_proof(tmp_path) as user:
        await user.press("ctrl+o")
        assert isinstance(user.app.screen, HomeScreen)
        assert user.app.screen.folder == tmp_path
        await user.press("escape")
        assert isinstance(user.app.screen, ProofScreen)
        await user.press("escape", "escape")
        assert isinstance(user.app.screen, HomeScreen)
        assert "F2 and F3 start a new part" in user.prompt


async def test_a_save_while_the_program_runs_keeps_the_run(tmp_path, monkeypatch):
    go_on = Event()

    def late(request: RunRequest, progress: Progress) -> Result:
        assert go_on.wait(20.0)
        return run(request, progress)

    async with at_proof(tmp_path) as user:
        await with_tool(user)
        monkeypatch.setattr("app.nc_proof.runs.run", late)
        await user.pilot.press("enter", "end", "(", "a", ")", "ctrl+s")
        while b"(a)" not in (tmp_path / "p.nc").read_bytes() or user.proof.document.unsaved:
            await user.pilot.pause(0.02)
        assert user.outcome.endswith("...")
        go_on.set()
        await user.settle()
        assert not user.outcome.endswith("...")
        assert user.proof.result is not None
        assert user.proof.result.request.text.text(0).endswith("(a)")
        assert user.app._works == ()


@pytest.mark.parametrize(
    ("text", "tool"),
    [
        ("2=.5", CutterTool(2, 0.5, unit=Unit.IN)),
        (".5", CutterTool(1, 0.5, unit=Unit.IN)),
        ("3=12.7mm", CutterTool(3, 0.5, unit=Unit.IN)),
    ],
)
def test_a_tool_is_read_with_its_number_or_as_a_diameter_alone(text, tool):
    assert read_tool(text, 1, Unit.IN) == tool


def test_an_unreadable_diameter_is_explained_in_a_sentence():
    assert read_tool("2=abc", 1, Unit.IN).reason.startswith("abc is not a number")


async def test_subprograms_are_found_in_the_folder_of_the_file(tmp_path):
    (tmp_path / "O0007.nc").write_text("O7\nG1 X5. F100.\nM99\n")
    check_request = CheckRequest("fanuc:a", {}, shop=False, unit=None)
    async with at_proof(tmp_path, b"%\nO1\nG21 G90 G0 X0 Y0\nM98 P7\nM30\n%\n", check_request) as user:
        assert "runs" in user.outcome
        assert user.proof.result is not None
        assert user.proof.result.proof.run.moves.points[-1, 0] == 5.0


async def test_the_status_line_describes_the_nc_text(tmp_path):
    async with at_proof(tmp_path, b"G21\nG0 X1\nM2\n") as user:
        status = user.proof.query_one(Status)
        assert "Prog Units: MM" in str(status.query_one("#units", Label).content)
        await user.press("question_mark")
        on_help = user.app.screen.query_one(Status)
        assert "Prog Units: MM" in str(on_help.query_one("#units", Label).content)
        await user.press("escape")
        await user.press("enter", "x", "down", "escape")
        assert str(status.query_one("#undo", Label).content) == "not saved   undo 1"
        await user.press("ctrl+z", "ctrl+y")
        assert str(status.query_one("#undo", Label).content) == "not saved   undo 1"
        await user.press("ctrl+z")
        assert str(status.query_one("#undo", Label).content) == "saved   redo 1"


async def test_the_cursor_line_stays_in_view_when_the_terminal_shrinks(tmp_path):
    async with at_proof(tmp_path, b"G21\n" + b"G0 X1\n" * 10 + b"M2\n") as user:
        await user.press(*("down",) * 11)
        listing = user.proof.query_one(Listing)
        assert listing.scroll_y == 0
        await user.pilot.resize_terminal(60, 20)
        await user.settle()
        assert listing.scroll_y <= user.line - 1 < listing.scroll_y + listing.scrollable_content_region.height


async def test_left_over_work_is_restored_into_the_same_screen_and_can_be_saved(tmp_path):
    (tmp_path / "p.nc").write_bytes(PROGRAM)
    dead = DocumentService(state=tmp_path / "own", me=DEAD)
    opened = dead.open(tmp_path / "p.nc")
    assert isinstance(opened, Opened)
    text = opened.document.text
    dead.keep(opened.document.edited(text.with_texts(["(LEFT)", *text.texts[1:]]), 0))
    dead.stop()
    async with at_proof(tmp_path) as user:
        assert isinstance(user.app.screen, Question)
        await user.press("r")
        assert len(user.app.proofs) == 1
        assert user.proof.query_one(Listing).document.get_line(0) == "(LEFT)"
        await user.press("ctrl+s")
        assert (tmp_path / "p.nc").read_bytes().startswith(b"(LEFT)\r\n")
        await user.press("f8")
        assert isinstance(user.app.screen, HomeScreen)


async def test_the_tool_dialog_quotes_the_diameter_from_a_comment(tmp_path):
    async with at_proof(tmp_path, b"G20 F10\n(TOOL 1 END MILL DIAMETER 0.5000)\nG42 D1 X1 Y1\nX3\nM2\n") as user:
        await user.press("t")
        lines = user.app.screen.query_one("#loss", Static)
        assert "The comment in line 2 says diameter 0.5000." in str(lines.content)
        await user.press("escape")


@pytest.mark.parametrize("typed", ["1=.25", ".25"])
async def test_a_typed_diameter_is_compared_with_that_in_a_comment(tmp_path, typed: str):
    async with at_proof(tmp_path, b"G20 F10\n(TOOL 1 END MILL DIAMETER 0.5000)\nT1 M6\nG1 X1 Y1\nX3\nM2\n") as user:
        await with_tool(user, typed)
        assert user.prompt == "Tool 1: diameter 0.25 IN. The comment in line 2 says diameter 0.5000."
        assert user.proof.query_one("#prompt").has_class("-warning")
        await with_tool(user, "12.7mm")
        assert user.prompt == "Tool 1: diameter 0.5 IN."


async def test_an_alarm_after_a_gouge_is_read_in_full_beside_the_tools(tmp_path):
    async with at_proof(tmp_path, PROGRAM.replace(b"M2\n", b"T9 M6\nM2\n")) as user:
        await with_tool(user, "1=.25")
        await with_tool(user, "51=10.6mm")
        assert user.outcome.startswith("gouges by 0.1250 at line 6, then alarms at line 7 (")
        outcome = user.proof.query_one("#proof-outcome", Static)
        assert len("gouges by 0.1250 at line 6, then alarms at line 7") <= outcome.content_region.width


async def test_a_warning_that_a_diameter_brings_is_highlighted_before_the_information_on_its_line(tmp_path):
    text = b"G21 F100.\nT1 M6\nG0 X-20. Y0.\nG41 D2 G1 X0. Y0.\nY40.\nX40.\nG40 X60.\nM2\n"
    async with at_proof(tmp_path, text, CheckRequest("fanuc:a", {}, False, None)) as user:
        await with_tool(user, "1=10")
        await with_tool(user, "2=10")
        await user.press("n")
        findings = user.proof.query_one("#proof-findings", OptionList)
        assert user.findings()[findings.highlighted or 0].startswith("i 4:")
        await with_tool(user, "1=14")
        assert user.findings()[findings.highlighted or 0].startswith("▲ 4: D2 has the radius 5.000, tool 1 has 7.000")
