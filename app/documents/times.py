"""This module writes points in time in ISO format with their zone, and in words."""

from __future__ import annotations

from datetime import datetime

from core.units import printable


def now() -> str:
    """Return the current time, to the second."""
    return datetime.now().astimezone().isoformat(timespec="seconds")


def of_file(nanoseconds: int) -> str:
    """Return a file's time, given in nanoseconds since 1970; empty if it is out of range."""
    try:
        return datetime.fromtimestamp(nanoseconds / 1e9).astimezone().isoformat(timespec="seconds")
    except (OverflowError, OSError, ValueError):
        return ""


def in_words(text: str, today: str) -> str:
    """Return `12:32 today`, or `3 May 2025 12:32` for another day; the text itself if it cannot be read."""
    try:
        time, day = datetime.fromisoformat(text), datetime.fromisoformat(today)
    except ValueError:
        return printable(text) or "at an unknown time"
    if time.date() == day.date():
        return f"{time:%H:%M} today"
    return f"{time.day} {time:%b %Y %H:%M}"


def for_file_name(text: str) -> str:
    """Return a time as part of a file's name, such as `2025-03-04-140509`."""
    return "".join(character for character in text[:19].replace("T", "-") if character.isdigit() or character == "-")
