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
from core.pipeline.derive import derive, look_ahead_table, remedy_for_gouge
from core.pipeline.jobs import jobs
from core.pipeline.plot import block_scene, svg_of
from core.pipeline.unit_question import unit_question
from core.program.model import (
    ArcSegment,
    BlendSegment,
    CutterComp,
    Direction,
    LineSegment,
    Number,
    ProgramParameters,
    Relative,
    Tool,
    Unread,
)
from core.units import Unit, sentence
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


def test_a_table_of_a_block_without_compensation_says_so():
    part = program(block(NOTCH, CutterComp.ON))
    (on,) = derive(part).blocks
    assert list(table_listing(on, look_ahead_table(on, part), Unit.IN))[1:] == [
        "  There is no contour to compensate yet, or CUTTER COMP. is ON."
    ]


def test_a_table_without_a_clean_value_says_so_and_has_its_notes_last():
    part = program(block(HOOK, CutterComp.LEFT))
    (gouging,) = derive(part).blocks
    table = look_ahead_table(gouging, part)
    assert table is not None
    lines = list(table_listing(gouging, table, Unit.IN))
    assert lines[22] == "  No value is clean."
    assert lines[23:] == [f"  {sentence(note, Unit.IN)}" for note in table.notes]
    document = table_document(gouging, table, Unit.IN)
    assert document["recommended"] is None
    assert not any(value["clean"] for value in document["values"])


HOOK = ((1, 0), (2, 0), (2, 1), (0.9, 1), (0.9, 0.3), (0, 0.3), (0, 0), (1, 0))


def test_a_gouge_that_no_look_ahead_mends_names_the_largest_tool():
    part = program(block(HOOK, CutterComp.LEFT))
    (gouging,) = derive(part).blocks
    remedy = remedy_for_gouge(gouging, part)
    assert (remedy.code, remedy.field) == ("TOOL_FITS", "tool")
    text = "Block 1: the tool is too big; the largest that does not gouge: {value}, with look-ahead 3."
    assert remedy.text == text
    for diameter, gouges in ((remedy.value / 25.4, False), (remedy.value / 25.4 + 0.001, True)):
        other = replace(part, tools=(Tool(1, diameter=Number(diameter)),))
        assert ("GOUGE" in [finding.code for finding in derive(other).blocks[0].findings]) is gouges
    for lookahead, gouges in ((2, True), (3, False)):
        typed = replace(part.blocks[0], lookahead=Number(lookahead))
        fitting = replace(part, blocks=(typed,), tools=(Tool(1, diameter=Number(remedy.value / 25.4)),))
        assert ("GOUGE" in [finding.code for finding in derive(fitting).blocks[0].findings]) is gouges
    whole = program(block(MID_SIDE_SQUARE, CutterComp.LEFT))
    assert remedy_for_gouge(derive(whole).blocks[0], whole) is None


def test_a_value_that_cannot_be_read_is_listed_with_its_text():
    typed = block(((1.0, 0.0), (2.0, 0.0)), CutterComp.LEFT)
    unread = LineSegment(x_end=Unread("2..5", "why"), y_end=Number(1.0))
    part = program(replace(typed, segments=(*typed.segments, unread)))
    (only,) = path_document(derive(part))["blocks"]
    assert only["segments"][-1]["x_end"] == {"value": None, "tag": "ERR", "text": "2..5"}
    assert [move["segment"] for move in only["moves"]] == [1]


def test_a_run_is_listed_with_all_its_solutions():
    """From 0 0 a line at 30 degrees, then one of length 40 to 70 10: two lines of such lengths meet."""
    first, second = LineSegment(angle=Number(30.0)), LineSegment(Number(70.0), Number(10.0), length=Number(40.0))
    typed = block(((0.0, 0.0), (0.0, 0.0)), CutterComp.LEFT)
    (only,) = path_document(derive(program(replace(typed, segments=(first, second)))))["blocks"]
    assert [segment["run"] for segment in only["segments"]] == [[1, 2], [1, 2]]
    (run,) = only["runs"]
    assert (run["first"], run["last"], run["solution"], run["code"]) == (1, 2, None, "PICK_SOLUTION")
    for solution in run["solutions"]:
        start, end = (segment["length"] for segment in solution["segments"])
        assert end == pytest.approx(40.0)
        assert solution["total"] == pytest.approx(start + end)
    # the distance of 70 10 from the first line is 26.34, and 40^2 = 26.34^2 + 30.104^2
    along = [solution["segments"][0]["length"] for solution in run["solutions"]]
    assert along == pytest.approx([65.6218 - 30.1044, 65.6218 + 30.1044], abs=1e-3)


@pytest.mark.parametrize(
    ("corner", "lengths"),
    [
        ((0.2, 0.2), (0.2, 0.2)),
        ((0.24, 0.3), (0.5, 0.24)),
        ((0.9, 3.0), (0.5, 0.9)),
        ((1.1, 3.0), None),
    ],
)
def test_the_unit_is_asked_for_small_parts_and_large_tools(corner, lengths):
    """The tool is 0.5 across: half of the smaller side at 1 inch; no part is meant to be smaller than a quarter."""
    x, y = corner
    corners = ((3, 2), (3 + x, 2), (3 + x, 2 + y), (3, 2 + y), (3, 2))
    question = unit_question(derive(program(block(corners, CutterComp.RIGHT))))
    assert (None if question is None else tuple(value / 25.4 for value in question.lengths)) == (
        None if lengths is None else pytest.approx(lengths)
    )
    if question is not None:
        assert question.text.endswith("The program is in INCH.")
    assert unit_question(derive(program(block(((0, 0), (x, 0), (x, y)), CutterComp.RIGHT)))) is None


def test_every_segment_of_the_document_has_the_kind_that_was_typed():
    mixed = block(((0, 0), (4, 0), (4, 4)), CutterComp.ON)
    typed = (mixed.segments[0], BlendSegment(Number(0.5)), mixed.segments[1])
    (only,) = path_document(derive(program(replace(mixed, segments=typed))))["blocks"]
    assert [segment["kind"] for segment in only["segments"]] == ["LINE", "BLEND ARC", "LINE"]


@pytest.mark.parametrize(("comp", "count", "recommended"), [(CutterComp.LEFT, 20, 3), (CutterComp.ON, 0, None)])
def test_only_a_compensated_contour_has_a_table(comp, count, recommended):
    part = program(block(NOTCH, comp))
    (derived_block,) = derive(part).blocks
    table = look_ahead_table(derived_block, part)
    document = table_document(derived_block, table, Unit.IN)
    assert (len(document["values"]), document["recommended"]) == (count, recommended)
    assert [need["text"] for need in document["needs"]] == (
        [] if table is None else [sentence(note, Unit.IN) for note in table.notes]
    )
    lines = list(table_listing(derived_block, table, Unit.IN))
    assert ("There is no contour to compensate yet" in lines[1]) is (table is None)
