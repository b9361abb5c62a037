"""Times in words: which blocks a program's total counts."""

from __future__ import annotations

from dataclasses import replace

from app.documents.files import load
from app.documents.programs import example
from app.session.work import times_in_words
from core.pipeline.derive import derive


def test_a_total_without_a_block_that_cannot_be_posted_names_the_blocks_it_counts() -> None:
    part = load(example("flange"))
    total, times = times_in_words(derive(part))
    assert total.endswith(" total")
    assert sorted(times) == [1, 2]
    unready = replace(part.blocks[1], x_start=None)
    total, times = times_in_words(derive(replace(part, blocks=(part.blocks[0], unready))))
    assert total.startswith("block 1: ")
    assert total.endswith(" total")
    assert sorted(times) == [1]
    four = (part.blocks[0], part.blocks[0], part.blocks[0], unready)
    total, times = times_in_words(derive(replace(part, blocks=four)))
    assert total.startswith("blocks 1-3: ")
    assert len(f"4 blocks   {total}") <= 36, "beside the file's name on 80 columns"
