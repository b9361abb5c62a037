"""A short walk of the monkey; `python -m tests.reports.monkey` is the long one."""

from __future__ import annotations

import gc
from pathlib import Path
from random import Random
from typing import Any
from weakref import ref

import pytest

from app.documents.files import load
from app.documents.nc_text import NcText
from app.documents.programs import empty_program, example
from app.painted.memory import Memory
from app.painted.nc_keeping import Kept, NcKeeping
from app.painted.screens.save import SaveAsPage
from app.painted.session import Session
from core.program.file.read import StoreError
from core.program.file.write import dumps
from tests.app.operator import Operator
from tests.reports import monkey
from tests.reports.monkey import MEGABYTE, Tally, report, run, screens, through_textual
from tests.reports.monkey_keys import Coverage, Monkey
from tests.reports.reference import Reference


def test_random_keys_on_every_screen() -> None:
    tally = run(2000, seed=3)
    assert tally.wrong == []
    assert tally.keys >= 2000
    assert tally.looks >= 90
    assert len(set(tally.coverage.screens) & set(screens())) >= 10


def test_an_app_that_is_over_is_collected() -> None:
    gone = ref(Reference(Session.of(empty_program())))
    gc.collect()
    assert gone() is None


async def test_random_keys_through_textual() -> None:
    assert await through_textual(15, seed=1) == []


def test_the_same_seed_presses_the_same_keys() -> None:
    first, second = run(150, seed=5), run(150, seed=5)
    assert first.coverage.pressed == second.coverage.pressed
    assert (first.keys, first.edits, first.lives) == (second.keys, second.edits, second.lives)


def test_a_screen_that_remembers_too_much_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    def stale(self: Memory, name: str, about: tuple[Any, ...], make: Any) -> Any:
        return self.answers.setdefault(name, (about, make()))[1]

    monkeypatch.setattr(Memory, "recall", stale)
    assert any("drawn anew" in text for text in run(300, seed=1).wrong)


def test_a_program_that_does_not_come_back_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(monkey, "dumps", lambda program: dumps(program).replace("speed", "x_speed"))
    with pytest.raises(StoreError):
        run(200, seed=1)


@pytest.mark.parametrize("field", [2, 3, 6, 7])
def test_what_the_contour_needs_is_told_the_same_while_a_number_is_typed(field: int) -> None:
    app = Reference(Session.of(load(example("notch")))).press(*["tab"] * field, *"-1+1/8")
    assert app.lines(132, 43) == app.fresh(132, 43)


def test_a_change_of_an_nc_file_that_is_not_kept_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    def forget(_: NcKeeping, one: Kept, listing: NcText) -> None:
        one.listing = listing

    monkeypatch.setattr(NcKeeping, "_write", forget)
    told = (text for seed in range(1, 9) for text in run(400, seed).wrong)
    assert any("does not bring back the NC file" in text for text in told)


def test_nothing_acts_outside_the_cage(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    one = Monkey(Random(1), tmp_path)
    operator = Operator.at().press("f8", "ctrl+s", *str(tmp_path / "part"))
    assert isinstance(operator.desk.page, SaveAsPage)
    assert one.caged(operator.desk, "enter") == "enter"
    operator.press(*"/../../other")
    assert [one.caged(operator.desk, key) for key in ("enter", "f1", "x")] == ["escape", "escape", "x"]


def test_the_report_names_what_was_not_reached() -> None:
    tally = Tally(keys=1, memory=[(1, MEGABYTE)])
    tally.coverage = Coverage(seen={("DrawPage", 1, "ALL"), ("DrawPage", 2, "IN")})
    tally.coverage.pressed["DrawPage", 1, "ALL"] += 1
    told = list(report(tally, 1.0))
    assert "softkeys 1 of 2, not DrawPage F2 IN" in told
    assert told[-1] == "failures 0"
