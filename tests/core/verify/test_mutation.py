"""The judge catches every spoiled path that gouges or leaves stock, and accuses none falsely."""

from __future__ import annotations

import pytest

from core.geometry.piece import Side
from core.verify.judge import judge
from tests.core.verify.corpus import corpus
from tests.core.verify.mutants import JUDGES, MUTATIONS, Table, tables


@pytest.fixture(scope="module")
def mutation_tables() -> dict[str, Table]:
    return tables(7, 4)


@pytest.mark.parametrize("parts", list(JUDGES))
@pytest.mark.parametrize("name", [mutation.__name__ for mutation in MUTATIONS])
def test_none_is_missed_and_none_falsely_accused(mutation_tables: dict[str, Table], parts: str, name: str) -> None:
    row = mutation_tables[parts][name]
    assert row.mutants > 0
    assert row.missed == 0
    assert row.falsely_accused == 0


def test_the_mutants_are_worth_judging(mutation_tables: dict[str, Table]) -> None:
    for rows in mutation_tables.values():
        assert sum(row.gouging for row in rows.values()) > 20
        assert sum(row.leaving for row in rows.values()) > 20
        for name in ("shift_all", "flip_an_arc", "narrower", "on_the_other_side"):
            assert rows[name].gouging > 0


def test_the_path_of_the_other_side_is_never_clean() -> None:
    for case in corpus(11, 12):
        other = Side.LEFT if case.side is Side.RIGHT else Side.RIGHT
        assert judge(case.surface, case.side, case.radius, case.path.path()).clean
        assert not judge(case.surface, other, case.radius, case.path.path()).clean
