"""Keys that a link has split are put together again; what comes too late is told, and never typed."""

from __future__ import annotations

from itertools import product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from textual import events
from textual._ansi_sequences import ANSI_SEQUENCES_KEYS
from textual._xterm_parser import XTermParser

from app.terminal.driver import messages
from app.terminal.split_keys import CLICK, DELAY, ESC, LATE, MOST, PASTING, REST, TOGETHER, TORN, UNENDED, Joined, delay

TAILS = ("[A", "[D", "[5~", "[18~", "[1;5H", "[[A", "[Z", "OS", "OP", "OM", "[?2026;1$y", "[<0;3;4M", "[99~")
LONG = 60.0


def arrived(*pieces: str | float, wait: float = DELAY) -> list[str]:
    """What comes of texts and of the seconds between them; at the end nothing comes for a long time."""
    joined, now, found = Joined(ANSI_SEQUENCES_KEYS, wait), 1000.0, list[str]()
    for piece in (*pieces, LONG):
        if isinstance(piece, str):
            found += joined.feed(piece, now)
            continue
        until = now + piece
        while joined.due is not None and joined.due <= until:
            now = joined.due
            found += joined.tick(now)
        now = until
    assert not joined.held
    return found


@pytest.mark.parametrize("tail", TAILS)
def test_a_key_in_two_pieces_is_the_key(tail: str) -> None:
    key = ESC + tail
    assert arrived(key) == [key]
    for place in range(1, len(key)):
        assert arrived(key[:place], 0.29, key[place:], "7") == [key, "7"]


@pytest.mark.parametrize("tail", TAILS)
@pytest.mark.parametrize("seconds", [0.31, 0.6, 1.0, 2.0])
def test_a_rest_that_comes_too_late_is_told_and_not_typed(tail: str, seconds: float) -> None:
    assert arrived(ESC, seconds, tail, "7") == [ESC, TORN, "7"]


@given(st.sampled_from(TAILS), st.lists(st.floats(0.0, DELAY * 0.99), min_size=11, max_size=11))
@settings(derandomize=True, deadline=None)
def test_every_byte_as_late_as_esc_waits(tail: str, gaps: list[float]) -> None:
    pieces = [piece for both in zip(ESC + tail, gaps, strict=False) for piece in both]
    assert arrived(*pieces, "7") == [ESC + tail, "7"]


@given(
    st.sampled_from([tail for tail in TAILS if tail[0] == "["]),
    st.floats(0.0, DELAY + LATE * 0.99),
    st.lists(st.floats(0.0, REST * 0.99), min_size=10, max_size=10),
)
@settings(derandomize=True, deadline=None)
def test_nothing_of_a_key_is_typed_however_late_its_bytes_are(tail: str, first: float, gaps: list[float]) -> None:
    pieces = [piece for both in zip(tail, gaps, strict=False) for piece in both]
    assert arrived(ESC, first, *pieces, "7") in ([ESC + tail, "7"], [ESC, TORN, "7"])


@pytest.mark.parametrize("tail", [tail for tail in TAILS if tail[0] == "["])
@pytest.mark.parametrize("seconds", [REST + 0.1, 2.0, REST + LATE - 0.1])
def test_a_key_whose_end_comes_long_after_its_beginning_types_nothing(tail: str, seconds: float) -> None:
    for place in range(1, len(tail)):
        assert set(arrived(ESC + tail[:place], seconds, tail[place:])) == {TORN}


def test_what_is_typed_when_a_key_was_told_torn_is_typed() -> None:
    assert arrived(ESC + "[1", REST + 0.5, "2", 0.2, ".", 0.2, "5", 0.2, "\r") == [TORN, *"2.5\r"]
    assert arrived(ESC + "[", REST + LATE + 0.1, "d") == [TORN, "d"]
    assert arrived(ESC + "[", REST + 0.5, ESC + "[D") == [TORN, ESC + "[D"]


def test_one_split_at_any_place_types_nothing() -> None:
    for tail, seconds in product(TAILS, (0.05, 0.29, 0.31, 0.9)):
        for place in range(1, len(tail) + 1):
            found = arrived((ESC + tail)[:place], seconds, (ESC + tail)[place:])
            assert [one for one in found if len(one) == 1 and one != ESC] == [], (tail, place, seconds)


@pytest.mark.parametrize(
    ("pieces", "found"),
    [
        ((ESC,), [ESC]),
        ((ESC, 0.05, "4"), [f"{ESC}4"]),
        ((f"{ESC}4",), [f"{ESC}4"]),
        # fingers are not that fast: the Esc takes back, the digit is typed
        ((ESC, 0.15, "4"), [ESC, "4"]),
        ((ESC, 0.5, "4"), [ESC, "4"]),
        ((ESC, 0.2, ESC, 0.2, "4"), [ESC, ESC, "4"]),
        ((f"{ESC}{ESC}[A",), [ESC, f"{ESC}[A"]),
        ((ESC, 0.2, "OUTSIDE"), [f"{ESC}OU", *"TSIDE"]),
    ],
)
def test_esc_and_what_is_typed_behind_it(pieces: tuple[str | float, ...], found: list[str]) -> None:
    joined = {*ANSI_SEQUENCES_KEYS, f"{ESC}OU"}
    one, now, got = Joined(joined), 0.0, list[str]()
    for piece in (*pieces, LONG):
        if isinstance(piece, str):
            got += one.feed(piece, now)
            continue
        now += piece
        got += one.tick(now)
    assert got == found


@pytest.mark.parametrize("text", ["O1234", "[2+3]", "[#1*2]", "[12]", "[2.5]", "[[2", "X[1", "O", "[", "1O", "\r"])
@pytest.mark.parametrize("seconds", [0.15, 0.5, 1.5])
def test_what_an_operator_types_behind_esc_is_typed(text: str, seconds: float) -> None:
    typed = [piece for character in text for piece in (character, 0.2)]
    if text == "[" and seconds < DELAY:
        assert arrived(ESC, seconds, *typed) == [TORN]
    elif text == "[[2" and seconds < DELAY:
        pytest.skip("two brackets at once behind Esc are a key of the Linux console")
    else:
        assert arrived(ESC, seconds, *typed) == [ESC, *text]


@pytest.mark.parametrize("letter", ["U", "S", "A"])
def test_a_word_that_begins_with_o_is_typed_a_while_after_esc(letter: str) -> None:
    assert arrived(ESC, 0.5, "O", TOGETHER * 1.5, letter) == [ESC, "O", letter]
    assert arrived(ESC, DELAY + LATE, f"O{letter}") == [ESC, "O", letter]
    assert arrived("1", "O", letter) == ["1", "O", letter]


def test_a_key_that_breaks_off_types_nothing_and_the_next_one_counts() -> None:
    assert arrived(f"{ESC}[1", REST * 2, f"{ESC}[A") == [TORN, f"{ESC}[A"]
    assert arrived(f"{ESC}[", ESC, "[A") == [TORN, f"{ESC}[A"]
    assert arrived(f"{ESC}[{'1' * 40}")[:2] == [ESC, "["]


def test_a_paste_comes_whole_however_it_was_split() -> None:
    whole = f"{ESC}[200~1.5\r[D OS\r{ESC}[201~"
    for place in range(1, len(whole)):
        assert arrived(whole[:place], 0.25, whole[place:], "7") == [whole, "7"]
    for place in range(len(f"{ESC}[200~"), len(whole)):
        assert arrived(whole[:place], 1.9, whole[place:], "7") == [whole, "7"]


def test_a_paste_whose_end_does_not_come_is_told_and_keys_work_again() -> None:
    for begun in ("", "1.5", "x" * 40):
        assert arrived(f"{ESC}[200~{begun}", PASTING, "7", f"{ESC}[D") == [UNENDED, "7", f"{ESC}[D"]
    assert arrived(f"{ESC}[200~1", 1.9, "2", 1.9, f"3{ESC}[201~", "7") == [f"{ESC}[200~123{ESC}[201~", "7"]
    assert arrived(f"{ESC}[200~1", PASTING, f"{ESC}[201~", "7") == [UNENDED, f"{ESC}[201~", "7"]


def test_a_paste_without_an_end_ends_two_seconds_after_its_last_byte() -> None:
    joined = Joined(())
    assert list(joined.feed(f"{ESC}[200~1.5", 100.0)) == []
    assert list(joined.feed("2", 101.5)) == []
    assert joined.due == 103.5
    assert list(joined.tick(103.4)) == []
    assert list(joined.tick(103.5)) == [UNENDED]
    assert list(joined.feed("7", 103.6)) == ["7"]


def test_a_paste_of_any_length_holds_no_more_than_its_beginning() -> None:
    joined = Joined(ANSI_SEQUENCES_KEYS)
    piece = "0123456789" * 400
    assert list(joined.feed(f"{ESC}[200~", 0.0)) == []
    for second in range(30):
        assert list(joined.feed(piece, float(second))) == []
        assert joined.paste is not None
        assert len(joined.paste) < MOST + len(piece)
    assert list(joined.feed(f"{ESC}[20", 31.0)) == []
    (whole,) = joined.feed("1~", 31.0)
    assert whole.startswith(f"{ESC}[200~{piece}")
    assert whole.endswith(f"{ESC}[201~")
    assert len(whole) < MOST + len(piece)


def test_a_click_that_another_program_asked_for_types_nothing() -> None:
    assert arrived(f"{CLICK} !!7") == ["7"]
    assert arrived(CLICK, 0.2, "7") == ["7"]


@pytest.mark.parametrize(
    ("asked", "seconds"), [("", 0.3), ("25", 0.025), ("1000", 1.0), ("0", 0.001), ("-5", 0.3), ("x", 0.3), ("²", 0.3)]
)
def test_escdelay_is_the_operators(asked: str, seconds: float) -> None:
    assert delay({"ESCDELAY": asked}) == delay({"ESCDELAY": asked, "TERM": "xterm"}) == pytest.approx(seconds)
    assert delay({}) == DELAY


def keys(*units: str) -> list[tuple[str, str | None]]:
    parser = XTermParser()
    return [(one.key, one.character) for unit in units for one in messages(parser, unit) if isinstance(one, events.Key)]


def test_textual_makes_the_keys_of_them() -> None:
    assert keys(ESC, f"{ESC}[D", "7", f"{ESC}OS") == [("escape", ESC), ("left", None), ("7", "7"), ("f4", None)]
    assert keys(TORN, UNENDED) == [(TORN, None), (UNENDED, None)]
    assert keys(f"{ESC}[?1;2c", f"{ESC}[1;9z", "7") == [("7", "7")]
    assert keys(f"{ESC}x", "y") == [("alt+x", "x"), ("y", "y")]
    pasted = [one for one in messages(XTermParser(), f"{ESC}[200~1.5\r{ESC}[201~") if isinstance(one, events.Paste)]
    assert [one.text for one in pasted] == ["1.5\r"]
