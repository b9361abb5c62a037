"""DXF import: the table of sample drawings, entities, units, layers, OCS, INSERTs and refusals."""

from __future__ import annotations

import io
import math
import re
from dataclasses import replace

import pytest
from ezdxf.filemanagement import new as ezdxf_new
from ezdxf.xclip import XClip

from core.geometry.piece import Line
from core.importing.contour import fit_sentence, fitted_contour
from core.importing.contours import ContourList, ImportOptions, contours_of
from core.importing.drawing import Drawing, DrawingError, DrawingUnit
from core.importing.dxf import read_dxf
from core.importing.listing import sentences, unit_question
from core.importing.segments import DoesNotFitError, block_of, comment
from core.program.model import Program
from core.tolerance import JOINED
from core.units import Unit
from tests.core.importing.drawings import (
    MADE,
    arc,
    binary,
    block,
    circle,
    drawing_file,
    dxf,
    ellipse,
    line,
    listed,
    polyline,
    square,
)

ACCEPTED = [case for case in MADE if "refused" not in case]


def read(data: bytes, *, damaged: bool = False) -> Drawing:
    return read_dxf(data, "test.dxf", damaged=damaged)


@pytest.mark.parametrize("case", ACCEPTED, ids=lambda case: case["file"])
def test_a_sample_drawing_has_the_contours_in_the_table(case: dict[str, float]) -> None:
    listed_contours = listed(drawing_file(str(case["file"])))
    closed = [contour for contour in listed_contours.contours if contour.closed]
    assert (len(closed), len(listed_contours.contours) - len(closed)) == (case["closed"], case["open"])
    first = listed_contours.contours[0]
    assert first.drawn == case.get("segments", first.drawn)
    assert sum(contour.length for contour in closed) == pytest.approx(
        case.get("length", sum(contour.length for contour in closed)), abs=1e-6
    )
    assert first.area == pytest.approx(case.get("area", first.area), abs=1e-6)
    counts = (
        listed_contours.cleaned.tiny,
        listed_contours.cleaned.duplicates,
        listed_contours.cleaned.overlaps,
        len(listed_contours.branches),
    )
    assert counts == tuple(case.get(name, 0) for name in ("tiny", "duplicates", "overlaps", "branches"))


@pytest.mark.parametrize("case", [case for case in MADE if "refused" in case], ids=lambda case: case["file"])
def test_a_bad_sample_drawing_is_refused_with_its_code(case: dict[str, str]) -> None:
    with pytest.raises(DrawingError) as refused:
        read(drawing_file(case["file"]))
    assert refused.value.code == case["refused"]


@pytest.mark.parametrize(("unit", "text"), [(Unit.MM, "0.0000001"), (Unit.IN, "0.000000004")])
def test_a_tiny_gap_is_shown_with_enough_digits(unit: Unit, text: str) -> None:
    barely = replace(listed(drawing_file("d05-gap.dxf")), gap=1.1 * JOINED)
    assert f"largest gap {text}." in sentences(barely, unit)


def test_progress_is_reported_every_hundred_entities() -> None:
    calls: list[tuple[str, int, int]] = []
    read_dxf(dxf(*(line((k, 0), (k, 5)) for k in range(250))), "test.dxf", progress=lambda *call: calls.append(call))
    assert calls == [("reading", 0, 1), ("reading", 0, 250), ("reading", 100, 250), ("reading", 200, 250)]


def test_a_gap_within_the_tolerance_is_closed_and_reported() -> None:
    assert listed(drawing_file("d05-gap.dxf")).gap == pytest.approx(0.008)
    still_open = listed(drawing_file("d06-gap-open.dxf")).contours[0]
    assert still_open.open_gap == pytest.approx(0.05)
    assert still_open.problems == ("gap 0.050 to its other end: TOLERANCE 0.050 would join it",)
    assert listed(drawing_file("d06-gap-open.dxf"), tolerance=0.1).contours[0].closed


def test_a_file_that_breaks_off_is_refused_with_its_last_line() -> None:
    data = drawing_file("d19-cut-off.dxf")
    with pytest.raises(DrawingError) as refused:
        read(data)
    assert refused.value.text == "This file breaks off at line 40: 1 entity could be read."
    assert refused.value.readable == 1
    taken = read(data, damaged=True)
    assert len(taken.shapes) == 1
    assert taken.notes == ("The file breaks off at line 40: what comes after it is missing.",)


def test_refusals_name_the_reason() -> None:
    for name, text in (
        ("d20-not-dxf.dxf", "test.dxf is not a DXF file."),
        (
            "d17-empty.dxf",
            "There is no line, arc, circle, polyline, ellipse or spline in model space: 1 TEXT was skipped.",
        ),
    ):
        with pytest.raises(DrawingError) as refused:
            read(drawing_file(name))
        assert refused.value.text == text


@pytest.mark.parametrize(
    "coordinates",
    [
        ((20, 1), (10, 2), (30, 0), (21, 5), (11, 6), (31, 0)),
        ((10, 2), (11, 6), (20, 1), (21, 5)),
    ],
)
def test_coordinates_in_an_unusual_order_are_read(coordinates: tuple[tuple[int, object], ...]) -> None:
    drawing = read(dxf([(0, "LINE"), (8, "0"), *coordinates]))
    assert [drawn.shape for drawn in drawing.shapes] == [Line((2.0, 1.0), (6.0, 5.0))]
    assert drawing.notes == ()


def test_a_drawing_without_contours_says_what_it_has() -> None:
    text, hidden = [(0, "TEXT"), (8, "0"), (10, 0), (20, 0), (40, 1), (1, "A")], [*line((0, 0), (7, 5)), (60, 1)]
    for entities, words in (
        ([], "in model space."),
        ([text, text], "in model space: 2 TEXT were skipped."),
        ([hidden], "in model space: 1 entity is frozen, off or invisible."),
        ([text, hidden, hidden], "in model space: 1 TEXT was skipped; 2 entities are frozen, off or invisible."),
    ):
        with pytest.raises(DrawingError) as refused:
            read(dxf(*entities))
        assert refused.value.code == "NO_GEOMETRY"
        assert refused.value.text.endswith(words)


def test_the_circle_of_3000_lines_becomes_one_arc() -> None:
    contour = fitted_contour(listed(drawing_file("d18-3000.dxf")).contours[0], 0.005)
    assert fit_sentence(contour, Unit.IN) == "3000 lines -> 1 ARC, off by 0.0000"
    assert contour.circle == pytest.approx(50.0, abs=1e-4)


@pytest.mark.parametrize(
    ("code", "unit"), [(1, "IN"), (2, "FT"), (4, "MM"), (5, "CM"), (6, "M"), (0, None), (9, None), (None, None)]
)
def test_insunits_gives_the_unit_or_none(code: int | None, unit: str | None) -> None:
    drawing = read(dxf(*square(0, 0, 1), units=code))
    assert drawing.unit == (None if unit is None else DrawingUnit[unit])


def test_the_unit_question_shows_the_size_in_both_units() -> None:
    text = unit_question(read(drawing_file("d04-nounits.dxf")))
    assert text == "The drawing names no unit. 40 x 30: as IN 40.0000 x 30.0000, as MM 40.000 x 30.000"


def test_the_unit_question_measures_curves() -> None:
    """An ellipse of half axes 5 and 2.5, and its part from 90 to 180 degrees."""
    whole = ellipse((1, 2), (5, 0), 0.5)
    part = [*whole[:-2], (41, math.pi / 2), (42, math.pi)]
    for entity, size in ((whole, "10.0000 x 5.0000, as MM 10.000 x 5.000"), (part, "5.0000 x 2.5000")):
        assert f": as IN {size}" in unit_question(read(dxf(line((1, 2), (1, 4)), entity, units=None)))


def test_entities_in_paper_space_or_invisible_are_counted() -> None:
    hidden, paper = [*line((0, 0), (7, 5)), (60, 1)], [*line((0, 0), (5, 5)), (67, 1)]
    drawing = read(dxf(line((0, 0), (5, 5)), paper, hidden, hidden))
    assert (drawing.entities, drawing.skipped, drawing.hidden) == (1, {"LINE in paper space": 1}, {"0": 2})
    shown = list(sentences(listed(dxf(line((0, 0), (5, 5)), paper, hidden, hidden)), Unit.MM))
    assert shown[:2] == ["skipped: 1 LINE in paper space.", "frozen, off or invisible, not taken: 2 on 0."]


def test_the_comment_names_the_file_and_its_layers_once() -> None:
    contours = [replace(contour, layers=("CUT", "HOLES\n")) for contour in listed(dxf(*square(0, 0, 9))).contours]
    assert comment("a.dxf", [*contours, *contours]) == "# from a.dxf, layers CUT, HOLES?"
    assert comment("a.dxf", [replace(contours[0], layers=("CUT",))]) == "# from a.dxf, layer CUT"
    assert comment("a.dxf", []) == "# from a.dxf"


UNITS = {1: "IN", 2: "FT", 4: "MM", 5: "CM", 6: "M"}
OTHER = {3: "miles", 7: "kilometers", 8: "microinches", 9: "mils", 10: "yards", 11: "angstroms", 12: "nanometers"}
OTHER |= {13: "microns", 14: "decimeters", 15: "decameters", 16: "hectometers", 17: "gigameters"}
OTHER |= {18: "astronomical units", 19: "light years", 20: "parsecs", 21: "US survey feet", 22: "unknown"}


@pytest.mark.parametrize("code", range(1, 23))
def test_the_unit_of_a_drawing_is_read_or_named(code: int) -> None:
    """The codes of $INSUNITS in Autodesk's DXF reference."""
    drawing = read(dxf(*square(0, 0, 40), units=code))
    assert drawing.unit == UNITS.get(code)
    if code in OTHER:
        text = f"The drawing has a unit that is not read ({OTHER[code]}, $INSUNITS {code}). 40 x 40: "
        assert unit_question(drawing).startswith(text)


def test_a_drawing_in_feet_is_converted_to_millimeters() -> None:
    assert listed(dxf(*square(0, 0, 1), units=2)).contours[0].length == pytest.approx(4 * 304.8)


def test_a_mirrored_arc_is_mirrored() -> None:
    contour = listed(drawing_file("d12-mirrored-arc.dxf")).contours[0]
    ends = {tuple(round(value, 6) + 0.0 for value in piece.start) for piece in contour.pieces}
    assert (40.0, 10.0) in ends
    assert (50.0, 20.0) in ends


def test_a_tilted_extrusion_is_refused_with_its_line() -> None:
    tilted = [*circle((0, 0), 5), (210, 0.0), (220, 1.0), (230, 0.0)]
    drawing = read(dxf(tilted, *square(0, 0, 1, "B")))
    assert drawing.not_flat[0].text == "The CIRCLE at line 19 does not lie in the XY plane."
    options = ImportOptions.usual(DrawingUnit.MM)
    with pytest.raises(DrawingError, match="does not lie in the XY plane"):
        contours_of(drawing, options)
    only_b = ImportOptions(options.unit, options.tolerance, options.fit, frozenset({"B"}))
    assert len(contours_of(drawing, only_b).contours) == 1


def test_a_sloped_line_is_refused_and_different_heights_are_reported() -> None:
    slope = [(0, "LINE"), (8, "0"), (10, 0), (20, 0), (30, 0), (11, 1), (21, 0), (31, 1)]
    assert len(read(dxf(slope)).not_flat) == 1
    drawing = read(dxf(line((0, 0), (1, 0)), line((1, 0), (1, 1), z=5.0)))
    assert drawing.notes == ("The entities lie at heights from Z 0 to 5: Z is dropped.",)
    symmetric = read(dxf(line((0, 0), (1, 0), z=-2.0), line((1, 0), (1, 1), z=2.0)))
    assert symmetric.notes == ("The entities lie at heights from Z -2 to 2: Z is dropped.",)


def polyline_3d(*points: tuple[float, float, float], flags: int) -> list[tuple[int, object]]:
    vertices = [tag for x, y, z in points for tag in ((0, "VERTEX"), (8, "0"), (10, x), (20, y), (30, z), (70, 32))]
    return [(0, "POLYLINE"), (8, "0"), (66, 1), (70, flags), (10, 0), (20, 0), (30, 0), *vertices, (0, "SEQEND")]


def test_a_three_dimensional_polyline_is_read_only_if_it_is_flat() -> None:
    corners = ((0.0, 0.0), (4.0, 0.0), (4.0, 3.0))
    flat = read(dxf(polyline_3d(*((x, y, 5.0) for x, y in corners), flags=9)))
    assert (flat.not_flat, len(flat.shapes)) == ((), 3)
    assert len(read(dxf(polyline_3d(*((x, y, 5.0) for x, y in corners), flags=8))).shapes) == 2
    sloping = read(dxf(polyline_3d(*((x, y, x) for x, y in corners), flags=9)))
    assert "does not lie in the XY plane" in sloping.not_flat[0].text
    mesh = polyline_3d(*((x, y, 5.0) for x, y in corners), flags=16)
    assert "is a mesh" in read(dxf(mesh)).not_flat[0].text


def insert(name: str, at: tuple[float, float], *more: tuple[int, object]) -> list[tuple[int, object]]:
    return [(0, "INSERT"), (8, "PARTS"), (2, name), (10, at[0]), (20, at[1]), (30, 0), *more]


def test_an_insert_transforms_its_block_onto_the_layer_of_the_insert() -> None:
    data = dxf(insert("B", (100, 0), (41, 2.0), (42, 2.0), (50, 90.0)), more=block("B", *square(0, 0, 10)))
    contour = listed(data).contours[0]
    assert contour.layer == "PARTS"
    assert contour.area == pytest.approx(400.0)
    assert min(piece.start[0] for piece in contour.pieces) == pytest.approx(80.0)


def test_an_insert_that_mirrors_and_stretches_a_circle_makes_an_ellipse() -> None:
    data = dxf(insert("B", (0, 0), (41, -2.0), (42, 1.0)), more=block("B", circle((10, 0), 5)))
    contour = listed(data).contours[0]
    assert contour.closed
    assert contour.area == pytest.approx(math.pi * 10 * 5, abs=0.3)
    assert contour.size == pytest.approx((20.0, 10.0), abs=0.01)


def test_an_arc_drawn_twice_is_dropped_where_an_insert_stretches_it() -> None:
    mirrored = [*arc((-20, 0), 5, 70, 160), (210, 0.0), (220, 0.0), (230, -1.0)]
    arcs = block("B", arc((20, 0), 5, 20, 110), mirrored)
    drawing = listed(dxf(insert("B", (0, 0), (41, 2.0), (42, 3.4)), more=arcs))
    assert len(drawing.contours) == 1


def test_texts_of_inserts_are_counted() -> None:
    text = [
        (0, "ATTRIB"),
        (8, "0"),
        (10, 0),
        (20, 0),
        (30, 0),
        (40, 5),
        (1, "M6"),
        (2, "SIZE"),
        (0, "SEQEND"),
        (8, "0"),
    ]
    with_text = [*insert("B", (0, 0), (66, 1)), *text]
    drawing = read(dxf(with_text, insert("B", (20, 0)), more=block("B", *square(0, 0, 10))))
    assert drawing.skipped == {"ATTRIB": 1}


def test_every_copy_of_an_insert_array_is_read() -> None:
    data = dxf(insert("B", (0, 0), (70, 3), (71, 2), (44, 20.0), (45, 20.0)), more=block("B", *square(0, 0, 10)))
    assert len(listed(data).contours) == 6


def test_more_than_a_million_inserted_lines_are_refused_with_the_limit() -> None:
    data = dxf(insert("B", (0, 0), (70, 3000), (71, 3000), (44, 20.0), (45, 20.0)), more=block("B", *square(0, 0, 10)))
    with pytest.raises(DrawingError, match="36,000,000 lines and curves: at most 1,000,000"):
        read(data)


def test_blocks_that_contain_themselves_are_refused() -> None:
    data = dxf(insert("B", (0, 0)), more=block("B", insert("B", (0, 0))))
    with pytest.raises(DrawingError, match="deeper than 8"):
        read(data)


def test_an_insert_of_a_missing_block_is_reported() -> None:
    drawing = read(dxf(insert("GONE", (0, 0)), *square(0, 0, 1)))
    assert drawing.skipped == {"INSERT": 1}
    assert "'GONE', which the file does not have" in drawing.notes[0]


@pytest.mark.parametrize("flags", [4, 8, 12, 36])
def test_an_insert_of_another_drawing_names_its_file(flags: int) -> None:
    empty = block("XR").replace("\n70\n0\n", f"\n70\n{flags}\n1\nparts/frame.dwg\n")
    notes = read(dxf(insert("XR", (0, 0)), *square(0, 0, 1), more=empty)).notes
    assert notes == ("INSERT of the block 'XR', whose geometry is in another file (XREF): 'parts/frame.dwg'.",)
    notes = read(dxf(insert("E", (0, 0)), *square(0, 0, 1), more=block("E"))).notes
    assert notes == ("INSERT of the block 'E', which holds nothing.",)


def test_skipped_entities_are_counted_by_kind() -> None:
    text = [(0, "TEXT"), (8, "0"), (10, 0), (20, 0), (30, 0), (40, 5), (1, "PART")]
    point = [(0, "POINT"), (8, "0"), (10, 0), (20, 0), (30, 0)]
    drawing = read(dxf(text, text, point, *square(0, 0, 1), [(0, "STRANGE"), (8, "0")]))
    assert drawing.skipped == {"TEXT": 2, "POINT": 1, "STRANGE": 1}


def test_entities_of_a_second_section_are_damage_and_never_lost_in_silence() -> None:
    second = dxf(*square(0, 0, 10)).decode().split("EOF")[0].rpartition("0\n")[0]
    data = second.encode() + dxf(line((0, 0), (-9, -9)), units=None)
    with pytest.raises(DrawingError, match="4 LINE could not be read"):
        read(data)
    assert "4 LINE could not be read." in read(data, damaged=True).notes


def test_a_clipped_insert_is_reported() -> None:
    document = ezdxf_new()
    document.blocks.new("B").add_line((0, 0), (10, 0))
    clip = XClip(document.modelspace().add_blockref("B", (0, 0)))
    clip.set_block_clipping_path([(0, 0), (5, 5)])
    text = io.StringIO()
    document.write(text)
    assert read(text.getvalue().encode()).notes == ("An INSERT is clipped (XCLIP): all of its block is taken.",)


def test_a_file_over_64_megabytes_is_refused_unread() -> None:
    with pytest.raises(DrawingError, match=r"64,000,001 bytes: at most 64,000,000"):
        read(b"x" * 64_000_001)


def test_entities_on_frozen_and_off_layers_are_counted() -> None:
    layer = [(0, "LAYER"), (2, "F"), (70, 1), (62, 7), (6, "CONTINUOUS"), (0, "LAYER"), (2, "O"), (70, 0), (62, -7)]
    table = [(0, "SECTION"), (2, "TABLES"), (0, "TABLE"), (2, "LAYER"), (70, 2), *layer, (6, "CONTINUOUS")]
    more = "".join(f"{code}\n{value}\n" for code, value in [*table, (0, "ENDTAB"), (0, "ENDSEC")])
    drawing = read(dxf(*square(0, 0, 1), *square(2, 0, 1, "F"), line((0, 5), (1, 5), "O"), more=more))
    assert drawing.hidden == {"F": 4, "O": 1}
    assert drawing.layers == ("0",)


def test_two_merged_entities_are_damage_and_never_one_entity() -> None:
    data = dxf(*square(0, 0, 10)).replace(b"0\nLINE\n8\n0\n10\n10\n20\n0\n", b"1\nLINE\n8\n0\n10\n10\n20\n0\n")
    with pytest.raises(DrawingError) as refused:
        read(data)
    assert refused.value.code == "DXF_DAMAGED"
    assert "The LINE at line 19 has group code 10 2 times" in refused.value.text


def test_an_invalid_number_is_damage() -> None:
    for wrong in (b"nan", b"1e400", b"x"):
        with pytest.raises(DrawingError) as refused:
            read(dxf(circle((0, 0), 5)).replace(b"40\n5\n", b"40\n" + wrong + b"\n"))
        assert refused.value.code == "DXF_DAMAGED"


def test_a_coordinate_that_is_too_far_away_is_named_with_the_limit() -> None:
    data = dxf(line((0, 0), (5, -2e7)), *square(0, 0, 10))
    with pytest.raises(DrawingError) as refused:
        read(data)
    assert (refused.value.code, refused.value.readable) == ("TOO_FAR", 4)
    number = r"The LINE at line \d+ has -20,000,000, larger than 10,000,000"
    limit = "the largest coordinate that can be read. Move or scale it in the drawing."
    assert re.fullmatch(f"{number}, {limit}", refused.value.text)
    taken = read_dxf(data, "test.dxf", damaged=True)
    assert taken.entities == 4
    assert re.fullmatch(f"{number}: it is left out.", taken.notes[-1])
    with pytest.raises(DrawingError, match="has 1e\\+30, larger than 10,000,000"):
        read(dxf(circle((0, 0), 1e30)))
    assert read(dxf(line((0, 0), (1e7, 0)))).entities == 1


def test_a_circle_with_zero_radius_is_skipped_and_reported() -> None:
    drawing = read(dxf(circle((0, 0), 0), *square(0, 0, 1)))
    assert drawing.notes == ("A CIRCLE has the radius 0 and is skipped.",)


def test_an_ellipse_of_ratio_one_is_an_arc() -> None:
    ellipse = [(0, "ELLIPSE"), (8, "0"), (10, 0), (20, 0), (30, 0), (11, 5), (21, 0), (31, 0), (40, 1.0)]
    whole = listed(dxf([*ellipse, (41, 0.0), (42, 2 * math.pi)]))
    assert whole.contours[0].circle == pytest.approx(5.0)
    half = listed(dxf([*ellipse, (41, 0.0), (42, math.pi)])).contours[0]
    assert half.drawn == 1
    assert half.length == pytest.approx(5 * math.pi)


def test_an_arc_of_a_full_turn_is_a_circle() -> None:
    assert listed(dxf(arc((1, 2), 3, 0, 360))).contours[0].circle == pytest.approx(3.0)


@pytest.mark.parametrize("end", [6.28319, 6.28318, 6.2832, 6.2831])
def test_an_ellipse_with_a_rounded_end_is_whole(end: float) -> None:
    head = [(0, "ELLIPSE"), (8, "0"), (10, 0), (20, 0), (30, 0), (11, 20), (21, 0), (31, 0), (40, 0.5)]
    (contour,) = listed(dxf([*head, (41, 0.0), (42, end)])).contours
    assert contour.closed
    assert contour.area == pytest.approx(math.pi * 20 * 10, rel=1e-3)


@pytest.mark.parametrize(
    ("begin", "end", "sweep"),
    [(0, 360.0001, 360), (0, 359.999, 360), (30, 390.002, 360), (10, 10.001, 0.001), (359.9995, 0.0005, 0.001)],
)
def test_an_arc_has_the_sweep_of_its_angles(begin: float, end: float, sweep: float) -> None:
    (contour,) = listed(dxf(arc((0, 0), 1000, begin, end))).contours
    assert (contour.circle is not None) is (sweep == 360)
    assert contour.length == pytest.approx(math.radians(sweep) * 1000)


def test_lines_that_overlap_at_an_angle_are_joined() -> None:
    corner, within, beyond, top, left = (7, -3), (22, 17), (37, 37), (67, 77), (7, 77)
    whole = listed(dxf(line(corner, beyond), line(within, top), line(top, left), line(left, corner)))
    (contour,) = whole.contours
    assert (whole.cleaned.overlaps, contour.closed) == (1, True)
    assert contour.length == pytest.approx(100 + 60 + 80)


def every_sentence(contours: ContourList) -> list[str]:
    return list(sentences(contours, Unit.MM))


def test_cleanup_is_reported() -> None:
    assert every_sentence(listed(drawing_file("d07-duplicate.dxf"))) == [
        "2 equal pieces were dropped.",
        "largest gap none.",
    ]
    assert every_sentence(listed(drawing_file("d08-overlap.dxf"))) == [
        "1 overlapping piece was joined.",
        "largest gap none.",
    ]
    assert every_sentence(listed(drawing_file("d15-tiny.dxf"))) == [
        "1 piece shorter than TOLERANCE 0.010 was dropped.",
        "largest gap 0.001.",
    ]
    assert every_sentence(listed(dxf(circle((20, 30), 5), circle((20.004, 30), 5.003), circle((60, 30), 5)))) == [
        "1 equal piece was dropped, off by up to 0.007 at X 20.004 Y 30.000.",
        "largest gap none.",
    ]
    assert every_sentence(listed(dxf(*square(0, 0, 10), *square(10, 0, 10)))) == [
        "1 piece drawn twice was kept for two contours.",
        "largest gap none.",
    ]
    assert "branch at X 40.000 Y 30.000: 2 ways." in every_sentence(listed(drawing_file("d09-branch.dxf")))


def spline(*points: tuple[float, float], fit: bool = False, closed: bool = False) -> bytes:
    """An R2000 drawing with one LINE and one SPLINE of control points or fit points."""
    document = ezdxf_new("R2000", units=4)
    space = document.modelspace()
    if fit:
        space.add_spline(points).dxf.flags |= closed
    else:
        space.add_open_spline(points)
    space.add_line((0, 50), (10, 50))
    stream = io.StringIO()
    document.write(stream)
    return stream.getvalue().encode()


def test_a_spline_of_fit_points_is_interpolated_and_reported() -> None:
    data = spline((0, 0), (10, 5), (20, 0), (30, 5), fit=True)
    assert read(data).notes == ("A SPLINE has fit points only: the curve through them is calculated.",)
    curve = max(listed(data).contours, key=lambda contour: contour.length)
    ends = {tuple(round(value, 6) for value in point) for point in (curve.start, curve.pieces[-1].end)}
    assert ends == {(0.0, 0.0), (30.0, 5.0)}


def test_a_closed_spline_of_fit_points_is_skipped_and_reported() -> None:
    drawing = read(spline((0, 0), (10, 5), (20, 0), (10, -5), fit=True, closed=True))
    assert drawing.notes == ("A closed SPLINE with fit points only is skipped. Export it with control points.",)
    assert drawing.skipped == {"SPLINE": 1}


def test_a_spline_without_length_is_counted_as_too_short() -> None:
    made_list = listed(spline((5, 5), (5, 5), (5, 5), (5, 5)))
    assert (made_list.cleaned.tiny, len(made_list.contours)) == (1, 1)


def test_an_insert_stretches_a_spline() -> None:
    document = ezdxf_new("R2000", units=4)
    part = document.blocks.new("PART")
    part.add_open_spline([(0, 0), (10, 20), (30, -10), (40, 10)])
    document.modelspace().add_blockref("PART", (0, 0), dxfattribs={"xscale": 2.0, "yscale": 0.5})
    stream = io.StringIO()
    document.write(stream)
    stretched = listed(stream.getvalue().encode()).contours[0]
    direct = listed(spline((0, 0), (20, 10), (60, -5), (80, 5))).contours[0]
    assert stretched.length == pytest.approx(direct.length, abs=1e-6)


@pytest.mark.parametrize(("version", "encoding"), [("AC1015", "cp1252"), ("AC1027", "utf-8")])
def test_layer_names_are_decoded_with_the_encoding_of_the_version(version: str, encoding: str) -> None:
    """Versions up to 2004 use the code page of the header, later ones UTF-8."""
    text = dxf(line((0, 0), (5, 0), "Größe")).decode().replace("AC1009", f"{version}\n9\n$DWGCODEPAGE\n3\nANSI_1252")
    assert read_dxf(text.encode(encoding), "test.dxf").layers == ("Größe",)


def test_each_step_of_the_work_is_reported() -> None:
    drawing = read_dxf(dxf(*square(0, 0, 10)), "test.dxf")
    steps: list[str] = []
    contours_of(drawing, ImportOptions.usual(DrawingUnit.MM), lambda step, *_: steps.append(step))
    assert [step for step in steps if step != "fitting"] == ["cleaning", "chaining", "nesting"]


@pytest.mark.parametrize(("closed", "count"), [(0, 3), (1, 4)])
def test_a_closed_polyline_returns_to_its_first_vertex(closed: int, count: int) -> None:
    corners = [(0.0, 0.0), (10.0, 0.0), (10.0, 5.0), (0.0, 7.0)]
    vertices: list[tuple[int, object]] = []
    for x, y in corners:
        vertices += [(0, "VERTEX"), (8, "0"), (10, x), (20, y), (30, 0.0)]
    polyline = [(0, "POLYLINE"), (8, "0"), (66, 1), (70, closed), (10, 0), (20, 0), (30, 0), *vertices, (0, "SEQEND")]
    (contour,) = listed(dxf(polyline)).contours
    assert contour.closed == bool(closed)
    assert contour.drawn == count
    assert set(corners) <= {piece.start for piece in contour.pieces} | {piece.end for piece in contour.pieces}


FLAT_BULGES = [(bulge, 50.0) for bulge in (0.0, 1e-17, -1e-12, 1e-7, 1e-6, -1e-5, 4e-5, 1e-4, 0.01)]


@pytest.mark.parametrize(("bulge", "size"), [*FLAT_BULGES, (1e-9, 400.0), (-1e-5, 400.0), (0.01, 400.0)])
def test_a_bulge_is_a_line_or_an_arc_within_fit(bulge: float, size: float) -> None:
    corners = [(0.0, 0.0, bulge), (size, 0.0, 0.0), (size, 30.0, 0.0), (0.0, 30.0, 0.0)]
    vertices = [
        tag for x, y, turn in corners for tag in ((0, "VERTEX"), (8, "0"), (10, x), (20, y), (30, 0), (42, turn))
    ]
    polyline = [(0, "POLYLINE"), (8, "0"), (66, 1), (70, 1), (10, 0), (20, 0), (30, 0), *vertices, (0, "SEQEND")]
    (contour,) = listed(dxf(polyline)).contours
    for piece in contour.pieces:
        if max(piece.start[1], piece.end[1]) < size * 0.001:
            x, y = piece.point_at(0.5)
            assert y == pytest.approx(-2.0 * bulge * x * (size - x) / size, abs=0.005)
    assert block_of(contour, Program(unit=Unit.MM)).block.segments


def test_an_arc_with_a_center_out_of_range_is_named() -> None:
    vertices = [
        tag for x, turn in ((0, 1e-4), (400, 0)) for tag in ((0, "VERTEX"), (8, "0"), (10, x), (20, 0), (42, turn))
    ]
    (contour,) = listed(dxf([(0, "POLYLINE"), (8, "0"), (66, 1), (70, 0), *vertices, (0, "SEQEND")])).contours
    with pytest.raises(DoesNotFitError, match="Chain 1 has an arc of radius 1000000"):
        block_of(contour, Program(unit=Unit.MM))


VERSIONS = [None, "", "AC1006", "AC1009", "AC1012", "AC1015", "AC1032"]
"""No header, a header without a version, and the versions."""
MIRRORED: list[tuple[int, object]] = [(210, 0.0), (220, 0.0), (230, -1.0)]


def of_version(version: str | None, *tags: tuple[int, object]) -> bytes:
    """A drawing with one entity."""
    named = [(9, "$ACADVER"), (1, version)] if version else []
    head = [] if version is None else [(0, "SECTION"), (2, "HEADER"), *named, (9, "$INSUNITS"), (70, 4), (0, "ENDSEC")]
    every = [*head, (0, "SECTION"), (2, "ENTITIES"), *tags, (0, "ENDSEC"), (0, "EOF")]
    return "".join(f"{code}\n{value}\n" for code, value in every).encode()


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("marked", [(True, True), (True, False), (False, True), (False, False)])
@pytest.mark.parametrize("mirrored", [False, True])
def test_a_polyline_is_read_whole_in_every_version_with_or_without_markers(
    version: str | None, marked: tuple[bool, bool], mirrored: bool
) -> None:
    common, own = [(100, "AcDbEntity")] * marked[0], [(100, "AcDbPolyline")] * marked[1]
    corners = [(10, 0.0), (20, 0.0), (10, 50.0), (20, 0.0), (10, 50.0), (20, 30.0), (10, 0.0), (20, 30.0)]
    data_tags: list[tuple[int, object]] = [(90, 4), (70, 1), *corners, *(MIRRORED if mirrored else [])]
    tags = [(0, "LWPOLYLINE"), (5, "1A"), *common, (8, "CUT"), *own, *data_tags]
    data = of_version(version, *tags)
    (contour,) = listed(data).contours
    x_values = [piece.start[0] for piece in contour.pieces]
    assert contour.closed
    assert contour.length == pytest.approx(160.0)
    assert (min(x_values), max(x_values)) == ((-50.0, 0.0) if mirrored else (0.0, 50.0))
    assert read(data).layers == ("CUT",)


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("marked", [(True, True), (True, False), (False, True), (False, False)])
def test_a_spline_keeps_its_degree_with_or_without_markers(version: str | None, marked: tuple[bool, bool]) -> None:
    # a Bezier parabola: with a degree other than 2 its number of knots would be wrong
    knots = [(40, knot) for knot in (0, 0, 0, 1, 1, 1)]
    points = [tag for x, y in ((0, 0), (10, 20), (20, 0)) for tag in ((10, x), (20, y), (30, 0))]
    common, own = [(100, "AcDbEntity")] * marked[0], [(100, "AcDbSpline")] * marked[1]
    tags = [
        (0, "SPLINE"),
        (5, "1A"),
        *common,
        (8, "CUT"),
        *own,
        (210, 0),
        (220, 0),
        (230, 1),
        (70, 8),
        (71, 2),
        (72, 6),
        (73, 3),
        *knots,
        *points,
    ]
    (contour,) = listed(of_version(version, *tags)).contours
    assert contour.layer == "CUT"
    middle = min(contour.pieces, key=lambda piece: abs(piece.point_at(0.5)[0] - 10.0)).point_at(0.5)
    assert max(point[1] for piece in contour.pieces for point in (piece.start, piece.end, middle)) == pytest.approx(
        10.0, abs=0.05
    )


@pytest.mark.parametrize("version", ["AC1009", "AC1015"])
@pytest.mark.parametrize("end", [b"\x1a", b"\n\n\n", b"\n\n", b"no\ncode\n"])
def test_tags_after_eof_are_ignored(version: str, end: bytes) -> None:
    corners = [(10, 0.0), (20, 0.0), (10, 50.0), (20, 0.0), (10, 50.0), (20, 30.0)]
    data = of_version(version, (0, "LWPOLYLINE"), (8, "CUT"), (90, 3), (70, 1), *corners)
    (contour,) = listed(data + end).contours
    assert (contour.closed, contour.drawn) == (True, 3)


@pytest.mark.parametrize("version", VERSIONS)
def test_entities_with_the_handle_zero_are_read(version: str | None) -> None:
    sides = [[kind, (5, "0"), *more] for kind, *more in square(0, 0, 10)]
    drawing = read(of_version(version, *(tag for side in sides for tag in side)))
    assert drawing.entities == 4
    assert read(binary(version or "AC1009", *(tag for side in sides for tag in side))).entities == 4


@pytest.mark.parametrize("version", ["AC1009", "AC1015", "AC1032"])
def test_a_polyline_without_its_end_is_read(version: str) -> None:
    whole = polyline((0, 0), (10, 0), (10, 5), closed=False)
    tags = [*whole[:-1], *line((20, 0), (30, 0)), *whole[:-1]]
    for data in (of_version(version, *tags), binary(version, *tags)):
        drawing = listed(data)
        assert [contour.drawn for contour in drawing.contours] == [2, 1]
        assert (drawing.drawing.entities, drawing.cleaned.duplicates) == (3, 2)
    inserted = dxf(insert("B", (0, 0)), more=block("B", whole[:-1], line((20, 0), (30, 0))))
    assert [contour.drawn for contour in listed(inserted).contours] == [2, 1]


def test_a_vertex_of_no_polyline_is_damage() -> None:
    corners = [(0, 0), (10, 0), (10, 5), (0, 5)]
    tags = [(0, "VERTEK") if row == 17 else tag for row, tag in enumerate(polyline(*corners))]
    for data, where in ((dxf(tags), "at line 63"), (binary("AC1015", *tags), "that is entity 3")):
        with pytest.raises(DrawingError) as refused:
            read(data)
        assert refused.value.text == f"This file is damaged: The VERTEX {where} belongs to no POLYLINE."


@pytest.mark.parametrize("version", ["AC1009", "AC1015"])
def test_a_binary_polyline_is_read_whole_in_every_version(version: str) -> None:
    corners = [(10, 0.0), (20, 0.0), (10, 50.0), (20, 0.0), (10, 50.0), (20, 30.0)]
    tags = [(0, "LWPOLYLINE"), (5, "1A"), (8, "CUT"), (90, 3), (70, 1), *corners]
    (contour,) = listed(binary(version, *tags)).contours
    assert (contour.closed, contour.drawn, contour.layer) == (True, 3, "CUT")


CLAMPED = [0, 0, 0, 1, 2, 3, 3, 3]
PERIODIC = [0, 1, 2, 3, 4, 5, 6, 7, 8]


@pytest.mark.parametrize(
    ("points", "knots", "noted"),
    [
        ([(0, 0), (20, 0), (20, 20), (0, 20), (-9, 5)], CLAMPED, True),
        ([(0, 0), (20, 0), (20, 20), (0, 20), (0, 0)], CLAMPED, False),
        ([(0, 0), (20, 0), (20, 20), (0, 20), (0, 0), (20, 0)], PERIODIC, False),
    ],
)
def test_a_closed_spline_with_ends_apart_is_reported(
    points: list[tuple[float, float]], knots: list[int], noted: bool
) -> None:
    head = [(0, "SPLINE"), (5, "1A"), (100, "AcDbEntity"), (8, "0"), (100, "AcDbSpline"), (70, 11), (71, 2)]
    counts = [(72, len(knots)), (73, len(points))]
    places = [tag for x, y in points for tag in ((10, x), (20, y), (30, 0))]
    result = listed(of_version("AC1015", *head, *counts, *((40, knot) for knot in knots), *places))
    text = "The SPLINE at line 19 is marked closed, but its ends do not meet: it is read as open."
    assert result.notes == ((text,) if noted else ())
    assert [contour.closed for contour in result.contours] == [not noted]


def test_a_polyline_of_one_marker_alone_is_skipped() -> None:
    drawing = read(of_version("AC1015", *square(0, 0, 1)[0], (0, "LWPOLYLINE"), (5, "1A"), (100, "AcDbPolyline")))
    assert drawing.notes == ("A LWPOLYLINE has fewer than two points and is skipped.",)


def test_a_polyline_with_a_late_layer_is_refused() -> None:
    tags = [(0, "LWPOLYLINE"), (90, 2), (70, 0), (10, 0.0), (20, 0.0), (10, 5.0), (20, 0.0), (8, "CUT")]
    with pytest.raises(DrawingError) as refused:
        read(of_version("AC1015", *tags))
    assert refused.value.code == "DXF_DAMAGED"


@pytest.mark.parametrize(("width", "notes"), [(0.0, ()), (0.5, ("The width of polylines is ignored.",))])
@pytest.mark.parametrize("end", [0, 1])
def test_the_width_of_a_polyline_is_noted_once(width: float, notes: tuple[str, ...], end: int) -> None:
    corners = polyline((0, 0), (10, 0), (10, 5))
    corners.insert(corners.index((20, 5)) + 1, (40 + end, width))
    drawing = read(dxf(corners, corners))
    assert (drawing.notes, len(drawing.shapes)) == (notes, 6)
