"""CompareControls lists what every control does with an NC program."""

from __future__ import annotations

from asyncio import to_thread
from textwrap import fill
from typing import TYPE_CHECKING, ClassVar, Final

from textual import on, work
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.content import Content
from textual.widgets import OptionList, Static
from textual.widgets.option_list import Option

from app.nc_proof.runs import RunRequest, compare
from app.screens.dialogs import Dialog
from app.session.work import SECONDS_BEFORE_PROGRESS, Work
from app.widgets.plain import PlainText
from app.widgets.rows import OptionRows
from core.progress import Stopped

RUNNING: Final = "Every control is running the program ..."
NAME_WIDTH: Final = 20
"""The cells of a control's name."""
MIN_WIDTH: Final = 40
"""The narrowest width in cells to which an answer is wrapped."""

if TYPE_CHECKING:
    from core.pipeline.checking import Answer


class CompareControls(Dialog["tuple[str, bool] | None"]):
    """A list of what every control does with a program; Enter takes one, Space draws its path dotted.

    The result is the control's full name and whether to draw its path dotted; None if no control was chosen.
    """

    BINDINGS: ClassVar[list[BindingType]] = [Binding("space", "dotted", "Draw dotted", show=False)]
    NOTHING: ClassVar[None] = None

    def __init__(self, request: RunRequest) -> None:
        super().__init__("COMPARE CONTROLS", classes="wide-box")
        self.request = request
        self.answers: tuple[Answer, ...] = ()
        self._work = Work(self.action_none)

    def compose_box(self) -> ComposeResult:
        """Lay out the list, which stays empty until the controls have answered."""
        yield PlainText(RUNNING, id="compare-wait")
        yield OptionRows(id="compared")

    def on_mount(self) -> None:
        """Run the program on all controls."""
        self.query_one("#question").border_subtitle = "Enter takes a control, Space draws its path dotted"
        self.set_interval(SECONDS_BEFORE_PROGRESS, self._show_progress)
        self._compare()

    def on_unmount(self) -> None:
        """Stop the comparison; its result is no longer needed."""
        self._work.stopped = True

    def _show_progress(self) -> None:
        if not self.answers and self._work.long:
            self.query_one("#compare-wait", Static).update(f"{RUNNING}  {self._work.text}")

    @work(exclusive=True, group="compare")
    async def _compare(self) -> None:
        try:
            self.answers = await to_thread(compare, self.request, self._work)
        except Stopped:
            return
        self.query_one("#compare-wait").display = False
        rows = self.query_one("#compared", OptionList)
        width = max(rows.content_region.width - rows.styles.scrollbar_size_vertical, MIN_WIDTH)
        for answer in self.answers:
            good = "$c-warn" if answer.warnings else "$c-good"
            role = "$c-err" if answer.errors else "$c-label" if answer.moves is None else good
            outcome = answer.outcome if answer.errors else answer.outcome_and_warnings
            head = fill(f"{answer.name:<{NAME_WIDTH}}{outcome}", width, subsequent_indent=" " * NAME_WIDTH)
            lines = [Content.assemble(head[:NAME_WIDTH], (head[NAME_WIDTH:], role))]
            if more := answer.stop_reason or answer.comparison:
                lines.append(Content.styled(fill(f"    {more}", width, subsequent_indent=" " * 4), "$c-label"))
            rows.add_option(Option(Content("\n").join(lines), id=answer.control))
        rows.highlighted = 0
        rows.focus()

    @on(OptionList.OptionSelected)
    def _selected(self, event: OptionList.OptionSelected) -> None:
        self.dismiss((event.option_id or "", False))

    def action_dotted(self) -> None:
        """Draw the path of the highlighted control dotted, unless it reads another language."""
        row = self.query_one("#compared", OptionList).highlighted
        if row is None:
            return
        answer = self.answers[row]
        if any(finding.code == "LANGUAGE" for finding in answer.findings):
            wait = self.query_one("#compare-wait", Static)
            wait.update(f"{answer.name} reads another language and has no path of this program to draw.")
            wait.display = True
        else:
            self.dismiss((answer.control, True))
