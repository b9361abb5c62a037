"""`cutcomp check` reports what controls do with an NC program, for one file or an archive of them."""

from __future__ import annotations

import argparse
import json
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from shlex import quote
from typing import Final

from app.cli.control_options import add_options, bytes_of, control_of, tools_of
from app.cli.shell import STATUS_CLEAN, STATUS_FINDINGS, STATUS_UNUSABLE, Unusable, reported, say
from app.documents.nc_library import called_program
from app.documents.nc_text import NC_SUFFIXES
from app.documents.paths import printable_path
from core.controls.control_tools import commented_size
from core.controls.program_text import lines_of
from core.controls.registry import choices
from core.pipeline import checking
from core.pipeline.checking import Answer, CheckRequest
from core.units import Unit

JSON_VERSION: Final = 1
"""Increases when a field of the JSON changes its meaning or is removed, but not for new fields."""

MAX_NAMES: Final = 10
"""The most suffixes (or names without one) listed for the files that are left out."""


@reported
def check(arguments: list[str]) -> int:
    """Run the command; return 0 for clean, 1 for errors found, 2 for input that cannot be used."""
    options = _parser().parse_args(arguments)
    control = "all" if options.control.strip().lower() == "all" else control_of(options.control)
    request = CheckRequest(control, tools_of(options), options.shop, Unit(options.units) if options.units else None)
    paths = list(_programs(options.files))
    if options.contour:
        return _contours(paths, request)
    single = len(paths) == 1 and paths[0] == options.files[0]
    answers = (_check_file(path, request) for path in paths)
    if options.json:
        return _as_json(answers)
    return _as_text(next(answers), request) if single else _as_summary(answers)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        "cutcomp check",
        description="What a control does with an NC program: its moves, its alarms, what it gouges.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="controls:\n" + "\n".join(f"  {choice.name:<24} {choice.title}: {choice.about}" for choice in choices()),
    )
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE", help="a program, or a folder of them")
    parser.add_argument("--control", required=True, metavar="NAME[:VARIANT]|all", help="the control, or all of them")
    add_options(parser)
    parser.add_argument("--shop", action="store_true", help="the shop's rules H1 to H9 too")
    parser.add_argument(
        "--contour", action="store_true", help="compare two programs, of any language, by the contours they describe"
    )
    parser.add_argument("--json", action="store_true", help="machine-readable")
    return parser


def _programs(files: list[Path]) -> Iterator[Path]:
    """Yield the given files, and the programs in given folders; a folder without programs is yielded itself."""
    for path in files:
        if not path.is_dir():
            yield path
            continue
        all_files = [file for file in path.rglob("*") if file.is_file()]
        programs = sorted(file for file in all_files if _is_program(file))
        if programs and len(programs) < len(all_files):
            others = {file.suffix.lower() or file.name for file in all_files if not _is_program(file)}
            names = " ".join(map(printable_path, sorted(others)[:MAX_NAMES]))
            count = checking.counted(len(all_files) - len(programs), "file")
            say(f"{printable_path(path)}: {count} left out, whose names are not those of programs: {names}")
        yield from programs or [path]


def _is_program(path: Path) -> bool:
    """True if a file is a program by its name; Fanuc controls write `O1234` without a suffix."""
    return path.suffix.lower() in NC_SUFFIXES or re.fullmatch(r"[O:]\d{1,8}", path.name.upper()) is not None


@dataclass(frozen=True, eq=False, slots=True)
class _Checked:
    """A file's answers, or the sentence that says why it could not be used."""

    path: Path
    answers: tuple[Answer, ...] = ()
    unusable: str = ""
    text: bytes = b""


def _check_file(path: Path, request: CheckRequest) -> _Checked:
    try:
        if path.is_dir():
            raise Unusable(f"{printable_path(path)} is a folder without programs ({' '.join(sorted(NC_SUFFIXES))}).")
        text = bytes_of(path)
    except Unusable as error:
        return _Checked(path, unusable=str(error))
    request = replace(request, library=partial(called_program, path.parent))
    answers = checking.answer_all(text, request) if request.control == "all" else (checking.answer(text, request),)
    return _Checked(path, answers, text=text if any(result.missing for result in answers) else b"")


def _status_of(checked: _Checked) -> int:
    """Return a file's status; say on standard error why it could not be used."""
    if checked.unusable:
        say(checked.unusable)
        return STATUS_UNUSABLE
    return STATUS_FINDINGS if any(result.errors for result in checked.answers) else STATUS_CLEAN


def _contours(paths: list[Path], request: CheckRequest) -> int:
    """Compare two programs by their contours; return 0 if they describe the same, 1 if not."""
    if len(paths) != 2:
        raise Unusable("--contour compares two files.")
    first, second = (bytes_of(path) for path in paths)
    same, report = checking.same_contours(first, second, request)
    print(*report, sep="\n")
    return STATUS_CLEAN if same else STATUS_FINDINGS


def _as_json(answers: Iterator[_Checked]) -> int:
    """Print JSON of one shape for any number of files and controls; `check-json.md` describes it."""
    status, results = STATUS_CLEAN, list[dict[str, object]]()
    for checked in answers:
        status = max(status, _status_of(checked))
        if checked.unusable:
            results.append(checking.unreadable(str(checked.path), checked.unusable))
        results += [{"file": str(checked.path), **result.json()} for result in checked.answers]
    json.dump({"version": JSON_VERSION, "results": results}, sys.stdout)
    print()
    return status


def _as_text(checked: _Checked, request: CheckRequest) -> int:
    """Print everything about one program, or the table of all controls."""
    status = _status_of(checked)
    answers = checked.answers
    if request.control == "all" and answers:
        width = max(len(result.name) for result in answers)
        outcome = max(len(result.outcome_and_warnings) for result in answers)
        for result in answers:
            print(f"{result.name:<{width}}  {result.outcome_and_warnings:<{outcome}}  {result.comparison}".rstrip())
        for reason in checking.reasons(answers):
            print(reason)
    elif answers:
        print(*checking.lines(answers[0]), sep="\n")
    _print_missing(answers, lines_of(checked.text))
    return status


def _print_missing(answers: tuple[Answer, ...], program: list[str]) -> None:
    """Print how to give the tool diameters that controls miss, and what the program's comments say of them."""
    missing = sorted({result.missing for result in answers if result.missing is not None}, key=str)
    if missing:
        names = " and ".join(map(str, missing))
        size = "10mm" if answers[0].unit is Unit.MM else "0.5in"
        sizes = " ".join(f"--tool {quote(str(tool))}={size}" for tool in missing)
        table = ", or --tools TABLE" if all(isinstance(tool, int) for tool in missing) else ""
        print(f"No diameter of tool {names} is known: add {sizes} with the real diameter{table}.")
    for tool in missing:
        if (comment := commented_size(program, tool)) is not None:
            print(f"The comment in line {comment.line} says diameter {comment.diameter} for tool {tool}.")


def _as_summary(answers: Iterator[_Checked]) -> int:
    """Print one line for each file and control, and then the totals."""
    status, counts, warned = STATUS_CLEAN, {STATUS_CLEAN: 0, STATUS_FINDINGS: 0, STATUS_UNUSABLE: 0}, 0
    for checked in answers:
        file_status = _status_of(checked)
        status = max(status, file_status)
        counts[file_status] += 1
        for result in checked.answers:
            print(f"{printable_path(checked.path)}: {result.name}: {result.outcome_and_warnings}", flush=True)
        warned += file_status == STATUS_CLEAN and any(result.warnings for result in checked.answers)
    print(f"{sum(counts.values())} files: {counts[STATUS_CLEAN] - warned} clean, {warned} with warnings, ", end="")
    print(f"{counts[STATUS_FINDINGS]} with errors, {counts[STATUS_UNUSABLE]} not readable.")
    return status
