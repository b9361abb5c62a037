from core.comp.advise import recommended
from core.pipeline.derive import derive
from core.pipeline.table import look_ahead_table
from core.program.model import CutterComp
from tests.core.pipeline.parts import NOTCH, OUTSIDE_SQUARE, OVER_RUN_SQUARE, block, program


def table(points, comp):
    part = program(block(points, comp))
    (found,) = derive(part).blocks
    return look_ahead_table(found, part)


def test_the_notch_is_clean_from_three_and_three_is_recommended():
    found = table(NOTCH, CutterComp.LEFT)
    assert [row.value for row in found.rows] == list(range(1, 21))
    assert [row.clean for row in found.rows] == [False] * 2 + [True] * 18
    assert found.row(2).gouge > 0.2 * 25.4
    assert found.row(3).gouge == 0.0
    assert found.row(3).deleted == (2.0, 3.0, 4.0)
    assert found.recommended == 3


def test_the_over_run_square_is_clean_from_three_although_most_of_it_is_erased():
    found = table(OVER_RUN_SQUARE, CutterComp.RIGHT)
    assert [row.clean for row in found.rows] == [False] * 2 + [True] * 18
    assert found.recommended == 3


def test_there_is_no_table_without_compensation():
    assert table(OUTSIDE_SQUARE, CutterComp.ON) is None


class Fate:
    def __init__(self, value, clean, uncut):
        self.value, self.clean, self.uncut = value, clean, uncut


def test_the_recommended_value_is_clean_then_leaves_least_then_is_smallest():
    fates = [Fate(1, False, 0.0), Fate(2, True, 3.0), Fate(3, True, 1.0), Fate(4, True, 1.0 + 1e-9)]
    assert recommended(fates) == 3
    assert recommended(fates[:1]) is None
    assert recommended([]) is None
