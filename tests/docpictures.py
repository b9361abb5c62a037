"""The pictures of the pages beside core's rooms, drawn by the program itself: `python -m tests.docpictures`."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

from core.pipeline.derive import derive
from core.pipeline.plot import svg_of
from core.program.edit import new_block
from core.program.model import (
    CutterComp,
    LineSegment,
    Number,
    PathChoice,
    Program,
    ProgramParameters,
    Tool,
)

CORE: Final = Path(__file__).parent.parent / "core"

Corner = tuple[float, float]


@dataclass(frozen=True)
class Picture:
    """A contour from `start` with its tool in inches, a typed look-ahead or CAL, and the path that is posted.

    `room` is the room of core whose page shows it.
    """

    name: str
    title: str
    start: Corner
    to: tuple[Corner, ...]
    comp: CutterComp = CutterComp.LEFT
    diameter: float = 0.5
    lookahead: int | None = None
    path: PathChoice = PathChoice.CONTROL
    room: str = "comp"

    @property
    def file(self) -> Path:
        """Where it is kept."""
        return CORE / self.room / "pictures" / f"{self.name}.svg"


NOTCH: Final = ((2.0, 0.0), (2.0, -0.3), (2.3, -0.3), (2.3, 0.0), (5.0, 0.0))
SQUARE: Final = ((2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (0.0, 0.0))
OVER_RUN: Final = ((2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (0.0, -1.0))
CHAMFERED: Final = ((2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (0.0, 0.1), (0.1, 0.0))
BONE: Final = (
    (2.0, 0.0), (2.0, 0.8), (3.0, 0.8), (3.0, 0.0), (5.0, 0.0), (5.0, 2.0), (3.0, 2.0), (3.0, 1.2), (2.0, 1.2),
    (2.0, 2.0), (0.0, 2.0), (0.0, 0.0), (1.0, 0.0),
)  # fmt: skip

PICTURES: Final = (
    Picture("over-run", "The ends past the corner are leads", (-1, 0), OVER_RUN, comp=CutterComp.RIGHT, room="verify"),
    Picture("walk-1", "Look-ahead 1: nothing is deleted", (0.0, 0.0), NOTCH, lookahead=1),
    Picture("walk-3", "Look-ahead 3: the notch is passed over", (0.0, 0.0), NOTCH, lookahead=3),
    Picture("corner-start", "Started at an inside corner", (0.0, 0.0), SQUARE),
    Picture("mid-side-start", "Started mid-side", (1.0, 0.0), (*SQUARE, (1.0, 0.0))),
    Picture("long-way", "CAL 4 deletes the longer way around", (0.1, 0.0), CHAMFERED),
    Picture("bone-control", "CAL 8: the neck is too narrow", (1.0, 0.0), BONE),
    Picture("bone-best", "The best path: two loops", (1.0, 0.0), BONE, path=PathChoice.BEST),
    Picture(
        "dead-slices", "A notch passed on its corners", (0.0, 0.0), NOTCH, path=PathChoice.BEST, room="comp/best_path"
    ),
    Picture(
        "uncut", "Corners the cutter does not reach", (1.0, 0.0), (*SQUARE, (1.0, 0.0)), diameter=1.2, room="verify"
    ),
)


def program(picture: Picture) -> Program:
    """The picture's program, as typed, without blend moves."""
    tools = (Tool(1, diameter=Number(picture.diameter)),)
    block = replace(
        new_block(Program(tools=tools)),
        tool=Number(1),
        cutter_comp=picture.comp,
        x_start=Number(picture.start[0]),
        y_start=Number(picture.start[1]),
        z_bottom=Number(-0.25),
        plunge_feed=Number(20.0),
        speed=Number(300.0),
        lookahead=_lookahead(picture),
        segments=tuple(LineSegment(x_end=Number(x), y_end=Number(y)) for x, y in picture.to),
    )
    plain = ProgramParameters(blend_offset=Number(0), blend_overlap=Number(0), path=picture.path)
    return Program(tools=tools, blocks=(block,), parameters=plain)


def _lookahead(picture: Picture) -> Number | None:
    return None if picture.lookahead is None else Number(picture.lookahead)


def drawn() -> Iterator[tuple[Path, str]]:
    """Every picture's file and SVG text."""
    for picture in PICTURES:
        yield picture.file, svg_of(derive(program(picture)), title=picture.title)


def main() -> None:
    """Write every picture."""
    argparse.ArgumentParser("tests.docpictures", description=__doc__).parse_args()
    for file, text in drawn():
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        print(file.relative_to(CORE))


if __name__ == "__main__":
    main()
