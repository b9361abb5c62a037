"""The form's two columns as text."""

from __future__ import annotations

import pytest

from app.painted.widgets import form
from app.painted.widgets.field import Editing
from app.painted.widgets.form import WIDTH, Cell, State, cursor_line, form_rows
from app.painted.widgets.rows import Look, text_of


def line(*cells: Cell, cursor: str = "", editing: Editing | None = None, width: int = WIDTH) -> str:
    return text_of(form_rows(cells, cursor, editing, width)[0]).rstrip()


X = Cell("x", "X END", "2.0000", 0, 0)
LENGTH = Cell("length", "XY LENGTH", "3.0000", 1, 0, State.CALCULATED, "CAL")


def test_labels_left_numbers_right_tags_beside_them() -> None:
    assert line(X, LENGTH) == " X END               2.0000  XY LENGTH     CAL     3.0000"


def test_calculated_and_typed_differ_without_color() -> None:
    typed = Cell("length", "XY LENGTH", "3.0000", 1, 0)
    assert line(X, typed) != line(X, LENGTH)


@pytest.mark.parametrize("text", ["-1234.5678", "99999.0000", "PROFILE RIGHT"])
def test_no_number_and_no_choice_is_ever_cut(text: str) -> None:
    for label in ("X END", "CUTTER COMP.", "CUTCOMP LOOKAHEAD"):
        for column in (0, 1):
            if len(text) <= 10 or label != "CUTCOMP LOOKAHEAD":
                assert text in line(Cell("x", label, text, column, 0))


@pytest.mark.parametrize("width", range(8, WIDTH))
def test_in_a_narrow_terminal_the_fields_stand_under_each_other(width: int) -> None:
    rows = form_rows((X, LENGTH), "", None, width)
    assert len(rows) == 2
    assert all(len(text_of(row)) <= width for row in rows)
    assert cursor_line((X, LENGTH), "length", width) == 1


def test_a_half_typed_number_stands_where_the_number_will_stand() -> None:
    assert line(X, cursor="x", editing=Editing("12.5", 4)) == " X END                12.5"


def test_the_caret_is_on_the_character_it_stands_before() -> None:
    row = form_rows((X,), "x", Editing("12.5", 1), WIDTH)[0]
    assert [span.text for span in row if span.look is Look.CARET] == ["2"]


def test_a_long_text_being_typed_pushes_the_label_aside() -> None:
    assert "1 1/2+2 3/4+.1" in line(X, cursor="x", editing=Editing("1 1/2+2 3/4+.1", 14))


def test_tags_stay_where_they_are_when_another_field_of_the_column_loses_its_own() -> None:
    plain, long = Cell("peck", "PECK CLEARANCE", "0.0500", 1, 0, State.CALCULATED, "DEF"), "RETRACT CLEARANCE"
    held = line(plain, Cell("retract", long, "0.1000", 1, 1, State.CALCULATED, "DEF"))
    assert line(plain, Cell("retract", long, "2.0000", 1, 1)) == held
    assert line(plain, Cell("retract", long, "2..", 1, 1, State.UNREAD, "ERR")) == held


def test_read_only_values_stand_in_brackets() -> None:
    cell = Cell("TYPE", "TYPE", "END MILL", 1, 0, State.READ_ONLY)
    assert line(cell) == " " * 29 + "(TYPE               END MILL)"


def test_a_text_that_is_too_long_ends_in_an_ellipsis() -> None:
    assert line(Cell("x", "X END", "?" * 50, 0, 0, State.UNREAD, "ERR")).endswith("?…")


@pytest.mark.parametrize("width", range(1, 12))
def test_a_text_can_be_typed_where_there_is_no_room_for_it(width: int) -> None:
    cell = Cell("radius", "RADIUS", "1.0000", 0, 0, State.TYPED, "CAL")
    assert form_rows([cell], "radius", Editing.of("1.25"), width)


@pytest.mark.parametrize("width", [30, WIDTH])
def test_lines_taken_over_are_those_made_anew(width: int) -> None:
    below = Cell("y", "Y END", "4.0000", 0, 1)
    for cursor in ("x", "y", "length", ""):
        for editing in (None, Editing("2.5", 3), Editing("2.5", 1), Editing("-3.25", 5)):
            for cells in ((X, LENGTH, below), (X._replace(text="2.5000"), LENGTH, below), (X, below)):
                kept = form_rows(cells, cursor, editing, width)
                form._line.cache_clear()
                form._cell.cache_clear()
                assert form_rows(cells, cursor, editing, width) == kept
