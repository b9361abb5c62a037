"""NC PROOF shows an NC program's listing, the path a control makes of it, and the findings."""

from __future__ import annotations

import re
from asyncio import to_thread
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING, ClassVar, Final

from textual import on, work
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, Vertical
from textual.content import Content
from textual.widgets import Label, OptionList, Static
from textual.widgets.option_list import Option

from app.documents.document import NcDocument
from app.documents.nc_text import NcText
from app.nc_proof import runs
from app.nc_proof.compare_controls import CompareControls
from app.nc_proof.listing import Listing
from app.nc_proof.runs import Result, RunRequest
from app.screens.base import BaseScreen
from app.screens.dialogs import ChooseLine, Phrase
from app.session.formats import counted
from app.session.messages import Sentence, Tone
from app.session.work import while_wanted
from app.widgets.drawing import Drawing
from app.widgets.plain import PlainLabel, PlainText
from app.widgets.rows import OptionRows, control_rows
from app.widgets.softkeys import Softkey
from app.widgets.status import Status
from app.widgets.verdict import MARKS_OF_CHARACTERS
from core.controls.control_names import display_name
from core.controls.control_tools import CommentedSize, CutterTool, ToolId, ToolTable, commented_size, tool_id
from core.controls.registry import choices
from core.finding import Finding, Severity
from core.progress import Stopped, part
from core.tolerance import ROUNDING
from core.units import Kind, Unit, Unreadable, parse, sentence

if TYPE_CHECKING:
    from core.draw.view import View
    from core.pipeline.checking import Answer, CheckRequest

READING_PROMPT: Final = (
    "Enter edits, N and P go from finding to finding, C another control, T a tool's diameter, V compares all controls."
)
EDITING_PROMPT: Final = "Editing. A line is taken when the cursor leaves it; Esc ends editing."
_NAMED: Final = re.compile(r"\s*([^=]*[^=\s])\s*=(.*)")


class ProofScreen(BaseScreen):
    """The proof of one NC text.

    The text runs on the control in `check_request`, else on the `usual_control` if that reads the text.  Its tools are
    those of the last time, `remembered_tools` such as `1=0.5in`; tools in `check_request` override them.
    """

    AUTO_FOCUS: ClassVar[str | None] = "#listing"
    HAS_PROGRESS: ClassVar[bool] = True
    SHOWS_NC_TEXT: ClassVar[bool] = True
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("enter", "edit", "Edit", show=False),
        Binding("escape", "leave", "Back", show=False),
        Binding("n,N", "finding(1)", "Next finding", show=False),
        Binding("p,P", "finding(-1)", "Finding before", show=False),
        Binding("c,C", "control", "Choose control", show=False),
        Binding("t,T", "tool", "Tool diameter", show=False),
        Binding("v,V", "compare", "Compare controls", show=False),
        Binding("b,B", "no_dotted_path", "No dotted path", show=False),
        Binding("plus,equals_sign", "zoom(1)", "Zoom in", show=False),
        Binding("minus", "zoom(-1)", "Zoom out", show=False),
        Binding("0", "fit", "Whole program", show=False),
        Binding("m,M", "app.next_characters", "Characters", show=False),
        Binding("tab", "other_panel", "Listing or findings", show=False),
    ]
    SOFTKEYS: ClassVar[tuple[Softkey | None, ...]] = (
        Softkey("EDIT", "edit", "EDIT"),
        Softkey("CHOOSE CONTROL", "control", "CONTROL"),
        Softkey("TOOL DIAMETER", "tool", "TOOL"),
        Softkey("COMPARE CONTROLS", "compare", "COMPARE"),
        Softkey("NEXT FINDING", "finding(1)", "NEXT"),
        Softkey("SAVE", "app.save", "SAVE"),
        Softkey("DRAW", "large", "DRAW"),
        Softkey("BACK", "close", "BACK"),
    )
    MORE_KEYS: ClassVar[tuple[tuple[str, str], ...]] = (
        ("F10", "FINDINGS"),
        ("^S", "SAVE"),
        ("^K", "ALL ACTIONS"),
        ("?", "KEYS, HELP"),
    )

    def __init__(
        self,
        document: NcDocument,
        check_request: CheckRequest | None = None,
        usual_control: str = "",
        remembered_tools: str = "",
    ) -> None:
        super().__init__()
        self.document = document
        text = document.text
        control = runs.likely_control(text, usual_control)
        folder = None if document.file.path is None else document.file.path.absolute().parent
        self.typed_tools = runs.read_tools(remembered_tools)
        """The tools typed for this program, now or in an earlier session."""
        self.tools_in_header = runs.header_tools(text)
        """The tools that the header of a program posted by cutcomp names."""
        tools, unit = {**self.tools_in_header, **self.typed_tools}, None
        self.tool = runs.first_tool(text)
        if check_request is not None:
            control, unit = check_request.control or control, check_request.unit
            tools |= check_request.tools
            self.tool = next(iter(check_request.tools), self.tool)
        self.request = RunRequest(text, control, tools, unit, folder)
        self.result: Result | None = None
        self.dotted_control = ""
        """The other control whose path is drawn dotted; empty for none."""
        self.dotted: Result | None = None
        """That control's run of the same text; None until it is known."""
        self.window_view: View | None = None
        self.stopped = self.half_typed = False

    def compose_body(self) -> ComposeResult:
        """Lay out the titles, the listing, the two drawings and the findings."""
        with Vertical(id="proof-title"):
            with Horizontal(classes="head"):
                yield PlainLabel("NC PROOF", id="proof-mode", classes="head-label")
                yield PlainLabel(id="proof-control", classes="head-kind")
                yield PlainLabel(id="proof-file", classes="head-note")
            with Horizontal(classes="head"):
                yield PlainText(id="proof-outcome")
                yield PlainLabel(id="proof-tools", classes="head-note")
        with Horizontal(id="proof-body"):
            yield Listing(id="listing")
            yield Drawing(id="proof-drawing")
            yield Drawing(id="proof-dotted")
        yield OptionRows(id="proof-findings", classes="panel")

    def on_mount(self) -> None:
        """Show the text with the cursor where it was, and start the first run."""
        self._show_text(self.document.row)
        super().on_mount()
        opened = self.notice
        self._run_request(self.request)
        if opened is not None:
            self.say(opened.text, opened.tone)
        before = "" if opened is None else f"{opened.text.removesuffix('.')}. "
        if any(tool is self.request.tools.get(number) for number, tool in self.typed_tools.items()):
            self.say(f"{before}It has the tools that you gave it last time.")
        elif self.tools_in_header and self.request.tools == self.tools_in_header:
            self.say(f"{before}It has the tools that its header names.")

    # ---- the text

    def _show_text(self, row: int) -> None:
        """Load the document's lines into the listing, with the cursor on a row."""
        listing = self.query_one(Listing)
        listing.load_text("\n".join(self.document.text.texts))
        listing.go_to_row(row)

    def show_document(self, document: NcDocument) -> None:
        """Show a new version of the same file's document; control and tools stay."""
        self.document = document
        self._show_text(document.row)
        self._run_request(replace(self.request, text=document.text))

    def take_lines(self) -> bool:
        """Take what was typed in the listing; return False if the file's encoding cannot hold it."""
        listing = self.query_one(Listing)
        text = self.document.text.with_texts(listing.document.lines)
        if text is not self.document.text:
            if not text.takes("".join(listing.document.lines)):
                self.say(f"The file is written in {text.encoding}, which cannot hold this line.", Tone.ERROR)
                return False
            self._change(text, listing.row)
        self._half_typed(typed=False)
        return True

    @on(Listing.Changed)
    def _typed(self) -> None:
        """Mark the file as unsaved while a line is being typed."""
        listing = self.query_one(Listing)
        here = listing.document.get_line(listing.row)
        self._half_typed(typed=not listing.read_only and here != self.document.text.text(listing.row))

    def _half_typed(self, *, typed: bool) -> None:
        if typed != self.half_typed:
            self.half_typed = typed
            self._show_titles()

    def _change(self, text: NcText, row: int) -> None:
        self.document = self.document.edited(text, row)
        self.host.keep_document(self.document)
        self._run_request(replace(self.request, text=text))

    def undo_or_redo_own_document(self, action: str, /) -> bool:
        """Undo or redo an edit of the NC text; a line that is being typed is one."""
        if not self.take_lines():
            return True
        before, undo = self.document.text, action == "undo"
        text = before.undo() if undo else before.redo()
        if text is before:
            self.say(f"There is nothing to {action}.")
        else:
            row = (text.future if undo else text.past)[-1].at
            self._change(text, row)
            self._show_text(row)
            self.say("Undone. Ctrl+Y brings it back." if undo else "Redone.")
        return True

    def saved(self, document: NcDocument) -> None:
        """Note that the text was saved."""
        self.document = self.document.saved(document.file, document)
        self._show_titles()

    def action_edit(self) -> None:
        """Switch the listing between editing and read-only."""
        listing = self.query_one(Listing)
        if self.document.file.holder is not None:
            self.say("Somebody else has this file open. SAVE AS (Ctrl+K) makes a copy of your own.", Tone.WARNING)
            return
        if self.has_class("-large"):
            self.action_large()
        listing.focus()
        listing.read_only = not listing.read_only
        self.clear_notice()
        if listing.read_only:
            self.take_lines()
        self.query_one("#proof-mode", Label).update("NC PROOF" if listing.read_only else "NC EDIT")
        self.refresh_frame()

    def action_leave(self) -> None:
        """Go one step back: leave editing, the large drawing, the findings, or the screen."""
        listing = self.query_one(Listing)
        if not listing.read_only:
            self.action_edit()
        elif self.has_class("-large"):
            self.action_large()
        elif not listing.has_focus:
            listing.focus()
        else:
            self.action_close()

    def action_close(self) -> None:
        """Leave the screen; ask about unsaved changes."""
        if self.take_lines():
            self.host.close_nc(self)

    @on(Listing.SelectionChanged)
    def _moved(self) -> None:
        """When the cursor leaves a line, take it and move the cutter to the end of the new line's moves."""
        if self.query_one(Listing).row != self.document.row:
            self.clear_notice()
            self._follow_cursor()

    def _follow_cursor(self) -> bool:
        """Take the line the cursor has left and show the drawing and finding of its new one; False if refused."""
        listing = self.query_one(Listing)
        taken = listing.read_only or self.take_lines()
        self.document = self.document.edited(self.document.text, listing.row)
        self._draw()
        findings, here = self.query_one("#proof-findings", OptionList), self._findings_of_row()
        if here and findings.highlighted not in here and not findings.has_focus:
            findings.highlighted = self._most_severe(here)
        return taken

    # ---- the control's run

    def _run_request(self, request: RunRequest) -> None:
        self.request, self.stopped = request, False
        # messages about the previous run no longer apply
        self.clear_notice()
        if self.dotted_control == request.control:
            self.dotted_control = ""
        self._end_dotted()
        self._show_titles()
        self._run(request)

    @work(exclusive=True, group="proof", description="proof")
    async def _run(self, request: RunRequest) -> None:
        with suppress(Stopped):
            with self.host.working(self._run_stopped) as work:
                result = await to_thread(runs.run, request, part(work, 0.0, runs.RUN_SHARE))
                self._show_result(result)
                judged = await to_thread(runs.judge, result, part(work, runs.RUN_SHARE, 1.0))
            self._show_result(judged)
            self._start_dotted_run()
            # the progress shown ends with the verdict
            fitted = await to_thread(runs.with_largest_tool, judged, while_wanted())
            if fitted.answer.fits is not None:
                self._show_result(fitted)

    def _run_stopped(self) -> None:
        """Report that Esc stopped the run: the text stays without a run, or without verdicts, until the next one."""
        self.stopped = True
        self._show_titles()
        self.say("Stopped. C chooses the control and runs the program again.", Tone.WARNING)

    def _show_result(self, result: Result) -> None:
        if not self.is_live or result.request is not self.request:
            return
        # a new run shows what is most severe; its verdicts keep what was chosen meanwhile
        again = self.result is not None and self.result.request is result.request
        highlighted = self._highlighted_finding() if again else None
        self.result = result
        # the most severe of a line's findings comes last, and stays
        ordered = sorted(self.result_findings, key=_severity, reverse=True)
        marks = {finding.line: finding.severity for finding in ordered if finding.line is not None}
        self.query_one(Listing).marks = marks
        self._show_findings(highlighted)
        self._show_titles()
        self._draw()

    # ---- the path of another control

    def _start_dotted_run(self) -> None:
        """Run the program on the control that is drawn dotted, once the main run is judged."""
        self._end_dotted()
        if self.dotted_control and self.result is not None and self.result.judged:
            self._run_dotted(self.result, self.dotted_control)

    @work(exclusive=True, group="dotted", description="dotted")
    async def _run_dotted(self, main: Result, control: str) -> None:
        with suppress(Stopped), self.host.working(self._dotted_stopped) as work:
            dotted = await to_thread(runs.run_dotted, main, control, work)
            if self.is_live and main.request is self.request and control == self.dotted_control:
                self.dotted = dotted
                self._draw()
                self.say(f"Dotted: {display_name(control)} {dotted.answer.outcome}. B removes it.")

    def _end_dotted(self) -> None:
        """Drop the other control's path and stop its run."""
        self.workers.cancel_group(self, "dotted")
        self.dotted = None

    def _dotted_stopped(self) -> None:
        """Report that Esc stopped the run on the other control."""
        self._remove_dotted()
        self.say("Stopped. V, then Space on a control, draws its path dotted.", Tone.WARNING)

    def _remove_dotted(self) -> None:
        self.dotted_control = ""
        self._end_dotted()
        self._show_titles()
        self._draw()

    def action_no_dotted_path(self) -> None:
        """Remove the other control's dotted path."""
        if self.dotted_control:
            self._remove_dotted()
            self.clear_notice()
        else:
            self.say("V, then Space on another control, draws its path dotted under this one.")

    @property
    def unit(self) -> Unit:
        """The program's unit; inches until the first run is done."""
        return Unit.IN if self.result is None else self.result.answer.unit

    def _show_titles(self) -> None:
        tools = "  ".join(map(self._shown_tool, self.request.tools.values()))
        dotted = f", dotted {display_name(self.dotted_control)}" if self.dotted_control else ""
        self.query_one("#proof-control", Label).update(f"{display_name(self.request.control)}{dotted}")
        # an alarm for want of a tool says so itself, and needs the room
        lacks = self.result is not None and self.result.answer.missing is not None
        self.query_one("#proof-tools", Label).update(f"tools {tools}" if tools else "" if lacks else "tools none given")
        path = self.document.file.path
        name = "NO NAME" if path is None else path.name
        name = name if self.document.file.holder is None else f"LOOK ONLY {name}"
        self.query_one("#proof-file", Label).update(f"{name}{' *' if self.document.unsaved or self.half_typed else ''}")
        self.query_one("#proof-outcome", Static).update(self._outcome())
        self.show_state()

    def _shown_tool(self, tool: CutterTool) -> str:
        """Return a tool and its diameter, with the unit if that is not the program's."""
        other = tool.unit is not None and tool.unit is not self.unit
        return f"{tool.number}={tool.diameter:g}{str(tool.unit).lower() if other else ''}"

    def _outcome(self) -> Content:
        if self.stopped:
            return Content.styled("stopped: not run to its end, not judged", "$c-warn")
        if self.result is None:
            return Content("running ...")
        answer = self.result.answer
        role = "$c-err" if answer.errors else "$c-warn" if answer.uncompensated or answer.warnings else "$c-good"
        text = self._alarm(answer) or f"{answer.outcome}; {counted(answer.move_count, 'move')}"
        # after an alarm only part of the program was run, so its contours are not counted
        if answer.stretches != 1 and answer.stopped_at is None:
            text += f", {counted(answer.stretches, 'contour') if answer.stretches else 'no contour'}"
        if not self.result.judged:
            role, text = "$c-warn", "being judged ..."
        return Content.styled(f"{text}{'' if self.result.request is self.request else ' ...'}", role)

    def _alarm(self, answer: Answer) -> str:
        """Return the line and the reason of an alarm; empty if there is none, or if a gouge comes before it."""
        if not answer.outcome.startswith("alarms at"):
            return ""
        reason = f"{answer.stop_reason.partition('. ')[0].removesuffix('.')}."
        if answer.missing is not None:
            reason = f"tool {answer.missing} not in table. T adds it."
        return f"{MARKS_OF_CHARACTERS[self.host.characters].gouge} ALARM line {answer.stopped_at}: {reason}"

    # ---- findings

    def _highlighted_finding(self) -> Finding | None:
        at = self.query_one("#proof-findings", OptionList).highlighted
        return None if at is None or at >= len(self.result_findings) else self.result_findings[at]

    def show_signs(self) -> None:
        """Redraw the signs of the findings."""
        self._show_findings(self._highlighted_finding())

    def _show_findings(self, keep: Finding | None) -> None:
        """List the findings; keep `keep` highlighted if it is on the cursor's line or the list has the focus."""
        findings, marks = self.query_one("#proof-findings", OptionList), MARKS_OF_CHARACTERS[self.host.characters]
        listed = self.result_findings
        findings.border_title = f"FINDINGS  {len(listed)}" if listed else "FINDINGS  none"
        at = listed.index(keep) if keep in listed else None
        findings.clear_options()
        findings.add_options([Option(self._line(finding, marks.gouge, marks.warning)) for finding in listed])
        here = self._findings_of_row()
        stays = at in here or (at is not None and findings.has_focus)
        findings.highlighted = at if stays else self._most_severe(here or range(len(listed)))

    def _most_severe(self, among: Sequence[int]) -> int | None:
        """Return the index of the first of the most severe findings among these; None if there are none."""
        return min(among, key=lambda index: _severity(self.result_findings[index]), default=None)

    def _line(self, finding: Finding, error: str, warning: str) -> Content:
        sign = {Severity.ERROR: error, Severity.WARNING: warning}.get(finding.severity, "i")
        role = {Severity.ERROR: "$c-err", Severity.WARNING: "$c-warn"}.get(finding.severity, "$c-label")
        where = f"{finding.line}: " if finding.line is not None else ""
        return Content.styled(f"{sign} {where}{sentence(finding, self.unit)}", role)

    def _findings_of_row(self) -> list[int]:
        """Return the indexes of the findings of the line with the cursor."""
        return [at for at, finding in enumerate(self.result_findings) if finding.line == self.document.row + 1]

    @property
    def result_findings(self) -> tuple[Finding, ...]:
        """The findings of the last run."""
        return () if self.result is None else self.result.answer.findings

    def action_finding(self, by: int) -> None:
        """Go to the next finding after the line with the cursor, or to the previous one."""
        lines = [(finding.line or 0, at) for at, finding in enumerate(self.result_findings)]
        findings = self.query_one("#proof-findings", OptionList)
        at = findings.highlighted
        row = self.document.row + 1
        here = (row, at) if at is not None and lines and lines[at][0] == row else (row, -1 if by > 0 else len(lines))
        there = [each for each in lines if (each > here if by > 0 else each < here)]
        if not there:
            which = "further" if by > 0 else "earlier"
            self.say(f"No {which} finding." if lines else "There are no findings.")
            return
        self._take_finding((there[0] if by > 0 else there[-1])[1])

    def _take_finding(self, at: int) -> None:
        finding = self.result_findings[at]
        self.query_one("#proof-findings", OptionList).highlighted = at
        if finding.line is not None:
            self.query_one(Listing).go_to_row(finding.line - 1)
            if self.window_view is not None and self.result is not None:
                # imported here: the first paint must not load numpy and shapely
                from core.pipeline.nc_proof import cutter_at_line

                center, _ = cutter_at_line(self.result.proof, finding.line)
                self.window_view = replace(self.window_view, center=center)
            # before the listing's own cursor event, which would clear the message below
            if not self._follow_cursor():
                return
        self.say(sentence(finding, self.unit))

    @on(OptionList.OptionHighlighted, "#proof-findings")
    def _finding_highlighted(self, event: OptionList.OptionHighlighted) -> None:
        if event.option_list.has_focus and event.option_index < len(self.result_findings):
            self._take_finding(event.option_index)

    @on(OptionList.OptionSelected, "#proof-findings")
    def _finding_selected(self) -> None:
        self.query_one(Listing).focus()

    def action_panel(self, name: str) -> None:
        """Move the cursor to the findings and back; an NC text has no segments."""
        if name == "findings":
            self.action_other_panel()

    def action_other_panel(self) -> None:
        """Move the cursor to the findings, or back to the listing."""
        listing = self.query_one(Listing)
        other = self.query_one("#proof-findings", OptionList)
        (other if listing.has_focus and self.result_findings else listing).focus()

    # ---- the drawing

    def _draw(self) -> None:
        if self.result is None:
            return
        # imported here: the first paint must not load numpy and shapely
        from core.pipeline.nc_proof import cutter_at_line, scene_at_line
        from core.pipeline.plot import SceneSubject

        line, dotted = self.document.row + 1, self.dotted
        scene = scene_at_line(self.result.scene, self.result.proof, line)
        if dotted is not None:
            scene = replace(scene, layers=(*dotted.dotted, *scene.layers))
            second = self.query_one("#proof-dotted", Drawing)
            second.heading = f"{display_name(dotted.request.control)}: {dotted.answer.outcome}"
            second.subject = SceneSubject(scene_at_line(dotted.scene, dotted.proof, line), self.unit, self.window_view)
        self.set_class(dotted is not None, "-dotted")
        drawing = self.query_one("#proof-drawing", Drawing)
        drawing.heading = f"LINE {line}"
        drawing.subject = SceneSubject(scene, self.unit, self.window_view)
        for each in self.query(Drawing):
            each.zoomed_about, _ = cutter_at_line(self.result.proof, line)

    @on(Drawing.Viewed)
    def _viewed(self, event: Drawing.Viewed) -> None:
        """Show the same window in both drawings."""
        self.window_view = event.view
        for drawing in self.query(Drawing):
            drawing.show_view(event.view)

    def action_zoom(self, steps: int) -> None:
        """Zoom in or out about the cutter."""
        self.query_one("#proof-drawing", Drawing).action_zoom(steps)

    def action_fit(self) -> None:
        """Show the whole program."""
        self.query_one("#proof-drawing", Drawing).action_fit()

    def action_large(self) -> None:
        """Switch between the large drawing and the listing; a hidden listing and its findings take no keys."""
        listing, large = self.query_one(Listing), not self.has_class("-large")
        if not listing.read_only:
            self.action_edit()
        self.set_class(large, "-large")
        listing.can_focus = self.query_one("#proof-findings").can_focus = not large
        if not large:
            listing.focus()

    # ---- control and tools

    @work(exclusive=True, group="question")
    async def action_control(self) -> None:
        """Let the operator choose the control from a list."""
        rows = control_rows(choices())
        here = self.request.control
        control = await self.app.push_screen_wait(ChooseLine("CONTROL", rows, here, classes="wide-box"))
        if control and self.take_lines():
            self.host.keep_settings(replace(self.host.settings, control=control))
            self._run_request(replace(self.request, control=control))

    @work(exclusive=True, group="question")
    async def action_compare(self) -> None:
        """Compare all controls; take the chosen one, or draw its path dotted."""
        if not self.take_lines():
            return
        chosen = await self.app.push_screen_wait(CompareControls(self.request))
        if chosen is None:
            return
        control, dotted = chosen
        if not dotted:
            self._run_request(replace(self.request, control=control))
        elif control == self.request.control:
            self.say("The program runs on this control already. Choose another one to draw dotted.")
        else:
            self.dotted_control = control
            self._start_dotted_run()
            self._show_titles()
            self._draw()

    @work(exclusive=True, group="question")
    async def action_tool(self) -> None:
        """Ask for the diameter of a tool or offset; `2=` removes that of tool 2."""
        missing = None if self.result is None else self.result.answer.missing
        named = self.tool if missing is None else missing
        plain, other = ("12", ".5in") if self.unit is Unit.MM else (".5", "12.7mm")
        comment = self._comment_on(named)
        lines = [
            f"Tool and diameter in {self.unit}: {named}={plain} or {named}={other}.",
            f"A number alone is the diameter of tool {named}. {named}= removes it.",
            *([] if comment is None else [_quoted(comment)]),
        ]

        def refusal(text: str) -> str:
            typed = read_tool(text, named, self.unit)
            return typed.reason if isinstance(typed, Unreadable) and text.strip() else ""

        text = await self.app.push_screen_wait(Phrase("TOOL DIAMETER", lines, refusal))
        typed = read_tool(text, named, self.unit)
        if isinstance(typed, CutterTool):
            self._with_tool(typed)
        elif not isinstance(typed, Unreadable):
            tables = (self.typed_tools, self.request.tools)
            typed_tools, tools = ({each: tool for each, tool in table.items() if each != typed} for table in tables)
            self._with_tools(typed_tools, tools)
            self.say(f"Tool {typed} has no diameter any more.")

    def _comment_on(self, number: ToolId) -> CommentedSize | None:
        return commented_size(self.document.text.texts, number)

    def _with_tool(self, tool: CutterTool) -> None:
        self.tool = tool.number
        self._with_tools({**self.typed_tools, tool.number: tool}, {**self.request.tools, tool.number: tool})
        said = f"Tool {tool.number}: diameter {tool.diameter:g} {tool.unit or self.unit}."
        comment = self._comment_on(tool.number)
        size = None if comment is None else parse(comment.diameter, Kind.LENGTH, self.unit)
        if comment is not None and isinstance(size, float) and abs(size - tool.diameter) > ROUNDING:
            self.say(f"{said} {_quoted(comment)}", Tone.WARNING)
        else:
            self.say(said)

    def _with_tools(self, typed_tools: ToolTable, tools: ToolTable) -> None:
        self.typed_tools = typed_tools
        if (file := self.document.file.path) is not None:
            self.host.keep_settings(self.host.settings.with_tools(file, runs.tools_text(typed_tools)))
        self._run_request(replace(self.request, tools=tools))

    # ---- the frame

    def show_state_on(self, status: Status) -> None:
        """Show the NC text's unit, edits and saved state on the status line."""
        text = self.document.text
        unit = "..." if self.result is None else str(self.unit)
        unsaved, saved = text.unsaved or self.half_typed, self.document.file.path is not None
        status.show(unit, len(text.past), len(text.future), unsaved=unsaved, saved=saved)

    def prompt_text(self) -> Sentence:
        """Return what the keys do."""
        return Sentence(READING_PROMPT if self.query_one(Listing).read_only else EDITING_PROMPT)

    def help_lines(self) -> tuple[str, ...]:
        """Return what the screen is for, and its keys."""
        return (
            "NC PROOF",
            "The listing, what the control makes of it, and the findings; Tab changes between them.",
            "N and P go from finding to finding. Enter edits the listing, Esc ends editing.",
            "C chooses the control, V compares all controls.",
            "The drawing shows the whole path, the moves of the line with the cursor, and the cutter at its end.",
            "In the list of V, Space draws another control's path dotted under this one; B removes it.",
            "T gives a tool its diameter, and the verdict follows.",
            "+ and - zoom, 0 shows the whole program, M changes the characters of the drawing.",
        )


def _severity(finding: Finding) -> int:
    """Return a number for sorting, 0 for the most severe."""
    return list(Severity).index(finding.severity)


def _quoted(comment: CommentedSize) -> str:
    return f"The comment in line {comment.line} says diameter {comment.diameter}."


def read_tool(text: str, tool: ToolId, unit: Unit) -> CutterTool | ToolId | Unreadable:
    """Read a tool typed as `2=.5`, `ROUGH=10` or a bare diameter; for `2=` return the tool to remove."""
    match = _NAMED.fullmatch(text)
    tool, size = (tool_id(match[1]), match[2]) if match else (tool, text)
    if match and not size.strip():
        return tool
    if text.strip() == str(tool):
        return Unreadable(f"{tool} is the number of the tool. For a diameter of {tool}, type {tool}={tool}.")
    value = parse(size, Kind.LENGTH, unit)
    return value if isinstance(value, Unreadable) else CutterTool(tool, value, unit=unit)
