"""Locks and stamps of program files."""

from __future__ import annotations

import errno
import json
import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from app.documents.files import stamp_of
from app.documents.lock import (
    UNKNOWN_OWNER,
    Lock,
    Owner,
    alive,
    held_by,
    lock_path,
    myself,
    owner_of,
    release,
    started,
    take,
    take_over,
    taken_by,
)
from tests.app.documents.things import put_something

ME = myself("2025-03-04T06:00:00+01:00")
ELSEWHERE = Owner("bob", "another-host", 1, "", "2025-03-04T05:00:00+01:00")
DEAD_PID = 2**22 + 17
"""Above every process number of the system."""


@pytest.fixture
def part(tmp_path: Path) -> Path:
    path = tmp_path / "part.toml"
    path.write_text("format = 1\n")
    return path


def lock_of(part: Path, owner: Owner) -> Lock:
    lock = take(part, owner)
    assert isinstance(lock, Lock)
    return lock


def test_the_second_opener_learns_who_has_the_file_open(part: Path) -> None:
    assert held_by(part) is None
    lock_of(part, ELSEWHERE)
    assert take(part, ME) == ELSEWHERE
    assert held_by(part) == ELSEWHERE


def test_releasing_a_lock_leaves_nothing(part: Path) -> None:
    release(lock_of(part, ME))
    assert [child.name for child in part.parent.iterdir()] == ["part.toml"]


def test_a_file_that_does_not_yet_exist_can_be_locked(tmp_path: Path) -> None:
    lock_of(tmp_path / "new.toml", ELSEWHERE)
    assert take(tmp_path / "new.toml", ME) == ELSEWHERE


def test_a_lock_is_readable_by_everybody(part: Path) -> None:
    before = os.umask(0o077)
    try:
        lock_of(part, ME)
    finally:
        os.umask(before)
    assert lock_path(part).stat().st_mode & 0o777 == 0o644


def test_a_link_and_its_file_share_one_lock(part: Path) -> None:
    link = part.with_name("link.toml")
    link.symlink_to(part)
    lock_of(link, ELSEWHERE)
    assert take(part, ME) == ELSEWHERE


def test_a_dead_process_of_this_host_holds_nothing(part: Path) -> None:
    lock_of(part, replace(ME, pid=DEAD_PID))
    assert held_by(part) is None
    assert take(part, ME) == Lock(lock_path(part), ME)


def test_a_lock_of_an_earlier_process_with_the_same_number_is_stale(part: Path) -> None:
    lock_of(part, replace(ME, started="an earlier boot:5"))
    assert isinstance(take(part, replace(ME, since="later")), Lock)


def test_a_living_process_of_this_host_holds_its_lock(part: Path) -> None:
    with subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE) as other:
        owner = Owner("ann", ME.host, other.pid, started(other.pid), "earlier")
        lock_of(part, owner)
        assert take(part, ME) == owner
        other.communicate(b"\n")
    assert isinstance(take(part, ME), Lock)


def test_a_zombie_counts_as_dead() -> None:
    process = subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE)
    owner = replace(ME, pid=process.pid, started=started(process.pid))
    assert alive(owner)
    process.kill()
    os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)
    assert not alive(owner)
    assert not alive(replace(owner, started=""))
    process.communicate()


def test_a_process_of_another_host_counts_as_alive() -> None:
    assert alive(ELSEWHERE)
    assert alive(UNKNOWN_OWNER)
    assert alive(ME)
    assert not alive(replace(ME, pid=DEAD_PID))


def test_the_first_owner_notices_a_take_over(part: Path) -> None:
    first_lock = lock_of(part, ELSEWHERE)
    assert taken_by(first_lock) is None
    second_lock = take_over(part, ME)
    assert taken_by(first_lock) == ME
    assert taken_by(second_lock) is None
    release(first_lock)
    assert lock_path(part).exists()
    release(second_lock)
    assert not lock_path(part).exists()


def test_a_removed_lock_is_not_taken_by_anybody(part: Path) -> None:
    lock = lock_of(part, ME)
    lock.path.unlink()
    assert taken_by(lock) is None
    release(lock)


@pytest.mark.parametrize("text", ["", "{", "[]", '{"user": 1}', "\x00\xff", "[" * 4000])
def test_an_unreadable_lock_is_stale(part: Path, text: str) -> None:
    """A full disk or a power cut leaves such files, which no process would remove."""
    lock_path(part).write_text(text)
    assert held_by(part) is None
    assert take(part, ME) == Lock(lock_path(part), ME)


def test_a_lock_being_written_is_waited_for(part: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    lock_path(part).write_text('{"user"')
    written = json.dumps(vars_of(ELSEWHERE))
    monkeypatch.setattr("app.documents.lock.sleep", lambda _: lock_path(part).write_text(written))
    assert take(part, ME) == ELSEWHERE


def test_a_lock_we_may_not_read_counts_as_held(part: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    lock_of(part, ELSEWHERE)

    def hidden(*_: object) -> bytes:
        raise PermissionError(errno.EACCES, "hidden")

    monkeypatch.setattr("app.documents.lock.read_file", hidden)
    assert take(part, ME) == UNKNOWN_OWNER
    assert take_over(part, ME).owner == ME


def test_an_owner_is_read_back_from_json() -> None:
    assert owner_of(json.loads(json.dumps({**vars_of(ME)}))) == ME
    with pytest.raises(ValueError, match="no owner"):
        owner_of({"user": "ann"})


def vars_of(owner: Owner) -> dict[str, object]:
    return {name: getattr(owner, name) for name in ("user", "host", "pid", "started", "since")}


def test_locking_fails_in_a_read_only_folder() -> None:
    with pytest.raises(OSError, match="part"):
        take(Path("/proc/part.toml"), ME)


def test_a_stamp_changes_only_with_the_content(part: Path) -> None:
    before = stamp_of(part)
    assert before is not None
    part.write_text("format = 1\n")
    again = stamp_of(part)
    assert again is not None
    assert before.same_content(again)
    part.write_text("format = 2\n")
    other = stamp_of(part)
    assert other is not None
    assert not before.same_content(other)
    assert other.size == before.size


def test_a_missing_file_or_a_folder_has_no_stamp(tmp_path: Path) -> None:
    assert stamp_of(tmp_path / "none") is None
    assert stamp_of(tmp_path) is None


@pytest.mark.parametrize("call", ["write", "fsync", "close"])
@pytest.mark.parametrize("make", [take, take_over])
def test_a_full_disk_leaves_no_half_lock(
    part: Path, monkeypatch: pytest.MonkeyPatch, make: Callable[[Path, Owner], object], call: str
) -> None:
    real = getattr(os, call)

    def full(*args: object) -> None:
        if call == "close":
            real(*args)
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as patch:
        patch.setattr(os, call, full)
        with pytest.raises(OSError, match="No space"):
            make(part, ME)
    assert [child.name for child in part.parent.iterdir()] == ["part.toml"]
    assert isinstance(take(part, ME), Lock)


@pytest.mark.parametrize("pid", [0, -1, -4711, 2**22 + 17, 2**31, 2**63, 10**309])
def test_a_lock_with_an_impossible_process_number_is_stale(part: Path, pid: int) -> None:
    lock_path(part).write_text(json.dumps({**vars_of(ME), "pid": pid}))
    assert held_by(part) is None
    assert take(part, ME) == Lock(lock_path(part), ME)


def test_a_lock_with_a_boolean_process_number_is_stale(part: Path) -> None:
    lock_path(part).write_text(json.dumps({**vars_of(ELSEWHERE), "pid": True}))
    assert held_by(part) is None


@pytest.mark.parametrize("what", ["pipe", "folder", "full folder", "socket", "device", "endless"])
@pytest.mark.parametrize("make", [take, take_over])
def test_anything_else_in_the_place_of_a_lock_is_stale(
    part: Path, what: str, make: Callable[[Path, Owner], object]
) -> None:
    put_something(lock_path(part), what)
    assert held_by(part) is None
    assert make(part, ME) == Lock(lock_path(part), ME)
