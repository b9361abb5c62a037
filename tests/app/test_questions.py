"""A question answers every key: with what was asked for, or with how it is answered."""

from __future__ import annotations

import pytest

from app.painted.messages import Close, Open, Say
from app.painted.screens.ask import Ask
from app.painted.screens.decide import Choose, Decide
from tests.app.operator import Operator

OPTIONS = (("c", "CONVERT", (Close(), Say("Converted."))), ("k", "KEEP", (Close(),)))


def asked(kind: type[Ask]) -> Operator:
    operator = Operator.at()
    operator.desk = operator.desk.take(Say("A new program.")).take(Open(kind("UNITS", ("Convert?",), OPTIONS)))
    return operator


@pytest.mark.parametrize("key", ["y", "n", "enter", "5", "X"])
def test_another_key_is_told_how_to_answer(key: str) -> None:
    assert asked(Ask).press(key).said == "Press C or K; Esc goes back and nothing changes."
    assert asked(Decide).press(key).said == "Press C or K."


@pytest.mark.parametrize("key", ["c", "C", "f1"])
def test_an_answer_is_taken(key: str) -> None:
    assert asked(Ask).press(key).said == "Converted."
    assert asked(Decide).press(key).said == "Converted."


def test_under_a_question_stands_nothing_that_was_said_before_it() -> None:
    assert asked(Decide).said == "Press the softkey or the letter of an answer."


def test_details_for_which_there_is_no_room_are_said_to_be_more() -> None:
    operator = Operator.at()
    details = tuple(f"Detail {number}." for number in range(40))
    operator.desk = operator.desk.take(Open(Choose("UNITS", ("Convert?",), OPTIONS, details=details)))
    told = operator.part("body").rstrip().splitlines()
    assert told[-1] == " And more."
    assert " Detail 0." in told
    assert any("C   CONVERT" in row for row in told)
