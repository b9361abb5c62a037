"""Code mutants: small faults put into core one at a time, and whether the tests of their own room find them.

    .venv/bin/python -m tests.reports.code_mutants --count 100
    .venv/bin/python -m tests.reports.code_mutants --room output --count 60

A mutant is a flipped comparison, a dropped statement, a changed sign or a number that is one off.  Each runs in a copy
of the tree against the tests of its room, those first that are named like its module.  A survivor has to be read: one
that changes nothing an operator or a machine can notice goes into the list of equivalent mutants with its reason, and
the next one takes its place.
"""

from __future__ import annotations

import argparse
import ast
import os
import queue
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import accumulate
from pathlib import Path
from random import Random
from time import monotonic
from typing import Final

ROOT: Final = Path(__file__).resolve().parents[2]
EQUIVALENT: Final = Path(__file__).with_name("equivalent_mutants.txt")
COPIED: Final = ("core", "app", "tests", "screenshots", "pyproject.toml", "README.md")

LEAST_SECONDS: Final = 60.0
SLOWER: Final = 5.0
"""A mutant that takes so many times what the room's tests take, and the seconds above at least, hangs: it is killed."""

COMPARISONS: Final[dict[type[ast.cmpop], tuple[str, str]]] = {
    ast.Lt: ("<", ">="),
    ast.LtE: ("<=", ">"),
    ast.Gt: (">", "<="),
    ast.GtE: (">=", "<"),
    ast.Eq: ("==", "!="),
    ast.NotEq: ("!=", "=="),
    ast.Is: ("is", "is not"),
    ast.IsNot: ("is not", "is"),
    ast.In: ("in", "not in"),
    ast.NotIn: ("not in", "in"),
}
SIGNS: Final[dict[type[ast.operator], tuple[str, str]]] = {ast.Add: ("+", "-"), ast.Sub: ("-", "+")}
DROPPED: Final = (ast.Expr, ast.Assign, ast.AugAssign, ast.Return, ast.Raise, ast.Continue, ast.Break)


@dataclass(frozen=True)
class Mutant:
    """One change of a file: the characters from `start` to `end` become `text`."""

    file: str
    line: int
    kind: str
    start: int
    end: int
    text: str

    def applied(self, source: str) -> str:
        return source[: self.start] + self.text + source[self.end :]

    def words(self, source: str) -> str:
        """The change as its line before and after, which names the mutant when other lines move."""
        before, after = source.splitlines(), self.applied(source).splitlines()
        return f"{self.file}: {before[self.line - 1].strip()} => {after[self.line - 1].strip()}"

    @property
    def room(self) -> str:
        parts = Path(self.file).parts
        return parts[1] if len(parts) > 2 else ""


@dataclass(frozen=True)
class Outcome:
    """What became of a mutant: the test that found it, or empty where it survived."""

    mutant: Mutant
    words: str
    test: str
    seconds: float


def main() -> None:
    options = _options()
    equivalent = _equivalent(options.equivalent)
    survivors = Counter[str]()
    killed = Counter[str]()
    with tempfile.TemporaryDirectory(prefix="mutants-") as name:
        trees = [_copy(Path(name) / str(number)) for number in range(options.parallel)]
        mutants = chosen(options.room, options.seed, options.count, equivalent)
        seconds = _undisturbed(trees[0], sorted({mutant.room for mutant in mutants}))
        for outcome in _outcomes(mutants, trees, seconds):
            (killed if outcome.test else survivors)[outcome.mutant.room or "core"] += 1
            state = f"killed by {outcome.test}" if outcome.test else "SURVIVED"
            print(f"{outcome.mutant.kind:<10} {outcome.words}\n    line {outcome.mutant.line}, {state}", flush=True)
    print()
    for room in sorted(killed | survivors):
        print(f"{room:<10} {killed[room]:>4} of {killed[room] + survivors[room]} killed")
    print(f"{'all':<10} {killed.total():>4} of {killed.total() + survivors.total()} killed, seed {options.seed}")


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser("tests.reports.code_mutants", description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=100, metavar="N", help="mutants that are tried")
    parser.add_argument("--room", metavar="NAME", help="of this room of core only, such as output")
    parser.add_argument("--parallel", type=int, default=2, metavar="N", help="tried at the same time")
    parser.add_argument(
        "--equivalent", type=Path, default=EQUIVALENT, metavar="FILE", help="mutants that were read and change nothing"
    )
    return parser.parse_args()


def _equivalent(file: Path) -> frozenset[str]:
    lines = file.read_text().splitlines() if file.exists() else []
    return frozenset(line for line in lines if line.startswith("core"))


# the mutants


def chosen(room: str | None, seed: int, count: int, equivalent: frozenset[str]) -> list[Mutant]:
    """This many mutants of core, the kinds in turn, without those that are known to change nothing."""
    by_kind: dict[str, list[Mutant]] = {}
    sources: dict[str, str] = {}
    for file in sorted((ROOT / "core" / (room or "")).rglob("*.py")):
        name = str(file.relative_to(ROOT))
        sources[name] = file.read_text()
        for mutant in mutants_of(name, sources[name]):
            by_kind.setdefault(mutant.kind, []).append(mutant)
    random = Random(seed)
    for kind in sorted(by_kind):
        random.shuffle(by_kind[kind])
    found: list[Mutant] = []
    while len(found) < count and any(by_kind.values()):
        for mutants in (by_kind[kind] for kind in sorted(by_kind) if by_kind[kind]):
            mutant = mutants.pop()
            source = sources[mutant.file]
            if len(found) < count and _valid(mutant, source) and mutant.words(source) not in equivalent:
                found.append(mutant)
    return found


def _valid(mutant: Mutant, source: str) -> bool:
    """Whether a mutant is a program: places inside of an f-string are not always right."""
    try:
        ast.parse(mutant.applied(source))
    except SyntaxError:
        return False
    return True


def mutants_of(file: str, source: str) -> Iterator[Mutant]:
    """Every mutant of a file."""
    text = _Text(file, source)
    for node in _changeable(ast.parse(source)):
        match node:
            case ast.Compare():
                yield from text.flipped(node)
            case ast.BinOp(op=ast.Add() | ast.Sub()) if not _of_text(node):
                yield from text.between(node.left, node.right, "sign", SIGNS[type(node.op)])
            case ast.UnaryOp(op=ast.USub()):
                yield text.mutant(node, "sign", text.begin(node), text.begin(node.operand), "")
            case ast.Constant(value=int(number)) if not isinstance(number, bool):
                yield text.mutant(node, "off by one", text.begin(node), text.end(node), str(number + 1))
            case ast.stmt() if isinstance(node, DROPPED) and not _docstring(node):
                yield text.mutant(node, "dropped", text.begin(node), text.end(node), "pass")


class _Text:
    """A module's text, in which places of the syntax tree are found; columns of the tree count bytes."""

    def __init__(self, file: str, source: str) -> None:
        self.file = file
        self.source = source
        self.lines = source.splitlines(keepends=True)
        self.starts = [0, *accumulate(map(len, self.lines))]

    def offset(self, line: int, column: int) -> int:
        return self.starts[line - 1] + len(self.lines[line - 1].encode()[:column].decode())

    def begin(self, node: ast.expr | ast.stmt) -> int:
        return self.offset(node.lineno, node.col_offset)

    def end(self, node: ast.expr | ast.stmt) -> int:
        return self.offset(node.end_lineno or node.lineno, node.end_col_offset or 0)

    def mutant(self, node: ast.expr | ast.stmt, kind: str, start: int, end: int, text: str) -> Mutant:
        return Mutant(self.file, node.lineno, kind, start, end, text)

    def flipped(self, node: ast.Compare) -> Iterator[Mutant]:
        for left, operator, right in zip([node.left, *node.comparators], node.ops, node.comparators, strict=False):
            yield from self.between(left, right, "comparison", COMPARISONS[type(operator)])

    def between(self, left: ast.expr, right: ast.expr, kind: str, words: tuple[str, str]) -> Iterator[Mutant]:
        """The operator between two operands exchanged for another."""
        gap = self.source[self.end(left) : self.begin(right)]
        word = re.search(rf"(?<!\w){re.escape(words[0])}(?!\w)", gap)
        if word and "#" not in gap:
            at = self.end(left) + word.start()
            line = self.source[:at].count("\n") + 1
            yield Mutant(self.file, line, kind, at, at + len(words[0]), words[1])


def _changeable(tree: ast.Module) -> Iterator[ast.AST]:
    """All nodes whose change could be noticed: no annotations, decorators, asserts, or statements outside functions."""
    waiting: list[tuple[ast.AST, bool]] = [(tree, False)]
    while waiting:
        node, inside = waiting.pop()
        if isinstance(node, ast.Assert | ast.Import | ast.ImportFrom):
            continue
        if inside or not isinstance(node, DROPPED):
            yield node
        inside = inside or isinstance(node, ast.FunctionDef)
        for name, value in ast.iter_fields(node):
            if name not in ("annotation", "returns", "decorator_list", "type_params", "bases"):
                children = value if isinstance(value, list) else [value]
                waiting += [(child, inside) for child in children if isinstance(child, ast.AST)]


def _of_text(node: ast.BinOp) -> bool:
    return any(
        isinstance(side, ast.JoinedStr) or (isinstance(side, ast.Constant) and isinstance(side.value, str))
        for side in (node.left, node.right)
    )


def _docstring(node: ast.stmt) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)


# the tests


def tests_of(mutant: Mutant, tree: Path) -> list[str]:
    """The test files of a mutant's room, those first whose names share words with its module's."""
    files = room_tests(mutant.room, tree)
    words = set(Path(mutant.file).stem.split("_")) | set(Path(mutant.file).parent.parts[2:])

    def relevance(name: str) -> int:
        return -len(words & {*Path(name).stem.removeprefix("test_").split("_"), *Path(name).parent.parts[3:]})

    return sorted(files, key=relevance)


def room_tests(room: str, tree: Path) -> list[str]:
    """The test files of a room of core; those at its top for a module that is in no room."""
    folder = tree / "tests" / "core" / room
    files = folder.rglob("test_*.py") if room else folder.glob("test_*.py")
    return sorted(str(file.relative_to(tree)) for file in files)


def _copy(tree: Path) -> Path:
    """A copy of this tree to change files in."""
    for name in COPIED:
        source = ROOT / name
        if source.is_dir():
            shutil.copytree(source, tree / name, ignore=shutil.ignore_patterns("__pycache__"))
        elif source.exists():
            tree.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, tree / name)
    return tree


def _undisturbed(tree: Path, rooms: Sequence[str]) -> dict[str, float]:
    """How long the tests of each room take without a mutant; ends where they fail."""
    seconds = {}
    for room in rooms:
        begun = monotonic()
        failed = _failure(tree, room_tests(room, tree), 3600.0, compiled=True)
        seconds[room] = monotonic() - begun
        if failed:
            sys.exit(f"the tests of {room or 'core'} fail without a mutant: {failed}")
        print(f"{room or 'core'}: tests pass in {seconds[room]:.0f} s", flush=True)
    return seconds


def _outcomes(mutants: Sequence[Mutant], trees: Sequence[Path], seconds: dict[str, float]) -> Iterator[Outcome]:
    """What becomes of each mutant, in order; as many at a time as there are copies of the tree."""
    free: queue.Queue[Path] = queue.Queue()
    for tree in trees:
        free.put(tree)

    def tried(mutant: Mutant) -> Outcome:
        tree = free.get()
        try:
            return _tried(mutant, tree, max(LEAST_SECONDS, SLOWER * seconds[mutant.room]))
        finally:
            free.put(tree)

    with ThreadPoolExecutor(len(trees)) as pool:
        yield from pool.map(tried, mutants)


def _tried(mutant: Mutant, tree: Path, longest: float) -> Outcome:
    file, begun = tree / mutant.file, monotonic()
    source = file.read_text()
    try:
        _write(file, mutant.applied(source))
        test = _failure(tree, tests_of(mutant, tree), longest)
    finally:
        _write(file, source)
    return Outcome(mutant, mutant.words(source), test, monotonic() - begun)


def _write(file: Path, source: str) -> None:
    """Write a module; what was compiled of it before would hide the change, since only its second is compared."""
    for compiled in (file.parent / "__pycache__").glob(f"{file.stem}.*.pyc"):
        compiled.unlink()
    file.write_text(source)


def _failure(tree: Path, files: Sequence[str], longest: float, *, compiled: bool = False) -> str:
    """The first test that fails, empty if all pass; tests that take longer fail."""
    environment = os.environ | {"PYTHONPATH": str(tree)}
    if not compiled:
        environment["PYTHONDONTWRITEBYTECODE"] = "1"
    command = [sys.executable, "-m", "pytest", "-x", "-q", "--no-header", "--tb=no", "-p", "no:cacheprovider", *files]
    try:
        done = subprocess.run(
            command, cwd=tree, env=environment, capture_output=True, text=True, timeout=longest, check=False
        )
    except subprocess.TimeoutExpired:
        return "the time limit"
    if done.returncode == 0:
        return ""
    failed = re.search(r"^(?:FAILED|ERROR) (\S+)", done.stdout, re.MULTILINE)
    return failed[1].removeprefix("tests/core/") if failed else f"pytest's exit status {done.returncode}"


if __name__ == "__main__":
    main()
