"""Posting from the command line for a control with its own compensation."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.__main__ import main
from app.documents.programs import example


def test_post_writes_compensated_code_for_a_control(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "part.nc"
    assert main(["post", str(example("plate-mm")), "--control", "nine-series:b", "-o", str(out)]) == 0
    assert "G41 D2 G1" in out.read_text()
    assert "takes corners differently" in capsys.readouterr().err


def test_post_refuses_gouges_unknown_controls_and_mixed_options(capsys: pytest.CaptureFixture[str]) -> None:
    part = str(example("pocket"))
    assert main(["post", part, "--control", "linuxcnc"]) == 1
    streams = capsys.readouterr()
    assert streams.out == ""
    assert "nothing was posted. Block 1, segment 8:" in streams.err
    assert main(["post", part, "--control", "siemens"]) == 2
    assert "No such control" in capsys.readouterr().err
    assert main(["post", part, "--control", "linuxcnc", "--override", "POST WITH GOUGE"]) == 2
    assert "leave out --control" in capsys.readouterr().err


def test_proof_refuses_an_unknown_control_and_a_bad_tool(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["proof", str(tmp_path), "--control", "siemens"]) == 2
    assert "No such control" in capsys.readouterr().err
    assert main(["proof", str(tmp_path / "none.nc"), "--tool", "x"]) == 2
    assert "--tool x" in capsys.readouterr().err


def test_a_refusal_names_every_block_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    part = tmp_path / "part.toml"
    block = """
[[block]]
kind = "MILL CONTOUR"
tool = 1
cutter_comp = "ON"
x_start = 0.0
y_start = 0.0
z_start = 0.0
z_bottom = -0.1
speed = 1000

[[block.segment]]
kind = "LINE"
x_end = 1.0
y_end = 0.0
"""
    tools = '[[tool]]\nnumber = 1\ntype = "END MILL"\ndiameter = 0.5\n'
    part.write_text(f'format = 1\nunits = "IN"\n{tools}{block}{block}')
    assert main(["post", str(part)]) == 1
    refusals = [line for line in capsys.readouterr().err.splitlines() if "nothing was posted." in line]
    assert len(refusals) == 1
    assert refusals[0].partition("nothing was posted. ")[2] == " ".join(
        f"Block {number}, START: PLUNGE FEED is blank: enter it on START." for number in (1, 2)
    )
