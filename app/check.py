"""`cutcomp check`: what controls do with an NC program, for one file or an archive of them."""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Final

from app.checking import Answer, Asked, answer, answer_all, lines, same_contours
from app.listing import SUFFIXES
from core.controls.registry import UnknownControl, names, resolve
from core.controls.source import shown
from core.controls.tools import CutterTool, ToolTable, read_table
from core.records import dataclass
from core.units import Unit

CLEAN: Final = 0
FINDINGS: Final = 1
UNUSABLE: Final = 2


class Unusable(Exception):
    """Arguments or a file that cannot be used; the text says why."""


def check(arguments: list[str]) -> int:
    """Runs the command; returns 0 for clean, 1 for errors found, 2 for what cannot be used."""
    options = _parser().parse_args(arguments)
    try:
        asked = _asked(options)
        paths = list(_programs(options.files))
    except Unusable as trouble:
        print(f"cutcomp: {trouble}", file=sys.stderr)
        return UNUSABLE
    if options.contour:
        return _contours(paths, asked)
    single = len(paths) == 1 and paths[0] == options.files[0]
    answers = _answers(paths, asked)
    if options.json:
        return _as_json(answers, single=single)
    return _as_text(answers, asked) if single else _as_summary(answers)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        "cutcomp check",
        description="What a control does with an NC program: its moves, its alarms, what it gouges.",
        epilog="controls: " + ", ".join(names()),
    )
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE", help="a program, or a folder of them")
    parser.add_argument("--control", required=True, metavar="NAME[:VARIANT]|all", help="the control, or all of them")
    parser.add_argument(
        "--tools", type=Path, metavar="TABLE", help="a tool table as LinuxCNC writes it, in the program's unit"
    )
    parser.add_argument(
        "--tool",
        action="append",
        default=[],
        metavar="N=DIAMETER",
        help="a tool's diameter in the program's unit, or with mm or in behind it",
    )
    parser.add_argument("--units", choices=("IN", "MM"), type=str.upper, help="the unit of a program that names none")
    parser.add_argument("--shop", action="store_true", help="the shop's rules H1 to H9 too")
    parser.add_argument(
        "--contour", action="store_true", help="compare two programs, of any language, by the contours they describe"
    )
    parser.add_argument("--json", action="store_true", help="machine-readable")
    return parser


def _asked(options: argparse.Namespace) -> Asked:
    control = options.control.strip().lower()
    if control != "all":
        full = resolve(control)
        if isinstance(full, UnknownControl):
            raise Unusable(full.text)
        control = full
    return Asked(control, tools_of(options), options.shop, Unit(options.units) if options.units else None)


def tools_of(options: argparse.Namespace) -> ToolTable:
    """The tools that --tools and --tool name; Unusable where they cannot be read."""
    table = ToolTable()
    if options.tools is not None:
        table, findings = read_table(_bytes(options.tools))
        if findings:
            first = findings[0]
            raise Unusable(f"{name_of(options.tools)}, line {first.line}: {first.text}")
    return table.with_tools(ToolTable.of(*(_tool(text) for text in options.tool)))


def _tool(text: str) -> CutterTool:
    """A tool written N=DIAMETER."""
    number, _, diameter = text.partition("=")
    unit = {"mm": Unit.MM, "in": Unit.IN}.get(diameter.strip().lower()[-2:])
    digits = diameter.strip()[:-2] if unit else diameter
    try:
        tool = CutterTool(int(number), float(digits), unit=unit)
    except ValueError:
        raise Unusable(f"--tool {shown(text)}: write a number and a diameter, as in 1=.5 or 2=6mm.") from None
    if not abs(tool.diameter) < 1e6 or tool.number < 0:
        raise Unusable(f"--tool {shown(text)}: that is no diameter of a tool.")
    return tool


def _bytes(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        raise Unusable(f"{name_of(path)}: {error.strerror}.") from error


def name_of(path: Path) -> str:
    """A file's name fit for a terminal."""
    return "".join(one if one.isprintable() else "?" for one in str(path))


def _programs(files: list[Path]) -> Iterator[Path]:
    """The files asked for, folders searched for programs."""
    for path in files:
        if not path.is_dir():
            yield path
            continue
        found = sorted(one for one in path.rglob("*") if one.suffix.lower() in SUFFIXES and one.is_file())
        if not found:
            raise Unusable(f"{name_of(path)} is a folder without programs ({' '.join(SUFFIXES)}).")
        yield from found


@dataclass(frozen=True, eq=False, slots=True)
class _Checked:
    """A file's answers, or the sentence that says why it could not be read."""

    path: Path
    answers: tuple[Answer, ...] = ()
    unusable: str = ""


def _one(path: Path, asked: Asked) -> _Checked:
    try:
        text = _bytes(path)
    except Unusable as trouble:
        return _Checked(path, unusable=str(trouble))
    found = answer_all(text, asked) if asked.control == "all" else (answer(text, asked),)
    return _Checked(path, found)


def _answers(paths: list[Path], asked: Asked) -> Iterator[_Checked]:
    """Every file's answers in order; several files in several processes."""
    workers = min(len(paths), os.cpu_count() or 1)
    if workers < 2:
        yield from (_one(path, asked) for path in paths)
        return
    with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool:
        yield from pool.map(_one, paths, [asked] * len(paths), chunksize=max(1, len(paths) // (8 * workers)))


def _status(checked: _Checked) -> int:
    if checked.unusable:
        return UNUSABLE
    return FINDINGS if any(one.errors for one in checked.answers) else CLEAN


def _told(checked: _Checked) -> int:
    """A file's status; what could not be read is said on standard error."""
    if checked.unusable:
        print(f"cutcomp: {checked.unusable}", file=sys.stderr)
    return _status(checked)


def _contours(paths: list[Path], asked: Asked) -> int:
    """Two programs by their contours: 0 if they describe the same, 1 if not."""
    try:
        if len(paths) != 2:
            raise Unusable("--contour compares two files.")
        first, second = (_bytes(path) for path in paths)
    except Unusable as trouble:
        print(f"cutcomp: {trouble}", file=sys.stderr)
        return UNUSABLE
    same, told = same_contours(first, second, asked)
    print(*told, sep="\n")
    return CLEAN if same else FINDINGS


def _as_json(answers: Iterator[_Checked], *, single: bool) -> int:
    """One object for one program on one control; otherwise a list of them, each with its file."""
    status, objects = CLEAN, []
    for checked in answers:
        status = max(status, _told(checked))
        objects += [one.json() if single else {"file": str(checked.path), **one.json()} for one in checked.answers]
    if not (single and status == UNUSABLE):
        json.dump(objects[0] if single and len(objects) == 1 else objects, sys.stdout)
        print()
    return status


def _as_text(answers: Iterator[_Checked], asked: Asked) -> int:
    """Everything about one program, or the table of all controls."""
    status = CLEAN
    for checked in answers:
        status = max(status, _told(checked))
        if asked.control == "all" and checked.answers:
            _print_table(checked.answers)
        elif checked.answers:
            print(*lines(checked.answers[0]), sep="\n")
    return status


def _print_table(answers: tuple[Answer, ...]) -> None:
    width = max(len(one.control) for one in answers)
    outcome = max(len(one.outcome) for one in answers)
    for one in answers:
        print(f"{one.control:<{width}}  {one.outcome:<{outcome}}  {one.parts}".rstrip())


def _as_summary(answers: Iterator[_Checked]) -> int:
    """One line for each file and control, and the sum of them."""
    status, counts = CLEAN, {CLEAN: 0, FINDINGS: 0, UNUSABLE: 0}
    for checked in answers:
        found = _told(checked)
        status = max(status, found)
        counts[found] += 1
        for one in checked.answers:
            print(f"{name_of(checked.path)}: {one.control}: {one.outcome}")
    print(f"{sum(counts.values())} files: {counts[CLEAN]} clean, {counts[FINDINGS]} with errors, ", end="")
    print(f"{counts[UNUSABLE]} not readable.")
    return status
