"""Checks what of a DXF file's text is whole, and reads its document with ezdxf.

A text that breaks off is recognized by its tags, since a reader that repairs would accept it silently.  ezdxf is
imported only when a drawing is opened.
"""

from __future__ import annotations

import io
import logging
import re
from collections.abc import Sequence
from contextlib import suppress
from itertools import pairwise
from typing import TYPE_CHECKING, Final

from core.importing.drawing import MAX_ENTITIES, DrawingError
from core.importing.dxf_tags import (
    BINARY_MARK,
    HANDLE,
    MARKER,
    MARKERS,
    NO_HANDLE,
    Scan,
    scan_tags,
    scan_text,
    text_lines,
)

if TYPE_CHECKING:
    from ezdxf.document import Drawing as Document

R12: Final = "AC1009"
R2000: Final = "AC1015"
LAYER: Final = 8
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
        return _binary_document(data)
    scan = scan_text(data)
    if not scan.whole and not scan.bad_line:
        data = _up_to_break(data, scan, damaged=damaged)
    if len(scan.entities) > MAX_ENTITIES:
        raise too_much("entities", len(scan.entities), MAX_ENTITIES)
    if scan.first_fault is not None and not damaged:
        fault = scan.first_fault
        readable = sum(not entity.fault for entity in scan.entities)
        raise damaged_file(f"The {fault.kind} {fault.where} {fault.fault}", readable)
    return scan, _loaded(_normalized(data, scan), scan, damaged=damaged)


def _normalized(data: bytes, scan: Scan) -> bytes:
    """Return a text file in which ezdxf reads every entity whole.

    In a file of R12, or of no version, ezdxf reads only what comes before an entity's first subclass marker: such a
    file becomes R2000.  It reads no LWPOLYLINE or SPLINE without its markers: they are inserted.  It reads no file with
    the handle 0, and gives an entity without a handle its own: the 0 is dropped.  What follows EOF is left out.
    """
    is_r12 = scan.version in ("", R12) and (scan.marked or scan.unmarked)
    if scan.bad_line or not (is_r12 or scan.unmarked or scan.null_handle):
        return data
    lines = text_lines(data)
    written, begin = list[bytes](), 0
    for row in range(2, len(lines) - 1, 2):
        if int(lines[row]):
            continue
        written += _with_markers(_without_null_handle(lines[begin:row]))
        begin = row
        if lines[row + 1].strip() == b"EOF":
            break
    written += lines[begin : begin + 2]
    return b"\n".join([*(_as_r2000(written) if is_r12 else written), b""])


def _as_r2000(lines: list[bytes]) -> list[bytes]:
    """Return the lines of a file with the version R2000 in its header."""
    values = [line.strip() for line in lines]
    version = _lines_of([(9, "$ACADVER"), (1, R2000)])
    if b"$ACADVER" in values:
        at = values.index(b"$ACADVER") - 1
        return [*lines[:at], *version, *lines[at + 4 :]]
    header = [row for row, pair in enumerate(pairwise(values[1::2])) if pair == (b"SECTION", b"HEADER")]
    if header:
        at = 2 * header[0] + 4
        return [*lines[:at], *version, *lines[at:]]
    return [*_lines_of([(0, "SECTION"), (2, "HEADER")]), *version, *_lines_of([(0, "ENDSEC")]), *lines]


def _without_null_handle(lines: list[bytes]) -> list[bytes]:
    """Return an entity's lines without the handle 0; those of a section as they are."""
    if lines[1].strip() == b"SECTION":
        return lines
    tags = zip(lines[::2], lines[1::2], strict=True)
    null = NO_HANDLE.encode()
    return [line for tag in tags if int(tag[0]) != HANDLE or tag[1].strip() != null for line in tag]


def _with_markers(lines: list[bytes]) -> list[bytes]:
    """Return an entity's lines with the markers it lacks; as they are if its layer comes too late."""
    kind = lines[1].strip().decode("latin-1")
    if kind not in MARKERS:
        return lines
    codes = [int(code) for code in lines[::2]]
    named = {value.strip().decode("latin-1") for code, value in zip(codes, lines[1::2], strict=True) if code == MARKER}
    common, own = (_lines_of([(MARKER, name)]) if name not in named else [] for name in MARKERS[kind])
    first = next((row for row, code in enumerate(codes) if code in _OWN_CODES), len(codes))
    if own and (first == len(codes) or LAYER in codes[first:]):
        return lines
    begin = 2 if codes[1] == HANDLE else 1
    return [*lines[: 2 * begin], *common, *lines[2 * begin : 2 * first], *own, *lines[2 * first :]]


def _lines_of(tags: Sequence[tuple[int, str]]) -> list[bytes]:
    return [line.encode() for code, value in tags for line in (str(code), value)]


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


def _binary_document(data: bytes) -> tuple[Scan, Document]:
    from ezdxf.document import Drawing as Document
    from ezdxf.lldxf.tagger import binary_tags_loader

    try:
        scan = scan_tags((tag.code, tag.value) for tag in binary_tags_loader(data))
        if len(scan.entities) > MAX_ENTITIES:
            raise too_much("entities", len(scan.entities), MAX_ENTITIES)
        if scan.unmarked or (scan.marked and scan.version in ("", R12)):
            raise damaged_file("its version does not have its kinds of entity. Export it as text DXF of R2000")
        if scan.whole:
            return scan, Document.load(binary_tags_loader(data))
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

    text = b"\n".join([*text_lines(data), b""]).decode(_encoding(data), "surrogateescape")
    try:
        return read(io.StringIO(text))
    except Exception as error:  # noqa: BLE001  # as above
        why = f"line {scan.bad_line} is no group code" if scan.bad_line else _structure_fault(error)
    with suppress(Exception):
        return Document.load(tag_reorder_layer(ascii_tags_loader(io.StringIO(text))))
    recovered = _recovered(data)
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
