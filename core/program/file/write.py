"""This module writes a program as the text of its file: only what was typed, in the order of the screens."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Final

from core.program.fields import STORED_FIELDS, Form, form_of
from core.program.model import (
    Block,
    ChamferSegment,
    Number,
    PartSetup,
    Program,
    ProgramParameters,
    Relative,
    Segment,
    Tool,
    Unread,
)
from core.units import Kind

FILE_FORMAT: Final = 1
"""The program file format that every version reads."""

NEWER_FORMAT: Final = 2
"""The format of files that need anything format 1 does not have."""

NEWER_KEYS: Final = frozenset(
    ("tangent", "start_angle", "point_x", "point_y", "point_dist", "parallel", "offset", "pick_x", "pick_y")
)
"""The segment keys that format 1 does not have, besides relative numbers and a `choice` above 1."""

RELATIVE_SUFFIX: Final = "_inc"
"""The suffix of the key of a relative number."""

PROPOSAL_KEYS: Final = ("speed", "feed", "plunge_feed", "coolant")
"""The keys of a tool that format 1 does not have."""

BLOCK_KIND: Final = "MILL CONTOUR"

UNREAD_TABLE: Final = "unread"
"""The table of typed texts that could not be read."""

LAST_LINE: Final = "# end of program"

LAST_LINE_NOTICE: Final = f'# its last line is "{LAST_LINE}"'
"""The comment on the first line, by which a truncated file is recognized."""


def dumps(program: Program) -> str:
    """Return the text of a program's file."""
    lines = [
        f"format = {format_of(program)}  {LAST_LINE_NOTICE}",
        f'units = "{program.unit}"  # every length and feed below is in it',
    ]
    lines += _table("[parameters]", "parameters", Form.PARAMETERS, program.parameters)
    lines += _table("[setup]", "setup", Form.SETUP, program.setup)
    for tool in program.tools:
        lines += _table("[[tool]]", "tool", Form.TOOL, tool)
    for block in program.blocks:
        lines += _table("[[block]]", "block", Form.START, block, BLOCK_KIND)
        for segment in block.segments:
            form = form_of(segment)
            lines += _table("[[block.segment]]", "block.segment", form, segment, form.value)
    return "\n".join((*lines, "", LAST_LINE)) + "\n"


def format_of(program: Program) -> int:
    """Return the format a program needs: 2 if it has anything that format 1 does not have."""
    segments = (segment for block in program.blocks for segment in block.segments)
    newer = any(map(_is_newer, segments)) or any(block.coolant is not None for block in program.blocks)
    newer = newer or any(getattr(tool, name) is not None for tool in program.tools for name in PROPOSAL_KEYS)
    return NEWER_FORMAT if newer else FILE_FORMAT


def _is_newer(segment: Segment) -> bool:
    if isinstance(segment, ChamferSegment):
        return True
    typed = {name: getattr(segment, name) for name in segment.__match_args__}
    newer = any(value not in (None, False) for name, value in typed.items() if name in NEWER_KEYS)
    return newer or (typed.get("choice") or 0) > 1 or any(isinstance(value, Relative) for value in typed.values())


Typable = ProgramParameters | PartSetup | Tool | Block | Segment


def _table(header: str, name: str, form: Form, part: Typable, kind: str | None = None) -> list[str]:
    """Return the lines of a table with its header, followed by the table of its unread texts."""
    keys = [] if kind is None else [f'kind = "{kind}"']
    keys += _keys(form, part)
    unread = [f"{key} = {_quoted(text)}" for key, text in _unread(form, part)]
    if unread:
        unread = ["", f"[{name}.{UNREAD_TABLE}]", *unread]
    bare = header.startswith("[[") or keys or unread
    return ["", header, *keys, *unread] if bare else []


def _keys(form: Form, part: Typable) -> Iterator[str]:
    for field in STORED_FIELDS[form]:
        value = getattr(part, field.name)
        if isinstance(value, Number):
            yield f"{field.name} = {_number(value.value, field.kind)}"
        elif isinstance(value, Relative):
            yield f"{field.name}{RELATIVE_SUFFIX} = {_number(value.value, field.kind)}"
        elif isinstance(value, bool):
            if value:
                yield f"{field.name} = true"
        elif isinstance(value, int | str) and (field.name, value) != ("name", ""):
            yield f"{field.name} = {_quoted(value) if isinstance(value, str) else value}"
    choice = getattr(part, "choice", None)
    if choice is not None:
        yield f"choice = {choice}"


def _unread(form: Form, part: Typable) -> Iterator[tuple[str, str]]:
    for field in STORED_FIELDS[form]:
        value = getattr(part, field.name)
        if isinstance(value, Unread):
            yield field.name, value.text


def _number(value: float, kind: Kind) -> str:
    """Format a number as the shortest text that reads back as the same number."""
    whole = kind is Kind.COUNT and value == int(value)
    return str(int(value)) if whole else repr(float(value) + 0.0)


def _quoted(text: str) -> str:
    """Format a TOML basic string; lone surrogates, which no file can hold, become question marks."""
    whole = str(text).encode("utf-8", "replace").decode("utf-8")
    return json.dumps(whole, ensure_ascii=False).replace("\x7f", "\\u007f")
