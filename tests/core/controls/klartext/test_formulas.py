"""Formulas of Q parameters."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.controls.klartext.formulas import evaluate


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("+5", 5),
        ("-2,5", -2.5),
        ("2 + 3 * 4", 14),
        ("( 2 + 3 ) * 4", 20),
        ("2 ^ 3 * 2", 16),
        ("10 - 4 - 3", 3),
        ("+Q1 DIV -2", -3.5),
        ("SIN 30 * 4", 2),
        ("SQRT ( 9 + 16 )", 5),
        ("+3 LEN +4", 5),
        ("+1 ANG -1", 135),
        ("SQ 3 - ABS -2", 7),
        ("INT -2.7", -2),
        ("FRAC 2.25", 0.25),
        ("NEG Q1", -7),
        ("SGN -4", -1),
        ("PI", 3.141592653589793),
        ("ATAN 1", 45),
        ("LOG 1000 + LN EXP 2", 5),
    ],
)
def test_values(text: str, value: float) -> None:
    assert evaluate(text, {"Q1": 7.0}) == pytest.approx(value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("1 / 0", "divides by zero"),
        ("SQRT -1", "outside its range"),
        ("Q2 + 1", "Q2 has no value yet"),
        ("1 +", "needs a number at its end"),
        ("( 1", "not closed"),
        ("1 2", "cannot have 2 at this place"),
        ("10 ^ 400", "outside its range"),
        ("%", "needs a number at %"),
        ("", "needs a number at its end"),
        ("(" * 5000, "nests more than 50"),
        ("-" * 5000, "nests more than 50"),
        ("1e5", "cannot have e at this place"),
    ],
)
def test_no_values(text: str, words: str) -> None:
    value = evaluate(text, {"Q1": 7.0})
    assert isinstance(value, str)
    assert words in value


@given(st.text("Q1+-*/^() .,SINCOQRTL29", max_size=40))
def test_no_formula_raises(text: str) -> None:
    assert isinstance(evaluate(text, {"Q1": 2.0}), float | str)


def test_a_product_of_whole_numbers_beyond_all_machines_has_no_value() -> None:
    large = f"INT 1{'0' * 200}"
    assert evaluate(f"{large} * {large}", {}) == "The formula's value is too large."
