"""What the NC file says of each pass: which side pass of how many, which peck of how many."""

from dataclasses import replace

from core.comp.compensated import CenterPath
from core.controls.write.written_program import Posted
from core.output.nc import center_path_program
from core.output.passes import Cutter, Job
from core.units import Unit
from tests.core.output.jobs import INCH, job, polyline

SLOT = polyline((0, 0), (2, 0))


def pass_titles(one: Job) -> list[str]:
    found = center_path_program([one], Unit.IN, name="SLOT")
    assert isinstance(found, Posted), found
    return [line for line in found.text.splitlines() if line.startswith("(BLOCK 1 ") and "MILL CONTOUR" not in line]


def test_every_pass_says_which_side_pass_and_which_peck_it_is():
    half = CenterPath(SLOT, offset=INCH / 2)
    rough = (CenterPath(SLOT, offset=INCH), half, half)
    assert pass_titles(job(SLOT, rough=rough, peck_depth=0.0)) == [
        "(BLOCK 1 SIDE PASS 1 OF 3 Z -0.2500 LEAVES 1.0000 ON SIDE)",
        "(BLOCK 1 SIDE PASS 2 OF 3 Z -0.2500 LEAVES 0.5000 ON SIDE)",
        "(BLOCK 1 SIDE PASS 2 OF 3 Z -0.2500 LEAVES 0.5000 ON SIDE)",
        "(BLOCK 1 SIDE PASS 3 OF 3 Z -0.2500)",
    ]
    assert pass_titles(job(SLOT, rough=rough[:1], peck_depth=0.2 * INCH)) == [
        "(BLOCK 1 SIDE PASS 1 OF 2 PECK 1 OF 2 Z -0.2000 LEAVES 1.0000 ON SIDE)",
        "(BLOCK 1 SIDE PASS 2 OF 2 PECK 1 OF 2 Z -0.2000)",
        "(BLOCK 1 SIDE PASS 1 OF 2 PECK 2 OF 2 Z -0.2500 LEAVES 1.0000 ON SIDE)",
        "(BLOCK 1 SIDE PASS 2 OF 2 PECK 2 OF 2 Z -0.2500)",
    ]


def test_the_finish_tool_counts_its_own_passes():
    one = job(
        SLOT, rough=(CenterPath(SLOT, offset=INCH),), finisher=Cutter(7, 12.7, "BALL"), finish_tool=7, peck_depth=0.0
    )
    assert pass_titles(one) == [
        "(BLOCK 1 PASS 1 OF 1 Z -0.2500 LEAVES 1.0000 ON SIDE)",
        "(BLOCK 1 FINISH PASS 1 OF 1 Z -0.2500)",
    ]
    assert pass_titles(replace(one, finisher=Cutter(7, 6.0), peck_depth=0.2 * INCH))[2:] == [
        "(BLOCK 1 FINISH PECK 1 OF 2 Z -0.2000)",
        "(BLOCK 1 FINISH PECK 2 OF 2 Z -0.2500)",
    ]
