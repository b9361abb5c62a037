"""Labels, subprograms, repeats, Q parameters and jumps on a condition."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from math import isclose
from typing import Final, NoReturn

from core.controls.klartext.blocks import Block
from core.controls.klartext.formula import NoValue, evaluate
from core.controls.klartext.setup import unknown
from core.controls.klartext.state import State
from core.controls.program_text import quoted

DEEPEST: Final = 19
"""Subprograms that may call one another."""

_LABEL: Final = re.compile(r'\s*("[^"]*"|\d+)\s*$', re.ASCII)
_CALL: Final = re.compile(r'\s*LBL\s*("[^"]*"|\d+)\s*(?:REP\s*(\d{1,5})(?:/\d+)?)?\s*$', re.ASCII)
_SET: Final = re.compile(r"\s*(\d+)\s*=(.*)$", re.ASCII)
_FUNCTION: Final = re.compile(r"\s*(\d+)\s*:\s*(.*)$", re.ASCII)
_ASSIGN: Final = re.compile(r"(Q[LR]?\d+)\s*=(.*)$", re.ASCII)
_COMPARISON: Final = re.compile(r"EQU|NE(?!G)|GT|LT", re.ASCII)
_GOAL: Final = re.compile(r'\s*LBL\s*("[^"]*"|\d+)\s*$', re.ASCII)


def labels_of(blocks: Sequence[Block]) -> Mapping[str, int]:
    """The block behind each label, the first where one stands twice; LBL 0 is the end of a subprogram, no label."""
    found: dict[str, int] = {}
    for index, block in enumerate(blocks):
        if block.head == "LBL" and (label := _LABEL.match(block.body)) and label[1] != "0":
            found.setdefault(label[1], index + 1)
    return found


def label(state: State, block: Block) -> None:
    """LBL n: a place to jump to; LBL 0 ends a subprogram."""
    found = _LABEL.match(block.body)
    if found is None:
        state.stop("LABEL", "LBL needs a number or a name in quotes.", block)
    if found[1] == "0" and state.calls:
        state.next = state.calls.pop()[1]


def call(state: State, block: Block) -> None:
    """CALL LBL n runs a subprogram; with REP m the part from LBL n to here is run m times more."""
    found = _CALL.match(block.body)
    if found is None:
        unknown(state, block)
        return
    if found[2]:
        left = state.repeats.pop(state.next, int(found[2]))
        if left > 0:
            state.repeats[state.next] = left - 1
            _jump(state, block, found[1])
        return
    if len(state.calls) >= DEEPEST or any(name == found[1] for name, _ in state.calls):
        text = f"LBL {quoted(found[1])} calls itself, or subprograms are more than {DEEPEST} deep; end them with LBL 0."
        state.stop("LABEL", text, block)
    state.calls.append((found[1], state.next))
    _jump(state, block, found[1])


def _jump(state: State, block: Block, name: str) -> None:
    if name not in state.labels:
        state.stop("LABEL", f"There is no LBL {quoted(name)} in this program.", block)
    state.next = state.labels[name]


def parameter(state: State, block: Block) -> None:
    """Q1 = formula."""
    found = _SET.match(block.body)
    if found is None:
        state.stop("Q", "A Q parameter is set by = and a formula.", block)
    _assign(state, block, f"{block.head}{found[1]}", found[2])


def _assign(state: State, block: Block, name: str, formula: str) -> None:
    value = evaluate(formula, state.parameters)
    if isinstance(value, NoValue):
        _no_value(state, block, value)
    state.parameters[name] = value


def _no_value(state: State, block: Block, value: NoValue) -> NoReturn:
    state.stop("Q", value.text, block)


def function(state: State, block: Block) -> None:
    """FN 0 to FN 13: assignments, and jumps on a condition; the others are not worked out here."""
    found = _FUNCTION.match(block.body)
    number = int(found[1][:4]) if found else -1
    rest = found[2] if found else ""
    if 9 <= number <= 12:
        condition(state, block._replace(body=rest))
    elif 0 <= number <= 13 and (given := _ASSIGN.match(rest)):
        formula = {5: "SQRT", 6: "SIN", 7: "COS"}.get(number, "")
        _assign(state, block, given[1], given[2] if formula in given[2] else f"{formula} {given[2]}")
    else:
        unknown(state, block)


def condition(state: State, block: Block) -> None:
    """IF a EQU, NE, GT or LT b GOTO LBL n."""
    question, _, goal = block.body.strip().removeprefix("IF").partition("GOTO")
    found, label = _COMPARISON.search(question), _GOAL.match(goal)
    if found is None or label is None:
        unknown(state, block)
        return
    first = evaluate(question[: found.start()], state.parameters)
    second = evaluate(question[found.end() :], state.parameters)
    if isinstance(first, NoValue):
        _no_value(state, block, first)
    if isinstance(second, NoValue):
        _no_value(state, block, second)
    equal = isclose(first, second, rel_tol=0.0, abs_tol=1e-9)
    holds = {"EQU": equal, "NE": not equal, "GT": first > second and not equal, "LT": first < second and not equal}
    if holds[found[0]]:
        _jump(state, block, label[1])
