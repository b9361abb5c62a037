"""A blend arc that gouges: its finding names the largest BLEND OFFSET that fits, to the last digit of the form."""

from __future__ import annotations

from dataclasses import replace
from math import cos, pi, sin
from random import Random

import pytest

from core.finding import Severity
from core.pipeline.derive import BLOCKS_SHARE, JUDGED_SHARE, derive, remedy_for_gouge
from core.pipeline.derived import DerivedBlock
from core.pipeline.setup_sheet import sheet_text
from core.program.model import (
    ArcSegment,
    CutterComp,
    Direction,
    Number,
    PathChoice,
    Program,
    ProgramParameters,
    Tool,
)
from core.progress import Stopped
from core.units import Unit, located_sentence, to_mm
from tests.core.pipeline.parts import Points, block

BLEND_CODES = {"BLEND_GOUGES", "BLEND_LEAVES"}

RECTANGLE = ((50, 0), (100, 0), (100, 60), (0, 60), (0, 0), (50, 0))
SLOT = ((50, 0), (100, 0), (100, 12), (0, 12), (0, 0), (50, 0))
EXACT_SLOT = ((50, 0), (100, 0), (100, 10), (0, 10), (0, 0), (50, 0))
TRIANGLE = ((50, 0), (100, 0), (50, 80), (0, 0), (50, 0))
L_POCKET = ((50, 0), (100, 0), (100, 60), (40, 60), (40, 30), (0, 30), (0, 0), (50, 0))


def lines_from(points: Points, tool: float, parameters: ProgramParameters, unit: Unit = Unit.MM) -> Program:
    """A pocket of lines, cut with a tool of this diameter."""
    return Program(unit, parameters, tools=(Tool(1, diameter=Number(tool)),), blocks=(block(points, CutterComp.LEFT),))


def hole(tool: float, parameters: ProgramParameters) -> Program:
    """A hole of 8 mm, started at its bottom, cut with a tool of this diameter."""
    arc = ArcSegment(Direction.CCW, x_end=Number(0), x_center=Number(0), y_center=Number(0))
    halves = (replace(arc, y_end=Number(4)), replace(arc, y_end=Number(-4)))
    made = lines_from(((0, -4), (1, -4)), tool, parameters)
    return replace(made, blocks=(replace(made.blocks[0], segments=halves),))


def parameters_of(blend: float, overlap: float = 0.0) -> ProgramParameters:
    return ProgramParameters(blend_offset=Number(blend), blend_overlap=Number(overlap))


def typed(program: Program, blend: float) -> DerivedBlock:
    """The block after BLEND OFFSET is typed."""
    parameters = replace(program.parameters, blend_offset=Number(blend))
    return derive(replace(program, parameters=parameters)).blocks[0]


def largest(derived: DerivedBlock) -> float | None:
    """The value that the findings on blend arcs name, in millimeters; None if they name none."""
    findings = [finding for finding in derived.findings if finding.code in BLEND_CODES]
    assert findings
    texts = {finding.text.partition("with F4")[2] for finding in findings}
    assert texts in ({": the largest that fits here is {0}."}, {": only 0 fits here."}, {"."})
    values = {finding.lengths for finding in findings}
    assert len(values) == 1
    return None if texts == {"."} else next(iter(values.pop()), 0.0)


def is_clean(derived: DerivedBlock) -> bool:
    return not any(finding.code in BLEND_CODES | {"GOUGE", "ROUGH_GOUGES"} for finding in derived.findings)


@pytest.mark.parametrize(
    ("points", "overlap", "value"),
    [
        (RECTANGLE, 0, 45.0),
        (RECTANGLE, 3, 42.0),
        (((20, 0), *RECTANGLE[1:-1], (20, 0)), 0, 15.0),
        (SLOT, 3, 2.0),
        (EXACT_SLOT, 0, 0.0),
        # 25.217700 by hand
        (TRIANGLE, 0, 25.217),
        (L_POCKET, 0, 20.0),
    ],
)
def test_the_largest_blend_of_a_pocket_is_the_one_by_hand(points: Points, overlap: float, value: float) -> None:
    program = lines_from(points, 10, parameters_of(0, overlap))
    assert largest(typed(program, 60.0)) == pytest.approx(value, abs=1e-9)
    if value:
        assert is_clean(typed(program, value))
    assert not is_clean(typed(program, value + 0.001))


def test_the_search_for_a_blend_that_fits_can_be_stopped() -> None:
    judged = list[float]()

    def stop_in_the_search(share: float) -> None:
        judged.append(share)
        if judged.count(BLOCKS_SHARE * JUDGED_SHARE) == 3:
            raise Stopped

    with pytest.raises(Stopped):
        derive(lines_from(L_POCKET, 10, parameters_of(60.0)), stop_in_the_search)


def test_a_hole_names_the_value_and_typing_it_works_but_one_more_digit_does_not() -> None:
    program = hole(6, parameters_of(3, 3))
    derived = typed(program, 3.0)
    (first, second) = [finding for finding in derived.findings if finding.code == "BLEND_GOUGES"]
    assert first.severity is second.severity is Severity.ERROR
    fits = "Start elsewhere or reduce BLEND OFFSET with F4: the largest that fits here is 1.000."
    assert located_sentence(first, Unit.MM).endswith(fits)
    assert is_clean(typed(program, 1.0))
    assert not is_clean(typed(program, 1.001))


def test_the_tool_is_not_called_too_big_where_only_the_blend_arcs_are() -> None:
    program = hole(6, parameters_of(3, 3))
    assert remedy_for_gouge(typed(program, 3.0), program) is None
    text = sheet_text(derive(program), name="hole", day="")
    assert "the largest that fits here is" in text
    assert "too big" not in text


def test_a_value_with_more_digits_than_the_form_may_only_lose_them() -> None:
    assert largest(typed(hole(6, parameters_of(1, 0)), 1.0004)) == 1.0


def test_roughing_passes_limit_the_value_too() -> None:
    parameters = replace(parameters_of(60), max_offset=Number(5), pocket_overlap=Number(40))
    program = lines_from(RECTANGLE, 10, parameters)
    program = replace(program, blocks=(replace(program.blocks[0], cutter_comp=CutterComp.PROFILE_LEFT),))
    value = largest(typed(program, 60.0))
    assert value is not None
    assert value > 0.0
    assert is_clean(typed(program, value))
    assert not is_clean(typed(program, value + 0.001))


def test_the_best_path_names_a_value_too() -> None:
    program = lines_from(SLOT, 10, replace(parameters_of(60, 3), path=PathChoice.BEST))
    assert largest(typed(program, 60.0)) == pytest.approx(2.0)


def test_a_path_that_gouges_at_start_without_blends_names_no_value() -> None:
    narrow = ((1, 0), (2, 0), (2, 0.3), (0, 0.3), (0, 0), (1, 0))
    assert largest(typed(lines_from(narrow, 0.5, parameters_of(0.1, 0.1)), 0.1)) is None


@pytest.mark.parametrize("unit", [Unit.IN, Unit.MM])
def test_typing_the_named_value_works_for_random_pockets(unit: Unit) -> None:
    random, tried = Random(20), 0
    size, decimals = (1.0, 4) if unit is Unit.IN else (25.0, 3)
    while tried < 12:
        corners = random.randint(4, 8)
        around = sorted(random.uniform(0, 2 * pi) for _ in range(corners))
        ring = [
            (size * random.uniform(2, 4) * cos(angle), size * random.uniform(2, 4) * sin(angle)) for angle in around
        ]
        points = [(round(x, decimals), round(y, decimals)) for x, y in ring]
        (x, y), (u, v) = points[-1], points[0]
        start = round((x + u) / 2, decimals), round((y + v) / 2, decimals)
        program = lines_from((start, *points, start), size / 2, parameters_of(0, size / 4), unit)
        if not is_clean(typed(program, 0.0)) or is_clean(failing := typed(program, 10 * size)):
            continue
        if not any(finding.code in BLEND_CODES for finding in failing.findings):
            continue
        tried += 1
        value = largest(failing)
        assert value is not None
        steps = round(value / to_mm(1.0, unit) * 10**decimals)
        assert is_clean(typed(program, steps / 10**decimals)), points
        assert not is_clean(typed(program, (steps + 1) / 10**decimals)), points
