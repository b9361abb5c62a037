"""This module formats lengths, points, counts and segment numbers the same way for every screen."""

from __future__ import annotations

from collections.abc import Iterable

from core.units import Kind, Unit, from_mm, show


def length(millimeters: float, unit: Unit) -> str:
    """Return a length given in millimeters, in program units, as the form prints it."""
    return show(from_mm(millimeters, unit), Kind.LENGTH, unit)


def place(point: tuple[float, float], unit: Unit) -> str:
    """Return a point given in millimeters as `X 1.0000 Y 2.0000`, in program units."""
    return f"X {length(point[0], unit)} Y {length(point[1], unit)}"


def counted(count: int, word: str) -> str:
    """Return `1 move`, `2 moves`."""
    return f"{count} {word}{'' if count == 1 else 's'}"


def segment_numbers(numbers: Iterable[float]) -> str:
    """Return segment numbers with runs joined: 2-4 7.  Corner arcs are left out."""
    whole = sorted({int(number) for number in numbers if number == int(number)})
    runs: list[list[int]] = []
    for number in whole:
        if runs and runs[-1][1] == number - 1:
            runs[-1][1] = number
        else:
            runs.append([number, number])
    return " ".join(str(first) if first == last else f"{first}-{last}" for first, last in runs)


def shortened(text: str, width: int) -> str:
    """Return the text in at most `width` cells, cut between words if possible, so that no number is cut."""
    if len(text) <= width:
        return text
    kept = text[:width].rpartition(" ")[0].rstrip(" ,;:")
    return f"{kept} …" if len(kept) + 2 <= width else f"{kept}…"[:width]


def cut_in_middle(text: str, width: int) -> str:
    """Return the text in at most `width` characters, cut in the middle, so that its beginning and its end stay."""
    if len(text) <= width:
        return text
    end = max(width - 1, 0) // 2
    return f"{text[: max(width - 1 - end, 0)]}…{text[len(text) - end :]}"
