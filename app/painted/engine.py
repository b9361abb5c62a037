"""What is calculated behind the screens, and when: at once while it is fast, in a thread while it is not.

The numeric library takes longer to load than the first screen to stand: until it is there, the form shows what
needs no library, and a thread fetches the rest.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from importlib import import_module
from math import inf
from time import thread_time
from typing import TYPE_CHECKING, Final, NamedTuple, TypeVar

from app.painted.memory import Memory
from app.painted.screens.page import Drawn, Sketch
from app.painted.widgets.rows import Row
from app.painted.widgets.verdict import fitted, verdict_rows
from core.advice.block_paths import BlockPaths
from core.pipeline.derived import Derived, DerivedBlock
from core.pipeline.outline import outline
from core.program.model import Program

if TYPE_CHECKING:
    from app.painted.desk import Desk
    from app.painted.screens.page import Page, Surface, View
    from app.painted.session import Session
    from core.advice.lookahead_table import Table
    from core.finding import Finding

NUMERIC: Final = ("core.pipeline.derive", "core.pipeline.derive", "app.painted.widgets.drawing")
"""Modules that need the numeric library."""
FAST: Final = 0.033
"""Seconds of work, two pictures of sixty a second: what took no longer lately is done before the next picture.

In a thread, with pictures of their own in between, the same path and table take half as long again.
"""
OLD: Final = 0.5
"""How much a measurement counts beside the next one: a wild contour of half a number is followed by a tame one."""

KEPT: Final = 4
"""So many derived programs and tables are kept: two megabytes each time at a thousand segments."""

Result = TypeVar("Result")


@dataclass(frozen=True, eq=False, slots=True)
class Known:
    """What is known besides the session: the table of the block with the cursor, and whether drawing is possible."""

    table: Table | None = None
    ready: bool = False
    memory: Memory = field(default_factory=Memory)
    trial: Session | None = None
    """The session as it would be with the half-typed number accepted."""

    def view(self, page: Page, session: Session, surface: Surface) -> View:
        """The page as it stands; it follows from these three alone."""
        return self.memory.recall("view", (page, session, surface), lambda: page.view(session, surface))

    def drawing(
        self, desk: Desk, sketch: Sketch, columns: int, rows: int, drawn: Drawn | None = None
    ) -> tuple[Row, ...]:
        """The drawing as rows; none before the numeric library is there."""
        if not self.ready or columns < 1 or rows < 1:
            return ()
        from app.painted.widgets.drawing import picture_rows
        from core.pipeline.plot import block_scene

        if drawn is not None:
            scene = self.memory.recall("page-scene", drawn.about, drawn.scene)
            own = (scene, sketch, columns, rows, desk.mode)
            return self.memory.recall("page-picture", own, lambda: picture_rows(*own))
        session = self.trial or desk.session
        found, segment, unit = session.found, session.where.segment, session.program.unit
        place = (session.guard.origin, len(session.program.blocks), session.where.block)
        if not found.known and (before := self.memory.last("picture", tuple, place)) is not None:
            # while the new path is being calculated the block's old drawing stands, never that of another block or
            # program: of these only the contour; the verdict says that it is not known
            return before
        # of the table no more is drawn than the path of one value: where none is asked for it may come later
        row = None if sketch.lookahead is None or self.table is None else self.table.row(sketch.lookahead)
        about = (*_seen(found, segment), row, segment, unit)
        scene = self.memory.recall("scene", about, lambda: block_scene(found, segment, unit, row))
        window = (scene, sketch, columns, rows, desk.mode)
        return self.memory.recall("picture", (*place, *window), lambda: picture_rows(*window))

    def verdict(self, session: Session, look: int | None, height: int, width: int, first: int = 0) -> tuple[Row, ...]:
        """The verdict in its room from line `first` on, of the path in force or of that of a look-ahead value."""
        told, room = (session.program.unit, look, first + height), (height, width)
        # whether there may be more to say is not said here
        read = None if self.table is None else (self.table.rows, self.table.notes)
        about = (session.found, read, *told, *room)
        rows = partial(verdict_rows, session.found, self.table, *told)
        return self.memory.recall("verdict", about, lambda: fitted(rows()[first:], *room))


class Needing(NamedTuple):
    """Sentences on what a block needs: the paths they are about, and the calculated look-ahead they explain."""

    work: BlockPaths
    calculated: int
    sentences: tuple[Finding, ...]


@dataclass(slots=True)
class Engine:
    """Remembers how long things took, what was derived last, and the look-ahead tables of the last paths asked for.

    A block whose depths or feeds have changed is another one with the same paths: its table stays.  Enter, undo, and a
    digit taken back lead to a program that was derived or tried out a moment ago.
    """

    limit: float = FAST
    ready: bool = False
    memory: Memory = field(default_factory=Memory)
    took: dict[str, float] = field(default_factory=dict)
    derived: tuple[Derived, ...] = ()
    """What was derived last, whether of the program or of one that was tried out; the newest first."""
    tables: tuple[tuple[BlockPaths, Table | None], ...] = ()
    """Paths and their tables, the newest first; changed as a whole, since screens look in from another thread."""
    notes: tuple[tuple[BlockPaths, tuple[Finding, ...]], ...] = ()
    """Paths and what a better one would cut, the newest first; changed as a whole too."""
    needs: tuple[Needing, ...] = ()
    """What was found out last, the newest first; changed as a whole too."""

    def load(self, program: Program) -> Derived:
        """Fetch the numeric library and derive the program; for a thread."""
        for module in NUMERIC:
            import_module(module)
        first = outline(program)
        self.derive(program, first)
        self.took.clear()
        # measured when everything is warm
        return self.derive(program, first)

    def fast(self, *tasks: str, part: float = 1.0) -> bool:
        """Whether these tasks may all be done before the next picture, or in a part of that time."""
        return self.ready and sum(self.took.get(task, 0.0) for task in tasks) <= part * self.limit

    def small(self, task: str, part: float) -> bool:
        """Whether a task took no longer than this part of that time lately: one never done may take any time."""
        return self.ready and self.took.get(task, inf) <= part * self.limit

    def timed(self, task: str, work: Callable[[], Result]) -> Result:
        """Do a task and remember how much work it was: waiting for a busy machine does not count."""
        begun = thread_time()
        result = work()
        took = thread_time() - begun
        self.took[task] = OLD * min(self.took.get(task, took), 2 * self.limit) + (1 - OLD) * took
        return result

    def derive(self, program: Program, before: Derived) -> Derived:
        """Everything that follows from a program."""
        result = self.timed("derive", lambda: derived_again(program, before))
        self.derived = (result, *self.derived)[:KEPT]
        return result

    def held(self, program: Program) -> Derived | None:
        """What was derived lately of an equal program; None where that was of none."""
        found = next((one for one in self.derived if one.program == program), None)
        return None if found is None else bearing(found, program)

    def keep_table(self, found: DerivedBlock, program: Program) -> None:
        """Make and keep the look-ahead table of a block."""
        from core.pipeline.derive import look_ahead_table

        if found.paths is None or self.tabulated(found):
            return
        table = self.timed("table", lambda: look_ahead_table(found, program))
        self.tables = ((found.paths, table), *self.tables)[:KEPT]

    def tabulated(self, found: DerivedBlock) -> bool:
        """Whether the table of a block is there, or the block can have none."""
        return found.paths is None or any(work is found.paths for work, _ in self.tables)

    def lacks_notes(self, found: DerivedBlock) -> bool:
        """Whether the table of this block is there, and not yet what a better path would cut."""
        return self._made(found) is not None and self._notes(found) is None

    def keep_notes(self, found: DerivedBlock) -> None:
        """Find out what a better path would cut."""
        from core.pipeline.derive import better_path

        if found.paths is not None and self._notes(found) is None:
            notes = self.timed("notes", lambda: better_path(found))
            self.notes = ((found.paths, notes), *self.notes)[:KEPT]

    def lacks_needs(self, found: DerivedBlock) -> bool:
        """Whether the table of this block is there, its calculated value is not clean, and nobody has said why."""
        table = self._made(found)
        if table is None or self._needing(found) is not None:
            return False
        return not table.row(found.lookahead.calculated).clean

    def keep_needs(self, found: DerivedBlock, program: Program, wanted: Callable[[], bool] = lambda: True) -> None:
        """Find out what the block needs; for a thread, since remedies are tried one after the other.

        `wanted` is asked between two of them: where nobody wants them any more, nothing is kept.
        """
        from core.pipeline.derive import advice_for_block

        if found.paths is None or self._needing(found) is not None:
            return
        told = advice_for_block(found, program, self._made(found), wanted=wanted)
        if told is not None:
            self.needs = (Needing(found.paths, found.lookahead.calculated, told.sentences), *self.needs)[:KEPT]

    def known(self, found: DerivedBlock, trial: Session | None, accepted: DerivedBlock | None = None) -> Known:
        """What the screens may show of this block; `accepted` is it without the half-typed number, where there is one.

        Advice is told of what has been accepted, even if it has been found out before.
        """
        own = accepted is None or accepted.paths is found.paths
        return Known(self._table(found, own=own), self.ready, self.memory, trial)

    def _made(self, found: DerivedBlock) -> Table | None:
        """The table of a block as it was made; None before that, and where the block has none."""
        return next((table for work, table in self.tables if work is found.paths), None)

    def _notes(self, found: DerivedBlock) -> tuple[Finding, ...] | None:
        """What a better path would cut; None while that is not known."""
        return next((notes for work, notes in self.notes if work is found.paths), None)

    def _table(self, found: DerivedBlock, *, own: bool) -> Table | None:
        """The table of a block with its notes as far as they are known, what the block needs before the others."""
        table, notes = self._made(found), self._notes(found)
        if table is None:
            return None
        complete = notes is not None and not (own and self.lacks_needs(found))
        needs, better = (self._needing(found), notes) if own else (None, None)
        every = (*(() if needs is None else needs.sentences), *(better or ()))
        about = (table, better, needs, complete)
        return self.memory.recall("table", about, lambda: replace(table, notes=every, complete=complete))

    def _needing(self, found: DerivedBlock) -> Needing | None:
        """What a block needs, where that was found out lately."""
        calculated = found.lookahead.calculated
        return next((one for one in self.needs if one.work is found.paths and one.calculated == calculated), None)


def derived_again(program: Program, before: Derived) -> Derived:
    """Everything that follows from a program; a block for which nothing has changed is that of `before`.

    Paths on which the change has no bearing, such as one of depths and feeds, are those of `before` too, and with them
    their look-ahead table.
    """
    from core.pipeline.derive import derive_block

    then = before.program
    shared = (program.tools, program.setup, program.parameters, program.unit)
    alike = shared == (then.tools, then.setup, then.parameters, then.unit)
    blocks = []
    for number, block in enumerate(program.blocks, 1):
        old = before.block(number) if number <= len(before.blocks) else None
        if alike and old is not None and old.known and old.block == block:
            blocks.append(old)
            continue
        found = derive_block(program, number)
        if old is not None and old.paths is not None and _paths_of(found, program) == _paths_of(old, then):
            found = replace(found, paths=old.paths)
        blocks.append(found)
    return Derived(program, tuple(blocks))


def _paths_of(found: DerivedBlock, program: Program) -> tuple[object, ...]:
    """All that a block's paths depend on."""
    solved = found.solved
    shape = (solved.pieces, solved.closed, found.side, found.profile, found.lookahead.value)
    return (*shape, found.radius, solved.tool_diameter, solved.finish_diameter, program.parameters, program.unit)


def bearing(derived: Derived, program: Program) -> Derived:
    """What was derived of an equal program, with the blocks of this one, by which the next derivation sees changes.

    Everything derived follows from values alone, so equal programs have it in common.
    """
    both = zip(derived.blocks, program.blocks, strict=True)
    return Derived(program, tuple(replace(found, block=block) for found, block in both))


def _seen(found: DerivedBlock, segment: int) -> tuple[object, ...]:
    """All of a block that its drawing shows: another depth or feed leaves the drawing as it stands."""
    solved = found.solved
    if found.paths is None or not 0 <= segment <= len(solved.segments):
        return (found,)
    current = solved.segments[segment - 1].piece if segment else None
    begins = solved.segments[0].start if solved.segments else None
    return found.paths, found.radius, solved.segments[solved.determined :], current, begins
