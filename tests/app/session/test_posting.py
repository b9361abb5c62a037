"""The notes of POST on a program before it is written."""

from __future__ import annotations

import pytest

from app.session.posting import CENTER_PATH, nc_text
from tests.core.program.parts import line, program


@pytest.mark.parametrize("choice", [CENTER_PATH, "fanuc:a"])
def test_a_warning_of_a_block_is_among_the_notes_of_post(choice: str) -> None:
    posted = nc_text(program(line(x_end=30.0, y_end=0.0)), "part", choice)
    assert posted.text, posted.against
    assert any(note.startswith("Block 1, segment 1: FEED is blank") for note in posted.notes), posted.notes
    fed = nc_text(program(line(x_end=30.0, y_end=0.0, feed=9.0)), "part", choice)
    assert fed.text
    assert not any("FEED is blank" in note for note in fed.notes)
