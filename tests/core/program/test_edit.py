"""Edits: each yields the new program or refuses with a sentence; a change of units keeps the part."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import HealthCheck, given, settings

from core.program import edit
from core.program.edit import FormPlace, Refused, set_unit
from core.program.fields import FIELDS_OF_FORM, PARAMETERS, SETUP, START, Form, field_of, unread_reason
from core.program.file.read import loads
from core.program.file.write import dumps
from core.program.model import (
    ArcSegment,
    BlendSegment,
    Block,
    Coolant,
    CutterComp,
    Direction,
    LineSegment,
    Number,
    PartSetup,
    PathChoice,
    Program,
    ProgramParameters,
    Relative,
    Segment,
    Tool,
    Unread,
    changed,
    unread_texts,
)
from core.units import Kind, Unit
from tests.core.program.parts import BLOCK, arc, blend, line, program, programs

SQUARE = program(line(x_end=2.0, y_end=0.0), line(x_end=2.0, y_end=2.0), line(x_end=0.0, y_end=0.0))


def accepted(edited: edit.Edited) -> Program:
    """The program of an accepted edit."""
    assert isinstance(edited, Program)
    return edited


def test_type_field_changes_start_and_segments():
    typed = accepted(edit.type_field(SQUARE, FormPlace(1), "x_start", Number(-1.0)))
    assert typed.blocks[0] == replace(SQUARE.blocks[0], x_start=Number(-1.0))
    typed = accepted(edit.type_field(SQUARE, FormPlace(1, 2), "feed", Number(10.0)))
    assert typed.blocks[0].segments[1] == line(x_end=2.0, y_end=2.0, feed=10.0)
    assert typed.blocks[0].segments[::2] == SQUARE.blocks[0].segments[::2]


def test_a_blank_and_unreadable_text_are_kept():
    assert accepted(edit.type_field(SQUARE, FormPlace(1), "x_start", None)).blocks[0].x_start is None
    unread = Unread("x", "why")
    first = accepted(edit.type_field(SQUARE, FormPlace(1, 1), "x_end", unread)).blocks[0].segments[0]
    assert first == LineSegment(x_end=unread, y_end=Number(0.0))


@pytest.mark.parametrize(
    ("where", "name", "value", "text"),
    [
        (FormPlace(1), "speed", 2.5, "SPEED (RPM) must be a whole number from 1 to 100000."),
        (FormPlace(1), "peck_depth", -1.0, "PECK DEPTH must be from 0 to 254000."),
        (FormPlace(1, 1), "feed", 0.0, "FEED must be above 0, at most 254000."),
        (FormPlace(1, 4), "feed", 1.0, "Segment 4 does not exist; the last is 3."),
        (FormPlace(1, -1), "feed", 1.0, "Segment -1 does not exist; the last is 3."),
        (FormPlace(2), "speed", 1.0, "Block 2 does not exist; the last is 1."),
        (FormPlace(0), "speed", 1.0, "Block 0 does not exist; the last is 1."),
    ],
)
def test_type_field_refuses_wrong_values_and_places(where, name, value, text):
    assert edit.type_field(SQUARE, where, name, Number(value)) == Refused(text)


def test_type_field_finds_no_block_in_an_empty_program():
    assert edit.type_field(Program(), FormPlace(1), "speed", None) == Refused(
        "Block 1 does not exist; no block is typed yet."
    )


def test_a_typed_lookahead_stays_until_it_is_recalculated():
    user = accepted(edit.type_field(SQUARE, FormPlace(1), "lookahead", Number(4.0)))
    assert user.blocks[0].lookahead == Number(4.0)
    moved = accepted(edit.type_field(user, FormPlace(1, 1), "x_end", Number(3.0)))
    assert moved.blocks[0].lookahead == Number(4.0)
    hidden = accepted(edit.choose(user, FormPlace(1), "cutter_comp", "ON"))
    assert hidden.blocks[0].lookahead == Number(4.0)
    assert accepted(edit.recalculate_lookahead(user, 1)) == SQUARE
    assert edit.recalculate_lookahead(user, 2) == Refused("Block 2 does not exist; the last is 1.")


@pytest.mark.parametrize("typed", [Number(0.0), Number(21.0), Number(2.5), Unread("x", "why"), None])
def test_a_wrong_lookahead_is_refused_with_the_range(typed):
    user = accepted(edit.type_field(SQUARE, FormPlace(1), "lookahead", Number(4.0)))
    refused = edit.type_field(user, FormPlace(1), "lookahead", typed)
    assert isinstance(refused, Refused)
    assert refused.text.startswith("CUTCOMP LOOKAHEAD must be a whole number from 1 to 20.")


def test_a_blank_keeps_the_lookahead_calculated():
    assert edit.type_field(SQUARE, FormPlace(1), "lookahead", None) == SQUARE


def test_choose_sets_choice_fields():
    right = accepted(edit.choose(SQUARE, FormPlace(1), "cutter_comp", "PROFILE RIGHT"))
    assert right.blocks[0].cutter_comp is CutterComp.PROFILE_RIGHT
    curved = program(arc("CW", x_end=1.0, y_end=1.0, radius=3.0))
    turned = accepted(edit.choose(curved, FormPlace(1, 1), "direction", "CCW")).blocks[0].segments[0]
    assert isinstance(turned, ArcSegment)
    assert turned.direction is Direction.CCW
    picked = accepted(edit.choose(curved, FormPlace(1, 1), "choice", 1)).blocks[0].segments[0]
    assert picked == arc("CW", x_end=1.0, y_end=1.0, radius=3.0, choice=1)
    assert (
        accepted(
            edit.choose(accepted(edit.choose(curved, FormPlace(1, 1), "choice", 1)), FormPlace(1, 1), "choice", None)
        )
        == curved
    )


RELATIVE = (
    LineSegment(angle=Relative(30.0)),
    ArcSegment(Direction.CW, radius=Number(1.0), start_angle=Relative(30.0)),
)


@pytest.mark.parametrize("segment", RELATIVE)
def test_tangent_replaces_an_angle_relative_to_the_segment_before(segment: Segment) -> None:
    part = program(line(x_end=2.0, y_end=0.0), segment)
    tangent = accepted(edit.choose(part, FormPlace(1, 2), "tangent", "YES")).blocks[0].segments[1]
    plain = line() if isinstance(segment, LineSegment) else arc("CW", radius=1.0)
    assert tangent == replace(plain, tangent=True)
    fixed = program(line(x_end=2.0, y_end=0.0), line(angle=30.0))
    for picked in ("YES", "NO"):
        (_, now) = accepted(edit.choose(fixed, FormPlace(1, 2), "tangent", picked)).blocks[0].segments
        assert now == replace(line(angle=30.0), tangent=picked == "YES")


def test_a_picked_joint_is_kept_with_its_segment() -> None:
    picked = accepted(edit.pick_joint(SQUARE, FormPlace(1, 2), 2.5, -1.0)).blocks[0].segments[1]
    assert picked == changed(SQUARE.blocks[0].segments[1], {"pick_x": Number(2.5), "pick_y": Number(-1.0)})
    assert edit.pick_joint(SQUARE, FormPlace(1, 4), 0.0, 0.0) == Refused("Segment 4 does not exist; the last is 3.")


def test_a_segment_with_nothing_but_a_feed_is_empty() -> None:
    assert edit.is_empty(line())
    assert edit.is_empty(line(feed=9.0))
    assert not edit.is_empty(line(x_end=0.0))


def test_words_and_relative_numbers_do_not_fit_every_field() -> None:
    refused = edit.type_field(SQUARE, FormPlace(1), "cutter_comp", Number(1.0))
    assert refused == Refused("CUTTER COMP. takes ON, LEFT, RIGHT, PROFILE LEFT, PROFILE RIGHT.")
    refused = edit.type_field(SQUARE, FormPlace(1), "x_start", Relative(1.0))
    assert refused == Refused("X START takes no relative number: type it without I.")


@pytest.mark.parametrize(
    ("where", "name", "value", "text"),
    [
        (FormPlace(1), "cutter_comp", "UP", "CUTTER COMP. takes ON, LEFT, RIGHT, PROFILE LEFT, PROFILE RIGHT."),
        (FormPlace(1), "cutter_comp", None, "CUTTER COMP. takes ON, LEFT, RIGHT, PROFILE LEFT, PROFILE RIGHT."),
        (FormPlace(1, 1), "choice", -1, "SOLUTION takes the number of a solution."),
        (FormPlace(1, 9), "choice", 0, "Segment 9 does not exist; the last is 3."),
    ],
)
def test_choose_refuses_wrong_values_and_places(where, name, value, text):
    assert edit.choose(SQUARE, where, name, value) == Refused(text)


def test_a_picked_solution_is_dropped_when_other_fields_are_filled():
    picked = program(arc("CW", x_end=1.0, y_end=1.0, radius=3.0, choice=1))
    kept = accepted(edit.type_field(picked, FormPlace(1, 1), "radius", Number(4.0))).blocks[0].segments[0]
    assert kept == arc("CW", x_end=1.0, y_end=1.0, radius=4.0, choice=1)
    kept = accepted(edit.type_field(picked, FormPlace(1, 1), "feed", Number(4.0))).blocks[0].segments[0]
    assert kept == arc("CW", x_end=1.0, y_end=1.0, radius=3.0, feed=4.0, choice=1)
    dropped = accepted(edit.type_field(picked, FormPlace(1, 1), "x_end", None)).blocks[0].segments[0]
    assert dropped == arc("CW", y_end=1.0, radius=3.0)


def test_insert_segment_inserts_before_the_place():
    new = line(x_end=9.0, y_end=9.0)
    first, second, third = SQUARE.blocks[0].segments
    assert accepted(edit.insert_segment(SQUARE, FormPlace(1, 1), new)).blocks[0].segments == (new, first, second, third)
    assert accepted(edit.insert_segment(SQUARE, FormPlace(1, 3), new)).blocks[0].segments == (first, second, new, third)
    assert accepted(edit.insert_segment(SQUARE, FormPlace(1, 4), new)).blocks[0].segments == (first, second, third, new)
    assert accepted(edit.insert_segment(SQUARE, FormPlace(1, 4), blend(0.1))).blocks[0].segments[3] == blend(0.1)


@pytest.mark.parametrize(
    ("where", "segment", "text"),
    [
        (FormPlace(1, 0), LineSegment(), "START is always first."),
        (FormPlace(1, 5), LineSegment(), "Segment 5 does not exist; the last is 3."),
        (FormPlace(1, -1), LineSegment(), "Segment -1 does not exist; the last is 3."),
        (FormPlace(3, 1), LineSegment(), "Block 3 does not exist; the last is 1."),
        (FormPlace(1, 1), BlendSegment(), "A BLEND ARC cannot be the first segment: it stands between two others."),
    ],
)
def test_insert_segment_refuses_wrong_places(where, segment, text):
    assert edit.insert_segment(SQUARE, where, segment) == Refused(text)


@pytest.mark.parametrize("at", [2, 3])
def test_two_blends_cannot_be_neighbors(at):
    blended = program(line(x_end=1.0, y_end=0.0), blend(0.1), line(x_end=1.0, y_end=1.0))
    refused = Refused("A BLEND ARC cannot be next to another BLEND ARC.")
    assert edit.insert_segment(blended, FormPlace(1, at), BlendSegment()) == refused


def test_a_blend_may_be_two_segments_before_another():
    blended = program(line(x_end=1.0, y_end=0.0), line(x_end=2.0, y_end=0.5), blend(0.1), line(x_end=2.0, y_end=1.0))
    segments = accepted(edit.insert_segment(blended, FormPlace(1, 2), blend(0.2))).blocks[0].segments
    assert list(map(type, segments)) == [LineSegment, BlendSegment, LineSegment, BlendSegment, LineSegment]


def test_delete_segment_deletes_all_but_start():
    first, _, third = SQUARE.blocks[0].segments
    assert accepted(edit.delete_segment(SQUARE, FormPlace(1, 2))).blocks[0].segments == (first, third)
    assert edit.delete_segment(SQUARE, FormPlace(1, 0)) == Refused("START cannot be deleted.")
    assert edit.delete_segment(SQUARE, FormPlace(1, 4)) == Refused("Segment 4 does not exist; the last is 3.")
    alone = program(line(x_end=1.0, y_end=0.0))
    assert accepted(edit.delete_segment(alone, FormPlace(1, 1))).blocks[0].segments == ()
    assert edit.delete_segment(program(), FormPlace(1, 1)) == Refused(
        "Segment 1 does not exist; no segment is typed yet."
    )


def test_a_new_block_has_few_values():
    block = edit.new_block(Program())
    assert block.tool == Number(1.0)
    assert block.cutter_comp is CutterComp.ON
    assert (block.finish_tool, block.z_start, block.peck_depth) == (Number(0.0),) * 3
    assert (block.x_start, block.y_start, block.z_bottom, block.lookahead) == (None,) * 4
    assert (block.plunge_feed, block.speed, block.coolant) == (None,) * 3


def test_insert_block_copies_the_tool_of_the_block_before():
    part = Program(blocks=(replace(BLOCK, tool=Number(7.0)), replace(BLOCK, tool=Number(8.0))))
    assert [block.tool for block in accepted(edit.insert_block(part, 2)).blocks] == [
        Number(7.0),
        Number(7.0),
        Number(8.0),
    ]
    assert [block.tool for block in accepted(edit.insert_block(part, 1)).blocks] == [
        Number(1.0),
        Number(7.0),
        Number(8.0),
    ]
    assert [block.tool for block in accepted(edit.insert_block(part, 3)).blocks] == [
        Number(7.0),
        Number(8.0),
        Number(8.0),
    ]
    assert edit.insert_block(part, 4) == Refused("Block 4 does not exist; the last is 2.")
    assert edit.insert_block(part, 0) == Refused("Block 0 does not exist; the last is 2.")


def test_the_values_of_a_block_are_shared_with_the_others():
    shape = replace(BLOCK, z_bottom=None, plunge_feed=None, x_start=Number(9.0), cutter_comp=CutterComp.RIGHT)
    first = replace(
        BLOCK, tool=Number(3.0), z_bottom=Number(-5.0), speed=Unread("1..2", "is not a number"), coolant=Coolant.FLOOD
    )
    given = Program(blocks=(shape, first, replace(shape, z_bottom=Number(-1.0))))
    one, source, three = accepted(edit.share_values(given, 2, only_blank=False)).blocks
    assert source == first
    assert (
        one
        == three
        == replace(shape, tool=Number(3.0), z_bottom=Number(-5.0), coolant=Coolant.FLOOD, plunge_feed=first.plunge_feed)
    )
    one, source, three = accepted(edit.share_values(given, 2, only_blank=True)).blocks
    assert source == first
    kept = replace(shape, plunge_feed=first.plunge_feed, coolant=Coolant.FLOOD)
    assert (one, three) == (replace(kept, z_bottom=Number(-5.0)), replace(kept, z_bottom=Number(-1.0)))


def test_sharing_values_that_all_blocks_have_is_refused():
    assert edit.share_values(Program(blocks=(BLOCK,)), 1, only_blank=False) == Refused("There is no other block.")
    same = Program(blocks=(BLOCK, replace(BLOCK, x_start=Number(2.0))))
    refusal = edit.share_values(same, 1, only_blank=False)
    assert refusal == Refused(
        "The other blocks already have the tool, depths, speed, plunge feed and coolant of block 1."
    )
    assert isinstance(edit.share_values(same, 3, only_blank=False), Refused)


def test_blocks_are_copied_moved_and_deleted():
    one, two, three = (replace(BLOCK, tool=Number(tool)) for tool in (1.0, 2.0, 3.0))
    given = Program(blocks=(one, two, three))
    assert accepted(edit.copy_block(given, 1)).blocks == (one, one, two, three)
    assert accepted(edit.copy_block(given, 3)).blocks == (one, two, three, three)
    assert accepted(edit.move_block(given, 1, 3)).blocks == (two, three, one)
    assert accepted(edit.move_block(given, 3, 1)).blocks == (three, one, two)
    assert accepted(edit.move_block(given, 2, 2)) == given
    assert accepted(edit.delete_block(given, 2)).blocks == (one, three)
    absent = Refused("Block 4 does not exist; the last is 3.")
    assert edit.copy_block(given, 4) == edit.move_block(given, 4, 1) == edit.move_block(given, 1, 4) == absent
    assert edit.delete_block(given, 4) == absent
    last = Refused("The only block cannot be deleted: a program has at least one.")
    assert edit.delete_block(Program(blocks=(one,)), 1) == last


def test_tools_are_set_and_deleted_in_the_table():
    three, two = Tool(3, "BALL MILL", Number(0.25)), Tool(2, diameter=Number(1.0))
    both = accepted(edit.set_tool(accepted(edit.set_tool(Program(), three)), two))
    assert both.tools == (two, three)
    larger = Tool(2, diameter=Number(2.0))
    assert accepted(edit.set_tool(both, larger)).tools == (larger, three)
    assert accepted(edit.delete_tool(both, 2)).tools == (three,)
    assert edit.delete_tool(both, 9) == Refused("Tool 9 is not in the tool table.")
    wrong = Refused("TOOL DIAMETER must be above 0, at most 10000.")
    assert edit.set_tool(both, Tool(1, diameter=Number(0.0))) == wrong
    assert edit.set_tool(both, Tool(1, diameter=Number(-0.5))) == wrong
    assert edit.set_tool(both, Tool(0)) == Refused("TOOL must be a whole number from 1 to 9999.")
    refused = Refused("TYPE: character 4 (U+00A0) cannot be displayed. Type the text again without it.")
    assert edit.set_tool(both, Tool(1, "END\u00a0MILL")) == refused


def test_parameters_and_setup_are_set_or_refused():
    assert accepted(edit.set_parameter(SQUARE, "max_offset", Number(0.5))).parameters.max_offset == Number(0.5)
    refused = Refused("POCKET OVERLAP must be from 0 to 99.")
    assert edit.set_parameter(SQUARE, "pocket_overlap", Number(100.0)) == refused
    assert edit.set_path_choice(SQUARE, PathChoice.BEST).parameters.path is PathChoice.BEST
    assert accepted(edit.set_setup(SQUARE, "name", "COVER 7")).setup.name == "COVER 7"
    assert accepted(edit.set_setup(SQUARE, "safe_z", None)).setup.safe_z is None
    refused = Refused("WORK OFFSET must be a whole number from 54 to 59.")
    assert edit.set_setup(SQUARE, "work_offset", Number(60.0)) == refused
    refused = Refused("PART NAME: character 6 (U+00A0) cannot be displayed. Type the text again without it.")
    assert edit.set_setup(SQUARE, "name", "COVER\u00a07") == refused
    assert isinstance(edit.set_setup(SQUARE, "name", "two\nlines"), Refused)


def test_set_unit_converts_lengths_and_feeds_only():
    given = program(
        line(length=1.0, angle=30.0, feed=10.0), arc("CW", radius=0.5, sweep=90.0), blend(0.125), unit=Unit.IN, x=-1.0
    )
    given = replace(given, parameters=replace(given.parameters, pocket_overlap=Number(40.0), max_offset=Number(1.0)))
    metric = edit.set_unit(given, Unit.MM)
    block = metric.blocks[0]
    assert metric.unit is Unit.MM
    assert (block.x_start, block.z_bottom) == (Number(-25.4), Number(-6.35))
    assert (block.plunge_feed, block.speed, block.tool) == (Number(508.0), Number(300.0), Number(1.0))
    assert block.segments == (
        line(length=25.4, angle=30.0, feed=254.0),
        arc("CW", radius=12.7, sweep=90.0),
        blend(3.175),
    )
    assert metric.parameters.max_offset == Number(25.4)
    assert metric.parameters.blend_offset == Number(3.175), "the inch program's usual value, not the metric one's 3.0"
    assert metric.parameters.finish_xy is None
    assert metric.tools == (Tool(1, "END MILL", Number(12.7)),)
    back = edit.set_unit(metric, Unit.IN)
    assert back == given


def test_set_unit_keeps_unreadable_text():
    unread = Unread("1,5", unread_reason("1,5", field_of(Form.LINE, "x_end"), Unit.IN))
    given = accepted(edit.type_field(SQUARE, FormPlace(1, 1), "x_end", unread))
    assert edit.set_unit(given, Unit.IN).blocks[0].segments[0] == LineSegment(x_end=unread, y_end=Number(0.0))
    assert (list(unread_texts(SQUARE)), list(unread_texts(given))) == ([], [unread])


@settings(derandomize=True, max_examples=15, suppress_health_check=[HealthCheck.too_slow])
@given(programs)
def test_set_unit_loses_no_field(given_program):
    other = Unit.IN if given_program.unit is Unit.MM else Unit.MM
    converted = edit.set_unit(given_program, other)
    assert edit.set_unit(given_program, given_program.unit) is given_program
    for before, after in zip(given_program.blocks, converted.blocks, strict=True):
        for old, new in zip(before.segments, after.segments, strict=True):
            assert type(old.feed) is type(new.feed)
        assert (before.speed, before.lookahead, before.tool) == (after.speed, after.lookahead, after.tool)


SEGMENTS: dict[Form, Segment] = {Form.LINE: LineSegment(), Form.ARC: ArcSegment(), Form.BLEND: BlendSegment()}


def expected(kind: Kind) -> Number:
    """The value of 2 inches, or of 2 of another kind, in a metric program."""
    return Number(50.8) if kind in (Kind.LENGTH, Kind.FEED) else Number(2.0)


def numbers(form: Form) -> list[tuple[str, Kind]]:
    return [(field.name, field.kind) for field in FIELDS_OF_FORM[form] if field.kind not in (Kind.CHOICE, Kind.TEXT)]


@pytest.mark.parametrize(("name", "kind"), numbers(Form.START))
def test_set_unit_converts_start_fields(name, kind):
    part = set_unit(Program(Unit.IN, blocks=(changed(Block(), {name: Number(2.0)}),)), Unit.MM)
    assert getattr(part.blocks[0], name) == expected(kind)
    others = [field.name for field in START if field.kind is not Kind.CHOICE and field.name != name]
    assert all(getattr(part.blocks[0], other) is None for other in others)


@pytest.mark.parametrize("form", SEGMENTS)
def test_set_unit_converts_segment_fields(form):
    for name, kind in numbers(form):
        segment = changed(SEGMENTS[form], {name: Number(2.0)})
        part = set_unit(Program(Unit.IN, blocks=(Block(segments=(segment,)),)), Unit.MM)
        assert part.blocks[0].segments == (changed(SEGMENTS[form], {name: expected(kind)}),)


@pytest.mark.parametrize(("name", "kind"), numbers(Form.PARAMETERS))
def test_set_unit_converts_parameters(name, kind):
    part = set_unit(Program(Unit.IN, changed(ProgramParameters(), {name: Number(2.0)})), Unit.MM)
    usual = {
        "blend_offset": Number(3.175),
        "blend_overlap": Number(3.175),
        "retract_clearance": Number(2.54),
        "peck_clearance": Number(1.27),
    }
    assert part.parameters == changed(ProgramParameters(), usual | {name: expected(kind)})
    assert len(numbers(Form.PARAMETERS)) == len(PARAMETERS) - 1


@pytest.mark.parametrize(("name", "kind"), numbers(Form.SETUP))
def test_set_unit_converts_part_setup(name, kind):
    part = set_unit(Program(Unit.IN, setup=changed(PartSetup("A"), {name: Number(2.0)})), Unit.MM)
    assert part.setup == changed(PartSetup("A"), {"safe_z": Number(25.4)} | {name: expected(kind)})
    assert len(numbers(Form.SETUP)) == len(SETUP) - 1


def test_set_unit_converts_tool_diameters():
    part = set_unit(Program(Unit.IN, tools=(Tool(2, "BALL MILL", Number(2.0)), Tool(3))), Unit.MM)
    assert part.tools == (Tool(2, "BALL MILL", Number(50.8)), Tool(3))


def test_blanks_are_blank_again_after_converting_there_and_back():
    part = Program(Unit.IN, changed(ProgramParameters(), {"blend_offset": Number(0.25)}))
    metric = set_unit(part, Unit.MM)
    assert metric.parameters.blend_overlap == Number(3.175)
    assert metric.setup.safe_z == Number(25.4)
    assert set_unit(metric, Unit.IN) == part
    assert set_unit(set_unit(Program(Unit.MM), Unit.IN), Unit.MM) == Program(Unit.MM)


def test_set_unit_keeps_a_typed_zero():
    part = Program(Unit.IN, changed(ProgramParameters(), {"blend_offset": Number(0.0), "finish_xy": Number(0.0)}))
    metric = set_unit(part, Unit.MM).parameters
    assert (metric.blend_offset, metric.finish_xy) == (Number(0.0), Number(0.0))
    assert set_unit(set_unit(part, Unit.MM), Unit.IN) == part


def test_set_unit_with_the_same_unit_returns_the_same_program():
    part = Program(Unit.MM)
    assert set_unit(part, Unit.MM) is part


def test_set_unit_rewrites_the_reason_of_unreadable_text() -> None:
    feed = Unread("0", "FEED must be above 0, at most 10000, not 0.")
    plain = Program(blocks=(Block(segments=(LineSegment(feed=feed),)),))
    metric = set_unit(plain, Unit.MM)
    (segment,) = metric.blocks[0].segments
    assert segment.feed == Unread("0", "FEED must be above 0, at most 254000, not 0.")
    assert loads(dumps(metric), "part") == metric
    assert set_unit(metric, Unit.IN).blocks == plain.blocks
