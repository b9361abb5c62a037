"""The tool table as blocks call it."""

from __future__ import annotations

import pytest

from core.finding import Severity
from core.program.model import Entry, Program, Tool, Unread
from core.program.tools import called_tool, find_tool, tool_diameter
from core.units import Unit

TABLE = Program(tools=(Tool(1, "END MILL", Entry(0.5)), Tool(4, "BALL MILL")))


def test_find():
    assert find_tool(TABLE, 1) == Tool(1, "END MILL", Entry(0.5))
    assert find_tool(TABLE, 2) is None


def test_a_tool_that_is_there():
    tool = called_tool(TABLE, Entry(1.0), "tool")
    assert (tool.type, tool.diameter, tool.findings) == ("END MILL", 12.7, ())


def test_a_missing_tool():
    (finding,) = called_tool(TABLE, Entry(2.0), "finish_tool").findings
    assert (finding.code, finding.severity, finding.field) == ("TOOL_MISSING", Severity.ERROR, "finish_tool")
    assert finding.text == "Tool 2 is not in the tool table: add it on TOOL SETUP, or call another."


@pytest.mark.parametrize(("typed", "name"), [(None, "tool"), (Unread("x", "why"), "tool"), (Entry(0.0), "finish_tool")])
def test_nothing_is_called(typed, name):
    tool = called_tool(TABLE, typed, name)
    assert (tool.type, tool.diameter, tool.findings) == ("", None, ())


@pytest.mark.parametrize(
    ("typed", "words"),
    [
        (None, "it is blank"),
        (Entry(0.0), "must be above 0, and it is 0"),
        (Entry(-0.5), "must be above 0, and it is -0.5"),
        (Entry(float("nan")), "must be above 0, and it is nan"),
        (Unread("1,5", "why"), "1,5 cannot be read"),
    ],
)
def test_a_diameter_that_cannot_be_used(typed, words):
    tool = Tool(3, diameter=typed)
    found = called_tool(Program(tools=(tool,)), Entry(3.0), "tool", Severity.WARNING)
    assert found.diameter is None
    assert (found.findings[0].code, found.findings[0].severity) == ("TOOL_DIAMETER", Severity.WARNING)
    assert words in found.findings[0].text
    assert tool_diameter(tool, Unit.IN) is None


def test_a_diameter_beyond_any_tool_is_refused_as_a_typed_one_is():
    part = Program(tools=(Tool(1, diameter=Entry(20000.0)),))
    found = called_tool(part, Entry(1.0), "tool")
    assert found.diameter is None
    assert [one.text for one in found.findings] == ["Tool 1: TOOL DIAMETER must be above 0, at most 10000."]
