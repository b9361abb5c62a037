"""Every form of a locale name, through a real pseudo-terminal: only characters of its set are written."""

from __future__ import annotations

import re

import pytest

from app.terminal.capabilities import charset, operators_environment
from tests.reports.matrix import stray
from tests.terminal import cutcomp, running

PROGRAM = cutcomp("--example", "pocket")
BRAILLE = re.compile("[\u2801-\u28ff]")
NONE = {"LANG": None}
"""No locale variable at all."""


@pytest.mark.parametrize(
    ("locale", "characters"),
    [
        (NONE, "ascii"),
        # this one is not installed: Python treats it as C
        ({"LANG": "C", "LC_CTYPE": "de_DE.ISO-8859-1"}, "latin-1"),
        ({**NONE, "LC_CTYPE": "UTF-8"}, "utf-8"),
    ],
    ids=str,
)
def test_the_drawing_uses_the_characters_of_the_locale(locale: dict[str, str | None], characters: str) -> None:
    with running(PROGRAM, environment=locale) as terminal:
        terminal.until("GOUGE none", longest=30.0)
        terminal.read(quiet=0.3)
        assert stray(bytes(terminal.seen), characters) == ""
        assert bool(BRAILLE.search(terminal.text)) == (characters == "utf-8")
        assert "|" in terminal.text or characters == "utf-8"
        if characters == "utf-8":
            return
        assert terminal.seen.isascii()
        terminal.send(b"\x1b[18~\x1b[17~")
        terminal.until("LANG or TERM says that there is no UTF-8")


def test_a_letter_of_latin_1_is_written_and_read_as_one_byte() -> None:
    with running(PROGRAM, environment={"LANG": "de_DE.ISO-8859-1"}) as terminal:
        terminal.stream.select_other_charset("@")
        terminal.until("GOUGE none", longest=30.0)
        terminal.send(b"\x13")
        terminal.until("SAVE")
        terminal.send(b"\xfc\xb0")
        terminal.until("ü°")
        assert b"\xfc" in terminal.seen


@pytest.mark.parametrize(
    ("environment", "started", "name"),
    [
        ({"LC_CTYPE": "C.UTF-8", "LANG": "C"}, {"LANG": "C"}, "ascii"),
        ({"LANG": "C.UTF-8", "LC_ALL": "C"}, {"LANG": "C.UTF-8", "LC_ALL": "C"}, "ascii"),
        ({"LC_CTYPE": "C.UTF-8", "LANG": "C.UTF-8"}, {"LC_CTYPE": "POSIX", "LANG": "C.UTF-8"}, "ascii"),
        ({"LANG": "C.UTF-8", "LC_ALL": "de_DE@euro"}, {"LANG": "C.UTF-8", "LC_ALL": "de_DE@euro"}, "iso8859-1"),
        ({"LANG": "xx_YY.UTF-8"}, {"LANG": "xx_YY.UTF-8"}, "utf-8"),
        ({"LC_CTYPE": "C.UTF-8", "LANG": "C"}, {"LANG": "C", "LC_CTYPE": "C.UTF-8"}, "utf-8"),
        ({"LC_CTYPE": "C.UTF-8"}, {"LC_CTYPE": "UTF-8"}, "utf-8"),
        ({"LC_CTYPE": "C.UTF-8", "LANG": "de_DE.ISO-8859-1"}, {}, "iso8859-1"),
        ({"LC_CTYPE": "C.UTF-8", "LANG": "C", "LC_ALL": "C.UTF-8"}, {}, "utf-8"),
        # a system that does not reveal the environment at the start
        ({"LC_CTYPE": "C.UTF-8", "LANG": "C"}, None, "ascii"),
        ({"LC_CTYPE": "C.utf8", "LANG": "en_US.UTF-8"}, None, "utf-8"),
        ({"LC_CTYPE": "UTF-8"}, None, "utf-8"),
        ({"LC_CTYPE": "C.UTF-8", "LANG": "C", "PYTHONCOERCECLOCALE": "0"}, None, "utf-8"),
    ],
)
def test_an_lc_ctype_set_by_python_is_ignored(
    environment: dict[str, str], started: dict[str, str] | None, name: str
) -> None:
    assert charset(operators_environment(environment, lambda: started)) == name
