"""A program file from before segments were calculated together, and its NC file of that time: both stay as they are.

`tests/data/older_program` was written by that version, but G43 stands with the first move today.
"""

from __future__ import annotations

from pathlib import Path

from core.pipeline.derive import derive
from core.pipeline.post import post_center_path
from core.program.edit import FormPlace, choose, type_field
from core.program.file.read import loads
from core.program.file.write import dumps
from core.program.model import Number, Program

FOLDER = Path(__file__).parents[2] / "data/older_program"
TEXT = (FOLDER / "part.toml").read_text(encoding="utf-8")


def posted(program: Program) -> str:
    return post_center_path(derive(program), name="OLDER").text


def test_it_is_read_and_written_unchanged():
    assert dumps(loads(TEXT, "part.toml")) == TEXT


def test_an_older_program_still_posts_the_same_nc_text():
    assert posted(loads(TEXT, "part.toml")) == (FOLDER / "part.nc").read_text(encoding="ascii")


def test_none_of_its_segments_needs_another_one():
    program = loads(TEXT, "part.toml")
    assert [block.solved.runs for block in derive(program).blocks] == [(), ()]


def test_a_field_of_the_new_kind_makes_it_a_newer_file_and_taking_it_back_the_older_one():
    program = loads(TEXT, "part.toml")
    tangent = choose(program, FormPlace(1, 7), "tangent", "YES")
    assert isinstance(tangent, Program)
    assert dumps(tangent).startswith("format = 2")
    again = choose(tangent, FormPlace(1, 7), "tangent", "NO")
    assert isinstance(again, Program)
    assert dumps(again) == TEXT


def test_a_calculated_program_comes_back_with_its_picks_and_posts_the_same():
    program = loads(TEXT, "part.toml")
    for name, value in (("x_end", None), ("y_end", None), ("angle", Number(100.0)), ("length", Number(50.0))):
        edited = type_field(program, FormPlace(1, 3), name, value)
        assert isinstance(edited, Program)
        program = edited
    lines = FormPlace(2, 2)
    for name, value in (("pick_x", Number(21.0)), ("pick_y", Number(14.0))):
        edited = type_field(program, lines, name, value)
        assert isinstance(edited, Program)
        program = edited
    text = dumps(program)
    assert "pick_x = 21.0" in text
    assert loads(text, "part.toml") == program
    assert posted(loads(text, "part.toml")) == posted(program)
