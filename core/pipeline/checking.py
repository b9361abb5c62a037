"""Checks one program on one control: findings, outcome in words, and the machine-readable object.

For a tool that is too big it finds the largest that fits: it runs the program with smaller and smaller sizes of it.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from enum import StrEnum, auto
from math import ceil
from shlex import quote
from typing import Final

from core.controls.compared_contours import ContourPair, Parting, contours
from core.controls.compared_controls import Compared, OtherLanguage, compare
from core.controls.control_names import display_name
from core.controls.control_run import MAX_ALIKE, ControlRun, Stretch, finding_of_omitted
from core.controls.control_tools import CutterTool, ToolId, ToolTable, tool_id
from core.controls.iso.flow import ProgramLibrary, no_library
from core.controls.iso.modal_state import RADIUS_ZERO
from core.controls.iso.reader import without_comments
from core.controls.judging import shop_rules
from core.controls.judging.judged_contour import JudgedContour
from core.controls.judging.judged_findings import judged_findings
from core.controls.judging.judged_runs import deepest_gouge, first_unjudged, judge_run
from core.controls.moves import Move, Moves
from core.controls.program_text import lines_of
from core.controls.registry import is_klartext, reads, run
from core.finding import Finding, Severity
from core.program.tools import unusual_size
from core.progress import Progress, silent
from core.units import Kind, Unit, decimals_shown, from_mm, length_text, sentence, to_mm

NOT_FOLLOWED: Final = (
    *("MACRO", "LIMIT", "BEYOND", "N-PROBE"),
    *("FN-DARC", "FN-CYCLE", "FN-TRANSFORM", "FN-WHERE", "FN-PARAMETER", "FN-ENDLESS"),
)
"""Rules that stop the reading of the program, not the control."""
EMPTY_CODE: Final = "EMPTY"
"""The rule of a program with nothing to run."""
SHALLOW_GOUGE_SHARE: Final = 0.01
"""A gouge is shallow below this fraction of the tool's radius."""

_COMPENSATES: Final = re.compile(r"G0*4[12](?!\d)")
_COMPENSATES_KLARTEXT: Final = re.compile(r"\bR[LR]\b")


class State(StrEnum):
    """The result of a program on a control: the word for it in JSON."""

    CLEAN = auto()
    GOUGES = auto()
    ALARM = auto()
    NOT_FOLLOWED = auto()
    UNJUDGED = auto()
    WRONG_SIDE = auto()
    UNCOMPENSATED = auto()
    ERRORS = auto()
    OTHER_LANGUAGE = auto()
    EMPTY = auto()
    UNREADABLE = auto()


@dataclass(frozen=True, eq=False, slots=True)
class CheckRequest:
    """What is asked of every program: a control's full name or `all`, the tools, and whether the shop's rules apply.

    `unit` applies if a program names none; None is the one that a control starts in.  `library` finds the programs
    that a control calls from its memory.  With `names_options`, a stop for lack of a tool's size names the option of
    the command line that gives it.  With `fits`, the largest tool that is clean is searched for if one is too big.
    """

    control: str
    tools: ToolTable
    shop: bool
    unit: Unit | None
    library: ProgramLibrary = no_library
    names_options: bool = True
    fits: bool = True


@dataclass(frozen=True, eq=False, slots=True)
class Answer:
    """A program's result on a control: the outcome in words, the findings, and what they were made from.

    `stretches` counts the compensated ones.  `stop` is the error that the control stops for.  `gouge` is the deepest
    one's depth in millimeters and its line.  `parting` is where the path leaves that of the control `reference`, and
    `comparison` says so in words, or why it was not compared.  `fits` is the largest tool if one is too big.
    """

    control: str
    unit: Unit
    moves: Moves | None
    findings: tuple[Finding, ...]
    stopped_at: int | None
    outcome: str
    stretches: int = 0
    comparison: str = ""
    stop: Finding | None = None
    state: State = State.CLEAN
    gouge: tuple[float, int | None] | None = None
    parting: Parting | None = None
    reference: str = ""
    fits: Finding | None = None

    @property
    def name(self) -> str:
        """The control's name as operators know it."""
        return display_name(self.control)

    @property
    def errors(self) -> bool:
        """True if any finding is an error."""
        return any(finding.severity is Severity.ERROR for finding in self.findings)

    @property
    def warnings(self) -> int:
        """The number of warnings."""
        return sum(finding.severity is Severity.WARNING for finding in self.findings)

    @property
    def outcome_and_warnings(self) -> str:
        """The outcome, with the number and rules of any warnings: `runs, 2 warnings (RAPID, UNCUT)`."""
        rules = dict.fromkeys(finding.code for finding in self.findings if finding.severity is Severity.WARNING)
        warnings = f", {counted(self.warnings, 'warning')} ({', '.join(rules)})" if rules else ""
        return f"{self.outcome}{warnings}"

    @property
    def uncompensated(self) -> bool:
        """True if the program asks for compensation with radius 0 anywhere."""
        return any(finding.code in RADIUS_ZERO for finding in self.findings)

    @property
    def stop_reason(self) -> str:
        """The reason for the stop as a sentence, empty if the control does not stop."""
        return "" if self.stop is None else sentence(self.stop, self.unit)

    @property
    def missing(self) -> ToolId | None:
        """The number or name of the tool whose diameter the control lacks when it stops, else None."""
        if self.stopped_at is None:
            return None
        return next((error.tool for error in self.findings if error.tool is not None), None)

    @property
    def move_count(self) -> int:
        """The number of moves, without the start point."""
        return len(self.moves) - 1 if self.moves is not None else 0

    def json(self) -> dict[str, object]:
        """Return the machine-readable object, in program units."""
        moves = [] if self.moves is None else [_move(move, self.unit) for move in self.moves]
        findings = [_finding(finding, self.unit) for finding in self.findings]
        depth = None if self.gouge is None else {"depth": from_mm(self.gouge[0], self.unit), "line": self.gouge[1]}
        return {
            "control": self.name,
            "units": self.unit.value,
            "state": self.state.value,
            "stopped_at": self.stopped_at,
            "deepest_gouge": depth,
            "parts_from": None if self.parting is None else _parts_from(self.parting, self.reference, self.unit),
            "stretches": self.stretches,
            "moves": moves,
            "findings": findings,
        }


def answer(text: bytes, request: CheckRequest) -> Answer:
    """Return one control's answer."""
    done = run(text, request.control, request.tools, request.unit, request.library)
    before = _before(done, text, request.tools)
    return _complete(_answer(done, judge_run(done), before, shop=request.shop), done, text, request)


def _complete(row: Answer, done: ControlRun, text: bytes, request: CheckRequest) -> Answer:
    """Return the answer with the largest tool that fits and, if asked for, the option that gives a tool its size."""
    row = with_largest_tool(row, done, text, request)
    return _with_remedy(row, tool_option) if request.names_options else row


def unusual_tools(tools: ToolTable, unit: Unit) -> tuple[Finding, ...]:
    """Return a warning on each tool whose diameter may be in the wrong unit, for a program in `unit`."""
    named = ((number, tool.diameter_mm(unit)) for number, tool in tools.items())
    doubts = ((number, unusual_size(f"Tool {number}", diameter, unit)) for number, diameter in named)
    # braces in a Klartext tool's name would be taken for placeholders of lengths
    return tuple(finding for number, finding in doubts if finding is not None and "{" not in str(number))


def with_largest_tool(
    row: Answer, done: ControlRun, text: bytes, request: CheckRequest, progress: Progress = silent
) -> Answer:
    """Return the answer; if a smaller tool would be clean, with the largest such tool at the fault's line."""
    if not request.fits or row.state not in (State.ALARM, State.GOUGES):
        return row
    fits = largest_tool(text, done, request.tools, request.library, request.unit, progress)
    if fits is None or _is_of_no_use(fits, row, done):
        return row
    fits = replace(fits, line=row.stopped_at or (row.gouge and row.gouge[1]))
    if row.state is State.GOUGES and _only_leads_gouge(row, done):
        message = "Only a lead-in or lead-out gouges: move its far end. As it is, the largest tool that fits is {0}."
        fits = replace(fits, text=message)
    return replace(row, fits=fits, findings=_by_line((*row.findings, fits)))


def _is_of_no_use(fits: Finding, row: Answer, done: ControlRun) -> bool:
    """True if a shallow gouge would need a tool less than half as large.

    LinuxCNC leaves such gouges at nearly tangent joints of a drawing's short lines, with any tool in use.
    """
    radius = max((stretch.radius for stretch in done.stretches), default=0.0)
    return row.gouge is not None and row.gouge[0] < SHALLOW_GOUGE_SHARE * radius and fits.lengths[0] < radius


def _only_leads_gouge(row: Answer, done: ControlRun) -> bool:
    """True if no move gouges except those that turn compensation on or off."""
    contours = set[int]()
    for stretch in done.stretches:
        lines = stretch.programmed.lines.tolist()
        contours.update(lines[stretch.entry + 1 : len(lines) - stretch.exit])
    return contours.isdisjoint(finding.line for finding in row.findings if finding.code == "GOUGE")


def _with_remedy(row: Answer, remedy: Callable[[ToolId], str]) -> Answer:
    """Return the answer; if the control stops for lack of a tool's size, with the remedy in the text of that alarm."""
    if row.stop is None or row.stopped_at is None or row.stop.tool is None:
        return row
    stop = replace(row.stop, text=f"{row.stop.text} {remedy(row.stop.tool)}")
    return replace(row, stop=stop, findings=tuple(stop if finding is row.stop else finding for finding in row.findings))


def tool_option(tool: ToolId) -> str:
    """Return the sentence that names the option for a tool's size."""
    return f"On the command line: --tool {quote(str(tool))}=DIAMETER."


def answered(done: ControlRun, results: tuple[JudgedContour, ...], text: bytes, tools: ToolTable) -> Answer:
    """Return the answer of a control that has run a text, with the key that gives a tool its size if it needs one."""
    before = _before(done, text, tools)
    return _with_remedy(_answer(done, results, before, shop=False), lambda tool: f"T gives tool {tool} its diameter.")


def answer_all(
    text: bytes, request: CheckRequest, reference: str = "", progress: Progress = silent
) -> tuple[Answer, ...]:
    """Return every control's answer, and where its path leaves that of the `reference`, which comes first.

    Without a reference, or if it does not run the program, the first control that runs it is the one compared with.
    """
    request = replace(request, unit=request.unit or Unit.IN)
    rows = compare(text, request.tools, request.unit, request.library, reference, progress)
    return tuple(_compared(row, request, text) for row in rows)


def _compared(row: Compared | OtherLanguage, request: CheckRequest, text: bytes) -> Answer:
    if isinstance(row, OtherLanguage):
        message = f"The program is in another control's language, and its contour is not compared: {row.why}."
        findings = (_language(Severity.INFO, message),)
        outcome, comparison = "reads another language", f"not compared: {row.why}"
        state = State.OTHER_LANGUAGE
        return Answer(row.control, Unit.MM, None, findings, None, outcome, comparison=comparison, state=state)
    comparison = _parting(row.parting, row.reference, row.run.unit) if row.parting else ""
    if not row.contour_of:
        before = _before(row.run, text, request.tools)
        answer_row = _complete(_answer(row.run, row.results, before, shop=request.shop), row.run, text, request)
    else:
        reader = display_name(row.contour_of)
        message = f"The program is in another control's language: only its contour was run, as {reader} reads it, with "
        message += "straight leads that cutcomp adds."
        answer_row = _answer(row.run, row.results, (_language(Severity.INFO, message),), shop=request.shop)
        comparison = f"its contour only{'; ' if comparison else ''}{comparison}"
    return replace(answer_row, comparison=comparison, parting=row.parting, reference=row.reference)


def _language(severity: Severity, message: str) -> Finding:
    return Finding("LANGUAGE", severity, message, line=1, column=1)


def _before(done: ControlRun, text: bytes, tools: ToolTable) -> tuple[Finding, ...]:
    """Return what to know before the findings of a run: unusual tools, a wrong language, and that nothing is judged."""
    return (*unusual_tools(tools, done.unit), *_foreign(done.control, text), *_idle_compensation(done, text))


def _foreign(control: str, text: bytes) -> tuple[Finding, ...]:
    if reads(control, text):
        return ()
    message = "The program is not written in this control's language. Comparing all controls takes its contour."
    return (_language(Severity.WARNING, message),)


def _idle_compensation(done: ControlRun, text: bytes) -> tuple[Finding, ...]:
    """Warn if a program has compensation but no compensated move was run, or only one: nothing has been judged then."""
    if done.stretches:
        return tuple(_without_contour(stretch) for stretch in done.stretches if _has_no_contour(done, stretch))
    if done.stopped_at is not None or any(each.code in RADIUS_ZERO for each in done.findings):
        return ()
    compensates = _COMPENSATES_KLARTEXT if is_klartext(done.control) else _COMPENSATES
    lines = enumerate(lines_of(text), 1)
    line = next((number for number, line in lines if compensates.search(without_comments(line.upper()))), None)
    if line is None:
        return ()
    # lines that were not run from another finding's place on are reported there
    ran_before = max((ran for ran in done.moves.lines.tolist() if ran < line), default=0)
    if any(each.code == "NOT_RUN" and ran_before < (each.line or 0) <= line for each in done.findings):
        return ()
    message = "Compensation is programmed here, but no compensated move is run: nothing is judged. "
    message += "Check the loops, jumps and calls that lead here."
    return (Finding("NOT_RUN", Severity.WARNING, message, line=line),)


def _has_no_contour(done: ControlRun, stretch: Stretch) -> bool:
    contour = stretch.programmed.moving_in(stretch.plane)[stretch.entry + 1 :]
    return bool(stretch.radius) and not contour.any() and not done.stops_within(stretch)


def _without_contour(stretch: Stretch) -> Finding:
    text = "Compensation turns on with this move and ends right after it: the move slants, and no contour is judged."
    return Finding("NO-CONTOUR", Severity.WARNING, text, line=int(stretch.programmed.lines[stretch.entry]) or None)


def _answer(done: ControlRun, results: tuple[JudgedContour, ...], before: tuple[Finding, ...], *, shop: bool) -> Answer:
    merged = (*before, *done.findings, *judged_findings(results), *(shop_rules.check_shop_rules(done) if shop else ()))
    errors = [finding for finding in done.findings if finding.severity is Severity.ERROR]
    stop = errors[-1] if errors and done.stopped_at is not None else None
    merged = _without_repeats(merged, done.unit)
    gouge = deepest_gouge(results)
    state, outcome = _outcome(done, results, stop, merged)
    return Answer(
        done.control,
        done.unit,
        done.moves,
        _by_line(merged),
        done.stopped_at,
        outcome,
        stretches=len(done.stretches),
        stop=stop,
        state=state,
        gouge=gouge if gouge[0] else None,
    )


def _without_repeats(findings: tuple[Finding, ...], unit: Unit) -> tuple[Finding, ...]:
    """Drop equal findings of passes at several depths; findings without a place all stay."""
    known: dict[object, Finding] = {}
    for number, finding in enumerate(findings):
        place = number if finding.line is None and finding.at is None else (finding.line, finding.column)
        known.setdefault((finding.code, finding.severity, place, sentence(finding, unit)), finding)
    return tuple(_with_few_alike(known.values(), unit))


def _with_few_alike(findings: Iterable[Finding], unit: Unit) -> Iterator[Finding]:
    """Yield equal information, as on the leads of a hundred holes, only MAX_ALIKE times; count the rest."""
    alike = Counter[tuple[str, str]]()
    left_out: dict[str, list[int | None]] = {}
    for finding in findings:
        repeated = (finding.code, sentence(finding, unit))
        alike[repeated] += 1
        if finding.severity is not Severity.INFO or alike[repeated] <= MAX_ALIKE:
            yield finding
        else:
            left_out.setdefault(finding.code, []).append(finding.line)
    yield from map(finding_of_omitted, left_out, left_out.values())


def _by_line(findings: tuple[Finding, ...]) -> tuple[Finding, ...]:
    return tuple(sorted(findings, key=lambda finding: finding.line or 0))


def _outcome(
    done: ControlRun, results: tuple[JudgedContour, ...], stop: Finding | None, findings: tuple[Finding, ...]
) -> tuple[State, str]:  # fmt: skip
    """Return the state of a run and the words for it, the worst first: an alarm before a gouge, a gouge before what
    cannot be judged."""
    if any(finding.code == EMPTY_CODE for finding in done.findings):
        return State.EMPTY, "has nothing to run"
    cut, line = deepest_gouge(results)
    place = f"at line {line}" if line else "in a lead"
    gouges = f"gouges by {length_text(cut, done.unit)} {place}" if cut else ""
    if done.stopped_at is not None:
        rule = "" if stop is None else stop.code
        state, stops = (
            (State.NOT_FOLLOWED, "cannot be followed past") if rule in NOT_FOLLOWED else (State.ALARM, "alarms at")
        )
        return state, f"{f'{gouges}, then ' if gouges else ''}{stops} line {done.stopped_at} ({rule})"
    if gouges:
        return State.GOUGES, gouges
    unjudged, at = first_unjudged(results)
    if unjudged:
        return State.UNJUDGED, f"cannot be judged at line {at}" if at else "cannot be judged"
    if any(result.verdict.wrong_side for result in results):
        return State.WRONG_SIDE, "runs on the wrong side"
    words = "runs" if done.moves.lines.any() else "moves nothing"
    if any(finding.code in RADIUS_ZERO for finding in done.findings):
        some = any(stretch.radius for stretch in done.stretches)
        part = f", {'not all' if some else 'nothing'} compensated" if words == "runs" else ""
        return State.UNCOMPENSATED, words + part
    if any(finding.severity is Severity.ERROR for finding in findings):
        return State.ERRORS, words
    return State.CLEAN if words == "runs" else State.EMPTY, words


def _parting(parting: Parting, reference: str, unit: Unit) -> str:
    """Return where the paths part, their largest distance and its line; short enough for a line of the screen."""
    where = f"differs from {display_name(reference)} from line {parting.line}"
    return f"{where}, by {length_text(parting.distance, unit)} at line {parting.farthest}"


def _move(move: Move, unit: Unit) -> dict[str, object]:
    x, y, z = (from_mm(value, unit) for value in move.point)
    document: dict[str, object] = {
        "type": "arc" if move.turn else "line",
        "mode": "rapid" if move.rapid else "feed",
        "line": move.line,
        "x": x,
        "y": y,
        "z": z,
    }
    if move.turn:
        cx, cy, cz = (from_mm(value, unit) for value in move.center)
        document |= {"cx": cx, "cy": cy, "cz": cz, "plane": move.plane.name, "ccw": move.turn > 0}
    document["feed"] = None if move.rapid else from_mm(move.feed, unit)
    return document


def _parts_from(parting: Parting, reference: str, unit: Unit) -> dict[str, object]:
    return {
        "control": display_name(reference),
        "line": parting.line,
        "farthest_line": parting.farthest,
        "distance": from_mm(parting.distance, unit),
    }


def _finding(finding: Finding, unit: Unit) -> dict[str, object]:
    return {
        "rule": finding.code,
        "severity": finding.severity.value,
        "line": finding.line,
        "column": finding.column,
        "text": sentence(finding, unit),
        "lengths": [from_mm(length, unit) for length in finding.lengths],
    }


def unreadable(file: str, why: str) -> dict[str, object]:
    """Return the machine-readable object of a file that could not be read."""
    finding: dict[str, object] = {"rule": "UNREADABLE", "severity": "error", "line": None, "column": None}
    nothing: dict[str, object] = {"control": None, "units": None, "state": State.UNREADABLE.value, "stopped_at": None}
    nothing |= {"deepest_gouge": None, "parts_from": None, "stretches": 0, "moves": []}
    return {"file": file, **nothing, "findings": [{**finding, "text": why, "lengths": []}]}


def lines(row: Answer) -> Iterator[str]:
    """Yield an answer as text, a line for each finding and one for the outcome."""
    for finding in row.findings:
        place = "" if finding.line is None else f"{finding.line}:{finding.column or 1}"
        yield f"{place:>9}  {finding.severity.value:<7}  {finding.code:<13}  {sentence(finding, row.unit)}"
    moves, stretches = counted(row.move_count, "move"), counted(row.stretches, "compensated stretch")
    yield f"{row.name}: {row.outcome_and_warnings}; {moves}, {stretches}, {row.unit.value}."


def counted(number: int, what: str) -> str:
    """Return a count with its noun: `1 move`, `2 moves`, `2 compensated stretches`."""
    return f"{number} {what}" if number == 1 else f"{number} {what}{'es' if what.endswith('ch') else 's'}"


def reasons(answers: tuple[Answer, ...]) -> Iterator[str]:
    """Yield each reason for a stop with the controls that stop at that line for it; then the largest tools that fit."""
    stopped: dict[str, list[str]] = {}
    for row in answers:
        if row.stop:
            stopped.setdefault(f"line {row.stopped_at} ({row.stop.code}): {row.stop_reason}", []).append(row.name)
    for reason, names in stopped.items():
        yield f"{' and '.join(filter(None, (', '.join(names[:-1]), names[-1])))} at {reason}"
    for row in answers:
        if row.fits is not None:
            yield f"{row.name}: {sentence(row.fits, row.unit)}"


def same_contours(first: bytes, second: bytes, request: CheckRequest) -> tuple[bool, tuple[str, ...]]:
    """Return whether two programs describe the same contours on the same sides, and a sentence about each contour.

    A program in Klartext runs on that control, any other on the one request for: LinuxCNC for `all` or Klartext.
    """
    first_run, second_run = _read(first, request), _read(second, request)
    pairs = contours(first_run, second_run)
    sentences = [_pair(pair, first_run.unit, second_run.unit) for pair in pairs]
    counts_differ = len(first_run.stretches) != len(second_run.stretches)
    if counts_differ:
        which = counted(len(first_run.stretches), "contour")
        sentences.append(f"The first program has {which}, the second {len(second_run.stretches)}.")
    for name, done in (("first", first_run), ("second", second_run)):
        if done.stopped_at is not None:
            sentences.append(_stopped(f"The {name} program", done))
    if not sentences:
        sentences.append("Neither program has a compensated contour.")
    complete = first_run.stopped_at is None and second_run.stopped_at is None
    return bool(pairs) and complete and not counts_differ and all(pair.same for pair in pairs), tuple(sentences)


def _stopped(name: str, done: ControlRun) -> str:
    why = next((err for err in done.findings if err.line == done.stopped_at and err.severity is Severity.ERROR), None)
    reason = "" if why is None else f" {sentence(why, done.unit)}"
    option = "" if why is None or why.tool is None else f" {tool_option(why.tool)}"
    return f"{name} stops at line {done.stopped_at}; what follows is not compared.{reason}{option}"


def _read(text: bytes, request: CheckRequest) -> ControlRun:
    iso = request.control if request.control not in ("all", "klartext") else "linuxcnc"
    return run(text, "klartext" if reads("klartext", text) else iso, request.tools, request.unit)


def _pair(pair: ContourPair, first: Unit, second: Unit) -> str:
    if pair.same:
        return f"Contour {pair.number}: the same."
    partings = ((pair.first, first, "first"), (pair.second, second, "second"))
    differences = [
        f"line {parting.farthest} of the {name} is {length_text(parting.distance, unit)} {unit.value} off"
        for parting, unit, name in partings
        if parting
    ]
    if not pair.same_side:
        differences.append("the sides or planes differ")
    return f"Contour {pair.number}: {', '.join(differences)}."


MAX_MOVES: Final = 2_000
"""Most moves, and most lines, of a program that is run again and again."""

MAX_TOOLS: Final = 8
"""Most tools of a program that are tried."""

MAX_REDUCTION: Final = 20
"""The smallest size tried is the diameter divided by this: with a tiny tool every fault looks small."""

_NAMED: Final = re.compile(rb'(?:[TD]|CALL|DEF)\s*(?:(\d+)|"([^"]+)")', re.IGNORECASE)
"""How a program names a tool or an offset."""


def largest_tool(
    text: bytes,
    done: ControlRun,
    tools: ToolTable,
    library: ProgramLibrary,
    unit: Unit | None,
    progress: Progress = silent,
) -> Finding | None:
    """Return the tool that is too big for a program that alarms or gouges, and the largest diameter that is clean.

    `done` is the run with the tools as they are.  None if no smaller tool helps: the fault is a different one.
    Each trial reports its own `progress`: the number of trials is not known beforehand.
    """
    if len(done.moves) > MAX_MOVES or text.count(b"\n") > MAX_MOVES:
        return None

    step = 10.0 ** -decimals_shown(Kind.LENGTH, done.unit)

    def fits(tool: CutterTool, size: int) -> bool:
        diameter = step * size if tool.diameter > 0.0 else -step * size
        trial = {**tools, tool.number: replace(tool, diameter=diameter, unit=done.unit)}
        ran = run(text, done.control, trial, unit, library, progress=progress)
        if len(ran.moves) > MAX_MOVES or ran.stopped_at is not None:
            return False
        return deepest_gouge(judge_run(ran, progress))[0] == 0.0

    for tool in _named(text, tools):
        fails = ceil(from_mm(abs(tool.diameter_mm(done.unit)), done.unit) / step - 1e-6)
        clean = fails // MAX_REDUCTION
        if not clean or not fits(tool, clean):
            continue
        while fails - clean > 1:
            size = (clean + fails) // 2
            clean, fails = (size, fails) if fits(tool, size) else (clean, size)
        message = f"Tool {tool.number} is too big; the largest that does not gouge: {{0}}."
        return Finding("TOOL_FITS", Severity.INFO, message, lengths=(to_mm(step * clean, done.unit),))
    return None


def _named(text: bytes, tools: ToolTable) -> tuple[CutterTool, ...]:
    """Return the tools of the table that the text names."""
    names = dict.fromkeys(tool_id((number or name).decode(errors="replace")) for number, name in _NAMED.findall(text))
    named = map(tools.get, names)
    return tuple(tool for tool in named if tool is not None)[:MAX_TOOLS]
