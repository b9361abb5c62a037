"""NC programs being edited: what comes back after a crash, who may write, what stays behind."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.documents.journal_file import journal_path, lines
from app.documents.lock import Owner, lock_path, myself, take
from app.documents.nc_text import NcText
from app.documents.programs import empty_program
from app.painted.desk import Desk
from app.painted.nc_journal import differences, found_in, steps, whole
from app.painted.nc_keeping import NcKeeping
from app.painted.screens.decide import Decide
from app.painted.screens.proof import ProofPage
from app.painted.screens.proof_files import opening
from app.painted.session import Session
from tests.app.kept import DEAD, ELSEWHERE, TIME
from tests.app.operator import Operator

TEXT = b"G20 G17\r\nG0 X1.\r\n\xb0 M30\r\n"
ME = replace(myself(TIME), user=DEAD.user)


@dataclass
class Typist(Operator):
    """A person at NC PROOF whose work is kept after every key."""

    keeping: NcKeeping

    def press(self, *keys: str) -> Typist:
        for key in keys:
            super().press(key)
            self.desk = self.keeping.keep(self.desk)
        return self

    @property
    def page(self) -> ProofPage:
        return next(page for page in self.desk.pages if isinstance(page, ProofPage))

    @property
    def texts(self) -> list[str]:
        return [self.page.listing.text(row) for row in range(len(self.page.listing))]

    def killed(self) -> None:
        """kill -9: only the handles are closed."""
        for one in self.keeping.kept.values():
            if one.journal is not None:
                one.journal.close()


def typist(file: Path, me: Owner = DEAD) -> Typist:
    keeping = NcKeeping(me, file.parent / "own", lambda: TIME)
    desk = opening(file)(Desk(Session.of(empty_program())))
    return Typist(keeping.keep(desk), keeping)


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "part.nc"
    path.write_bytes(TEXT)
    return path


def asked(one: Typist) -> Decide:
    page = one.desk.page
    assert isinstance(page, Decide)
    return page


def test_after_a_crash_the_changes_are_offered_and_come_back_with_undo(file: Path) -> None:
    typist(file).press("down", "enter", *" Y2.", "enter", "x").killed()
    assert file.read_bytes() == TEXT
    again = typist(file, ME)
    question = asked(again)
    assert question.title == "CHANGES THAT WERE NOT SAVED"
    assert "part.nc" in again.part("header")
    assert "new program" not in again.part("header")
    assert "2 changes can be undone" in question.lines[0]
    assert question.details[0] == "Line 2: G0 X1. Y2. (in the file: G0 X1.)"
    assert question.details[1] == "Line 3 of the file is taken out: \xb0 M30"
    again.press("r")
    assert again.texts == ["G20 G17", "G0 X1. Y2."]
    assert again.said.endswith("No tool's diameter and no control is kept: t and c give them again.")
    assert again.page.unsaved
    again.press("u", "u")
    assert again.texts == ["G20 G17", "G0 X1.", "\xb0 M30"]
    again.press("r", "s")
    assert file.read_bytes() == TEXT.replace(b"X1.", b"X1. Y2.")
    assert not journal_path(file).exists()


def test_restored_changes_undone_to_the_file_are_no_changes(file: Path) -> None:
    typist(file).press("x", "x").killed()
    again = typist(file, ME).press("r", "ctrl+z")
    assert again.page.unsaved
    again.press("ctrl+z")
    assert "redo 2" in again.screen()[-1]
    assert not again.page.unsaved
    assert "*" not in again.part("header")
    again.press("ctrl+y")
    assert again.page.unsaved
    again.press("ctrl+z", "f8")
    assert not any(isinstance(page, ProofPage | Decide) for page in again.desk.pages)
    assert file.read_bytes() == TEXT
    assert not journal_path(file).exists()


def test_restored_changes_undone_to_what_was_saved_between_are_no_changes(file: Path) -> None:
    typist(file).press("x", "s", "x", "x").killed()
    again = typist(file, ME).press("r", "u")
    assert again.page.unsaved
    assert not again.press("u").page.unsaved
    assert again.page.listing.data == file.read_bytes()
    assert again.press("u").page.unsaved
    assert again.page.listing.data == TEXT


def test_restored_changes_done_again_to_what_was_saved_are_no_changes(file: Path) -> None:
    typist(file).press("x", "s", "u").killed()
    again = typist(file, ME).press("r")
    assert again.page.unsaved
    assert not again.press("ctrl+y").page.unsaved


def test_restored_changes_of_another_file_or_none_are_changes_all_the_way(file: Path) -> None:
    typist(file).press("x", "x").killed()
    file.write_bytes(b"M2\n")
    again = typist(file, ME).press("r", "u", "u")
    assert again.texts == ["G20 G17", "G0 X1.", "\xb0 M30"]
    assert again.page.unsaved


def test_restored_changes_are_kept_again(file: Path) -> None:
    typist(file).press("x").killed()
    typist(file).press("r", "x").killed()
    assert typist(file, ME).press("r").texts == ["\xb0 M30"]


def test_discarded_changes_are_kept_aside(file: Path) -> None:
    typist(file).press("x").killed()
    again = typist(file).press("d", "y")
    assert again.texts[0] == "G20 G17"
    assert not isinstance(again.desk.page, Decide)
    assert [path.name for path in file.parent.glob(".part*discarded-1")]
    assert not isinstance(typist(file, ME).desk.page, Decide)


def test_nothing_stays_behind_a_save_or_a_way_out(file: Path) -> None:
    one = typist(file, ME).press("x", "s")
    assert not journal_path(file).exists()
    one.press("x")
    assert journal_path(file).exists()
    one.press("f8", "l")
    assert not journal_path(file).exists()
    assert not lock_path(file).exists()


def test_an_end_nobody_asked_for_leaves_the_journal_and_no_lock(file: Path) -> None:
    one = typist(file, ME).press("x")
    one.keeping.close()
    assert journal_path(file).exists()
    assert not lock_path(file).exists()


def test_undone_to_the_last_there_is_nothing_to_leave(file: Path) -> None:
    one = typist(file, ME).press("x", "u")
    one.keeping.close()
    assert not journal_path(file).exists()


def test_changes_that_the_file_has_by_now_are_not_offered(file: Path) -> None:
    typist(file).press("x").killed()
    file.write_bytes(TEXT.partition(b"\r\n")[2])
    assert not isinstance(typist(file, ME).desk.page, Decide)
    assert not journal_path(file).exists()


def test_a_file_that_somebody_wrote_since_is_told(file: Path) -> None:
    typist(file).press("x").killed()
    file.write_bytes(b"M2\n")
    again = typist(file, ME)
    assert "The file was written since: by somebody else, or by this program just before its end." in asked(again).lines
    assert again.press("r").texts == ["G0 X1.", "\xb0 M30"]


@pytest.mark.parametrize("cut", [1, 7, 40])
def test_a_torn_end_costs_the_last_change_only(file: Path, cut: int) -> None:
    typist(file).press("x", "x").killed()
    path = journal_path(file)
    path.write_bytes(path.read_bytes()[:-cut])
    assert typist(file, ME).press("r").texts == ["G0 X1.", "\xb0 M30"]


@pytest.mark.parametrize(
    "data", [b"x", b"00000000 {}\n", lines([{"nc": 1}])[0], lines([{"nc": 2, "owner": 1}])[0], b"\xff" * 99]
)
def test_what_is_no_journal_is_told_and_not_overwritten(file: Path, data: bytes) -> None:
    journal_path(file).write_bytes(data)
    one = typist(file, ME)
    assert "cannot be read: its beginning is damaged" in asked(one).lines[0]
    one.press("g")
    assert not isinstance(one.desk.page, Decide)
    one.press("x")
    assert "kept-1" in one.said
    assert [path.read_bytes() for path in file.parent.glob(".part*kept-1")] == [data]


def test_a_second_opener_looks_or_takes_over(file: Path) -> None:
    take(file, ELSEWHERE)
    one = typist(file, ME)
    assert asked(one).title == "OPEN ALREADY"
    assert "part.nc" in one.part("header")
    assert "LOOK ONLY part.nc" in one.press("l").part("header")
    one.press("x", "enter", "i")
    assert one.texts[0] == "G20 G17"
    assert "bob on office has this program open" in one.said
    one.press("s")
    assert file.read_bytes() == TEXT
    two = typist(file, ME).press("t", "x", "s")
    assert file.read_bytes() == TEXT.partition(b"\r\n")[2]
    assert two.page.looking == ""
    assert "LOOK ONLY" not in two.part("header")


def test_the_first_one_is_told_that_the_file_was_taken_over(file: Path) -> None:
    one = typist(file, ME)
    lock_path(file).write_text(json.dumps({"user": "bob", "host": "office", "pid": 7, "started": "", "since": TIME}))
    one.press("x")
    assert "bob on office has this program open" in one.said


def test_saved_under_another_name_the_lock_moves(file: Path) -> None:
    one = typist(file, ME).press("x", "S", *["backspace"] * 99, *str(file.with_name("other.nc")), "enter")
    assert one.page.file == file.with_name("other.nc")
    assert lock_path(file.with_name("other.nc")).exists()
    assert not lock_path(file).exists()
    assert not journal_path(file).exists()


def test_differences_in_words() -> None:
    file, work = NcText.read(b"A\nB\nC\nD\n"), NcText.read(b"A\nX\nB\nD\nE\n")
    told = ("Line 2 is new: X", "Line 3 of the file is taken out: C", "Line 5 is new: E")
    assert differences(file, work) == told
    assert differences(file, file) == ()
    long = NcText.read(b"".join(b"%d\n" % row for row in range(900)))
    assert differences(file, long) == ("Lines 1 to 900 are others than in the file.",)


WORK = st.lists(st.tuples(st.sampled_from("cidur"), st.integers(0, 9), st.text("GX1.\t", max_size=4)), max_size=25)


@given(WORK, st.sampled_from([b"", b"A\nB\nC", b"A\r\nB\r\n", b"\xff\xfeA\x00\n\x00"]))
def test_any_work_is_replayed(work: list[tuple[str, int, str]], data: bytes) -> None:
    listing = NcText.read(data)
    records = list(whole(listing, ME, TIME))
    for kind, row, text in work:
        before, row = listing, row % (len(listing) + 1)
        match kind:
            case "c" if len(listing) > row:
                listing = listing.changed(row, text)
            case "i":
                listing = listing.inserted(row, text)
            case "d" if len(listing) > row:
                listing = listing.deleted(row)
            case "u" | "r":
                listing = listing.undone() if kind == "u" else listing.redone()
        more = steps(before, listing, TIME)
        assert more is not None
        records += more
    for journal in (records, list(whole(listing, ME, TIME))):
        found = found_in(lines(journal)[0])
        assert found is not None
        assert not found.damaged
        assert found.listing.lines == listing.lines
        assert len(found.listing.past) == len(listing.past)
        assert len(found.listing.future) == len(listing.future)
        assert found.listing.encoding == listing.encoding
