"""The table of fields against the model and the labels of the screens, and texts in fields."""

from __future__ import annotations

from dataclasses import fields as attributes

import pytest

from core.program import fields
from core.program.fields import (
    FIELDS_OF_FORM,
    TYPE_AGAIN,
    Form,
    default_value,
    field_of,
    form_of,
    read_typed,
    text_refusal,
    unread_reason,
    value_refusal,
)
from core.program.model import (
    ArcSegment,
    BlendSegment,
    Block,
    ChamferSegment,
    LineSegment,
    Number,
    PartSetup,
    ProgramParameters,
    Relative,
    Tool,
    Unread,
)
from core.units import Kind, Unit

PARTS = {
    Form.START: (Block, {"segments"}),
    Form.LINE: (LineSegment, {"choice", "pick_x", "pick_y"}),
    Form.ARC: (ArcSegment, {"choice", "pick_x", "pick_y"}),
    Form.BLEND: (BlendSegment, set()),
    Form.CHAMFER: (ChamferSegment, set()),
    Form.TOOL: (Tool, set()),
    Form.PARAMETERS: (ProgramParameters, set()),
    Form.SETUP: (PartSetup, set()),
}


@pytest.mark.parametrize("form", Form)
def test_every_attribute_has_its_field(form):
    part, others = PARTS[form]
    assert {item.name for item in FIELDS_OF_FORM[form]} | others == {item.name for item in attributes(part)}
    assert all(field_of(form, item.name) is item for item in FIELDS_OF_FORM[form])


@pytest.mark.parametrize("form", Form)
def test_every_field_has_a_label_a_prompt_and_the_choices_of_its_kind(form):
    for one in FIELDS_OF_FORM[form]:
        assert one.label == one.label.upper()
        assert one.prompt.endswith(".")
        assert bool(one.choices) == (one.kind is Kind.CHOICE)


def test_the_labels_of_start_are_those_of_the_control():
    assert [one.label for one in fields.START] == [
        "TOOL",
        "CUTTER COMP.",
        "FINISH TOOL",
        "X START",
        "Y START",
        "Z START",
        "Z BOTTOM",
        "PLUNGE FEED",
        "SPEED (RPM)",
        "PECK DEPTH",
        "CUTCOMP LOOKAHEAD",
        "COOLANT",
    ]
    assert field_of(Form.START, "cutter_comp").choices == ("ON", "LEFT", "RIGHT", "PROFILE LEFT", "PROFILE RIGHT")


def test_the_labels_of_segments_are_those_of_the_control():
    assert [one.label for one in fields.LINE] == [
        "X END",
        "Y END",
        "Z END",
        "POINT X",
        "POINT Y",
        "DISTANCE",
        "XY LENGTH",
        "XY ANGLE",
        "PARALLEL TO",
        "OFFSET",
        "FEED",
        "TANGENT",
    ]
    assert [one.label for one in fields.ARC] == [
        "DIRECTION",
        "X END",
        "Y END",
        "Z END",
        "POINT X",
        "POINT Y",
        "X CENTER",
        "Y CENTER",
        "RADIUS",
        "SWEEP ANGLE",
        "START ANGLE",
        "FEED",
        "TANGENT",
    ]
    assert [one.label for one in fields.BLEND] == ["RADIUS", "FEED"]


def test_the_lookahead_prompt_is_that_of_the_control():
    words = "Enter a cutter comp lookahead value to override the calculated value. Not recommended unless necessary."
    assert field_of(Form.START, "lookahead").prompt.startswith(words)
    assert "1 to 20" in fields.LOOKAHEAD_PROMPT


def test_only_lines_and_arcs_have_a_solution_field():
    assert field_of(Form.ARC, "choice") is field_of(Form.LINE, "choice") is fields.SOLUTION
    with pytest.raises(KeyError):
        field_of(Form.BLEND, "choice")


def test_form_of_names_the_form_of_a_segment():
    assert [form_of(one) for one in (LineSegment(), ArcSegment(), BlendSegment())] == [Form.LINE, Form.ARC, Form.BLEND]


@pytest.mark.parametrize(
    ("form", "name", "value", "text"),
    [
        (Form.START, "lookahead", 0.0, "CUTCOMP LOOKAHEAD must be a whole number from 1 to 20."),
        (Form.START, "lookahead", 21.0, "CUTCOMP LOOKAHEAD must be a whole number from 1 to 20."),
        (Form.START, "lookahead", 2.5, "CUTCOMP LOOKAHEAD must be a whole number from 1 to 20."),
        (Form.START, "tool", 0.0, "TOOL must be a whole number from 1 to 9999."),
        (Form.START, "peck_depth", -0.1, "PECK DEPTH must be from 0 to 10000."),
        (Form.START, "plunge_feed", 0.0, "PLUNGE FEED must be above 0, at most 10000."),
        (Form.START, "x_start", float("nan"), "X START must be from -10000 to 10000."),
        (Form.START, "x_start", float("inf"), "X START must be from -10000 to 10000."),
        (Form.TOOL, "diameter", -0.5, "TOOL DIAMETER must be above 0, at most 10000."),
        (Form.ARC, "sweep", 360.001, "SWEEP ANGLE must be above 0, at most 360."),
        (Form.LINE, "angle", 361.0, "XY ANGLE must be from -360 to 360."),
        (Form.SETUP, "work_offset", 60.0, "WORK OFFSET must be a whole number from 54 to 59."),
        (Form.PARAMETERS, "pocket_overlap", 100.0, "POCKET OVERLAP must be from 0 to 99."),
    ],
)
def test_value_refusal_names_the_range(form, name, value, text):
    assert value_refusal(field_of(form, name), value, Unit.IN) == text


@pytest.mark.parametrize(
    ("form", "name", "value"),
    [
        (Form.START, "lookahead", 1.0),
        (Form.START, "lookahead", 20.0),
        (Form.START, "finish_tool", 0.0),
        (Form.START, "peck_depth", 0.0),
        (Form.START, "x_start", -1e4),
        (Form.ARC, "sweep", 360.0),
        (Form.ARC, "radius", 1e-9),
    ],
)
def test_value_refusal_accepts_values_in_range(form, name, value):
    assert value_refusal(field_of(form, name), value, Unit.IN) is None


def test_default_values_depend_on_the_unit():
    assert default_value("blend_offset", Unit.IN) == 0.125
    assert default_value("blend_offset", Unit.MM) == 3.0
    assert default_value("pocket_overlap", Unit.MM) == 50.0
    assert default_value("retract_clearance", Unit.MM) == 2.5
    assert default_value("peck_clearance", Unit.IN) == 0.05
    assert default_value("safe_z", Unit.IN) == 1.0
    assert default_value("x_start", Unit.IN) is None


def test_the_ranges_of_a_field_are_the_same_in_both_units():
    place, feed = field_of(Form.START, "x_start"), field_of(Form.LINE, "feed")
    assert value_refusal(place, 10000.0, Unit.IN) is None
    assert value_refusal(place, 254000.0, Unit.MM) is None
    assert value_refusal(place, 10000.1, Unit.IN) == "X START must be from -10000 to 10000."
    assert value_refusal(place, 254000.1, Unit.MM) == "X START must be from -254000 to 254000."
    assert value_refusal(feed, 254000.1, Unit.MM) == "FEED must be above 0, at most 254000."
    angle = field_of(Form.LINE, "angle")
    assert value_refusal(angle, 360.0, Unit.IN) == value_refusal(angle, 360.0, Unit.MM) is None


def test_a_speed_of_zero_is_refused():
    speed = field_of(Form.START, "speed")
    assert value_refusal(speed, 0.0, Unit.MM) == "SPEED (RPM) must be a whole number from 1 to 100000."
    assert value_refusal(speed, 1.0, Unit.MM) is None


@pytest.mark.parametrize("unit", Unit)
def test_every_parameter_has_a_default_within_its_range(unit):
    for one in (*fields.PARAMETERS, *fields.SETUP):
        if one.kind not in (Kind.CHOICE, Kind.TEXT):
            value = default_value(one.name, unit)
            assert value is not None
            assert value_refusal(one, value, unit) is None


def test_read_typed_keeps_unreadable_text():
    one = field_of(Form.LINE, "x_end")
    assert read_typed("  ", one, Unit.IN) is None
    assert read_typed("1 1/2", one, Unit.IN) == Number(1.5)
    unread = read_typed("1a5", one, Unit.IN)
    assert isinstance(unread, Unread)
    assert unread.text == "1a5"


@pytest.mark.parametrize(
    ("form", "name", "text", "why"),
    [
        (Form.START, "x_start", "99999", "X START must be from -10000 to 10000, not 99999."),
        (Form.START, "finish_tool", "-1", "FINISH TOOL must be a whole number from 0 to 9999, not -1."),
        (Form.LINE, "feed", " 0 ", "FEED must be above 0, at most 10000, not 0."),
    ],
)
def test_a_number_out_of_range_is_kept_as_typed(form: Form, name: str, text: str, why: str) -> None:
    one = field_of(form, name)
    assert read_typed(text, one, Unit.IN) == Unread(text, why)
    assert text_refusal(text, one, Unit.IN) == unread_reason(text, one, Unit.IN) == why


@pytest.mark.parametrize("text", ["I2.5", "i 2.5", "2.5I", "2 1/2 i", "5/2I", "2.5 I"])
def test_an_i_before_or_after_a_number_counts_from_the_start_of_the_segment(text: str) -> None:
    end, start = field_of(Form.LINE, "x_end"), field_of(Form.START, "x_start")
    assert read_typed(text, end, Unit.IN) == Relative(2.5)
    assert read_typed("12I", end, Unit.IN) == Relative(12.0)
    assert isinstance(read_typed(text, start, Unit.IN), Unread)


@pytest.mark.parametrize("text", ["I", "in", "2.5in", "inI", "2.5mmI"])
def test_an_i_that_is_part_of_a_word_is_not_relative(text: str) -> None:
    assert not isinstance(read_typed(text, field_of(Form.LINE, "x_end"), Unit.IN), Relative)


def test_a_text_that_the_field_would_now_accept_must_be_typed_again() -> None:
    one = field_of(Form.START, "x_start")
    assert text_refusal("99999", one, Unit.MM) is None
    assert unread_reason("99999", one, Unit.MM) == TYPE_AGAIN


@pytest.mark.parametrize(
    ("form", "name", "least", "most"),
    [
        (Form.START, "tool", 1, 9999),
        (Form.START, "finish_tool", 0, 9999),
        (Form.START, "speed", 1, 100000),
        (Form.START, "lookahead", 1, 20),
        (Form.LINE, "parallel", 1, 9999),
        (Form.LINE, "angle", -360, 360),
        (Form.ARC, "start_angle", -360, 360),
        (Form.TOOL, "number", 1, 9999),
        (Form.TOOL, "speed", 1, 100000),
        (Form.PARAMETERS, "pocket_overlap", 0, 99),
        (Form.SETUP, "work_offset", 54, 59),
    ],
)
def test_numbers_are_accepted_up_to_their_limits(form, name, least, most):
    field = field_of(form, name)
    assert [value_refusal(field, float(value), Unit.IN) for value in (least, most)] == [None, None]
    assert all(value_refusal(field, float(value), Unit.IN) for value in (least - 1, most + 1))
