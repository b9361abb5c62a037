"""This module holds the commands for the shop: setup sheets, tool tables, and the screens in a browser."""

from __future__ import annotations

import argparse
from contextlib import suppress
from datetime import datetime
from pathlib import Path

from app.cli.commands import deliver
from app.cli.shell import SHOP_HELP, STATUS_CLEAN, STATUS_FINDINGS, STATUS_UNUSABLE, Unusable, reported, say
from app.documents import times
from app.documents.files import load, save
from app.documents.lock import Owner, myself, release, take
from app.documents.questions import held_sentence
from app.documents.tool_tables import merged, read_table, tool_line
from core.program.model import Program
from core.program.tools import table_faults
from core.units import Unit


@reported
def shop(arguments: list[str]) -> int:
    """Run one of these commands; return the exit status."""
    options = _parser(arguments[0]).parse_args(arguments[1:])
    return {"sheet": sheet, "tools": tools, "serve": serve}[arguments[0]](options)


def _parser(name: str) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(f"cutcomp {name}", description=SHOP_HELP[name])
    optional = "?" if name == "serve" else None
    parser.add_argument("file", nargs=optional, type=Path, metavar="FILE", help="a program file (TOML)")
    match name:
        case "sheet":
            parser.add_argument("-o", "--output", type=Path, metavar="OUT", help=".html: a page; anything else: text")
        case "tools":
            parser.add_argument("--import", type=Path, metavar="TABLE", dest="table", help="a LinuxCNC tool table")
            parser.add_argument("--units", type=str.upper, choices=tuple(Unit), help="of the table; else the program's")
        case _:
            parser.add_argument("--host", default="127.0.0.1", help="address to serve (this machine's own)")
            parser.add_argument("--port", type=_port, default=8000, help="1 to 65535")
            parser.add_argument("--allow-network", action="store_true", help="serve an address others can reach")
    return parser


def _port(text: str) -> int:
    if not (text.isascii() and text.isdigit() and len(text) < 6 and 1 <= int(text) <= 65535):
        raise argparse.ArgumentTypeError(f"{text} is no port; ports go from 1 to 65535.")
    return int(text)


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
