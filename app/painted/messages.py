"""What the screens ask of the App, as frozen messages; only the App changes the session and touches files."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from app.painted.session import SEGMENT, Tone
from core.program.edit import Edited, FormPlace

if TYPE_CHECKING:
    from app.painted.desk import Desk
    from app.painted.screens.page import Page


class Edit(NamedTuple):
    """A change of the program, made or refused; `label` is what undo calls it."""

    outcome: Edited
    label: str


class Move(NamedTuple):
    """The cursor goes to a field of the MILL CONTOUR form."""

    where: FormPlace
    field: str = SEGMENT


class Say(NamedTuple):
    """A sentence for the prompt line; one that `stays` does so while the cursor walks."""

    text: str
    tone: Tone = Tone.PLAIN
    stays: bool = False


class Undo(NamedTuple):
    """Take back the last change."""


class Redo(NamedTuple):
    """Make the last undone change again."""


class Open(NamedTuple):
    """Put a screen on top of this one; what makes it is called when it is opened."""

    page: Page | Callable[[], Page]


class Close(NamedTuple):
    """Back to the screen below."""


class Swap(NamedTuple):
    """Put a screen in the place of this one."""

    page: Page


class NextMode(NamedTuple):
    """Draw with the next set of characters: braille, half blocks, ASCII."""


class Save(NamedTuple):
    """Write the program to `path`, to its own file when None; `overwrite` says that the operator agreed."""

    path: Path | None = None
    overwrite: bool = False
    leave: bool = False
    """Leave the program once it is saved."""
    linked: bool = False
    """The operator agreed to write where a link leads, or outside the folder of the program."""
    taken: bool = False
    """The operator agreed to write although somebody has taken the program over."""
    changed: bool = False
    """The operator agreed that what somebody else wrote meanwhile becomes a copy."""


class Browse(NamedTuple):
    """Show the programs in a folder, in that of the program when None."""

    folder: Path | None = None


class Load(NamedTuple):
    """Work on the program in a file, on an empty one when None; `unsaved` gives up what is not saved.

    `earlier` is a journal that was set aside, whose work is offered then.
    """

    path: Path | None
    unsaved: bool = False
    earlier: Path | None = None


class Post(NamedTuple):
    """Write the NC file; `override` is the sentence the operator typed to post in spite of the findings.

    `control` is the full name of the control that is to compensate by itself, None for the path of the tool's center.
    `linked` says that the operator agreed to write outside the folder of the program, `clear` that nothing was found to
    stand against posting: what takes long is then calculated behind the questions.
    """

    path: Path
    overwrite: bool = False
    override: str | None = None
    control: str | None = None
    linked: bool = False
    clear: bool = False


class Leave(NamedTuple):
    """End the program; `unsaved` says that the operator agreed to lose what is not saved."""

    unsaved: bool = False


class Do(NamedTuple):
    """Work on the whole desk that touches files, such as writing a setup sheet; trouble becomes a sentence."""

    work: Callable[[Desk], Desk]


Message = Do | Edit | Move | Say | Undo | Redo | Open | Swap | Close | NextMode | Save | Browse | Load | Post | Leave
