"""The keys of NC PROOF: softkeys, their plain twins, and the help on them."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final

from app.painted.messages import Message, NextMode, Open, Say
from app.painted.proving import Question
from app.painted.screens.draw import ARROWS, STEP, followed, panned, zoomed
from app.painted.screens.page import WHOLE, Answer, Softkey, Softkeys
from app.painted.screens.proof_compare import ComparePage
from app.painted.screens.proof_files import SaveListing, saving
from app.painted.screens.proof_findings import ProofFindings
from app.painted.screens.proof_tool import GoTo, ToolSize, stepped

if TYPE_CHECKING:
    from app.painted.screens.proof import ProofPage

HELP: Final = (
    "NC PROOF",
    "The listing on the left, what the control makes of it on the right, the findings below; Tab changes between the "
    "listing and the findings. Up and down walk, the cutter stands where the line under the cursor leaves it.",
    "Enter types in the line, Enter takes it, Esc leaves it as it was. i and o put a new line before and behind, x or "
    "Delete takes the line out, u undoes, r does it again, s saves, S saves under another name.",
    "n and p go to the next finding and the one before; f or Ctrl+F shows all of them, each whole. g goes to a line.",
    "c and C try the next control and the one before; v compares all of them.",
    "t gives a tool another diameter, < and > make it a little smaller and larger: the verdict follows.",
    "+ and - zoom on the cutter, 0 shows everything, d gives the drawing the whole terminal, where the arrows move it: "
    "from then on + and - zoom on its middle, until n or p brings the cutter back.",
    "In the drawing: the programmed contour, the path of the tool's center, dashed rapids, ! where it gouges.",
)


FIRST: Final = (
    "DELETE LINE",
    "INSERT LINE BEFORE",
    "NEXT CONTROL",
    "TOOL DIAMETER",
    "COMPARE CONTROLS",
    "NEXT FINDING",
    "MORE",
    "EXIT",
)
SECOND: Final = ("UNDO", "REDO", "CONTROL BEFORE", "GO TO LINE", "SAVE", "SAVE AS", "MORE", "EXIT")
LETTERS: Final = ("xictvn", "urCgsS")
"""What F1 to F6 do, as letters, in both sets."""


NONE: Final = "There are no findings."
CHANGING: Final = "ioxur"
"""Letters that change the text."""


def softkeys(page: ProofPage) -> Softkeys:
    """The labels of the set that is shown; what they do is worked out when one is pressed."""
    return {number: Softkey(label) for number, label in enumerate(SECOND if page.second else FIRST, 1)}


def chosen(page: ProofPage, number: int) -> Answer:
    """What a softkey does."""
    if number == 7:
        return Answer(replace(page, second=not page.second))
    if number == 8:
        return Answer(page, page.left())
    return _lettered(page, LETTERS[page.second][number - 1]) or Answer(page)


def pressed(page: ProofPage, key: str, character: str | None) -> Answer | None:
    """A key over the listing, the findings or the drawing."""
    if page.large and key in ARROWS:
        return Answer(replace(page, sketch=panned(page.sketch, *ARROWS[key])))
    if key == "enter":
        return Answer(replace(page, telling=False)) if page.telling else page.edited()
    if key in ("tab", "shift+tab"):
        return _over_findings(page)
    if key == "delete":
        return _lettered(page, "x")
    if character in ("+", "=", "-"):
        return Answer(replace(page, sketch=zoomed(page.sketch, 1 / STEP if character == "-" else STEP)))
    return _lettered(page, character or "")


def _lettered(page: ProofPage, letter: str) -> Answer | None:
    if page.looking and letter and letter in CHANGING:
        return page.refused()
    match letter:
        case "i" | "o":
            return inserted(page, 0 if letter == "i" else 1)
        case "x":
            return deleted(page)
        case "u" | "r":
            return turned_back(page) if letter == "u" else done_again(page)
        case "c" | "C":
            return on_control(page, 1 if letter == "c" else -1)
        case "n" | "p":
            return next_finding(page, 1 if letter == "n" else -1)
        case "<" | ">":
            return stepped(page, 1 if letter == ">" else -1)
        case "0" | "d":
            return Answer(replace(page, sketch=WHOLE) if letter == "0" else replace(page, large=not page.large))
        case _:
            return _asking(page, letter)


def _asking(page: ProofPage, letter: str) -> Answer | None:
    """Letters that open something."""
    if letter == "f" and not page.findings:
        return Answer(page, (Say(NONE),))
    messages: dict[str, tuple[Message, ...]] = {"f": (Open(ProofFindings(page)),)}
    messages |= {"m": (NextMode(),), "g": (Open(GoTo()),)}
    messages |= {"t": (Open(ToolSize.of(page)),), "v": compared(page)}
    messages |= {"s": saved(page), "S": (Open(SaveListing.of(page)),)}
    return Answer(page, messages[letter]) if letter in messages else None


def _over_findings(page: ProofPage) -> Answer:
    if not page.findings:
        return Answer(page, (Say(NONE),))
    page = replace(page, telling=not page.telling)
    return Answer(page.at_finding(page.at) if page.telling else page)


def inserted(page: ProofPage, behind: int) -> Answer:
    """A new line before or behind the cursor, being typed."""
    row = min(page.row + behind, len(page.listing))
    page = page.asking(listing=page.listing.inserted(row))
    return page.at_row(row).edited()


def deleted(page: ProofPage) -> Answer:
    """Without the line under the cursor."""
    if not len(page.listing):
        return Answer(page, (Say("There is no line."),))
    page = page.asking(listing=page.listing.deleted(page.row))
    return Answer(page.at_row(page.row))


def turned_back(page: ProofPage) -> Answer:
    """Without the last change, the cursor where it was."""
    if not page.listing.past:
        return Answer(page, (Say("There is nothing to undo."),))
    row = page.listing.past[-1].row
    return Answer(page.asking(listing=page.listing.undone()).at_row(row), (Say("Undone. r brings it back."),))


def done_again(page: ProofPage) -> Answer:
    """With the last undone change."""
    if not page.listing.future:
        return Answer(page, (Say("There is nothing to redo."),))
    row = page.listing.future[-1].row
    return Answer(page.asking(listing=page.listing.redone()).at_row(row), (Say("Done again."),))


def on_control(page: ProofPage, step: int) -> Answer:
    """The next control or variant; which there are is known once the numeric library is loaded."""
    from core.controls.registry import names

    every = names()
    control = every[(every.index(page.control) + step) % len(every)]
    return Answer(page.asking(control=control), (Say(f"Tried on {control}."),))


def next_finding(page: ProofPage, step: int) -> Answer:
    """To the finding behind the one the cursor is on, or behind its line; or to the one before."""
    lines = [(one.line or 0, index) for index, one in enumerate(page.findings)]
    here = (page.row + 1, page.at) if page.current is None else lines[page.at]
    if step > 0:
        there = next((index for line, index in lines if (line, index) > here), None)
    else:
        there = next((index for line, index in reversed(lines) if (line, index) < here), None)
    if there is None:
        return Answer(page, (Say("There is no further finding."),))
    return Answer(replace(page.at_finding(there), sketch=followed(page.sketch)))


def compared(page: ProofPage) -> tuple[Message, ...]:
    """All controls side by side."""
    now = page.asked
    return (Open(ComparePage(Question(now.listing, None, now.tools, now.unit), here=page.control)),)


def saved(page: ProofPage) -> tuple[Message, ...]:
    """Under its own name, or asking for one."""
    return (Open(SaveListing.of(page)),) if page.file is None else (saving(),)
