"""Record: what two trees answer to the same corpus, compared number by number.

    .venv/bin/python -m tests.reports.record --before ../before

`../before` is a worktree of the commit to compare with.  Both trees get the same questions through their command line
(paths, best paths, look-ahead tables, findings, NC texts, and what every control makes of NC programs) and are told
apart by their answers: numbers by more than 1e-9 mm, findings by code, place and value (not by their texts), NC texts
by anything but the spelling.  Nothing is kept unless something differs; then the corpus stays where the last line says.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from time import monotonic
from typing import Any, Final

from tests.reports.corpus import Case, cases, iso_program, klartext_program, program_file

ROOT: Final = Path(__file__).resolve().parents[2]
WORKER: Final = Path(__file__).with_name("record_worker.py")

CLOSE_MM: Final = 1e-9
"""Numbers this near are equal, in millimeters."""

CONTROLS: Final = (
    "threeblock",
    "rosettacnc:nist",
    "rosettacnc:easy",
    "rosettacnc:normal",
    "nine-series:a",
    "nine-series:b",
    "nine-series:a-g39",
    "nine-series:b-g39.1",
    "klartext",
    "linuxcnc",
    "fanuc:a",
    "haas:b",
)
TOOLS: Final = ("--tool", "1=.5in", "--tool", "2=6mm", "--tool", "3=3mm", "--tool", "4=8mm")
"""Tools for the programs under tests/data."""

SPELLINGS: Final = (
    ("centre", "center"),
    ("millimetre", "millimeter"),
    ("metre", "meter"),
    ("colour", "color"),
    ("neighbour", "neighbor"),
    ("cancelled", "canceled"),
    ("labelled", "labeled"),
    ("travelled", "traveled"),
    ("grey", "gray"),
)
NUMBERED: Final = re.compile(r"^\d+ (?=\D)")
FINDING: Final = re.compile(r"^[(;] ?(?:overridden [a-z_]+:|note [a-z_]+)")
REMARK: Final = re.compile(r"^[(;] ?(?:g64|safe z|that is|block|pass)")
"""A comment that does not go on with the sentence of a finding before it."""
NUMBER: Final = re.compile(r"[-+]?\d*\.\d+|[-+]?\d+\.?")


@dataclass(frozen=True)
class Question:
    """One command line; `file` is what it is about, `save` where its answer is written for a later question."""

    kind: str
    file: str
    arguments: tuple[str, ...]
    save: str = ""

    @property
    def label(self) -> str:
        return f"{self.kind} {' '.join(self.arguments)}"


@dataclass
class Tally:
    """What a comparison has counted: answers by kind, differences by question."""

    asked: Counter[str] = field(default_factory=Counter)
    different: list[tuple[Question, list[str]]] = field(default_factory=list)
    expected: set[str] = field(default_factory=set)
    last_digits: int = 0
    codes: Counter[str] = field(default_factory=Counter)
    new_keys: Counter[str] = field(default_factory=Counter)


def main() -> None:
    options = _options()
    folder = Path(tempfile.mkdtemp(prefix="record-"))
    questions = [
        question
        for question in _questions(folder, options.contours, options.seed)
        if not options.only or any(word in question.label for word in options.only)
    ]
    started, tally = monotonic(), Tally()
    for number, (question, answers) in enumerate(_answers(questions, options.before, options.after, folder), 1):
        _compare(question, *answers, tally, frozenset(options.expected))
        if number % 2000 == 0:
            print(f"{number} of {len(questions)}, {monotonic() - started:.0f} s", file=sys.stderr)
    different = _report(tally, options.most)
    print(f"{len(questions)} questions in {monotonic() - started:.0f} s")
    if different:
        print(f"corpus: {folder}")
        sys.exit(1)
    shutil.rmtree(folder)


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser("tests.reports.record", description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--before", type=Path, required=True, metavar="TREE", help="worktree of the commit before")
    parser.add_argument("--after", type=Path, default=ROOT, metavar="TREE", help="the tree to compare, else this one")
    parser.add_argument("--contours", type=int, default=1000, metavar="N", help="random contours")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument(
        "--only",
        nargs="+",
        default=[],
        metavar="WORD",
        help="only command lines that contain one of these: path, lookahead, post, check, a control, a family, a file",
    )
    parser.add_argument(
        "--expected", nargs="+", default=[], metavar="CODE", help="findings that may differ, with all of their program"
    )
    parser.add_argument("--most", type=int, default=10, metavar="N", help="differences told in full")
    return parser.parse_args()


# the questions


def _questions(folder: Path, contours: int, seed: int) -> Iterator[Question]:
    """Everything that is asked; the files are written into the folder."""
    shutil.copytree(ROOT / "tests/data", folder / "data")
    shutil.copytree(ROOT / "app/examples", folder / "examples")
    for file in sorted(folder.glob("examples/*.toml")):
        yield from _about_program(folder, file, CONTROLS)
    for file in sorted(folder.glob("data/**/*.toml")):
        yield from _about_program(folder, file, CONTROLS[:1])
    for file in sorted([*folder.glob("data/**/*.nc"), *folder.glob("data/**/*.ngc"), *folder.glob("data/**/*.h")]):
        yield _check(folder, file, "all", TOOLS)
    for number, case in enumerate(cases(contours, seed)):
        yield from _about_case(folder, case, number, Random(f"texts {seed} {number}"))


def _about_program(folder: Path, file: Path, controls: Sequence[str], check: tuple[str, ...] = TOOLS) -> list[Question]:
    name = str(file.relative_to(folder))
    asked = [
        Question("path", name, ("path", str(file), "--json")),
        Question("lookahead", name, ("lookahead", str(file), "--json")),
        Question("post", name, ("post", str(file), "--override", "POST WITH GOUGE")),
    ]
    for control in controls:
        saved = f"{name}-{control}.nc".replace("/", "-")
        asked.append(Question("post", name, ("post", str(file), "--control", control), saved))
        arguments = ("check", f"{{folder}}/{saved}", "--control", control, "--json", *check)
        asked.append(Question("check", name, arguments))
    return asked


def _about_case(folder: Path, case: Case, number: int, random: Random) -> Iterator[Question]:
    tools = (
        "--tool",
        f"1={case.diameter:g}{case.unit.lower()}",
        "--tool",
        f"2={case.diameter * 0.75:g}{case.unit.lower()}",
    )
    file, best = folder / f"{case.name}.toml", folder / f"{case.name}-best.toml"
    state = random.getstate()
    file.write_text(program_file(case, "CONTROL", random))
    random.setstate(state)
    best.write_text(program_file(case, "BEST", random))
    controls = (CONTROLS[number % len(CONTROLS)], CONTROLS[(number // len(CONTROLS) + number) % len(CONTROLS)])
    yield from _about_program(folder, file, tuple(dict.fromkeys(controls)), tools)
    yield Question("path", best.name, ("path", str(best), "--json"))
    yield Question("post", best.name, ("post", str(best)))
    if number % 2 == 0:
        program = folder / f"{case.name}{'.h' if number % 8 == 0 else '.nc'}"
        program.write_text((klartext_program if number % 8 == 0 else iso_program)(case, random))
        yield _check(folder, program, "all", tools)


def _check(folder: Path, file: Path, control: str, tools: tuple[str, ...]) -> Question:
    arguments = ("check", str(file), "--control", control, "--json", *tools)
    return Question("check", str(file.relative_to(folder)), arguments)


# the answers


def _answers(
    questions: Sequence[Question], before: Path, after: Path, folder: Path
) -> Iterator[tuple[Question, tuple[dict[str, Any], dict[str, Any]]]]:
    """Every question with the answers of both trees, which work side by side."""
    file = folder / "questions"
    with file.open("w") as out:
        for question in questions:
            out.write(f"{json.dumps({'arguments': question.arguments, 'save': question.save})}\n")
    with _worker(before, file, folder / "before") as old, _worker(after, file, folder / "after") as new:
        for question in questions:
            lines = old.readline(), new.readline()
            if not all(lines):
                sys.exit(f"a worker ended at: {question.label}")
            yield question, (json.loads(lines[0]), json.loads(lines[1]))


@contextmanager
def _worker(tree: Path, questions: Path, folder: Path) -> Iterator[Any]:
    tree = tree.resolve()
    folder.mkdir()
    environment = os.environ | {"PYTHONPATH": str(tree), "HOME": str(folder)}
    command = [sys.executable, "-P", str(WORKER), str(questions), str(folder)]
    process = subprocess.Popen(command, cwd=tree, env=environment, stdout=subprocess.PIPE, text=True)
    try:
        yield process.stdout
    finally:
        process.kill()
        process.wait()


# the comparison


def _compare(
    question: Question, old: dict[str, Any], new: dict[str, Any], tally: Tally, expected: frozenset[str]
) -> None:
    tally.asked[question.kind] += 1
    comparison = Comparison(tally, expected)
    differences = list(comparison.answers(question.kind, old, new))
    if comparison.expected_codes:
        tally.expected.add(_program(question.file))
        tally.codes.update(comparison.expected_codes)
    if differences:
        tally.different.append((question, differences))


def _program(file: str) -> str:
    """The program a file is about, of whatever form."""
    return file.rpartition(".")[0].removesuffix("-best")


class Comparison:
    """Comparison of two answers; `expected_codes` are those whose findings differ as expected."""

    def __init__(self, tally: Tally, expected: frozenset[str]) -> None:
        self.tally = tally
        self.expected = expected
        self.expected_codes: set[str] = set()
        self.close = CLOSE_MM

    def answers(self, kind: str, old: dict[str, Any], new: dict[str, Any]) -> Iterator[str]:
        for name, answer in (("before", old), ("after", new)):
            if isinstance(answer["status"], str):
                yield f"{name} ends in a traceback: {answer['status'].splitlines()[-1]}"
        if old["status"] != new["status"]:
            yield f"exit status: {old['status']!r} before, {new['status']!r} after {_said(old)}{_said(new)}"
        if kind == "post" or not (old["text"].startswith(("{", "[")) and new["text"].startswith(("{", "["))):
            yield from self.texts(old["text"], new["text"])
        else:
            yield from self.documents(json.loads(old["text"]), json.loads(new["text"]))

    def texts(self, old: str, new: str) -> Iterator[str]:
        """NC texts, line by line; a number that is one off in its last digit is counted apart."""
        lines = compared_lines(old), compared_lines(new)
        if len(lines[0]) != len(lines[1]):
            yield f"{len(lines[0])} lines before, {len(lines[1])} after"
        for number, (one, other) in enumerate(zip(*lines, strict=False), 1):
            if one == other:
                continue
            if _nearly(one, other):
                self.tally.last_digits += 1
                continue
            yield f"compared line {number}: {one!r} before, {other!r} after"

    def documents(self, old: Any, new: Any, place: str = "") -> Iterator[str]:
        """JSON answers; `place` is the way to what differs."""
        if isinstance(old, dict) and isinstance(new, dict):
            yield from self._objects(old, new, place)
        elif isinstance(old, list) and isinstance(new, list) and _of_controls(old) and _of_controls(new):
            yield from self._controls(old, new, place)
        elif isinstance(old, list) and isinstance(new, list):
            if len(old) != len(new):
                yield f"{place}: {len(old)} before, {len(new)} after"
            for row, pair in enumerate(zip(old, new, strict=False)):
                yield from self.documents(*pair, f"{place}[{row}]")
        elif not self._equal(old, new):
            yield f"{place}: {old!r} before, {new!r} after"

    def _objects(self, old: dict[str, Any], new: dict[str, Any], place: str) -> Iterator[str]:
        if "units" in old:
            self.close = CLOSE_MM / (25.4 if old["units"] == "IN" else 1.0)
        self.tally.new_keys.update(key for key in new if key not in old)
        for key, value in old.items():
            where = f"{place}.{key}" if place else key
            if key not in new:
                yield f"{where}: missing after"
            elif key == "findings":
                yield from self._findings(value, new[key], where)
            elif key not in ("text", "needs", "file"):
                yield from self.documents(value, new[key], where)

    def _controls(self, old: list[dict[str, Any]], new: list[dict[str, Any]], place: str) -> Iterator[str]:
        """What controls made of one program, by their names; those that are new are counted as keys are."""
        after = {result["control"]: result for result in new}
        before = {result["control"] for result in old}
        self.tally.new_keys.update(control for control in after if control not in before)
        for result in old:
            where = f"{place} {result['control']}".strip()
            if result["control"] in after:
                yield from self.documents(result, after[result["control"]], where)
            else:
                yield f"{where}: missing after"

    def _findings(self, old: list[dict[str, Any]], new: list[dict[str, Any]], place: str) -> Iterator[str]:
        """Findings in their order, those that are expected to differ apart."""
        for code in self.expected & {_code(finding) for finding in (*old, *new)}:
            before, after = ([one for one in findings if _code(one) == code] for findings in (old, new))
            if any(self.documents(before, after)):
                self.expected_codes.add(code)
        old, new = ([one for one in findings if _code(one) not in self.expected] for findings in (old, new))
        if [_code(finding) for finding in old] != [_code(finding) for finding in new]:
            lost, added = Counter(map(_code, old)), Counter(map(_code, new))
            yield f"{place}: before only {dict(lost - added)}, after only {dict(added - lost)}, or in another order"
            return
        for one, other in zip(old, new, strict=True):
            yield from self.documents(one, other, f"{place} {_code(one)}")

    def _equal(self, old: Any, new: Any) -> bool:
        if isinstance(old, bool) or isinstance(new, bool) or not isinstance(old, int | float):
            return bool(old == new)
        if not isinstance(new, int | float):
            return False
        return abs(old - new) <= max(self.close, 1e-13 * abs(old))


def _code(finding: dict[str, Any]) -> str:
    return str(finding.get("code", finding.get("rule")))


def _of_controls(answers: list[Any]) -> bool:
    return bool(answers) and all(isinstance(answer, dict) and "control" in answer for answer in answers)


def _said(answer: dict[str, Any]) -> str:
    lines = answer["messages"].splitlines()
    return f" ({lines[-1][:150]})" if lines else ""


def folded(text: str) -> str:
    """A text in American spelling and capitals, so that only what it says is compared."""
    text = text.lower()
    for british, american in SPELLINGS:
        text = text.replace(british, american)
    return text


def compared_lines(text: str) -> list[str]:
    """Lines of an NC text: of findings in its comments the code alone, of Klartext lines no numbers."""
    lines: list[str] = []
    in_finding = False
    for line in (NUMBERED.sub("", line) for line in folded(text).splitlines()):
        if found := FINDING.match(line):
            lines.append(found[0])
            in_finding = True
        elif not in_finding or not line.startswith(("(", ";")) or REMARK.match(line):
            lines.append(line)
            in_finding = False
    return lines


def _nearly(one: str, other: str) -> bool:
    """Whether two lines differ in the last digits of numbers alone, by one."""
    if NUMBER.split(one) != NUMBER.split(other):
        return False
    for pair in zip(NUMBER.findall(one), NUMBER.findall(other), strict=True):
        decimals = max(len(text.partition(".")[2]) for text in pair)
        if pair[0] != pair[1] and (not decimals or abs(float(pair[0]) - float(pair[1])) > 1.01 * 10.0**-decimals):
            return False
    return True


# the report


def _report(tally: Tally, most: int) -> bool:
    """Print what was counted; returns whether anything differs that was not expected."""
    apart = [one for one in tally.different if _program(one[0].file) in tally.expected]
    different = [one for one in tally.different if _program(one[0].file) not in tally.expected]
    _print_first(different, most)
    kinds = Counter(question.kind for question, _ in different)
    print()
    for kind, count in tally.asked.items():
        print(f"{kind:<10} {count:>6} answers, {kinds[kind]:>5} different")
    if tally.expected:
        programs = f"{len(tally.expected)} programs differ in expected findings"
        print(f"{programs} ({_counts(tally.codes)}); {len(apart)} answers about them differ otherwise:")
        _print_first(apart, most)
    if tally.last_digits:
        print(f"{tally.last_digits} lines of NC text differ in a last digit by one, which counts as equal")
    if tally.new_keys:
        print(f"keys after only: {_counts(tally.new_keys)}")
    return bool(different)


def _print_first(different: list[tuple[Question, list[str]]], most: int) -> None:
    """The first differences, each with the command line that shows it."""
    for question, differences in different[:most]:
        print(f"\ncutcomp {' '.join(question.arguments)}")
        for text in differences[:4]:
            print(f"    {text}")
        if len(differences) > 4:
            print(f"    and {len(differences) - 4} more")


def _counts(counter: Counter[str]) -> str:
    return ", ".join(f"{name} {count}" for name, count in counter.most_common())


if __name__ == "__main__":
    main()
