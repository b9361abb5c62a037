"""Lines with parameters and expressions: worked out to words that are numbers, each with its place."""

from __future__ import annotations

from typing import Final, NamedTuple

from core.controls.control_run import Log
from core.controls.iso.expressions import Reader
from core.controls.iso.parameters import FaultError, Parameters
from core.controls.program_text import quoted
from core.finding import Severity

_DIGITS: Final = frozenset("0123456789")

GAP: Final = "\x01"
"""Stands where a comment was: words may be parted by it, numbers not."""


class Squeezed(NamedTuple):
    """A text in capitals without blanks, and the column less one of each of its signs."""

    text: str
    columns: tuple[int, ...]

    @staticmethod
    def of(text: str, start: int = 0) -> Squeezed:
        """The text without blanks; `start` is where it begins on its line."""
        kept = [(sign, start + index) for index, sign in enumerate(text) if sign not in " \t"]
        return Squeezed("".join(sign for sign, _ in kept), tuple(column for _, column in kept))

    def column(self, at: int) -> int:
        """The column of a place in the text, from 1; behind its end that of its last sign."""
        return self.columns[min(at, len(self.columns) - 1)] + 1 if self.columns else 1


class WorkedOut(NamedTuple):
    """The words of a line as plain text, and the column of each."""

    text: str
    columns: tuple[int, ...]


def worked_out(line: Squeezed, number: int, values: Parameters, log: Log) -> WorkedOut:
    """Works a line out and then sets what it sets; what cannot be worked out stops the run at its place."""
    reader = Reader(line.text, values)
    words: list[str] = []
    columns: list[int] = []
    settings: list[tuple[int | str, float]] = []
    try:
        while reader.at < len(line.text):
            _item(reader, line, words, columns, settings)
    except FaultError as fault:
        log.stop(fault.code, fault.text, number, line.column(fault.at))
    tell_unset(reader, line, number, log)
    for key, value in settings:
        values.set(key, value)
    return WorkedOut(" ".join(words), tuple(columns))


def _item(
    reader: Reader, line: Squeezed, words: list[str], columns: list[int], settings: list[tuple[int | str, float]]
) -> None:  # fmt: skip
    """One word, or one setting of a parameter."""
    begin, text = reader.at, line.text
    sign = text[begin]
    if sign == GAP:
        reader.at += 1
    elif sign == "#":
        settings.append(_setting(reader))
    elif sign == "N" and text[begin + 1 : begin + 2] not in _DIGITS:
        raise FaultError("WORD", "A block number is plain digits.", begin)
    elif "A" <= sign <= "Z":
        reader.at += 1
        words.append(f"{sign}{plain(reader.value())}")
        columns.append(line.columns[begin] + 1)
    else:
        raise FaultError("WORD", f"{quoted(text[begin:])} is not understood; a word is a letter and a value.", begin)


def _setting(reader: Reader) -> tuple[int | str, float]:
    begin, key = reader.at, reader.key()
    if reader.text[reader.at : reader.at + 1] != "=":
        raise FaultError("WORD", "This value has no letter before it, and no = behind it that would set it.", begin)
    reader.values.settable(key, begin)
    reader.at += 1
    return key, reader.value()


def tell_unset(reader: Reader, line: Squeezed, number: int, log: Log) -> None:
    """Tells of parameters that were read before anything set them."""
    for index, at in reader.unset:
        text = f"#{index} is not set by the program; it is taken as 0, and the control may keep another value in it."
        log.tell(Severity.WARNING, "PARAMETER", text, number, line.column(at))


def plain(value: float) -> str:
    """A value as a number without exponent."""
    return f"{value:.12f}".rstrip("0").rstrip(".")
