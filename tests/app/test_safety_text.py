"""Text from files never reaches a terminal or an NC file as control characters."""

from __future__ import annotations

import json
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pytest

from app.__main__ import main
from app.documents.files import save
from core.program.fields import FIELDS_OF_FORM, Form
from core.program.file.read import loads
from core.program.model import CutterComp
from core.units import Kind
from tests.core.program.parts import line, program
from tests.terminal import cutcomp, running

EVIL = "\x1b]0;a\x07\x1b[2J\u009b5n\x7f\r\u202e[/q])(M30%\u2028"
"""A title, a cleared screen, a terminal query, reversed text, invalid Textual markup, the end of a comment, a new
line."""


ESCAPES = ("\x1b]0;", "\x1b[2J")
"""Sequences a terminal would obey; the program itself sends neither."""


def unread(form: Form, path: str) -> str:
    """A table of unread texts for all number fields of a form."""
    names = [field.name for field in FIELDS_OF_FORM[form] if field.kind not in (Kind.CHOICE, Kind.TEXT)]
    lines = [f"{name} = {json.dumps(EVIL)}\n" for name in names if name not in ("number", "lookahead")]
    return f"[{path}.unread]\n{''.join(lines)}"


HOSTILE = (
    'format = 1\nunits = "IN"\n'
    + unread(Form.PARAMETERS, "parameters")
    + '[setup]\nname = "A (MSG, B) % \u00d8"\n'
    + unread(Form.SETUP, "setup")
    + '[[tool]]\nnumber = 1\ntype = ") [/q] (MSG, x) %"\n'
    + unread(Form.TOOL, "tool")
    + '[[block]]\nkind = "MILL CONTOUR"\ncutter_comp = "LEFT"\n'
    + unread(Form.START, "block")
    + '[[block.segment]]\nkind = "LINE"\n'
    + unread(Form.LINE, "block.segment")
    + '[[block.segment]]\nkind = "ARC"\ndirection = "CW"\n'
    + unread(Form.ARC, "block.segment")
    + '[[block.segment]]\nkind = "BLEND ARC"\n'
    + unread(Form.BLEND, "block.segment")
)


@pytest.fixture
def part(tmp_path: Path) -> Path:
    path = tmp_path / "c[" / "d]a\x1b[2J\u202eb.toml"
    path.parent.mkdir()
    path.write_text(HOSTILE, encoding="utf-8")
    return path


def harmless(text: str) -> bool:
    return all(line.isprintable() for line in text.split("\n"))


def test_the_hostile_text_is_a_valid_program() -> None:
    assert loads(HOSTILE, "hostile").blocks[0].segments
    assert not harmless(EVIL)


BACK = b"\x1b8"
FORM = "MILL CONTOUR"
STEPS = (
    (b"\t\t\t\t", "cannot be read"),
    (b"\x1b[1;5H1\r\t?", "HELP"),
    (b"\r", FORM),
    (b"\x1b[6~\t\t", "LINE"),
    (b"\x1b[6~\t", "ARC"),
    (b"\x1bOS", "PROGRAM PARAMETERS"),
    (b"\t", "cannot be read"),
    (BACK, FORM),
    (b"\x1b[15~", "PART SETUP"),
    (b"\t", "cannot be read"),
    (BACK, FORM),
    (b"\x1b[17~", "TOOL SETUP"),
    (b"\t\t", "cannot be read"),
    (BACK, FORM),
    (b"\x1b[18~", "DRAW "),
    (BACK, FORM),
    (b"\x1b[20~", "Up and down choose a segment."),
    (b"\x1b[20~", "cannot be read"),
    (b"\x1b[21~", "Up and down show the places"),
    (b"\x1b[21~", "cannot be read"),
    (BACK, "1 block"),
    (b"\x1bOR", "NC file name"),
    (BACK, "1 block"),
    (b"\x0f", "CUTCOMP"),
)
"""The keys through every screen of a program, and the text that each screen then shows."""


def test_no_screen_sends_control_characters_of_a_file(part: Path) -> None:
    """The output of the program contains none of the dangerous characters of the file."""
    with running(cutcomp(str(part)), cwd=str(part.parent)) as terminal:
        terminal.until(FORM, longest=60.0)
        for keys, text in STEPS:
            terminal.send(keys)
            terminal.until(text, longest=60.0)
            terminal.read(quiet=0.05, longest=0.5)
        terminal.send(b"\x11")
        ended = terminal.status(longest=60.0)
        sent = bytes(terminal.seen).decode()
    assert ended == 0
    assert sent.count("[/q]") > 10, "nothing of it was shown"
    assert [evil for evil in (*ESCAPES, "\x7f", "\u202e", "\u2028", "\u009b") if evil in sent] == []


def test_nc_proof_sends_no_control_characters_of_a_file(tmp_path: Path) -> None:
    nc = tmp_path / "c[" / "d]evil.nc"
    nc.parent.mkdir()
    nc.write_text(f"G20\n({EVIL.replace(chr(13), '')})\nM30\n", encoding="utf-8")
    with running(cutcomp(str(nc)), cwd=str(tmp_path)) as terminal:
        terminal.until("NC PROOF", longest=20.0)
        terminal.read(quiet=0.3)
        sent = bytes(terminal.seen).decode()
    assert "5n" in sent, "nothing of it was shown"
    assert [evil for evil in (*ESCAPES, "\x7f", "\u202e", "\u2028", "\u009b") if evil in sent] == []


COMMANDS = [
    ["path"],
    ["path", "--json"],
    ["lookahead"],
    ["lookahead", "--json"],
    ["post"],
    ["post", "--override", "POST WITH GOUGE"],
    ["plot"],
    ["sheet"],
    ["tools"],
    ["check", "--control", "all"],
]


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
@pytest.mark.parametrize("content", [HOSTILE, HOSTILE + f"\nx = {json.dumps(EVIL)}\n", f'x = "{EVIL}"\n'])
def test_no_command_prints_control_characters_of_a_file(
    part: Path, command: list[str], content: str, capsys: pytest.CaptureFixture[str]
) -> None:
    part.write_text(content, encoding="utf-8")
    with suppress(SystemExit):
        main([*command, str(part)])
    output = capsys.readouterr()
    assert harmless(output.out), output.out
    assert harmless(output.err), output.err


def test_names_appear_only_as_comments_in_an_nc_file(tmp_path: Path) -> None:
    """A name cannot end its comment, start a command, or end the file."""
    part = Path(tmp_path / "M99 %)(.toml")
    sides = (line(x_end=x, y_end=y) for x, y in ((30.0, 0.0), (30.0, 30.0), (0.0, 30.0), (0.0, 0.0)))
    square = program(*sides, start={"cutter_comp": CutterComp.ON})
    save(square, part)
    text = part.read_text(encoding="utf-8")
    part.write_text(
        text.replace("END MILL", ") G0 Z-9 (MSG, %").replace("[[tool]]", '[setup]\nname = ")M30"\n[[tool]]')
    )
    result = subprocess.run(
        [sys.executable, "-m", "app", "post", str(part)], capture_output=True, text=True, check=False
    )
    assert result.returncode == 0, result.stderr
    for row in result.stdout.splitlines():
        code, _, comment = row.partition("(")
        assert "Z-9" not in code
        assert comment.count("(") == 0
        assert comment.count(")") == (1 if comment else 0)
        assert "%" not in comment
    assert result.stdout.count("M30") - result.stdout.count("]M30") == 1
