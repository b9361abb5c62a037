"""The kill report in small: a few kills, and that it would notice a loss."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest

from tests.app.documents.typist import started
from tests.reports import kill
from tests.reports.kill import Tally, came_back, lives, report
from tests.reports.kill_parts import NC, ContourPart, NcPart, Part, shown_lines


def test_a_kill_of_each_document_loses_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kill, "LIVES_OF_A_PART", 1)
    monkeypatch.setattr(kill, "LONGEST_LIFE", 1.0)
    told = list(report(lives(2, seed=11)))
    assert told[-1] == "2 kills, 0 lost"
    assert {line.split()[1] for line in told if line.startswith("SIG")} == {"ContourPart", "NcPart"}


def typed(part: Part) -> None:
    """Edits of which nothing is on the disk."""
    part.begin(None)
    chance = Random(1)
    while len(part.states) < 4 or part.content(part.states[-1].work) == part.saved_work():
        part.next_keys(chance)


@pytest.fixture(params=["part.toml", "part.nc"])
def part(request: pytest.FixtureRequest, tmp_path: Path) -> Part:
    file = tmp_path / str(request.param)
    if file.suffix == ".toml":
        return ContourPart(file)
    file.write_bytes(NC)
    return NcPart(file)


def test_what_the_screen_had_shown_and_the_disk_has_not_is_a_loss(part: Part) -> None:
    typed(part)
    part.acknowledged = len(part.states) - 1
    tally = Tally()
    assert not came_back(part, tally)
    assert len(tally.lost) == 1


def test_a_key_that_no_screen_has_shown_may_be_gone(part: Part) -> None:
    typed(part)
    tally = Tally()
    came_back(part, tally)
    assert tally.lost == []


def test_what_was_never_typed_is_a_loss_too(part: Part) -> None:
    """Another program is in the journal, left by another who died."""
    typed(part)
    started(part.file.parent / "own", part.file).type(77).killed()
    tally = Tally()
    assert came_back(part, tally)
    assert len(tally.lost) == 1


def test_a_screen_acknowledges_the_state_that_it_shows(tmp_path: Path) -> None:
    part = ContourPart(tmp_path / "part.toml")
    typed(part)
    part.acknowledge("Prog Units: IN        not saved   undo 2          12:00")
    assert part.acknowledged == 2


def test_a_line_that_is_shown_may_still_be_typed(tmp_path: Path) -> None:
    part = NcPart(tmp_path / "part.nc")
    part.file.write_bytes(NC)
    part.begin(None)
    part.type_before(0, "N1 ")
    screen = "\n".join(f"{row:>2}  {line:<24}│ F1  EDIT" for row, line in enumerate(part.text.texts, 1))
    assert shown_lines(screen)[0] == "N1 G20 G17"
    part.acknowledge(screen)
    assert part.acknowledged == 0


def test_half_a_number_is_not_what_undo_brings(tmp_path: Path) -> None:
    """The old number of a line is deleted key by key before the new one is typed."""
    part = NcPart(tmp_path / "part.nc")
    part.file.write_bytes(NC)
    part.begin(None)
    part.type_before(0, "N1 ")
    part.acknowledged = 1
    before = part.text.texts[0]
    part.text = part.text.undo()
    part._add(sure=True)
    listing = "\n".join(f"{row:>2}  {line:<24}│" for row, line in enumerate(part.text.texts, 1))
    part.acknowledge(f"{listing}\n Prog Units: IN   not saved   undo 1   08:28")
    assert part.acknowledged == 1
    part.acknowledge(f"{listing}\n Prog Units: IN   saved   redo 1   08:28")
    assert (part.acknowledged, before) == (2, "N1 G20 G17")
