"""Points in time: in ISO format with their zone, and in words."""

from __future__ import annotations

from datetime import datetime

from core.units import printable


def now() -> str:
    """This second."""
    return datetime.now().astimezone().isoformat(timespec="seconds")


def of(nanoseconds: int) -> str:
    """A file's time."""
    try:
        return datetime.fromtimestamp(nanoseconds / 1e9).astimezone().isoformat(timespec="seconds")
    except (OverflowError, OSError, ValueError):
        return ""


def in_words(text: str, today: str) -> str:
    """`at 14:05`, `on 3 May 2025 at 14:05`; a time that cannot be read as it stands."""
    try:
        time, day = datetime.fromisoformat(text), datetime.fromisoformat(today)
    except ValueError:
        return f"at {printable(text) or 'an unknown time'}"
    if time.date() == day.date():
        return f"at {time:%H:%M}"
    return f"on {time.day} {time:%b %Y} at {time:%H:%M}"


def short(text: str, today: str) -> str:
    """`12:32 today`, `3 May 2025 12:32`; a time that cannot be read as it stands."""
    try:
        time, day = datetime.fromisoformat(text), datetime.fromisoformat(today)
    except ValueError:
        return printable(text) or "at an unknown time"
    if time.date() == day.date():
        return f"{time:%H:%M} today"
    return f"{time.day} {time:%b %Y %H:%M}"


def stamp(text: str) -> str:
    """A time as part of a file's name."""
    return "".join(character for character in text[:19].replace("T", "-") if character.isdigit() or character == "-")
