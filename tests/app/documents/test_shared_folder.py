"""Saving in a shared folder keeps owner, group, mode, attributes and links of a file.

Under root, a child process plays the colleague.
"""

from __future__ import annotations

import errno
import os
import stat
import warnings
from collections.abc import Callable
from pathlib import Path

import pytest

from app.documents.files import write_data
from core.program.file.read import StoreError

ANN, BOB, SHOP = 12001, 12002, 12100
root_only = pytest.mark.skipif(os.getuid() != 0, reason="only root can become somebody else")


def child(work: Callable[[], None], user: int, *groups: int) -> None:
    """Do this as another user; an AssertionError says what went wrong."""
    reading, writing = os.pipe()
    with warnings.catch_warnings():
        # the child uses no threads
        warnings.simplefilter("ignore", DeprecationWarning)
        pid = os.fork()
    if not pid:
        text = ""
        try:
            os.setgroups(groups)
            os.setgid(user)
            os.setuid(user)
            work()
        except BaseException as error:  # noqa: BLE001  # the parent reports it
            text = f"{type(error).__name__}: {error}"
        os.write(writing, text.encode()[:4000])
        os._exit(0)
    os.close(writing)
    with os.fdopen(reading) as pipe:
        text = pipe.read()
    os.waitpid(pid, 0)
    assert not text, text


@pytest.fixture
def shop(tmp_path: Path) -> Path:
    """A folder that the group SHOP may write."""
    tmp_path.chmod(0o755)
    folder = tmp_path / "shop"
    folder.mkdir()
    os.chown(folder, ANN, SHOP)
    folder.chmod(0o775)
    return folder


def make_file(path: Path, user: int, group: int, mode: int) -> os.stat_result:
    path.write_bytes(b"old")
    os.chown(path, user, group)
    path.chmod(mode)
    return path.stat()


def who(path: Path) -> tuple[int, int, int]:
    status = path.stat()
    return status.st_uid, status.st_gid, stat.S_IMODE(status.st_mode)


@root_only
def test_a_save_by_a_colleague_keeps_owner_group_and_mode(shop: Path) -> None:
    path = shop / "part.toml"
    make_file(path, ANN, SHOP, 0o660)

    def save() -> None:
        assert write_data(path, b"new and longer") == "it stays its owner's"

    child(save, BOB, SHOP)
    assert who(path) == (ANN, SHOP, 0o660)
    assert path.read_bytes() == b"new and longer"
    assert list(shop.iterdir()) == [path]


@root_only
def test_a_file_of_a_group_the_owner_is_in_is_replaced_and_keeps_the_group(shop: Path) -> None:
    path = shop / "part.toml"
    before = make_file(path, BOB, SHOP, 0o640)

    def save() -> None:
        assert write_data(path, b"new") == ""

    child(save, BOB, SHOP)
    assert who(path) == (BOB, SHOP, 0o640)
    assert path.stat().st_ino != before.st_ino


@root_only
def test_a_file_of_a_group_the_owner_is_not_in_is_written_in_place(shop: Path) -> None:
    path = shop / "part.toml"
    make_file(path, BOB, SHOP, 0o660)
    shop.chmod(0o777)

    def save() -> None:
        assert write_data(path, b"new") == "it keeps its group"

    child(save, BOB)
    assert who(path) == (BOB, SHOP, 0o660)


@root_only
def test_a_file_of_another_user_in_a_sticky_folder_is_written_in_place(shop: Path) -> None:
    """In a sticky folder, only the owner of a file may replace it."""
    path = shop / "part.toml"
    make_file(path, ANN, SHOP, 0o666)
    shop.chmod(0o1777)

    def save() -> None:
        write_data(path, b"new")

    child(save, BOB, SHOP)
    assert path.read_bytes() == b"new"
    assert list(shop.iterdir()) == [path]


@root_only
def test_a_file_saved_by_root_keeps_its_owner(shop: Path) -> None:
    path = shop / "part.toml"
    make_file(path, ANN, SHOP, 0o640)
    assert write_data(path, b"new") == ""
    assert who(path) == (ANN, SHOP, 0o640)


@root_only
def test_a_file_the_colleague_may_only_read_is_not_written(shop: Path) -> None:
    path = shop / "part.toml"
    make_file(path, ANN, SHOP, 0o640)

    def save() -> None:
        with pytest.raises(StoreError, match="it is protected"):
            write_data(path, b"new")

    child(save, BOB, SHOP)
    assert path.read_bytes() == b"old"


def test_a_file_with_two_hard_links_keeps_both(tmp_path: Path) -> None:
    path, other = tmp_path / "part.toml", tmp_path / "other.toml"
    path.write_bytes(b"the old one, longer")
    other.hardlink_to(path)
    assert write_data(path, b"new") == "it has more than one name"
    assert other.read_bytes() == b"new"
    assert other.samefile(path)
    assert sorted(tmp_path.iterdir()) == [other, path]


def test_saving_keeps_extended_attributes(tmp_path: Path) -> None:
    path = tmp_path / "part.toml"
    path.write_bytes(b"old")
    try:
        os.setxattr(path, "user.job", b"4711")
    except OSError:
        pytest.skip("this file system has no attributes")
    assert write_data(path, b"new") == ""
    assert os.getxattr(path, "user.job") == b"4711"


def test_a_file_whose_attributes_cannot_be_copied_is_written_in_place(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "part.toml"
    path.write_bytes(b"old")
    before = path.stat().st_ino

    def refused(*_: object) -> None:
        raise OSError(errno.ENOTSUP, "no")

    monkeypatch.setattr(os, "listxattr", lambda _: ["user.job"])
    monkeypatch.setattr(os, "getxattr", lambda *_: b"4711")
    monkeypatch.setattr(os, "setxattr", refused)
    assert write_data(path, b"new") == "it keeps its attributes"
    assert path.stat().st_ino == before


@pytest.mark.parametrize("call", ["posix_fallocate", "ftruncate", "lseek"])
def test_a_disk_failing_during_an_in_place_write_leaves_the_old_content(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, call: str
) -> None:
    path = tmp_path / "part.toml"
    path.write_bytes(b"old")
    (tmp_path / "other").hardlink_to(path)
    real, failed = getattr(os, call), list[str]()

    def once(*args: int) -> object:
        if not failed:
            failed.append(call)
            raise OSError(errno.ENOSPC, "No space left on device")
        return real(*args)

    monkeypatch.setattr(os, call, once)
    with pytest.raises(StoreError, match="the disk is full"):
        write_data(path, b"new and longer")
    assert path.read_bytes() == b"old"
    assert len(list(tmp_path.iterdir())) == 2


def test_a_long_name_of_two_byte_letters_can_be_saved(tmp_path: Path) -> None:
    path = tmp_path / f"{'ä' * 120}.toml"
    write_data(path, b"new")
    write_data(path, b"newer")
    assert path.read_bytes() == b"newer"
