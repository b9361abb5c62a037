"""Random runs of LINEs and ARCs, a judge that walks an answer's chain, and brute force that finds every answer.

None of it shares code with the solver.  A run is plain data as in `tests/data/calculated_runs.json`: millimeters and
degrees, `start`, and `segments` with the keys of a program file.  An answer is a list of pieces with `x_end`, `y_end`
and, for an arc, `x_center`, `y_center`.
"""

from __future__ import annotations

import math
import random
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

Case = dict[str, Any]
Piece = Mapping[str, Any]
Floats = NDArray[np.float64]

TURN = {"LINE": 0, "CCW": 1, "CW": -1}


def turn_of(segment: Mapping[str, Any]) -> int:
    """1 for a CCW arc, -1 for a CW one, 0 for a line."""
    return TURN[segment["direction"] if segment["kind"] == "ARC" else "LINE"]


# the generator


def random_case(
    seed: int, least: int = 2, most: int = 5, *, points: bool = False, relative: bool = False
) -> tuple[Case, list[dict[str, Any]]]:
    """A run with as many data as it has unknowns, and the answer it was made from.

    With `points` some data are POINTs, with `relative` some count from the start or from the heading before.
    """
    pick = random.Random(seed)
    start = (pick.uniform(-50.0, 50.0), pick.uniform(-50.0, 50.0))
    pieces, tangents = _contour(pick, start, pick.randint(least, most))
    pools = [_data(piece, tangents[index]) for index, piece in enumerate(pieces)]
    if points:
        starts = [start, *((piece["x_end"], piece["y_end"]) for piece in pieces)]
        for pool, piece, at in zip(pools, pieces, starts[:-1], strict=True):
            pool["point"] = _point_data(pick, piece, at)
    unknowns = sum(3 if piece["kind"] == "ARC" else 2 for piece in pieces)
    chosen = [(len(pieces) - 1, name) for name in ("x_end", "y_end")] if pick.random() < 0.85 else []
    rest = [(index, name) for index, pool in enumerate(pools) for name in pool if (index, name) not in chosen]
    pick.shuffle(rest)
    # tangencies are what drawings give most
    rest.sort(key=lambda datum: datum[1] != "tangent" or pick.random() < 0.3)
    chosen += rest[: unknowns - len(chosen)]
    segments = []
    for index, piece in enumerate(pieces):
        segment: dict[str, Any] = {key: piece[key] for key in ("kind", "direction") if key in piece}
        segment |= {name: pools[index][name] for at, name in chosen if at == index}
        segment |= segment.pop("point", {})
        segments.append(_made_relative(pick, segment, pieces, index, start) if relative else segment)
    return {"units": "MM", "start": list(start), "segments": segments}, pieces


def _made_relative(
    pick: random.Random, segment: dict[str, Any], pieces: Sequence[Piece], index: int, start: tuple[float, float]
) -> dict[str, Any]:
    """A segment of which about half of the numbers that can be are relative."""
    before = pieces[index - 1] if index else {"x_end": start[0], "y_end": start[1]}
    bases = {f"{axis}_{place}": before[f"{axis}_end"] for axis in "xy" for place in ("end", "center")}
    if index and "tangent" not in segment:
        heading = before.get("angle", before.get("start_angle", 0.0)) + before.get("turned", 0.0)
        bases |= {"angle": heading, "start_angle": heading}
    made: dict[str, Any] = {}
    for name, value in segment.items():
        if name not in bases or pick.random() < 0.5:
            made[name] = value
        elif name in ("angle", "start_angle"):
            made[f"{name}_inc"] = (value - bases[name] + 180.0) % 360.0 - 180.0
        else:
            made[f"{name}_inc"] = value - bases[name]
    return made


def _contour(pick: random.Random, start: tuple[float, float], count: int) -> tuple[list[dict[str, Any]], list[bool]]:
    x, y = start
    heading = pick.uniform(0.0, math.tau)
    pieces: list[dict[str, Any]] = []
    tangents = []
    for index in range(count):
        smooth = index > 0 and pick.random() < 0.65
        heading += 0.0 if smooth else pick.uniform(-2.6, 2.6)
        piece = _line(pick, x, y, heading) if pick.random() < 0.5 else _arc(pick, x, y, heading)
        heading += math.radians(piece.get("turned", 0.0))
        x, y = piece["x_end"], piece["y_end"]
        pieces.append(piece)
        tangents.append(smooth)
    return pieces, tangents


def _line(pick: random.Random, x: float, y: float, heading: float) -> dict[str, Any]:
    length = pick.uniform(8.0, 80.0)
    end = (x + length * math.cos(heading), y + length * math.sin(heading))
    angle = math.degrees(heading) % 360.0
    return {"kind": "LINE", "x_end": end[0], "y_end": end[1], "length": length, "angle": angle}


def _arc(pick: random.Random, x: float, y: float, heading: float) -> dict[str, Any]:
    turn, radius, sweep = pick.choice((1, -1)), pick.uniform(6.0, 50.0), pick.uniform(20.0, 230.0)
    cx, cy = x - turn * radius * math.sin(heading), y + turn * radius * math.cos(heading)
    out = heading + turn * math.radians(sweep)
    return {
        "kind": "ARC",
        "direction": "CCW" if turn > 0 else "CW",
        "x_end": cx + turn * radius * math.sin(out),
        "y_end": cy - turn * radius * math.cos(out),
        "x_center": cx,
        "y_center": cy,
        "radius": radius,
        "sweep": sweep,
        "start_angle": math.degrees(heading) % 360.0,
        "turned": turn * sweep,
    }


def _data(piece: Piece, smooth: bool) -> dict[str, Any]:
    names = ("x_end", "y_end", "length", "angle", "x_center", "y_center", "radius", "sweep", "start_angle")
    data: dict[str, Any] = {name: piece[name] for name in names if name in piece}
    return data | ({"tangent": True} if smooth else {})


def _point_data(pick: random.Random, piece: Piece, start: tuple[float, float]) -> dict[str, float]:
    """A point on a piece's circle, or beside its line, as POINT gives it."""
    if piece["kind"] == "ARC":
        angle = pick.uniform(0.0, math.tau)
        x, y = (
            piece["x_center"] + piece["radius"] * math.cos(angle),
            piece["y_center"] + piece["radius"] * math.sin(angle),
        )
        return {"point_x": x, "point_y": y}
    along, side = pick.uniform(-20.0, 60.0), pick.choice((0.0, 12.0, -12.0))
    c, s = math.cos(math.radians(piece["angle"])), math.sin(math.radians(piece["angle"]))
    point = {"point_x": start[0] + along * c - side * s, "point_y": start[1] + along * s + side * c}
    return point | ({"point_dist": abs(side)} if side else {})


# the judge


def walk(case: Case, answer: Sequence[Piece]) -> float:
    """The largest difference between an answer and what is typed: millimeters, or radians times the size of a piece.

    Infinite where an answer is no chain: a line without length, an arc whose ends lie on two circles.
    """
    x, y = case["start"]
    heading = case.get("heading")
    worst = 0.0
    lines: list[tuple[float, float, float]] = []
    for segment, piece in zip(case["segments"], answer, strict=True):
        leaving, arriving, actual = _walked(segment, piece, x, y)
        size = max(actual.get("length", 0.0), actual.get("radius", 0.0))
        lines.append((leaving, x, y))
        differences = [_difference(name, segment[name], actual, size) for name in actual if name in segment]
        if "tangent" in segment and heading is not None:
            differences.append(_turned(leaving - heading) * size)
        for name in ("angle_inc", "start_angle_inc"):
            if name in segment and heading is not None:
                differences.append(_turned(leaving - heading - math.radians(segment[name])) * size)
        if "point_x" in segment:
            differences.append(_point_difference(segment, piece, x, y, leaving))
        if "parallel" in segment:
            differences += _parallel_differences(segment, piece, leaving, lines)
        worst = max(worst, *differences, 0.0)
        heading, x, y = arriving, piece["x_end"], piece["y_end"]
    return worst


def _walked(segment: Piece, piece: Piece, x: float, y: float) -> tuple[float, float, dict[str, float]]:
    """The headings in which a piece leaves and arrives (radians), and what it comes to."""
    dx, dy = piece["x_end"] - x, piece["y_end"] - y
    actual = {"x_end": piece["x_end"], "y_end": piece["y_end"], "x_end_inc": dx, "y_end_inc": dy}
    turn = turn_of(segment)
    if not turn:
        length, heading = math.hypot(dx, dy), math.atan2(dy, dx)
        if length < 1e-7:
            return heading, heading, {"x_end": math.inf}
        return heading, heading, actual | {"length": length, "angle": math.degrees(heading)}
    cx, cy = piece["x_center"], piece["y_center"]
    radius, out = math.hypot(x - cx, y - cy), math.hypot(piece["x_end"] - cx, piece["y_end"] - cy)
    first, last = math.atan2(y - cy, x - cx), math.atan2(piece["y_end"] - cy, piece["x_end"] - cx)
    sweep = (turn * (last - first)) % math.tau or math.tau
    leaving, arriving = first + turn * math.pi / 2.0, last + turn * math.pi / 2.0
    if abs(radius - out) > 1e-6:
        return leaving, arriving, {"x_end": math.inf}
    actual |= {"x_center": cx, "y_center": cy, "x_center_inc": cx - x, "y_center_inc": cy - y, "radius": radius}
    return leaving, arriving, actual | {"sweep": math.degrees(sweep), "start_angle": math.degrees(leaving)}


def _difference(name: str, typed: float, actual: Mapping[str, float], size: float) -> float:
    if name in ("angle", "start_angle", "sweep"):
        return _turned(math.radians(typed - actual[name])) * size
    return float(abs(typed - actual[name]))


def _turned(angle: float) -> float:
    return abs((angle + math.pi) % math.tau - math.pi)


def _point_difference(segment: Piece, piece: Piece, x: float, y: float, leaving: float) -> float:
    px, py, distance = segment["point_x"], segment["point_y"], segment.get("point_dist", 0.0)
    if segment["kind"] == "ARC":
        cx, cy = piece["x_center"], piece["y_center"]
        return float(abs(math.hypot(px - cx, py - cy) - math.hypot(x - cx, y - cy)))
    return float(abs(abs((py - y) * math.cos(leaving) - (px - x) * math.sin(leaving)) - distance))


def _parallel_differences(
    segment: Piece, piece: Piece, leaving: float, lines: list[tuple[float, float, float]]
) -> list[float]:
    heading, x, y = lines[segment["parallel"] - 1]
    length = math.hypot(piece["x_end"] - lines[-1][1], piece["y_end"] - lines[-1][2])
    off = abs(math.sin(leaving - heading)) * length
    if "offset" not in segment:
        return [off]
    apart = abs((piece["y_end"] - y) * math.cos(heading) - (piece["x_end"] - x) * math.sin(heading))
    return [off, abs(apart - segment["offset"])]


# brute force


class BruteForce:
    """Every answer of a run by Newton's method from many random starts, all at once.

    The numbers of a line are its heading and length, those of an arc its first heading, radius and sweep.
    """

    def __init__(self, case: Case) -> None:
        self.case = case
        self.turns = [turn_of(segment) for segment in case["segments"]]
        self.width = sum(3 if turn else 2 for turn in self.turns)
        self.scale = max(50.0, *(abs(value) for value in self._lengths()))

    def _lengths(self) -> list[float]:
        names = ("x_end", "y_end", "length", "x_center", "y_center", "radius")
        return [segment[name] for segment in self.case["segments"] for name in names if name in segment]

    def residuals(self, numbers: Floats) -> Floats:
        """What each row of numbers misses each datum by: (rows, data), angles times the scale."""
        x = np.full(len(numbers), float(self.case["start"][0]))
        y = np.full(len(numbers), float(self.case["start"][1]))
        heading = np.full(len(numbers), math.nan)
        missed: list[Floats] = []
        at = 0
        for segment, turn in zip(self.case["segments"], self.turns, strict=True):
            actual, arriving, at = self._piece(numbers, at, turn, x, y)
            for name, value in actual.items():
                if name in segment:
                    angular = name in ("angle", "start_angle")
                    missed.append(self._missed(value, segment[name], angular, sweep=name == "sweep"))
            if "point_x" in segment:
                missed.append(self._point_missed(segment, actual, turn, x, y))
            if "tangent" in segment:
                missed.append(self.scale * np.sin((actual["leaving"] - heading) / 2.0) * 2.0)
            x, y, heading = actual["x_end"], actual["y_end"], arriving
        return np.stack(missed, axis=1)

    def _missed(self, value: Floats, typed: float, angular: bool, *, sweep: bool) -> Floats:
        if angular:
            return self.scale * 2.0 * np.sin((value - math.radians(typed)) / 2.0)
        return self.scale * (value - math.radians(typed)) if sweep else value - typed

    def _point_missed(self, segment: Piece, actual: dict[str, Floats], turn: int, x: Floats, y: Floats) -> Floats:
        px, py, distance = segment["point_x"], segment["point_y"], segment.get("point_dist", 0.0)
        missed: Floats
        if turn:
            missed = np.hypot(px - actual["x_center"], py - actual["y_center"]) - actual["radius"]
            return missed
        side = (py - y) * np.cos(actual["angle"]) - (px - x) * np.sin(actual["angle"])
        missed = np.abs(side) - distance if distance else side
        return missed

    def _piece(
        self, numbers: Floats, at: int, turn: int, x: Floats, y: Floats
    ) -> tuple[dict[str, Floats], Floats, int]:
        heading, size = numbers[:, at], numbers[:, at + 1]
        if not turn:
            end = {"x_end": x + size * np.cos(heading), "y_end": y + size * np.sin(heading)}
            return end | {"length": size, "angle": heading, "leaving": heading}, heading, at + 2
        sweep = numbers[:, at + 2]
        cx, cy = x - turn * size * np.sin(heading), y + turn * size * np.cos(heading)
        out = heading + turn * sweep
        end = {"x_end": cx + turn * size * np.sin(out), "y_end": cy - turn * size * np.cos(out)}
        circle = {"x_center": cx, "y_center": cy, "radius": size, "sweep": sweep, "start_angle": heading}
        return end | circle | {"leaving": heading}, out, at + 3

    def jacobian(self, numbers: Floats) -> Floats:
        """Derivatives of the residuals, (rows, data, numbers), by central differences."""
        columns = []
        for column in range(self.width):
            step = np.zeros(self.width)
            step[column] = 1e-6
            columns.append((self.residuals(numbers + step) - self.residuals(numbers - step)) / 2e-6)
        return np.stack(columns, axis=2)

    def numbers_of(self, answer: Sequence[Piece]) -> Floats:
        """The numbers of an answer, one row."""
        x, y = self.case["start"]
        numbers: list[float] = []
        for segment, piece in zip(self.case["segments"], answer, strict=True):
            leaving, _, actual = _walked(segment, piece, x, y)
            numbers += [leaving, actual["length"]] if not turn_of(segment) else []
            if turn_of(segment):
                numbers += [leaving, actual["radius"], math.radians(actual["sweep"])]
            x, y = piece["x_end"], piece["y_end"]
        return np.array([numbers])

    def condition(self, answer: Sequence[Piece]) -> float:
        """The smallest singular value against the largest at an answer: next to 0 the data do not determine it."""
        sizes = np.tile([1.0], self.width)
        at = 0
        for turn in self.turns:
            sizes[at] = 1.0 / self.scale
            if turn:
                sizes[at + 2] = 1.0 / self.scale
            at += 3 if turn else 2
        values = np.linalg.svd(self.jacobian(self.numbers_of(answer))[0] * sizes, compute_uv=False)
        return float(values[-1] / values[0]) if len(values) >= self.width else 0.0

    def answers(self, starts: int = 3000, seed: int = 1) -> list[list[dict[str, float]]]:
        """Every answer that some start leads to."""
        numbers = self._converged(self._starts(starts, seed))
        found: list[list[dict[str, float]]] = []
        for row in numbers:
            answer = self._answer(row)
            if answer is not None and not any(apart(answer, other) < 1e-4 for other in found):
                found.append(answer)
        return found

    def _starts(self, starts: int, seed: int) -> Floats:
        random_numbers = np.random.default_rng(seed)
        columns = []
        for segment, turn in zip(self.case["segments"], self.turns, strict=True):
            name = "start_angle" if turn else "angle"
            heading = random_numbers.uniform(0.0, math.tau, starts)
            columns.append(np.full(starts, math.radians(segment[name])) if name in segment else heading)
            size = np.exp(random_numbers.uniform(math.log(2.0), math.log(3.0 * self.scale), starts))
            name = "radius" if turn else "length"
            columns.append(np.full(starts, segment[name]) if name in segment else size)
            if turn:
                sweep = random_numbers.uniform(0.1, math.tau, starts)
                columns.append(np.full(starts, math.radians(segment["sweep"])) if "sweep" in segment else sweep)
        return np.stack(columns, axis=1)

    def _converged(self, numbers: Floats) -> Floats:
        """The rows that Newton's method (damped) brings to a root."""
        damping = np.full(len(numbers), 1e-2)
        missed = self.residuals(numbers)
        for _ in range(60):
            slopes = self.jacobian(numbers)
            turned = slopes.transpose(0, 2, 1)
            square = turned @ slopes
            diagonal = np.einsum("ijj->ij", square)
            diagonal += damping[:, None] * (diagonal + 1e-9)
            step = np.linalg.solve(square, -(turned @ missed[:, :, None]))[:, :, 0]
            tried = numbers + np.clip(step, -self.scale, self.scale)
            after = self.residuals(tried)
            better = np.linalg.norm(after, axis=1) < np.linalg.norm(missed, axis=1)
            numbers = np.where(better[:, None], tried, numbers)
            missed = np.where(better[:, None], after, missed)
            damping = np.where(better, damping * 0.2, np.minimum(damping * 6.0, 1e6))
            damping = np.maximum(damping, 1e-14)
        roots: Floats = numbers[np.linalg.norm(missed, axis=1) < 1e-7]
        return roots

    def _answer(self, row: Floats) -> list[dict[str, float]] | None:
        """The pieces of a row, None where a length, radius or sweep is none."""
        x, y = (np.array([float(value)]) for value in self.case["start"])
        at, pieces = 0, []
        for turn in self.turns:
            size = row[at + 1]
            if size <= 1e-6 or (turn and not 1e-6 < row[at + 2] <= math.tau + 1e-9):
                return None
            actual, _, at = self._piece(row[None, :], at, turn, x, y)
            names = ("x_end", "y_end", "x_center", "y_center") if turn else ("x_end", "y_end")
            pieces.append({name: float(actual[name][0]) for name in names})
            x, y = actual["x_end"], actual["y_end"]
        return pieces


def apart(first: Sequence[Piece], second: Sequence[Piece]) -> float:
    """The largest difference between two answers, in millimeters."""
    names = ("x_end", "y_end", "x_center", "y_center")
    pairs = zip(first, second, strict=True)
    return float(max(abs(a[name] - b[name]) for a, b in pairs for name in names if name in a and name in b))
