"""This module holds the commands on a program: path, look-ahead table, NC text, picture, sheet, tools, and `serve`."""

from __future__ import annotations

import argparse
import json
import sys
from contextlib import suppress
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Final

from app.cli.shell import COMMAND_HELP, STATUS_CLEAN, STATUS_FINDINGS, STATUS_UNUSABLE, Unusable, reported, say
from app.documents import times
from app.documents.files import load, load_from, save, write_output
from app.documents.lock import Owner, myself, release, take
from app.documents.questions import held_sentence
from app.documents.tool_tables import merged, read_table, tool_line
from core.comp.lookahead import MAX_LOOKAHEAD, MIN_LOOKAHEAD
from core.program.model import Number, Program
from core.program.tools import table_faults
from core.units import Unit, located_sentence, segment_name, sentence

if TYPE_CHECKING:
    from core.controls.write.written_program import Refusal
    from core.pipeline.derived import Derived

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
    run = {
        "path": path,
        "lookahead": lookahead,
        "post": post,
        "plot": plot,
        "sheet": sheet,
        "tools": tools,
        "serve": serve,
    }
    return run[arguments[0]](_parser(arguments[0]).parse_args(arguments[1:]))


def _parser(name: str) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(f"cutcomp {name}", description=COMMAND_HELP[name])
    optional, stdin = "?" if name == "serve" else None, name in ("path", "lookahead", "post", "plot")
    about_file = f"a program file (TOML){', - for standard input' if stdin else ''}"
    parser.add_argument("file", nargs=optional, type=Path, metavar="FILE", help=about_file)
    if name in ("path", "lookahead"):
        parser.add_argument("--block", type=int, metavar="N", help="this block only")
        parser.add_argument("--json", action="store_true", help="machine-readable")
    match name:
        case "path":
            parser.add_argument("--lookahead", metavar="N|cal", help="use this look-ahead instead of the program's")
        case "post":
            _add_output(parser, "write here instead of standard output")
            about_override = "post although there is a gouge; the refusal names the phrase"
            parser.add_argument("--override", metavar="SENTENCE", help=about_override)
            about_control = "as that control's own G41, G42, RL or RR program"
            parser.add_argument("--control", metavar="NAME[:VARIANT]", help=about_control)
        case "plot":
            _add_output(parser, "an .svg or .dxf file to write instead of standard output")
        case "sheet":
            _add_output(parser, ".html: a page; anything else: text")
        case "tools":
            parser.add_argument("--import", type=Path, metavar="TABLE", dest="table", help="a LinuxCNC tool table")
            parser.add_argument("--units", type=str.upper, choices=tuple(Unit), help="of the table; else the program's")
        case "serve":
            parser.add_argument("--host", default="127.0.0.1", help="address to serve (this machine's own)")
            parser.add_argument("--port", type=_port, default=8000, help="1 to 65535")
            parser.add_argument("--allow-network", action="store_true", help="serve an address others can reach")
    return parser


def _add_output(parser: argparse.ArgumentParser, about: str) -> None:
    parser.add_argument("-o", "--output", type=Path, metavar="OUT", help=about)


def _port(text: str) -> int:
    if not (text.isascii() and text.isdigit() and len(text) < 6 and 1 <= int(text) <= 65535):
        raise argparse.ArgumentTypeError(f"{text} is not a port; ports go from 1 to 65535.")
    return int(text)


def _derived(path: Path, block: int | None = None, lookahead: str | None = None) -> Derived:
    """Return a file's program derived, or only one block of it, with another look-ahead if one is given."""
    from core.pipeline.derive import derive, with_better_paths

    program = load_from(sys.stdin.buffer, STDIN) if str(path) == STANDARD_STREAM else load(path)
    if block is not None and not 1 <= block <= len(program.blocks):
        has = f"blocks 1 to {len(program.blocks)}" if len(program.blocks) > 1 else "1 block"
        raise Unusable(f"--block {block}: {path} has {has}.")
    derived = with_better_paths(derive(program if lookahead is None else _with_lookahead(program, lookahead)))
    return derived if block is None else replace(derived, blocks=(derived.block(block),))


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


def _status(derived: Derived) -> int:
    return STATUS_FINDINGS if any(block.errors for block in derived.blocks) else STATUS_CLEAN


def _report(derived: Derived) -> None:
    for block in derived.blocks:
        for finding in block.findings:
            where = f", {segment_name(finding.segment)}" if finding.segment else ""
            say(f"block {block.number}{where}: {finding.severity}: {sentence(finding, derived.program.unit)}")


def path(options: argparse.Namespace) -> int:
    """Run `cutcomp path`, which prints the center path of every block."""
    from core.pipeline.command_output import path_document, path_listing

    derived = _derived(options.file, options.block, options.lookahead)
    if options.json:
        deliver(f"{json.dumps(path_document(derived), allow_nan=False)}\n", None)
    else:
        deliver("".join(f"{line}\n" for line in path_listing(derived)), None)
        _report(derived)
    return _status(derived)


def lookahead(options: argparse.Namespace) -> int:
    """Run `cutcomp lookahead`, which prints the result of every value, and what the contour needs."""
    from core.pipeline.command_output import table_document, table_listing
    from core.pipeline.derive import advice_for_block, look_ahead_table

    derived = _derived(options.file, options.block)
    unit = derived.program.unit
    tables = []
    for block in derived.blocks:
        table = look_ahead_table(block, derived.program)
        # with what the contour needs as its notes
        noted = table and replace(table, notes=advice_for_block(block, derived.program, table))
        tables.append((block, noted))
    if options.json:
        blocks = [table_document(block, table, unit) for block, table in tables]
        text = json.dumps({"units": str(unit), "blocks": blocks}, allow_nan=False)
    else:
        text = "\n\n".join("\n".join(table_listing(block, table, unit)) for block, table in tables)
    deliver(f"{text}\n", None)
    if not options.json:
        _report(derived)
    return _status(derived)


def post(options: argparse.Namespace) -> int:
    """Run `cutcomp post`, which writes the NC text or says why there is none."""
    from app.session.posting import refusals
    from core.controls.write.written_program import Posted
    from core.pipeline.post import post_center_path, post_control_program
    from core.pipeline.unit_question import unit_question

    control = None
    if options.control is not None:
        if options.override is not None:
            raise Unusable("--override goes with the center path only: leave out --control.")
        from app.cli.control_options import control_of

        control = control_of(options.control)
    derived, name = _derived(options.file), _name(options.file)
    if control is None:
        result = post_center_path(derived, name=name, override=options.override)
    else:
        result = post_control_program(derived, name=name, control=control)
    _report(derived)
    if question := unit_question(derived):
        say(f"{question.severity}: {sentence(question, derived.program.unit)}")
    if not isinstance(result, Posted):
        reasons, remedies = refusals(derived, result)
        say(f"nothing was posted. {' '.join((*reasons, *remedies))}{_override_hint(result, options)}")
        return STATUS_FINDINGS
    if options.override is not None and not result.overridden:
        say("--override was not needed: nothing prevented posting.")
    for note in result.notes:
        say(f"{note.severity}: {located_sentence(note, derived.program.unit)}")
    deliver(result.text, options.output)
    return _status(derived)


def _override_hint(result: Refusal, options: argparse.Namespace) -> str:
    """Return the words that override the refusal; empty if it cannot be overridden."""
    from core.output.objections import OVERRIDABLE_CODES, OVERRIDE_PHRASE

    if options.control is not None or not all(finding.code in OVERRIDABLE_CODES for finding in result.findings):
        return ""
    wrong = "" if options.override is None else f" {options.override!r} is not the phrase."
    return f"{wrong} To post in spite of it: --override '{OVERRIDE_PHRASE}'"


def plot(options: argparse.Namespace) -> int:
    """Run `cutcomp plot`, which writes the program as an SVG or DXF drawing."""
    from core.pipeline.plot import dxf_of, svg_of

    if options.output is not None and options.output.suffix.lower() in OTHER_PICTURES:
        raise Unusable(f"-o {options.output}: plot writes SVG and DXF; name a file that ends in .svg or .dxf.")
    derived = _derived(options.file)
    as_dxf = options.output is not None and options.output.suffix.lower() == ".dxf"
    text = dxf_of(derived) if as_dxf else svg_of(derived, title=_name(options.file))
    deliver(text, options.output)
    _report(derived)
    return _status(derived)


def sheet(options: argparse.Namespace) -> int:
    """Run `cutcomp sheet`, which writes the setup sheet; return 1 if the sheet says DO NOT RUN."""
    from app.session.posting import setup_sheet
    from core.output.sheet import NOT_READY_TEXT

    program = load(options.file)
    text = setup_sheet(program, options.output or Path("-"), datetime.now().astimezone(), name=options.file.stem)
    deliver(text, options.output)
    return STATUS_FINDINGS if NOT_READY_TEXT in text else STATUS_CLEAN


def tools(options: argparse.Namespace) -> int:
    """Run `cutcomp tools`, which lists a program's tools; an import before that is complete or changes nothing."""
    if options.table is None:
        return _print_tools(load(options.file))
    now, lock = times.now(), None
    with suppress(OSError):
        # if no lock can be written, neither can the program, and saving it says so
        lock = take(options.file, myself(now))
    if isinstance(lock, Owner):
        raise Unusable(f"nothing was imported: {held_sentence(lock, now)} TOOL SETUP there imports a table, too.")
    try:
        return _import_table(options)
    finally:
        if lock is not None:
            release(lock)


def _import_table(options: argparse.Namespace) -> int:
    program = load(options.file)
    table = read_table(options.table, Unit(options.units) if options.units else program.unit, program.unit)
    if table.errors:
        say(table_faults(str(options.table), table.errors))
        say("nothing was imported.")
        return STATUS_UNUSABLE
    for finding in table.findings:
        say(f"{options.table}, line {finding.line}, column {finding.column}: warning: {finding.text}")
    program = merged(program, table.tools)
    save(program, options.file)
    return _print_tools(program)


def _print_tools(program: Program) -> int:
    for tool in program.tools:
        print(tool_line(tool, program.unit))
    return STATUS_CLEAN


def serve(options: argparse.Namespace) -> int:
    """Run `cutcomp serve` until Ctrl+C."""
    from app.cli import web

    if reason := web.refusal(options.host, allow_network=options.allow_network):
        raise Unusable(reason)
    say(web.NO_LOGIN)
    say("Where the browser keeps a function key to itself, Esc and then its digit does the same.")
    try:
        from app.cli.web_server import serve as serve_screens
    except ImportError:
        raise Unusable(web.MISSING_PACKAGE_TEXT) from None
    try:
        serve_screens(options.file, options.host, options.port)
    except (OSError, UnicodeError) as error:
        address = web.address(options.host, options.port)
        raise Unusable(f"{address} cannot be served: {web.why_not_served(error)}") from error
    return STATUS_CLEAN


def deliver(text: str, output: Path | None) -> None:
    """Write the output of a command to a file, or to standard output for None and `-`."""
    if output is None or str(output) == STANDARD_STREAM:
        sys.stdout.write(text)
        sys.stdout.flush()
    else:
        write_output(output, text)
