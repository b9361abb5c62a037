"""LinuxCNC's own sample programs as the Debian package brings them, and its library of subprograms with a call."""

from __future__ import annotations

import re
from pathlib import Path

SAMPLES = Path("/usr/share/linuxcnc/ncfiles")
"""Where the Debian package puts LinuxCNC's own sample programs."""

COMPENSATED = {
    "comp.ngc": "",
    "comp-g1.ngc": "",
    "comp311.ngc": "",
    "comp311_2.ngc": "",
    "gmoccapy_2_tools_with_cutter_radius_compensation.ngc": "",
    "lathecomp.ngc": "",
    "useful-subroutines.ngc": "",
    "mmount.ngc": "G33.1, rigid tapping, is not followed here",
    "g76.ngc": "G76, threading, is not followed here",
    "lathe-g76.ngc": "G76, threading, is not followed here",
    "lathe_g70_71_demo.ngc": "G71, roughing on a lathe, is not followed here",
}
"""Its samples that use compensation, and why some cannot be followed to their end."""

TOOLS = {**dict(enumerate((0.25, 0.125, 0.5, 0.1, 0.2, 0.0, 0.1, 0.3, 0.1), 1)), 15: 0.55}

_SQUARE = {f"{axis}{corner}": value for corner, xy in enumerate(((0, 0), (3, 0), (3, 3), (0, 3)), 1)
           for axis, value in zip("xy", xy, strict=True)}  # fmt: skip
_DEPTH = {"toolno": 2, "cutdepth": -0.2, "zincr": 0.1, "spin_notify": 0, "verbose": 0, "feedrate": 10, "rpm": 1000}

LIBRARY: dict[str, dict[str, float]] = {
    "arc1": _DEPTH,
    "helix": {**_DEPTH, "x": 1, "y": 1, "hdiam": 2, "zstart": 0, "inside": 1},
    "ihex": {**_DEPTH, "flatd": 3},
    "ohex": {**_DEPTH, "flatd": 3},
    "iquad": {**_DEPTH, **_SQUARE},
    "oquad": {**_DEPTH, **_SQUARE},
    "slot": {**_DEPTH, "x1": 0, "y1": 0, "x2": 3, "y2": 1},
    "simp": {},
}
"""Its subprograms that compensate, and the arguments with which they are called besides their defaults."""

_ARGUMENT = re.compile(r"#<(\w+)>\s*=\s*#(\d+)(?:\s*\(=\s*(-?[\d.]+))?")


def sample(name: str) -> str:
    """A sample's text."""
    return (SAMPLES / name).read_text(errors="replace")


def called(name: str) -> str:
    """A subprogram of the library with all it calls in one file, and a call of it."""
    folder = SAMPLES / "ngcgui_lib"
    text = (folder / f"{name}.ngc").read_text(errors="replace")
    others = [file.read_text(errors="replace") for file in sorted((folder / "utilitysubs").glob("[delms]*.ngc"))]
    values: list[str] = []
    for word, index, default in _ARGUMENT.findall(text):
        if int(index) == len(values) + 1:
            values.append(f"[{LIBRARY[name].get(word, default or 1)}]")
    return "\n".join((*others, text, "G20 G17 G90 F9", "G0 X0 Y0 Z1", f"o<{name}> call {''.join(values)}", "M2", ""))
