"""This module reads the text of a program file strictly: it refuses an unknown key or a wrong type by line and key.

Numbers outside a field's range are kept: the form shows them and they block posting.  A look-ahead outside its range
is refused, since the form never holds one.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Final, TypeVar

from core.program.fields import (
    FIELDS_OF_FORM,
    MAX_CHOICE,
    NUMBER_FIELDS,
    SEGMENT_FORMS,
    STORED_FIELDS,
    Field,
    Form,
    field_of,
    unread_reason,
    value_refusal,
)
from core.program.file.faults import KeyPath, key_lines, line_of, syntax_fault, truncation
from core.program.file.write import BLOCK_KIND, FILE_FORMAT, NEWER_FORMAT, RELATIVE_SUFFIX, UNREAD_TABLE
from core.program.model import (
    ArcSegment,
    Block,
    LineSegment,
    Number,
    PartSetup,
    Program,
    ProgramParameters,
    Relative,
    Segment,
    Tool,
    Typed,
    Unread,
)
from core.tolerance import LARGEST_COORDINATE
from core.units import Kind, Unit, printable, to_mm

REQUIRED_CHOICES: Final = ("cutter_comp", "direction")
"""The choices that a file must have."""

_BARE: Final = re.compile(r"[+-]?\d+(\.\d+)?")
"""A number that needs no quotes in a file."""


class StoreError(Exception):
    """A program file cannot be read or written; `text` says which file, where, and what to do."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.text = text


@dataclass(frozen=True, slots=True)
class _Table:
    """One table of the file, with its path."""

    file: str
    lines: Callable[[], Mapping[KeyPath, int]]
    """Called at the first fault: a file without faults needs no line numbers."""
    path: KeyPath
    data: Mapping[str, Any]
    unit: Unit

    def fault(self, key: str | None, text: str) -> StoreError:
        """Return an error at a key, or at the table itself."""
        line = line_of(self.lines(), self.path if key is None else (*self.path, key))
        return StoreError(f"{self.file}, line {line}: {text}")

    def only(self, allowed: tuple[str, ...]) -> None:
        """Refuse keys that this table does not have."""
        if self.data.keys() <= set(allowed):
            return
        from difflib import get_close_matches

        for key in self.data:
            if key not in allowed:
                near = get_close_matches(key, allowed, 1)
                hint = f"did you mean {near[0]}?" if near else "remove it."
                raise self.fault(key, f"{printable(key)} is not a key of {self.title()}: {hint}")

    def title(self) -> str:
        """Name this table for a message."""
        names = [part for part in self.path if isinstance(part, str)]
        return f"[{'.'.join(names)}]" if names else "the program"

    def text(self, key: str) -> str:
        """Return a text; raise an error if it is missing or is not printable text."""
        value = self.data.get(key)
        if isinstance(value, str) and value.isprintable():
            return value
        what = "is missing" if value is None else "must be text in quotes on one line"
        raise self.fault(key, f"{key} {what}.")

    def chosen(self, key: str, choices: tuple[Choice, ...]) -> Choice:
        """Return one of the choices; raise an error for any other value."""
        value = self.data.get(key)
        chosen = next((choice for choice in choices if choice == value), None)
        if chosen is None:
            what = "is missing" if value is None else f"cannot be {_written(value)}"
            raise self.fault(key, f"{key} {what}: write one of {', '.join(choices)}, in quotes.")
        return chosen

    def number(self, key: str, field: Field) -> float:
        """Return a number; raise an error if the field cannot hold it."""
        value = self.data[key]
        if isinstance(value, str):
            mended = ": take the quotes away" if _BARE.fullmatch(value) else ""
            raise self.fault(key, f"{key} must be a number, and {printable(value)} is text in quotes{mended}.")
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise self.fault(key, f"{key} must be a number, not {_written(value)}.")
        if _beyond(value, field, self.unit):
            largest = f"{LARGEST_COORDINATE:,.0f}{' mm' if field.kind in (Kind.LENGTH, Kind.FEED) else ''}"
            text = f"{key} is {_written(value)}: no machine has such a number, correct it. The largest is {largest}."
            raise self.fault(key, text)
        if field.kind is Kind.COUNT and value != int(value):
            raise self.fault(key, f"{key} must be a whole number, not {_written(value)}.")
        return float(value)

    def table(self, key: str) -> _Table:
        """Return a table inside this one, empty if it is absent."""
        value = self.data.get(key, {})
        if not isinstance(value, dict):
            raise self.fault(key, f"{key} must be a table, [{key}].")
        return _Table(self.file, self.lines, (*self.path, key), value, self.unit)

    def array(self, key: str) -> Iterator[_Table]:
        """Yield the tables of an array inside this one, none if it is absent."""
        value = self.data.get(key, [])
        if not isinstance(value, list) or not all(isinstance(item, dict) for item in value):
            raise self.fault(key, f"{key} must be tables, each headed [[{key}]].")
        for index, item in enumerate(value):
            yield _Table(self.file, self.lines, (*self.path, key, index), item, self.unit)


def _written(value: object) -> str:
    """Format a value as it appears in a file."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, list):
        return f"[{', '.join(map(_written, value))}]"
    return printable(str(value))


def _beyond(value: float, field: Field, unit: Unit) -> bool:
    """True if a number is larger than any machine could have, in program units or in millimeters."""
    if not abs(value) <= LARGEST_COORDINATE:
        return True
    return field.kind in (Kind.LENGTH, Kind.FEED) and round(to_mm(abs(value), unit), 3) > LARGEST_COORDINATE


Choice = TypeVar("Choice", bound=str)


def loads(text: str, file: str) -> Program:
    """Return the program in a file's text; StoreError names `file`, line and key."""
    top = _Table(file, partial(key_lines, text), (), _parsed(text, file), Unit.IN)
    if "format" not in top.data:
        raise top.fault(
            "format", f"format is missing, so this is not a cutcomp program: one begins with format = {FILE_FORMAT}."
        )
    top.only(("format", "units", "parameters", "setup", "tool", "block"))
    version = top.data.get("format")
    if isinstance(version, bool) or version not in (FILE_FORMAT, NEWER_FORMAT):
        readable = f"format = {FILE_FORMAT} and {NEWER_FORMAT}"
        raise top.fault("format", f"format cannot be {_written(version)}: this program reads {readable}.")
    top = _Table(file, top.lines, (), top.data, top.chosen("units", tuple(Unit)))
    return Program(
        top.unit,
        ProgramParameters(**_values(_with_rapid_feed(top.table("parameters")), Form.PARAMETERS)),
        PartSetup(**_values(top.table("setup"), Form.SETUP)),
        _tools(top),
        tuple(_block(block) for block in top.array("block")),
    )


def loads_bytes(data: bytes, file: str) -> Program:
    """Return the program in a file's bytes; StoreError names `file`, line and key."""
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        readable = data[: error.start].decode("utf-8-sig")
        if error.end == len(data) and (fault := truncation(readable)) is not None:
            raise StoreError(f"{file}, {fault}") from error
        line = data.count(b"\n", 0, error.start) + 1
        raise StoreError(f"{file}, line {line}: this is not UTF-8 text. Save it as UTF-8, or open a copy.") from error
    return loads(text, file)


def _parsed(text: str, file: str) -> dict[str, Any]:
    if (fault := truncation(text)) is not None:
        raise StoreError(f"{file}, {fault}")
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise StoreError(f"{file}: brackets are nested too deep for a program file.") from None
    except ValueError as error:
        raise StoreError(f"{file}, {syntax_fault(str(error), text)}") from error


def _with_rapid_feed(table: _Table) -> _Table:
    """Return the parameters with `rapid_feed` under its name; earlier files called it `rapid_rate`."""
    if "rapid_rate" not in table.data or "rapid_feed" in table.data:
        return table
    data = {"rapid_feed" if key == "rapid_rate" else key: value for key, value in table.data.items()}
    return replace(table, data=data)


def _values(table: _Table, form: Form, *others: str) -> dict[str, Any]:
    """Return what is typed on a form by name; refuse any key that is neither a field's nor one of the others."""
    relative = (field.name + RELATIVE_SUFFIX for field in STORED_FIELDS[form] if field.relative)
    table.only((*others, *(field.name for field in STORED_FIELDS[form]), *relative, UNREAD_TABLE))
    values: dict[str, Any] = dict(_numbers(table, form))
    for field in FIELDS_OF_FORM[form]:
        if field.kind is Kind.TEXT and field.name in table.data:
            values[field.name] = table.text(field.name)
        elif field.name == "tangent":
            values[field.name] = _tangent(table)
        elif field.kind is Kind.CHOICE and (field.name in table.data or field.name in REQUIRED_CHOICES):
            values[field.name] = table.chosen(field.name, field.choices)
    return values


def _numbers(table: _Table, form: Form) -> dict[str, Typed]:
    """Return the typed numbers of a form by name, absolute or relative, and the texts from its `unread` table."""
    fields, unread = NUMBER_FIELDS[form], table.table(UNREAD_TABLE)
    unread.only(tuple(field.name for field in fields))
    typed: dict[str, Typed] = {}
    for field in fields:
        name, relative = field.name, field.name + RELATIVE_SUFFIX
        if name in table.data:
            typed[name] = Number(table.number(name, field))
        if field.relative and relative in table.data:
            if name in typed:
                raise table.fault(relative, f"{name} appears twice, as {name} and as {relative}: remove one.")
            typed[name] = Relative(table.number(relative, field))
        if name in unread.data:
            if name in typed:
                raise unread.fault(name, f"{name} appears twice, as a number and as unread text: remove one.")
            typed[name] = _unread(unread, field)
    return typed


def _unread(table: _Table, field: Field) -> Unread:
    """Return unread text with its reason derived again; a text that could be read now must be typed again."""
    text = table.data[field.name]
    if not isinstance(text, str) or not text.strip():
        raise table.fault(field.name, f"{field.name} must be the text that was typed, in quotes.")
    return Unread(text, unread_reason(text, field, table.unit))


def _tools(top: _Table) -> tuple[Tool, ...]:
    tools: dict[int, Tool] = {}
    for table in top.array("tool"):
        tool = _tool(table)
        if tool.number in tools:
            raise table.fault("number", f"tool {tool.number} appears twice in the tool table: remove one.")
        tools[tool.number] = tool
    return tuple(tools[number] for number in sorted(tools))


def _tool(table: _Table) -> Tool:
    values = _values(table, Form.TOOL)
    number = values.pop("number", None)
    field = FIELDS_OF_FORM[Form.TOOL][0]
    if not isinstance(number, Number) or value_refusal(field, number.value, table.unit):
        raise table.fault(
            "number", f"number {'is missing' if number is None else 'is not a tool number'}: write 1 to 9999."
        )
    return Tool(int(number.value), **values)


def _block(table: _Table) -> Block:
    if table.text("kind") != BLOCK_KIND:
        raise table.fault("kind", f'kind must be "{BLOCK_KIND}".')
    values = _values(table, Form.START, "kind", "segment")
    lookahead = values.get("lookahead")
    if isinstance(lookahead, Number) and (
        trouble := value_refusal(field_of(Form.START, "lookahead"), lookahead.value, table.unit)
    ):
        raise table.fault("lookahead", f"lookahead is {lookahead.value:g}: {trouble}")
    return Block(**values, segments=tuple(_segment(segment) for segment in table.array("segment")))


def _segment(table: _Table) -> Segment:
    kind = table.text("kind")
    segment = next((segment for segment, form in SEGMENT_FORMS.items() if form == kind), None)
    if segment is None:
        kinds = "LINE, ARC, BLEND ARC or CHAMFER"
        raise table.fault("kind", f"kind cannot be {printable(kind)}: write {kinds}, in quotes.")
    if not issubclass(segment, LineSegment | ArcSegment):
        return segment(**_values(table, Form(kind), "kind"))
    return segment(**_values(table, Form(kind), "kind", "choice"), choice=_choice(table))


def _choice(table: _Table) -> int | None:
    value = table.data.get("choice")
    if value is None or (type(value) is int and 0 <= value <= MAX_CHOICE):
        return value
    remedy = f"write a whole number from 0 to {MAX_CHOICE}, or remove it."
    raise table.fault("choice", f"choice cannot be {_written(value)}: {remedy}")


def _tangent(table: _Table) -> bool:
    """Return TANGENT, which is NO if absent; raise an error if the angle to the segment before is also typed."""
    value = table.data.get("tangent", False)
    if not isinstance(value, bool):
        raise table.fault("tangent", f"tangent cannot be {_written(value)}: write true or false.")
    for key in ("angle_inc", "start_angle_inc"):
        if value and key in table.data:
            raise table.fault(key, f"tangent = true says what {key} says: remove one.")
    return value
