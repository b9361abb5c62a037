"""A field's text under the operator's keys."""

from __future__ import annotations

from app.painted.widgets.field import LONGEST, Editing, press, window


def keys(shown: str, *names: str) -> Editing | None:
    editing: Editing | None = None
    for name in names:
        editing = press(editing, shown, name, name if len(name) == 1 else None)
    return editing


def test_typing_replaces_what_is_shown() -> None:
    assert keys("2.0000", "3", ".", "5") == Editing("3.5", 3)


def test_arrows_keep_what_is_shown_and_change_it_in_the_middle() -> None:
    assert keys("2.0000", "left", "left", "5") == Editing("2.00500", 5)
    assert keys("2.0000", "home", "delete", "7") == Editing("7.0000", 1)
    assert keys("2.0000", "end", "backspace") == Editing("2.000", 5)


def test_backspace_and_delete_empty_the_field_at_first() -> None:
    assert keys("2.0000", "backspace") == Editing("", 0)
    assert keys("2.0000", "delete") == Editing("", 0)


def test_the_caret_stays_within_the_text() -> None:
    assert keys("ab", "left", "left", "left", "left") == Editing("ab", 0)
    assert keys("ab", "left", "right", "right", "right") == Editing("ab", 2)


def test_other_keys_are_none_of_editing() -> None:
    assert press(None, "2", "f5", None) is None
    assert press(Editing("1", 1), "2", "up", None) is None


def test_control_characters_and_endless_texts_are_not_taken() -> None:
    assert Editing("a", 1).insert("\x1b[31m\n") == Editing("a[31m", 5)
    assert Editing("x" * LONGEST, 3).insert("y") == Editing("x" * LONGEST, 3)


def test_a_long_text_is_shown_around_its_caret() -> None:
    assert window(Editing("0123456789", 10), 5) == ("6789", 4)
    assert window(Editing("0123456789", 2), 5) == ("01234", 2)
    assert window(Editing("", 0), 5) == ("", 0)
