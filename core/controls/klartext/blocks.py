"""Klartext program text as blocks: one head word and the words behind it, each with its place.

A block is a line, or several where a line ends in `~`.  In front of the head word may stand `/` (block skip)
and a block number; behind `;` stands a comment.  A head word is L, CC, APPR, TOOL ...; the rest of the block,
upper-cased, is its body.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Final, NamedTuple

NUMBER: Final = r"[+-]?(?:Q[LR]?\d+|\d+[.,]?\d*|[.,]\d+)"
"""A number with a point or a comma, or a Q parameter; either with a sign or without."""

_NAMES: Final = r"F[ \t]*(?:MAX|AUTO)|R[LR](?=[FM]|\s|$)|[A-PR-Z]+"
WORD: Final = re.compile(rf"({_NAMES})[ \t]*({NUMBER}|[+-])?|([^ \t])", re.ASCII)
"""A word: letters with a number, a bare sign or nothing behind them; or a sign that is no word."""

TOOL_WORD: Final = re.compile(rf"(DR2|R2(?=[+-])|{_NAMES})[ \t]*({NUMBER}|[+-])?|([^ \t])", re.ASCII)
"""The same where a second tool radius may stand."""

LONGEST: Final = 1000
"""Signs a line may have; the controls take fewer."""

TOO_LONG: Final = "TOO LONG"
"""The head of a block that is not read for its length."""

_START: Final = re.compile(r"[ \t]*(/)?[ \t]*(?:\d+(?=[ \t]|$|\*))?[ \t]*", re.ASCII)
_HEAD: Final = re.compile(r"[A-Z]+|\*|$", re.ASCII)
_GLUED: Final = re.compile(r"(L|CC|C)(?=I?[XYZ][ \t]*[-+.\dQ])", re.ASCII)


class Block(NamedTuple):
    """One block: `line` from 1; `head` is "" for an empty block; the body's first sign is at `column` (from 1)."""

    line: int
    head: str
    body: str
    column: int
    skip: bool


@dataclass(frozen=True, slots=True)
class Place:
    """A line and a column of the program, both from 1."""

    line: int
    column: int


def blocks(lines: Iterable[str]) -> Iterator[Block]:
    """The blocks of a program in order, comments and continuation lines folded away, empty ones left out."""
    continued = False
    for number, raw in enumerate(lines, start=1):
        code = raw.partition(";")[0].rstrip()
        folded, continued = continued, code.endswith("~") or raw.endswith("~")
        if len(code) > LONGEST:
            yield Block(number, TOO_LONG, "", 1, skip=False)
        elif code and not folded:
            block = _block(number, _capitals(code.removesuffix("~")))
            if block.head:
                yield block


def _capitals(code: str) -> str:
    """A line in capitals, sign for sign: only the plain letters, lest another sign turns into one of them."""
    if code.isascii():
        return code.upper()
    return "".join(one.upper() if one.isascii() else one for one in code)


def _block(number: int, code: str) -> Block:
    start = _START.match(code)
    begin = start.end() if start else 0
    found = _GLUED.match(code, begin) or _HEAD.match(code, begin)
    skip = bool(start and start[1])
    if found is None:
        return Block(number, code[begin], code[begin:], begin + 1, skip)
    return Block(number, found[0], code[found.end() :], found.end() + 1, skip)


def place(block: Block, name: str) -> Place:
    """Where the word `name` stands in the block; the block's head if it is not among its words."""
    for found in WORD.finditer(block.body):
        if name in (together(found[1] or ""), found[3], (found[1] or "") + (found[2] or "")):
            return Place(block.line, block.column + found.start())
    return head_place(block)


def together(name: str) -> str:
    """A word's name without blanks inside it: F MAX is FMAX."""
    return "".join(name.split())


def head_place(block: Block) -> Place:
    """Where the block's head word stands."""
    return Place(block.line, max(1, block.column - len(block.head)))
