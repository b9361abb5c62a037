"""The tool table: tools that fields call, and the import of LinuxCNC tables."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.controls.control_tools import read_table
from core.finding import Finding, Severity
from core.program.model import Number, Program, Tool, Unread
from core.program.tools import (
    MAX_TABLE_LINES,
    ImportedTools,
    called_tool,
    decode_table,
    find_tool,
    read_tool_table,
    table_faults,
)
from core.units import Unit
from tests.properties import exercised, must_exercise

TABLE = Program(tools=(Tool(1, "END MILL", Number(0.5)), Tool(4, "BALL MILL")))


def test_find_tool_returns_the_tool_or_none():
    assert find_tool(TABLE, 1) == Tool(1, "END MILL", Number(0.5))
    assert find_tool(TABLE, 2) is None


def test_a_called_tool_has_its_type_and_diameter():
    tool = called_tool(TABLE, Number(1.0), "tool")
    assert (tool.type, tool.diameter, tool.findings) == ("END MILL", 12.7, ())


def test_a_missing_tool_is_an_error():
    (finding,) = called_tool(TABLE, Number(2.0), "finish_tool").findings
    assert (finding.code, finding.severity, finding.field) == ("TOOL_MISSING", Severity.ERROR, "finish_tool")
    assert finding.text == "Tool 2 is not in the tool table: add it on TOOL SETUP, or call another."


@pytest.mark.parametrize(
    ("typed", "name"), [(None, "tool"), (Unread("x", "why"), "tool"), (Number(0.0), "finish_tool")]
)
def test_a_blank_or_zero_tool_calls_nothing(typed, name):
    tool = called_tool(TABLE, typed, name)
    assert (tool.type, tool.diameter, tool.findings) == ("", None, ())


@pytest.mark.parametrize(
    ("typed", "words"),
    [
        (None, "it is blank"),
        (Number(0.0), "must be above 0"),
        (Number(-0.5), "must be above 0"),
        (Number(float("nan")), "must be above 0"),
        (Unread("1,5", "why"), "1,5 cannot be read"),
    ],
)
def test_an_unusable_diameter_is_reported(typed, words):
    tool = Tool(3, diameter=typed)
    called = called_tool(Program(tools=(tool,)), Number(3.0), "tool", Severity.WARNING)
    assert called.diameter is None
    assert (called.findings[0].code, called.findings[0].severity) == ("TOOL_DIAMETER", Severity.WARNING)
    assert words in called.findings[0].text


def test_a_diameter_out_of_range_is_refused():
    part = Program(tools=(Tool(1, diameter=Number(20000.0)),))
    called = called_tool(part, Number(1.0), "tool")
    assert called.diameter is None
    assert [finding.text for finding in called.findings] == ["Tool 1: TOOL DIAMETER must be above 0, at most 10000."]


LINUXCNC_TABLE = """\
; the mill by the window
T2 P2 Z1.25 D0.375 Q0 ;BALL MILL 3/8
T1 P1 D.5

t10 p3 x0 y0 d+1. i90 j-90;  FACE MILL
"""


def read(text: str, unit: Unit = Unit.IN, program: Unit = Unit.IN) -> ImportedTools:
    return read_tool_table(text, unit, program)


def refused(text: str) -> Finding:
    """The first error of a table that is not imported."""
    table = read(text)
    assert table.tools == ()
    return table.errors[0]


def test_a_table_is_sorted_by_number_with_remarks_as_types():
    table = read(LINUXCNC_TABLE)
    assert table.tools == (
        Tool(1, "END MILL", Number(0.5)),
        Tool(2, "BALL MILL 3/8", Number(0.375)),
        Tool(10, "FACE MILL", Number(1.0)),
    )
    assert table.findings == ()


@pytest.mark.parametrize(
    ("unit", "program", "value"),
    [(Unit.MM, Unit.IN, 0.5), (Unit.MM, Unit.MM, 12.7), (Unit.IN, Unit.MM, 322.58)],
)
def test_diameters_are_converted_from_the_unit_of_the_table(unit, program, value):
    assert read("T1 D12.7", unit, program).tools == (Tool(1, "END MILL", Number(value)),)


@pytest.mark.parametrize("line", ["T3 P3", "T3 P3 D0", "T3 P3 D-0.0"])
def test_a_tool_without_a_diameter_stays_blank_and_is_reported(line):
    table = read(f"T1 D.5\n{line}")
    assert table.tools[1] == Tool(3, "END MILL", None)
    (finding,) = table.findings
    assert (finding.severity, finding.line) == (Severity.WARNING, 2)
    assert finding.text == "Tool 3 has no diameter: it stays blank."


@pytest.mark.parametrize(
    ("text", "line", "column", "words"),
    [
        ("T1 D.5\nT2 D0,25", 2, 4, "D0,25 is not a word"),
        ("T1 D.5 hello", 1, 8, "hello is not a word"),
        ("T1 D1e3", 1, 6, "E is not a word"),
        ("T1 D1 D2", 1, 7, "D appears twice"),
        ("T1 G1", 1, 4, "G is not a word"),
        ("P1 D.5", 1, 1, "whole tool number"),
        ("P1 T1.5 D.5", 1, 4, "whole tool number"),
        ("T0 D.5", 1, 1, "from 1 to 9999"),
        ("T-1 D.5", 1, 1, "from 1 to 9999"),
        ("T10000 D.5", 1, 1, "from 1 to 9999"),
        ("T1 D-.5", 1, 4, "above 0"),
        ("T1 D999999", 1, 4, "above 0"),
        ("T1 D99999999999", 1, 4, "too large"),
        ("T1 D.5\n\nT1 D.25", 3, 1, "is already on line 1"),
        ("", 1, 1, "no tool in this table"),
        ("; nothing\n", 1, 1, "no tool in this table"),
        ("G1 X0 Y0 F100", 1, 1, "G is not a word"),
    ],
)
def test_a_table_with_a_fault_is_not_imported(text, line, column, words):
    finding = refused(text)
    assert (finding.line, finding.column) == (line, column)
    assert words in finding.text


def test_text_quoted_in_a_message_is_made_harmless():
    assert refused("T1 \x1b[2J{value}").text == "?[2J?value? is not a word of a tool table; write T1 P1 D.25 Z0."


def test_a_remark_becomes_a_type_without_control_characters():
    assert read("T1 D.5 ;END\x1b[31m\x07 MILL").tools[0].type == "END[31m MILL"
    assert len(read(f"T1 D.5 ;{'x' * 500}").tools[0].type) == 40


def test_a_file_with_too_many_lines_is_refused():
    assert "more than" in refused("T1 D.5\n" + ";\n" * MAX_TABLE_LINES).text


def test_all_line_ends_and_encodings_are_read():
    assert len(read("T1 D1\rT2 D2\r\nT3 D3\n").tools) == 3
    assert decode_table(b"\xef\xbb\xbfT1 ;\xc3\xb8") == "T1 ;\u00f8"
    assert decode_table(b"T1 ;\xf8") == "T1 ;\u00f8"


numbers = st.one_of(
    st.integers(0, 99).map(str),
    st.floats(0.0, 50.0).map("{:.3f}".format),
    st.sampled_from(["", "-1", "+.5", ".", "1e3", "0", "99999", "1.5.2"]),
)
words = st.builds("{}{}".format, st.sampled_from("TTDDPZQ"), numbers) | st.sampled_from([";END", "x", "{", "\x1b"])
lines_of_words = st.lists(words, max_size=4).map(" ".join)
tools = st.builds("T{} P{} D{}{}".format, st.integers(1, 12), st.integers(1, 12), numbers, st.sampled_from(["", " ;A"]))
sound_tools = st.builds("T{} P1 D{:.3f}".format, st.integers(1, 99), st.floats(0.001, 9.0))
tables = st.one_of(
    st.lists(sound_tools, min_size=1, max_size=4),
    st.lists(tools, min_size=1, max_size=3),
    st.lists(sound_tools | lines_of_words, max_size=4),
).map("\n".join)
"""Tables that are sound, nearly sound, or broken in one line."""


@must_exercise(0.2, "imported", "refused")
@settings(max_examples=150)
@given(tables)
def test_a_table_is_imported_whole_or_not_at_all(text):
    table = read(text)
    exercised("imported" if table.tools else "refused")
    assert bool(table.errors) == (table.tools == ())
    assert len({tool.number for tool in table.tools}) == len(table.tools)
    for tool in table.tools:
        assert tool.diameter is None or tool.diameter.value > 0.0
    for finding in table.findings:
        assert finding.text.isprintable()
        assert 1 <= finding.line <= text.count("\n") + 1


@given(st.text(alphabet="TDPZQ ;.-+0123456789\nex{\x1b", max_size=60))
def test_any_text_is_a_table_or_refused(text):
    table = read(text)
    assert bool(table.errors) == (table.tools == ())


@must_exercise(0.2)
@settings(max_examples=150)
@given(tables)
def test_the_reader_of_the_control_finds_the_same_tools(text):
    table, control = read(text), read_table(text.encode())[0]
    if table.tools:
        exercised()
    for tool in table.tools:
        control_tool = control.get(tool.number)
        assert control_tool is not None
        assert control_tool.diameter == (tool.diameter.value if tool.diameter else 0.0)


@pytest.mark.parametrize(("count", "more"), [(3, []), (4, ["t.tbl: 1 more fault."]), (5, ["t.tbl: 2 more faults."])])
def test_the_first_faults_of_a_table_are_listed_and_the_others_counted(count: int, more: list[str]) -> None:
    faults = [Finding("TOOL", Severity.ERROR, f"Fault {line}.", line=line, column=2) for line in range(1, count + 1)]
    listed = [f"t.tbl, line {line}, column 2: Fault {line}." for line in (1, 2, 3)]
    assert table_faults("t.tbl", faults).splitlines() == listed + more
