"""Program files: what is written reads back the same, what is wrong is named, nothing is ever lost."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.program.edit import set_unit
from core.program.file.store import StoreError, dumps, load, loads, save, write_output
from core.program.model import Entry, Program, Unread
from core.units import Unit
from tests.core.program.parts import program, programs
from tests.core.program.stored import PART, TEXT

BAD = Path(__file__).parents[2] / "data" / "bad" / "program"


EXAMPLES = Path(__file__).parents[3] / "app" / "examples"


def test_the_text_of_a_program():
    assert dumps(PART) == TEXT


@settings(derandomize=True, max_examples=80, deadline=None)
@given(programs)
def test_every_program_reads_back_the_same(given_program):
    assert loads(dumps(given_program), "x") == given_program


def test_what_could_not_be_read_is_kept_with_its_reason():
    z_bottom = loads(TEXT, "x").blocks[0].z_bottom
    assert isinstance(z_bottom, Unread)
    assert z_bottom.text == "-1/4x"
    assert z_bottom.reason.startswith("x is not understood here")


def test_unread_text_that_could_be_read_now_never_becomes_a_number():
    z_bottom = loads(TEXT.replace("-1/4x", "-1/4"), "x").blocks[0].z_bottom
    assert z_bottom == Unread("-1/4", "Type it again.")


def test_half_characters_do_not_stop_saving():
    odd = program(start={"speed": Unread("\udcb0x\x7f\x00", "why")})
    speed = loads(dumps(odd), "x").blocks[0].speed
    assert isinstance(speed, Unread)
    assert speed.text == "?x\x7f\x00"


def test_a_whole_number_may_stand_for_a_length():
    assert loads(TEXT.replace("x_start = -1.0", "x_start = -1"), "x").blocks[0].x_start == Entry(-1.0)


def test_blanks_stay_blank():
    empty = loads('format = 1\nunits = "MM"\n', "x")
    assert empty == Program(unit=Unit.MM)
    bare = 'format = 1\nunits = "MM"\n[[block]]\nkind = "MILL CONTOUR"\ncutter_comp = "ON"\n'
    assert loads(bare, "x").blocks[0].x_start is None


def test_a_number_out_of_its_fields_range_is_kept_for_the_form_to_show():
    text = TEXT.replace("diameter = 0.5", "diameter = -0.5").replace("speed = 300", "speed = -1")
    assert loads(text, "x").tools[0].diameter == Entry(-0.5)
    assert loads(text, "x").blocks[0].speed == Entry(-1.0)


@pytest.mark.parametrize("path", sorted(BAD.glob("*.toml")), ids=lambda path: path.stem)
def test_bad_files_are_refused_by_line_and_key(path):
    before = path.read_bytes()
    with pytest.raises(StoreError) as refused:
        load(path)
    assert path.with_suffix(".txt").read_text().strip() in refused.value.text
    assert refused.value.text.startswith(f"{path}")
    assert path.read_bytes() == before


@pytest.mark.parametrize("length", range(0, len(TEXT), 7))
def test_a_truncated_file_is_a_shorter_program_or_refused(length):
    try:
        read = loads(TEXT[:length], "part.toml")
    except StoreError as error:
        read = None
        message = error.text
    if read is None:
        assert message.startswith("part.toml")
    else:
        assert len(read.blocks) <= 1


def test_truth_values_are_told_as_the_file_has_them():
    told = [loads_refused(TEXT.replace('"IN"', value, 1)) for value in ("true", "[true, [false, 1.5]]")]
    assert [text.partition(":")[0] for text in told] == [
        "units cannot be true",
        "units cannot be [true, [false, 1.5]]",
    ]
    assert "format cannot be true: " in loads_refused(TEXT.replace("format = 1", "format = true"))


def loads_refused(text: str) -> str:
    with pytest.raises(StoreError) as refused:
        loads(text, "part")
    return str(refused.value).partition("line ")[2].partition(": ")[2]


def test_a_syntax_error_says_line_and_column():
    with pytest.raises(StoreError, match=r"part.toml, line 3, column 5: Invalid value. Correct it there"):
        loads('format = 1\nunits = "IN"\nx = ]\n', "part.toml")


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.toml")), ids=lambda path: path.stem)
def test_examples_are_as_this_program_writes_them(path):
    assert dumps(load(path)) == path.read_text()


@settings(derandomize=True, max_examples=100, deadline=None)
@given(st.floats(-393700.0, 393700.0), st.sampled_from(Unit))
def test_what_could_be_read_can_be_read_in_the_other_unit_too(value, unit):
    text = dumps(program(start={"x_start": Entry(value)}, unit=unit))
    part = loads(text, "x")
    other = Unit.IN if unit is Unit.MM else Unit.MM
    turned = set_unit(part, other)
    assert loads(dumps(turned), "x") == turned


def test_output_is_never_written_over_a_program(tmp_path):
    part, other, fresh = tmp_path / "part.toml", tmp_path / "renamed", tmp_path / "part.nc"
    save(Program(), part)
    other.write_bytes(part.read_bytes())
    for target in (part, other, tmp_path / "new.toml"):
        with pytest.raises(StoreError, match="Name another file"):
            write_output(target, "M2")
    assert part.read_bytes() == other.read_bytes()
    assert load(part) == Program()
    write_output(fresh, "M2")
    assert fresh.read_text() == "M2"


def test_output_does_not_wait_for_a_pipe(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(StoreError, match="this is not a file"):
        write_output(tmp_path / "pipe", "M2")
