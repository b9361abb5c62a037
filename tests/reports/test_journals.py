"""A sample of the report on journals with right sums and wrong content."""

from __future__ import annotations

from pathlib import Path

from tests.reports.journals import tried


def test_a_journal_with_wrong_content_is_damaged_and_never_a_traceback(tmp_path: Path) -> None:
    counts = tried(tmp_path, 120, 60)
    assert counts.total() == 180
    assert counts["one value wrong", "damaged"] > 30
    assert counts["one value wrong", "restored"] > 5
    assert counts["random values", "damaged"] > 10
