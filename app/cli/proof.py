"""`cutcomp proof` opens the screen NC PROOF on a file."""

from __future__ import annotations

import argparse
from pathlib import Path

from app.cli.shell import Unusable, prepare, reported


@reported
def proof(arguments: list[str]) -> int:
    """Run the command; return the exit status."""
    from app.cli.control_options import control_of, tools_of, unit_of
    from app.documents.programs import is_nc
    from core.pipeline.checking import CheckRequest

    options = _parser().parse_args(arguments)
    control = "" if options.control is None else control_of(options.control)
    request = CheckRequest(control, tools_of(options), shop=False, unit=unit_of(options))
    if options.file.is_file() and not is_nc(options.file):
        raise Unusable(f"{options.file} is a program, not an NC file: cutcomp {options.file} opens it.")
    prepare()
    from app.cli.screens import run

    return run(options.file, check_request=request)


def _parser() -> argparse.ArgumentParser:
    from app.cli.control_options import add_options

    parser = argparse.ArgumentParser(
        "cutcomp proof", description="The listing of an NC program, the path a control makes of it, and its findings."
    )
    parser.add_argument("file", type=Path, metavar="FILE", help="an NC program")
    parser.add_argument("--control", metavar="NAME[:VARIANT]", help="the control; the screen changes it by key")
    add_options(parser)
    return parser
