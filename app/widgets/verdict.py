"""Verdict shows what the cutter does, in three lines at the same place on every screen.

The title gives the look-ahead in force and its effect; the strip has a cell for each value from 1 to 20; the chips
are GOUGE, UNCUT and DELETED, always in this order.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import isfinite
from typing import TYPE_CHECKING, Final, NamedTuple

from textual.app import ComposeResult
from textual.containers import Vertical
from textual.content import Content
from textual.reactive import reactive
from textual.widgets import Static

from app.documents.folder_list import Outcome
from app.session.block_findings import GOUGE_CODES, TO_TYPE, WAITING_CODES
from app.session.formats import length, segment_numbers, shortened
from app.session.posting import deleted_numbers, deleted_segments
from app.widgets.plain import PlainText, show_text
from core.comp.lookahead import MAX_LOOKAHEAD
from core.finding import Severity
from core.pipeline.derived import DerivedBlock
from core.units import Unit, sentence

if TYPE_CHECKING:
    from core.advice.lookahead_table import Row, Table
    from core.verify.verdict import Verdict as Judgment

CHIPS_WIDTH: Final = 58
"""The width in cells of the chips' line on the narrowest screens."""
SHORTEST_CHIP: Final = 24
"""The fewest characters before a colon that are shown alone: a field's name would say too little."""

IN_OTHER_PLACES: Final = WAITING_CODES | GOUGE_CODES
"""Errors for which the prompt or the first chip is enough."""

OUTCOME_ROLES: Final = {
    Outcome.NOT_SAVED: "$c-warn",
    Outcome.OPEN: "$c-label",
    Outcome.GOUGE: "$c-gouge",
    Outcome.NOT_READY: "$c-warn",
    Outcome.UNREADABLE: "$c-err",
    Outcome.WARNING: "$c-warn",
    Outcome.UNCUT: "$c-uncut",
    Outcome.CLEAN: "$c-good",
    Outcome.EMPTY: "$c-label",
}
"""The color of each outcome."""


class Marks(NamedTuple):
    """The signs in one character set."""

    gouge: str
    warning: str
    deleted: str
    good: str
    value: str


MARKS_OF_CHARACTERS: Final[Mapping[str, Marks]] = {
    "braille": Marks("✖", "▲", "×", "✓", "•"),
    "block": Marks("!", "▲", "x", "√", "·"),
    "ascii": Marks("!", "^", "x", "ok", "."),
}
"""The signs for each character set of the drawing; every font on such a terminal has them."""


@dataclass(frozen=True, eq=False, slots=True)
class Case:
    """The block whose path the verdict describes.

    `working` is the fraction of the calculation that is done, None if all of it is.  Until then, and also if the
    calculation was `stopped`, the verdict is the previous one.
    """

    block: DerivedBlock
    table: Table | None
    unit: Unit
    working: float | None = None
    stopped: bool = False
    rows: tuple[Row, ...] = ()
    """The rows of the table that are known while it is being made."""

    def row(self, value: int) -> Row | None:
        """Return the row of a look-ahead value; None if it is not known yet."""
        rows = self.rows if self.table is None else self.table.rows
        return next((row for row in rows if row.value == value), None)

    @property
    def judgment(self) -> Judgment | None:
        """The judge's verdict on the path; None while there is none."""
        return None if self.block.paths is None else self.block.paths.verdict


class Verdict(Vertical):
    """The verdict on a `case`, with the signs for `characters`."""

    case: reactive[Case | None] = reactive(None, repaint=False)
    characters: reactive[str] = reactive("braille", repaint=False)

    def compose(self) -> ComposeResult:
        """Yield the strip and the chips."""
        yield PlainText(id="strip")
        yield PlainText(id="chips")

    def _show(self) -> None:
        if not self.is_mounted or self.case is None:
            return
        self.set_class(self.case.working is not None or self.case.stopped, "-working")
        self.border_title = title(self.case)
        marks = MARKS_OF_CHARACTERS[self.characters]
        for name, line in (("strip", strip(self.case, marks)), ("chips", chips(self.case, marks))):
            show_text(self.query_one(f"#{name}", Static), line)

    watch_case = watch_characters = _show


def title(case: Case) -> str:
    """Return the look-ahead in force, and its effect or the progress of the calculation."""
    block = case.block
    if block.side is None:
        return "CUTTER COMP. ON: the tool center runs on the contour"
    progress = "" if case.working is None else f"  working {round(100 * case.working)} %"
    progress = "  stopped" if case.stopped else progress
    best = block.paths is not None and block.paths.best is not None
    name = "PATH BEST" if best else f"LOOK-AHEAD {block.lookahead.tag} {block.lookahead.value}"
    return f"{name}{progress or _effect(case)}"


def _effect(case: Case) -> str:
    """Return the worst of what the path does."""
    judgment = case.judgment
    if judgment is None:
        return "  calculating" if not case.block.complete else ""
    if judgment.gouges:
        return f" gouges {_segments(segment_numbers(gouge.surface_number for gouge in judgment.gouges))}"
    if judgment.wrong_side:
        return " runs on the wrong side"
    if not judgment.judged:
        return " is not judged"
    effect = " leaves stock uncut" if judgment.uncut else " is clean"
    if deleted := deleted_segments(case.block):
        effect = f" deletes {_segments(deleted)}"
    return f"{effect}{_extent(case.block)}"


def _segments(numbers: str) -> str:
    if not numbers:
        return "a corner"
    return f"segments {', '.join(numbers.split())}" if set(numbers) & set(" -") else f"segment {numbers}"


def _extent(block: DerivedBlock) -> str:
    """Return which segments the verdict covers; empty if it covers the whole contour, or nothing."""
    if block.solved.fully_determined or not block.solved.pieces:
        return ""
    last = block.solved.pieces[-1][0]
    return ", segment 1 only" if last == 1 else f", segments 1-{last} only"


def strip(case: Case, marks: Marks) -> Content:
    """Return a cell for each look-ahead value, the one in force as its number, and which value is best."""
    if case.block.side is None:
        return Content("")
    parts: list[tuple[str, str]] = [(" 1 ", "$c-label")]
    for value in range(1, MAX_LOOKAHEAD + 1):
        row = case.row(value)
        role, mark = _value_mark(row, marks)
        here = value == case.block.lookahead.value
        parts.append((f" {value} ", f"bold reverse {role}") if here else (mark, role))
    parts.append((f" {MAX_LOOKAHEAD}", "$c-label"))
    parts.append((f"   {_advice(case)}", "$c-label"))
    return Content.assemble(*parts)


def _value_mark(row: Row | None, marks: Marks) -> tuple[str, str]:
    """Return the color role and the mark of a look-ahead value; `row` is None if it is not known yet."""
    if row is None:
        return "$c-label", marks.value
    if not row.clean:
        return "$c-gouge", marks.gouge
    return ("$c-deleted" if segment_numbers(row.deleted) else "$c-good"), marks.value


def _advice(case: Case) -> str:
    """Return which look-ahead value is best and what it costs."""
    if case.table is None:
        return ""
    best = case.table.recommended
    if best is None:
        return "none is clean, F10 says why" if case.table.notes else "no value is clean"
    if best == case.block.lookahead.value:
        return "this is best"
    row = case.table.row(best)
    if deleted := segment_numbers(row.deleted):
        return f"best {best}: deletes {deleted}"
    return f"best {best}: uncut {length(row.uncut, case.unit)}" if row.verdict.uncut else f"best {best}: clean"


def chips(case: Case, marks: Marks, *, findings_key: str = "F10", width: int = CHIPS_WIDTH) -> Content:
    """Return GOUGE, UNCUT and DELETED; without segments, what to type first; without a path, the first error."""
    if hint := first_step(case.block):
        depth = next((finding for finding in case.block.findings if finding.code == "Z_ORDER"), None)
        if depth is not None:
            return Content.styled(f"{marks.warning} {sentence(depth, case.unit)}", "bold $c-warn")
        return Content.styled(f" {hint}", "$c-label")
    judgment = case.judgment
    if case.block.side is None or judgment is None or _stopped_short(case):
        return _first_error(case, marks)
    gouge = _gouge_chip(judgment, case.unit, marks)
    uncut_length = length(judgment.uncut_length, case.unit)
    has_uncut = not isfinite(judgment.uncut_length) or judgment.uncut
    uncut = (
        (f"{marks.warning} UNCUT {uncut_length} long", "$c-uncut")
        if has_uncut
        else (f"{marks.good} UNCUT none", "$c-good")
    )
    deleted, counted = _deleted_chips(case.block, marks)
    # the chips sum up what is uncut or deleted; the findings list has the rest
    others = () if judgment.gouges else _others(case.block, marks, findings_key)
    rows = [
        _row((gouge, uncut, *rest), gap)
        for rest in ((deleted, *others), (counted, *others), (counted,))
        for gap in ("   ", "  ")
    ]
    return next((row for row in rows if len(row) <= width), rows[-1])


def _others(block: DerivedBlock, marks: Marks, findings_key: str) -> tuple[tuple[str, str], ...]:
    """Return the chip that points to the other findings: an error that forbids posting before a warning."""
    if any(finding.code not in IN_OTHER_PLACES for finding in block.errors):
        return ((f"{marks.gouge} see {findings_key}", "$c-err"),)
    warned = any(finding.severity is Severity.WARNING for finding in block.findings)
    return ((f"{marks.warning} see {findings_key}", "$c-warn"),) if warned else ()


def _deleted_chips(block: DerivedBlock, marks: Marks) -> tuple[tuple[str, str], tuple[str, str]]:
    """Return DELETED with the numbers of the segments, and with their count, for which there is more often room."""
    deleted = deleted_numbers(block)
    texts = (f"DELETED {segment_numbers(deleted)}", f"{len(deleted)} DELETED")
    named, counted = (
        (f"{marks.deleted} {text}", "$c-deleted") if deleted else (f"{marks.good} DELETED none", "$c-good")
        for text in texts
    )
    return named, counted


def _stopped_short(case: Case) -> bool:
    """True if the path ends before a segment with an error and gouges nothing up to there."""
    block = case.block
    open_end = not block.solved.fully_determined and not (case.judgment and case.judgment.gouges)
    return open_end and any(finding.code not in WAITING_CODES for finding in block.errors)


def _first_error(case: Case, marks: Marks) -> Content:
    """Return as much of the first error's sentence as fits; F10 lists it in full."""
    if not case.block.complete or not case.block.errors:
        return Content("")
    first = next((error for error in case.block.errors if error.code not in TO_TYPE), case.block.errors[0])
    role = "$c-warn" if first.code in TO_TYPE else "$c-err"
    text_of_error = sentence(first, case.unit)
    if first.code == "UNREADABLE" and first.segment:
        text_of_error = f"Segment {first.segment:g}, {text_of_error}"
    text = f"{marks.gouge} {text_of_error}"
    # the prompt and F10 give the full sentence
    if len(text) > CHIPS_WIDTH and ". " in text[:CHIPS_WIDTH]:
        text = f"{text.partition('. ')[0]}."
    elif len(text) > CHIPS_WIDTH and ": " in text[SHORTEST_CHIP:CHIPS_WIDTH]:
        text = f"{text[: text.rindex(': ', SHORTEST_CHIP, CHIPS_WIDTH)]}."
    return Content.styled(shortened(text, CHIPS_WIDTH), f"bold {role}")


def _gouge_chip(judgment: Judgment, unit: Unit, marks: Marks) -> tuple[str, str]:
    if judgment.gouges:
        return f"{marks.gouge} GOUGE {length(judgment.depth, unit)}", "$c-gouge"
    if not judgment.judged:
        return f"{marks.warning} GOUGE not judged", "$c-gouge"
    if judgment.wrong_side:
        return f"{marks.gouge} WRONG SIDE", "$c-gouge"
    return f"{marks.good} GOUGE none", "$c-good"


def _row(texts: Iterable[tuple[str, str]], gap: str) -> Content:
    return Content(gap).join([Content.styled(text, f"bold {role}") for text, role in texts])


def first_step(block: DerivedBlock) -> str:
    """Return what to do in a block without segments; empty if it has any, or an error other than missing values."""
    if block.block.segments or any(finding.code not in TO_TYPE for finding in block.errors):
        return ""
    if any(finding.code == "MISSING" for finding in block.errors):
        return "Fill in START, then Page Down for segment 1."
    return "START is complete: Page Down for segment 1."


def verdict_word(outcome: Outcome, marks: Marks) -> Content:
    """Return an outcome with its sign, in its color."""
    signs = {Outcome.GOUGE: marks.gouge, Outcome.CLEAN: marks.good}
    signs |= dict.fromkeys((Outcome.UNCUT, Outcome.WARNING), marks.warning)
    return Content.styled(f"{signs.get(outcome, '?')} {outcome}", OUTCOME_ROLES[outcome])
