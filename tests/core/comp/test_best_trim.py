"""What is cut off before anything else is looked at."""

from dataclasses import fields

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.comp.best_path import trim
from core.comp.best_path.raw_offset import Raw, untrimmed
from core.comp.best_path.surface import crosses_itself, surface_of
from core.comp.best_path.trim import trimmed
from core.geometry.path import Path
from core.geometry.piece import Side
from tests.core.comp.families import rings, strips

CONTOURS = strips | rings
RADII = st.sampled_from([0.05, 0.25, 0.5, 1.0]) | st.floats(0.03, 3.0)


def cut(contour: Path, side: Side, radius: float, few: int) -> Raw:
    closed = contour.points[0].tolist() == contour.points[-1].tolist()
    surface = surface_of(contour, radius, closed=closed)
    crossing = crosses_itself(surface, closed=closed) is not None
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(trim, "FEW", few)
        chain = untrimmed(surface.path, side, radius, closed=closed, crossing=crossing)
        return trimmed(chain, side.sign, radius)


@settings(max_examples=150, deadline=None, derandomize=True)
@given(CONTOURS, st.sampled_from(Side), RADII)
def test_all_joints_at_once_cut_what_one_after_the_other_cut(contour: Path, side: Side, radius: float) -> None:
    one, other = cut(contour, side, radius, 0), cut(contour, side, radius, 1000)
    for each in fields(one):
        assert np.array_equal(getattr(one, each.name), getattr(other, each.name)), each.name
