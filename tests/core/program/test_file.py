"""Program files read back as written; wrong or cut-off files are refused with line and key."""

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


def test_a_program_is_written_as_the_expected_text():
    assert dumps(PART) == TEXT


@settings(derandomize=True, max_examples=40, deadline=None)
@given(programs)
def test_every_program_reads_back_the_same(given_program):
    assert loads(dumps(given_program), "x") == given_program


def test_unreadable_text_is_kept_with_its_reason():
    z_bottom = loads(TEXT, "x").blocks[0].z_bottom
    assert isinstance(z_bottom, Unread)
    assert z_bottom.text == "-1/4x"
    assert z_bottom.reason.startswith("x is not a unit here")


def test_unread_text_never_becomes_a_number():
    z_bottom = loads(TEXT.replace("-1/4x", "-1/4"), "x").blocks[0].z_bottom
    assert z_bottom == Unread("-1/4", "Type it again.")


def test_surrogate_characters_do_not_prevent_saving():
    odd = program(start={"speed": Unread("\udcb0x\x7f\x00", "why")})
    speed = loads(dumps(odd), "x").blocks[0].speed
    assert isinstance(speed, Unread)
    assert speed.text == "?x\x7f\x00"


def test_a_length_may_be_a_whole_number():
    assert loads(TEXT.replace("x_start = -1.0", "x_start = -1"), "x").blocks[0].x_start == Number(-1.0)


def test_blanks_stay_blank():
    empty = loads('format = 1\nunits = "MM"\n', "x")
    assert empty == Program(unit=Unit.MM)
    bare = 'format = 1\nunits = "MM"\n[[block]]\nkind = "MILL CONTOUR"\ncutter_comp = "ON"\n'
    assert loads(bare, "x").blocks[0].x_start is None


def test_a_number_out_of_range_is_kept_for_the_form():
    text = TEXT.replace("diameter = 0.5", "diameter = -0.5").replace("speed = 300", "speed = -1")
    assert loads(text, "x").tools[0].diameter == Number(-0.5)
    assert loads(text, "x").blocks[0].speed == Number(-1.0)


@pytest.mark.parametrize(("name", "limit"), [("huge", "10,000,000 mm"), ("huge-radius", "10,000,000 mm")])
def test_a_number_too_large_for_any_machine_is_named_with_the_limit(name, limit):
    path = BAD / f"{name}.toml"
    with pytest.raises(StoreError, match=f"correct it. The largest is {limit}."):
        loads_bytes(path.read_bytes(), str(path))


@pytest.mark.parametrize("path", sorted(BAD.glob("*.toml")), ids=lambda path: path.stem)
def test_bad_files_are_refused_with_line_and_key(path):
    before = path.read_bytes()
    with pytest.raises(StoreError) as refused:
        loads_bytes(path.read_bytes(), str(path))
    assert path.with_suffix(".txt").read_text().strip() in refused.value.text
    assert refused.value.text.startswith(f"{path}")
    assert path.read_bytes() == before


@pytest.mark.parametrize("length", range(0, len(TEXT), 7))
def test_a_truncated_file_is_refused(length):
    with pytest.raises(StoreError) as refused:
        loads(TEXT[:length], "part.toml")
    assert refused.value.text.startswith("part.toml")


def test_messages_show_boolean_values_as_in_the_file():
    messages = [loads_refused(TEXT.replace('"IN"', value, 1)) for value in ("true", "[true, [false, 1.5]]")]
    assert [text.partition(":")[0] for text in messages] == [
        "units cannot be true",
        "units cannot be [true, [false, 1.5]]",
    ]
    assert "format cannot be true: " in loads_refused(TEXT.replace("format = 1", "format = true"))


def loads_refused(text: str) -> str:
    with pytest.raises(StoreError) as refused:
        loads(text, "part")
    return str(refused.value).partition("line ")[2].partition(": ")[2]


def test_a_syntax_error_names_line_and_column():
    with pytest.raises(StoreError, match=r"part.toml, line 3, column 5: Invalid value. Correct it there"):
        loads('format = 1\nunits = "IN"\nx = ]\n', "part.toml")


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_the_examples_are_exactly_as_the_program_writes_them(path):
    assert dumps(loads_bytes(path.read_bytes(), str(path))) == path.read_text()


@settings(derandomize=True, max_examples=100, deadline=None)
@given(st.floats(-393700.0, 393700.0), st.sampled_from(Unit))
def test_a_program_converted_to_the_other_unit_reads_back(value, unit):
    text = dumps(program(start={"x_start": Number(value)}, unit=unit))
    part = loads(text, "x")
    other = Unit.IN if unit is Unit.MM else Unit.MM
    turned = set_unit(part, other)
    assert loads(dumps(turned), "x") == turned


END = "# end of program"
WITHOUT_END = TEXT.replace(f'  # its last line is "{END}"', "").replace(f"\n{END}\n", "")


def refusal(text: str) -> str:
    with pytest.raises(StoreError) as refused:
        loads(text, "part.toml")
    return refused.value.text


def test_the_first_line_names_the_last_line():
    lines = TEXT.splitlines()
    assert lines[0] == f'format = 1  # its last line is "{END}"'
    assert lines[-1] == END


@pytest.mark.parametrize("path", [None, *EXAMPLES], ids=lambda path: "everything" if path is None else path.stem)
def test_a_file_cut_off_at_any_byte_is_refused_or_complete(path: Path | None) -> None:
    data = TEXT.encode() if path is None else path.read_bytes()
    for length in range(len(data)):
        result = outcome(data[:length])
        if isinstance(result, str):
            assert re.fullmatch(r"part.toml(, line \d+(, \w+)?)?: .+\.", result)
        else:
            assert (result, length) == (loads(data.decode(), "x"), len(data) - 1)


def outcome(data: bytes) -> Program | str:
    try:
        return loads_bytes(data, "part.toml")
    except StoreError as error:
        return error.text


def test_a_file_that_ends_inside_a_character_is_reported_as_cut_off() -> None:
    data = TEXT.replace("END MILL", "FR\u00c4SER").encode()
    with pytest.raises(StoreError, match=r'part.toml, line 9: cut off after "type = .*": the last line'):
        loads_bytes(data[: data.index(b"\xc3") + 1], "part.toml")


def test_the_message_of_a_cut_off_file_names_the_last_line_and_what_to_do():
    cut = TEXT[: TEXT.index("y_end = 0.1") + len("y_end = 0")]
    line = cut.count("\n") + 1
    assert refusal(cut) == (
        f'part.toml, line {line}: cut off after "y_end = 0": the last line, "{END}", is missing. '
        "Open a saved copy or an earlier version; if nothing is missing, add that line."
    )


def test_blank_lines_after_the_cut_are_not_the_last_line():
    cut = TEXT[: TEXT.index("y_end = 0.1")] + "\n  \n\n"
    assert f'line {TEXT[: TEXT.index("y_end = 0.1")].count(chr(10))}: cut off after "x_end = 2.0"' in refusal(cut)


@pytest.mark.parametrize(
    "text",
    [
        TEXT.replace("\n", "\r\n"),
        TEXT.rstrip(),
        TEXT + "\n\n",
        TEXT.replace(END + "\n", f"  {END}  \n"),
        WITHOUT_END,
        WITHOUT_END + f"\n{END}\n",
    ],
    ids=["dos", "no line feed", "blank lines", "indented", "older", "end alone"],
)
def test_files_changed_by_editors_or_mail_and_older_files_are_read(text: str) -> None:
    assert dumps(loads(text, "x")) == TEXT


@pytest.mark.parametrize("key", ["rapid_feed", "rapid_rate"])
def test_the_rapid_rate_is_read_under_its_key_and_its_older_one(key: str) -> None:
    read = loads(f'format = 2\nunits = "IN"\n[parameters]\n{key} = 150.0\n', "part.toml")
    assert read.parameters.rapid_feed == Number(150.0)
    assert "rapid_feed = 150.0" in dumps(read)


def test_a_segment_added_after_the_end_line_is_read():
    more = TEXT + '[[block.segment]]\nkind = "LINE"\nx_end = 4.0\n'
    assert len(loads(more, "x").blocks[0].segments) == len(PART.blocks[0].segments) + 1


def test_a_part_name_like_the_end_line_is_not_the_end():
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
def test_an_older_file_that_stops_in_the_middle_of_a_line_may_be_cut_off(cut: str, said: str | None) -> None:
    position = WITHOUT_END.index(cut[:6] if cut.startswith("x_st") else cut)
    text = WITHOUT_END[:position] + cut
    if said is None:
        loads(text, "x")
        return
    message = refusal(text)
    assert message.startswith(f"part.toml, {said}")
    assert message.endswith(" The file may be cut off there: open a saved copy or an earlier version, or fix the line.")


def test_a_fault_in_a_complete_file_is_reported_for_its_line():
    assert refusal(TEXT.replace("x_end = 2.0", "x_end = 2.0.1")).endswith("Correct it there, or open a saved copy.")


@pytest.mark.parametrize("begin", ["", "  "])
def test_a_duplicate_key_is_named(begin: str) -> None:
    message = refusal(WITHOUT_END.replace("speed = 300", f"speed = 300\n{begin}speed = 400"))
    line = WITHOUT_END[: WITHOUT_END.index("speed = 300")].count("\n") + 2
    assert message == f"part.toml, line {line}: speed appears twice: remove one."


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


def test_a_missing_key_has_the_line_of_its_table():
    lines = key_lines(KEYS)
    assert line_of(lines, ("block", 1, "segment", 0, "y_end")) == 17
    assert line_of(lines, ("units",)) == 1
    assert line_of(lines, ("block", 7, "tool")) == 1


def test_dotted_keys_have_lines():
    assert key_lines("setup.name = 'A'\n")["setup", "name"] == 1


def test_a_file_that_is_not_utf_8_is_refused_with_its_line() -> None:
    with pytest.raises(StoreError, match=r"^part\.toml, line 3: this is not UTF-8 text\."):
        loads_bytes("# a\n# b\n# größer\n# c\n".encode("latin-1"), "part.toml")
