"""Typed sums against hand-made values and Python's fractions."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.arithmetic import MAX_CHARACTERS, CannotReadError, evaluate
from tests.properties import exercised, must_exercise

SCALES = {"in": Fraction(1), "mm": Fraction(5, 127), '"': Fraction(1)}


def read(text: str) -> Fraction:
    return evaluate(text, SCALES, "type a number")


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("2", "2"),
        ("2.", "2"),
        (".5", "1/2"),
        ("-.5", "-1/2"),
        ("+3", "3"),
        (" 1 1/2 ", "3/2"),
        ("1\t1/2", "3/2"),
        ("-1 1/2", "-3/2"),
        ("1/2", "1/2"),
        ("3-1 1/2", "3/2"),
        ("3 - 1/2", "5/2"),
        ("2*1 1/2", "3"),
        ("5/(2 1/2)", "2"),
        ("8/2-1 1/2", "5/2"),
        ("2.5-.125", "19/8"),
        ("25.4/2", "127/10"),
        ("1/2/4", "1/8"),
        ("8/2*4", "16"),
        ("1-2-3", "-4"),
        ("2+3*4", "14"),
        ("(2+3)*4", "20"),
        ("-(1+2)", "-3"),
        ("2--.5", "5/2"),
        ("2*-3", "-6"),
        ("12.7mm", "1/2"),
        ("12.7 MM", "1/2"),
        ("1/2in", "1/2"),
        ('1 1/2"', "3/2"),
        ("1in+25.4mm", "2"),
        ("(2.5-.125)in", "19/8"),
        ("25.4mm/2", "1/2"),
        ("6/3in", "2"),
        ("1/2in*3", "3/2"),
        ("\N{MINUS SIGN}2", "-2"),
        ("2\N{MULTIPLICATION SIGN}3", "6"),
    ],
)
def test_evaluate_reads_numbers_sums_and_units(text, value):
    assert read(text) == Fraction(value)


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("", "Type a number"),
        ("   ", "Type a number"),
        ("x", "x is not a number"),
        ("2x", "x is not a unit"),
        ("1e5", "e is not a unit"),
        ("1 2", "1 2 is not a number"),
        ("1/2 1/2", "1/2 1/2 is not clear: put 2 1/2 into brackets to divide by it."),
        ("3/4 1/2", "3/4 1/2 is not clear: put 4 1/2 into brackets to divide by it."),
        ("1/-2 1/2", "1/-2 1/2 is not clear: put 2 1/2 into brackets to divide by it."),
        ("1.2.3", "1.2.3 is not a number"),
        ("1 3/2", "must be less than 1"),
        ("1 1/0", "must be less than 1"),
        ("1/0", "Division by zero"),
        ("1/(2-2)", "Division by zero"),
        ("--1", "A number is missing before -"),
        ("2+", "A number is missing at the end"),
        ("*2", "A number is missing before *"),
        ("(1+2", "closing bracket is missing"),
        ("1+2)", "One bracket too many"),
        ("()", "A number is missing before"),
        ("1,5", "comma"),
        ("1,000", "comma"),
        ("1in+3", "Give every number its unit"),
        ("2.5-.125mm", "Give every number its unit"),
        ("1mm mm", "One unit is enough|does not belong there"),
        ("(1in)mm", "One unit is enough"),
        ("1in*2in", "Length times length"),
        ("1in/2in", "divided by a length"),
        ("1/(2in)", "divided by a length"),
        ("٣", "not a number"),
        ("1 ٣/4", "is not a unit"),
        ("²", "not a number"),
        ("1\x1b", "a character that cannot be displayed"),
        ("1" * (MAX_CHARACTERS + 1), "Too long"),
        ("(" * MAX_CHARACTERS, "A number is missing at the end"),
    ],
)
def test_evaluate_refuses_with_a_reason(text, word):
    with pytest.raises(CannotReadError, match=word):
        read(text)


def test_a_dash_before_a_fraction_of_an_inch_is_refused_as_ambiguous():
    with pytest.raises(CannotReadError, match=r"1-1/2 is not clear: type 1 1/2 with a blank, or 1 - 1/2"):
        read("1-1/2")
    with pytest.raises(CannotReadError, match=r"type -2 3/16 with a blank"):
        read("-2-3/16in")


def test_a_dash_before_any_other_fraction_is_a_minus():
    assert read("2-3/2") == Fraction(1, 2)
    assert read("2-1/3") == Fraction(5, 3)
    assert read("2-1/2-1") == Fraction(1, 2)


def outcome(text: str) -> str:
    """The value or the reason as text."""
    try:
        return str(read(text))
    except CannotReadError as error:
        return str(error)


numbers = st.decimals(min_value=0, max_value=9999, places=3).map(str)
signs = st.sampled_from(["+", " - ", "*"])


@settings(derandomize=True, max_examples=200)
@given(st.lists(st.tuples(numbers, signs), min_size=1, max_size=4), numbers)
def test_evaluate_agrees_with_exact_arithmetic(terms, last):
    text = "".join(number + sign for number, sign in terms) + last
    exact = "".join(f"Fraction('{number}'){sign}" for number, sign in terms) + f"Fraction('{last}')"
    assert read(text) == eval(exact, {"Fraction": Fraction})


def assert_answered(text: str) -> None:
    """It is a number, or a sentence says why not."""
    answer = outcome(text)
    exercised("reason" if answer.endswith(".") else "number")
    assert answer.endswith(".") or Fraction(answer) == read(text)


@must_exercise(0.5, "reason")
@settings(derandomize=True, max_examples=150)
@given(st.text(max_size=20))
def test_any_text_is_a_number_or_has_a_reason(text):
    assert_answered(text)


@must_exercise(0.02, "number", "reason")
@settings(derandomize=True, max_examples=150)
@given(st.text(alphabet='0123456789./*-+() inm"', max_size=MAX_CHARACTERS))
def test_any_text_of_allowed_characters_is_a_number_or_has_a_reason(text):
    assert_answered(text)
