"""What the screen says is what then happens: posting, names of files, values that are refused, the next step."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.cli.screens import begin
from app.documents.files import load
from app.documents.programs import empty_program, example
from app.painted.desk import Desk
from app.painted.screens.ask import Ask
from app.painted.screens.new_segment import NewSegment
from app.painted.screens.post import PostPage
from app.painted.session import Session
from app.painted.widgets.rows import text_of
from app.painted.widgets.verdict import verdict_rows
from core.pipeline.derive import derive, look_ahead_table
from core.program.file.write import dumps
from core.program.model import Number
from tests.app.kept import DEAD, ELSEWHERE, asked, started
from tests.app.operator import Operator

TO_LINUXCNC = ("f8", "f6", "up")


def worked_out(name: str, *keys: str) -> Operator:
    """An example with everything that follows from it, and these keys pressed."""
    program = load(example(name))
    return Operator(Desk(Session.of(program).knowing(derive(program)))).press(*keys)


def answered(operator: Operator) -> Operator:
    """What the page asks for is calculated, as the App does it behind the screen."""
    question = operator.desk.page.question
    assert question is not None
    operator.desk = operator.desk.told(question.answer())
    return operator


def words(operator: Operator) -> str:
    return " ".join(operator.part("body").split())


def test_what_a_control_refuses_is_told_before_anything_is_posted() -> None:
    operator = worked_out("pocket", *TO_LINUXCNC)
    assert "Nothing stands" not in words(operator)
    assert "What linuxcnc refuses is being calculated." in words(operator)
    answered(operator)
    assert "Nothing stands" not in words(operator)
    assert "!! Segment 8: The look-ahead deletes the next segments" in words(operator)
    assert "Nothing can be posted for linuxcnc" in operator.said
    assert operator.desk.page.question is None


@pytest.mark.parametrize("steps", range(1, 9))
def test_that_it_is_being_calculated_is_never_cut(steps: int) -> None:
    operator = worked_out("pocket", "f8", "f6", *["down"] * steps)
    assert "refuses is being calculated." in " ".join(row[:59].rstrip() for row in operator.screen())


def test_what_a_control_takes_is_told_with_its_remarks() -> None:
    operator = answered(worked_out("plate-mm", "f8", "f6", *["down"] * 5))
    assert "Nothing stands against posting." in words(operator)
    assert "allen-bradley:a takes corners differently" in words(operator)


def test_the_path_of_the_center_waits_for_no_control() -> None:
    operator = worked_out("pocket", *TO_LINUXCNC)
    answered(operator).press("down")
    assert operator.desk.page.question is None
    assert "Nothing stands against posting." in words(operator)


def test_an_answer_about_another_control_is_dropped() -> None:
    operator = worked_out("pocket", *TO_LINUXCNC)
    late = operator.desk.page.question
    assert late is not None
    operator.press("up")
    operator.desk = operator.desk.told(late.answer())
    assert "linuxcnc" not in words(operator)
    assert "is being calculated" in words(operator)


@pytest.mark.parametrize("known", [False, True])
def test_nobody_is_asked_to_replace_a_file_by_what_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, *, known: bool
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("part.nc").write_text("M30\n")
    operator = worked_out("pocket", *TO_LINUXCNC)
    if known:
        answered(operator)
    operator.press("enter")
    assert isinstance(operator.desk.page, PostPage)
    assert "Nothing was written: Segment 8:" in operator.said
    assert Path("part.nc").read_text() == "M30\n"


def test_a_gouge_that_is_posted_is_said_to_be_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    operator = worked_out("notch", *["tab"] * 11, "1", "enter")
    operator.desk = operator.desk.knowing(derive(operator.session.program))
    operator.press("f8", "f6", "enter").press(*"POST", "space", *"WITH", "space", *"GOUGE", "enter")
    assert operator.said.startswith("! Posted in spite of a gouge: part.nc, ")
    assert "OVERRIDDEN" in Path("part.nc").read_text()


@pytest.fixture
def beside(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "pk2.toml").write_text(dumps(load(example("pocket"))))
    return tmp_path


def test_a_name_without_suffix_opens_what_save_as_made_of_it(beside: Path) -> None:
    assert begin(Path("pk2"), None).program == load(beside / "pk2.toml")
    assert begin(Path("pk2"), None).file == Path("pk2.toml")


def test_a_name_without_suffix_that_is_nowhere_becomes_what_save_as_makes_of_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    session = begin(Path("new"), None)
    assert session.file == Path("new.toml")
    assert session.said is not None
    assert session.said.text == "new.toml does not exist yet: saving makes it."


def test_a_file_that_is_there_keeps_its_name(beside: Path) -> None:
    (beside / "pk2").write_text(dumps(load(example("notch"))))
    assert begin(Path("pk2"), None).file == Path("pk2")
    assert begin(Path("pk2"), None).program == load(example("notch"))


def test_open_takes_a_name_without_suffix_too(beside: Path) -> None:
    operator = Operator(Desk(Session.of(empty_program()))).press("ctrl+o", *"pk2", "enter")
    assert operator.session.program == load(beside / "pk2.toml")


@pytest.mark.parametrize("text", ["21", "abc"])
def test_a_look_ahead_that_is_none_leaves_the_old_one_and_says_so_until_something_is_typed(text: str) -> None:
    operator = worked_out("pocket", *["tab"] * 11, *text, "enter")
    assert operator.session.block.lookahead is None
    assert "CUTCOMP LOOKAHEAD must be a whole number from 1 to 20." in operator.said
    assert "F3" not in operator.said
    for key in ("down", "up", "enter", "tab"):
        assert "CUTCOMP LOOKAHEAD must be" in operator.press(key).said
    assert "must be" not in operator.press("1").said


def test_only_where_a_value_was_typed_is_the_way_back_to_the_calculated_one_told() -> None:
    operator = worked_out("pocket", *["tab"] * 11, "5", "enter", "up", "2", "1", "enter")
    assert operator.session.block.lookahead == Number(5.0)
    assert operator.said.endswith("Press F3 to go back to CAL.")
    assert "must be" not in operator.press("f3").said


def hint(operator: Operator) -> str:
    found, program = operator.session.found, operator.session.program
    table = look_ahead_table(found, program)
    return " ".join(text_of(row) for row in verdict_rows(found, table, program.unit, None)[1:])


def test_a_start_that_is_complete_says_what_comes_next() -> None:
    operator = Operator.at()
    assert "Type START" in hint(operator)
    found = [one.field for one in operator.session.found.errors if one.field]
    while any(one.field for one in operator.session.found.errors):
        operator.press("tab").press(*("0", "enter", "up") if operator.session.field in found else ())
    assert "Type START" not in hint(operator)
    assert "START is complete" in hint(operator)
    assert "segment 1" in hint(operator)


def test_where_the_first_segment_is_chosen_nobody_is_sent_there() -> None:
    operator = Operator.at().press("pagedown")
    assert operator.part("verdict").splitlines()[1:] == [" START is not complete yet: left arrow goes back to it."]
    operator = Operator.at().press(*["tab"] * 4).type("1", "1", "0", "-1")
    assert operator.part("verdict").splitlines()[1:] == [" START is complete: on SEGMENT, right arrow to segment 1."]
    operator.press("pagedown")
    assert isinstance(operator.desk.page, NewSegment)
    assert operator.part("verdict").splitlines()[1:] == [" START is complete: choose what segment 1 is."]
    assert "START" not in operator.press("l", "pagedown").part("verdict")


def test_taking_over_says_that_the_other_terminal_is_still_live(tmp_path: Path) -> None:
    part, own = tmp_path / "part.toml", tmp_path / "own"
    part.write_text(dumps(load(example("pocket"))))
    started(own, part, ELSEWHERE).press("tab").type("7")
    second = started(own, part, DEAD).press("t")
    assert "The other terminal may still be in use" in asked(second)


def test_work_of_a_dead_terminal_says_nothing_of_it(tmp_path: Path) -> None:
    part, own = tmp_path / "part.toml", tmp_path / "own"
    part.write_text(dumps(load(example("pocket"))))
    started(own, part, DEAD).press("tab").type("7").killed()
    assert "terminal" not in asked(started(own, part, DEAD))


@pytest.mark.parametrize(
    "keys", [("f8", "f7", "f3"), ("f8", "f6", "up"), ("f6", "f3")], ids=["SAVE AS", "POST NC", "IMPORT"]
)
@pytest.mark.parametrize("accept", ["enter", "f1"])
def test_the_first_character_behind_a_name_that_was_refused_replaces_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, keys: tuple[str, ...], accept: str
) -> None:
    monkeypatch.chdir(tmp_path)
    operator = worked_out("pocket", *keys, *"nowhere/none.x", accept)
    assert not isinstance(operator.desk.page, Ask)
    assert operator.said.startswith("!!")
    assert "nowhere/none.x" in operator.part("body")
    operator.press("x")
    assert "none.x" not in operator.part("body")


def test_what_was_found_clear_is_asked_about_at_once_and_worked_out_again_when_it_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("part.nc").write_text("M30\n")
    operator = answered(worked_out("plate-mm", "f8", "f6", *["down"] * 5)).press("enter")
    assert isinstance(operator.desk.page, Ask)
    assert "allen-bradley" in operator.press("r").said
    assert "G41 D2 G1" in Path("part.nc").read_text()
