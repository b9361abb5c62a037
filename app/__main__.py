"""This module is the command line: it starts the screens or a command that runs without them.

Exit status: 0 clean, 1 findings of severity error, 2 unusable input or arguments.  Results go to standard output,
messages to standard error.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

from app.cli import lifeline
from app.cli.shell import COMMAND_HELP, NOTHING_ASKED, STATUS_UNUSABLE, TerminalOptions, prepare, say
from app.documents.paths import is_drawing

DESCRIPTION = """\
Type a MILL CONTOUR from the drawing, see what the cutter will do, write the NC file.

  cutcomp [FILE]             the screens, on FILE or on the start screen
  cutcomp --example [NAME]   the screens, on an example part
"""


def main(arguments: list[str] | None = None) -> int:
    """Run the program with these arguments, or with the command line's; return the exit status."""
    given = sys.argv[1:] if arguments is None else arguments
    match given:
        case []:
            return screens(None)
        case ["check", *rest]:
            from app.cli.check import check

            return check(rest)
        case ["proof", *rest]:
            from app.cli.screens import proof

            return proof(rest)
        case ["import", *rest]:
            from app.cli.import_contours import import_contours

            return import_contours(rest)
        case [word, *_] if word in COMMAND_HELP:
            from app.cli.commands import command

            return command(given)
        case [word] if not word.startswith("-"):
            # a file alone needs no parser, so that the screens appear sooner
            return screens(Path(word))
        case _:
            return _parsed(given)


def _parsed(given: list[str]) -> int:
    import argparse

    from app.documents.programs import examples
    from app.terminal.capabilities import CHARACTER_SETS

    parser = argparse.ArgumentParser(
        "cutcomp",
        description=DESCRIPTION,
        epilog="commands without a screen:\n"
        + "".join(f"  cutcomp {name:<10} {text}\n" for name, text in COMMAND_HELP.items())
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
        choices=CHARACTER_SETS,
        default="",
        help="draw with these; by itself braille, half blocks on the Linux console, ASCII where LANG names no UTF-8",
    )
    parser.add_argument("--mouse", action="store_true", help="clicks act on fields, softkeys, lists and drawings")
    parser.add_argument("--light", action="store_true", help="dark text on a light background")
    parser.add_argument("--version", action="store_true", help="print the version and end")
    options = parser.parse_args(given)
    if options.version:
        from importlib.metadata import version

        print(f"cutcomp {version('cutcomp')}")
        return 0
    return screens(
        options.file, options.example, TerminalOptions(options.characters, light=options.light, mouse=options.mouse)
    )


def screens(file: Path | None, example: str | None = None, options: TerminalOptions = NOTHING_ASKED) -> int:
    """Run the screens on a program, NC file, drawing, or example part, or the start screen; return the exit status."""
    if file is not None and is_drawing(file) and not file.is_file():
        say(f"{file}: there is no such drawing.")
        return STATUS_UNUSABLE
    # must run before the imports below
    prepare()
    from app.cli.screens import run

    return run(file, example=example, options=options)


def guarded() -> None:
    """Run the console command; a closed pipe and Ctrl+C end it quietly, a file error is reported in a sentence."""
    lifeline.watch()
    try:
        status = main()
        # flush now: at exit the interpreter would report a failure with a traceback
        sys.stdout.flush()
    except KeyboardInterrupt:
        status = 130
    except BrokenPipeError:
        sys.stderr.close()
        status = STATUS_UNUSABLE
    except OSError as error:
        say(trouble(error))
        status = STATUS_UNUSABLE
    sys.exit(status)


def trouble(error: OSError) -> str:
    """Return what the system refused, as a sentence; an error without a file name is one of standard output."""
    from app.documents.files import why

    if error.filename is not None:
        return f"{error.filename}: {why(error)}"
    # discard what is still buffered: it could not be written at exit either
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return f"standard output cannot be written: {why(error)}"


if __name__ == "__main__":
    guarded()
