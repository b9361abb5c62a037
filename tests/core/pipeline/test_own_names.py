"""Names at the head of programs posted for every control."""

from __future__ import annotations

from dataclasses import replace

import pytest

from core.controls.registry import names
from core.output.nc import Posted
from core.pipeline.derive import derive
from core.pipeline.derived import Derived
from core.pipeline.post import post_control_program
from core.program.model import CutterComp, Entry, Parameters
from tests.core.pipeline.parts import MID_SIDE_SQUARE, block, program

BLENDS = Parameters(blend_offset=Entry(0.125), blend_overlap=Entry(0.125))
SQUARE = replace(block(MID_SIDE_SQUARE, CutterComp.RIGHT), peck_depth=Entry(0.1))


def posted(found: Derived, control: str) -> Posted:
    result = post_control_program(found, name="PART", control=control)
    assert isinstance(result, Posted), result
    return result


@pytest.mark.parametrize("control", names())
def test_the_part_name_stands_at_the_head_of_every_controls_program(control: str) -> None:
    """Read back with it, and the same blocks as without; where the text holds no comments, that is said."""
    plain = program(SQUARE, SQUARE, parameters=BLENDS)
    named = derive(replace(plain, setup=replace(plain.setup, name="Teil ö) ; M30 (7")))
    found, nameless = posted(named, control), posted(derive(plain), control)
    lines, others = found.text.splitlines(), nameless.text.splitlines()
    told = [note.code for note in found.notes if note.code == "PART_NAME"]
    if control == "threeblock":
        assert (lines, told) == (others, ["PART_NAME"])
        return
    at = 2 if control == "klartext" else 1
    said = "PART Teil ?] , M30 [7"
    assert lines[at] == (f"{at} ; {said}" if control == "klartext" else f"({said})")
    assert told == []
    bare = [line.partition(" ")[2] if control == "klartext" else line for line in lines]
    assert [*bare[:at], *bare[at + 1 :]] == [
        line.partition(" ")[2] if control == "klartext" else line for line in others
    ]


def test_a_name_that_no_control_takes_is_changed() -> None:
    result = post_control_program(derive(program(SQUARE, parameters=BLENDS)), name="Teil 7 ;) ö", control="klartext")
    assert isinstance(result, Posted)
    assert result.text.startswith("0 BEGIN PGM Teil-7----- INCH\n")
    assert result.text.isascii()
