"""`cutcomp check`: what controls do with an NC program, for one file or an archive of them."""

from __future__ import annotations

import argparse
import json
import os
import re
import sys
import threading
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass, replace
from multiprocessing import active_children, get_context
from pathlib import Path
from shlex import quote
from signal import SIG_IGN, SIGINT, signal
from typing import Final

from app.cli.control_options import add_options, bytes_of, control_of, tools_of, unit_of
from app.cli.shell import CLEAN, FINDINGS, UNUSABLE, Unusable, reported, say
from app.documents.nc_library import FolderLibrary
from app.documents.nc_text import NC_SUFFIXES
from app.documents.paths import printable_path
from core.controls.control_tools import commented_size
from core.controls.program_text import lines_of
from core.controls.registry import choices
from core.pipeline.checking import Answer, Asked, answer, answer_all, counted, lines, reasons, same_contours, unreadable
from core.units import Unit

JSON_VERSION: Final = 1
"""Counts up where a field of the JSON changes its meaning or goes; new fields leave it."""

FILES_AT_ONCE: Final = 4
"""Files that a process is given at a time, at most: more would keep the first answers back."""

MOST_NAMES: Final = 10
"""Suffixes of files left out that are named."""


@reported
def check(arguments: list[str]) -> int:
    """Runs the command; returns 0 for clean, 1 for errors found, 2 for what cannot be used."""
    options = _parser().parse_args(arguments)
    asked = _asked(options)
    paths = list(_programs(options.files))
    if options.contour:
        return _contours(paths, asked)
    single = len(paths) == 1 and paths[0] == options.files[0]
    answers = _answers(paths, asked)
    if options.json:
        return _as_json(answers)
    return _as_text(answers, asked) if single else _as_summary(answers)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        "cutcomp check",
        description="What a control does with an NC program: its moves, its alarms, what it gouges.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="controls:\n" + "\n".join(f"  {one.name:<24} {one.title}: {one.about}" for one in choices()),
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


def _asked(options: argparse.Namespace) -> Asked:
    every = options.control.strip().lower() == "all"
    return Asked("all" if every else control_of(options.control), tools_of(options), options.shop, unit_of(options))


def _programs(files: list[Path]) -> Iterator[Path]:
    """The files asked for, folders searched for programs."""
    for path in files:
        if not path.is_dir():
            yield path
            continue
        every = [one for one in path.rglob("*") if one.is_file()]
        found = sorted(one for one in every if _is_program(one))
        if found and len(found) < len(every):
            others = {one.suffix.lower() or one.name for one in every if not _is_program(one)}
            names = " ".join(map(printable_path, sorted(others)[:MOST_NAMES]))
            count = counted(len(every) - len(found), "file")
            text = f"{printable_path(path)}: {count} left out that are no programs by their names: {names}"
            say(text)
        yield from found or [path]


def _is_program(path: Path) -> bool:
    """Whether a file is a program by its name; Fanuc controls write `O1234` without a suffix."""
    return path.suffix.lower() in NC_SUFFIXES or re.fullmatch(r"[O:]\d{1,8}", path.name.upper()) is not None


@dataclass(frozen=True, eq=False, slots=True)
class _Checked:
    """A file's answers, or the sentence that says why it could not be read."""

    path: Path
    answers: tuple[Answer, ...] = ()
    unusable: str = ""
    text: bytes = b""


def _one(path: Path, asked: Asked) -> _Checked:
    try:
        if path.is_dir():
            raise Unusable(f"{printable_path(path)} is a folder without programs ({' '.join(sorted(NC_SUFFIXES))}).")
        text = bytes_of(path)
    except Unusable as trouble:
        return _Checked(path, unusable=str(trouble))
    asked = replace(asked, library=FolderLibrary(path.parent))
    found = answer_all(text, asked) if asked.control == "all" else (answer(text, asked),)
    return _Checked(path, found, text=text if any(one.missing for one in found) else b"")


def _answers(paths: list[Path], asked: Asked) -> Iterator[_Checked]:
    """Every file's answers in order; several files in several processes."""
    workers = min(len(paths), os.cpu_count() or 1)
    if workers < 2:
        yield from (_one(path, asked) for path in paths)
        return
    with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool:
        with _uninterrupted():
            at_once = max(1, min(FILES_AT_ONCE, len(paths) // (8 * workers)))
            answers = pool.map(_one, paths, [asked] * len(paths), chunksize=at_once)
        try:
            yield from answers
        except BrokenProcessPool:
            raise Unusable("A process that checked files was ended from outside; the rest is not checked.") from None
        except BaseException:
            # nobody waits for what is being worked out, nor for the pool's own thread to say that it is canceled
            threading.excepthook = lambda _: None
            _end(pool)
            raise


def _end(pool: ProcessPoolExecutor) -> None:
    """End a pool's processes in the middle of their work.

    One that is ended while it sends a long answer leaves half of it in the pipe; the pool's thread would wait for the
    other half for ever if this process held that end of the pipe open.
    """
    for process in active_children():
        process.kill()
    # the library has no name of its own for it
    pool._result_queue._writer.close()  # type: ignore[attr-defined]


@contextmanager
def _uninterrupted() -> Iterator[None]:
    """Processes that begin here do not hear Ctrl+C: it is for the one that started them."""
    try:
        before = signal(SIGINT, SIG_IGN)
    except ValueError:  # not in the main thread, which alone hears it
        yield
        return
    try:
        yield
    finally:
        signal(SIGINT, before)


def _told(checked: _Checked) -> int:
    """A file's status; what could not be read is said on standard error."""
    if checked.unusable:
        say(checked.unusable)
        return UNUSABLE
    return FINDINGS if any(one.errors for one in checked.answers) else CLEAN


def _contours(paths: list[Path], asked: Asked) -> int:
    """Two programs by their contours: 0 if they describe the same, 1 if not."""
    if len(paths) != 2:
        raise Unusable("--contour compares two files.")
    first, second = (bytes_of(path) for path in paths)
    same, told = same_contours(first, second, asked)
    print(*told, sep="\n")
    return CLEAN if same else FINDINGS


def _as_json(answers: Iterator[_Checked]) -> int:
    """One shape for any number of files and controls; `check-json.md` describes it."""
    status, results = CLEAN, list[dict[str, object]]()
    for checked in answers:
        status = max(status, _told(checked))
        if checked.unusable:
            results.append(unreadable(str(checked.path), checked.unusable))
        results += [{"file": str(checked.path), **one.json()} for one in checked.answers]
    json.dump({"version": JSON_VERSION, "results": results}, sys.stdout)
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
        _print_missing(checked.answers, lines_of(checked.text))
    return status


def _print_table(answers: tuple[Answer, ...]) -> None:
    width = max(len(one.name) for one in answers)
    outcome = max(len(one.outcome_and_warnings) for one in answers)
    for one in answers:
        print(f"{one.name:<{width}}  {one.outcome_and_warnings:<{outcome}}  {one.parts}".rstrip())
    for reason in reasons(answers):
        print(reason)


def _print_missing(answers: tuple[Answer, ...], program: list[str]) -> None:
    """How the tools are given for whose diameter a control stops, and what the program's comments say of them."""
    missing = sorted({one.missing for one in answers if one.missing is not None}, key=str)
    if missing:
        told = " and ".join(map(str, missing))
        size = "10mm" if answers[0].unit is Unit.MM else "0.5in"
        sizes = " ".join(f"--tool {quote(str(tool))}={size}" for tool in missing)
        table = ", or --tools TABLE" if all(isinstance(tool, int) for tool in missing) else ""
        print(f"No diameter of tool {told} is known: add {sizes} with the real diameter{table}.")
    for tool in missing:
        if (said := commented_size(program, tool)) is not None:
            print(f"The comment in line {said.line} says diameter {said.diameter} for tool {tool}.")


def _as_summary(answers: Iterator[_Checked]) -> int:
    """One line for each file and control, and the sum of them."""
    status, counts, warned = CLEAN, {CLEAN: 0, FINDINGS: 0, UNUSABLE: 0}, 0
    for checked in answers:
        found = _told(checked)
        status = max(status, found)
        counts[found] += 1
        for one in checked.answers:
            print(f"{printable_path(checked.path)}: {one.name}: {one.outcome_and_warnings}", flush=True)
        warned += found == CLEAN and any(one.warnings for one in checked.answers)
    print(f"{sum(counts.values())} files: {counts[CLEAN] - warned} clean, {warned} with warnings, ", end="")
    print(f"{counts[FINDINGS]} with errors, {counts[UNUSABLE]} not readable.")
    return status
