"""Words: lengths in program units, places and segment numbers as every screen writes them."""

from __future__ import annotations

from collections.abc import Iterable

from core.units import Kind, Unit, from_mm, show


def length(millimeters: float, unit: Unit) -> str:
    """A length in millimeters as the form prints it."""
    return show(from_mm(millimeters, unit), Kind.LENGTH, unit)


def place(point: tuple[float, float], unit: Unit) -> str:
    """A point in millimeters as `X 1.0000 Y 2.0000`."""
    return f"X {length(point[0], unit)} Y {length(point[1], unit)}"


def counted(count: int, word: str) -> str:
    """`1 move`, `2 moves`."""
    return f"{count} {word}{'' if count == 1 else 's'}"


def segment_numbers(numbers: Iterable[float]) -> str:
    """Numbers of segments, runs joined: 2-4 7.  Corner arcs are left out."""
    whole = sorted({int(number) for number in numbers if number == int(number)})
    runs: list[list[int]] = []
    for number in whole:
        if runs and runs[-1][1] == number - 1:
            runs[-1][1] = number
        else:
            runs.append([number, number])
    return " ".join(str(first) if first == last else f"{first}-{last}" for first, last in runs)


def shortened(text: str, width: int) -> str:
    """The text in at most `width` cells: what does not fit is left out by whole words, so that no number is cut."""
    if len(text) <= width:
        return text
    kept = text[:width].rpartition(" ")[0].rstrip(" ,;:")
    return f"{kept} …" if len(kept) + 2 <= width else f"{kept}…"[:width]
