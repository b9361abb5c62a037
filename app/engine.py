"""What is calculated behind the screens, and when: at once while it is fast, in a thread while it is not.

The numeric library takes longer to load than the first screen to stand: until it is there, the form shows what
needs no library, and a thread fetches the rest.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from importlib import import_module
from time import perf_counter
from typing import TYPE_CHECKING, Final, TypeVar

from app.screens.page import Sketch
from app.widgets.rows import Row
from core.pipeline.derived import Derived, DerivedBlock
from core.program.model import Program

if TYPE_CHECKING:
    from app.desk import Desk
    from core.pipeline.table import Table

NUMERIC: Final = ("core.pipeline.derive", "core.pipeline.table", "app.widgets.drawing")
"""Modules that need the numeric library."""
FAST: Final = 0.016
"""Seconds: what took no longer the last time is done before the next picture."""

Result = TypeVar("Result")


@dataclass(frozen=True, eq=False, slots=True)
class Known:
    """What is known besides the session: the table of the block with the cursor, and whether drawing is possible."""

    table: Table | None = None
    ready: bool = False

    def drawing(self, desk: Desk, sketch: Sketch, columns: int, rows: int) -> tuple[Row, ...]:
        """The drawing as rows; none before the numeric library is there."""
        if not self.ready or columns < 1 or rows < 1:
            return ()
        from app.widgets.drawing import picture_rows, scene_of

        session = desk.session
        scene = scene_of(session.found, self.table, session.where.segment, session.program.unit, sketch)
        return picture_rows(scene, sketch, columns, rows, desk.mode)


@dataclass(slots=True)
class Engine:
    """Remembers how long things took, and the look-ahead table of the last block asked for."""

    ready: bool = False
    took: dict[str, float] = field(default_factory=dict)
    table: Table | None = None
    table_of: DerivedBlock | None = None

    def load(self) -> None:
        """Fetch the numeric library; for a thread."""
        for module in NUMERIC:
            import_module(module)

    def fast(self, task: str) -> bool:
        """Whether a task may be done before the next picture."""
        return self.ready and self.took.get(task, 0.0) <= FAST

    def timed(self, task: str, work: Callable[[], Result]) -> Result:
        """Do a task and remember how long it took."""
        begun = perf_counter()
        result = work()
        self.took[task] = perf_counter() - begun
        return result

    def derive(self, program: Program, before: Derived) -> Derived:
        """Everything that follows from a program."""
        from core.pipeline.derive import derive

        return self.timed("derive", lambda: derive(program, before))

    def make_table(self, found: DerivedBlock, program: Program) -> Table | None:
        """The look-ahead table of a block."""
        from core.pipeline.table import look_ahead_table

        return self.timed("table", lambda: look_ahead_table(found, program))

    def known(self, found: DerivedBlock) -> Known:
        """What the screens may show of this block."""
        return Known(self.table if self.table_of is found else None, self.ready)
