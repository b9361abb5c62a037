"""A property that rarely tests fails, one that often tests passes."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.properties import exercised, must_exercise


@must_exercise(0.5)
@given(st.integers(0, 9))
def test_a_property_that_often_tests_passes(number: int) -> None:
    if number < 9:
        exercised()
        assert number < 9


@must_exercise(0.5, "nines")
@given(st.integers(0, 1000))
def rarely(number: int) -> None:
    if number == 999:
        exercised("nines")


def test_a_property_that_rarely_tests_fails() -> None:
    with pytest.raises(AssertionError, match=r"nines was tested \d+ times in \d+ examples"):
        rarely()
