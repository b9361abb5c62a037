import json
from dataclasses import replace
from itertools import pairwise

import pytest

from core.pipeline.command_output import (
    path_document,
    path_listing,
    table_document,
    table_listing,
    verdict_listing,
)
from core.pipeline.derive import derive, look_ahead_table
from core.pipeline.jobs import jobs
from core.pipeline.plot import block_scene, svg_of
from core.program.model import ArcSegment, CutterComp, Direction, LineSegment, Number, ProgramParameters, Relative
from core.units import Unit
from tests.core.pipeline.parts import MID_SIDE_SQUARE, NOTCH, OVER_RUN_SQUARE, block, program

BLENDS = ProgramParameters(blend_offset=Number(0.125), blend_overlap=Number(0.125))


def test_moves_join_in_program_units_and_name_their_part():
    derived = derive(program(block(MID_SIDE_SQUARE, CutterComp.LEFT), parameters=BLENDS))
    document = json.loads(json.dumps(path_document(derived), allow_nan=False))
    (only,) = document["blocks"]
    assert document["units"] == "IN"
    assert only["closed"] is True
    assert only["lookahead"] == {"value": 4, "tag": "CAL"}
    assert only["radius"] == pytest.approx(0.25)
    moves = only["moves"]
    for current, following in pairwise(moves):
        assert (current["x"], current["y"]) == (following["x0"], following["y0"])
    assert [move["part"] for move in moves] == ["blend-in", *["path"] * 5, "blend-out", "blend-out"]
    first = moves[0]
    assert (first["type"], first["ccw"]) == ("arc", True)
    assert (first["x0"], first["y0"]) == pytest.approx((0.875, 0.375))
    assert (first["cx"], first["cy"]) == pytest.approx((1.0, 0.375))
    assert (first["x"], first["y"]) == pytest.approx((1.0, 0.25))


def test_corner_arcs_have_half_numbers_and_deletions_have_causes():
    derived = derive(program(block(NOTCH, CutterComp.LEFT, lookahead=Number(3))))
    (only,) = path_document(derived)["blocks"]
    assert [move["segment"] for move in only["moves"]] == [1, 1.5, 4.5, 5]
    assert [(deletion["segment"], deletion["by"]) for deletion in only["deleted"]] == [
        (2, [1.5, 4.5]),
        (3, [1.5, 4.5]),
        (4, [1.5, 4.5]),
    ]
    assert (only["deleted"][0]["x"], only["deleted"][0]["y"]) == pytest.approx((2.15, 0.2))


def test_findings_have_a_value_and_a_sentence():
    derived = derive(program(block(NOTCH, CutterComp.LEFT)))
    gouge = path_document(derived)["blocks"][0]["findings"][0]
    assert (gouge["code"], gouge["severity"]) == ("GOUGE", "error")
    assert gouge["value"] == pytest.approx(0.25)
    assert "0.2500" in gouge["text"]


def test_the_document_contains_only_the_requested_block():
    part = program(block(NOTCH, CutterComp.LEFT), block(OVER_RUN_SQUARE, CutterComp.RIGHT))
    assert [listed["block"] for listed in path_document(derive(part), 2)["blocks"]] == [2]


def test_the_table_is_written_as_a_document_and_as_lines():
    part = program(block(NOTCH, CutterComp.LEFT))
    (derived_block,) = derive(part).blocks
    table = look_ahead_table(derived_block, part)
    document = table_document(derived_block, table, Unit.IN)
    assert document["recommended"] == 3
    assert document["values"][1]["clean"] is False
    assert document["values"][2] == {
        "value": 3,
        "clean": True,
        "gouge": 0.0,
        "uncut": pytest.approx(document["values"][2]["uncut"]),
        "deleted": [2, 3, 4],
    }
    lines = list(table_listing(derived_block, table, Unit.IN))
    assert len(lines) == 23
    assert lines[-1].strip() == "Recommended: 3"


def test_the_listing_names_every_move():
    derived = derive(program(block(NOTCH, CutterComp.LEFT, lookahead=Number(3))))
    lines = list(path_listing(derived))
    assert lines[0] == "BLOCK 1  CUTTER COMP. LEFT  open  LOOKAHEAD USR 3  IN"
    assert len(lines) == 1 + 4 + 3 + 3
    assert "about X       2.0000 Y       0.0000" in lines[2]
    assert lines[8] == "  NEAREST 0.2500  TOOL RADIUS 0.2500  at X 0.0000 Y 0.0000 on segment 1"
    assert lines[9] == "  UNCUT 0.9000 of 5.6000"
    assert lines[10] == "    0.9000 from X 2.0000 Y 0.0000 on segment 2 to X 2.3000 Y 0.0000 on segment 4"


def test_the_listing_of_a_gouge_shows_the_least_distance():
    (derived_block,) = derive(program(block(NOTCH, CutterComp.LEFT))).blocks
    nearest, *uncut = verdict_listing(derived_block, Unit.IN)
    assert nearest == "  NEAREST 0.0000  TOOL RADIUS 0.2500  at X 2.3000 Y -0.0500 on segment 4"
    assert uncut == ["  UNCUT 0.0000 of 5.6000"]


def test_the_document_has_the_least_distance_and_its_place():
    derived = derive(program(block(NOTCH, CutterComp.LEFT), block(NOTCH, CutterComp.ON)))
    gouging, on = path_document(derived)["blocks"]
    assert gouging["clearance"] == pytest.approx(0.0, abs=1e-9)
    assert gouging["clearance_at"] == {"segment": 4, "x": pytest.approx(2.3), "y": pytest.approx(-0.05)}
    assert (on["clearance"], on["clearance_at"]) == (None, None)


def test_a_job_has_the_values_to_post():
    (job,) = jobs(derive(program(block(MID_SIDE_SQUARE, CutterComp.LEFT), parameters=BLENDS)))
    assert (job.cutter.number, job.finisher) == (1, None)
    assert (job.lookahead, job.comp) == ("CAL 4", "LEFT")
    assert job.z_bottom == pytest.approx(-0.25 * 25.4)
    assert [floor.number for floor in job.floors] == [1, 2, 3, 4, 5]
    assert len(job.finish) == 1
    assert job.rough == ()


def test_a_block_that_is_not_determined_has_an_empty_drawing():
    part = program(block(NOTCH[:1], CutterComp.LEFT))
    (derived_block,) = derive(part).blocks
    assert block_scene(derived_block, 0, Unit.IN).layers == ()
    assert svg_of(derive(part), title="empty").startswith("<")


def test_the_posted_notes_list_deleted_and_uncut_segments():
    derived = derive(program(block(NOTCH, CutterComp.LEFT, lookahead=Number(3))))
    (noted,) = jobs(derived)
    assert noted.notes[0] == "DELETED BY THE LOOK-AHEAD: SEGMENTS 2, 3, 4"
    assert noted.notes[1].startswith("UNCUT 0.9")


def test_a_typed_value_that_the_piece_misses_is_given_as_calculated():
    block_of_two = block(((1.0, 0.0), (2.0, 0.0)), CutterComp.LEFT)
    slanted = LineSegment(x_end=Number(3.0), y_end=Number(1.0), angle=Number(45.0005))
    whole = program(replace(block_of_two, segments=(*block_of_two.segments, slanted)))
    values = path_document(derive(whole))["blocks"][0]["segments"][-1]
    assert values["angle"] == {"value": pytest.approx(45.0, abs=1e-9), "tag": None}
    assert values["x_end"] == {"value": 3.0, "tag": None}


def test_a_relative_center_is_given_as_an_absolute_position():
    arc = ArcSegment(
        Direction.CCW, x_end=Number(2.0), y_end=Number(2.0), x_center=Relative(0.0), y_center=Relative(1.0)
    )
    typed = block(((1.0, 0.0), (2.0, 0.0)), CutterComp.LEFT)
    values = path_document(derive(program(replace(typed, segments=(*typed.segments, arc)))))["blocks"][0]["segments"][
        -1
    ]
    assert (values["x_center"]["value"], values["y_center"]["value"]) == pytest.approx((2.0, 1.0))
    assert (values["radius"]["value"], values["sweep"]["value"]) == pytest.approx((1.0, 180.0))
