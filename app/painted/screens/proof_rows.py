"""NC PROOF as rows: the listing round the cursor, the findings round theirs, the header, the prompt."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final

from app.painted.screens.page import Drawn, Surface, View
from app.painted.session import Said, Tone
from app.painted.widgets.form import typed_spans
from app.painted.widgets.header import LOOKING, printable, short
from app.painted.widgets.rows import Look, Row, Span, padded, plain
from app.painted.widgets.words import shortened
from core.finding import Finding, Severity
from core.units import Unit, sentence

if TYPE_CHECKING:
    from app.painted.proving import Told
    from app.painted.screens.proof import ProofPage
    from core.draw.scene import Scene
    from core.pipeline.checking import Answer

PROMPT: Final = (
    "Enter types in the line, i o x insert and delete, c control, t tool, v compares, n finding. ? tells all."
)
TYPING: Final = "Enter takes the line and goes on, Esc leaves it as it was."
LARGE: Final = "+ - zoom, arrows move, 0 fits, n and p go from finding to finding. d or Esc goes back."
NOTHING: Final = "The program is empty: i begins a line."
LOOKS: Final = {Severity.ERROR: Look.ERROR, Severity.WARNING: Look.WARNING, Severity.INFO: Look.LABEL}
TONES: Final = {Severity.ERROR: Tone.ERROR, Severity.WARNING: Tone.WARNING, Severity.INFO: Tone.PLAIN}
ORDER: Final = tuple(Severity)
"""The gravest first."""
BEFORE: Final = "of the text before the last change"
MARKS: Final = {Severity.ERROR: "!!", Severity.WARNING: "! ", Severity.INFO: "  "}


def view(page: ProofPage, surface: Surface) -> View:
    """The page on its parts of the terminal."""
    unit = _unit(page)
    return View(
        _header(page, surface.width),
        () if page.large else _listing(page, surface),
        _prompt(page, unit),
        sketch=page.sketch,
        told=_told(page, surface, unit),
        drawn=_drawn(page),
    )


def status(page: ProofPage) -> tuple[str, str]:
    """The program's unit as far as it is known, and what can be undone and redone."""
    return (str(_unit(page)) if page.told else "..", _changes(page))


def _unit(page: ProofPage) -> Unit:
    answer = page.told.answer if page.told is not None else None
    return Unit.IN if answer is None else answer.unit


def _changes(page: ProofPage) -> str:
    done, back = len(page.listing.past), len(page.listing.future)
    return (f"undo {done}" if done else "") + (f"  redo {back}" if back else "")


def _header(page: ProofPage, width: int) -> tuple[Row, ...]:
    """The control and the tools; what comes of it, and the file's name."""
    tools = "  ".join(f"{one.number}={one.diameter:g}" for one in page.asked.tools.tools.values())
    tools = shortened(tools, width - len(f" NC PROOF  {page.control}  tools "))
    first: Row = (Span(" NC PROOF  ", Look.HEAD), Span(page.control, Look.TAG), Span("  tools ", Look.LABEL))
    first = (*first, Span(tools or "none given", Look.TYPED if tools else Look.LABEL))
    name = "no name" if page.file is None else printable(page.file.name)
    name = f" {LOOKING} {short(name, 18)}" if page.looking else f" {short(name)}{'*' if page.unsaved else ''}"
    room = max(width - len(name) - 1, 1)
    return first, (*padded(_outcome(page, room), room), Span(name, Look.WARNING if page.looking else Look.DIM))


def _outcome(page: ProofPage, room: int) -> Row:
    """What the control does, in a few words; of the counts as much as there is room for, in whole words."""
    answer = page.told.answer if page.told is not None else None
    if answer is None:
        return plain(" calculating ...", Look.DIM)
    look = Look.ERROR if answer.errors else Look.WARNING if answer.uncompensated else Look.GOOD
    outcome, counts = answer.outcome, _counts(answer)
    if page.told is not None and page.told.rest is not None:
        look, outcome, counts = Look.WARNING, "gouges not known yet: being judged ...", counts[-1:]
    behind = "" if page.fresh else " ..."
    room -= 1 + len(behind)
    whole = (text for one in counts if len(text := f"{outcome}; {one}") <= room)
    return (Span(f" {next(whole, shortened(outcome, room))}", look), Span(behind, Look.DIM))


def _counts(answer: Answer) -> tuple[str, ...]:
    """How many moves and compensated stretches there are, in fewer and fewer words."""
    from core.pipeline.checking import counted

    moves = counted(answer.count, "move")
    return *(f"{moves}, {counted(answer.stretches, what)}" for what in ("compensated stretch", "contour")), moves


def _listing(page: ProofPage, surface: Surface) -> tuple[Row, ...]:
    """The lines round the cursor, as many as fit."""
    if not len(page.listing):
        return (plain(f" {NOTHING}", Look.LABEL),)
    room = max(surface.body, 1)
    top = max(0, min(page.row - room // 2, len(page.listing) - room))
    marks = _marks(page)
    digits = max(len(str(len(page.listing))), 3)
    rows = range(top, min(top + room, len(page.listing)))
    return tuple(_line(page, row, marks, digits, surface.across) for row in rows)


def _marks(page: ProofPage) -> dict[int, Severity]:
    """The gravest finding of each line; none while the answer is to other lines."""
    found: dict[int, Severity] = {}
    for finding in page.findings if page.fresh else ():
        if finding.line is not None:
            found[finding.line] = min(found.get(finding.line, Severity.INFO), finding.severity, key=ORDER.index)
    return found


def _line(page: ProofPage, row: int, marks: dict[int, Severity], digits: int, width: int) -> Row:
    on_it = row == page.row
    severity = marks.get(row + 1)
    number = Span(f"{row + 1:>{digits}}", Look.LABEL if severity is None else LOOKS[severity])
    mark = Span(" " if severity is None else MARKS[severity][0], number.look)
    room = max(width - digits - 3, 1)
    if on_it and page.editing is not None:
        shown = replace(page.editing, text=_shown(page.editing.text))
        return (number, mark, Span(">", Look.TAG), *typed_spans(shown, room, right=False))
    text = _shown(page.listing.text(row)[:room])
    return (number, mark, Span(">" if on_it else " ", Look.TAG), _text(text, room, page, on_it=on_it))


def _shown(text: str) -> str:
    """A tab is a blank here: every sign takes one cell."""
    return text.replace("\t", " ")


def _text(text: str, room: int, page: ProofPage, *, on_it: bool) -> Span:
    """The cursor's line over the whole width; while the findings have the cursor, only marked."""
    if not on_it:
        return Span(text, Look.TYPED)
    return Span(f"{text:<{room}}", Look.CURSOR if not page.telling else Look.CURRENT)


def _told(page: ProofPage, surface: Surface, unit: Unit) -> tuple[Row, ...]:
    """The findings round the one with the cursor, under a line that counts them."""
    room = max(surface.told - 1, 1)
    top = max(0, min(page.at - room // 2, len(page.findings) - room))
    shown = page.findings[top : top + room]
    texts = [_finding(one, unit) for one in shown]
    wide = max(surface.below - 3, 1)
    rows = [_marked(page, top + index, shortened(text, wide)) for index, text in enumerate(texts)]
    return (_count(page, cut=any(len(text) > wide for text in texts)), *rows)


def _count(page: ProofPage, *, cut: bool) -> Row:
    count = len(page.findings)
    text = count_of(page) if page.current is not None else f"{count}" if count else "none"
    text = " FINDINGS" if page.told is None else f" FINDINGS  {text}"
    behind = f"   {BEFORE}" if not page.fresh else "   Ctrl+F shows them whole" if cut else ""
    return (Span(text, Look.HEAD), Span(behind, Look.DIM))


def count_of(page: ProofPage) -> str:
    """Which finding of how many has the mark."""
    return f"{page.at + 1} of {len(page.findings)}" if page.findings else "none"


def place(one: Finding) -> str:
    """Line and column of a finding, as far as it has them."""
    return "" if one.line is None else f"{one.line}:{one.column or 1}"


def _finding(one: Finding, unit: Unit) -> str:
    return f"{MARKS[one.severity]} {place(one):>6} {one.code:<9} {sentence(one, unit)}"


def _marked(page: ProofPage, index: int, text: str) -> Row:
    on_it = index == page.at and page.current is not None
    look = Look.CURSOR if page.telling and on_it else LOOKS[page.findings[index].severity]
    return (Span("> " if on_it else "  ", Look.TAG), Span(text, look))


def _prompt(page: ProofPage, unit: Unit) -> Said:
    """What is being done; else the finding that the cursor is on, by its own text; else the keys."""
    if page.editing is not None:
        return Said(TYPING)
    if (one := page.current) is not None:
        return Said(told(one, unit), TONES[one.severity])
    return Said(LARGE if page.large else PROMPT)


def told(one: Finding, unit: Unit) -> str:
    """A finding whole."""
    return f"{one.code}: {sentence(one, unit)}"


def _drawn(page: ProofPage) -> Drawn:
    """The drawing: the last answer's, with the cutter at the cursor's line."""
    told, line = page.told, page.row + 1
    return Drawn((told, line), lambda: _scene(told, line))


def _scene(told: Told | None, line: int) -> Scene:
    from core.draw.scene import Scene
    from core.pipeline.nc_proof import scene_at_line

    if told is None or told.proof is None or told.ground is None:
        return Scene()
    return scene_at_line(told.ground, told.proof, line)
