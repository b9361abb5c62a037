"""Checks what of a DXF file's text is whole, and reads its document with ezdxf.

A text that breaks off is recognized by its tags, since a reader that repairs would accept it silently.  ezdxf is
imported only when a drawing is opened.
"""

from __future__ import annotations

import io
import logging
import re
from collections.abc import Iterable, Iterator
from contextlib import suppress
from typing import TYPE_CHECKING, Final

from core.importing.drawing import MAX_ENTITIES, DrawingError
from core.importing.dxf_tags import (
    BINARY_MARK,
    HANDLE_CODE,
    MARKER_CODE,
    MARKERS_OF_ENTITY,
    NO_HANDLE,
    Scan,
    scan_tags,
    scan_text,
    text_lines,
)

if TYPE_CHECKING:
    from ezdxf.document import Drawing as Document
    from ezdxf.lldxf.types import DXFTag

R2000: Final = "AC1015"
LAYER_CODE: Final = 8
_OWN_CODES: Final = frozenset({10, 11, 12, 13, 38, 39, 40, 41, 42, 43, 44, 70, 71, 72, 73, 74, 90, 91, 210})
"""Group codes with which the own data of an LWPOLYLINE or a SPLINE may begin."""

MISSING_PACKAGE: Final = "DXF files need the package ezdxf: pip install ezdxf"


def too_much(what: str, count: int, most: int) -> DrawingError:
    """Return the error for a drawing that has more of something than is read."""
    return DrawingError("TOO_MUCH", f"The drawing has {count:,} {what}: at most {most:,} are read.")


def _silence(logger: logging.Logger) -> None:
    """Keep ezdxf's log off the screen: the operator gets messages of our own."""
    logger.propagate = False
    if not logger.handlers:
        logger.addHandler(logging.NullHandler())


def document_of(data: bytes, *, damaged: bool) -> tuple[Scan, Document]:
    """Return the scan of the tags and ezdxf's document, or raise DrawingError."""
    try:
        import ezdxf
    except ImportError as error:
        raise DrawingError("NO_EZDXF", MISSING_PACKAGE) from error
    _silence(logging.getLogger(ezdxf.__name__))
    if data.startswith(BINARY_MARK):
        return _binary_document(data, damaged=damaged)
    scan = scan_text(data)
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
    end = [b"0", b"ENDBLK"] if scan.open_section == "BLOCKS" else []
    if scan.open_section:
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
        scan = scan_tags((tag.code, tag.value) for tag in binary_tags_loader(data))
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
        why = f"line {scan.bad_line} is no group code" if scan.bad_line else _structure_fault(error)
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
