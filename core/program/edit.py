"""This module edits programs: each edit is a pure function that returns the new program or refuses with a sentence.

A refused edit changes nothing.  A number outside a field's range is refused.  A text that cannot be read is kept as
`Unread`, except in the look-ahead, which keeps its old value.  Blocks and segments count from 1; segment 0 is START.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Final

from core.program.fields import (
    MAX_CHOICE,
    PARAMETERS,
    SETUP,
    START,
    STORED_FIELDS,
    TOOL,
    Field,
    Form,
    default_value,
    field_of,
    form_of,
    range_of,
    text_refusal,
    unread_reason,
    value_refusal,
)
from core.program.model import (
    Block,
    CornerSegment,
    LineSegment,
    Number,
    Part,
    PathChoice,
    Program,
    Relative,
    Segment,
    Tool,
    Typed,
    Unread,
    changed,
)
from core.program.solve.block import solve_block
from core.program.solve.solved import solution_at
from core.units import Kind, Unit, convert, from_mm, printable


@dataclass(frozen=True, slots=True)
class FormPlace:
    """A place on the form: the block number from 1; the segment number from 1, or 0 for START."""

    block: int
    segment: int = 0


FIRST_START: Final = FormPlace(1)
"""START of block 1."""
SEGMENT_FIELD: Final = "segment"
"""The name of the SEGMENT line, on which the cursor steps from segment to segment."""


@dataclass(frozen=True, slots=True)
class Refused:
    """A refused edit, with the sentence that says why."""

    text: str


Edited = Program | Refused


def type_field(program: Program, where: FormPlace, name: str, typed: Typed) -> Edited:
    """Put a typed value or a blank into a field of START or of a segment."""
    if refusal := _place_refusal(program, where):
        return refusal
    part = _part(program, where)
    refusal = _field_refusal(_field(part, name), typed, program.unit)
    if isinstance(part, Block) and name == "lookahead":
        refusal = refusal or _lookahead_refusal(part, typed)
    if refusal:
        return refusal
    # a relative angle clears TANGENT
    relative = name in ("angle", "start_angle") and isinstance(typed, Relative)
    edited = with_part(program, where, changed(part, {name: typed, **({"tangent": False} if relative else {})}))
    if isinstance(part, Block) or name in NONGEOMETRIC_FIELDS or type(typed) is type(getattr(part, name)):
        return edited
    return _clear_solutions(program, edited, where)


def is_empty(segment: Segment) -> bool:
    """True if a segment equals a new one except for its feed."""
    return replace(segment, feed=None) == type(segment)()


def choose(program: Program, where: FormPlace, name: str, value: str | int | None) -> Edited:
    """Set a choice: CUTTER COMP. or COOLANT of START, DIRECTION of an ARC, TANGENT (YES or NO) of a LINE or an ARC.

    `choice` is the picked solution, an int from 0; the values of the other fields are their words.  None blanks COOLANT
    or clears the picked solution.  Any other value is Refused; raise KeyError for a field that does not exist.
    """
    if refusal := _place_refusal(program, where):
        return refusal
    part = _part(program, where)
    field = _field(part, name)
    if value is None and name in ("choice", "coolant"):
        return with_part(program, where, changed(part, {name: None}))
    if name == "choice":
        if not (isinstance(value, int) and 0 <= value <= MAX_CHOICE):
            return Refused("SOLUTION takes the number of a solution.")
        return with_part(program, where, changed(part, {name: value}))
    picked = next((choice for choice in field.choices if choice == str(value)), None)
    if picked is None:
        return _wrong_choice(field)
    if name == "tangent":
        return _clear_solutions(program, with_part(program, where, _tangent(part, tangent=picked == "YES")), where)
    chosen = with_part(program, where, changed(part, {name: picked}))
    return chosen if isinstance(part, Block) else _clear_solutions_of_runs(program, chosen, where)


NONGEOMETRIC_FIELDS: Final = ("z_end", "feed", "pick_x", "pick_y")
"""The fields of a segment that do not affect which solutions it has."""


def take_solution(program: Program, where: FormPlace, index: int) -> Edited:
    """Take solution `index` (from 0) of those that SOLUTION lists at a segment."""
    if refusal := _place_refusal(program, where):
        return refusal
    block = program.blocks[where.block - 1]
    solution = solution_at(solve_block(block, program), where.segment)
    if solution is None or not 0 <= index < len(solution.answers):
        return Refused("There is no such solution to pick here.")
    answer, first = solution.answers[index], FormPlace(where.block, solution.number)
    values: dict[str, Any] = {"choice": answer.choice}
    if answer.pick is not None:
        at = (Number(from_mm(coordinate, program.unit)) for coordinate in answer.pick)
        values |= dict(zip(("pick_x", "pick_y"), at, strict=True))
    return with_part(program, first, changed(_part(program, first), values))


def pick_joint(program: Program, where: FormPlace, x: float, y: float) -> Edited:
    """Pick (x, y), in program units, as a point near the end of a run's first segment."""
    with_x = type_field(program, where, "pick_x", Number(x))
    return with_x if isinstance(with_x, Refused) else type_field(with_x, where, "pick_y", Number(y))


def _tangent(part: Block | Segment, *, tangent: bool) -> Block | Segment:
    """Return the segment with TANGENT YES or NO; YES replaces an angle relative to the segment before."""
    if not tangent:
        return changed(part, {"tangent": False})
    name = "angle" if isinstance(part, LineSegment) else "start_angle"
    relative = isinstance(getattr(part, name), Relative)
    return changed(part, {"tangent": True, **({name: None} if relative else {})})


def _clear_solutions(old: Program, new: Program, where: FormPlace) -> Program:
    """Clear the solutions picked at a segment and for the runs that contain it before or after an edit."""
    return _clear_solutions_of_runs(old, _without_solution(new, where.block, where.segment), where)


def _clear_solutions_of_runs(old: Program, new: Program, where: FormPlace) -> Program:
    """Clear the solutions picked for runs that contain a segment or end just before it, before or after an edit."""
    for program in (old, new):
        block = program.blocks[where.block - 1]
        if not any(getattr(segment, "choice", None) is not None for segment in block.segments):
            continue
        for run in solve_block(block, program).runs:
            if run.first <= where.segment <= run.last + 1:
                new = _without_solution(new, where.block, run.first)
    return new


def _without_solution(program: Program, block: int, number: int) -> Program:
    segments = program.blocks[block - 1].segments
    part = segments[number - 1] if number <= len(segments) else None
    if part is None or isinstance(part, CornerSegment) or part.choice is None:
        return program
    return with_part(program, FormPlace(block, number), replace(part, choice=None))


def insert_segment(program: Program, where: FormPlace, segment: Segment) -> Edited:
    """Insert a segment before `where.segment`; one more than the last number appends it."""
    if where.segment == 0:
        return Refused("START is always first.")
    if refusal := _place_refusal(program, replace(where, segment=0)):
        return refusal
    block = program.blocks[where.block - 1]
    before, after = block.segments[: where.segment - 1], block.segments[where.segment - 1 :]
    if not 0 < where.segment <= len(block.segments) + 1:
        return _does_not_exist("segment", where.segment, len(block.segments))
    if isinstance(segment, CornerSegment):
        if not before:
            return Refused(f"A {form_of(segment)} cannot be the first segment: it stands between two others.")
        if other := next((each for each in (*before[-1:], *after[:1]) if isinstance(each, CornerSegment)), None):
            article = "another" if form_of(other) is form_of(segment) else "a"
            return Refused(f"A {form_of(segment)} cannot be next to {article} {form_of(other)}.")
    after = tuple(renumbered(following, where.segment, 1) for following in after)
    edited = with_part(program, FormPlace(where.block), replace(block, segments=(*before, segment, *after)))
    return _clear_solutions_of_runs(edited, edited, where)


def delete_segment(program: Program, where: FormPlace) -> Edited:
    """Delete a segment; the next one then starts at the end of the one before."""
    if where.segment == 0:
        return Refused("START cannot be deleted.")
    if refusal := _place_refusal(program, where):
        return refusal
    block = program.blocks[where.block - 1]
    after = (renumbered(segment, where.segment, -1) for segment in block.segments[where.segment :])
    earlier = _clear_solutions_of_runs(program, program, where).blocks[where.block - 1].segments[: where.segment - 1]
    edited = with_part(program, FormPlace(where.block), replace(block, segments=(*earlier, *after)))
    return _clear_solutions_of_runs(edited, edited, where)


def renumbered(segment: Segment, at: int, step: int) -> Segment:
    """Adjust PARALLEL TO of a segment after segments are inserted from `at` on (step > 0) or `at` is deleted (-1)."""
    target = segment.parallel if isinstance(segment, LineSegment) else None
    if not isinstance(target, Number) or target.value < at:
        return segment
    if step < 0 and target.value == at:
        return changed(segment, {"parallel": Unread(f"{target.value:.0f}", f"Segment {at} was deleted.")})
    return changed(segment, {"parallel": Number(target.value + step)})


def recalculate_lookahead(program: Program, block: int) -> Edited:
    """Go back to the calculated look-ahead: USR becomes CAL."""
    where = FormPlace(block)
    if refusal := _place_refusal(program, where):
        return refusal
    return with_part(program, where, replace(program.blocks[block - 1], lookahead=None))


def new_block(program: Program) -> Block:
    """Return a new block with X START and Y START blank: the first has tool 1, and neither speed nor feeds.

    A later block copies the last block without its segments and look-ahead.  Fields that TOOL SETUP fills stay blank.
    """
    if program.blocks:
        return replace(program.blocks[-1], x_start=None, y_start=None, lookahead=None, segments=())
    zero = Number(0.0)
    return Block(tool=Number(1.0), finish_tool=zero, z_start=zero, peck_depth=zero)


def insert_block(program: Program, at: int) -> Edited:
    """Insert a new block as number `at`, modeled on the block before it; one more than the last number appends it."""
    if not 1 <= at <= len(program.blocks) + 1:
        return _does_not_exist("block", at, len(program.blocks))
    before, after = program.blocks[: at - 1], program.blocks[at - 1 :]
    return replace(program, blocks=(*before, new_block(replace(program, blocks=before)), *after))


SHARED_FIELDS: Final = (
    "tool", "finish_tool", "z_start", "z_bottom", "plunge_feed", "speed", "peck_depth", "coolant"
)  # fmt: skip
"""The fields of START that `share_values` copies: those that are not about the shape of the contour."""


def share_values(program: Program, at: int, *, only_blank: bool) -> Edited:
    """Give the tool, depths, speed, plunge feed and coolant of block `at` to the others, or to their blank fields only.

    Text that cannot be read is not copied.
    """
    if refusal := _place_refusal(program, FormPlace(at)):
        return refusal
    if len(program.blocks) == 1:
        return Refused("There is no other block.")
    values = {name: getattr(program.blocks[at - 1], name) for name in SHARED_FIELDS}
    values = {name: value for name, value in values.items() if not isinstance(value, Unread)}
    blocks = []
    for block in program.blocks:
        copied = {name: value for name, value in values.items() if not only_blank or getattr(block, name) is None}
        blocks.append(changed(block, copied))
    if tuple(blocks) == program.blocks:
        text = f"The other blocks already have the tool, depths, speed, plunge feed and coolant of block {at}."
        return Refused(text)
    return replace(program, blocks=tuple(blocks))


def copy_block(program: Program, at: int) -> Edited:
    """Insert a copy of a block after it."""
    if refusal := _place_refusal(program, FormPlace(at)):
        return refusal
    return replace(program, blocks=(*program.blocks[:at], *program.blocks[at - 1 :]))


def move_block(program: Program, at: int, to: int) -> Edited:
    """Move block `at` so that its number becomes `to`."""
    if refusal := _place_refusal(program, FormPlace(at)) or _place_refusal(program, FormPlace(to)):
        return refusal
    others = program.blocks[: at - 1] + program.blocks[at:]
    return replace(program, blocks=(*others[: to - 1], program.blocks[at - 1], *others[to - 1 :]))


def delete_block(program: Program, at: int) -> Edited:
    """Delete a block; the only block cannot be deleted."""
    if refusal := _place_refusal(program, FormPlace(at)):
        return refusal
    if len(program.blocks) == 1:
        return Refused("The only block cannot be deleted: a program has at least one.")
    return replace(program, blocks=program.blocks[: at - 1] + program.blocks[at:])


def set_tool(program: Program, tool: Tool) -> Edited:
    """Put a tool into the tool table, replacing the one with its number; the table stays sorted by number."""
    if refusal := _field_refusal(field_of(Form.TOOL, "number"), Number(tool.number), program.unit):
        return refusal
    for name in ("diameter", "speed", "feed", "plunge_feed"):
        if refusal := _field_refusal(field_of(Form.TOOL, name), getattr(tool, name), program.unit):
            return refusal
    if refusal := _not_displayable(field_of(Form.TOOL, "type").label, tool.type):
        return refusal
    others = (other for other in program.tools if other.number != tool.number)
    return replace(program, tools=tuple(sorted((*others, tool), key=lambda tool: tool.number)))


def delete_tool(program: Program, number: int) -> Edited:
    """Delete a tool from the table; blocks that call it then report it missing."""
    others = tuple(tool for tool in program.tools if tool.number != number)
    if len(others) == len(program.tools):
        return Refused(f"Tool {number} is not in the tool table.")
    return replace(program, tools=others)


def set_parameter(program: Program, name: str, typed: Typed) -> Edited:
    """Put a typed value, or a blank for the default, into a field of PROGRAM PARAMETERS."""
    if refusal := _field_refusal(field_of(Form.PARAMETERS, name), typed, program.unit):
        return refusal
    return replace(program, parameters=changed(program.parameters, {name: typed}))


def set_path_choice(program: Program, choice: PathChoice) -> Program:
    """Choose which center path is posted."""
    return replace(program, parameters=replace(program.parameters, path=choice))


def set_setup(program: Program, name: str, value: str | Typed) -> Edited:
    """Put a typed value into a field of PART SETUP: text for the name, a number or a blank for the others."""
    field = field_of(Form.SETUP, name)
    if isinstance(value, str):
        if refusal := _not_displayable(field.label, value):
            return refusal
    elif refusal := _field_refusal(field, value, program.unit):
        return refusal
    return replace(program, setup=changed(program.setup, {name: value}))


def _not_displayable(label: str, text: str) -> Refused | None:
    """Refuse a text with a character that no screen displays, such as a pasted non-breaking space."""
    position = next((at for at, character in enumerate(text, 1) if not character.isprintable()), None)
    if position is None:
        return None
    code = f"U+{ord(text[position - 1]):04X}"
    return Refused(f"{label}: character {position} ({code}) cannot be displayed. Type the text again without it.")


def set_unit(program: Program, unit: Unit) -> Program:
    """Convert a program to another unit: every typed length and feed is converted, the part stays the same.

    A blank length stands for the old unit's default, which differs in the new unit: it is written out, so that the same
    part is cut.  A value that equals the new unit's default becomes blank again.
    """
    if program.unit is unit:
        return program
    old = program.unit
    return replace(
        program,
        unit=unit,
        parameters=_converted_defaults(program.parameters, PARAMETERS, old, unit),
        setup=_converted_defaults(program.setup, SETUP, old, unit),
        tools=tuple(_converted(tool, TOOL, old, unit) for tool in program.tools),
        blocks=tuple(_converted_block(block, old, unit) for block in program.blocks),
    )


def _converted_defaults(part: Part, table: tuple[Field, ...], old: Unit, new: Unit) -> Part:
    """Return a converted copy, with blanks written out first and values equal to a default blanked again."""
    converted = _converted(_with_defaults_typed(part, table, old), table, old, new)
    defaults = ((field.name, default_value(field.name, new)) for field in table if field.kind is Kind.LENGTH)
    return changed(
        converted, {name: None for name, value in defaults if value and getattr(converted, name) == Number(value)}
    )


def _with_defaults_typed(part: Part, table: tuple[Field, ...], unit: Unit) -> Part:
    """Return a copy with blank lengths set to the unit's defaults, except those that are 0 in every unit."""
    blank = (field.name for field in table if field.kind is Kind.LENGTH and getattr(part, field.name) is None)
    defaults = ((name, default_value(name, unit)) for name in blank)
    return changed(part, {name: Number(value) for name, value in defaults if value})


def _converted_block(block: Block, old: Unit, new: Unit) -> Block:
    segments = tuple(_converted(segment, STORED_FIELDS[form_of(segment)], old, new) for segment in block.segments)
    return replace(_converted(block, START, old, new), segments=segments)


def _converted(part: Part, table: tuple[Field, ...], old: Unit, new: Unit) -> Part:
    """Return a copy with lengths and feeds converted; unread text stays, with its reason worded in the new unit."""
    typed = [(field, getattr(part, field.name)) for field in table if field.kind in (Kind.LENGTH, Kind.FEED)]
    entries = {
        field.name: type(value)(convert(value.value, old, new))
        for field, value in typed
        if isinstance(value, Number | Relative)
    }
    texts = {
        field.name: Unread(value.text, unread_reason(value.text, field, new))
        for field, value in typed
        if isinstance(value, Unread)
    }
    return changed(part, {**entries, **texts})


def _place_refusal(program: Program, where: FormPlace) -> Refused | None:
    if not 1 <= where.block <= len(program.blocks):
        return _does_not_exist("block", where.block, len(program.blocks))
    count = len(program.blocks[where.block - 1].segments)
    return None if 0 <= where.segment <= count else _does_not_exist("segment", where.segment, count)


def _does_not_exist(noun: str, number: int, count: int) -> Refused:
    last = f"the last is {count}." if count else f"no {noun} is typed yet."
    return Refused(f"{noun.capitalize()} {number} does not exist; {last}")


def _field_refusal(field: Field, typed: Typed, unit: Unit) -> Refused | None:
    """Return a refusal if a field does not accept what was typed."""
    if field.kind is Kind.CHOICE:
        return _wrong_choice(field)
    if isinstance(typed, Relative) and not field.relative:
        return Refused(f"{field.label} takes no relative number: type it without I.")
    text = value_refusal(field, typed.value, unit) if isinstance(typed, Number | Relative) else None
    return None if text is None else Refused(text)


def _wrong_choice(field: Field) -> Refused:
    return Refused(f"{field.label} takes {', '.join(field.choices)}.")


def _lookahead_refusal(block: Block, typed: Typed) -> Refused | None:
    if isinstance(typed, Number | Relative) or typed == block.lookahead:
        return None
    field = field_of(Form.START, "lookahead")
    unreadable = typed is not None and text_refusal(typed.text, field, Unit.MM) is None
    quoted = f" {printable(typed.text)} cannot be read." if unreadable and typed is not None else ""
    remedy = "" if block.lookahead is None else " Press F3 to go back to CAL."
    return Refused(f"{field.label} must be a whole number {range_of(field, Unit.MM)}.{quoted}{remedy}")


def _part(program: Program, where: FormPlace) -> Block | Segment:
    """Return a segment, or the block itself for START."""
    block = program.blocks[where.block - 1]
    return block.segments[where.segment - 1] if where.segment else block


def _field(part: Block | Segment, name: str) -> Field:
    return field_of(Form.START if isinstance(part, Block) else form_of(part), name)


def with_part(program: Program, where: FormPlace, part: Block | Segment) -> Program:
    """Return the program with this part replaced."""
    index = where.block - 1
    if not isinstance(part, Block):
        block = program.blocks[index]
        segments = (*block.segments[: where.segment - 1], part, *block.segments[where.segment :])
        part = replace(block, segments=segments)
    return replace(program, blocks=(*program.blocks[:index], part, *program.blocks[index + 1 :]))
