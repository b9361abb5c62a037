"""Broken programs never raise, hang or take long.

`python -m tests.core.controls.klartext.test_mutations` runs 1,000 mutations of every sample.
"""

from __future__ import annotations

from pathlib import Path
from random import Random
from time import process_time

import pytest

from core.controls.control_run import ControlRun
from core.controls.klartext.control import run_klartext
from tests.core.controls.klartext.klartext_runs import DATA

SAMPLES = sorted((DATA / "klartext").glob("*.h"))
JUNK = (b"\x00", b"\xff\xfe", b"\x1b[2J", b"\r", b"\n", b"Q", b"9" * 400, b"(", b"~", b"/", b";", b"REP 9999", b"-")
LONGEST = 5.0
"""Seconds of processor time; a hundredth of it is usual."""


def mutated(text: bytes, random: Random) -> bytes:
    """The text with a few of its signs or lines broken."""
    for _ in range(random.randint(1, 6)):
        at = random.randrange(len(text) or 1)
        match random.randrange(6):
            case 0:
                text = text[:at] + text[at + 1 :]
            case 1:
                text = text[:at] + text[at : at + 1] * random.randint(2, 5) + text[at + 1 :]
            case 2:
                text = text[:at] + text[at + 1 : at + 2] + text[at : at + 1] + text[at + 2 :]
            case 3:
                lines = text.split(b"\n")
                random.shuffle(lines)
                text = b"\n".join(lines)
            case 4:
                text = text[:at] + random.choice(JUNK) + text[at:]
            case _:
                line = random.choice(text.split(b"\n"))
                text = text[:at] + b"\n" + line + b"\n" + text[at:]
    return text


def sound(made: ControlRun) -> bool:
    """Moves that are numbers, and findings that say where."""
    finite = bool((abs(made.moves.points) < 1e9).all() and (abs(made.moves.centers) < 1e12).all())
    return finite and all(finding.line is not None for finding in made.findings)


def run_broken(file: Path, count: int) -> tuple[float, int]:
    """Seconds that the slowest of `count` mutations took, and how many have a compensated contour."""
    text, random, slowest, cutting = file.read_bytes(), Random(file.stem), 0.0, 0
    for number in range(count):
        program = mutated(text, random)
        before = process_time()
        made = run_klartext(program, {})
        slowest = max(slowest, process_time() - before)
        cutting += bool(made.stretches)
        assert sound(made), (file.name, number, program)
    return slowest, cutting


@pytest.mark.parametrize("file", SAMPLES, ids=lambda file: file.stem)
def test_a_hundred_mutations_of_each_sample(file: Path) -> None:
    seconds, cutting = run_broken(file, 100)
    assert seconds < LONGEST
    assert cutting


@pytest.mark.parametrize(
    "text",
    [
        b"",
        b"\x00" * 5000,
        bytes(range(256)) * 40,
        b"L X+1 " * 200_000,
        b"9" * 1_000_000,
        b"FN 9: IF " + b" " * 900 + b"GOTO",
        b"Q1 = " + b"-" * 990,
        b"TOOL CALL " + b"9" * 980 + b" Z",
        b"L X+" + b"9" * 990,
        b"L M" + b"9" * 990,
        b"L X+1\n" * 20_000,
        b"LBL 1\nCALL LBL 1 REP 65534\n" * 50,
    ],
    ids=range(12),
)
def test_what_is_no_program_is_answered(text: bytes) -> None:
    before = process_time()
    made = run_klartext(text, {})
    assert process_time() - before < LONGEST
    assert sound(made)
    assert made.findings


if __name__ == "__main__":
    for sample in SAMPLES:
        print(f"{sample.name:16} slowest {run_broken(sample, 1000)[0] * 1000:8.1f} ms")
