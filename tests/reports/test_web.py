"""The screens in a real browser; skipped where there is no Chromium or the extra `web` is not installed."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

import pytest

from tests.reports.browser import chromium
from tests.reports.web import report


@pytest.mark.skipif(chromium() is None, reason="no Chromium here: apt-get install chromium")
@pytest.mark.skipif(find_spec("textual_serve") is None, reason="the extra web is not installed")
def test_from_the_start_screen_to_a_posted_file_in_a_browser(tmp_path: Path) -> None:
    told = report(tmp_path / "seen.png")
    assert told[0].endswith("refused (403)")
    assert told[-1].startswith("posted, ")
    assert (tmp_path / "seen.png").stat().st_size > 10_000
