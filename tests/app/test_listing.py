"""Editing an NC text: untouched lines are written back byte by byte."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.documents.nc_text import NcText
from app.documents.programs import is_nc
from core.controls.program_text import lines_of
from tests.app.nc_lines import changed, deleted, inserted

DATA = (
    b"",
    b"G1 X1",
    b"G1 X1\n",
    b"G1 X1\r\nG1 X2\rG1 X3\nG1 X4",
    b"\n\n\n",
    b"\xef\xbb\xbfG1\n",
    b"(caf\xe9)\nG1 X1\n",
    b"(\xc3\xa9)\n",
    b"\xff\xfeG\x001\x00\n\x00",
    b"\xfe\xff\x00G\x001\x00\n",
    b"\xff\xfeodd",
    bytes(range(256)),
)


@pytest.mark.parametrize("data", DATA)
def test_an_unedited_text_is_written_as_read(data: bytes) -> None:
    listing = NcText.read(data)
    assert listing.data == data
    assert "".join(listing.lines).encode(listing.encoding) == data
    assert not listing.unsaved


@settings(max_examples=200, derandomize=True)
@given(st.binary(max_size=60))
def test_lines_are_those_the_controls_count(data: bytes) -> None:
    listing = NcText.read(data)
    # a file that is nothing but a byte order mark has one empty line here, and none to the controls
    if data != b"\xef\xbb\xbf" and not data.startswith((b"\xff\xfe", b"\xfe\xff")):
        assert [listing.text(row) for row in range(len(listing))] == lines_of(data)


def test_lines_of_utf_16_are_split_as_the_controls_count_them() -> None:
    data = "\ufeffG1 X1\r\nG0".encode("utf-16-le")
    listing = NcText.read(data)
    assert [listing.text(row) for row in range(len(listing))] == lines_of(data) == ["G1 X1", "G0"]
    assert changed(listing, 1, "M30").data == "\ufeffG1 X1\r\nM30".encode("utf-16-le")


def test_a_changed_line_keeps_its_end_and_its_neighbors() -> None:
    listing = changed(NcText.read(b"G1 X1\r\nG1 X2\rG1 X3"), 1, "G0")
    assert listing.data == b"G1 X1\r\nG0\rG1 X3"
    assert listing.unsaved
    assert changed(listing, 2, "M30").data == b"G1 X1\r\nG0\rM30"


def test_a_changed_first_line_keeps_the_byte_order_mark_of_utf_8() -> None:
    listing = NcText.read(b"\xef\xbb\xbfG1\n")
    assert listing.text(0) == "G1"
    assert changed(listing, 0, "G0").data == b"\xef\xbb\xbfG0\n"


def test_inserted_lines_take_the_line_end_of_the_file() -> None:
    listing = NcText.read(b"A\r\nB")
    assert inserted(listing, 0, "X").data == b"X\r\nA\r\nB"
    assert inserted(listing, 1, "X").data == b"A\r\nX\r\nB"
    assert inserted(listing, 2, "X").data == b"A\r\nB\r\nX"
    assert inserted(NcText(), 0, "X").data == b"X\n"


def test_deleting_every_line_leaves_nothing() -> None:
    listing = deleted(NcText.read(b"A\nB\n"), 0)
    assert listing.data == b"B\n"
    assert deleted(deleted(listing, 0), 0).data == b""


def test_undo_and_redo_go_through_every_state() -> None:
    states = [NcText.read(b"A\nB\nC\n")]
    states.append(changed(states[-1], 1, "X"))
    states.append(inserted(states[-1], 0, "Y"))
    states.append(deleted(states[-1], 3))
    text = states[-1]
    for state in reversed(states[:-1]):
        text = text.undo()
        assert text.lines == state.lines
    assert not text.unsaved
    assert text.undo() is text
    for state in states[1:]:
        text = text.redo()
        assert text.lines == state.lines
    assert text.redo() is text


def test_undo_and_redo_compare_with_what_was_written() -> None:
    typed = changed(NcText.read(b"A\n"), 0, "B")
    saved = typed.saved_as(typed)
    assert not saved.unsaved
    assert saved.undo().unsaved
    assert not saved.undo().redo().unsaved
    assert changed(saved.undo(), 0, "B").unsaved


def test_a_text_knows_what_its_encoding_cannot_hold() -> None:
    assert not NcText.read(b"(\xe9)\n").takes("\u2192")
    assert NcText.read(b"G1\n").takes("\u2192")


@pytest.mark.parametrize(
    ("name", "text", "nc"),
    [
        ("a.nc", "G1 X1\n", True),
        ("a.toml", "G1 X1\n", False),
        ("a.txt", "# mine\nformat = 1\nunits = 'IN'\n", False),
        ("a.txt", "\ufeff# mine\r\n\r\nunits = 'IN'\r\nformat = 1\r\n", False),
        ("a.nc", "G20\nformat = 1\n", True),
        ("a", "%\nG0\n", True),
        ("empty.nc", "", True),
    ],
)
def test_which_files_are_nc_programs(name: str, text: str, nc: bool, tmp_path: Path) -> None:
    (tmp_path / name).write_text(text)
    assert is_nc(tmp_path / name) is nc


def test_a_folder_or_a_missing_file_is_no_nc_program(tmp_path: Path) -> None:
    assert not is_nc(tmp_path)
    assert not is_nc(tmp_path / "none.nc")


@pytest.mark.parametrize("encoding", ["utf-16", "utf-8-sig"])
def test_edits_keep_the_byte_order_mark_in_front(encoding: str) -> None:
    listing = NcText.read("A\nB\n".encode(encoding))
    first = inserted(listing, 0, "X")
    assert first.data == "X\nA\nB\n".encode(encoding)
    assert deleted(first, 0).data == "A\nB\n".encode(encoding)
    assert deleted(deleted(first, 0), 0).data == "B\n".encode(encoding)
    empty = deleted(deleted(deleted(first, 0), 0), 0)
    assert empty.data == "".encode(encoding)
    assert deleted(empty, 0) is empty
    assert inserted(empty, 0, "C").data == "C\n".encode(encoding)
    assert len(inserted(empty, 0, "C")) == 1
    assert empty.undo().undo().undo().data == first.data
