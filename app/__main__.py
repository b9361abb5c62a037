"""The command line: the screens, and the same program without a screen.

Exit status: 0 clean, 1 findings of severity error, 2 unusable input or arguments.  Results go to standard output,
messages to standard error.
"""

from __future__ import annotations

import argparse
import sys
from importlib.resources import files
from pathlib import Path

from app import shop
from app.commands import COMMANDS, UNUSABLE, say

DESCRIPTION = """\
Type a MILL CONTOUR from the drawing, see what the cutter will do, write the NC file.

  cutcomp [FILE]             the screens, on FILE or on the start screen
  cutcomp --example [NAME]   the screens, on an example part
"""

COMMAND_HELP = {
    "path": "the centre path of every block",
    "lookahead": "what becomes of the path at every look-ahead value",
    "post": "write the NC file",
    "plot": "draw the program as SVG",
}


def main(arguments: list[str] | None = None) -> int:
    """Run the program with these arguments, or with the command line's; returns the exit status."""
    given = sys.argv[1:] if arguments is None else arguments
    if given and given[0] == "check":
        from app.check import check

        return check(given[1:])
    if given and given[0] == "proof":
        from app.proof import proof

        return proof(given[1:])
    if given and given[0] in shop.HELP:
        return shop.shop(given)
    if given and given[0] in COMMANDS:
        options = _command_parser(given[0]).parse_args(given[1:])
        return COMMANDS[given[0]](options)
    return _screens(_screen_parser().parse_args(given))


def _screen_parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        "cutcomp",
        description=DESCRIPTION,
        epilog="commands without a screen:\n"
        + "".join(f"  cutcomp {name:<10} {text}\n" for name, text in (COMMAND_HELP | shop.HELP).items())
        + "  cutcomp check      what controls do with an NC program\n\nanother screen:\n"
        + "  cutcomp proof      an NC program, the path a control makes of it, its findings\n\n"
        + "`cutcomp COMMAND --help` tells more.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "file", nargs="?", type=Path, metavar="FILE", help="a program file (TOML), or an NC file to prove"
    )
    parser.add_argument("--example", nargs="?", const="pocket", choices=example_names(), help="open an example part")
    parser.add_argument(
        "--characters",
        choices=("braille", "block", "ascii"),
        default="",
        help="draw with these; by itself braille, half blocks on the Linux console, ASCII where LANG names no UTF-8",
    )
    return parser


def _command_parser(name: str) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(f"cutcomp {name}", description=COMMAND_HELP[name])
    parser.add_argument("file", type=Path, metavar="FILE", help="a program file (TOML)")
    if name in ("path", "lookahead"):
        parser.add_argument("--block", type=int, metavar="N", help="this block only")
        parser.add_argument("--json", action="store_true", help="machine-readable")
    if name == "path":
        parser.add_argument("--lookahead", metavar="N|cal", help="use this look-ahead instead of the program's")
    if name in ("post", "plot"):
        parser.add_argument("-o", "--output", type=Path, metavar="OUT", help="write here instead of standard output")
    if name == "post":
        parser.add_argument("--override", metavar="SENTENCE", help="post in spite of a gouge; refusals name the words")
        parser.add_argument(
            "--control", metavar="NAME[:VARIANT]", help="as that control's own G41, G42, RL or RR program"
        )
    return parser


def _screens(options: argparse.Namespace) -> int:
    from app.listing import is_nc
    from app.main import run

    if options.file is not None and is_nc(options.file):
        from app.proof import shown

        return shown(options.file, options.characters)
    return run(options.file, example=options.example, characters=options.characters)


def example_names() -> tuple[str, ...]:
    """Names of the example parts that ship with the program."""
    found = (entry.name for entry in files("app").joinpath("examples").iterdir())
    return tuple(sorted(name.removesuffix(".toml") for name in found if name.endswith(".toml")))


def guarded() -> None:
    """The console command: a closed pipe and Ctrl+C end it quietly."""
    try:
        status = main()
    except KeyboardInterrupt:
        status = 130
    except BrokenPipeError:
        sys.stderr.close()
        status = UNUSABLE
    except OSError as error:
        say(str(error))
        status = UNUSABLE
    sys.exit(status)


if __name__ == "__main__":
    guarded()
