"""Numbers in the words of the screens: lengths in program units, runs of segment numbers."""

from __future__ import annotations

from collections.abc import Iterable

from core.finding import Finding
from core.units import Kind, Unit, from_mm, sentence, show


def length(millimeters: float, unit: Unit) -> str:
    """A length in millimeters as the form prints it."""
    return show(from_mm(millimeters, unit), Kind.LENGTH, unit)


def place(point: tuple[float, float], unit: Unit) -> str:
    """A point in millimeters as `X 1.0000 Y 2.0000`."""
    return f"X {length(point[0], unit)} Y {length(point[1], unit)}"


def shortened(text: str, width: int) -> str:
    """The text in at most `width` cells: what does not fit is left out by whole words, so that no number is cut."""
    if len(text) <= width:
        return text
    kept = text[:width].rpartition(" ")[0].rstrip(" ,;:")
    return f"{kept} …" if len(kept) + 2 <= width else f"{kept}…"[:width]


def number(segment: float) -> str:
    """A segment's number; the corner arc behind segment 3, which is 3.5, stands between two segments."""
    return f"{segment:g}" if segment == int(segment) else f"corner {_between(segment)}"


def pair(first: float, second: float) -> str:
    """Two segments or corners, as `number` tells each."""
    if first != int(first) and second != int(second):
        return f"corners {_between(first)} and {_between(second)}"
    return f"{number(first)} and {number(second)}"


def _between(corner: float) -> str:
    return f"{int(corner)}-{int(corner) + 1}"


def segment(place: float) -> str:
    """A segment by its number, or a corner by those of its segments."""
    return f"segment {place:g}" if place == int(place) else number(place)


def placed(finding: Finding, unit: Unit) -> str:
    """A finding's sentence behind its segment."""
    where = "" if finding.segment is None else f"{segment(finding.segment).capitalize()}: "
    return f"{where}{sentence(finding, unit)}"


def in_spite(overridden: Iterable[Finding]) -> str:
    """In spite of what a path was posted, in the words of `core.output.objections.OVERRIDABLE`."""
    wrong_side_alone = all(finding.code == "WRONG_SIDE" for finding in overridden)
    return f"in spite of {'a cut on the wrong side' if wrong_side_alone else 'a gouge'}"


def numbers(segments: Iterable[float]) -> str:
    """Programmed segment numbers with neighbors joined: 2-4 7.  Corner arcs are left out."""
    whole = sorted({int(segment) for segment in segments if segment == int(segment)})
    runs: list[list[int]] = []
    for one in whole:
        if runs and runs[-1][1] == one - 1:
            runs[-1][1] = one
        else:
            runs.append([one, one])
    return " ".join(str(first) if first == last else f"{first}-{last}" for first, last in runs)
