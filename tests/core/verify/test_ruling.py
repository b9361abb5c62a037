"""A ruling says at once whether a path is clean, and all else when it is read."""

from __future__ import annotations

import pytest

from core.geometry.piece import Side
from core.verify import judge as judging
from core.verify.judge import judge, rulings
from core.verify.ruling import Ruling
from core.verify.verdict import Verdict
from tests.core.verify.shapes import lines, square

PLATE = square(40.0)
AROUND = lines((-3, -3), (43, -3), (43, 43), (-3, 43), (-3, -3))
THROUGH = lines((-3, -3), (43, 2), (43, 43))
CORNER = lines((-3, -3), (-1, -1), (43, -3))


class Completing:
    """A verdict to be completed, and how often that was done."""

    def __init__(self) -> None:
        self.done = 0

    def __call__(self) -> Verdict:
        self.done += 1
        return judge(PLATE, Side.RIGHT, 3.0, THROUGH)


def test_it_is_completed_once_and_not_before_it_is_read() -> None:
    complete = Completing()
    ruling = Ruling(complete, clean=False)
    assert not ruling.clean
    assert complete.done == 0
    assert ruling.verdict is ruling.verdict
    assert complete.done == 1


def test_that_of_a_verdict_is_as_clean_as_that_and_has_it() -> None:
    for path in (AROUND, THROUGH):
        verdict = judge(PLATE, Side.RIGHT, 3.0, path)
        assert Ruling.of(verdict).clean is verdict.clean
        assert Ruling.of(verdict).verdict is verdict


def test_of_a_path_that_gouges_nothing_more_is_worked_out_before_it_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    around, through = rulings(PLATE, Side.RIGHT, 3.0, (AROUND, THROUGH))
    monkeypatch.setattr(judging, "uncut", None)
    assert around.verdict.clean
    with pytest.raises(TypeError):
        through.complete()
    monkeypatch.undo()
    assert through.complete() is through.verdict


def test_a_path_with_a_corner_too_near_to_one_of_the_surface_is_not_measured_before_it_is_read(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(judging, "pairs_of", None)
    (ruling,) = rulings(PLATE, Side.RIGHT, 3.0, (CORNER,))
    assert not ruling.clean
    with pytest.raises(TypeError):
        rulings(PLATE, Side.RIGHT, 3.0, (AROUND,))
    monkeypatch.undo()
    assert ruling.verdict.gouges == judge(PLATE, Side.RIGHT, 3.0, CORNER).gouges != ()


def test_a_path_that_turns_out_to_be_unjudged_when_it_is_read_is_told_so(monkeypatch: pytest.MonkeyPatch) -> None:
    (ruling,) = rulings(PLATE, Side.RIGHT, 3.0, (CORNER,))
    monkeypatch.setattr(judging, "_measured", lambda *_: None)
    assert not ruling.clean
    assert not ruling.verdict.judged
    assert not ruling.verdict.clean


def test_of_a_path_with_many_pairs_everything_is_known_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(judging, "FEW_PAIRS", 2)
    many = rulings(PLATE, Side.RIGHT, 3.0, (THROUGH, CORNER))
    monkeypatch.setattr(judging, "uncut", None)
    assert all(one.verdict.gouges for one in many)


@pytest.mark.parametrize("radius", [0.0, 1.0, 3.0, 3.5, float("nan")])
@pytest.mark.parametrize("side", list(Side))
def test_what_it_says_at_once_the_verdict_says_too(side: Side, radius: float) -> None:
    paths = (AROUND, THROUGH, CORNER)
    for ruling, path in zip(rulings(PLATE, side, radius, paths), paths, strict=True):
        alone = judge(PLATE, side, radius, path)
        assert ruling.clean is alone.clean
        assert ruling.verdict.clean is alone.clean
        assert ruling.verdict.gouges == alone.gouges
        assert ruling.verdict.wrong_side == alone.wrong_side
        assert ruling.verdict.uncut == alone.uncut
