"""Help is there for every field, fits, and every softkey has twins without a function key."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.documents.files import load
from app.documents.programs import empty_program, example
from app.painted.desk import Desk
from app.painted.screens.ask import Ask
from app.painted.screens.browse import BrowsePage
from app.painted.screens.contour import Contour
from app.painted.screens.draw import DrawPage
from app.painted.screens.findings import FindingsPage
from app.painted.screens.help import KEYS, MARKS, HelpPage
from app.painted.screens.import_tools import FaultsPage, ImportPage
from app.painted.screens.lookahead import LookaheadTable
from app.painted.screens.new_segment import NewSegment
from app.painted.screens.page import Page
from app.painted.screens.parameters import ParametersPage
from app.painted.screens.post import PostPage
from app.painted.screens.program import ProgramPage
from app.painted.screens.save import SaveAsPage
from app.painted.screens.setup import SetupPage
from app.painted.screens.sheet import SheetPage
from app.painted.screens.start import StartPage
from app.painted.screens.tools import ToolsPage
from app.painted.session import Session
from app.screens.topics import TOPICS, topic_of
from core.program.fields import TABLES, Form, field_of
from tests.app.operator import Operator

SESSION = Session.of(load(example("pocket")))
PAGES: tuple[Page, ...] = (
    Ask("LEAVE?", ("Really?",), ()),
    BrowsePage(),
    Contour(),
    DrawPage(),
    FaultsPage(),
    FindingsPage(),
    HelpPage(),
    ImportPage.of(SESSION),
    LookaheadTable(3),
    NewSegment(1),
    ParametersPage(),
    PostPage.of(SESSION),
    ProgramPage(),
    ProgramPage(set=1),
    ProgramPage(set=2),
    SaveAsPage.of(SESSION),
    SetupPage(),
    SheetPage.of(SESSION),
    StartPage(),
    ToolsPage(),
)


@pytest.mark.parametrize(("form", "name"), [(form, one.name) for form, table in TABLES.items() for one in table])
def test_every_field_has_a_topic_of_plain_signs_in_56_columns(form: Form, name: str) -> None:
    topic = TOPICS[form, name]
    assert topic.words.isascii()
    assert topic.words.endswith(".")
    assert all(line.isascii() and line.startswith("  ") and len(line) <= 58 for line in topic.picture)


@pytest.mark.parametrize(
    ("form", "name"),
    [
        (Form.LINE, "angle"),
        (Form.ARC, "sweep"),
        (Form.START, "cutter_comp"),
        (Form.START, "peck_depth"),
        (Form.START, "lookahead"),
        (Form.PARAMETERS, "blend_offset"),
    ],
)
def test_pictures_where_words_are_not_enough(form: Form, name: str) -> None:
    topic = topic_of(field_of(form, name))
    assert topic is not None
    assert len(topic.picture) >= 3


def test_the_same_name_on_two_forms_has_two_topics() -> None:
    assert topic_of(field_of(Form.ARC, "radius")) is not topic_of(field_of(Form.BLEND, "radius"))


def test_help_shows_words_range_and_picture_then_the_keys() -> None:
    operator = Operator.at(load(example("pocket"))).press("1", "enter", *["tab"] * 5, "?")
    shown = operator.part("body")
    assert " XY ANGLE" in shown
    assert "  180 ----+---- 0  (+X)" in shown
    assert "From -360 to 360." in shown
    assert "Ctrl+K" in operator.press("pagedown").part("body")


def test_the_key_sheet_fits() -> None:
    assert all(len(key) <= 15 and len(text) <= 43 for key, text in (*KEYS, *MARKS))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: type(page).__name__ + str(getattr(page, "set", "")))
@pytest.mark.parametrize("number", range(1, 9))
def test_no_softkey_needs_a_function_key(
    page: Page, number: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "twin").mkdir()
    monkeypatch.chdir(tmp_path)
    desk = Desk(Session.of(empty_program()), (ProgramPage(), page))
    by_key = desk.press(f"f{number}")
    monkeypatch.chdir(tmp_path / "twin")
    by_twin = desk.press("ctrl+k").press(str(number))
    shown = page.softkeys(desk.session).get(number)
    if shown is not None and not shown.label:
        # the digit is typed, as one sees no softkey; the function key then only says that nothing is to be done
        assert by_key.session.program == desk.session.program
        return
    assert [type(one) for one in by_key.pages] == [type(one) for one in by_twin.pages]
    assert (by_key.session.program, by_key.session.said) == (by_twin.session.program, by_twin.session.said)
    assert by_key.exit == by_twin.exit


@pytest.mark.parametrize("page", PAGES, ids=lambda page: type(page).__name__ + str(getattr(page, "set", "")))
def test_help_is_one_key_away_even_where_text_is_typed(page: Page) -> None:
    desk = Desk(Session.of(empty_program()), (ProgramPage(), page)).press("ctrl+g")
    assert isinstance(desk.page, HelpPage)


def test_the_help_of_speed_promises_nothing_that_the_field_refuses() -> None:
    assert field_of(Form.START, "speed").low == 1
    assert "0" not in TOPICS[Form.START, "speed"].words
