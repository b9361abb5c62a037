"""Posting for a control that compensates by itself: from the POST NC screen and from the command line."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.__main__ import main
from app.documents.files import load
from app.documents.programs import example
from app.painted.desk import Desk
from app.painted.screens.post import PostPage
from app.painted.session import Session
from tests.app.operator import Operator


def operator(name: str) -> Operator:
    """On POST NC, the name of the file not typed yet."""
    one = Operator(Desk(Session.of(load(example(name)))))
    return one.press("f8", "f6")


def test_the_control_is_chosen_by_keys() -> None:
    one = operator("flange")
    assert "CONTROL none" in "\n".join(one.screen())
    one.press("down")
    assert "CONTROL threeblock" in "\n".join(one.screen())
    one.press("f4", "up")
    assert "CONTROL linuxcnc" in "\n".join(one.screen())
    one.press("f3")
    assert isinstance(one.desk.page, PostPage)
    assert one.desk.page.control is None


def test_the_program_of_a_control_is_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    file = tmp_path / "part.nc"
    one = operator("flange").press("down", *str(file), "enter")
    assert one.said.startswith("Posted:")
    assert one.said.endswith("PART NAME FLANGE is not in the file: three-block has no comments.")
    assert file.read_text().startswith("G17G70G40G90\nT1//0.5\n")


def test_what_the_control_does_otherwise_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    one = operator("plate-mm").press(*["down"] * 5, *str(tmp_path / "a.nc"), "enter")
    assert one.said.startswith("! Posted: a.nc, ")
    assert "lines. Segment" in one.said
    assert "allen-bradley:a takes corners differently" in one.said


def test_what_the_control_cannot_is_said_and_nothing_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    file = tmp_path / "part.nc"
    one = operator("pocket").press("down", *str(file), "enter")
    assert "no control" in one.said
    assert not file.exists()


def test_post_control_on_the_command_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "part.nc"
    assert main(["post", str(example("plate-mm")), "--control", "nine-series:b", "-o", str(out)]) in (0, 1)
    assert "G41 D2 G1" in out.read_text()
    assert "takes corners differently" in capsys.readouterr().err


def test_refusals_on_the_command_line(capsys: pytest.CaptureFixture[str]) -> None:
    part = str(example("pocket"))
    assert main(["post", part, "--control", "linuxcnc"]) == 1
    streams = capsys.readouterr()
    assert streams.out == ""
    assert "nothing was posted. Segment 8:" in streams.err
    assert main(["post", part, "--control", "siemens"]) == 2
    assert "No such control" in capsys.readouterr().err
    assert main(["post", part, "--control", "linuxcnc", "--override", "POST WITH GOUGE"]) == 2
    assert "leave out --control" in capsys.readouterr().err


def test_proof_refuses_what_it_cannot_open(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["proof", str(tmp_path), "--control", "siemens"]) == 2
    assert "No such control" in capsys.readouterr().err
    assert main(["proof", str(tmp_path / "none.nc"), "--tool", "x"]) == 2
    assert "--tool x" in capsys.readouterr().err
