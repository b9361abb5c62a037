"""DXF out: what is drawn on which layer, and that reading it back gives the same contours."""

from __future__ import annotations

import io
from pathlib import Path

import pytest
from ezdxf.filemanagement import read as ezdxf_read

from core.geometry.piece import Arc, Piece
from core.importing.contour import reversed_contour, started_at
from core.importing.contours import ImportOptions, contours_of
from core.importing.drawing import Drawing
from core.importing.dxf import read_dxf
from core.pipeline.derive import derive
from core.pipeline.plot import dxf_of
from core.program.file.read import loads

EXAMPLES = sorted((Path(__file__).parents[3] / "app" / "examples").glob("*.toml"))


def drawn(example: Path) -> tuple[str, list[list[Piece]]]:
    """The DXF text of an example, and the pieces of each of its contours."""
    derived = derive(loads(example.read_text(), example.name))
    return dxf_of(derived), [[piece for _, piece in block.solved.pieces] for block in derived.blocks]


def read(text: str) -> Drawing:
    return read_dxf(text.encode(), "out.dxf")


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_dxf_out_and_in_gives_the_same_contours(example: Path) -> None:
    text, originals = drawn(example)
    drawing = read(text)
    assert drawing.unit is not None
    usual = ImportOptions.usual(drawing.unit)
    options = ImportOptions(drawing.unit, usual.tolerance, usual.fit, frozenset({"CONTOUR"}))
    contours = contours_of(drawing, options).contours
    assert len(contours) == len(originals)
    for pieces in originals:
        same = [contour for contour in contours if contour.drawn == len(pieces)]
        matched = [back for contour in same for back in _travels(contour, pieces)]
        assert min(_apart(pieces, back) for back in matched) <= 1e-6


def _travels(contour, pieces: list[Piece]) -> list[tuple[Piece, ...]]:
    """The contour from the original's start, in either direction."""
    either = (started_at(contour, pieces[0].start), started_at(reversed_contour(contour), pieces[0].start))
    return [each.pieces for each in either if len(each.pieces) == len(pieces)]


def _apart(first: list[Piece], second: tuple[Piece, ...]) -> float:
    """How far starts, middles and ends of pieces are apart; infinite where the kinds differ."""
    if any(isinstance(one, Arc) is not isinstance(other, Arc) for one, other in zip(first, second, strict=True)):
        return float("inf")
    return max(
        abs(complex(*one.point_at(share)) - complex(*other.point_at(share)))
        for one, other in zip(first, second, strict=True)
        for share in (0.0, 0.25, 0.5, 1.0)
    )


def test_each_role_has_its_layer_and_color() -> None:
    text, _ = drawn(next(path for path in EXAMPLES if path.stem == "pocket"))
    document = ezdxf_read(io.StringIO(text))
    assert not document.audit().errors
    colors = {layer.dxf.name: layer.dxf.color for layer in document.layers}
    assert {name: colors[name] for name in ("CONTOUR", "PATH", "LEADS", "UNCUT", "DELETED")} == {
        "CONTOUR": 7,
        "PATH": 4,
        "LEADS": 2,
        "UNCUT": 1,
        "DELETED": 8,
    }
    assert {entity.dxf.layer for entity in document.modelspace()} >= {"CONTOUR", "PATH", "LEADS"}
    assert {entity.dxftype() for entity in document.modelspace()} <= {"LINE", "ARC", "CIRCLE"}
