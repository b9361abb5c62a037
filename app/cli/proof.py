"""`cutcomp proof`: the screen NC PROOF on a file."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from app.cli.shell import UNUSABLE, say

if TYPE_CHECKING:
    from app.painted.screens.proof import ProofPage


def proof(arguments: list[str]) -> int:
    """Runs the command; returns the exit status."""
    from app.cli.control_options import Unusable

    options = _parser().parse_args(arguments)
    try:
        return _proof(options)
    except Unusable as trouble:
        say(str(trouble))
        return UNUSABLE


def shown(file: Path, characters: str = "") -> int:
    """The screen on a file, on the control it looks like."""
    from app.cli.screens import run

    return run(None, page=lambda: _page(file, ""), characters=characters)


def _parser() -> argparse.ArgumentParser:
    from app.cli.control_options import add_options

    parser = argparse.ArgumentParser(
        "cutcomp proof", description="The listing of an NC program, the path a control makes of it, and its findings."
    )
    parser.add_argument("file", type=Path, metavar="FILE", help="an NC program")
    parser.add_argument("--control", metavar="NAME[:VARIANT]", help="the control; the screen changes it by key")
    add_options(parser)
    return parser


def _proof(options: argparse.Namespace) -> int:
    from app.cli.control_options import control_of, tools_of, unit_of
    from app.cli.screens import run

    control = "" if options.control is None else control_of(options.control)
    tools, unit = tools_of(options), unit_of(options)

    def page() -> ProofPage:
        plain = _page(options.file, control)
        return replace(
            plain, asked=replace(plain.asked, tools=tools, unit=unit), tool=min(tools.tools, default=plain.tool)
        )

    return run(None, page=page)


def _page(file: Path, control: str) -> ProofPage:
    """The page on a file; StoreError where it cannot be read."""
    from app.painted.screens.proof import ProofPage
    from app.painted.screens.proof_files import read

    return ProofPage.of(read(file), file, control=control, alone=True)
