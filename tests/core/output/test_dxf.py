"""DXF out: what of a scene is on which layer, in which unit, and with which numbers, as ezdxf reads it."""

from __future__ import annotations

import io
from math import inf

import pytest
from ezdxf.document import Drawing
from ezdxf.filemanagement import read

from core.draw.scene import Layer, Scene, Style
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Turn
from core.output.dxf import dxf
from core.units import Unit


def drawn(*layers: Layer, unit: Unit = Unit.MM) -> Drawing:
    """The scene's DXF text as a document without errors."""
    document = read(io.StringIO(dxf(Scene(layers), unit)))
    assert not document.audit().errors
    return document


def layer(style: Style, *pieces: Piece, dashed: bool = False) -> Layer:
    return Layer(Path.from_pieces(list(pieces)), style, dashed)


LINE = Line((0.0, 0.0), (25.4, -12.7))


def test_each_role_has_its_layer_and_color() -> None:
    styles = (Style.SURFACE, Style.PATH, Style.LEAD, Style.UNCUT, Style.DELETED, Style.RAPID, Style.GOUGE)
    document = drawn(*(layer(style, LINE) for style in styles))
    layers = [entity.dxf.layer for entity in document.modelspace()]
    assert layers == ["CONTOUR", "PATH", "LEADS", "UNCUT", "DELETED", "ROUGH"]
    colors = {each.dxf.name: each.dxf.color for each in document.layers}
    assert [colors[name] for name in layers] == [7, 4, 2, 1, 8, 9]


@pytest.mark.parametrize(("unit", "code", "end"), [(Unit.MM, 4, (25.4, -12.7, 0.0)), (Unit.IN, 1, (1.0, -0.5, 0.0))])
def test_numbers_are_in_program_units_which_the_header_names(unit: Unit, code: int, end: tuple[float, ...]) -> None:
    document = drawn(layer(Style.SURFACE, LINE), unit=unit)
    assert (document.header["$INSUNITS"], document.header["$MEASUREMENT"]) == (code, int(unit is Unit.MM))
    (entity,) = document.modelspace()
    assert (tuple(entity.dxf.start), tuple(entity.dxf.end)) == ((0.0, 0.0, 0.0), end)


@pytest.mark.parametrize(("turn", "angles"), [(Turn.CCW, (0.0, 90.0)), (Turn.CW, (90.0, 0.0))])
def test_an_arc_runs_counterclockwise_from_its_first_angle(turn: Turn, angles: tuple[float, float]) -> None:
    (entity,) = drawn(layer(Style.PATH, Arc((7.0, 3.0), (2.0, 8.0), (2.0, 3.0), turn))).modelspace()
    assert entity.dxftype() == "ARC"
    assert (tuple(entity.dxf.center), entity.dxf.radius) == ((2.0, 3.0, 0.0), 5.0)
    assert (entity.dxf.start_angle, entity.dxf.end_angle) == angles


def test_an_arc_that_ends_where_it_begins_is_a_circle() -> None:
    (entity,) = drawn(layer(Style.PATH, Arc((7.0, 3.0), (7.0, 3.0), (2.0, 3.0), Turn.CW))).modelspace()
    assert (entity.dxftype(), entity.dxf.radius) == ("CIRCLE", 5.0)


def test_segments_not_determined_and_what_is_not_finite_are_left_out() -> None:
    endless = Line((0.0, 0.0), (inf, 0.0))
    layers = [layer(Style.SURFACE, LINE, dashed=True), layer(Style.RAPID, LINE, dashed=True)]
    document = drawn(*layers, layer(Style.PATH, endless))
    assert [entity.dxf.layer for entity in document.modelspace()] == ["ROUGH"]


def test_numbers_have_six_decimals_and_up_to_ten_where_they_say_more() -> None:
    text = dxf(Scene((layer(Style.PATH, Line((-1e-12, 25.4), (0.25, 1.0 / 3.0))),)), Unit.MM)
    at = text.index("LINE\n8\nPATH\n") + len("LINE\n8\nPATH\n")
    assert text[at:].split()[1::2][:6] == ["0.000000", "25.400000", "0.0", "0.250000", "0.3333333333", "0.0"]
