"""This module has the parsers of the screens and of the commands in `COMMAND_HELP`; other commands have their own."""

from __future__ import annotations

import argparse
from pathlib import Path

from app.cli.shell import COMMAND_HELP, SHOP_HELP
from app.documents.programs import examples

DESCRIPTION = """\
Type a MILL CONTOUR from the drawing, see what the cutter will do, write the NC file.

  cutcomp [FILE]             the screens, on FILE or on the start screen
  cutcomp --example [NAME]   the screens, on an example part
"""


def screen_parser() -> argparse.ArgumentParser:
    """Return the parser for the screens."""
    parser = argparse.ArgumentParser(
        "cutcomp",
        description=DESCRIPTION,
        epilog="commands without a screen:\n"
        + "".join(f"  cutcomp {name:<10} {text}\n" for name, text in (COMMAND_HELP | SHOP_HELP).items())
        + "  cutcomp check      what controls do with an NC program\n"
        + "  cutcomp import     contours of a DXF drawing as a program\n\nanother screen:\n"
        + "  cutcomp proof      an NC program, the path a control makes of it, its findings\n\n"
        + "`cutcomp COMMAND --help` tells more.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "file",
        nargs="?",
        type=Path,
        metavar="FILE",
        help="a program (TOML), an NC program to prove, a drawing (DXF), or a folder",
    )
    names = sorted(path.stem for path in examples().glob("*.toml"))
    parser.add_argument("--example", nargs="?", const="pocket", choices=names, help="open an example part")
    parser.add_argument(
        "--characters",
        choices=("braille", "block", "ascii"),
        default="",
        help="draw with these; by itself braille, half blocks on the Linux console, ASCII where LANG names no UTF-8",
    )
    parser.add_argument("--mouse", action="store_true", help="clicks act on fields, softkeys, lists and drawings")
    parser.add_argument("--light", action="store_true", help="dark ink on light paper")
    parser.add_argument("--version", action="store_true", help="print the version and end")
    return parser


def command_parser(name: str) -> argparse.ArgumentParser:
    """Return the parser for one of the commands in `COMMAND_HELP`."""
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
