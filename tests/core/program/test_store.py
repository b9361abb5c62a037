"""Program files: what is written reads back the same, what is wrong is named, nothing is ever lost."""

from __future__ import annotations

import errno
import os
import stat
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.program import store
from core.program.edit import set_unit
from core.program.model import Entry, Program, Unread
from core.program.store import StoreError, dumps, load, loads, save, write_output
from core.units import Unit
from tests.core.program.parts import arc, blend, line, program, programs

BAD = Path(__file__).parents[2] / "data" / "bad" / "program"
EXAMPLES = Path(__file__).parents[3] / "app" / "examples"

PART = program(
    line(x_end=2.0, y_end=0.1, feed=10.0),
    blend(0.25),
    arc("CCW", x_end=2.5, y_end=0.5, radius=0.5, choice=1),
    unit=Unit.IN,
    x=-1.0,
    start={"lookahead": Entry(4.0), "z_bottom": Unread("-1/4x", "why")},
)

TEXT = """\
format = 1
units = "IN"  # every length and feed below is in it

[parameters]
path = "CONTROL"

[[tool]]
number = 1
type = "END MILL"
diameter = 0.5

[[block]]
kind = "MILL CONTOUR"
tool = 1
cutter_comp = "LEFT"
finish_tool = 0
x_start = -1.0
y_start = 0.0
z_start = 0.0
plunge_feed = 20.0
speed = 300
peck_depth = 0.0
lookahead = 4

[block.unread]
z_bottom = "-1/4x"

[[block.segment]]
kind = "LINE"
x_end = 2.0
y_end = 0.1
feed = 10.0

[[block.segment]]
kind = "BLEND ARC"
radius = 0.25

[[block.segment]]
kind = "ARC"
direction = "CCW"
x_end = 2.5
y_end = 0.5
radius = 0.5
choice = 1
"""


def test_the_text_of_a_program():
    assert dumps(PART) == TEXT


@settings(derandomize=True, max_examples=80, deadline=None)
@given(programs)
def test_every_program_reads_back_the_same(given_program):
    assert loads(dumps(given_program), "x") == given_program


def test_what_could_not_be_read_is_kept_with_its_reason():
    z_bottom = loads(TEXT, "x").blocks[0].z_bottom
    assert isinstance(z_bottom, Unread)
    assert z_bottom.text == "-1/4x"
    assert z_bottom.reason.startswith("x is not understood here")


def test_unread_text_that_could_be_read_now_never_becomes_a_number():
    z_bottom = loads(TEXT.replace("-1/4x", "-1/4"), "x").blocks[0].z_bottom
    assert z_bottom == Unread("-1/4", "Type it again.")


def test_half_characters_do_not_stop_saving():
    odd = program(start={"speed": Unread("\udcb0x\x7f\x00", "why")})
    speed = loads(dumps(odd), "x").blocks[0].speed
    assert isinstance(speed, Unread)
    assert speed.text == "?x\x7f\x00"


def test_a_whole_number_may_stand_for_a_length():
    assert loads(TEXT.replace("x_start = -1.0", "x_start = -1"), "x").blocks[0].x_start == Entry(-1.0)


def test_blanks_stay_blank():
    empty = loads('format = 1\nunits = "MM"\n', "x")
    assert empty == Program(unit=Unit.MM)
    bare = 'format = 1\nunits = "MM"\n[[block]]\nkind = "MILL CONTOUR"\ncutter_comp = "ON"\n'
    assert loads(bare, "x").blocks[0].x_start is None


def test_a_number_out_of_its_fields_range_is_kept_for_the_form_to_show():
    text = TEXT.replace("diameter = 0.5", "diameter = -0.5").replace("speed = 300", "speed = -1")
    assert loads(text, "x").tools[0].diameter == Entry(-0.5)
    assert loads(text, "x").blocks[0].speed == Entry(-1.0)


@pytest.mark.parametrize("path", sorted(BAD.glob("*.toml")), ids=lambda path: path.stem)
def test_bad_files_are_refused_by_line_and_key(path):
    before = path.read_bytes()
    with pytest.raises(StoreError) as refused:
        load(path)
    assert path.with_suffix(".txt").read_text().strip() in refused.value.text
    assert refused.value.text.startswith(f"{path}")
    assert path.read_bytes() == before


@pytest.mark.parametrize("length", range(0, len(TEXT), 7))
def test_a_truncated_file_is_a_shorter_program_or_refused(length):
    try:
        read = loads(TEXT[:length], "part.toml")
    except StoreError as error:
        read = None
        message = error.text
    if read is None:
        assert message.startswith("part.toml")
    else:
        assert len(read.blocks) <= 1


def test_a_syntax_error_says_line_and_column():
    with pytest.raises(StoreError, match=r"part.toml, line 3, column 5: Invalid value. Correct it there"):
        loads('format = 1\nunits = "IN"\nx = ]\n', "part.toml")


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.toml")), ids=lambda path: path.stem)
def test_examples_are_as_this_program_writes_them(path):
    assert dumps(load(path)) == path.read_text()


def test_save_and_load(tmp_path):
    path = tmp_path / "part.toml"
    save(PART, path)
    assert dumps(load(path)) == TEXT
    save(Program(), str(path))
    assert load(str(path)) == Program()
    assert list(tmp_path.iterdir()) == [path]


def test_a_byte_order_mark_is_no_trouble(tmp_path):
    path = tmp_path / "part.toml"
    path.write_bytes(b"\xef\xbb\xbf" + TEXT.encode())
    assert dumps(load(path)) == TEXT


def test_the_mode_stays(tmp_path):
    path = tmp_path / "part.toml"
    save(PART, path)
    path.chmod(0o640)
    save(Program(), path)
    assert stat.S_IMODE(path.stat().st_mode) == 0o640


def test_a_new_file_has_the_mode_other_programs_give(tmp_path):
    (tmp_path / "usual").touch()
    save(PART, tmp_path / "part.toml")
    assert (tmp_path / "part.toml").stat().st_mode == (tmp_path / "usual").stat().st_mode


def test_a_link_stays_a_link(tmp_path):
    real, link = tmp_path / "real.toml", tmp_path / "link.toml"
    save(Program(), real)
    link.symlink_to(real)
    save(PART, link)
    assert link.is_symlink()
    assert dumps(load(real)) == TEXT


def refusal(act: Callable[[], object]) -> str:
    with pytest.raises(StoreError) as refused:
        act()
    return refused.value.text


def test_loading_what_is_no_file(tmp_path):
    assert refusal(lambda: load(tmp_path)).endswith("this is not a file. Choose the name of a file.")
    missing = tmp_path / "none.toml"
    words = f"{missing} cannot be read: there is no such file or folder. Check the name."
    assert refusal(lambda: load(missing)) == words
    assert refusal(lambda: load(tmp_path / "a\0b")).endswith("this is no file name. Choose another.")
    assert refusal(lambda: load(tmp_path / ("n" * 300))).endswith("the name is too long. Choose a shorter one.")
    os.mkfifo(tmp_path / "pipe")
    assert refusal(lambda: load(tmp_path / "pipe")).endswith("this is not a file. Choose the name of a file.")


def test_loading_what_is_no_text(tmp_path):
    path = tmp_path / "part.toml"
    path.write_bytes(b'format = 1\nunits = "\xb0"\n')
    assert "line 2: this is not UTF-8 text" in refusal(lambda: load(path))
    path.write_bytes(b"#" * (store.LARGEST_FILE + 1))
    assert "too large for a program file" in refusal(lambda: load(path))


def test_loading_what_may_not_be_read(tmp_path, monkeypatch):
    path = tmp_path / "part.toml"
    save(PART, path)

    def forbidden(*_args: object, **_named: object) -> None:
        raise PermissionError(errno.EACCES, "Permission denied")

    monkeypatch.setattr(Path, "open", forbidden)
    assert refusal(lambda: load(path)).endswith("it is protected. Ask for permission, or choose another place.")


def test_saving_where_no_file_can_be(tmp_path):
    assert refusal(lambda: save(PART, tmp_path)).endswith("this is not a file. Choose the name of a file.")
    nowhere = tmp_path / "none" / "part.toml"
    assert refusal(lambda: save(PART, nowhere)).startswith(f"{nowhere} is not saved: there is no such file or folder.")
    assert refusal(lambda: save(PART, tmp_path / "a\0b")).endswith("this is no file name. Choose another.")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("call", ["write", "fsync", "fchmod", "close"])
@pytest.mark.parametrize(
    ("number", "words"), [(errno.ENOSPC, "the disk is full"), (errno.EDQUOT, "the disk is full"), (errno.EIO, "Input")]
)
def test_a_disk_that_fails_leaves_the_old_file_and_nothing_beside_it(tmp_path, monkeypatch, call, number, words):
    path = tmp_path / "part.toml"
    save(PART, path)
    real = getattr(os, call)

    def failing(*args: object) -> None:
        if call == "close":
            real(*args)
        raise OSError(number, os.strerror(number))

    with monkeypatch.context() as patch:
        patch.setattr(os, call, failing)
        assert words in refusal(lambda: save(Program(), path))
    assert dumps(load(path)) == TEXT
    assert list(tmp_path.iterdir()) == [path]


def test_a_rename_that_fails_leaves_the_old_file_and_nothing_beside_it(tmp_path, monkeypatch):
    path = tmp_path / "part.toml"
    save(PART, path)

    def failing(*_args: object) -> None:
        raise OSError(errno.EROFS, os.strerror(errno.EROFS))

    with monkeypatch.context() as patch:
        patch.setattr(Path, "replace", failing)
        assert "the disk is write protected" in refusal(lambda: save(Program(), path))
    assert dumps(load(path)) == TEXT
    assert list(tmp_path.iterdir()) == [path]


def test_a_write_in_pieces_is_whole(tmp_path, monkeypatch):
    real = os.write
    monkeypatch.setattr(os, "write", lambda handle, data: real(handle, data[:5]))
    save(PART, tmp_path / "part.toml")
    assert (tmp_path / "part.toml").read_text() == TEXT


def test_a_write_protected_file_is_not_replaced(tmp_path, monkeypatch):
    path = tmp_path / "part.toml"
    save(PART, path)
    path.chmod(0o444)
    monkeypatch.setattr(os, "access", lambda *_args: False)
    assert "it is protected" in refusal(lambda: save(Program(), path))
    assert dumps(load(path)) == TEXT


def test_interrupted_saving_leaves_nothing_beside_the_file(tmp_path, monkeypatch):
    path = tmp_path / "part.toml"

    def interrupted(_handle: int) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "fsync", interrupted)
    with pytest.raises(KeyboardInterrupt):
        save(PART, path)
    assert list(tmp_path.iterdir()) == []


def test_a_file_size_limit_stands_for_a_really_full_disk(tmp_path):
    """The kernel itself refuses the write here: a child process may write files of 100 bytes only."""
    path = tmp_path / "part.toml"
    save(PART, path)
    script = (
        "import resource, signal, sys; from core.program.store import StoreError, load, save\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        "part = load(sys.argv[1])\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))\n"
        "try: save(part, sys.argv[1])\n"
        "except StoreError as error: print(error.text)\n"
    )
    done = subprocess.run([sys.executable, "-c", script, str(path)], capture_output=True, text=True, check=True)
    assert done.stdout.strip().startswith(f"{path} is not saved: it is too large")
    assert dumps(load(path)) == TEXT
    assert list(tmp_path.iterdir()) == [path]


@settings(derandomize=True, max_examples=100, deadline=None)
@given(st.floats(-393700.0, 393700.0), st.sampled_from(Unit))
def test_what_could_be_read_can_be_read_in_the_other_unit_too(value, unit):
    text = dumps(program(start={"x_start": Entry(value)}, unit=unit))
    part = loads(text, "x")
    other = Unit.IN if unit is Unit.MM else Unit.MM
    turned = set_unit(part, other)
    assert loads(dumps(turned), "x") == turned


def test_output_is_never_written_over_a_program(tmp_path):
    part, other, fresh = tmp_path / "part.toml", tmp_path / "renamed", tmp_path / "part.nc"
    save(Program(), part)
    other.write_bytes(part.read_bytes())
    for target in (part, other, tmp_path / "new.toml"):
        with pytest.raises(StoreError, match="Name another file"):
            write_output(target, "M2")
    assert part.read_bytes() == other.read_bytes()
    assert load(part) == Program()
    write_output(fresh, "M2")
    assert fresh.read_text() == "M2"
