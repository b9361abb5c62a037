"""This module holds the commands that read a program and write its path, its look-ahead table, NC text or picture."""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Final

from app.cli.shell import COMMAND_HELP, STATUS_CLEAN, STATUS_FINDINGS, Unusable, reported, say
from app.documents.files import load, load_from, write_output
from core.comp.lookahead import MAX_LOOKAHEAD, MIN_LOOKAHEAD
from core.program.model import Number, Program
from core.units import segment_name, sentence

if TYPE_CHECKING:
    from core.advice.lookahead_table import Table
    from core.controls.write.written_program import Refusal
    from core.pipeline.derived import Derived, DerivedBlock

STANDARD_STREAM: Final = "-"
"""Means standard input or standard output in place of a file."""
STDIN: Final = "standard input"
OTHER_PICTURES: Final = frozenset(
    (".bmp", ".dwg", ".eps", ".gif", ".jpeg", ".jpg", ".pdf", ".png", ".ps", ".svgz", ".tif", ".tiff", ".webp")
)
"""Suffixes of picture formats that plot does not write: a viewer would call such a file broken."""


@reported
def command(arguments: list[str]) -> int:
    """Run one of these commands; return the exit status."""
    options = _parser(arguments[0]).parse_args(arguments[1:])
    return {"path": path, "lookahead": lookahead, "post": post, "plot": plot}[arguments[0]](options)


def _parser(name: str) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(f"cutcomp {name}", description=COMMAND_HELP[name])
    parser.add_argument("file", type=Path, metavar="FILE", help="a program file (TOML), - for standard input")
    if name in ("path", "lookahead"):
        parser.add_argument("--block", type=int, metavar="N", help="this block only")
        parser.add_argument("--json", action="store_true", help="machine-readable")
    if name == "path":
        parser.add_argument("--lookahead", metavar="N|cal", help="use this look-ahead instead of the program's")
    if name in ("post", "plot"):
        what = "an .svg or .dxf file to write" if name == "plot" else "write here"
        parser.add_argument("-o", "--output", type=Path, metavar="OUT", help=f"{what} instead of standard output")
    if name == "post":
        parser.add_argument(
            "--override", metavar="SENTENCE", help="post although there is a gouge; the refusal names the words"
        )
        parser.add_argument(
            "--control", metavar="NAME[:VARIANT]", help="as that control's own G41, G42, RL or RR program"
        )
    return parser


def _derived(path: Path, block: int | None = None, lookahead: str | None = None) -> Derived:
    from core.pipeline.derive import derive, with_better_paths

    program = _program(path)
    if block is not None and not 1 <= block <= len(program.blocks):
        has = f"blocks 1 to {len(program.blocks)}" if len(program.blocks) > 1 else "1 block"
        raise Unusable(f"--block {block}: {path} has {has}.")
    return with_better_paths(derive(program if lookahead is None else _with_lookahead(program, lookahead)))


def _program(path: Path) -> Program:
    return load_from(sys.stdin.buffer, STDIN) if str(path) == STANDARD_STREAM else load(path)


def _name(path: Path) -> str:
    """Return the name of the program for its output."""
    return STDIN if str(path) == STANDARD_STREAM else path.stem


def _with_lookahead(program: Program, text: str) -> Program:
    if text.lower() == "cal":
        value = None
    elif text.isdecimal() and MIN_LOOKAHEAD <= int(text) <= MAX_LOOKAHEAD:
        value = Number(float(text))
    else:
        raise Unusable(f"--lookahead {text}: type {MIN_LOOKAHEAD} to {MAX_LOOKAHEAD}, or cal.")
    return replace(program, blocks=tuple(replace(block, lookahead=value) for block in program.blocks))


def _chosen(derived: Derived, number: int | None) -> tuple[DerivedBlock, ...]:
    return derived.blocks if number is None else (derived.block(number),)


def _status(derived: Derived, number: int | None) -> int:
    return STATUS_FINDINGS if any(block.errors for block in _chosen(derived, number)) else STATUS_CLEAN


def _report(derived: Derived, number: int | None) -> None:
    for block in _chosen(derived, number):
        for finding in block.findings:
            where = f", {segment_name(finding.segment)}" if finding.segment else ""
            say(f"block {block.number}{where}: {finding.severity}: {sentence(finding, derived.program.unit)}")


def path(options: argparse.Namespace) -> int:
    """Run `cutcomp path`, which prints the center path of every block."""
    from core.pipeline.command_output import path_document, path_listing

    derived = _derived(options.file, options.block, options.lookahead)
    if options.json:
        deliver(f"{json.dumps(path_document(derived, options.block), allow_nan=False)}\n", None)
    else:
        deliver("".join(f"{line}\n" for line in path_listing(derived, options.block)), None)
        _report(derived, options.block)
    return _status(derived, options.block)


def lookahead(options: argparse.Namespace) -> int:
    """Run `cutcomp lookahead`, which prints the result of every value, and what the contour needs."""
    from core.pipeline.command_output import table_document, table_listing
    from core.pipeline.derive import look_ahead_table

    derived = _derived(options.file, options.block)
    unit = derived.program.unit
    chosen = _chosen(derived, options.block)
    tables = [(block, _annotated(block, look_ahead_table(block, derived.program), derived.program)) for block in chosen]
    if options.json:
        blocks = [table_document(block, table, unit) for block, table in tables]
        text = json.dumps({"units": str(unit), "blocks": blocks}, allow_nan=False)
    else:
        text = "\n\n".join("\n".join(table_listing(block, table, unit)) for block, table in tables)
    deliver(f"{text}\n", None)
    if not options.json:
        _report(derived, options.block)
    return _status(derived, options.block)


def _annotated(block: DerivedBlock, table: Table | None, program: Program) -> Table | None:
    """Return the table with what the contour needs as its notes."""
    from core.pipeline.derive import advice_for_block

    return None if table is None else replace(table, notes=advice_for_block(block, program, table))


def post(options: argparse.Namespace) -> int:
    """Run `cutcomp post`, which writes the NC text or says why there is none."""
    from app.session.posting import refusals
    from core.controls.write.written_program import Posted
    from core.pipeline.post import post_center_path, post_control_program
    from core.pipeline.unit_question import unit_question

    control, derived, name = _control(options), _derived(options.file), _name(options.file)
    if control is None:
        result = post_center_path(derived, name=name, override=options.override)
    else:
        result = post_control_program(derived, name=name, control=control)
    _report(derived, None)
    if question := unit_question(derived):
        say(f"{question.severity}: {sentence(question, derived.program.unit)}")
    if not isinstance(result, Posted):
        reasons, remedies = refusals(derived, result)
        say(f"nothing was posted. {' '.join((*reasons, *remedies))}{_override_hint(result, options)}")
        return STATUS_FINDINGS
    if options.override is not None and not result.overridden:
        say("--override was not needed: nothing stood against posting.")
    for note in result.notes:
        say(f"{note.severity}: {sentence(note, derived.program.unit)}")
    deliver(result.text, options.output)
    return _status(derived, None)


def _override_hint(result: Refusal, options: argparse.Namespace) -> str:
    """Return the words that override the refusal; empty if it cannot be overridden."""
    from core.output.objections import OVERRIDABLE_CODES, OVERRIDE_PHRASE

    if options.control is not None or not all(finding.code in OVERRIDABLE_CODES for finding in result.findings):
        return ""
    wrong = "" if options.override is None else f" {options.override!r} are not the words."
    return f"{wrong} To post in spite of it: --override '{OVERRIDE_PHRASE}'"


def _control(options: argparse.Namespace) -> str | None:
    """Return the full name of the requested control; None for the path of the tool's center."""
    if options.control is None:
        return None
    if options.override is not None:
        raise Unusable("--override goes with the center path only: leave out --control.")
    from app.cli.control_options import control_of

    return control_of(options.control)


def plot(options: argparse.Namespace) -> int:
    """Run `cutcomp plot`, which writes the program as an SVG or DXF drawing."""
    from core.pipeline.plot import dxf_of, svg_of

    if options.output is not None and options.output.suffix.lower() in OTHER_PICTURES:
        raise Unusable(f"-o {options.output}: plot writes SVG and DXF; name a file that ends in .svg or .dxf.")
    derived = _derived(options.file)
    as_dxf = options.output is not None and options.output.suffix.lower() == ".dxf"
    text = dxf_of(derived) if as_dxf else svg_of(derived, title=_name(options.file))
    deliver(text, options.output)
    _report(derived, None)
    return _status(derived, None)


def deliver(text: str, output: Path | None) -> None:
    """Write the output of a command to a file, or to standard output for None and `-`."""
    if output is None or str(output) == STANDARD_STREAM:
        sys.stdout.write(text)
        sys.stdout.flush()
    else:
        write_output(output, text)
