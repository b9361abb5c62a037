"""`cutcomp import` turns contours of a drawing or an NC program into a program of MILL CONTOUR blocks."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from dataclasses import replace
from math import isfinite, nan
from pathlib import Path

from app.cli.control_options import add_tool_options, bytes_of, control_of, tools_of
from app.cli.drawing_list import list_drawing
from app.cli.shell import STATUS_CLEAN, Unusable, reported, say
from app.documents.drawing_files import Worker, drawing_bytes
from app.documents.files import write_text
from app.documents.programs import empty_program
from app.session.formats import counted, length, place
from core.geometry.piece import Side
from core.importing.contour import Contour, fitted_contour, reversed_contour, started_at
from core.importing.contours import ContourList, frame_notes
from core.importing.drawing import DrawingError, DrawingUnit
from core.importing.listing import rows_of, sentences, table
from core.importing.nc_contour import CenterPathTool, NcContour, NcError, nc_blocks
from core.importing.segments import DoesNotFitError, comment, with_contours
from core.pipeline.checking import tool_option
from core.program.file.write import dumps
from core.program.model import Program
from core.units import Unit, to_mm


@reported
def import_contours(arguments: list[str]) -> int:
    """Run the command; return 0, or 2 for input that cannot be used."""
    options = _parser().parse_args(arguments)
    try:
        _refuse_unused(options)
        if options.control is None:
            _import(options)
        else:
            import_nc(options)
    except NcError as error:
        more = " Add --side left or right and --diameter D, or --side on." if error.needs_center else ""
        option = "" if error.tool is None else f" {tool_option(error.tool)}"
        raise Unusable(f"{error}{option}{more}") from error
    except DoesNotFitError as error:
        raise Unusable(str(error)) from error
    except DrawingError as error:
        raise Unusable(f"{error.text}{_remedy(error, options)}") from error
    return STATUS_CLEAN


def _refuse_unused(options: argparse.Namespace) -> None:
    """Raise Unusable for an option that would do nothing here."""
    if options.control is None:
        if name := _first_given(options, "side", "diameter", "tools", "tool"):
            raise Unusable(f"--{name} goes with an NC program only: add --control NAME.")
        if options.fit == 0.0:
            raise Unusable("--fit 0: type a length above 0, or leave --fit out.")
    elif name := _first_given(options, "fit", "tolerance", "start", "layer", "reverse", "damaged"):
        raise Unusable(f"--{name} goes with a drawing only: leave out --control.")
    if options.list and (name := _first_given(options, "chain", "start", "reverse", "output")):
        raise Unusable(f"--{name} takes contours and --list takes none: leave one of them out.")


def _first_given(options: argparse.Namespace, *names: str) -> str:
    """Return the first of these options that was typed, empty for none; 0 is a value."""
    for name in names:
        value = getattr(options, name)
        if value is not None and value is not False and value != []:
            return name
    return ""


def _remedy(error: DrawingError, options: argparse.Namespace) -> str:
    """Return the option that would get the drawing accepted; empty if none would."""
    if error.code == "NOT_FLAT":
        return " Delete it from the drawing, or name the layers to take with --layer."
    if error.code == "NOT_DXF":
        return " For an NC program add --control NAME."
    if error.code == "TOO_FAR" and error.readable:
        return " Or leave it out with --damaged."
    return " Take it all the same with --damaged." if error.readable and not options.damaged else ""


def _length(text: str) -> float:
    """Return the length that an option gives, in the unit of the drawing or the program."""
    try:
        length = float(text)
    except ValueError:
        length = nan
    if not (isfinite(length) and length >= 0.0):
        raise argparse.ArgumentTypeError(f"{text} is not a length of 0 or more")
    return length


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        "cutcomp import",
        description="Contours of a DXF drawing, or of an NC program (with --control), as a program; "
        "lengths are typed in the program's unit.",
    )
    parser.add_argument("file", type=Path, metavar="FILE", help="a drawing (DXF) or an NC program")
    parser.add_argument("--list", action="store_true", help="list the contours, take none")
    parser.add_argument(
        "--chain", metavar="N|all", help="the contours to take by their numbers in the list: 1,3 or all"
    )
    parser.add_argument("--layer", action="append", default=[], metavar="L", help="take this layer; may be repeated")
    units = tuple(unit.lower() for unit in DrawingUnit)
    parser.add_argument("--units", choices=units, type=str.lower, help="the unit of a drawing that names none")
    parser.add_argument(
        "--tolerance", type=_length, metavar="T", help="ends so near are joined; usually 0.0005 in, 0.01 mm"
    )
    parser.add_argument(
        "--fit", type=_length, metavar="T", help="fit arcs within T to runs of lines too; usually 0.0002 in, 0.005 mm"
    )
    parser.add_argument("--start", metavar="X,Y", help="start at the place nearest to this one")
    parser.add_argument("--reverse", action="store_true", help="travel the contour the other way")
    parser.add_argument("--damaged", action="store_true", help="take what can be read of a damaged file")
    parser.add_argument("--control", metavar="NAME[:VARIANT]", help="FILE is an NC program of this control")
    parser.add_argument("--side", choices=("left", "right", "on"), help="side of an NC program's center path")
    parser.add_argument("--diameter", type=_length, metavar="D", help="diameter of the tool, for such a program")
    add_tool_options(parser)
    parser.add_argument("-o", "--output", type=Path, metavar="OUT.toml", help="write the program here")
    return parser


def _import(options: argparse.Namespace) -> None:
    listed = Worker(list_drawing, drawing_bytes(options.file), options).result()
    if options.list or not listed.contours:
        _print_list(listed)
        if not options.list:
            raise Unusable("The drawing has no contour to take.")
        return
    wanted = _numbers(options.chain, len(listed.contours), "drawing", lambda: _print_list(listed))
    chosen = (contour for contour in listed.contours if contour.number in wanted)
    _write(options, listed, tuple(_changed(contour, options, listed.unit) for contour in chosen))


def _print_list(listed: ContourList) -> None:
    drawing = listed.drawing
    known = "" if drawing.unit is None else " ($INSUNITS)"
    print(f"{listed.options.unit}{known}, layers {', '.join(drawing.layers)}")
    print(*table(rows_of(listed.contours), listed.unit), sep="\n")
    print(*sentences(listed, listed.unit), sep="\n")


def _numbers(chain: str | None, count: int, source: str, show: Callable[[], None]) -> set[int]:
    """Return the numbers that --chain names; if it is missing but needed, show the list and raise Unusable."""
    if chain is None and count > 1:
        show()
        raise Unusable(f"The {source} has {count} chains: add --chain N, --chain 1,2 or --chain all.")
    if chain is None or chain.strip().lower() == "all":
        return set(range(1, count + 1))
    numbers = [part.strip() for part in chain.split(",")]
    wrong = next((part for part in numbers if not part.isdecimal() or not 1 <= int(part) <= count), None)
    if wrong is not None:
        raise Unusable(f"--chain {wrong}: the {source} has chains 1 to {count}.")
    return {int(part) for part in numbers}


def _changed(contour: Contour, options: argparse.Namespace, unit: Unit) -> Contour:
    """Return the contour changed as --fit, --start and --reverse say."""
    if options.fit:
        contour = fitted_contour(contour, to_mm(options.fit, unit))
    if options.start is not None:
        contour = started_at(contour, _point(options.start, unit))
    return reversed_contour(contour) if options.reverse else contour


def _point(text: str, unit: Unit) -> tuple[float, float]:
    parts = text.split(",")
    try:
        x, y = (to_mm(float(part), unit) for part in parts)
    except ValueError:
        x = y = nan
    if not (isfinite(x) and isfinite(y)):
        raise Unusable(f"--start {text}: type X,Y such as 10,2.5.")
    return x, y


def _write(options: argparse.Namespace, listed: ContourList, contours: tuple[Contour, ...]) -> None:
    unit = listed.unit
    program, imported = with_contours(empty_program(unit), contours)
    _write_program(options, program, comment(options.file.name, contours))
    for sentence in (*sentences(listed, unit), *frame_notes(listed, {contour.number for contour in contours})):
        say(sentence)
    for block, contour in zip(imported, contours, strict=True):
        turn = f", {contour.turn.name}" if contour.closed else ""
        segments = counted(len(block.block.segments), "segment")
        say(f"chain {contour.number}: {contour.kind}, {segments} from {place(contour.start, unit)}{turn}.")
        for note in block.notes:
            say(note)


def _write_program(options: argparse.Namespace, program: Program, remark: str) -> None:
    """Write the program, with a comment on its source after the first line."""
    first_line, _, remaining_lines = dumps(program).partition("\n")
    text = f"{first_line}\n{remark}\n{remaining_lines}"
    if options.output is None:
        sys.stdout.write(text)
        return
    if options.output.exists() and options.output.resolve() == options.file.resolve():
        raise Unusable(f"-o {options.output}: that is the file that is imported.")
    write_text(options.output, text)


def import_nc(options: argparse.Namespace) -> None:
    """Run `cutcomp import FILE.nc --control NAME`, which imports the contours of an NC program."""
    units = {"in": Unit.IN, "mm": Unit.MM}
    if options.units and options.units not in units:
        raise Unusable("--units: an NC program is in inches or in millimeters.")
    unit = units.get(options.units or "")
    # this loads every control; a drawing needs none
    from core.importing.nc import read_nc

    data, control = bytes_of(options.file), control_of(options.control)
    read = read_nc(data, control, tools_of(options), unit=unit, center=_center(options))
    rows = "\n".join(_nc_row(number, contour, read.unit) for number, contour in enumerate(read.contours, 1))
    if options.list:
        print(rows)
        return
    wanted = _numbers(options.chain, len(read.contours), "program", lambda: print(rows))
    contours = tuple(contour for number, contour in enumerate(read.contours, 1) if number in wanted)
    chosen = replace(read, contours=contours)
    program, imported = nc_blocks(replace(empty_program(read.unit), tools=(), blocks=()), chosen)
    _write_program(options, program, comment(options.file.name, ()))
    for number, block in zip(sorted(wanted), imported, strict=True):
        say(f"chain {number}: {counted(len(block.block.segments), 'segment')}.")
        for note in block.notes:
            say(note)
    for note in chosen.notes:
        say(note)


def _center(options: argparse.Namespace) -> CenterPathTool | None:
    """Return the tool that --side and --diameter give for a center path; None without --side."""
    if options.side is None:
        return None
    if options.side != "on" and not options.diameter:
        raise Unusable("--side: add --diameter, the tool's in the program's unit.")
    side = {"left": Side.LEFT, "right": Side.RIGHT, "on": None}[options.side]
    return CenterPathTool(side, options.diameter or 0.0)


def _nc_row(number: int, contour: NcContour, unit: Unit) -> str:
    """Return a contour of an NC program as a line of the list."""
    first, last = contour.cuts[0].line, contour.cuts[-1].line
    kind = "closed" if contour.closed else "open"
    tool = "" if contour.tool is None else f"  tool {contour.tool}"
    cut = length(sum(piece.length for piece in contour.pieces), unit)
    side = "ON" if contour.side is None else contour.side.value
    passes = f"  {len(contour.depths)} passes" if len(contour.depths) > 1 else ""
    return f"{number:>4}  {side:<5}  {kind:<6}  {len(contour.cuts):>5}  {cut:>10}  lines {first}-{last}{tool}{passes}"
