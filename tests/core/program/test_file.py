"""Program files: what is written reads back the same, what is wrong or cut off is named by line and key."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.program.edit import set_unit
from core.program.file.faults import key_lines, line_of
from core.program.file.read import StoreError, loads, loads_bytes
from core.program.file.write import dumps
from core.program.model import Number, Program, Unread
from core.units import Unit
from tests.core.program.parts import program, programs
from tests.core.program.stored import PART, TEXT

BAD = Path(__file__).parents[2] / "data" / "bad" / "program"


EXAMPLES = sorted((Path(__file__).parents[3] / "app" / "examples").glob("*.toml"))


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
    assert z_bottom.reason.startswith("x is not a unit here")


def test_unread_text_that_could_be_read_now_never_becomes_a_number():
    z_bottom = loads(TEXT.replace("-1/4x", "-1/4"), "x").blocks[0].z_bottom
    assert z_bottom == Unread("-1/4", "Type it again.")


def test_half_characters_do_not_stop_saving():
    odd = program(start={"speed": Unread("\udcb0x\x7f\x00", "why")})
    speed = loads(dumps(odd), "x").blocks[0].speed
    assert isinstance(speed, Unread)
    assert speed.text == "?x\x7f\x00"


def test_a_whole_number_may_stand_for_a_length():
    assert loads(TEXT.replace("x_start = -1.0", "x_start = -1"), "x").blocks[0].x_start == Number(-1.0)


def test_blanks_stay_blank():
    empty = loads('format = 1\nunits = "MM"\n', "x")
    assert empty == Program(unit=Unit.MM)
    bare = 'format = 1\nunits = "MM"\n[[block]]\nkind = "MILL CONTOUR"\ncutter_comp = "ON"\n'
    assert loads(bare, "x").blocks[0].x_start is None


def test_a_number_out_of_its_fields_range_is_kept_for_the_form_to_show():
    text = TEXT.replace("diameter = 0.5", "diameter = -0.5").replace("speed = 300", "speed = -1")
    assert loads(text, "x").tools[0].diameter == Number(-0.5)
    assert loads(text, "x").blocks[0].speed == Number(-1.0)


@pytest.mark.parametrize("path", sorted(BAD.glob("*.toml")), ids=lambda path: path.stem)
def test_bad_files_are_refused_by_line_and_key(path):
    before = path.read_bytes()
    with pytest.raises(StoreError) as refused:
        loads_bytes(path.read_bytes(), str(path))
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


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_examples_are_as_this_program_writes_them(path):
    assert dumps(loads_bytes(path.read_bytes(), str(path))) == path.read_text()


@settings(derandomize=True, max_examples=100, deadline=None)
@given(st.floats(-393700.0, 393700.0), st.sampled_from(Unit))
def test_what_could_be_read_can_be_read_in_the_other_unit_too(value, unit):
    text = dumps(program(start={"x_start": Number(value)}, unit=unit))
    part = loads(text, "x")
    other = Unit.IN if unit is Unit.MM else Unit.MM
    turned = set_unit(part, other)
    assert loads(dumps(turned), "x") == turned


END = "# end of program"
UNTOLD = TEXT.replace(f'  # its last line is "{END}"', "").replace(f"\n{END}\n", "")


def refusal(text: str) -> str:
    with pytest.raises(StoreError) as refused:
        loads(text, "part.toml")
    return refused.value.text


def test_a_file_says_what_its_last_line_is():
    lines = TEXT.splitlines()
    assert lines[0] == f'format = 1  # its last line is "{END}"'
    assert lines[-1] == END


@pytest.mark.parametrize("path", [None, *EXAMPLES], ids=lambda path: "everything" if path is None else path.stem)
def test_cut_at_any_byte_it_is_the_whole_program_or_refused(path: Path | None) -> None:
    data = TEXT.encode() if path is None else path.read_bytes()
    for length in range(len(data)):
        found = outcome(data[:length])
        if isinstance(found, str):
            assert re.fullmatch(r"part.toml(, line \d+(, \w+)?)?: .+\.", found)
        else:
            assert (found, length) == (loads(data.decode(), "x"), len(data) - 1)


def outcome(data: bytes) -> Program | str:
    try:
        return loads_bytes(data, "part.toml")
    except StoreError as error:
        return error.text


def test_a_name_cut_in_the_middle_of_a_letter_is_a_file_cut_off() -> None:
    data = TEXT.replace("END MILL", "FR\u00c4SER").encode()
    with pytest.raises(StoreError, match=r'part.toml, line 9: cut off after "type = .*": the last line'):
        loads_bytes(data[: data.index(b"\xc3") + 1], "part.toml")


def test_the_sentence_names_the_last_line_and_what_to_do():
    cut = TEXT[: TEXT.index("y_end = 0.1") + len("y_end = 0")]
    line = cut.count("\n") + 1
    assert refusal(cut) == (
        f'part.toml, line {line}: cut off after "y_end = 0": the last line, "{END}", is missing. '
        "Open a saved copy or an earlier version; if nothing is missing, add that line."
    )


def test_blank_lines_behind_the_cut_are_not_its_last_line():
    cut = TEXT[: TEXT.index("y_end = 0.1")] + "\n  \n\n"
    assert f'line {TEXT[: TEXT.index("y_end = 0.1")].count(chr(10))}: cut off after "x_end = 2.0"' in refusal(cut)


@pytest.mark.parametrize(
    "text",
    [
        TEXT.replace("\n", "\r\n"),
        TEXT.rstrip(),
        TEXT + "\n\n",
        TEXT.replace(END + "\n", f"  {END}  \n"),
        UNTOLD,
        UNTOLD + f"\n{END}\n",
    ],
    ids=["dos", "no line feed", "blank lines", "indented", "older", "end alone"],
)
def test_what_editors_and_mail_do_to_a_file_and_older_files_are_no_trouble(text: str) -> None:
    assert dumps(loads(text, "x")) == TEXT


def test_a_segment_added_by_hand_behind_the_end_counts():
    more = TEXT + '[[block.segment]]\nkind = "LINE"\nx_end = 4.0\n'
    assert len(loads(more, "x").blocks[0].segments) == len(PART.blocks[0].segments) + 1


def test_a_text_that_reads_like_the_end_is_not_the_end():
    named = Program(setup=Program().setup.__class__(name=END))
    text = dumps(named)
    assert loads(text, "x") == named
    assert "cut off" in refusal(text.removesuffix(f"{END}\n"))


@pytest.mark.parametrize(
    ("cut", "said"),
    [
        ("x_start =", "line 17, x_start: Invalid value."),
        ("x_start = -", "line 17, x_start: Invalid value."),
        ("x_st", "line 17: Expected '=' after a key in a key/value pair."),
        ("speed = 30", None),
        ('kind = "LI', "line 29, kind: Unterminated string."),
        ("[[block.segm", "line 28: Expected ']]' at the end of an array declaration."),
    ],
)
def test_a_file_without_an_end_that_stops_in_the_middle_of_a_line_may_be_cut_off(cut: str, said: str | None) -> None:
    where = UNTOLD.index(cut[:6] if cut.startswith("x_st") else cut)
    text = UNTOLD[:where] + cut
    if said is None:
        loads(text, "x")
        return
    told = refusal(text)
    assert told.startswith(f"part.toml, {said}")
    assert told.endswith(" The file may be cut off there: open a saved copy or an earlier version, or fix the line.")


def test_a_fault_in_the_middle_is_a_fault_of_its_line():
    assert refusal(TEXT.replace("x_end = 2.0", "x_end = 2.0.1")).endswith("Correct it there, or open a saved copy.")


@pytest.mark.parametrize("begin", ["", "  "])
def test_a_key_that_stands_twice_is_named(begin: str) -> None:
    told = refusal(UNTOLD.replace("speed = 300", f"speed = 300\n{begin}speed = 400"))
    line = UNTOLD[: UNTOLD.index("speed = 300")].count("\n") + 2
    assert told == f"part.toml, line {line}: speed appears twice: remove one."


KEYS = """\
format = 1
[parameters]
  max_offset = 1.0   # a comment = none
[[tool]]
number = 1
[[ block ]]   # first
tool = 1
[block.unread]
speed = "x"
[[block.segment]]
kind = "LINE"
[[block.segment]]
"x_end" = 1.0
[block.segment.unread]
y_end = "q"
[[block]]
[[block.segment]]
x_end = 2.0
"""


def test_every_key_has_its_line():
    lines = key_lines(KEYS)
    assert lines["format",] == 1
    assert lines["parameters", "max_offset"] == 3
    assert lines["tool", 0, "number"] == 5
    assert lines["block", 0] == 6
    assert lines["block", 0, "unread", "speed"] == 9
    assert lines["block", 0, "segment", 0, "kind"] == 11
    assert lines["block", 0, "segment", 1, "x_end"] == 13
    assert lines["block", 0, "segment", 1, "unread", "y_end"] == 15
    assert lines["block", 1, "segment", 0, "x_end"] == 18


def test_a_key_that_is_not_there_has_the_line_of_its_table():
    lines = key_lines(KEYS)
    assert line_of(lines, ("block", 1, "segment", 0, "y_end")) == 17
    assert line_of(lines, ("units",)) == 1
    assert line_of(lines, ("block", 7, "tool")) == 1


def test_dotted_keys():
    assert key_lines("setup.name = 'A'\n")["setup", "name"] == 1
