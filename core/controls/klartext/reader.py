"""Klartext program text as blocks: a head word and the words after it, each with its place.

A block is a line, or several where a line ends in `~`.  Before the head word may stand `/` (block skip) and a block
number, also as N10; after `;` comes a comment.  A head word is L, CC, APPR, TOOL ...; the rest of the block, in
capitals, is its body.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Final, NamedTuple

from core.controls.program_text import capitals

NUMBER: Final = r"(?:[+-][ \t]*)?(?:Q[LR]?\d+|\d+[.,]?\d*|[.,]\d+)"
"""A number with a point or a comma, or a Q parameter; either with a sign or without."""

_NAMES: Final = r"F[ \t]*(?:MAX|AUTO)|R[LR](?=[FM]|\s|$)|[A-PR-Z]+"
WORD: Final = re.compile(rf"({_NAMES})[ \t]*({NUMBER}|[+-])?|([^ \t])", re.ASCII)
"""A word: letters and after them a number, a bare sign or nothing; or a character that is no word."""

TOOL_WORD: Final = re.compile(rf"(DR2|R2(?=[+-])|{_NAMES})[ \t]*({NUMBER}|[+-])?|([^ \t])", re.ASCII)
"""The same where a second tool radius may stand."""

MAX_LINE_LENGTH: Final = 1000
"""Characters of a line; the controls take fewer."""

TOO_LONG: Final = "TOO LONG"
"""The head of a line that is too long to be read."""

_START: Final = re.compile(r"[ \t]*(/)?[ \t]*(?:N\d+|\d+(?=[ \t]|$|\*))?[ \t]*", re.ASCII)
_HEAD: Final = re.compile(r"[A-Z]+|[*(]|$", re.ASCII)
_GLUED_HEAD: Final = re.compile(r"(L|CC|C)(?=I?[XYZ][ \t]*[-+.\dQ])", re.ASCII)


_BEGIN: Final = re.compile(r"\s*+(?:N?[0-9]++\s++)?BEGIN\s++PGM\b", re.IGNORECASE | re.ASCII)
_KLARTEXT: Final = re.compile(
    r"[\s/]*+(?:N?[0-9]++\s++)?(?:L\s*+(?=I?[XYZ]\s*+[-+.\dQ]|[RFM])|(?:LP|CP|CTP)\s++[IP]|(?:CC|CR|CT|C|APPR|DEP)\s++[A-Z]"
    r"|TOOL\s++(?:CALL|DEF)|BLK\s++FORM|CYCL\s++(?:DEF|CALL)|(?:CALL\s++)?LBL\s|FN\s*+[0-9]++\s*+:|(?:RND|CHF)\s*+R?[0-9])",
    re.IGNORECASE | re.ASCII,
)
_WORD_ADDRESS: Final = re.compile(r"[\s/]*+(?:N\s*+[0-9]++)?\s*+[GXYZO]\s*+[-+.#\[0-9]", re.IGNORECASE | re.ASCII)


def is_klartext_text(lines: Iterable[str]) -> bool:
    """Whether lines are Klartext: they begin a program of it, or, as a piece of one, have more of its blocks."""
    more = 0
    for line in lines:
        if _BEGIN.match(line):
            return True
        more += (_KLARTEXT.match(line) is not None) - (_WORD_ADDRESS.match(line) is not None)
    return more > 0


class Block(NamedTuple):
    """One block: `line` from 1; `head` is "" for an empty block; the body's first character is at `column` (from 1).

    `more` are the lines that continue it, in capitals and without comments.
    """

    line: int
    head: str
    body: str
    column: int
    skip: bool
    more: tuple[str, ...] = ()

    @property
    def start(self) -> int:
        """The column of its head word."""
        return max(1, self.column - len(self.head))

    def after(self, end: int) -> Block:
        """The block with the first `end` characters of its body blanked, every other one in its place."""
        return self._replace(body=" " * end + self.body[end:])

    def column_of(self, name: str) -> int:
        """Where the word `name` stands; the start of the block if there is no such word."""
        for word in WORD.finditer(self.body) if name else ():
            if name in (joined_name(word[1] or ""), word[3], (word[1] or "") + (word[2] or "")):
                return self.column + word.start()
        return self.start


def read_blocks(lines: Iterable[str]) -> Iterator[Block]:
    """The blocks of a program in order, without comments and empty blocks."""
    block: Block | None = None
    continued = False
    for number, raw in enumerate(lines, start=1):
        code = raw.partition(";")[0].rstrip()
        continuation, continued = continued, code.endswith("~") or raw.endswith("~")
        if continuation:
            if block and len(code) <= MAX_LINE_LENGTH:
                block = block._replace(more=(*block.more, capitals(code.removesuffix("~")).strip()))
            continue
        if block:
            yield block
        block = _read_block(number, code)
    if block:
        yield block


def _read_block(number: int, code: str) -> Block | None:
    """The block of a line without its comment, None for an empty one."""
    if len(code) > MAX_LINE_LENGTH:
        return Block(number, TOO_LONG, "", 1, skip=False)
    block = _block(number, capitals(code.removesuffix("~"))) if code else None
    return block if block and block.head else None


def _block(number: int, code: str) -> Block:
    start = _START.match(code)
    begin = start.end() if start else 0
    head = _GLUED_HEAD.match(code, begin) or _HEAD.match(code, begin)
    skip = bool(start and start[1])
    if head is None:
        return Block(number, code[begin], code[begin + 1 :], begin + 2, skip)
    return Block(number, head[0], code[head.end() :], head.end() + 1, skip)


def joined_name(name: str) -> str:
    """A word's name without blanks inside it: F MAX is FMAX."""
    return "".join(name.split())
