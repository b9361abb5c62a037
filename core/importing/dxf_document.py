"""Checks what of a DXF file is whole by its tags, and reads its document with ezdxf.

A text that breaks off is recognized by its tags, and their counts are compared with what was read, so that no loss goes
unreported: a reader that repairs silently drops what it cannot place.  ezdxf is imported only when a drawing is opened.
https://help.autodesk.com: DXF reference, "About the General DXF File Structure".
"""

from __future__ import annotations

import io
import logging
import re
from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING, Final, NamedTuple

from core.importing.drawing import MAX_ENTITIES, DrawingError

if TYPE_CHECKING:
    from ezdxf.document import Drawing as Document
    from ezdxf.lldxf.types import DXFTag

BINARY_MARK: Final = b"AutoCAD Binary DXF\r\n\x1a\x00"

R12: Final = "AC1009"
COMMENT_CODE: Final = 999
HANDLE_CODE: Final = 5
NO_HANDLE: Final = "0"
"""A handle that means none: no entity may have it, but some programs write it into each."""
MARKER_CODE: Final = 100
"""The group code of a subclass marker, such as AcDbPolyline."""
MARKERS_OF_ENTITY: Final = {"LWPOLYLINE": ("AcDbEntity", "AcDbPolyline"), "SPLINE": ("AcDbEntity", "AcDbSpline")}
"""The markers without which ezdxf does not read an entity: before its common data, and before its own."""

_BREAK: Final = re.compile(rb"\r\n|\r")

_SECTIONS: Final = frozenset(
    {"HEADER", "CLASSES", "TABLES", "BLOCKS", "ENTITIES", "OBJECTS", "THUMBNAILIMAGE", "ACDSDATA"}
)

_SUBORDINATE: Final = frozenset({"VERTEX", "SEQEND", "ATTRIB"})
"""Entities that belong to the one before them: points of a POLYLINE, texts of an INSERT."""

_NEEDED: Final = {
    "LINE": (10, 20, 11, 21),
    "CIRCLE": (10, 20, 40),
    "ARC": (10, 20, 40, 50, 51),
    "ELLIPSE": (10, 20, 11, 21, 40),
    "VERTEX": (10, 20),
    "INSERT": (2, 10, 20),
}
"""Group codes that an entity has exactly once: two entities run together have them twice."""

_AT_MOST_ONCE: Final = {
    "ELLIPSE": (41, 42),
    "VERTEX": (42,),
    "INSERT": (41, 42, 50),
    "LWPOLYLINE": (38, 90),
    "SPLINE": (70, 71),
}

_COUNTED: Final = {
    "LWPOLYLINE": (("points", 90, 10), ("points", 90, 20)),
    "SPLINE": (("knots", 72, 40), ("control points", 73, 10), ("fit points", 74, 11)),
}
"""Entities that state how often a group code follows: (what, code of the count, counted code)."""


class Tag(NamedTuple):
    """A group code with its value; `line` is the line of the group code, 0 in a binary file."""

    code: int
    value: str
    line: int


@dataclass(slots=True)
class ScannedEntity:
    """An entity in the file; `number` counts from 1 within its section or block."""

    kind: str
    line: int
    number: int
    paper: bool = False
    fault: str = ""
    """What is wrong with its group codes, empty if nothing is."""

    @property
    def where(self) -> str:
        """Its place in words."""
        return f"at line {self.line}" if self.line else f"that is entity {self.number}"


@dataclass(slots=True)
class Scan:
    """The contents of a file by its tags, entity by entity.

    `whole`: every section that begins ends, and the file ends with EOF.  `last_line` is the last line that was read,
    `cut` the number of lines up to the last whole entity if the file breaks off within its entities.  `block` and
    `entity` are those that the tags are in; `open_polyline`: its SEQEND has not come yet.
    """

    whole: bool = False
    last_line: int = 0
    entities: list[ScannedEntity] = field(default_factory=list)
    blocks: dict[str, list[ScannedEntity]] = field(default_factory=dict)
    units: int = 0
    """$INSUNITS, 0 if the file has none."""
    version: str | None = None
    """$ACADVER, empty if the header has none, None if the file has no header."""
    marked: bool = False
    """An entity has subclass markers (group code 100), which R12 does not know."""
    unmarked: bool = False
    """An entity lacks one of its `MARKERS_OF_ENTITY`."""
    irregular: bool = False
    """An entity has the handle 0, or a POLYLINE has no SEQEND."""
    bad_line: int = 0
    """The first line that should be a group code and is not, 0 if there is none."""
    section: str = ""
    """The section that the tags are in; after the last tag the one in which the file ends, empty if all end."""
    block: str | None = None
    entity: ScannedEntity | None = None
    open_polyline: bool = False
    cut: int = 0
    repaired: str = ""
    """Why the file could be read only after a repair, empty if it needed none."""
    unknown_sections: list[str] = field(default_factory=list)
    lost: list[ScannedEntity] = field(default_factory=list)
    """Entities that no reader can see, because their kind or their POLYLINE is missing."""

    @property
    def becomes_r2000(self) -> bool:
        """True if an R12 file, or one of no version, has subclass markers or entities that R12 does not have."""
        return self.version in (None, "", R12) and (self.marked or self.unmarked)

    @property
    def first_fault(self) -> ScannedEntity | None:
        """The first entity whose group codes cannot be right."""
        every = (entity for entities in (self.lost, *self.blocks.values(), self.entities) for entity in entities)
        return next((entity for entity in every if entity.fault), None)

    @property
    def current(self) -> list[ScannedEntity]:
        """The entities of the block that the tags are in, or of the section ENTITIES."""
        return self.entities if self.block is None else self.blocks[self.block]

    def read(self, tags: Iterable[Tag]) -> None:
        """Take in the tags of a file."""
        marker = Tag(-1, "", 0)
        body: list[Tag] = []
        for tag in tags:
            if tag.code != 0:
                body.append(tag)
                continue
            self.close(marker, body)
            marker, body = tag, []
            if tag.value == "EOF":
                self.whole = not self.section
                return
            self.open(tag)
        # the last entity may have lost something: only those before it are whole
        if self.section in ("ENTITIES", "BLOCKS"):
            self.cut = marker.line - 1 if marker.line else 0
        last = self.current[-1] if self.current else None
        if self.section == "ENTITIES" and last is not None and (self.open_polyline or last.line == marker.line):
            self.cut = last.line - 1
            self.current.pop()

    def open(self, tag: Tag) -> None:
        """Begin a section, a block or an entity at its marker."""
        name = tag.value
        if self.open_polyline and name not in _SUBORDINATE:
            self.irregular, self.open_polyline = True, False
        if name == "SECTION":
            return
        if name == "ENDSEC":
            self.section, self.block = "", None
        elif name in ("BLOCK", "ENDBLK"):
            self.block = None
        elif name in _SUBORDINATE:
            if name == "SEQEND":
                self.open_polyline = False
            elif name == "VERTEX" and not self.open_polyline:
                number = len(self.entities) + 1
                self.lost.append(ScannedEntity(name, tag.line, number, fault="belongs to no POLYLINE"))
        elif self.section == "ENTITIES" or self.block is not None:
            self.entity = ScannedEntity(name, tag.line, len(self.current) + 1)
            self.open_polyline = name == "POLYLINE"
            self.current.append(self.entity)
        elif self.section == "BLOCKS":
            # the beginning of its block is missing
            self.blocks.setdefault("", []).append(ScannedEntity(name, tag.line, 1, fault="stands outside of any block"))

    def close(self, marker: Tag, body: list[Tag]) -> None:
        """Process a marker once all its tags are known."""
        if marker.code:
            return
        if marker.value == "SECTION":
            self.section = next((tag.value for tag in body if tag.code == 2), "")
            named = [tag for tag in body if tag.code != COMMENT_CODE]
            if self.section == "HEADER":
                self._header(body)
            elif self.section in ("ENTITIES", "BLOCKS") and len(named) > 1:
                self.lost.append(ScannedEntity("entity", named[1].line, 1, fault="has no kind (group code 0)"))
            elif self.section not in _SECTIONS:
                self.unknown_sections.append(self.section)
            return
        self.irregular |= any(tag[:2] == (HANDLE_CODE, NO_HANDLE) for tag in body)
        if marker.value == "BLOCK" and self.section == "BLOCKS":
            self.block = next((tag.value for tag in body if tag.code == 2), "").lower()
            self.blocks.setdefault(self.block, [])
        elif self.entity is not None and (marker.value in _SUBORDINATE or marker.line == self.entity.line):
            self._check(self.entity, marker.value, body)

    def _header(self, body: list[Tag]) -> None:
        self.version = ""
        for variable, value in pairwise(body):
            if variable[:2] == (9, "$ACADVER"):
                self.version = value.value
            if variable[:2] == (9, "$INSUNITS") and value.code == 70 and value.value.lstrip("-").isdecimal():
                self.units = int(value.value)

    def _check(self, entity: ScannedEntity, kind: str, body: list[Tag]) -> None:
        counts = Counter(tag.code for tag in body)
        self.marked |= MARKER_CODE in counts
        self.unmarked |= any(
            (MARKER_CODE, name) not in (tag[:2] for tag in body) for name in MARKERS_OF_ENTITY.get(kind, ())
        )
        if kind == entity.kind and any(tag.code == 67 and tag.value == "1" for tag in body):
            entity.paper = True
        entity.fault = entity.fault or _fault(kind, counts, body)


def text_lines(data: bytes) -> list[bytes]:
    """Return the lines of a text file, with any kind of line end."""
    lines = _BREAK.sub(b"\n", data).removeprefix(b"\xef\xbb\xbf").split(b"\n")
    if lines and not lines[-1].strip():
        lines.pop()
    return lines


def is_dxf(data: bytes) -> bool:
    """True if the data begins like a DXF file: with its binary mark, or with a SECTION after comments."""
    if data.startswith(BINARY_MARK):
        return True
    first = next((tag for tag in _tags(text_lines(data[:65536]), Scan()) if tag.code != COMMENT_CODE), None)
    return first is not None and first[:2] == (0, "SECTION")


def _tags(lines: list[bytes], scan: Scan) -> Iterator[Tag]:
    """Yield the tags up to EOF, or up to the first line that should be a group code and is not."""
    for row in range(0, len(lines) - 1, 2):
        try:
            code = int(lines[row])
        except ValueError:
            scan.bad_line = row + 1
            return
        # the name of an entity may have blanks around it
        value = lines[row + 1].strip().decode("latin-1")
        yield Tag(code, value, row + 1)
        if (code, value) == (0, "EOF"):
            return


def _fault(kind: str, counts: Counter[int], body: list[Tag]) -> str:
    """Return what is wrong with an entity's group codes, empty if they can be right."""
    for code in _NEEDED.get(kind, ()):
        if counts[code] != 1:
            return f"has group code {code} {_times(counts[code])}"
    for code in _AT_MOST_ONCE.get(kind, ()):
        if counts[code] > 1:
            return f"has group code {code} {_times(counts[code])}"
    for noun, code, counted in _COUNTED.get(kind, ()):
        stated = next((tag.value for tag in body if tag.code == code), None)
        if stated is not None and (not stated.isdecimal() or int(stated) != counts[counted]):
            return f"names {stated} {noun} and has {counts[counted]}"
    return ""


def _times(count: int) -> str:
    return "missing" if not count else f"{count} times"


R2000: Final = "AC1015"
LAYER_CODE: Final = 8
_OWN_CODES: Final = frozenset({10, 11, 12, 13, 38, 39, 40, 41, 42, 43, 44, 70, 71, 72, 73, 74, 90, 91, 210})
"""Group codes with which the own data of an LWPOLYLINE or a SPLINE may begin."""

MISSING_PACKAGE: Final = "DXF files need the package ezdxf: pip install ezdxf"


def too_much(what: str, count: int, most: int) -> DrawingError:
    """Return the error for a drawing that has more of something than is read."""
    return DrawingError("TOO_MUCH", f"The drawing has {count:,} {what}: at most {most:,} are read.")


def document_of(data: bytes, *, damaged: bool) -> tuple[Scan, Document]:
    """Return the scan of the tags and ezdxf's document, or raise DrawingError."""
    try:
        import ezdxf
    except ImportError as error:
        raise DrawingError("NO_EZDXF", MISSING_PACKAGE) from error
    # keep ezdxf's log off the screen: the operator gets messages of our own
    logger = logging.getLogger(ezdxf.__name__)
    logger.propagate = False
    if not logger.handlers:
        logger.addHandler(logging.NullHandler())
    if data.startswith(BINARY_MARK):
        return _binary_document(data, damaged=damaged)
    lines = text_lines(data)
    scan = Scan(last_line=len(lines))
    scan.read(_tags(lines, scan))
    if not scan.whole and not scan.bad_line:
        data = _up_to_break(data, scan, damaged=damaged)
    _check(scan, damaged=damaged)
    return scan, _loaded(data, scan, damaged=damaged)


def _check(scan: Scan, *, damaged: bool) -> None:
    """Raise if a file has too many entities, or one whose group codes cannot be right."""
    if len(scan.entities) > MAX_ENTITIES:
        raise too_much("entities", len(scan.entities), MAX_ENTITIES)
    if scan.first_fault is not None and not damaged:
        fault = scan.first_fault
        readable = sum(not entity.fault for entity in scan.entities)
        raise damaged_file(f"The {fault.kind} {fault.where} {fault.fault}", readable)


def _normalized(tags: Iterable[DXFTag], scan: Scan) -> Iterator[DXFTag]:
    """Yield the tags up to EOF, changed so that ezdxf reads every entity whole.

    In a file of R12, or of no version, ezdxf reads only what comes before an entity's first subclass marker: such a
    file becomes R2000.  It reads no LWPOLYLINE or SPLINE without its markers, and no POLYLINE without SEQEND: they are
    inserted.  It reads no file with the handle 0, and gives an entity without a handle its own: the 0 is dropped.
    """
    from ezdxf.lldxf.tags import group_tags
    from ezdxf.lldxf.types import DXFTag

    if scan.becomes_r2000 and scan.version is None:
        yield from (*_as_r2000([DXFTag(0, "SECTION"), DXFTag(2, "HEADER")]), DXFTag(0, "ENDSEC"))
    kind = ""
    for entity in group_tags(tags):
        before, kind = kind, entity[0].value.strip()
        if before in ("POLYLINE", "VERTEX") and kind not in ("VERTEX", "SEQEND"):
            yield DXFTag(0, "SEQEND")
        if kind == "SECTION":
            is_header = any(_stripped(tag) == (2, "HEADER") for tag in entity[1:2])
            yield from _as_r2000(entity) if is_header and scan.becomes_r2000 else entity
        else:
            yield from _with_markers([tag for tag in entity if _stripped(tag) != (HANDLE_CODE, NO_HANDLE)])
        if kind == "EOF":
            return


def _as_r2000(header: list[DXFTag]) -> list[DXFTag]:
    """Return the tags of a header with the version R2000."""
    from ezdxf.lldxf.types import DXFTag

    at = next((row for row, tag in enumerate(header) if _stripped(tag) == (9, "$ACADVER")), len(header))
    return [*header[:2], DXFTag(9, "$ACADVER"), DXFTag(1, R2000), *header[2:at], *header[at + 2 :]]


def _with_markers(entity: list[DXFTag]) -> list[DXFTag]:
    """Return an entity's tags with the markers it lacks; as they are if its layer comes too late."""
    from ezdxf.lldxf.types import DXFTag

    kind = entity[0].value.strip()
    if kind not in MARKERS_OF_ENTITY:
        return entity
    codes, named = [tag.code for tag in entity], set(map(_stripped, entity))
    common, own = (
        [] if (MARKER_CODE, name) in named else [DXFTag(MARKER_CODE, name)] for name in MARKERS_OF_ENTITY[kind]
    )
    first = next((row for row, code in enumerate(codes) if code in _OWN_CODES), len(codes))
    if own and (first == len(codes) or LAYER_CODE in codes[first:]):
        return entity
    begin = 2 if codes[1] == HANDLE_CODE else 1
    return [*entity[:begin], *common, *entity[begin:first], *own, *entity[first:]]


def _stripped(tag: DXFTag) -> tuple[int, str]:
    return tag.code, str(tag.value).strip()


def _up_to_break(data: bytes, scan: Scan, *, damaged: bool) -> bytes:
    """Return the text of a file that breaks off, ended properly after its last whole entity."""
    if not damaged:
        count = len(scan.entities)
        could = f"{count} {'entity' if count == 1 else 'entities'} could be read"
        raise DrawingError("DXF_DAMAGED", f"This file breaks off at line {scan.last_line}: {could}.", count)
    end = [b"0", b"ENDBLK"] if scan.section == "BLOCKS" else []
    if scan.section:
        end += [b"0", b"ENDSEC"]
    lines = text_lines(data)
    kept = lines[: scan.cut] if scan.cut else lines[: len(lines) // 2 * 2]
    return b"\n".join([*kept, *end, b"0", b"EOF", b""])


def damaged_file(text: str, readable: int | None = None) -> DrawingError:
    """Return the error for a damaged file; `readable` counts its readable entities, None if it cannot be taken."""
    return DrawingError("DXF_DAMAGED", f"This file is damaged: {text}.", readable)


def _binary_document(data: bytes, *, damaged: bool) -> tuple[Scan, Document]:
    from ezdxf.document import Drawing as Document
    from ezdxf.lldxf.tagger import binary_tags_loader

    try:
        tags, scan = binary_tags_loader(data), Scan()
        scan.read(Tag(tag.code, str(tag.value), 0) for tag in tags if tag.code != COMMENT_CODE)
        _check(scan, damaged=damaged)
        if scan.whole:
            return scan, Document.load(_normalized(binary_tags_loader(data), scan))
    except DrawingError:
        raise
    except Exception as error:  # a damaged file may bring any exception out of a package for files
        raise damaged_file(_structure_fault(error)) from error
    raise damaged_file("it breaks off")


def _loaded(data: bytes, scan: Scan, *, damaged: bool) -> Document:
    """Return ezdxf's document of a text file; coordinates in an unusual order are reordered.

    A file that cannot be read this way is recovered, but taken only with `damaged`.
    """
    from ezdxf.document import Drawing as Document
    from ezdxf.filemanagement import read
    from ezdxf.lldxf.repair import tag_reorder_layer
    from ezdxf.lldxf.tagger import ascii_tags_loader

    encoding = _encoding(data)
    text = b"\n".join([*text_lines(data), b""]).decode(encoding, "surrogateescape")
    if (scan.irregular or scan.unmarked or scan.becomes_r2000) and not scan.bad_line:
        tags = _normalized(ascii_tags_loader(io.StringIO(text)), scan)
        text = "".join(f"{tag.code}\n{tag.value}\n" for tag in tags)
    try:
        return read(io.StringIO(text))
    except Exception as error:  # noqa: BLE001  # as above
        why = f"line {scan.bad_line} is not a group code" if scan.bad_line else _structure_fault(error)
    with suppress(Exception):
        return Document.load(tag_reorder_layer(ascii_tags_loader(io.StringIO(text))))
    recovered = _recovered(text.encode(encoding, "surrogateescape"))
    if damaged and recovered is not None:
        scan.repaired = why
        return recovered
    raise damaged_file(why, None if recovered is None else len(recovered.modelspace()))


def _structure_fault(error: Exception) -> str:
    """Return ezdxf's words about a file's structure; its internal errors tell an operator nothing."""
    from ezdxf.lldxf.const import DXFError

    return words_of(error) if isinstance(error, DXFError) else "its sections cannot be read"


def _recovered(data: bytes) -> Document | None:
    """Return what ezdxf can repair of a file, None if it cannot."""
    from ezdxf.recover import read

    try:
        document, _ = read(io.BytesIO(data))
    except Exception:  # noqa: BLE001  # as above
        return None
    return document


def _encoding(data: bytes) -> str:
    """Return the encoding that the header names; since R2007 it is UTF-8."""
    from ezdxf.filemanagement import dxf_stream_info

    try:
        head = data[:200_000].decode("latin-1").replace("\r\n", "\n").replace("\r", "\n")
        encoding = str(dxf_stream_info(io.StringIO(head)).encoding)
        "".encode(encoding)
    except Exception:  # noqa: BLE001  # a header that cannot be read names no encoding
        return "cp1252"
    return encoding


_HANDLE: Final = re.compile(r"\(#\w+\)|^\w+Error: ")
"""Parts of a message that tell an operator nothing: an entity's handle, ezdxf's name of an error."""


def words_of(error: Exception | str) -> str:
    """Return a package's error message, or a name from the file, on one line and shortened."""
    words = " ".join("".join(sign if sign.isprintable() else " " for sign in _HANDLE.sub("", str(error))).split())
    return (words or type(error).__name__).rstrip(".")[:160]
