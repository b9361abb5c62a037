"""What stays from one time to the next: recent files, the drawing's characters, the unit of new programs, the folder.

Kept as TOML in the platform's own folder for settings.  A file of settings that cannot be read or written never stops
the program: one sentence says so, and the usual values hold.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Final

from app.documents.files import LARGEST_FILE, write_text
from app.painted.session import Tone
from core.program.file.read import StoreError
from core.units import Unit

if TYPE_CHECKING:
    from app.painted.desk import Desk

MOST: Final = 8
"""Recent files that are remembered."""
KNOWN_MODES: Final = ("braille", "block", "ascii")


@dataclass(frozen=True, slots=True)
class Settings:
    """`recent` are absolute paths, the last used first; `mode` and `folder` are empty until they are chosen."""

    recent: tuple[str, ...] = ()
    mode: str = ""
    unit: Unit = Unit.IN
    folder: str = ""

    def using(self, file: Path) -> Settings:
        """After a program was opened or saved; a name that no settings file can hold is not remembered."""
        here = file.absolute()
        name = str(here)
        if not name.isprintable():
            return self
        others = tuple(one for one in self.recent if one != name)
        return replace(self, recent=(name, *others)[:MOST], folder=str(here.parent))


def place() -> Path:
    """The file of this person's settings."""
    from platformdirs import user_config_path

    return user_config_path("cutcomp", appauthor=False) / "settings.toml"


def loads(text: str) -> Settings:
    """Settings from a file's text; what is of no use in it is passed over.  ValueError when it is no TOML."""
    import tomllib

    held = tomllib.loads(text)
    recent = held.get("recent")
    mode, unit = held.get("mode"), held.get("unit")
    return Settings(
        tuple(filter(_usable, recent))[:MOST] if isinstance(recent, list) else (),
        mode if mode in KNOWN_MODES else "",
        Unit(unit) if unit in tuple(Unit) else Unit.IN,
        held["folder"] if _usable(held.get("folder")) else "",
    )


def _usable(name: object) -> bool:
    """A path as `Settings.using` writes it."""
    return isinstance(name, str) and name.isprintable() and Path(name).is_absolute()


def dumps(settings: Settings) -> str:
    """The text of a settings file."""
    recent = "".join(f"  {_quoted(name)},\n" for name in settings.recent)
    lines = (
        "# cutcomp writes this file anew; what else is put into it is lost",
        f"unit = {_quoted(settings.unit)}",
        f"mode = {_quoted(settings.mode)}",
        f"folder = {_quoted(settings.folder)}",
        f"recent = [\n{recent}]",
    )
    return "\n".join(lines) + "\n"


def _quoted(text: str) -> str:
    return json.dumps(str(text), ensure_ascii=False).replace("\x7f", "\\u007f")


def load(path: Path) -> tuple[Settings, str]:
    """The settings in a file, and the sentence that says why they are the usual ones, empty if they are not."""
    try:
        with path.open("rb") as file:
            return loads(file.read(LARGEST_FILE).decode()), ""
    except FileNotFoundError:
        return Settings(), ""
    except (OSError, ValueError) as error:
        why = error.strerror if isinstance(error, OSError) else "it is no settings file"
        return Settings(), f"Your settings in {path} cannot be read: {why}. The usual ones hold."


def taken_up(desk: Desk, settings: Settings, trouble: str) -> Desk:
    """The desk with what stays from one time to the next; where it could not be read, the prompt line says so."""
    desk = replace(desk, settings=settings, mode=settings.mode or desk.mode)
    return replace(desk, session=desk.session.saying(trouble, Tone.WARNING)) if trouble else desk


@dataclass(slots=True)
class Keeper:
    """Writes settings when they change; `path` None keeps them for this time only."""

    path: Path | None = None
    written: Settings = field(default_factory=Settings)
    file: Path | None = None
    failed: bool = False

    def keep(self, desk: Desk) -> Desk:
        """After a key: remember the program's file, and put changed settings on the disk."""
        file = desk.session.file
        if file is not self.file and file is not None and file.exists():
            desk = replace(desk, settings=desk.settings.using(file))
            self.file = file
        if desk.settings == self.written:
            return desk
        return self._write(desk)

    def _write(self, desk: Desk) -> Desk:
        self.written = desk.settings
        if self.path is None or self.failed:
            return desk
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            write_text(self.path, dumps(desk.settings))
        except (OSError, StoreError) as error:
            self.failed = True
            said = f"Settings are not kept: {error}"
            return desk if desk.session.said else replace(desk, session=desk.session.saying(said))
        return desk
