"""Paths of a contour as the advice room gets them, cut and judged without a program."""

from __future__ import annotations

from core.advice.block_paths import BlockPaths, RoughPass
from core.comp.compensate import compensate
from core.comp.compensated import CenterPath
from core.geometry.path import Path
from core.geometry.piece import Side
from core.verify.judge import judge


def work(
    contour: Path,
    side: Side = Side.LEFT,
    radius: float = 0.25,
    lookahead: int = 1,
    *,
    closed: bool = False,
    blend: float = 0.0,
    overlap: float = 0.0,
    stocks: tuple[float, ...] = (),
) -> BlockPaths:
    """The control's path at full size and the roughing passes that leave these stocks."""

    def cut(size: float) -> tuple[RoughPass, tuple[CenterPath, ...]]:
        control = compensate(contour, side, size, lookahead, closed=closed, blend=blend, overlap=overlap)
        loops = (CenterPath(control.path, control.lead_in, control.lead_out),) if len(control.path) else ()
        verdict = judge(contour, side, size, [loop.with_leads for loop in loops])
        return RoughPass(size - radius, loops, control, verdict), loops

    finish, loops = cut(radius)
    return BlockPaths(
        contour, loops, finish.compensated, finish.verdict, tuple(cut(radius + stock)[0] for stock in stocks)
    )
