"""Every field has a help topic that fits, with a picture where words are not enough."""

from __future__ import annotations

import pytest

from app.screens.topics import TOPICS, topic_of
from core.program.fields import FIELDS_OF_FORM, Form, field_of


@pytest.mark.parametrize(
    ("form", "name"), [(form, field.name) for form, table in FIELDS_OF_FORM.items() for field in table]
)
def test_every_field_has_an_ascii_topic_with_a_picture_of_at_most_56_columns(form: Form, name: str) -> None:
    topic = TOPICS[form, name]
    assert topic.words.isascii()
    assert topic.words.endswith(".")
    assert all(line.isascii() and line.startswith("  ") and len(line) <= 58 for line in topic.picture)


@pytest.mark.parametrize(
    ("form", "name"),
    [
        (Form.LINE, "angle"),
        (Form.ARC, "sweep"),
        (Form.START, "cutter_comp"),
        (Form.START, "peck_depth"),
        (Form.START, "lookahead"),
        (Form.PARAMETERS, "blend_offset"),
    ],
)
def test_topics_that_need_a_picture_have_one(form: Form, name: str) -> None:
    topic = topic_of(field_of(form, name))
    assert topic is not None
    assert len(topic.picture) >= 3


def test_the_same_name_on_two_forms_has_two_topics() -> None:
    assert topic_of(field_of(Form.ARC, "radius")) is not topic_of(field_of(Form.BLEND, "radius"))


def test_the_help_of_speed_does_not_offer_0() -> None:
    assert field_of(Form.START, "speed").low == 1
    assert "0" not in TOPICS[Form.START, "speed"].words
