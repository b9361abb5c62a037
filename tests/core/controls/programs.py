"""Random compensated programs, seeded: lines and arcs at outside, inside and tangent corners, in the words of ISO."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, pi, radians, sin, sqrt
from random import Random

RADIUS = 100.0
"""Cutter radius of the programs, in program units; sizes go with it, so that four decimals are many digits."""


MODAL: dict[str, str] = {
    "subprograms, repeated": "G20 F9\nM98 P7 L3\nG90\nM98 P8\nM2\nO7\nG91 G1 X1 Y.5\nM99\nO8\nG1 X0\nM98 P7\nM99\n",
    "a local shift replaces the last one": "G20 F9\nG52 X5\nG1 X1\nG52 X-5 Y1\nG1 X1 Y1\nG52 X0 Y0\nG1 X1\nM2\n",
    "a preset origin": "G20 F9\nG1 X1 Y1\nG92 X0 Y5\nG1 X2 Y2\nG92.1\nG1 X0 Y0\nM2\n",
    "arcs by radius": "G20 F9\nG1 X1\nG2 X3 R1\nG3 X3 Y2 R-1.5\nG2 X2 Y3 R1\nM2\n",
    "arcs with absolute centers": "G20 F9\nG90.1\nG1 X1\nG2 X3 Y0 I2 J0\nG3 X3 Y0 I4 J0\nM2\n",
    "planes": "G20 F9\nG18\nG2 X2 Z0 I1 K0\nG19\nG3 Y1 Z1 J0 K1\nG17\nG2 X4 Y1 I1\nM2\n",
    "a helix": "G20 F9\nG2 X2 Y0 Z-1 I1\nG3 X2 Y0 Z-2 J1\nM2\n",
    "incremental moves under compensation": "G20 F9\nG42 D1\nG1 X2\nG91\nX2\nY-2\nG2 X1 Y-1 I1\nG40\nG1 G90 X0\nM2\n",
    "z moves wait at an inside corner": "G20 F9\nG41 D1\nG1 X2\nX4\nZ-1\nZ0\nY3\nG40\nX0\nM2\n",
    "compensation of radius 0": "G20 F9\nG41\nG1 X2\nX4\nY3\nG40\nX0\nM2\n",
    "the program ends under compensation": "G20 F9\nG41 D1\nG1 X2\nX4\nM2\n",
    "machine coordinates": "G20 F9\nG52 X3\nG1 X1\nG53 G0 X1\nG1 X1\nM2\n",
    "a rapid corner": "G20 F9\nG42 D1\nG0 X2\nG0 X4\nG0 Y3\nG1 X0\nG40\nX-2\nM2\n",
    "comments and spaces": "g20 (inch) f 9\ng1 x1 (y2) y 3 ; z4\nm2\n",
    "blanks inside words": "G 2 0 F 9\nG1 X1 .5 Y- 2\nG4 P. 1\nM 2\n",
    "a preset canceled in a block of motion": "G20 F9\nG1 X1\nG92 X0\nG92.1 G1 X5\nM2\n",
    "g80 next to another motion": "G20 F9\nG0 G17 G40 G49 G80 G90\nG0 G80 X5\nX6\nG80 G1 X7 Y1\nG80 G80 G0 X1\nM2\n",
    "g80 next to a cycle": "G20 F9\nG81 X1 Z-1 R.1\nG80 G81 X2\nX3\nG80 G0 X4\nG1 Z1\nG80 G82 X2 Z-2 R.1 P1\nM2\n",
    "g80 next to a code that is no motion": "G20 F9\nG1 X1\nG80 G92 X5\nG1 X2\nG80 G4 P1\nG0 X3\nM2\n",
    "a work offset set by the program": "G20 F9\nG55\nG1 X1\nG54\nG1 X1\nM2\n",
}
"""Programs in inches for the modal machine, tool 1 of diameter .5 and tool 2 of .25, by what they are about."""


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
        radius = RADIUS * self.random.choice((0.7, 1.3, 2.0, 3.0, 5.0, 8.0)) * self.random.uniform(0.8, 1.2)
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
        length = RADIUS * random.choice((0.8, 1.5, 1.5, 2.0, 3.0, 3.0, 5.0))
        writer.x += length * cos(writer.heading)
        writer.y += length * sin(writer.heading)
        entry = [f"G1 X{writer.x:.6f} Y{writer.y:.6f}"]
    body = writer.lines(random.randint(1, 5))
    tail = ["G40", f"G0 X{writer.x + 5 * RADIUS:.6f} Y{writer.y:.6f} Z20", "M2"]
    return "\n".join((*head, *entry, *body, *tail)) + "\n"


def stopped(seed: int) -> str:
    """One of these programs with a program stop somewhere under compensation."""
    random, lines = Random(seed), program(seed).split("\n")
    on = next(index for index, line in enumerate(lines) if line.startswith(("G41", "G42")))
    lines.insert(random.randint(on + 2, lines.index("G40")), random.choice(("M0", "M1", "M60")))
    return "\n".join(lines)


def turned_to_zx(text: str) -> str:
    """The same program in the plane G18: X is written Z, Y is X, Z is Y, I is K and J is I."""
    words = str.maketrans({"X": "Z", "Y": "X", "Z": "Y", "I": "K", "J": "I"})
    return text.translate(words).replace("G17", "G18")


def broken(seed: int) -> str:
    """One of the modal programs with one or two of its signs or lines out of place."""
    random = Random(seed)
    text = random.choice(list(MODAL.values()))
    for _ in range(random.randint(1, 2)):
        at = random.randrange(len(text))
        match random.randrange(5):
            case 0:
                text = text[:at] + text[at + 1 :]
            case 1:
                text = text[:at] + text[at] + text[at:]
            case 2:
                text = text[:at] + text[at + 1 : at + 2] + text[at : at + 1] + text[at + 2 :]
            case 3:
                lines = text.split("\n")
                one, other = random.randrange(len(lines)), random.randrange(len(lines))
                lines[one], lines[other] = lines[other], lines[one]
                text = "\n".join(lines)
            case _:
                text = text[:at] + random.choice("0123456789GXYZIJRFM.-") + text[at:]
    return text


def _round(count: int) -> list[tuple[float, float]]:
    """Points all round a large circle, from the second one on."""
    angles = (2 * pi * index / count for index in range(1, count))
    return [(20_000 * sin(angle), 20_000 * (1 - cos(angle))) for angle in angles]


def long(count: int) -> str:
    """A program of this many compensated lines and arcs around a large circle."""
    lines = ["G21 G17 G90 F500", "G0 X-10 Y-10", "G41 D1", "G1 X0 Y0"]
    for index, (x, y) in enumerate(_round(count), 1):
        point = f"X{x:.4f} Y{y:.4f}"
        lines.append(f"G1 {point}" if index % 3 else f"G3 {point} R400")
    return "\n".join((*lines, "G40", "G1 X0 Y-20", "M2", ""))


def long_klartext(count: int) -> str:
    """The same in Klartext."""
    lines = ["BEGIN PGM LONG MM", "TOOL CALL 1 Z S1000", "L X-10 Y-10 R0 FMAX", "L X+0 Y+0 RL F500"]
    for index, (x, y) in enumerate(_round(count), 1):
        point = f"X{x:+.4f} Y{y:+.4f}"
        lines.append(f"L {point}" if index % 3 else f"CR {point} R+400 DR+")
    return "\n".join((*lines, "L X+0 Y-20 R0", "END PGM LONG MM", ""))


def long_threeblock(count: int) -> str:
    """As long for `threeblock`, with absolute centers, and each other block an arc: it refuses lines on one line."""
    lines, x, y = ["G71G17G90F500.", "T1M6", "G0X-10.Y-10.", "G1G41X-5.Y-5.", "X0Y0"], 0.0, 0.0
    for index, (end_x, end_y) in enumerate(_round(count), 1):
        dx, dy = end_x - x, end_y - y
        away = sqrt(400.0**2 / (dx * dx + dy * dy) - 0.25)
        center = f"I{(x + end_x) / 2 - away * dy:.4f}J{(y + end_y) / 2 + away * dx:.4f}"
        lines.append(f"G1X{end_x:.4f}Y{end_y:.4f}" if index % 2 else f"G3X{end_x:.4f}Y{end_y:.4f}{center}")
        x, y = end_x, end_y
    return "\n".join((*lines, "G40", "G1X0Y-20.", "M2", ""))
