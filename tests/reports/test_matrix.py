"""A few terminals of the matrix, far apart from each other; `python -m tests.reports.matrix` runs them all."""

from __future__ import annotations

from itertools import product
from types import SimpleNamespace

import pytest

from tests.reports import matrix, recorded
from tests.reports.matrix import SCRIPT, Lost, Tally, one_kind, seated, stands_out, stray
from tests.reports.terminals import FORMS, LOCALES, MODES, PUTTY, SIZES, TERMS, Colors, Kind, kinds, sampled, sent

SHORT = recorded.keys_of("tab", "tab", "f4", "f8", "f7", "f8")
FEW = (
    (Kind("xterm", Colors.TRUE, "UTF-8"), (SIZES[0],)),
    (Kind("vt100", Colors.FEW, "C"), (SIZES[0],)),
    (Kind("linux", Colors.NONE, "Latin-1"), (SIZES[0],)),
)


@pytest.mark.parametrize(("kind", "sizes"), FEW, ids=lambda one: str(one) if isinstance(one, Kind) else "")
def test_a_terminal_shows_what_it_must(
    kind: Kind, sizes: tuple[tuple[int, int], ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(matrix, "SCRIPT", SHORT)
    tally = one_kind(kind, len(kind.modes) % 2, sizes)
    assert tally.wrong == []
    assert sum(tally.combinations.values()) == len(kind.only_here) * len(sizes)
    assert tally.screens > len(SHORT)


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


def test_a_wrong_screen_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    tally = Tally()
    with seated(Kind("xterm", Colors.FEW, "UTF-8"), SIZES[0], ("tab",), (), tally, "braille") as seat:
        monkeypatch.setattr(matrix, "PATIENCE", 0.2)
        with pytest.raises(Lost):
            seat.compare("nothing was typed")
    assert "line" in tally.wrong[-1]
