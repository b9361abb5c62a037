"""What the screens ask of the App, as frozen messages; only the App changes the session and touches files."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from app.session import SEGMENT, Tone
from core.program.edit import Edited, Where

if TYPE_CHECKING:
    from app.screens.page import Page


@dataclass(frozen=True, eq=False, slots=True)
class Edit:
    """A change of the program, made or refused; `label` is what undo calls it."""

    outcome: Edited
    label: str


@dataclass(frozen=True, slots=True)
class Move:
    """The cursor goes to a field of the MILL CONTOUR form."""

    where: Where
    field: str = SEGMENT


@dataclass(frozen=True, slots=True)
class Say:
    """A sentence for the prompt line."""

    text: str
    tone: Tone = Tone.PLAIN


@dataclass(frozen=True, slots=True)
class Undo:
    """Take back the last change."""


@dataclass(frozen=True, slots=True)
class Redo:
    """Make the last undone change again."""


@dataclass(frozen=True, slots=True)
class Open:
    """Put a screen on top of this one."""

    page: Page


@dataclass(frozen=True, slots=True)
class Close:
    """Back to the screen below."""


@dataclass(frozen=True, slots=True)
class Swap:
    """Put a screen in the place of this one."""

    page: Page


@dataclass(frozen=True, slots=True)
class NextMode:
    """Draw with the next set of characters: braille, half blocks, ASCII."""


@dataclass(frozen=True, slots=True)
class Save:
    """Write the program to `path`, to its own file when None; `overwrite` says that the operator agreed."""

    path: Path | None = None
    overwrite: bool = False
    leave: bool = False
    """Leave the program once it is saved."""


@dataclass(frozen=True, slots=True)
class Browse:
    """Show the programs in a folder, in that of the program when None."""

    folder: Path | None = None


@dataclass(frozen=True, slots=True)
class Load:
    """Work on the program in a file, on an empty one when None; `unsaved` gives up what is not saved."""

    path: Path | None
    unsaved: bool = False


@dataclass(frozen=True, slots=True)
class Post:
    """Write the NC file; `override` is the sentence the operator typed to post in spite of the findings."""

    path: Path
    overwrite: bool = False
    override: str | None = None


@dataclass(frozen=True, slots=True)
class Leave:
    """End the program; `unsaved` says that the operator agreed to lose what is not saved."""

    unsaved: bool = False


Message = Edit | Move | Say | Undo | Redo | Open | Swap | Close | NextMode | Save | Browse | Load | Post | Leave
