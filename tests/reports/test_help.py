"""Every report and benchmark that tests/REPORTS.md names says how it is used, and runs nothing when asked that."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
TABLE = (ROOT / "tests" / "REPORTS.md").read_text().partition("| command, after")[2].partition("\n\n")[0]
MODULES = re.findall(r"`(tests\.[a-z0-9_.]+)", TABLE)


def test_the_page_names_the_reports_and_benchmarks() -> None:
    assert len(MODULES) > 15


@pytest.mark.parametrize("module", MODULES)
def test_asked_for_help_a_report_tells_its_arguments(module: str) -> None:
    command = [sys.executable, "-m", module, "--help"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("usage:")
