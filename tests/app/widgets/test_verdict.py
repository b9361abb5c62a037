"""The verdict's lines: a finding begins with what it weighs."""

from __future__ import annotations

from dataclasses import replace

import pytest

from app.documents.files import load
from app.documents.programs import example
from app.painted.widgets.rows import text_of
from app.painted.widgets.verdict import verdict_rows
from core.finding import Finding, Severity
from core.pipeline.derive import derive, look_ahead_table
from core.pipeline.outline import outline
from core.program.model import Number
from core.units import Unit
from tests.app.squares import square


@pytest.mark.parametrize(("weight", "mark"), [("error", "!!"), ("warning", "! "), ("info", "i ")])
def test_error_warning_and_information_have_marks_of_their_own(weight: str, mark: str) -> None:
    one = Finding("ANY", Severity(weight), "Told.")
    found = replace(outline(square().session.program).blocks[0], findings=(one,))
    told = [text_of(row) for row in verdict_rows(found, None, Unit.IN, None)]
    assert f" {mark} Told." in told


def test_where_start_lies_elsewhere_that_is_told_before_what_comes_of_it() -> None:
    pocket = load(example("pocket"))
    (block,) = pocket.blocks
    (found,) = derive(replace(pocket, blocks=(replace(block, y_start=Number(7.0)),))).blocks
    told = [text_of(row) for row in verdict_rows(found, None, Unit.IN, None)]
    assert told[1] == " i  The contour is open: it ends 6.7500 from START."
    assert told[2].startswith(" GOUGE ")
    assert sum("from START" in row for row in told) == 1


def test_an_over_run_gouges_nothing_and_is_told() -> None:
    (found,) = derive(load(example("overrun-square"))).blocks
    assert {"OVER_RUN", "OPEN"} <= {one.code for one in found.findings}
    rows = [text_of(row) for row in verdict_rows(found, None, Unit.IN, None)]
    assert any("GOUGE none" in row for row in rows)


def test_a_contour_that_does_not_cross_itself_begins_with_its_gouge_and_where_it_is_not_closed() -> None:
    pocket = load(example("pocket"))
    (block,) = pocket.blocks
    (found,) = derive(replace(pocket, blocks=(replace(block, y_start=Number(0.5)),))).blocks
    assert "CROSSES_ITSELF" not in {one.code for one in found.findings}
    _, gouge, end, *_ = (text_of(row) for row in verdict_rows(found, None, Unit.IN, None))
    assert gouge.startswith(" GOUGE ")
    assert "is not closed: it ends 0.2500 from START, at X 2.0000 Y 0.2500" in end


def test_beside_every_value_of_the_table_stands_what_the_contour_needs_and_nothing_of_the_path_in_force() -> None:
    program = square().session.program
    found = replace(derive(program).blocks[0], findings=())
    why = Finding("CAL_NOT_CLEAN", Severity.WARNING, "Why.")
    apart = Finding("BEST_DIFFERS", Severity.INFO, "Apart.")
    table = look_ahead_table(found, program)
    assert table is not None
    told = [text_of(row) for row in verdict_rows(found, replace(table, notes=(why, apart)), Unit.IN, 3)]
    assert told[-1] == " !  Why."
    assert " i  Apart." not in told


def test_what_stays_uncut_stands_behind_the_first_pair_that_deletes() -> None:
    pocket = load(example("pocket"))
    program = replace(pocket, tools=tuple(replace(tool, diameter=Number(2.625)) for tool in pocket.tools))
    (found,) = derive(program).blocks
    told = [text_of(row) for row in verdict_rows(found, None, Unit.IN, None)]
    begins = [row.split()[0] for row in told if row.split()[0] in ("DELETED", "UNCUT")]
    assert begins[:2] == ["DELETED", "UNCUT"]
    assert begins.count("DELETED") > 1


@pytest.mark.parametrize("look", [None, 1, 20])
def test_lines_that_nobody_reads_are_counted_and_the_others_are_the_same(look: int | None) -> None:
    for name, diameter in (("pocket", 2.625), ("notch", 0.5), ("overrun-square", 0.25)):
        program = load(example(name))
        program = replace(program, tools=tuple(replace(tool, diameter=Number(diameter)) for tool in program.tools))
        (found,) = derive(program).blocks
        table = look_ahead_table(found, program)
        every = verdict_rows(found, table, Unit.IN, look)
        for most in range(len(every) + 2):
            read = verdict_rows(found, table, Unit.IN, look, most)
            assert read == [*every[:most], *[()] * (len(every) - most)]
