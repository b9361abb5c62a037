"""An NC text and the lines of its editor."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from app.documents.nc_text import NcText

ENDS = st.sampled_from(["\n", "\r\n", "\r"])
LINES = st.lists(st.sampled_from(["", "G1 X1", "M30", "(A)"]), min_size=0, max_size=6)


@given(LINES, ENDS, st.booleans(), LINES, st.booleans())
@settings(max_examples=400, derandomize=True, deadline=None)
def test_an_editor_gives_back_the_lines_it_shows_and_undo_brings_the_file_back(old, end, ended, new, new_ended):
    data = (end.join(old) + (end if ended and old else "")).encode()
    text = NcText.read(data)
    wanted = (*new, "") if new_ended or not new else tuple(new)
    edited = text.with_texts(wanted)
    if edited is text:
        assert text.texts == wanted
        return
    shown = edited.texts
    assert shown == wanted or (shown == wanted[:-1] and wanted[-1] == ""), (old, ended, wanted, edited.lines)
    assert edited.undo().data == data
    assert edited.undo().redo().lines == edited.lines


def test_untouched_lines_keep_their_line_ends():
    text = NcText.read(b"G0 X0\r\nG1 X1\nM30\r\n")
    edited = text.with_texts(("G0 X0", "G1 X2", "M30", ""))
    assert edited.data == b"G0 X0\r\nG1 X2\nM30\r\n"


def test_an_edit_keeps_the_byte_order_mark_in_front():
    text = NcText.read("\ufeffG0 X0\nM30\n".encode())
    assert text.texts == ("G0 X0", "M30", "")
    assert text.with_texts(("G0 X5", "M30", "")).data == "\ufeffG0 X5\nM30\n".encode()
