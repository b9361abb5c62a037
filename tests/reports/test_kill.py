"""The kill test in small: eight kills, and that it would notice a loss."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from app.documents.files import save
from app.documents.programs import empty_program
from core.program.history import History
from core.program.model import Number
from tests.reports.kill import Part, Tally, came_back, lives, report


def test_eight_kills_lose_nothing() -> None:
    tally = lives(8, seed=11)
    assert list(report(tally))[-1] == "8 kills, 0 lost"
    assert tally.moments["keys typed"] > 50
    assert tally.moments["work offered"] > 0


def typed(part: Part, *keys: str) -> None:
    part.begin(History(empty_program()))
    for key in keys:
        part.press(key)


def test_what_the_screen_had_shown_and_the_disk_has_not_is_a_loss(tmp_path: Path) -> None:
    part, tally = Part(tmp_path / "part.toml"), Tally()
    typed(part, "tab", "7", "enter")
    part.acknowledged = 3
    assert not came_back(part, tally)
    assert len(tally.lost) == 1
    assert "Block 1: TOOL 7, was 1." in tally.lost[0]


def test_a_key_that_no_screen_has_shown_may_be_gone(tmp_path: Path) -> None:
    part, tally = Part(tmp_path / "part.toml"), Tally()
    typed(part, "tab", "7", "enter")
    part.acknowledged = 2
    came_back(part, tally)
    assert tally.lost == []


def test_what_was_never_typed_is_a_loss_too(tmp_path: Path) -> None:
    part, tally = Part(tmp_path / "part.toml"), Tally()
    typed(part, "tab", "7", "enter")
    program = empty_program()
    save(replace(program, blocks=(replace(program.blocks[0], tool=Number(5.0)),)), part.file)
    came_back(part, tally)
    assert len(tally.lost) == 1
