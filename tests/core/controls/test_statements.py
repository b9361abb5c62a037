"""Every row of the makers' statements does what it must by hand calculation.

`python -m tests.core.controls.test_statements` prints them control by control.
"""

from __future__ import annotations

import argparse
from collections import Counter

import pytest

from tests.core.controls.hand import findings_of, run_of, same, shape
from tests.core.controls.statement import Row
from tests.core.controls.statements import ROWS


def wrong(row: Row) -> str:
    """What of a row's run is not as it must be, empty if all is."""
    run = run_of(row.text, row.control, **row.tools)
    path = shape(run)
    if row.path is not None and not same(path, row.path):
        return f"path {path}"
    if run.stopped_at != row.stops:
        return f"stopped at {run.stopped_at}: {[finding.text for finding in run.findings]}"
    for rule, line in row.rules:
        lines = [finding.line for finding in findings_of(run, rule.removeprefix("-"))]
        if (line in lines) == rule.startswith("-"):
            return f"{rule} told at {lines}"
    return ""


@pytest.mark.parametrize("row", ROWS, ids=[f"{row.control} {row.statement}" for row in ROWS])
def test_the_statement_holds(row: Row) -> None:
    assert not wrong(row)


def main() -> None:
    """Prints each row and how many hold."""
    argparse.ArgumentParser("tests.core.controls.test_statements", description=__doc__).parse_args()
    held: Counter[str] = Counter()
    for row in ROWS:
        what = wrong(row)
        held[row.control.partition(":")[0]] += not what
        print(f"{row.control:18}{'holds' if not what else 'WRONG':7}{row.statement}{': ' + what if what else ''}")
    print(", ".join(f"{control} {count}" for control, count in held.items()), f"of {len(ROWS)} hold")


if __name__ == "__main__":
    main()
