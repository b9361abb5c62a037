"""Mutants of DXF files: a byte changed, deleted or inserted, lines lost or doubled, the rest cut off."""

from __future__ import annotations

import io
import random
from dataclasses import dataclass
from time import process_time

import ezdxf.filemanagement
from ezdxf._options import options
from ezdxf.math import BSpline

from core.importing.contours import ImportOptions, contours_of
from core.importing.drawing import Drawing, DrawingError, DrawingUnit
from core.importing.dxf import read_dxf
from core.importing.dxf_document import BINARY_MARK
from tests.core.importing.drawings import block, circle, drawing_file, dxf, square

TIME_LIMIT = 60.0


def full_document() -> ezdxf.document.Drawing:
    """A drawing of R2000 with what later versions have: LWPOLYLINE, ELLIPSE, SPLINE, INSERT, a hidden layer."""
    # the same bytes in every run
    options.write_fixed_meta_data_for_testing = True
    document = ezdxf.filemanagement.new("R2000", units=4)
    document.layers.add("OFF").off()
    space = document.modelspace()
    space.add_lwpolyline([(0, 0, 0.2), (40, 0, 0), (40, 30, -0.3), (0, 30, 0)], format="xyb", close=True)
    space.add_ellipse((100, 0), (20, 5), 0.4)
    space.add_spline().apply_construction_tool(BSpline([(0, 50), (10, 70), (30, 40), (50, 60)]))
    space.add_circle((5, 5), 2, dxfattribs={"layer": "OFF"})
    space.add_arc((80, 50), 10, 20, 200)
    part = document.blocks.new("PART")
    part.add_lwpolyline([(0, 0), (5, 0), (5, 5)], close=True)
    part.add_line((0, 0), (1, 1))
    space.add_blockref("PART", (200, 0), dxfattribs={"xscale": 2.0, "yscale": 1.0, "rotation": 30.0})
    space.add_text("PART 1")
    return document


def text_of(document: ezdxf.document.Drawing) -> bytes:
    stream = io.StringIO()
    document.write(stream)
    return stream.getvalue().encode()


def binary_of(document: ezdxf.document.Drawing) -> bytes:
    stream = io.BytesIO()
    document.write(stream, fmt="bin")
    return stream.getvalue()


def originals() -> dict[str, bytes]:
    """Six files: of R12, of R2000, with a block, with layers, and a binary one."""
    insert = [(0, "INSERT"), (8, "0"), (2, "B"), (10, 50), (20, 0), (30, 0), (50, 45)]
    document = full_document()
    return {
        "bulges": drawing_file("d10-bulge.dxf"),
        "layers": drawing_file("d14-layers.dxf"),
        "mirrored": drawing_file("d12-mirrored-arc.dxf"),
        "block": dxf(*square(0, 0, 10), insert, circle((5, 5), 2), more=block("B", *square(0, 0, 5))),
        "r2000": text_of(document),
        "binary": binary_of(document),
    }


def mutant(data: bytes, chance: random.Random) -> bytes:
    """The data with one to three faults."""
    for _ in range(chance.choice((1, 1, 1, 2, 3))):
        at = chance.randrange(len(data))
        # lines are those of a text: a piece of a binary file may be a whole entity, which nobody can miss
        kind = chance.choice((0, 5, 6, 7, 9) if data.startswith(BINARY_MARK) else range(10))
        if kind < 5:
            data = data[:at] + bytes([chance.randrange(256)]) + data[at + 1 :]
        elif kind < 6:
            data = data[:at] + chance.choice(b"0123456789-.eE\n ").to_bytes(1, "little") + data[at + 1 :]
        elif kind < 7:
            data = data[:at] + data[at + 1 :]
        elif kind < 8:
            data = data[:at] + bytes([chance.randrange(256)]) + data[at:]
        elif kind < 9:
            lines = data.split(b"\n")
            row = chance.randrange(len(lines))
            data = b"\n".join([*lines[:row], *lines[row + chance.choice((1, 2)) :]])
        else:
            data = data[: max(at, 1)]
        if not data:
            return b"0"
    return data


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of a file: the code of its refusal or nothing, its entities, and everything that was said."""

    code: str
    entities: int = 0
    said: tuple[str, ...] = ()
    seconds: float = 0.0


def outcome(data: bytes, *, damaged: bool = False) -> Outcome:
    """A file read and made into contours; any exception but DrawingError is a defect and is not caught."""
    begin = process_time()
    try:
        drawing = read_dxf(data, "mutant.dxf", damaged=damaged)
        contours_of(drawing, ImportOptions.usual(drawing.unit or DrawingUnit.MM))
    except DrawingError as error:
        return Outcome(error.code, seconds=process_time() - begin)
    return Outcome("", drawing.entities, _said(drawing), process_time() - begin)


def _said(drawing: Drawing) -> tuple[str, ...]:
    counts = (f"{kind} {count}" for kind, count in (*drawing.skipped.items(), *drawing.hidden.items()))
    return (*counts, *(bad.text for bad in drawing.not_flat), *drawing.notes)


def lost_in_silence(original: Outcome, changed: Outcome) -> bool:
    """Whether a file is taken with fewer entities than the original, and not a word more."""
    return not changed.code and changed.entities < original.entities and changed.said == original.said
