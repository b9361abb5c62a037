"""The pictures of the documentation show what its text says, and are the ones the program draws."""

from __future__ import annotations

import re

import pytest

from core.advice.block_paths import BlockPaths
from core.pipeline.derive import derive
from tests.docpictures import CORE, PICTURES, drawn, program

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")


def _work(name: str) -> BlockPaths:
    (picture,) = (one for one in PICTURES if one.name == name)
    (found,) = derive(program(picture)).blocks
    assert found.paths is not None
    return found.paths


@pytest.mark.parametrize(
    ("name", "clean"),
    [
        ("walk-1", False),
        ("walk-3", True),
        ("corner-start", False),
        ("mid-side-start", True),
        ("long-way", False),
        ("bone-control", True),
        ("bone-best", True),
        ("dead-slices", True),
        ("uncut", True),
        ("over-run", True),
    ],
)
def test_the_verdicts_are_those_of_the_text(name, clean):
    assert _work(name).verdict.clean is clean


def test_deletions_and_loops_are_those_of_the_text():
    assert not len(_work("walk-1").compensated.deleted)
    assert _work("walk-3").compensated.deleted.segments.tolist() == [2, 3, 4]
    assert [len(_work(name).loops) for name in ("bone-control", "bone-best")] == [1, 2]
    assert _work("uncut").verdict.uncut_length > 4 * 25.4


def test_every_picture_of_a_page_is_drawn_and_every_drawn_picture_is_on_a_page():
    linked = {
        page.parent / picture
        for page in CORE.rglob("*.md")
        for picture in re.findall(r"\((pictures/[\w-]+\.svg)\)", page.read_text())
    }
    assert linked == set(CORE.rglob("*.svg")) == {file for file, _ in drawn()}


@pytest.mark.parametrize(("file", "text"), list(drawn()), ids=lambda value: getattr(value, "stem", ""))
def test_a_picture_is_what_the_program_draws(file, text):
    """Compared word by word and number by number: last digits may differ between machines."""
    kept = file.read_text()
    assert NUMBER.sub("#", kept) == NUMBER.sub("#", text), "python -m tests.docpictures draws it anew"
    ours, theirs = (list(map(float, NUMBER.findall(one))) for one in (kept, text))
    assert ours == pytest.approx(theirs, abs=2e-6)
