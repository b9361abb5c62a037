"""Random compensated programs, seeded: lines and arcs at outside, inside and tangent corners, in the words of ISO."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, pi, radians, sin
from random import Random

RADIUS = 100.0
"""Cutter radius of the programs, in program units; sizes go with it, so that four decimals are many digits."""


@dataclass
class Writer:
    """A program being written, with the point and direction reached."""

    random: Random
    x: float = 0.0
    y: float = 0.0
    heading: float = 0.0

    def lines(self, count: int) -> list[str]:
        return [self._element(index) for index in range(count)]

    def _element(self, index: int) -> str:
        kind = self.random.random()
        if index and kind < 0.1:
            return f"G1 Z{self.random.uniform(-50, 50):.4f}"
        turn = self._corner()
        self.heading += turn
        if kind < 0.5:
            return self._line()
        return self._arc()

    def _corner(self) -> float:
        kind = self.random.random()
        if kind < 0.25:
            return 0.0
        if kind < 0.35:
            return self.random.choice((-1, 1)) * self.random.uniform(0.0, 0.2)
        if kind < 0.45:
            return self.random.choice((-1, 1)) * radians(self.random.choice((90, 45, 135, 179, 180)))
        return radians(self.random.uniform(-150, 150))

    def _line(self) -> str:
        length = RADIUS * self.random.choice((0.3, 1.5, 4.0, 9.0)) * self.random.uniform(0.7, 1.3)
        self.x += length * cos(self.heading)
        self.y += length * sin(self.heading)
        code = "G0" if self.random.random() < 0.08 else "G1"
        return f"{code} X{self.x:.6f} Y{self.y:.6f}"

    def _arc(self) -> str:
        radius = RADIUS * self.random.choice((0.7, 1.3, 3.0, 8.0)) * self.random.uniform(0.8, 1.2)
        turn = self.random.choice((-1, 1))
        swept = radians(self.random.choice((20, 60, 90, 170, 250, 360)))
        cx, cy = self.x - turn * radius * sin(self.heading), self.y + turn * radius * cos(self.heading)
        begin = self.heading - turn * pi / 2
        end = begin + turn * swept
        i, j = round(cx - self.x, 6), round(cy - self.y, 6)
        if swept < 6.2:
            x, y = cx + radius * cos(end), cy + radius * sin(end)
        else:
            x, y = self.x, self.y
        self.heading += turn * swept
        short = swept < 3.0 and hypot(x - self.x, y - self.y) > 1.0 and self.random.random() < 0.3
        self.x, self.y = x, y
        words = f"R{radius:.6f}" if short else f"I{i:.6f} J{j:.6f}"
        return f"{'G3' if turn > 0 else 'G2'} X{x:.6f} Y{y:.6f} {words}"


def program(seed: int) -> str:
    """One program: entry, a few elements, exit; every seed another one."""
    random = Random(seed)
    writer = Writer(random, random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(-pi, pi))
    head = [f"G21 G17 G40 G90 F{random.choice((100, 2500))}", f"G0 X{writer.x:.6f} Y{writer.y:.6f} Z10"]
    side = random.choice(("G41", "G42"))
    head.append(f"{side}.1 D{random.choice((1, 1, 1, -1)) * 2 * RADIUS}" if random.random() < 0.3 else f"{side} D1")
    if random.random() < 0.1:
        entry = [writer._arc()]
    else:
        length = RADIUS * random.choice((0.8, 1.5, 3.0))
        writer.x += length * cos(writer.heading)
        writer.y += length * sin(writer.heading)
        entry = [f"G1 X{writer.x:.6f} Y{writer.y:.6f}"]
    body = writer.lines(random.randint(1, 5))
    tail = ["G40", f"G0 X{writer.x + 5 * RADIUS:.6f} Y{writer.y:.6f} Z20", "M2"]
    return "\n".join((*head, *entry, *body, *tail)) + "\n"


def turned_to_zx(text: str) -> str:
    """The same program in the plane G18: X is written Z, Y is X, Z is Y, I is K and J is I."""
    words = str.maketrans({"X": "Z", "Y": "X", "Z": "Y", "I": "K", "J": "I"})
    return text.translate(words).replace("G17", "G18")
