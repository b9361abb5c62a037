"""One terminal of the matrix; `python -m tests.reports.matrix` runs them all."""

from __future__ import annotations

from itertools import product
from types import SimpleNamespace

import pytest

from tests.reports import matrix
from tests.reports.matrix import SCRIPT, Tally, one_kind, seated, stands_out, stray
from tests.reports.recorded import Picture
from tests.reports.terminals import FORMS, LOCALES, MODES, PUTTY, SIZES, TERMS, Colors, Kind, kinds, sampled, sent

SIZE = SIZES[0]
SHORT = matrix.resizing([SIZE])


def test_a_terminal_shows_what_it_must(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(matrix, "SCRIPT", SHORT)
    tally = one_kind(Kind("vt100", Colors.FEW, "C"), 0, (SIZE,))
    assert (tally.wrong, tally.runs, tally.screens) == ([], 2, 2 * len(SHORT) + 2)
    assert tally.combinations == {"80x24 ascii": 1}


def test_a_wrong_screen_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    nothing = Picture(("",) * 24, frozenset())
    monkeypatch.setitem(matrix.RECORDINGS, (SIZE, "ascii", SHORT), [nothing])
    tally = Tally()
    with seated(Kind("vt100", Colors.FEW, "C"), SIZE, SHORT, (), tally, "ascii") as seat:
        seat.terminal.until("MILL CONTOUR", longest=30.0)
        monkeypatch.setattr(matrix, "PATIENCE", 0.1)
        assert not list(seat.walk(SHORT))
    assert "after the start: line 0" in tally.wrong[-1]
    assert tally.screens == 0


def test_every_combination_is_in_the_matrix_once() -> None:
    every = [(kind.term, kind.colors, kind.locale, mode) for kind in kinds() for mode in kind.only_here]
    assert len(every) == len(set(every)) == 9 * 4 * 3 * 3
    assert {mode for *_, mode in every} == set(MODES)


def test_the_sample_has_every_pair_of_a_terminal_its_colors_and_its_locale() -> None:
    few = sampled()
    assert {(kind.term, kind.colors) for kind in few} == set(product(TERMS, Colors))
    assert {(kind.term, kind.locale) for kind in few} == set(product(TERMS, LOCALES))
    assert {(kind.colors, kind.locale) for kind in few} == set(product(Colors, LOCALES))
    assert {(kind.form, kind.locale) for kind in few} == set(product(FORMS, LOCALES))
    assert {kind.term for kind in few if kind.asked} == set(TERMS)


def test_the_script_presses_every_softkey() -> None:
    assert {f"f{number}" for number in range(1, 9)} <= set(SCRIPT)


def test_putty_sends_what_its_manual_says() -> None:
    assert [sent(f"f{number}", PUTTY["ESC[n~"]) for number in (1, 5, 6)] == [b"\x1b[11~", b"\x1b[15~", b"\x1b[17~"]
    assert [sent(f"f{number}", PUTTY["VT100+"]) for number in (1, 8)] == [b"\x1bOP", b"\x1bOW"]
    assert [sent(f"f{number}", PUTTY["Linux"]) for number in (1, 5, 6)] == [b"\x1b[[A", b"\x1b[[E", b"\x1b[17~"]
    assert [sent(f"f{number}", PUTTY["SCO"]) for number in (1, 2, 3, 8)] == [b"\x1b1", b"\x1b[N", b"\x1b3", b"\x1b[T"]


@pytest.mark.parametrize(
    ("data", "characters", "what"),
    [
        (b"\x1b[1;31mX\x1b[?25l\x1b[0m", "ascii", ""),
        ("│".encode(), "ascii", "bytes that are not ascii"),
        ("│".encode(), "latin-1", "stray characters"),
        (b"\xb0", "utf-8", "bytes that are not utf-8"),
        ("\ufffd".encode(), "utf-8", "stray characters"),
        (b"\x1bPq\x1b\\", "utf-8", "stray characters"),
        (b"a\x07", "utf-8", "stray characters"),
    ],
)
def test_stray_bytes_are_found(data: bytes, characters: str, what: str) -> None:
    assert stray(data, characters).startswith(what)
    assert bool(stray(data, characters)) == bool(what)


def test_a_cursor_of_color_alone_is_not_seen_without_colors() -> None:
    colored = SimpleNamespace(reverse=False, underscore=False, bg="7fb2e5")
    assert stands_out(colored, Colors.TRUE)
    assert not stands_out(colored, Colors.NONE)
    assert stands_out(SimpleNamespace(reverse=True, underscore=False, bg="default"), Colors.NONE)
