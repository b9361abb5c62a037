"""Many blocks at once give the same run as one block after the other: moves to the last bit, findings, stretches."""

from __future__ import annotations

from random import Random

import pytest

from core.controls.iso import flow
from core.controls.iso.words import read_line
from core.controls.moves import Moves
from core.controls.registry import UnknownControl, names, run
from core.controls.report import Log, Run
from core.controls.series import road
from core.controls.series.words import plain_words
from core.controls.tools import ToolTable
from core.units import Unit
from tests.core.controls.klartext.test_mutations import mutated
from tests.core.controls.programs import RADIUS, long, program
from tests.core.controls.series.written import CLEAN, OTHERS, written

ISO = [name for name in names() if not name.startswith("klartext")]
LENGTHS = ((1, 1, 3), (1, 2, 64), (5, 8, 8192))
"""From how many lines on, how many at least and at most are tried at a time."""


class Counted(road.Road):
    """A road that counts the lines it runs at once."""

    at_once = 0

    def _run(self, lines, flow, machine) -> int:
        count = super()._run(lines, flow, machine)
        Counted.at_once += count
        return count


@pytest.fixture
def counted(monkeypatch: pytest.MonkeyPatch) -> type[Counted]:
    """The lines that are run at once, counted from here on."""
    monkeypatch.setattr("core.controls.iso.runner.Road", Counted)
    Counted.at_once = 0
    return Counted


def one_by_one(text: bytes, control: str, tools: ToolTable) -> Run:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(road.Road, "ahead", lambda _, flow, __: flow.at < len(flow.lines))
        return done(text, control, tools)


def at_once(text: bytes, control: str, tools: ToolTable, lengths: tuple[int, int, int]) -> Run:
    least, few, many = lengths
    with pytest.MonkeyPatch.context() as patch:
        for name, value in (("LEAST", least), ("FEW", few), ("MANY", many), ("LONGEST", 3)):
            patch.setattr(road, name, value)
        return done(text, control, tools)


def done(text: bytes, control: str, tools: ToolTable) -> Run:
    made = run(text, control, tools)
    assert not isinstance(made, UnknownControl)
    return made


def columns(moves: Moves) -> tuple[list[float], ...]:
    every = (moves.points, moves.centers, moves.turns, moves.planes, moves.rapid, moves.feeds, moves.lines)
    return tuple(column.tolist() for column in every)


def said(made: Run) -> list[object]:
    """Everything of a run."""
    stretches = [
        (
            one.side,
            one.radius,
            one.plane,
            one.entry,
            one.exit,
            one.first,
            one.last,
            one.changes,
            columns(one.programmed),
        )
        for one in made.stretches
    ]
    return [made.unit, made.stopped_at, made.findings, columns(made.moves), stretches]


def same(text: bytes, control: str, diameter: float, lengths: tuple[int, int, int]) -> None:
    tools = ToolTable.diameters({1: diameter}, Unit.MM)
    slow, fast = one_by_one(text, control, tools), at_once(text, control, tools, lengths)
    for one, other in zip(said(slow), said(fast), strict=True):
        assert one == other, (control, diameter, lengths, text.decode("latin-1"))


@pytest.mark.parametrize("control", ISO)
def test_written_programs(control: str, counted: type[Counted]) -> None:
    for seed in range(60):
        text = written(seed, absolute=control == "threeblock", others=CLEAN if seed % 3 else OTHERS)
        same(text.encode(), control, Random(seed).choice((0.0, 0.2, 1.0, -0.5)), LENGTHS[seed % 3])
    assert counted.at_once > 120


@pytest.mark.parametrize("control", ISO)
def test_mutated_programs(control: str, counted: type[Counted]) -> None:
    random = Random(control)
    for seed in range(60):
        text = mutated(written(seed, absolute=control == "threeblock", others=CLEAN).encode(), random)
        same(text, control, 0.2, LENGTHS[seed % 3])
    assert counted.at_once > 50


@pytest.mark.parametrize("control", ["linuxcnc", "nine-series:a", "nine-series:b-g39.1"])
def test_corners_as_large_as_the_cutter(control: str, counted: type[Counted]) -> None:
    for seed in range(500 if control == "linuxcnc" else 200):
        same(program(seed).encode(), control, 2 * RADIUS, (1, 1, 3))
    assert counted.at_once > 120


@pytest.mark.parametrize("side", ["G41", "G42"])
@pytest.mark.parametrize("control", ["linuxcnc", "nine-series:a", "nine-series:b-g39.1"])
def test_exact_reversals(control: str, side: str, counted: type[Counted]) -> None:
    ways = ("X9\nX5\nX20", "X9\nG3 X4 Y-5 J-5\nG1 X4 Y-9", "X9\nG2 X4 Y5 J5\nG1 X4 Y9", "G3 X10 Y10 J5\nG1 X15\nX3")
    for way in ways:
        same(f"G21 G90 F9\nG0 X-9 Y0\n{side} D1\nG1 X-3\nX0\n{way}\nG40\nY99\nM2\n".encode(), control, 1.0, (1, 1, 3))
    assert counted.at_once > 4


@pytest.mark.parametrize(
    "between", ["G1 Z-1.", "G1 Z-1.\nZ-2.", "D2", "G42 D1", "G42 D2", "G54", "G4 P1", "G1 X9. Y3."]
)
@pytest.mark.parametrize("control", ISO)
def test_what_stands_before_a_run(control: str, between: str) -> None:
    """Moves of Z that wait, another radius or side, an entry anew."""
    tools = ToolTable.diameters({1: 0.2, 2: 0.5}, Unit.MM)
    points = [f"G1 X{x}. Y{y}." for x, y in ((0, 9), (9, 12), (12, 4), (20, 0), (30, 4), (33, -9), (20, -20), (9, -9))]
    head = "G21 G90 F9.\nT1\nG0 X-9. Y-9.\nG41 D1\nG1 X-3. Y-3.\nX0. Y0."
    text = "\n".join((head, *points[:2], between, *points[2:], "G40", "G1 X-50. Y-50.", "M2")).encode()
    for lengths in LENGTHS:
        assert said(one_by_one(text, control, tools)) == said(at_once(text, control, tools, lengths))


@pytest.mark.parametrize("control", ISO)
def test_long_programs_are_run_at_once(control: str, counted: type[Counted]) -> None:
    text = long(900).replace("G41 D1", "T1\nG41 D1").encode()
    same(text, control, 1.0, (road.LEAST, road.FEW, road.MANY))
    if control != "threeblock":
        assert counted.at_once > 800


def test_a_subprogram_that_is_called_again_and_again(counted: type[Counted]) -> None:
    body = "\n".join(f"G1 X{index % 7} Y{index % 5}" for index in range(40))
    text = f"G21 G90 F500\nM98 P1 L5\nM2\nO1\n{body}\nM99\n".encode()
    for control in ("linuxcnc", "rosettacnc", "nine-series"):
        same(text, control, 1.0, (road.LEAST, road.FEW, road.MANY))
    assert counted.at_once > 300


@pytest.mark.parametrize(
    "line", ["G1 X{} Y{}", "N10 G1 X{} Y{} F100", "g1 x{} y{}", "G1 X{} Y{} (a)", "G90 G1 X{} Y{}"]
)
def test_what_repeats_too_often_is_given_up_at_the_same_line(line: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(flow, "MOST_BLOCKS", 2000)
    body = "\n".join(line.format(index % 7, index % 5) for index in range(40))
    for end in ("M99", "M8\nM99"):
        text = f"G21 G90 F500\nG0 X-9 Y-9\nM98 P1 L9999\nM2\nO1\n{body}\n{end}\n".encode()
        same(text, "linuxcnc", 1.0, (road.LEAST, road.FEW, road.MANY))


PLAIN = ("G1 X1 Y2", "g01x.5y-.5", " N1 X 1 F2. ", "X+1", "X1.", "G3 X1 Y1 I1", "G1.0 X1", "X00001.50", "Y-0")
OTHER = (
    *("G1 X1 X2", "G1 G1 X1", "G4 X1", "G1.5 X1", "G-1 X1", "X1e3", "X- 1", "X1 .5", "X", "X1 (a)", "X1;", "/X1"),
    *(
        "",
        " ",
        "%",
        "X1 Y",
        "X12345678901",
        "X" + 400 * "9",
        "X1\u212a1",
        "\u0661",
        "X\u0661",
        "F1 F2 X1",
        "X1_0",
        "M3 X1",
    ),
)


@pytest.mark.parametrize("line", PLAIN)
def test_a_plain_line_is_what_one_by_one_it_is(line: str) -> None:
    words = plain_words(("X1", line, "Y2"))
    (block,) = read_line(line, 1, Log())
    assert words.count == 3
    assert {letter for letter, given in words.given.items() if given[1]} >= {*block.words}
    assert {letter: words.values[letter][1] for letter in block.words} == block.words
    assert block.g == ([10 * words.values["G"][1]] if "G" in line.upper() else [])
    assert not block.m
    assert block.data is None


@pytest.mark.parametrize("line", OTHER)
def test_other_lines_are_not_plain(line: str) -> None:
    assert plain_words(("X1", line, "Y2")).count == 1
