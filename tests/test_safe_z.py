"""Tool changes happen at SAFE Z: every program that is posted for an example, read by a reader of its own."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from app.__main__ import main
from tests.core.controls.some_controls import FIRST_VARIANTS

EXAMPLES = sorted((Path(__file__).parents[1] / "app" / "examples").glob("*.toml"))
TOOLS = {"flange": (1, 2), "notch": (1,), "overrun-square": (1,), "plate-mm": (1, 2), "pocket": (1,)}
"""Tools of the examples in the order they are called."""
SWAPPED = {name: (1, 2, 1, 2, 1) if name == "flange" else (1, 2, 1) for name in TOOLS}
"""The same for their rich forms."""


@dataclass(frozen=True)
class Change:
    """A tool change, or the end of the program: the height it happens at, and the first move after it."""

    tool: int | None
    line: str
    z: float | None
    next_move: str = ""


def changes(text: str) -> Iterator[Change]:
    """Tool changes and the end, in the order of the program; the height is None before the first move."""
    z: float | None = None
    in_spindle: int | None = None
    lines = [re.sub(r"\(.*?\)|;.*", "", line) for line in text.splitlines()]
    for row, line in enumerate(lines):
        heights = re.findall(r"Z([-+]?\d*\.?\d+)", line)
        assert len(heights) <= 1
        z = float(heights[0]) if heights else z
        if called := re.search(r"TOOL CALL (\d+)|T(\d+) ?M6(?!\d)", line):
            tool = int(called[1] or called[2])
            if tool != in_spindle:
                in_spindle = tool
                yield Change(tool, line, z, next(other for other in lines[row + 1 :] if re.search("[XYZ]", other)))
        else:
            assert not re.search(r"M0?6(?!\d)", line)
        if re.search(r"M(30|0?2)(?!\d)", line):
            yield Change(None, line, z)


def rich(text: str, work_offset: int, safe_z: float) -> str:
    """A program with pecks, a finish tool, another work offset, and each block once more with the tools swapped."""
    size = 1.0 if 'units = "IN"' in text else 25.4
    head, *blocks = text.replace("# end of program", "").split("[[block]]")
    swapped = ""
    for block in blocks:
        block = re.sub(r"peck_depth = .*", f"peck_depth = {0.07 * size}", block)
        for tool, finish_tool in ((1, 2), (2, 1)):
            block = re.sub(r"\ntool = .*", f"\ntool = {tool}", block)
            swapped += "[[block]]" + re.sub(r"finish_tool = .*", f"finish_tool = {finish_tool}", block)
    head = head.replace("[setup]", f"[setup]\nwork_offset = {work_offset}\nsafe_z = {safe_z}")
    if "number = 2" not in head:
        diameter = re.findall(r"diameter = (.*)", head)[0]
        head += f'[[tool]]\nnumber = 2\ntype = "END MILL"\ndiameter = {diameter}\n\n'
    return f"{head}{swapped}# end of program\n"


def safe_z_of(file: Path) -> float:
    """The usual SAFE Z, which the examples take."""
    return 1.0 if 'units = "IN"' in file.read_text() else 25.0


def posted(file: Path, capsys: pytest.CaptureFixture[str], *options: str) -> str:
    main(["post", str(file), *options])
    return capsys.readouterr().out


def assert_changes_at(safe_z: float, text: str, *tools: int) -> None:
    found = list(changes(text))
    assert [change.tool for change in found] == [*tools, None]
    assert [change.z for change in found] == [None, *[safe_z] * len(tools)]
    for change in found[:-1]:
        # straight up before anything else
        assert re.fullmatch(r"(\d+ )?(G0 ?(G43 ?H\d+ ?)?|L )Z[+]?[\d.]+( R0 FMAX M3)?", change.next_move), change


@pytest.mark.parametrize("file", EXAMPLES, ids=lambda file: file.stem)
def test_every_tool_change_of_an_example_is_at_safe_z(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = posted(file, capsys, "--override", "POST WITH GOUGE")
    assert_changes_at(safe_z_of(file), text, *TOOLS[file.stem])


@pytest.mark.parametrize("file", EXAMPLES, ids=lambda file: file.stem)
@pytest.mark.parametrize(("work_offset", "safe_z"), [(54, 2.5), (55, 60.0), (57, 25.4), (59, 3.1416)])
def test_every_tool_change_between_blocks_pecks_and_passes_is_at_safe_z(
    file: Path, work_offset: int, safe_z: float, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    program = tmp_path / "rich.toml"
    program.write_text(rich(file.read_text(), work_offset, safe_z))
    text = posted(program, capsys, "--override", "POST WITH GOUGE")
    assert f"G{work_offset}" in text
    assert_changes_at(safe_z, text, *SWAPPED[file.stem])


@pytest.mark.parametrize(
    ("name", "control"),
    [*(("flange", control) for control in FIRST_VARIANTS), ("plate-mm", "klartext"), ("plate-mm", "linuxcnc")],
)
def test_every_tool_change_for_a_control_is_at_safe_z(
    name: str, control: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = next(file for file in EXAMPLES if file.stem == name)
    program = tmp_path / "rich.toml"
    program.write_text(rich(file.read_text(), 56, 40.0))
    assert_changes_at(40.0, posted(program, capsys, "--control", control), *SWAPPED[name])


@pytest.mark.parametrize("control", FIRST_VARIANTS)
def test_every_example_that_a_control_posts_changes_tools_at_safe_z(
    control: str, capsys: pytest.CaptureFixture[str]
) -> None:
    texts = {file: text for file in EXAMPLES if (text := posted(file, capsys, "--control", control))}
    for file, text in texts.items():
        assert_changes_at(safe_z_of(file), text, *TOOLS[file.stem])
    assert {"flange", "plate-mm"} <= {file.stem for file in texts}
