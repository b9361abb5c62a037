"""This module makes a program's NC text for a control, the reasons that prevent posting, and the setup sheet."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Final

from app.session.formats import length, segment_numbers
from core.finding import Severity
from core.pipeline.derived import Derived, DerivedBlock
from core.program.model import Program
from core.progress import Progress, silent
from core.units import located_sentence, sentence

if TYPE_CHECKING:
    from core.controls.control_names import ControlChoice
    from core.controls.write.written_program import Refusal

CENTER_PATH: Final = "center path"
"""The choice without a control: the tool's center path, which needs no compensation by the control."""
OVERRIDE_PHRASES: Final = ("POST ANYWAY", "POST WITH GOUGE")
"""The phrases that the operator types to post a path that gouges."""


@dataclass(frozen=True, slots=True)
class PostedText:
    """An NC text, or the reasons `against` posting; `overridable` if the operator's phrase overrides them.

    `block` is the number of the block of the first reason; None if it is about the whole program.
    """

    text: str = ""
    against: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    overridable: bool = False
    block: int | None = None


def choices() -> tuple[ControlChoice, ...]:
    """Return the center path and every control that cutcomp can post for."""
    # imported here: the first paint must not load the controls
    from core.controls.control_names import ControlChoice
    from core.controls.registry import choices as controls

    return (ControlChoice(CENTER_PATH, CENTER_PATH, "", "no G41 or G42, for LinuxCNC"), *controls())


def nc_text(
    program: Program, name: str, choice: str, override: str | None = None, progress: Progress = silent
) -> PostedText:
    """Return the NC text of a program; everything is derived again, so nothing stale is posted.

    `name` is the file's name; `override` is the phrase the operator typed to post a path that gouges.
    """
    from core.controls.write.written_program import Posted
    from core.output.objections import OVERRIDABLE_CODES, OVERRIDE_PHRASE
    from core.pipeline.derive import derive
    from core.pipeline.post import post_center_path, post_control_program
    from core.pipeline.unit_question import unit_question

    derived, unit = derive(program, progress), program.unit
    if choice == CENTER_PATH:
        result = post_center_path(derived, name=name, override=OVERRIDE_PHRASE if override else None)
    else:
        result = post_control_program(derived, name=name, control=choice)
    asked = unit_question(derived)
    notes = () if asked is None else (sentence(asked, unit),)
    if isinstance(result, Posted):
        # each with its block's number; warnings do not prevent posting
        warnings = (
            replace(finding, block=block.number)
            for block in derived.blocks
            for finding in block.findings
            if finding.severity is Severity.WARNING
        )
        remarks = (*warnings, *result.notes)
        return PostedText(result.text, notes=(*notes, *(located_sentence(note, unit) for note in remarks)))
    against, remedies = refusals(derived, result)
    overridable = choice == CENTER_PATH and all(finding.code in OVERRIDABLE_CODES for finding in result.findings)
    block = result.findings[0].block if result.findings else None
    return PostedText(against=against, notes=(*remedies, *notes), overridable=overridable, block=block)


def refusals(derived: Derived, refusal: Refusal) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the reasons for a refusal, each with its block and segment, and the remedies for blocks that gouge."""
    from core.pipeline.derive import remedy_for_gouge

    reasons = tuple(located_sentence(finding, refusal.unit) for finding in refusal.findings)
    remedies = (remedy_for_gouge(block, derived.program) for block in derived.blocks)
    return reasons, tuple(sentence(remedy, refusal.unit) for remedy in remedies if remedy is not None)


def objections(derived: Derived) -> Iterator[str]:
    """Yield a line on uncut stock and a line on segments the look-ahead deletes, each with its blocks."""
    unit = derived.program.unit
    verdicts = [(block.number, block.paths.verdict) for block in derived.blocks if block.paths is not None]
    left = [
        f"block {number} {length(verdict.uncut_length, unit)} long"
        for number, verdict in verdicts
        if verdict is not None and verdict.uncut
    ]
    deleted = [(block.number, numbers) for block in derived.blocks if (numbers := deleted_segments(block))]
    if left:
        yield f"UNCUT {', '.join(left)}"
    if deleted:
        yield f"DELETED {', '.join(f'block {number} segments {numbers}' for number, numbers in deleted)}"


def deleted_segments(block: DerivedBlock) -> str:
    """Return the segments that the control's path deletes; empty if the best path is posted instead."""
    return segment_numbers(deleted_numbers(block))


def deleted_numbers(block: DerivedBlock) -> frozenset[int]:
    """Return the numbers of those segments.  Corner arcs are left out."""
    paths = block.paths
    if paths is None or paths.compensated is None or paths.best is not None:
        return frozenset()
    return frozenset(int(number) for number in paths.compensated.deleted.segments.tolist() if number == int(number))


def setup_sheet(program: Program, path: Path, now: datetime, *, name: str = "") -> str:
    """Return the setup sheet: a page for .html and .htm, text for any other suffix; everything is derived again."""
    from core.pipeline.derive import derive
    from core.pipeline.setup_sheet import sheet_page, sheet_text

    write = sheet_page if path.suffix.lower() in (".html", ".htm") else sheet_text
    return write(derive(program), name=name or path.stem, day=f"{now:%Y-%m-%d}")
