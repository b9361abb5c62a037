"""A program file that is cut off is refused, wherever it was cut; one that never told its end is not."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from core.program.file.store import StoreError, dumps, load, loads, save
from core.program.model import Program
from tests.core.program.stored import PART, TEXT

EXAMPLES = sorted((Path(__file__).parents[3] / "app" / "examples").glob("*.toml"))
END = "# end of program"
UNTOLD = TEXT.replace(f'  # its last line is "{END}"', "").replace(f"\n{END}\n", "")


def refusal(text: str) -> str:
    with pytest.raises(StoreError) as refused:
        loads(text, "part.toml")
    return refused.value.text


def test_a_file_says_what_its_last_line_is():
    lines = TEXT.splitlines()
    assert lines[0] == f'format = 1  # its last line is "{END}"'
    assert lines[-1] == END


@pytest.mark.parametrize("part", [None, *EXAMPLES], ids=lambda path: "everything" if path is None else path.stem)
def test_cut_at_any_byte_it_is_the_whole_program_or_refused(tmp_path: Path, part: Path | None) -> None:
    whole = PART if part is None else load(part)
    path = tmp_path / "part.toml"
    save(whole, path)
    data = path.read_bytes()
    for length in range(len(data)):
        path.write_bytes(data[:length])
        found = outcome(path)
        if isinstance(found, str):
            assert re.fullmatch(rf"{re.escape(str(path))}(, line \d+(, \w+)?)?: .+\.", found)
        else:
            assert (found, length) == (loads(data.decode(), "x"), len(data) - 1)


def outcome(path: Path) -> Program | str:
    try:
        return load(path)
    except StoreError as error:
        return error.text


def test_a_name_cut_in_the_middle_of_a_letter_is_a_file_cut_off(tmp_path: Path) -> None:
    path = tmp_path / "part.toml"
    data = TEXT.replace("END MILL", "FR\u00c4SER").encode()
    path.write_bytes(data[: data.index(b"\xc3") + 1])
    with pytest.raises(StoreError, match=r'part.toml, line 9: cut off behind "type = .*": the last line'):
        load(path)


def test_the_sentence_names_the_last_line_and_what_to_do():
    cut = TEXT[: TEXT.index("y_end = 0.1") + len("y_end = 0")]
    line = cut.count("\n") + 1
    assert refusal(cut) == (
        f'part.toml, line {line}: cut off behind "y_end = 0": the last line, "{END}", is missing. '
        "Open a saved copy or an earlier version; if nothing is missing, add that line."
    )


def test_blank_lines_behind_the_cut_are_not_its_last_line():
    cut = TEXT[: TEXT.index("y_end = 0.1")] + "\n  \n\n"
    assert f'line {TEXT[: TEXT.index("y_end = 0.1")].count(chr(10))}: cut off behind "x_end = 2.0"' in refusal(cut)


@pytest.mark.parametrize(
    "text",
    [
        TEXT.replace("\n", "\r\n"),
        TEXT.rstrip(),
        TEXT + "\n\n",
        TEXT.replace(END + "\n", f"  {END}  \n"),
        UNTOLD,
        UNTOLD + f"\n{END}\n",
    ],
    ids=["dos", "no line feed", "blank lines", "indented", "older", "end alone"],
)
def test_what_editors_and_mail_do_to_a_file_and_older_files_are_no_trouble(text: str) -> None:
    assert dumps(loads(text, "x")) == TEXT


def test_a_segment_added_by_hand_behind_the_end_counts():
    more = TEXT + '[[block.segment]]\nkind = "LINE"\nx_end = 4.0\n'
    assert len(loads(more, "x").blocks[0].segments) == len(PART.blocks[0].segments) + 1


def test_a_text_that_reads_like_the_end_is_not_the_end():
    named = Program(setup=Program().setup.__class__(name=END))
    text = dumps(named)
    assert loads(text, "x") == named
    assert "cut off" in refusal(text.removesuffix(f"{END}\n"))


@pytest.mark.parametrize(
    ("cut", "said"),
    [
        ("x_start =", "line 17, x_start: Invalid value."),
        ("x_start = -", "line 17, x_start: Invalid value."),
        ("x_st", "line 17: Expected '=' after a key in a key/value pair."),
        ("speed = 30", None),
        ('kind = "LI', "line 29, kind: Unterminated string."),
        ("[[block.segm", "line 28: Expected ']]' at the end of an array declaration."),
    ],
)
def test_a_file_without_an_end_that_stops_in_the_middle_of_a_line_may_be_cut_off(cut: str, said: str | None) -> None:
    where = UNTOLD.index(cut[:6] if cut.startswith("x_st") else cut)
    text = UNTOLD[:where] + cut
    if said is None:
        loads(text, "x")
        return
    told = refusal(text)
    assert told.startswith(f"part.toml, {said}")
    assert told.endswith(" The file may be cut off there: open a saved copy or an earlier version, or mend the line.")


def test_a_fault_in_the_middle_is_a_fault_of_its_line():
    assert refusal(TEXT.replace("x_end = 2.0", "x_end = 2.0.1")).endswith("Correct it there, or open a saved copy.")


@pytest.mark.parametrize("begin", ["", "  "])
def test_a_key_that_stands_twice_is_named(begin: str) -> None:
    told = refusal(UNTOLD.replace("speed = 300", f"speed = 300\n{begin}speed = 400"))
    line = UNTOLD[: UNTOLD.index("speed = 300")].count("\n") + 2
    assert told == f"part.toml, line {line}: speed stands twice: remove one."
