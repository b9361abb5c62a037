"""This module keeps settings between runs, in a TOML file in the platform's folder for them.

A settings file that cannot be read or written never stops the program: one sentence says so, and the defaults apply.
"""

from __future__ import annotations

import json
import tomllib
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Final

from app.documents.files import read_file, why, write_text
from core.program.file.read import StoreError

MAX_FILES_WITH_TOOLS: Final = 100
"""The most NC programs whose tools are remembered."""
MAX_SETTINGS_BYTES: Final = 1_000_000
CHARACTER_SETS: Final = ("braille", "block", "ascii")
"""The character sets that a drawing can be made of."""
THEMES: Final = ("dark", "light")


@dataclass(frozen=True, slots=True)
class Settings:
    """A user's settings; a text is empty until a value is chosen.

    `folder` is that of the last file opened or saved, `control` the full name of the control that NC programs run on.
    `tools` pairs the absolute path of an NC program with the diameters given to its tools, such as `1=0.5in 2=12.0mm`;
    the last given comes first.
    """

    characters: str = ""
    theme: str = ""
    folder: str = ""
    mouse: bool = False
    control: str = ""
    tools: tuple[tuple[str, str], ...] = ()

    def tools_of(self, file: Path) -> str:
        """Return the tools that were given to an NC program, empty for none."""
        return dict(self.tools).get(str(file.absolute()), "")

    def with_tools(self, file: Path, text: str) -> Settings:
        """Return the settings after an NC program was given these tools."""
        name = str(file.absolute())
        if not name.isprintable():
            return self
        others = tuple(pair for pair in self.tools if pair[0] != name)
        return replace(self, tools=((name, text), *others)[:MAX_FILES_WITH_TOOLS])

    def using(self, file: Path | None) -> Settings:
        """Return the settings after a file was opened or saved; an unprintable path is not remembered."""
        folder = "" if file is None else str(file.absolute().parent)
        return replace(self, folder=folder) if folder and folder.isprintable() else self


def settings_file() -> Path:
    """Return the path of the user's settings file."""
    from platformdirs import user_config_path

    return user_config_path("cutcomp", appauthor=False) / "settings.toml"


def parsed(text: str) -> Settings:
    """Return the settings in a file's text, without unusable values; raise ValueError if it is not TOML."""
    held = tomllib.loads(text)
    tools = held["tools"].items() if isinstance(held.get("tools"), dict) else ()
    usable = tuple((name, diameters) for name, diameters in tools if _is_path(name) and isinstance(diameters, str))
    # older files call the characters `mode`
    characters = held.get("characters", held.get("mode"))
    return Settings(
        characters if characters in CHARACTER_SETS else "",
        held["theme"] if held.get("theme") in THEMES else "",
        held["folder"] if _is_path(held.get("folder")) else "",
        held.get("mouse") is True,
        held["control"] if isinstance(held.get("control"), str) else "",
        usable[:MAX_FILES_WITH_TOOLS],
    )


def _is_path(name: object) -> bool:
    """True for a path such as `Settings.using` and `Settings.with_tools` write."""
    return isinstance(name, str) and name.isprintable() and Path(name).is_absolute()


def written(settings: Settings) -> str:
    """Return the text of a settings file."""
    single = [(each.name, getattr(settings, each.name)) for each in fields(settings) if each.name != "tools"]
    lines = (
        "# cutcomp writes this file anew; what else is put into it is lost",
        *(f"{name} = {_quoted(value)}" for name, value in single),
        "[tools]",
        *(f"{_quoted(name)} = {_quoted(text)}" for name, text in settings.tools),
    )
    return "\n".join(lines) + "\n"


def _quoted(value: str | bool) -> str:
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")


def load_settings(path: Path) -> tuple[Settings, str]:
    """Return a file's settings, and a sentence that says why it cannot be read, empty if it can or does not exist."""
    try:
        return parsed(read_file(path, MAX_SETTINGS_BYTES)[0].decode()), ""
    except FileNotFoundError:
        return Settings(), ""
    except (OSError, ValueError, RecursionError) as error:
        reason = why(error).partition(".")[0] if isinstance(error, OSError) else "it is no settings file"
        return Settings(), f"Your settings in {path} cannot be read: {reason}. The usual ones hold."


@dataclass(slots=True)
class SettingsFile:
    """Writes settings when they change; with `path` None they last for this run only."""

    path: Path | None = None
    settings: Settings = field(default_factory=Settings)
    failed: bool = False

    def keep(self, settings: Settings) -> str:
        """Write changed settings to disk; return the sentence that says why they cannot be kept, only once."""
        if settings == self.settings:
            return ""
        self.settings = settings
        if self.path is None or self.failed:
            return ""
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            write_text(self.path, written(settings))
        except (OSError, StoreError) as error:
            self.failed = True
            return f"Settings are not kept: {why(error) if isinstance(error, OSError) else error}"
        return ""
