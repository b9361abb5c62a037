"""What an operator's text is in a field: a blank, an entry, or text that stays."""

from __future__ import annotations

import pytest

from core.program.fields import AGAIN, Form, check_text, field_of, read_typed, unread_reason
from core.program.model import Entry, Unread
from core.units import Unit


def test_read_keeps_what_it_cannot_read():
    one = field_of(Form.LINE, "x_end")
    assert read_typed("  ", one, Unit.IN) is None
    assert read_typed("1 1/2", one, Unit.IN) == Entry(1.5)
    unread = read_typed("1,5", one, Unit.IN)
    assert isinstance(unread, Unread)
    assert unread.text == "1,5"


@pytest.mark.parametrize(
    ("form", "name", "text", "why"),
    [
        (Form.START, "x_start", "99999", "X START must be from -10000 to 10000, not 99999."),
        (Form.START, "finish_tool", "-1", "FINISH TOOL must be a whole number from 0 to 9999, not -1."),
        (Form.LINE, "feed", " 0 ", "FEED must be above 0, at most 10000, not 0."),
    ],
)
def test_a_number_the_field_does_not_take_is_kept_as_it_was_typed(form: Form, name: str, text: str, why: str) -> None:
    one = field_of(form, name)
    assert read_typed(text, one, Unit.IN) == Unread(text, why)
    assert check_text(text, one, Unit.IN) == unread_reason(text, one, Unit.IN) == why


def test_a_text_the_field_would_take_now_waits_to_be_typed_again() -> None:
    one = field_of(Form.START, "x_start")
    assert check_text("99999", one, Unit.MM) is None
    assert unread_reason("99999", one, Unit.MM) == AGAIN
