"""Broken programs never raise, hang or take long on any control.

`python -m tests.core.controls.test_mutations` runs 1,000 mutations of every sample on every control.
"""

from __future__ import annotations

import argparse
from itertools import chain, cycle
from pathlib import Path
from random import Random
from time import process_time

import numpy as np
import pytest

from core.controls.registry import names
from tests.core.controls.cycle_programs import drilled, timed
from tests.core.controls.hand import DATA, run_of
from tests.core.controls.klartext.test_mutations import mutated
from tests.core.controls.macro_programs import SAME, generated, whole

SAMPLES = sorted((DATA / "nc").glob("*.n*"))
ISO = [name for name in names() if not name.startswith("klartext")]
LONGEST = 5.0
"""Seconds of processor time; a hundredth of it is usual."""


def run_broken(sample: Path, count: int, controls: list[str]) -> tuple[float, int]:
    """Runs mutations of a sample, each on one of the controls in turn; seconds of the slowest, and how many cut.

    One that cuts is not refused before its first compensated contour.
    """
    random, text, most, cutting = Random(sample.name), sample.read_bytes(), 0.0, 0
    for index in range(count):
        program, control = mutated(text, random), controls[index % len(controls)]
        before = process_time()
        done = run_of(program, control, t1=0.5, t3=10.0)
        most = max(most, process_time() - before)
        cutting += bool(done.stretches)
        assert np.isfinite(done.moves.points).all(), (control, program)
        assert np.isfinite(done.moves.centers).all(), (control, program)
        for finding in done.findings:
            assert finding.text.isprintable(), (control, program)
            assert finding.line is None or finding.line >= 1
    return most, cutting


@pytest.mark.parametrize("sample", SAMPLES, ids=lambda sample: sample.stem)
def test_mutations_of_a_sample(sample: Path) -> None:
    """Every other one runs on a control that the sample was written for."""
    own = [control for control in ISO if sample.stem.startswith(control.partition(":")[0])]
    seconds, cutting = run_broken(sample, 60, list(chain.from_iterable(zip(cycle(own), ISO, strict=False))))
    assert seconds < LONGEST
    assert cutting > 2


def test_mutations_of_programs_with_parameters_loops_and_cycles(tmp_path: Path) -> None:
    texts = [*map(whole, SAME.values()), *map(generated, range(4)), *map(drilled, range(4)), *map(timed, range(4))]
    all_cutting = 0
    for index, text in enumerate(texts):
        sample = tmp_path / f"{index}.ngc"
        sample.write_text(text)
        seconds, cutting = run_broken(sample, 8, ["linuxcnc", "linuxcnc", "rosettacnc", "nine-series"])
        assert seconds < LONGEST
        all_cutting += cutting
    assert all_cutting > 10


def main() -> None:
    """The full thing."""
    argparse.ArgumentParser("tests.core.controls.test_mutations", description=__doc__).parse_args()
    for sample in SAMPLES:
        for control in ISO:
            seconds, cutting = run_broken(sample, 1000, [control])
            print(f"{sample.name:32}{control:24}{seconds:8.3f} s{cutting:6} cut")


if __name__ == "__main__":
    main()
