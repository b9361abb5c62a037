"""This module reads a line of a word-address program into blocks of words and numbers, each with its column.

G and M codes are counted in tenths, so that G41.1 is 411 and M6 is 60.  Two regular expressions read a line of nothing
but words; only a line with anything else, such as comments or errors, is examined more closely.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from math import inf
from typing import Final

from core.controls.control_run import Log, Spot
from core.controls.iso.code_support import CONTROLS_WITH_EXPRESSIONS, CONTROLS_WITH_JUMPS, only_on
from core.controls.iso.expressions import (
    COMMENT_GAP,
    POLAR,
    POLAR_TEXT,
    STRICT_N,
    CompactText,
    MacroParameters,
    Word,
    evaluated_line,
    not_a_word,
)
from core.controls.program_text import capitals, quoted
from core.tolerance import LARGEST_COORDINATE

NUMBER: Final = r"[-+]?(?:[0-9]++(?:\.[0-9]*+)?|\.[0-9]++)"
"""The pattern of a word's number."""

_CLEAN: Final = re.compile(rf"(?:[ \t]*+[A-Z][ \t]*+{NUMBER})*[ \t]*+")
_PAIR: Final = re.compile(rf"([A-Z])[ \t]*+({NUMBER})")
_DATA: Final = re.compile(rf"T[ \t]*+([0-9]++)[ \t]*+/[ \t]*+({NUMBER})?[ \t]*+/[ \t]*+({NUMBER})?")

_BRANCH: Final = re.compile(
    r"[ \t]*+(?:N[ \t]*+[0-9]++)?[ \t]*+(IF|WHILE|GOTO|DO|END(?:IF|WHILE)?|THEN|ELSE)(?=[ \t]*+(?:[\[0-9#]|$))"
)
_EXPRESSION: Final = re.compile(r"[#\[]|[-+][ \t]*+[-+]")
_NESTED: Final = re.compile(r"^[^;(]*+\([^()]*+\(")

INTEGER_TOLERANCE: Final = 1e-4
"""How far a code, in tenths, or a tool number may be from a whole number and still be one."""


LONGEST_STRICT: Final = 252
"""The longest line, without its end, that LinuxCNC's interpreter reads (tried with rs274)."""

COMPENSATION_CODES: Final = frozenset((410, 420, 411, 421))
"""The codes that turn compensation on."""


@dataclass(frozen=True, slots=True)
class Syntax:
    """How a control writes blocks."""

    semicolon_ends: bool = False
    """A semicolon ends a block instead of beginning a comment."""
    tool_data: bool = False
    """Slashes separate tool data, as in T4/.75/.2."""
    corners: bool = False
    """The control has `,R` and `,C`, which cutcomp does not follow."""
    strict: bool = False
    """Blanks have no meaning anywhere, N comes first without a decimal point, lines have at most LONGEST_STRICT
    characters, no byte order mark."""


@dataclass(frozen=True, slots=True)
class ToolData:
    """Tool data in the program: T number / length / diameter; what is left out stays as it is."""

    number: int
    length: float | None
    diameter: float | None


@dataclass(eq=False, slots=True)
class Block:
    """One block: its words' values by letter, and its G and M codes in tenths, as written.

    `start` is the column, less one, at which the block begins on its line; `evaluated` are its words if they have
    values of expressions.  `corner` is its `,R` or `,C` with the value.
    """

    line: int
    text: str
    start: int = 0
    words: dict[str, float] = field(default_factory=dict)
    g: list[int] = field(default_factory=list)
    m: list[int] = field(default_factory=list)
    data: ToolData | None = None
    evaluated: Sequence[Word] = ()
    corner: tuple[str, float] | None = None

    def written(self) -> Sequence[Word]:
        """Return the block's words in the order written, repeated letters included."""
        if self.evaluated:
            return self.evaluated
        pairs = _PAIR.finditer(without_comments(capitals(self.text)))
        return [Word(pair[1], pair[2], self.start + pair.start() + 1) for pair in pairs]

    @property
    def column(self) -> int:
        """The column, from 1, at which the block begins."""
        return self.start + 1

    def at(self, letters: str, code: int | None = None) -> Spot:
        """Return the place of the first word with one of these letters and, if given, `code` in tenths."""
        for letter, number, column in self.written():
            if letter in letters and (code is None or tenths(float(number)) == code):
                return Spot(self.line, column)
        return Spot(self.line, self.column)

    def at_side(self) -> Spot:
        """Return the place of the code that turns compensation on."""
        return self.at("G", next((code for code in self.g if code in COMPENSATION_CODES), None))


def tenths(value: float) -> int | None:
    """Return a code in tenths, None if the number is not a code."""
    if not 0.0 <= value < 1e5:
        return None
    code = round(value * 10)
    return code if abs(code - value * 10) < INTEGER_TOLERANCE else None


def whole(value: float) -> int | None:
    """Return a value as a whole number, None if it is not one."""
    number = round(value)
    return number if abs(number - value) < INTEGER_TOLERANCE else None


def whole_word(
    block: Block, letter: str, log: Log, rule: str, text: str, least: int = 0, most: float = inf, default: float = -1.0
) -> int:  # fmt: skip
    """Return the value of a word that must be a whole number within limits; any other stops the run."""
    number = whole(block.words.get(letter, default))
    if number is None or not least <= number <= most:
        log.stop(rule, text, block.at(letter))
    return number


def is_words(bare: str) -> bool:
    """True if a line, in capitals and without comments, has nothing but letters with numbers."""
    return _CLEAN.fullmatch(bare) is not None


PLAIN_SYNTAX: Final = Syntax()


def read_line(
    text: str, line: int, log: Log, syntax: Syntax = PLAIN_SYNTAX, values: MacroParameters | None = None
) -> list[Block]:  # fmt: skip
    """Return the blocks of one line, none of an empty one; what cannot be read stops the run at its column.

    With `values`, expressions are evaluated and parameters are set.
    """
    upper = capitals(text)
    if COMMENT_GAP in text:
        log.stop("WORD", not_a_word(COMMENT_GAP), Spot(line, text.index(COMMENT_GAP) + 1))
    if syntax.strict:
        _check_strictly(upper, line, log)
    if _CLEAN.fullmatch(upper):
        return [fill_words(Block(line, text), pairs_in(upper), log)] if upper and not upper.isspace() else []
    if syntax.semicolon_ends and ";" in upper:
        return list(_pieces(text, line, log, syntax))
    return _read_closely(Block(line, text), without_comments(upper), log, syntax, values)


def check_length(text: str, line: int, log: Log) -> None:
    """Stop the run at a line that is too long for a strict control."""
    if len(text) > LONGEST_STRICT:
        message = f"The line has more than {LONGEST_STRICT} characters, which this control does not read. Shorten it."
        log.stop("WORD", message, Spot(line, LONGEST_STRICT + 1))


def _check_strictly(upper: str, line: int, log: Log) -> None:
    """Stop the run at a line whose N does not come first, or whose block number ends with a point."""
    bare = without_comments(upper)
    words = bare.removeprefix("/").replace(" ", "").replace("\t", "")
    if "N" not in words or not _CLEAN.fullmatch(words):
        return
    pairs = _PAIR.findall(words)
    first, count = pairs[0][0], sum(letter == "N" for letter, _ in pairs)
    if count == 1 and (first != "N" or pairs[0][1].endswith(".")):
        log.stop("WORD", STRICT_N, Spot(line, bare.index("N") + 1))


def _pieces(text: str, line: int, log: Log, syntax: Syntax) -> Iterator[Block]:
    """Yield the blocks between semicolons; report and skip text after the last semicolon that is not a block."""
    for start, part in between_semicolons(text):
        bare = without_comments(capitals(part))
        plain = _CLEAN.fullmatch(bare) is not None
        if plain or start + len(part) < len(text):
            yield from _read_closely(Block(line, part, start), bare, log, syntax)
        else:
            place = Spot(line, start + 1 + len(part) - len(part.lstrip()))
            log.inform("TEXT", f"Text after the end of the block is ignored: {quoted(part)}", place)


def between_semicolons(line: str) -> Iterator[tuple[int, str]]:
    """Yield where each part of a line between semicolons outside comments begins, and the part."""
    start, in_comment = 0, False
    for index, character in enumerate(line if ";" in line else ""):
        if character in "()":
            in_comment = character == "("
        elif character == ";" and not in_comment:
            yield start, line[start:index]
            start = index + 1
    if start < len(line) or not start:
        yield start, line[start:]


def _read_closely(
    block: Block, bare: str, log: Log, syntax: Syntax, values: MacroParameters | None = None
) -> list[Block]:  # fmt: skip
    """Return the block of a line with more than words, such as tool data, a block skip, a percent sign, expressions."""
    if syntax.tool_data and (data := _DATA.search(bare)):
        length, diameter = (None if part is None else float(part) for part in (data[2], data[3]))
        block.data = ToolData(int(data[1][:9]), length, diameter)
        bare = bare[: data.start()] + " " * len(data[0]) + bare[data.end() :]
    if syntax.strict and block.text.count("(") > 1:
        _without_blanks(block, log)
    if bare.lstrip().startswith("/"):
        log.inform("SKIP", "Block skip is assumed off, so this block runs.", block)
        bare = bare.replace("/", " ", 1)
    if not bare.strip() or bare.strip() == "%":
        return [block] if block.data else []
    if branch := _BRANCH.match(bare):
        others = only_on(CONTROLS_WITH_JUMPS)
        text = f"cutcomp follows no {branch[1]} on this control. Write the blocks out as they run. {others}"
        log.stop("BRANCH", text, Spot(block.line, block.start + branch.start(1) + 1))
    if values is not None and _EXPRESSION.search(bare):
        return _evaluated_block(block, log, values)
    if _CLEAN.fullmatch(bare) is None:
        squeezed = _without_blanks(block, log) if syntax.strict else ""
        if not squeezed or _CLEAN.fullmatch(squeezed) is None:
            _fault(block, bare, log, syntax)
        block.text = bare = squeezed
    return [fill_words(block, pairs_in(bare), log)]


def _evaluated_block(block: Block, log: Log, values: MacroParameters) -> list[Block]:
    """Return the block of a line with parameters or expressions; none if the line only sets parameters."""
    marked = without_comments(capitals(block.text), COMMENT_GAP)
    skip = len(marked) - len(marked.lstrip()) + 1 if marked.lstrip().startswith("/") else 0
    block.evaluated = evaluated_line(CompactText.of(marked[skip:], block.line, block.start + skip), values, log)
    return [fill_words(block, block.evaluated, log)] if block.evaluated else []


def _without_blanks(block: Block, log: Log) -> str:
    """Return the text of a block without its blanks; only a comment still separates words."""
    nested = _NESTED.search(block.text)
    if nested:
        text = "A comment begins inside a comment; close the first one."
        log.stop("COMMENT", text, Spot(block.line, block.start + nested.end()))
    bare = without_comments(capitals(block.text), COMMENT_GAP)
    return bare.replace(" ", "").replace("\t", "").replace(COMMENT_GAP, " ")


def pairs_in(upper: str) -> list[tuple[str, str]]:
    """Return the letters and numbers of a text in capitals that has nothing else."""
    return _PAIR.findall(upper)


def fill_words(
    block: Block, pairs: Iterable[tuple[str, str] | Word], log: Log, *, last_counts: bool = False
) -> Block:  # fmt: skip
    """Fill a block with letters and their numbers, and return it.

    With `last_counts`, the last of two words with the same letter counts, with a warning; else they stop the run.
    """
    words = block.words
    for letter, number, *_ in pairs:
        if letter in "GM":
            code = tenths(float(number))
            if code is None:
                place = block.at(letter)
                log.stop("CODE", f"{letter}{quoted(number)} is not a code of any control.", place)
            (block.g if letter == "G" else block.m).append(code)
            continue
        if letter in words and not (letter in "IJK" and last_counts and not {650, 660, 661}.isdisjoint(block.g)):
            place = Spot(block.line, [word.column for word in block.written() if word.letter == letter][1])
            if not last_counts:
                log.stop("TWICE", f"{letter} is written twice in this block; keep one.", place)
            log.warn("TWICE", f"{letter} is written twice in this block; the control takes the last one.", place)
        words[letter] = value = float(number)
        if not -LARGEST_COORDINATE < value < LARGEST_COORDINATE:
            text = f"{letter}{quoted(number)} is too large: no machine goes beyond {LARGEST_COORDINATE:,.0f}."
            log.stop("NUMBER", text, block.at(letter))
    return block


def _fault(block: Block, bare: str, log: Log, syntax: Syntax) -> None:
    """Stop the run at the first character that belongs to no word."""
    clean = _CLEAN.match(bare)
    at = clean.end() if clean else 0
    at += len(bare[at:]) - len(bare[at:].lstrip(" \t"))
    rest, place = block.text[at:], Spot(block.line, block.start + at + 1)
    if rest and not rest[0].isprintable():
        log.stop("WORD", not_a_word(rest), place)
    if rest.startswith(",") and rest[1:2].isdigit():
        log.stop("WORD", "A comma is no decimal point here. Write a point.", place)
    if syntax.corners and rest.startswith(","):
        log.stop("BEYOND", f"cutcomp does not follow {quoted(rest)} on this control. Write the corner's moves.", place)
    if syntax.strict and rest[:1] in POLAR:
        log.stop("BEYOND", POLAR_TEXT, place)
    if rest.startswith("("):
        log.stop("COMMENT", "The comment is not closed; write the closing bracket.", place)
    if rest.startswith("/"):
        text = "cutcomp takes / only at the beginning of a block on this control. Move it there, or remove it."
        log.stop("WORD", text, place)
    if block.text.lstrip().startswith("/") and rest[:1].isdigit():
        log.stop("WORD", "cutcomp knows no block skip with a number on this control. Write / alone.", place)
    if any(character in rest[:80] for character in "#[<="):
        text = f"{quoted(rest)} is an expression; cutcomp evaluates none for this control. Write the number."
        log.stop("MACRO", f"{text} {only_on(CONTROLS_WITH_EXPRESSIONS)}", place)
    log.stop("WORD", not_a_word(rest), place)


_WORD_ANYWHERE: Final = re.compile(r"[A-Za-z][ \t]*+[-+]?[0-9.#\[<]")


def has_words(line: str) -> bool:
    """True if a line has a word, a letter with a number, outside its comments."""
    return _WORD_ANYWHERE.search(without_comments(line)) is not None


def without_comments(upper: str, fill: str = " ") -> str:
    """Return a line with its comments blanked out and every other character in its place."""
    if "(" not in upper and ";" not in upper:
        return upper
    out, at = [], 0
    while at < len(upper):
        opened, ended = upper.find("(", at), upper.find(";", at)
        if ended >= 0 and (opened < 0 or ended < opened):
            out.append(upper[at:ended].ljust(len(upper) - at, fill))
            return "".join(out)
        closed = upper.find(")", opened) if opened >= 0 else -1
        if closed < 0:
            break
        out.append(upper[at:opened].ljust(closed + 1 - at, fill))
        at = closed + 1
    return "".join((*out, upper[at:]))
