"""Keys split by a link are joined again; parts that arrive too late are reported and never typed."""

from __future__ import annotations

from itertools import product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from textual import events
from textual._ansi_sequences import ANSI_SEQUENCES_KEYS
from textual._xterm_parser import XTermParser

from app.terminal.driver import messages_of_key
from app.terminal.split_keys import (
    CLICK,
    ESC,
    ESC_SECONDS,
    LATE_SECONDS,
    MAX_PASTED,
    PASTE_SECONDS,
    REST_SECONDS,
    SAME_KEY_SECONDS,
    TORN,
    UNENDED,
    Joined,
    delay,
)

TAILS = ("[A", "[D", "[5~", "[18~", "[1;5H", "[[A", "[Z", "OS", "OP", "OM", "[?2026;1$y", "[<0;3;4M", "[99~")
LONG = 60.0


def arrived(*pieces: str | float, wait: float = ESC_SECONDS) -> list[str]:
    """The keys made of texts and the seconds between them, followed by a long silence."""
    joined, now, result = Joined(ANSI_SEQUENCES_KEYS, wait), 1000.0, list[str]()
    for piece in (*pieces, LONG):
        if isinstance(piece, str):
            result += joined.feed(piece, now)
            continue
        until = now + piece
        while joined.due is not None and joined.due <= until:
            now = joined.due
            result += joined.tick(now)
        now = until
    assert not joined.held
    return result


@pytest.mark.parametrize("tail", TAILS)
def test_a_key_in_two_pieces_is_joined(tail: str) -> None:
    key = ESC + tail
    assert arrived(key) == [key]
    for place in range(1, len(key)):
        assert arrived(key[:place], 0.29, key[place:], "7") == [key, "7"]


@pytest.mark.parametrize("tail", TAILS)
@pytest.mark.parametrize("seconds", [0.31, 0.6, 1.0, 2.0])
def test_a_tail_that_arrives_too_late_is_reported_and_not_typed(tail: str, seconds: float) -> None:
    assert arrived(ESC, seconds, tail, "7") == [ESC, TORN, "7"]


@given(st.sampled_from(TAILS), st.lists(st.floats(0.0, ESC_SECONDS * 0.99), min_size=11, max_size=11))
@settings(derandomize=True, deadline=None)
def test_every_byte_as_late_as_esc_waits(tail: str, gaps: list[float]) -> None:
    pieces = [piece for both in zip(ESC + tail, gaps, strict=False) for piece in both]
    assert arrived(*pieces, "7") == [ESC + tail, "7"]


@given(
    st.sampled_from([tail for tail in TAILS if tail[0] == "["]),
    st.floats(0.0, ESC_SECONDS + LATE_SECONDS * 0.99),
    st.lists(st.floats(0.0, REST_SECONDS * 0.99), min_size=10, max_size=10),
)
@settings(derandomize=True, deadline=None)
def test_nothing_of_a_key_is_typed_however_late_its_bytes_are(tail: str, first: float, gaps: list[float]) -> None:
    pieces = [piece for both in zip(tail, gaps, strict=False) for piece in both]
    assert arrived(ESC, first, *pieces, "7") in ([ESC + tail, "7"], [ESC, TORN, "7"])


@pytest.mark.parametrize("tail", [tail for tail in TAILS if tail[0] == "["])
@pytest.mark.parametrize("seconds", [REST_SECONDS + 0.1, 2.0, REST_SECONDS + LATE_SECONDS - 0.1])
def test_a_key_whose_end_arrives_very_late_types_nothing(tail: str, seconds: float) -> None:
    for place in range(1, len(tail)):
        assert set(arrived(ESC + tail[:place], seconds, tail[place:])) == {TORN}


def test_text_after_a_torn_key_is_typed() -> None:
    assert arrived(ESC + "[1", REST_SECONDS + 0.5, "2", 0.2, ".", 0.2, "5", 0.2, "\r") == [TORN, *"2.5\r"]
    assert arrived(ESC + "[", REST_SECONDS + LATE_SECONDS + 0.1, "d") == [TORN, "d"]
    assert arrived(ESC + "[", REST_SECONDS + 0.5, ESC + "[D") == [TORN, ESC + "[D"]


def test_a_key_split_anywhere_types_nothing() -> None:
    for tail, seconds in product(TAILS, (0.05, 0.29, 0.31, 0.9)):
        for place in range(1, len(tail) + 1):
            result = arrived((ESC + tail)[:place], seconds, (ESC + tail)[place:])
            assert [key for key in result if len(key) == 1 and key != ESC] == [], (tail, place, seconds)


@pytest.mark.parametrize(
    ("pieces", "found"),
    [
        ((ESC,), [ESC]),
        ((ESC, 0.05, "4"), [f"{ESC}4"]),
        ((f"{ESC}4",), [f"{ESC}4"]),
        # fingers are not that fast: Esc acts alone and the digit is typed
        ((ESC, 0.15, "4"), [ESC, "4"]),
        ((ESC, 0.5, "4"), [ESC, "4"]),
        ((ESC, 0.2, ESC, 0.2, "4"), [ESC, ESC, "4"]),
        ((f"{ESC}{ESC}[A",), [ESC, f"{ESC}[A"]),
        ((ESC, 0.2, "OUTSIDE"), [f"{ESC}OU", *"TSIDE"]),
    ],
)
def test_text_after_esc_is_alt_only_when_it_follows_at_once(pieces: tuple[str | float, ...], found: list[str]) -> None:
    sequences = {*ANSI_SEQUENCES_KEYS, f"{ESC}OU"}
    joined, now, result = Joined(sequences), 0.0, list[str]()
    for piece in (*pieces, LONG):
        if isinstance(piece, str):
            result += joined.feed(piece, now)
            continue
        now += piece
        result += joined.tick(now)
    assert result == found


@pytest.mark.parametrize("text", ["O1234", "[2+3]", "[#1*2]", "[12]", "[2.5]", "[[2", "X[1", "O", "[", "1O", "\r"])
@pytest.mark.parametrize("seconds", [0.15, 0.5, 1.5])
def test_text_typed_after_esc_is_typed(text: str, seconds: float) -> None:
    typed = [piece for character in text for piece in (character, 0.2)]
    if text == "[" and seconds < ESC_SECONDS:
        assert arrived(ESC, seconds, *typed) == [TORN]
    elif text == "[[2" and seconds < ESC_SECONDS:
        pytest.skip("two brackets at once behind Esc are a key of the Linux console")
    else:
        assert arrived(ESC, seconds, *typed) == [ESC, *text]


@pytest.mark.parametrize("letter", ["U", "S", "A"])
def test_a_word_beginning_with_o_is_typed_some_time_after_esc(letter: str) -> None:
    assert arrived(ESC, 0.5, "O", SAME_KEY_SECONDS * 1.5, letter) == [ESC, "O", letter]
    assert arrived(ESC, ESC_SECONDS + LATE_SECONDS, f"O{letter}") == [ESC, "O", letter]
    assert arrived("1", "O", letter) == ["1", "O", letter]


def test_an_incomplete_key_types_nothing_and_the_next_key_works() -> None:
    assert arrived(f"{ESC}[1", REST_SECONDS * 2, f"{ESC}[A") == [TORN, f"{ESC}[A"]
    assert arrived(f"{ESC}[", ESC, "[A") == [TORN, f"{ESC}[A"]
    assert arrived(f"{ESC}[{'1' * 40}")[:2] == [ESC, "["]


def test_a_split_paste_arrives_whole() -> None:
    whole = f"{ESC}[200~1.5\r[D OS\r{ESC}[201~"
    for place in range(1, len(whole)):
        assert arrived(whole[:place], 0.25, whole[place:], "7") == [whole, "7"]
    for place in range(len(f"{ESC}[200~"), len(whole)):
        assert arrived(whole[:place], 1.9, whole[place:], "7") == [whole, "7"]


def test_a_paste_without_an_end_is_reported_and_keys_work_again() -> None:
    for pasted in ("", "1.5", "x" * 40):
        assert arrived(f"{ESC}[200~{pasted}", PASTE_SECONDS, "7", f"{ESC}[D") == [UNENDED, "7", f"{ESC}[D"]
    assert arrived(f"{ESC}[200~1", 1.9, "2", 1.9, f"3{ESC}[201~", "7") == [f"{ESC}[200~123{ESC}[201~", "7"]
    assert arrived(f"{ESC}[200~1", PASTE_SECONDS, f"{ESC}[201~", "7") == [UNENDED, f"{ESC}[201~", "7"]


def test_a_paste_without_an_end_ends_two_seconds_after_its_last_byte() -> None:
    joined = Joined(())
    assert list(joined.feed(f"{ESC}[200~1.5", 100.0)) == []
    assert list(joined.feed("2", 101.5)) == []
    assert joined.due == 103.5
    assert list(joined.tick(103.4)) == []
    assert list(joined.tick(103.5)) == [UNENDED]
    assert list(joined.feed("7", 103.6)) == ["7"]


def test_only_the_beginning_of_a_long_paste_is_held() -> None:
    joined = Joined(ANSI_SEQUENCES_KEYS)
    piece = "0123456789" * 400
    assert list(joined.feed(f"{ESC}[200~", 0.0)) == []
    for second in range(30):
        assert list(joined.feed(piece, float(second))) == []
        assert joined.paste is not None
        assert len(joined.paste) < MAX_PASTED + len(piece)
    assert list(joined.feed(f"{ESC}[20", 31.0)) == []
    (whole,) = joined.feed("1~", 31.0)
    assert whole.startswith(f"{ESC}[200~{piece}")
    assert whole.endswith(f"{ESC}[201~")
    assert len(whole) < MAX_PASTED + len(piece)


def test_a_click_requested_by_another_program_types_nothing() -> None:
    assert arrived(f"{CLICK} !!7") == ["7"]
    assert arrived(CLICK, 0.2, "7") == ["7"]


@pytest.mark.parametrize(
    ("value", "seconds"), [("", 0.3), ("25", 0.025), ("1000", 1.0), ("0", 0.001), ("-5", 0.3), ("x", 0.3), ("²", 0.3)]
)
def test_escdelay_sets_the_delay(value: str, seconds: float) -> None:
    assert delay({"ESCDELAY": value}) == delay({"ESCDELAY": value, "TERM": "xterm"}) == pytest.approx(seconds)
    assert delay({}) == ESC_SECONDS


def keys(*units: str) -> list[tuple[str, str | None]]:
    parser = XTermParser()
    return [
        (event.key, event.character)
        for unit in units
        for event in messages_of_key(parser, unit)
        if isinstance(event, events.Key)
    ]


def test_textual_turns_the_sequences_into_keys() -> None:
    assert keys(ESC, f"{ESC}[D", "7", f"{ESC}OS") == [("escape", ESC), ("left", None), ("7", "7"), ("f4", None)]
    assert keys(TORN, UNENDED) == [(TORN, None), (UNENDED, None)]
    assert keys(f"{ESC}[?1;2c", f"{ESC}[1;9z", "7") == [("7", "7")]
    assert keys(f"{ESC}x", "y") == [("alt+x", "x"), ("y", "y")]
    pasted = [
        event
        for event in messages_of_key(XTermParser(), f"{ESC}[200~1.5\r{ESC}[201~")
        if isinstance(event, events.Paste)
    ]
    assert [event.text for event in pasted] == ["1.5\r"]
