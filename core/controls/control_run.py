"""A control run holds a program's moves, compensated stretches and findings on a control, up to its end or an alarm."""

from __future__ import annotations

from bisect import bisect
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import inf
from typing import Final, NamedTuple, NoReturn, Protocol

from core.controls.control_tools import ToolId
from core.controls.moves import Moves, Plane
from core.finding import Finding, Severity
from core.geometry.piece import Side
from core.units import Unit

MAX_FINDINGS_OF_A_RULE: Final = 100
"""Most findings of one rule that are kept; the rest are only counted."""

MAX_ALIKE: Final = 3
"""Most INFO findings of one rule with the same text that are kept: more would bury what matters."""

LIMIT_RULES: Final = frozenset({"LIMIT", "FN-ENDLESS"})
"""The rules that end a run because it repeats too much to follow."""

NOT_RUN_TEXT: Final = "The lines from here on come after the end of the program and were not run. Check them."


@dataclass(frozen=True, slots=True)
class Change:
    """A new side or radius within a stretch, from row `programmed` of the programmed moves on.

    In the run's moves the element before ends at `row`, and the first element with the new side or radius runs after
    `start`; the rows between them are the moves across.
    """

    programmed: int
    row: int
    start: int
    side: Side
    radius: float


@dataclass(frozen=True, eq=False, slots=True)
class Stretch:
    """Compensated moves: from the move that turns compensation on to the one that leaves it."""

    side: Side
    """The side of the tool; a negative radius in the program has already flipped it."""
    radius: float
    """Millimeters, positive."""
    plane: Plane
    programmed: Moves
    """The moves as written, without compensation, with their start point as row 0: the part's surface."""
    entry: int
    """How many of them lead in at the beginning, and are not surface."""
    exit: int
    """How many of them lead out at the end."""
    first: int
    last: int
    """The stretch has the rows `first` ... `last` - 1 of the run's moves."""
    led_in: bool = False
    """The control enters on a lead of its own, not in a programmed move."""
    led_out: bool = False
    """The control leaves on a lead of its own."""
    changes: tuple[Change, ...] = ()
    """Where its side or radius changes."""
    wear: bool = False
    """The radius is a small negative one: the wear of a program that describes the cutter's center path."""

    def has_part(self, part: Stretch) -> bool:
        """True if `part` is this stretch or a part of it; the next stretch may begin where this one ends."""
        return self.first <= part.first < self.last - 1

    def without_wear(self) -> Stretch:
        """Return the stretch as it is with no wear: the center runs on the programmed path, on the side programmed."""
        if not self.wear:
            return self
        return replace(self, side=Side.RIGHT if self.side is Side.LEFT else Side.LEFT, radius=0.0)

    def parts(self) -> tuple[Stretch, ...]:
        """Return the stretch in parts of one side and radius each; moves across belong to the smaller radius.

        Anything larger does not fit there, whatever the control does: the center is square to the smaller one.
        """
        if not self.changes:
            return (self,)
        parts, side, radius, entry, first = list[Stretch](), self.side, self.radius, self.entry, self.first
        begin = 1
        for change in self.changes:
            last = change.row if change.radius <= radius else change.start
            programmed = self.programmed.part(begin - 1, change.programmed)
            parts.append(Stretch(side, radius, self.plane, programmed, entry, 0, first, last + 1))
            begin, side, radius, entry, first = change.programmed, change.side, change.radius, 0, last
        programmed = self.programmed.part(begin - 1, len(self.programmed))
        parts.append(Stretch(side, radius, self.plane, programmed, entry, self.exit, first, self.last))
        return tuple(parts)


class SpindleChange(NamedTuple):
    """The tool and the spindle speed as programmed from a row of the moves on; None if the program has named none."""

    row: int = 0
    tool: int | None = None
    speed: float | None = None


class SetupChange(NamedTuple):
    """The setup from a row of the moves on: another position of axes that are not followed, or another work offset
    that the program does not set.  A setup that comes again has its number again."""

    row: int = 0
    number: int = 0


@dataclass(frozen=True, eq=False, slots=True)
class ControlRun:
    """A program's run on a control.

    `unit` is the program's; everything else is in millimeters.  `stopped_at` is the line at which the control would
    stop with an alarm, None if it runs to the end; `moves` are those made before that.  `unplaced` are the rows whose
    height only the machine knows.  `spindle` are the changes of tool and speed, in order, `setups` those of the setup.
    `variables` are the common macro variables as the program leaves them.
    """

    control: str
    unit: Unit
    moves: Moves
    findings: tuple[Finding, ...]
    stopped_at: int | None = None
    stretches: tuple[Stretch, ...] = ()
    unplaced: frozenset[int] = frozenset()
    spindle: tuple[SpindleChange, ...] = (SpindleChange(),)
    setups: tuple[SetupChange, ...] = (SetupChange(),)
    variables: Mapping[int, float] = field(default_factory=dict)

    @property
    def endless(self) -> bool:
        """True if the run was given up because it repeats too much to follow."""
        return any(finding.code in LIMIT_RULES for finding in self.findings)

    def spindle_at(self, row: int) -> SpindleChange:
        """Return the tool and the speed in force when the move of a row begins."""
        return next(change for change in reversed(self.spindle) if change.row <= row)

    def setup_at(self, row: int) -> int:
        """Return the number of the setup in which the move of a row runs; places of two setups do not compare."""
        return self.setups[bisect(self.setups, row, key=lambda change: change.row) - 1].number

    def stops_within(self, stretch: Stretch) -> bool:
        """True if the control stops within the stretch."""
        return self.stopped_at is not None and stretch.last == len(self.moves)


class Place(Protocol):
    """Where a finding is: anything with a line and a column of the program, such as a block or an element."""

    @property
    def line(self) -> int:
        """The line, from 1."""

    @property
    def column(self) -> int:
        """The column, from 1."""


class Spot(NamedTuple):
    """A place of its own."""

    line: int
    column: int = 1


class AlarmError(Exception):
    """Stops the control; caught where the program is run, never seen outside."""

    def __init__(self, finding: Finding, line: int | None) -> None:
        super().__init__(finding.text)
        self.finding = finding
        self.line = line


def finding_of_omitted(code: str, lines: Sequence[int | None]) -> Finding:
    """Return the finding that counts the further findings of a rule, at the first of their lines."""
    more = f"{code}: {len(lines)} more {'line' if len(lines) == 1 else 'lines'} like these."
    return Finding(code, Severity.INFO, more, line=lines[0])


GRAVEST_FIRST: Final = (Severity.ERROR, Severity.WARNING, Severity.INFO)


@dataclass(slots=True)
class Log:
    """The findings of a run: one per rule and line, MAX_FINDINGS_OF_A_RULE per rule, MAX_ALIKE of one text.

    A line that is run again, in a loop or a subprogram, may get a graver one too, or one of a larger value.

    `seen` has the largest value of each rule, line and severity, 0 for findings without one.
    `kept` counts kept findings by rule, INFO apart from the rest; `alike` counts INFO findings by rule and text;
    `left_out` has the lines of the findings not kept, by rule.  `rule_names` are a control's own alarm numbers, by the
    ids of the rules that controls share.
    """

    findings: list[Finding] = field(default_factory=list)
    kept: Counter[tuple[str, bool]] = field(default_factory=Counter)
    alike: Counter[tuple[str, str]] = field(default_factory=Counter)
    left_out: dict[str, list[int | None]] = field(default_factory=dict)
    seen: dict[tuple[str, int | None, Severity], float] = field(default_factory=dict)
    rule_names: Mapping[str, str] = field(default_factory=dict)

    def add(self, finding: Finding) -> None:
        """Keep a finding unless its line has one of its rule as grave and large as it, or the limits are reached."""
        as_grave = GRAVEST_FIRST[: GRAVEST_FIRST.index(finding.severity) + 1]
        value = finding.value or 0.0
        if any(self.seen.get((finding.code, finding.line, severity), -inf) >= value for severity in as_grave):
            return
        self.seen[finding.code, finding.line, finding.severity] = value
        informs = finding.severity is Severity.INFO
        rule, text = (finding.code, informs), (finding.code, finding.text if informs else "")
        if self.kept[rule] >= MAX_FINDINGS_OF_A_RULE or (informs and self.alike[text] >= MAX_ALIKE):
            self.left_out.setdefault(finding.code, []).append(finding.line)
            return
        self.kept[rule] += 1
        self.alike[text] += 1
        self.findings.append(finding)

    def has(self, code: str) -> bool:
        """True if a finding of this rule was kept."""
        return self.kept[code, True] > 0 or self.kept[code, False] > 0

    def report(
        self,
        severity: Severity,
        code: str,
        text: str,
        place: Place,
        *,
        lengths: tuple[float, ...] = (),
        value: float | None = None,
    ) -> None:
        """Keep a finding with these values; the control continues."""
        self.add(Finding(code, severity, text, lengths=lengths, value=value, line=place.line, column=place.column))

    def inform(self, code: str, text: str, place: Place, *, lengths: tuple[float, ...] = ()) -> None:
        """Keep a note."""
        self.report(Severity.INFO, code, text, place, lengths=lengths)

    def warn(self, code: str, text: str, place: Place, *, lengths: tuple[float, ...] = ()) -> None:
        """Keep a warning."""
        self.report(Severity.WARNING, code, text, place, lengths=lengths)

    def stop(
        self,
        code: str,
        text: str,
        place: Place,
        *,
        lengths: tuple[float, ...] = (),
        at: tuple[float, float] | None = None,
        stops_at: int | None = None,
        tool: ToolId | None = None,
    ) -> NoReturn:
        """Stop the control with an alarm, at the line of its place unless another is given.

        `tool` is the one whose size is missing.
        """
        code, line = self.rule_names.get(code, code), place.line
        finding = Finding(code, Severity.ERROR, text, at=at, lengths=lengths, line=line, column=place.column, tool=tool)
        raise AlarmError(finding, stops_at or line)

    def all_findings(self) -> tuple[Finding, ...]:
        """Return all findings by line, and one more for each rule that has findings left out."""
        listed = (*self.findings, *map(finding_of_omitted, self.left_out, self.left_out.values()))
        return tuple(sorted(listed, key=lambda finding: (finding.line or 0, finding.column or 0)))
