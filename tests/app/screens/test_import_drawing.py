"""IMPORT by keys: a drawing's contours are listed, changed, marked and taken as blocks in one edit."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from itertools import pairwise
from math import cos, dist, pi, sin
from pathlib import Path

import pytest
from ezdxf.filemanagement import new as new_drawing
from textual.widgets import DataTable, Label, Static

from app.app import CutcompApp
from app.documents import drawing_files
from app.documents.document_service import DocumentService
from app.documents.programs import empty_program
from app.documents.settings import Settings, SettingsFile
from app.file_actions import session_of
from app.screens.dialogs import ChooseSeveral, NumberForm, Question
from app.screens.import_drawing import ImportScreen
from app.session.messages import Tone
from app.session.session import Session
from app.widgets.contour_table import ContourTable
from app.widgets.status import Prompt
from core.importing.contour import Contour
from core.importing.contours import ContourList
from core.program.edit import FormPlace
from core.program.file.write import dumps
from core.program.model import CutterComp, Number
from core.units import Unit
from tests.app.widget_pilot import SURROUNDINGS, Operator
from tests.core.importing.drawings import circle, circle_of_lines, dxf, line, square

DATA = Path(__file__).parents[2] / "data" / "dxf"


class InlineWorker:
    """Does a worker's work in this process: starting a process for each test would take most of the time."""

    def __init__(self, function: Callable[..., object], *arguments: object) -> None:
        self.function, self.arguments = function, arguments

    def poll(self, _wait: float = 0.0) -> object:
        return self.function(*self.arguments, progress=lambda *_: None)

    def cancel(self) -> None:
        pass


REAL_WORKER = drawing_files.Worker


@pytest.fixture(autouse=True)
def in_this_process(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.screens.import_drawing.Worker", InlineWorker)


class Importer(Operator):
    """An operator at IMPORT."""

    @property
    def importing(self) -> ImportScreen:
        return next(screen for screen in self.app.screen_stack if isinstance(screen, ImportScreen))

    @property
    def contour(self) -> Contour:
        assert self.importing.contour is not None
        return self.importing.contour

    async def ready(self) -> None:
        """Wait until the drawing is listed, refused, or something is asked."""
        for _ in range(400):
            await self.pilot.pause(0.01)
            at_rest = not isinstance(self.app.screen, ImportScreen) or not self.app.screen._working
            if at_rest and (self.app.screen is not self.importing or self.importing.notice or self.importing.listed):
                break
        await self.settle()

    async def show(self, path: Path, *, fresh: bool = False) -> None:
        """Open a drawing and wait until it is listed, refused, or something is asked."""
        self.app.show_drawing(path, fresh=fresh)
        await self.pilot.pause()
        await self.ready()

    async def left(self) -> None:
        """Wait until the form is in front."""
        await self.until(lambda: type(self.app.screen).__name__ == "ContourScreen")

    async def until(self, condition: Callable[[], object]) -> None:
        for _ in range(400):
            if condition():
                await self.settle()
                return
            await self.pilot.pause(0.01)
        raise AssertionError(self.app.screen)

    async def taken(self) -> None:
        """Wait until the first block has segments."""
        await self.until(lambda: self.session.program.blocks[0].segments)

    @property
    def question(self) -> Question:
        assert isinstance(self.app.screen, Question)
        return self.app.screen

    @property
    def rows(self) -> list[list[str]]:
        table = self.importing.query_one(ContourTable)
        return [[cell.plain.strip() for cell in table.get_row_at(row)] for row in range(table.row_count)]

    @property
    def message(self) -> str:
        prompt = self.importing.query_one(Prompt)
        return f"{prompt.sentence.tone}: {prompt.sentence.text}"

    @property
    def about(self) -> str:
        return str(self.importing.query_one("#import-about").render())


@asynccontextmanager
async def importer(source: Path | bytes, tmp_path: Path, *, unit: Unit = Unit.MM) -> AsyncIterator[Importer]:
    """An operator who has opened a drawing over an empty program."""
    path = source if isinstance(source, Path) else tmp_path / "part.dxf"
    if isinstance(source, bytes):
        path.write_bytes(source)
    async with running(unit) as user:
        await user.show(path)
        yield user


@asynccontextmanager
async def running(unit: Unit = Unit.MM, size: tuple[int, int] = (80, 24)) -> AsyncIterator[Importer]:
    """An operator at an empty program."""
    app = CutcompApp(Session.of(empty_program(unit)), surroundings=SURROUNDINGS)
    async with Importer.of(app, size) as user:
        yield user


async def test_the_contours_are_listed_and_the_chosen_one_is_drawn(tmp_path):
    async with importer(DATA / "d14-layers.dxf", tmp_path) as user:
        assert user.rows == [
            ["1", "OUTSIDE", "0", "4", "140.000", "40.000 x 30.000"],
            ["2", "HOLE", "HOLES", "4", "100.000", "30.000 x 20.000"],
        ]
        assert "start X 20.000 Y 0.000  mid longest side  CW  LEFT" in user.about
        assert "largest gap none" in user.about
        title = str(user.importing.query_one("#import-file").render())
        assert title == "d14-layers.dxf  MM ($INSUNITS)  layers 2 of 2"
        await user.press("down")
        assert user.importing.picture.heading == "chain 2  HOLE"


async def test_the_depths_typed_in_one_block_are_taken_into_all_others(tmp_path):
    async with importer(DATA / "d14-layers.dxf", tmp_path) as user:
        await user.press("space", "down", "space", "enter")
        await user.taken()
        await user.left()
        for field, text in (("z_bottom", "-5"), ("plunge_feed", "100"), ("speed", "2000")):
            user.app.move(FormPlace(1), field)
            await user.settle()
            await user.press(f"'{text}", "enter")
        typed = user.session.program
        assert typed.blocks[1].z_bottom is None
        await user.press("ctrl+k", "'same values", "enter")
        await user.until(lambda: isinstance(user.app.screen, Question))
        assert "Z BOTTOM -5.000, PLUNGE FEED 100.0, SPEED (RPM) 2000" in user.question.lines[1]
        await user.press("b")
        await user.left()
        first, second = user.session.program.blocks
        assert (second.z_bottom, second.plunge_feed, second.speed) == (Number(-5.0), Number(100.0), Number(2000.0))
        assert first == typed.blocks[0]
        assert second.segments == typed.blocks[1].segments
        await user.press("ctrl+z")
        assert user.session.program == typed


@pytest.mark.parametrize(("radius", "asks"), [(4.0, False), (2.0, True)])
async def test_a_drawing_that_names_its_unit_leaves_only_a_tiny_part_in_doubt(tmp_path, radius, asks):
    """The usual tool of 12 mm is larger than this boss; whether 4 mm are meant, the drawing may not know either."""
    async with importer(dxf(circle((0.0, 0.0), radius)), tmp_path) as user:
        await user.press("enter")
        await user.taken()
        assert ("INCH or MM?" in user.prompt) == asks
        await user.press("ctrl+z")
        assert not user.app.part_is_drawn


@pytest.mark.parametrize("size", [(80, 24), (60, 20)])
async def test_a_long_name_is_cut_in_the_middle_of_the_title(tmp_path, size):
    path = tmp_path / "housing_cover_left_hand_side_final_revision_C7.dxf"
    path.write_bytes((DATA / "d14-layers.dxf").read_bytes())
    async with running(size=size) as user:
        await user.show(path)
        await user.press("space")
        title = str(user.importing.query_one("#import-file").render())
        assert title.endswith("C7.dxf  MM  layers 2 of 2  1 marked")
        assert title.startswith("housing_")
        assert len(title) <= user.importing.query_one("#import-file").size.width


async def test_marked_contours_become_blocks_in_one_undoable_edit(tmp_path):
    async with importer(DATA / "d14-layers.dxf", tmp_path) as user:
        before = user.session.program
        await user.press("f7", "n", "plus")
        assert user.importing.picture.has_focus
        assert user.contour.number == 2
        assert user.importing.picture.subject.view is not None
        await user.press("0", "space", "escape")
        assert user.importing.picture.subject.view is None
        assert user.importing.marked == {2}
        assert user.importing.table.has_focus
        await user.press("up", "space", "enter")
        await user.until(lambda: user.session.program is not before)
        assert [block.cutter_comp for block in user.session.program.blocks] == [CutterComp.LEFT, CutterComp.LEFT]
        assert user.session.history.undo_count == 1
        assert type(user.app.screen).__name__ == "ContourScreen"
        assert user.session.place == FormPlace(1)
        await user.press("ctrl+z")
        assert dumps(user.session.program) == dumps(before)


async def test_contours_are_appended_after_the_blocks_of_the_program(tmp_path):
    async with importer(DATA / "d14-layers.dxf", tmp_path) as user:
        await user.press("down", "f1")
        await user.until(lambda: len(user.session.program.blocks[0].segments))
        await user.show(DATA / "d01-square.dxf")
        await user.press("enter")
        await user.until(lambda: len(user.session.program.blocks) == 2)
        assert user.session.place == FormPlace(2)


async def test_only_a_program_begun_for_a_drawing_shows_and_takes_its_unit(tmp_path):
    square = DATA / "d01-square.dxf"
    async with importer(square, tmp_path, unit=Unit.IN) as user:
        cases = {False: ("I N C H", "5.5118", Unit.IN), True: ("M M", "140.000", Unit.MM)}
        for fresh, (label, length, unit) in cases.items():
            if fresh:
                await user.press("ctrl+z")
                await user.show(square, fresh=True)
            assert str(user.importing.query_one("#units", Label).content) == f"Prog Units:  {label}    Free: 23 GB"
            assert user.rows[0][4] == length
            await user.press("enter")
            await user.taken()
            assert user.session.program.unit is unit


async def test_a_drawing_without_a_unit_asks_for_it_and_shows_both_sizes(tmp_path):
    async with importer(DATA / "d04-nounits.dxf", tmp_path) as user:
        assert isinstance(user.app.screen, Question)
        assert "40 x 30: as IN 40.0000 x 30.0000, as MM 40.000 x 30.000" in user.question.lines[0]
        assert user.question.safe == "GO BACK"
        await user.press("escape")
        await user.left()
        await user.show(DATA / "d04-nounits.dxf")
        await user.press("i")
        await user.until(lambda: user.importing.listed)
        assert user.rows[0][4] == "3556.000"


async def test_a_damaged_file_is_taken_only_by_yes(tmp_path):
    damaged = DATA / "d19-cut-off.dxf"
    async with importer(damaged, tmp_path) as user:
        for key in ("enter", "n"):
            assert user.question.lines == ("This file breaks off at line 40: 1 entity could be read.", "Take it?")
            await user.press(key)
            await user.left()
            await user.show(damaged)
        await user.press("y")
        await user.until(lambda: user.importing.listed)
        assert "what comes after it is missing" in " ".join(user.importing.help_lines())


SLOPE = [(0, "LINE"), (8, "SLOPE"), (10, 0), (20, 0), (30, 0), (11, 1), (21, 1), (31, 9)]
UNLISTABLE: dict[str, Path | bytes] = {
    "d20-not-dxf.dxf is not a DXF file.": DATA / "d20-not-dxf.dxf",
    "in model space: 1 TEXT was skipped.": DATA / "d17-empty.dxf",
    ": 0 entities could be read.": dxf(*square(0, 0, 10))[:110],
    "gone.dxf cannot be read: there is no such file or folder. Check the name.": DATA / "gone.dxf",
    "F2 LAYERS": dxf(line((0, 0), (5, 5)), SLOPE),
}


async def test_an_unlistable_drawing_is_reported_and_the_screen_stays(tmp_path):
    path = tmp_path / "part.dxf"
    async with running(Unit.MM) as user:
        for words, source in UNLISTABLE.items():
            if isinstance(source, bytes):
                path.write_bytes(source)
            await user.show(path if isinstance(source, bytes) else source)
            assert words in user.message
            assert user.message.startswith(Tone.ERROR)
            await user.press("f1", "down")
            assert user.importing.listed is None, words
            await user.press("escape")
            await user.left()


async def test_layers_leaves_out_a_layer_that_is_not_flat(tmp_path):
    async with importer(dxf(*square(0, 0, 10), SLOPE), tmp_path) as user:
        assert "does not lie in the XY plane. F2 LAYERS leaves its layer out." in user.message
        await user.press("f2")
        assert isinstance(user.app.screen, ChooseSeveral)
        await user.press("down", "space", "enter")
        await user.until(lambda: user.importing.listed)
        assert len(user.rows) == 1


async def test_layers_without_a_contour_and_no_layer_at_all_are_told_apart(tmp_path):
    point = [(0, "POINT"), (8, "MARKS"), (10, 1), (20, 1), (30, 0)]
    async with importer(dxf(*square(0, 0, 10), line((5, 5), (5, 5), "DOTS"), point), tmp_path) as user:
        await user.press("f2", "space", "enter")
        await user.until(lambda: not user.rows)
        assert user.message == f"{Tone.WARNING}: These layers hold no contour. F2 chooses others."
        await user.press("f2", "down", "space", "enter")
        assert user.message == f"{Tone.WARNING}: No layer is marked: nothing was changed."
        await user.press("enter")
        assert not user.session.program.blocks[0].segments


async def test_a_contour_that_no_segments_can_describe_is_refused_and_the_screen_stays(tmp_path):
    bulged = [
        tag for x, turn in ((0, 1e-4), (400, 0)) for tag in ((0, "VERTEX"), (8, "0"), (10, x), (20, 0), (42, turn))
    ]
    flat = [(0, "POLYLINE"), (8, "0"), (66, 1), (70, 0), *bulged, (0, "SEQEND")]
    async with importer(dxf(flat), tmp_path) as user:
        before = user.session.program
        await user.press("enter")
        await user.until(lambda: isinstance(user.app.screen, Question))
        await user.press("l")
        await user.until(lambda: user.importing.notice)
        assert user.message.startswith(f"{Tone.ERROR}: Chain 1 has an arc of radius 1000000")
        assert user.session.program is before


async def test_too_many_entities_are_reported_with_count_and_limit(tmp_path, monkeypatch):
    monkeypatch.setattr("core.importing.dxf.MAX_ENTITIES", 3)
    async with importer(dxf(*square(0, 0, 10)), tmp_path) as user:
        assert user.message == f"{Tone.ERROR}: The drawing has 4 entities: at most 3 are read."


async def test_a_larger_tolerance_joins_an_open_chain(tmp_path):
    async with importer(DATA / "d06-gap-open.dxf", tmp_path) as user:
        assert user.rows[0][1] == "OPEN"
        assert "would join it" in user.about
        await user.press("f4")
        assert isinstance(user.app.screen, NumberForm)
        await user.press(*["backspace"] * 8, "'9", "enter")
        assert isinstance(user.app.screen, NumberForm), "more than the largest tolerance"
        await user.press("backspace", "'.", "'1", "enter", "enter")
        await user.until(lambda: user.importing.contour and user.contour.closed)
        assert user.rows[0][1] == "OUTSIDE"


async def test_an_open_chain_is_taken_only_after_a_side_is_chosen(tmp_path):
    async with importer(dxf(line((0, 0), (10, 0)), line((10, 0), (10, 10))), tmp_path) as user:
        before = user.session.program
        await user.press("enter")
        await user.until(lambda: isinstance(user.app.screen, Question))
        await user.press("enter")
        assert user.session.program is before
        await user.press("enter")
        await user.until(lambda: isinstance(user.app.screen, Question))
        await user.press("r")
        await user.until(lambda: user.session.program is not before)
        assert user.session.program.blocks[0].cutter_comp is CutterComp.RIGHT


async def test_the_branch_question_joins_a_chain_with_the_chosen_way(tmp_path):
    ends = (line((0, 0), (10, 0)), line((10, 0), (20, 5)), line((10, 0), (20, -5)))
    async with importer(dxf(*ends), tmp_path) as user:
        assert [row[1] for row in user.rows] == ["OPEN"] * 3
        assert "branch at X 10.000 Y 0.000: 2 ways. B chooses." in user.about
        await user.press("b")
        await user.until(lambda: isinstance(user.app.screen, Question))
        assert user.question.question == "branch at X 10.000 Y 0.000: 2 ways"
        await user.press("1")
        await user.until(lambda: len(user.rows) == 2)
        assert sorted(row[3] for row in user.rows) == ["1", "2"]
        await user.press("down", "b")
        await user.until(lambda: "does not end at a branch" in user.message or isinstance(user.app.screen, Question))


async def test_start_and_reverse_change_the_block(tmp_path):
    async with importer(DATA / "d01-square.dxf", tmp_path) as user:
        assert (user.contour.turn.name, user.contour.start) == ("CW", (20.0, 0.0))
        await user.press("f6")
        assert "mid longest side  CCW  RIGHT" in user.about
        await user.press("f5", "n")
        await user.until(lambda: user.contour.start != (20.0, 0.0))
        assert user.contour.start == (40.0, 0.0)
        assert "corner" in user.about
        await user.press("escape")
        await user.press("f5", "x")
        await user.until(lambda: isinstance(user.app.screen, NumberForm))
        await user.press("backspace", "'9", "enter", "backspace", "'3", "'3", "enter")
        await user.until(lambda: user.contour.start == (9.0, 30.0))
        await user.press("enter")
        await user.taken()
        block = user.session.program.blocks[0]
        assert (block.x_start.value, block.y_start.value) == (9.0, 30.0)
        assert block.cutter_comp is CutterComp.RIGHT


async def test_start_stays_open_and_repeats_its_steps_until_esc(tmp_path):
    async with importer(DATA / "d01-square.dxf", tmp_path) as user:
        await user.press("f5", "n", "n", "n")
        await user.until(lambda: user.contour.start == (40.0, 30.0))
        assert isinstance(user.app.screen, Question)
        assert "starts at X 40.000 Y 30.000" in user.question.query_one("#loss", Static).render().plain
        assert "start X 40.000 Y 30.000" in user.about
        await user.press("c", "enter")
        await user.until(lambda: user.contour.start == (0.0, 0.0))
        await user.press("s")
        await user.until(lambda: user.contour.start == (0.0, 15.0))
        await user.press("escape")
        assert isinstance(user.app.screen, ImportScreen)
        assert user.contour.start == (0.0, 15.0)


async def test_start_leaves_the_drawing_visible_and_says_what_a_step_cannot_do(tmp_path):
    async with importer(dxf(circle((0, 0), 5)), tmp_path) as user:
        await user.press("f5", "n")
        await user.until(lambda: "no corner" in user.question.query_one("#loss", Static).render().plain)
        assert user.question.query_one("#question").region.bottom <= user.importing.picture.region.y
        await user.press("escape")
    async with importer(dxf(line((0, 0), (10, 0)), line((10, 0), (10, 5))), tmp_path) as user:
        await user.press("f5", "n")
        await user.until(lambda: "is open" in user.question.query_one("#loss", Static).render().plain)


async def test_what_the_reader_says_about_a_spline_is_readable_at_80_columns(tmp_path):
    document = new_drawing()
    document.header["$INSUNITS"] = 4
    document.modelspace().add_spline([(0, 0, 0), (40, 10, 0), (60, 40, 0), (30, 60, 0)])
    document.saveas(tmp_path / "curve.dxf")
    async with importer(tmp_path / "curve.dxf", tmp_path) as user:
        told = user.importing.query_one("#import-about")
        rows = [told.render_line(row).text.strip() for row in range(told.content_size.height)]
        assert "A SPLINE has fit points only: the curve through them is calculated." in " ".join(rows)


async def test_leaving_says_that_nothing_is_taken_and_how_the_drawing_comes_back(tmp_path):
    for key in ("escape", "f8"):
        async with importer(dxf(*square(0, 0, 50)), tmp_path) as user:
            await user.press("space", key)
            said = "Nothing is taken from part.dxf. Ctrl+O opens it again."
            assert said in [each.message for each in user.app._notifications]


async def test_fit_arcs_shows_both_counts_and_restores_the_lines(tmp_path):
    async with importer(circle_of_lines(300), tmp_path) as user:
        assert user.rows[0][3] == "300"
        await user.press("f3")
        await user.until(lambda: user.rows[0][3] == "1")
        assert "300 lines -> 1 ARC, off by 0." in user.about
        turn, start = user.contour.turn, user.contour.start
        await user.press("f6", "f3")
        await user.until(lambda: user.rows[0][3] == "300")
        assert user.contour.turn == -turn
        assert dist(user.contour.start, start) < 0.01


def spline_export(count: int) -> bytes:
    """A smooth closed curve made of `count` lines."""
    turns = [2.0 * pi * step / count for step in range(count)]
    points = [((40 + 6 * cos(3 * turn)) * cos(turn), (25 + 4 * sin(2 * turn)) * sin(turn)) for turn in turns]
    return dxf(*(line(first, second) for first, second in pairwise([*points, points[0]])))


async def test_a_spline_export_of_two_thousand_lines_becomes_arcs_and_can_be_undone(tmp_path):
    async with importer(spline_export(2000), tmp_path) as user:
        before = dumps(user.session.program)
        assert user.rows[0][3] == "2000"
        await user.press("f3")
        await user.until(lambda: user.importing.unfitted)
        fitted = user.contour.fitted
        assert fitted is not None
        assert (fitted.before, len(fitted.pieces) < 150, fitted.deviation <= 0.005) == (2000, True, True)
        await user.press("enter")
        await user.taken()
        assert len(user.session.program.blocks[0].segments) <= len(fitted.pieces) + 1
        await user.press("ctrl+z")
        assert dumps(user.session.program) == before


async def test_fit_arcs_is_advised_before_more_than_five_hundred_segments_are_taken(tmp_path):
    async with importer(circle_of_lines(600), tmp_path) as user:
        await user.press("enter")
        await user.until(lambda: isinstance(user.app.screen, Question))
        assert "segments: the form shows them, the look-ahead of a control may not." in user.question.lines[0]
        await user.press("enter")
        await user.until(lambda: user.rows[0][3] == "1")
        await user.press("enter")
        await user.taken()
        assert len(user.session.program.blocks[0].segments) == 1


async def test_equal_circles_fold_into_one_row_that_opens(tmp_path):
    data = dxf(*square(0, 0, 50), *(circle((10 + 5 * k, 10), 1) for k in range(6)))
    async with importer(data, tmp_path) as user:
        assert [row[5] for row in user.rows] == ["50.000 x 50.000", "dia. 2.000 x 6"]
        await user.press("down", "right")
        assert len(user.rows) == 7
        await user.press("down", "space", "left")
        assert [row[0] for row in user.rows] == ["1", "-    2"]
        await user.press("enter")
        await user.taken()
        assert len(user.session.program.blocks) == 1


async def test_the_filter_hides_chains_that_do_not_match(tmp_path):
    async with importer(DATA / "d14-layers.dxf", tmp_path) as user:
        await user.press("slash")
        assert user.prompt.startswith("Type a part of a layer, kind, length or size.")
        await user.press("'h", "'o", "'l", "'e")
        assert [row[1] for row in user.rows] == ["HOLE"]
        await user.press("'x")
        assert user.rows == []
        assert user.prompt == "No chain has 'holex' in its layer, kind, length or size. Esc shows all."
        await user.press("enter", "up", "home", "f1", "f6", "escape", "slash", "'h", "'o", "'l", "'e")
        await user.press("enter", "space")
        assert user.importing.marked == {2}
        await user.press("escape")
        assert len(user.rows) == 2
        assert user.prompt.startswith("Space marks")


async def test_a_contour_can_be_taken_by_keys_at_every_size():
    async with running(Unit.MM) as user:
        for size in ((60, 20), (80, 24), (132, 43)):
            await user.pilot.resize_terminal(*size)
            await user.show(DATA / "d14-layers.dxf")
            assert user.importing.table.size.height >= 7, size
            assert user.importing.picture.display is (size[0] >= 80), size
            await user.press("f7")
            assert user.importing.picture.outer_size.width == user.importing.query_one("#desk").size.width, size
            await user.press("f7", "f1")
            await user.taken()
            await user.press("ctrl+z")
            assert not user.session.program.blocks[0].segments


async def test_home_lists_drawings_and_opens_one(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "plate.dxf").write_bytes(dxf(*square(0, 0, 10)))
    service = DocumentService(state=tmp_path / "own")
    app = CutcompApp(session_of(service.new(Unit.MM).document), surroundings=SURROUNDINGS, service=service, home=True)
    async with Importer.of(app) as user:
        table = app.screen.query_one("#programs", DataTable)
        assert [str(cell) for cell in table.get_row_at(0)] == ["plate.dxf", "", "", "", "drawing"]
        await user.press("enter")
        await user.until(lambda: any(isinstance(screen, ImportScreen) for screen in app.screen_stack))
        await user.ready()
        assert user.rows[0][1] == "OUTSIDE"
        await user.press("f8")
        await user.until(lambda: type(app.screen).__name__ == "HomeScreen")
    service.stop()


async def test_open_of_a_drawing_by_its_path_lists_it(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "plate.dxf").write_bytes(dxf(*square(0, 0, 10)))
    service = DocumentService(state=tmp_path / "own")
    settings = SettingsFile(tmp_path / "settings.toml", Settings())
    program = service.new(Unit.MM).document
    app = CutcompApp(session_of(program), surroundings=SURROUNDINGS, service=service, settings_file=settings)
    async with Importer.of(app) as user:
        await user.press("ctrl+k", *["'i", "'m", "'p", "'o", "'r", "'t"], "'d")
        await user.press("ctrl+k")
        await app.run_action("app.open_path")
        await user.settle()
        await user.press("p", "l", "a", "t", "e", "full_stop", "d", "x", "f", "enter")
        await user.until(lambda: any(isinstance(screen, ImportScreen) for screen in app.screen_stack))
        await user.ready()
        assert user.rows[0][1] == "OUTSIDE"
        await user.press("escape")
    service.stop()


async def test_escape_leaves_the_screen_while_a_drawing_is_read(tmp_path, monkeypatch):
    monkeypatch.setattr("app.screens.import_drawing.Worker", REAL_WORKER)
    monkeypatch.setattr("app.screens.import_drawing.read_and_list", wait_for_ever)
    path = tmp_path / "slow.dxf"
    path.write_bytes(dxf(*square(0, 0, 10)))
    async with running() as user:
        user.app.show_drawing(path)
        await user.pilot.pause()
        await user.until(lambda: "Esc stops." in user.message)
        await user.press("escape")
        await user.left()


async def test_a_list_that_arrives_while_the_screen_closes_is_dropped(tmp_path, monkeypatch):
    listed = asyncio.Event()

    async def late(work: Callable[..., object], *arguments: object) -> object:
        result = await asyncio.to_thread(work, *arguments)
        if isinstance(result, ContourList):
            listed.set()
            while importing.query(ContourTable):
                await asyncio.sleep(0)
        return result

    monkeypatch.setattr("app.screens.import_drawing.to_thread", late)
    path = tmp_path / "part.dxf"
    path.write_bytes(dxf(*square(0, 0, 10)))
    async with running() as user:
        user.app.show_drawing(path)
        importing = user.importing
        await asyncio.wait_for(listed.wait(), 30)
        user.app.pop_screen()
        await user.settle()
        assert importing.listed is None
        assert not importing.query(ContourTable)


def wait_for_ever(*_arguments: object, progress: object) -> int:
    while progress:
        pass
    return 0
