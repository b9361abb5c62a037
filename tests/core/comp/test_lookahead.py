"""The calculated look-ahead."""

from __future__ import annotations

import subprocess
import sys

import pytest

from core.comp.lookahead import MAX_LOOKAHEAD, MIN_LOOKAHEAD, calculated

OPEN = [2, 2, 2, 2, 2, 3, 4, 5, 6, 7, 8, 8]
CLOSED = [3, 3, 3, 3, 4, 5, 6, 7, 8, 8, 8, 8]


@pytest.mark.parametrize(("count", "value"), enumerate(OPEN, 1))
def test_open(count, value):
    assert calculated(count, closed=False) == value


@pytest.mark.parametrize(("count", "value"), enumerate(CLOSED, 1))
def test_closed(count, value):
    assert calculated(count, closed=True) == value


def test_long_contours_stay_at_eight():
    assert calculated(1000, closed=False) == calculated(1000, closed=True) == 8


def test_range_of_a_typed_value():
    assert (MIN_LOOKAHEAD, MAX_LOOKAHEAD) == (1, 20)


def test_needs_no_numpy():
    program = "import sys, core.comp.lookahead; sys.exit('numpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0
