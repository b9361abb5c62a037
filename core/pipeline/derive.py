"""Every stage in its order: fields, surface, compensation, verdict, findings."""

from __future__ import annotations

from dataclasses import replace
from math import inf

from core.comp.compensate import compensate
from core.comp.result import Compensated
from core.finding import Finding, Severity
from core.geometry.path import Path
from core.geometry.side import Side
from core.pipeline.derived import Derived, DerivedBlock, RoughPass, Work
from core.pipeline.outline import outline_block
from core.program.fields import default
from core.program.model import Block, Entry, Program
from core.units import to_mm
from core.verify.judge import judge
from core.verify.report import findings as verdict_findings
from core.verify.verdict import Verdict


def derive(program: Program, before: Derived | None = None) -> Derived:
    """The whole program derived; blocks that are the same objects as in `before` are taken from there."""
    blocks = (derive_block(number, block, program, before) for number, block in enumerate(program.blocks, 1))
    return Derived(program, tuple(blocks))


def derive_block(number: int, block: Block, program: Program, before: Derived | None = None) -> DerivedBlock:
    """One block derived, or its former self where nothing it depends on has changed."""
    former = _former(number, block, program, before)
    if former is not None:
        return former
    found = outline_block(number, block, program)
    pieces = found.solved.pieces
    if not pieces or found.radius is None:
        return replace(found, known=True)
    surface = Path.from_pieces([piece for _, piece in pieces], [float(number) for number, _ in pieces])
    return _worked(found, program, surface)


def _former(number: int, block: Block, program: Program, before: Derived | None) -> DerivedBlock | None:
    if before is None or number > len(before.blocks) or not before.blocks[number - 1].known:
        return None
    then = before.program
    same = before.blocks[number - 1].block is block and then.tools is program.tools
    same = same and then.parameters is program.parameters and then.unit is program.unit
    return before.blocks[number - 1] if same else None


def parameter(program: Program, name: str) -> float:
    """A program parameter as typed or its default; lengths in millimetres, a percentage as it is."""
    typed = getattr(program.parameters, name)
    value = typed.value if isinstance(typed, Entry) else default(name, program.unit)
    if value is None:
        return 0.0
    return value if name == "pocket_overlap" else to_mm(value, program.unit)


def _worked(found: DerivedBlock, program: Program, surface: Path) -> DerivedBlock:
    assert found.radius is not None
    if found.side is None:
        work = Work(surface, surface, None, None, ())
        return replace(found, work=work, known=True)
    finish = _pass(found, program, surface, found.side, found.radius)
    verdict = judge(surface, found.side, found.radius, finish.whole)
    work = Work(surface, finish.whole, finish, verdict, _rough(found, program, surface, found.side))
    judged = (*verdict_findings(verdict, surface), *_blend_findings(finish, verdict), *_rough_findings(work.rough))
    trouble = (*found.findings, *finish.findings, *judged, *_size_warning(found, surface))
    return replace(found, work=work, known=True, findings=_by_weight(trouble))


def _pass(found: DerivedBlock, program: Program, surface: Path, side: Side, radius: float) -> Compensated:
    return compensate(
        surface,
        side,
        radius,
        found.lookahead.value,
        closed=found.solved.closed,
        blend=parameter(program, "blend_offset"),
        overlap=parameter(program, "blend_overlap"),
    )


def stocks(found: DerivedBlock, program: Program) -> tuple[float, ...]:
    """What each pass before the finish path leaves on the surface, in millimetres, outermost first.

    PROFILE comes in from MAX OFFSET, each pass overlapping the one before by POCKET OVERLAP percent of the cutter's
    diameter; a finish tool has a roughing pass in front of it that leaves FINISH XY.
    """
    assert found.solved.tool_diameter is not None
    finishing = found.solved.finish_diameter is not None
    least = parameter(program, "finish_xy") if finishing else 0.0
    widths: list[float] = []
    if found.profile:
        stock = parameter(program, "max_offset")
        step = found.solved.tool_diameter * (1.0 - parameter(program, "pocket_overlap") / 100.0)
        while stock > least + 1e-9 and step > 0.0 and len(widths) < MOST_PASSES:
            widths.append(stock)
            stock -= step
    return (*widths, least) if finishing else tuple(widths)


MOST_PASSES = 1000
"""More passes than this are a slip of the finger in MAX OFFSET or POCKET OVERLAP."""


def _rough(found: DerivedBlock, program: Program, surface: Path, side: Side) -> tuple[RoughPass, ...]:
    if found.solved.tool_diameter is None:
        return ()
    cutter = found.solved.tool_diameter / 2
    passes = []
    for stock in stocks(found, program):
        compensated = _pass(found, program, surface, side, cutter + stock)
        verdict = judge(surface, side, cutter, compensated.whole)
        passes.append(RoughPass(stock, cutter, compensated.whole, compensated, verdict))
    return tuple(passes)


def _blend_findings(finish: Compensated, verdict: Verdict) -> tuple[Finding, ...]:
    """A blend arc that gouges is named as such: the remedy is another start or a smaller BLEND OFFSET."""
    first, last = len(finish.lead_in), len(finish.lead_in) + len(finish.path)
    found = []
    for name, hit in (
        ("in", next((gouge for gouge in verdict.gouges if gouge.path_piece < first), None)),
        ("out", next((gouge for gouge in verdict.gouges if gouge.path_piece >= last), None)),
    ):
        if hit is not None:
            text = f"The blend-{name} arc gouges {{value}} deep. Start elsewhere or make BLEND OFFSET smaller."
            found.append(Finding("BLEND_GOUGES", Severity.ERROR, text, hit.surface_number, None, hit.at, hit.depth))
    return tuple(found)


def _rough_findings(rough: tuple[RoughPass, ...]) -> tuple[Finding, ...]:
    text = "The roughing pass that leaves {0} gouges {value} deep."
    return tuple(
        Finding("ROUGH_GOUGES", Severity.ERROR, text, hit.surface_number, None, hit.at, hit.depth, (one.stock,))
        for one in rough
        for hit in one.verdict.gouges[:1]
    )


def _size_warning(found: DerivedBlock, surface: Path) -> tuple[Finding, ...]:
    assert found.radius is not None
    boxes = surface.boxes
    extent = max((boxes[:, 2:].max(axis=0) - boxes[:, :2].min(axis=0)).tolist(), default=inf)
    if 2 * found.radius <= extent:
        return ()
    text = "The tool is {value} across, larger than the whole contour ({0}). Check TOOL and TOOL SETUP."
    return (Finding("TOOL_LARGE", Severity.WARNING, text, field="tool", value=2 * found.radius, lengths=(extent,)),)


def _by_weight(found: tuple[Finding, ...]) -> tuple[Finding, ...]:
    order = list(Severity)
    return tuple(sorted(found, key=lambda finding: order.index(finding.severity)))
