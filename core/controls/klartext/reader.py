"""The reader splits Klartext program text into blocks: a head word and the words after it, each with its column.

A block is a line, or several if a line ends in `~`.  A `/` (block skip) and a block number, also as N10, may precede
the head word; a comment follows `;`.  A head word is L, CC, APPR, TOOL ...; the rest of the block, in capitals, is its
body.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Final, NamedTuple

from core.controls.control_run import Spot
from core.controls.program_text import capitals

NUMBER: Final = r"(?:[+-][ \t]*)?(?:Q[LR]?\d+|\d+[.,]?\d*|[.,]\d+)"
"""A number with a point or a comma, or a Q parameter, with or without a sign."""

_NAMES: Final = r"F[ \t]*(?:MAX|AUTO)|R[LR](?=[FM]|\s|$)|[A-PR-Z]+"
WORD: Final = re.compile(rf"({_NAMES})[ \t]*({NUMBER}|[+-])?|([^ \t])", re.ASCII)
"""A word: letters, then a number, a bare sign or nothing; or a character that belongs to no word."""

TOOL_WORD: Final = re.compile(rf"(DR2|R2(?=[+-])|{_NAMES})[ \t]*({NUMBER}|[+-])?|([^ \t])", re.ASCII)
"""The same for blocks that may have a second tool radius."""

MAX_LINE_LENGTH: Final = 1000
"""Most characters of a line; the controls take fewer."""

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
    """True if lines are Klartext: they have BEGIN PGM, or more lines of Klartext than of word addresses."""
    balance = 0
    for line in lines:
        if _BEGIN.match(line):
            return True
        balance += (_KLARTEXT.match(line) is not None) - (_WORD_ADDRESS.match(line) is not None)
    return balance > 0


class Block(NamedTuple):
    """One block: `line` from 1; `head` is "" for an empty block; the body begins at column `begin`, from 1.

    `more` holds the lines that continue it, in capitals and without comments.
    """

    line: int
    head: str
    body: str
    begin: int
    skip: bool
    more: tuple[str, ...] = ()

    @property
    def column(self) -> int:
        """The column of its head word."""
        return max(1, self.begin - len(self.head))

    def after(self, end: int) -> Block:
        """Return the block with the first `end` characters of its body blanked; the others keep their columns."""
        return self._replace(body=" " * end + self.body[end:])

    def at(self, name: str) -> Spot:
        """Return the place of the word `name`, or of the block's head if there is no such word."""
        for word in WORD.finditer(self.body) if name else ():
            if name in (joined_name(word[1] or ""), word[3], (word[1] or "") + (word[2] or "")):
                return Spot(self.line, self.begin + word.start())
        return Spot(self.line, self.column)


def read_blocks(lines: Iterable[str]) -> Iterator[Block]:
    """Yield the blocks of a program in order, without comments and empty blocks."""
    block: Block | None = None
    continued = False
    for number, raw in enumerate(lines, start=1):
        code = raw.partition(";")[0].rstrip()
        continuation, continued = continued, bool(code or continued) and (code.endswith("~") or raw.endswith("~"))
        if continuation:
            if block and len(code) > MAX_LINE_LENGTH:
                block = block._replace(head=TOO_LONG)
            elif block:
                block = block._replace(more=(*block.more, capitals(code.removesuffix("~")).strip()))
            continue
        if block:
            yield block
        block = _read_block(number, code)
    if block:
        yield block


def _read_block(number: int, code: str) -> Block | None:
    """Return the block of a line without its comment; None for an empty line."""
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
    """Return a word's name without blanks inside it: F MAX is FMAX."""
    return "".join(name.split())
