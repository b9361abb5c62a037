"""This module turns edits of a contour program into plain values for JSON and back.

What an edit puts in, a segment or a block, is the text of a program file that holds nothing else, so that a journal is
read as strictly as a file.  Parts that two programs share are recognized by identity, so that one field typed into a
thousand segments costs no more than one comparison for each.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

from app.documents.journal_file import DamagedError, Record
from core.program.file.read import loads
from core.program.file.write import dumps
from core.program.history import splice
from core.program.model import Program

Item = TypeVar("Item")


def delta(old: Program, new: Program) -> Record:
    """Return the changes that turn `old` into `new`: where tools and blocks are replaced, and the text of the new ones.

    Within one block only segments are replaced; the block in the text then holds only the new ones.
    """
    tools, blocks = splice(old.tools, new.tools), splice(old.blocks, new.blocks)
    inserted, within = blocks.new, None
    if len(blocks.old) == len(blocks.new) == 1:
        segments = splice(blocks.old[0].segments, blocks.new[0].segments)
        inserted = (replace(blocks.new[0], segments=segments.new),)
        within = [segments.at, len(segments.old)]
    return {
        "tools": [tools.at, len(tools.old)],
        "blocks": [blocks.at, len(blocks.old)],
        "segments": within,
        "text": dumps(replace(new, tools=tools.new, blocks=inserted)),
    }


def applied(program: Program, values: object) -> Program:
    """Return the program after the changes of a `delta`; raise DamagedError or StoreError if they do not fit."""
    match values:
        case {"tools": tools, "blocks": blocks, "segments": segments, "text": str(text)}:
            new = loads(text, "")
        case _:
            raise DamagedError
    if segments is not None:
        match blocks, new.blocks:
            case [int(at), 1], [block] if 0 <= at < len(program.blocks):
                replaced = _replaced(program.blocks[at].segments, segments, block.segments)
                new = replace(new, blocks=(replace(block, segments=replaced),))
            case _:
                raise DamagedError
    table = _replaced(program.tools, tools, new.tools)
    if len({tool.number for tool in table}) < len(table):
        raise DamagedError
    return replace(new, tools=table, blocks=_replaced(program.blocks, blocks, new.blocks))


def _replaced(old: tuple[Item, ...], place: object, new: tuple[Item, ...]) -> tuple[Item, ...]:
    match place:
        case [int(at), int(gone)] if 0 <= at <= at + gone <= len(old):
            return (*old[:at], *new, *old[at + gone :])
        case _:
            raise DamagedError
