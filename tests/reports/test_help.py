"""Every report and benchmark that tests/REPORTS.md names says how it is used, and runs nothing when asked that."""

from __future__ import annotations

import re
import runpy
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
TABLE = (ROOT / "tests" / "REPORTS.md").read_text().partition("| command, after")[2].partition("\n\n")[0]
MODULES = re.findall(r"`(tests\.[a-z0-9_.]+)", TABLE)


def test_the_page_names_the_reports_and_benchmarks() -> None:
    assert len(MODULES) > 15


@pytest.mark.parametrize("module", MODULES)
def test_asked_for_help_a_report_tells_its_arguments(
    module: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "argv", [module, "--help"])
    with pytest.raises(SystemExit) as ended:
        runpy.run_path(str(ROOT / module.replace(".", "/")) + ".py", run_name="__main__")
    told = capsys.readouterr()
    assert (ended.value.code, told.err) == (0, "")
    assert told.out.startswith("usage:")
