"""What the engine keeps from key to key."""

from __future__ import annotations

import pytest

from app.engine import Engine
from app.files import example
from core.pipeline.derive import derive
from core.pipeline.derived import DerivedBlock
from core.program.edit import Where, type_field
from core.program.model import Entry, Program
from core.program.store import load

PART = load(example("overrun-square"))


@pytest.fixture
def engine() -> Engine:
    engine = Engine(ready=True)
    found = derive(PART).blocks[0]
    engine.keep_table(found, PART)
    engine.keep_needs(found, PART)
    return engine


def changed(where: Where, field: str, value: float) -> tuple[DerivedBlock, Program]:
    """The block after one number was typed."""
    program = type_field(PART, where, field, Entry(value))
    assert isinstance(program, Program)
    return derive(program, derive(PART)).blocks[0], program


def test_another_path_has_another_table(engine: Engine) -> None:
    found, program = changed(Where(1, 1), "x_end", 2.5)
    assert not engine.tabulated(found)
    assert engine.known(found, None).table is None
    engine.keep_table(found, program)
    assert engine.tabulated(found)
    assert engine.lacks_needs(found)


def test_another_depth_keeps_the_table_and_what_the_contour_needs() -> None:
    engine, before = Engine(ready=True), derive(PART)
    engine.keep_table(before.blocks[0], PART)
    engine.keep_needs(before.blocks[0], PART)
    program = type_field(PART, Where(1, 0), "z_bottom", Entry(-0.5))
    assert isinstance(program, Program)
    found = derive(program, before).blocks[0]
    assert found is not before.blocks[0]
    assert engine.tabulated(found)
    assert not engine.lacks_needs(found)
    assert engine.known(found, None).table is engine.known(before.blocks[0], None).table
