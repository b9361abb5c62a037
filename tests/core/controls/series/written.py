"""Long programs, seeded: connected lines and arcs written in every way plain blocks can be, with others between."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, radians, sin
from random import Random

OTHERS = ("(a note)", "M8", "", "G4 P1", "S500", "G1", "X1 X2", "G1 X", "#1=3", "F0", "G90 G0 Z5", "%", "G40", "G5.5")
"""Lines that are not plain, some of them wrong."""

CLEAN = OTHERS[:5]
"""Those of them that leave the contour as it is."""


@dataclass
class Pen:
    """A contour being written: `radius` of its sizes, what is in force, and where it stands.

    `outward`: it turns corners this way alone, +1 to the left, -1 to the right.
    """

    random: Random
    radius: float
    absolute: bool
    outward: int = 0
    incremental: bool = False
    code: str = ""
    x: float = 0.0
    y: float = 0.0
    heading: float = 0.0

    def line(self) -> str:
        """One more element, as a line of the program."""
        chance, code = self.random, "G1"
        corner = chance.choice((0.0, 0.0, 0.03, -0.03, 0.4, -0.4, 1.2, -1.2, pi / 2, -pi / 2, 2.0, -2.5, pi))
        self.heading += self.outward * min(abs(corner), 2.5) if self.outward else corner
        x, y, words = self.x, self.y, ""
        if chance.random() < 0.6:
            length = self.radius * chance.choice((0.3, 2.0, 3.0, 5.0, 9.0)) * chance.uniform(0.7, 1.3)
            self.x, self.y = x + length * cos(self.heading), y + length * sin(self.heading)
            code = "G0" if chance.random() < 0.1 else "G1"
        else:
            code, words = self._arc()
        self.x, self.y = round(self.x, 6), round(self.y, 6)
        base = (x, y) if self.incremental else (0.0, 0.0)
        return self._styled(code, f"X{self.x - base[0]:.6f} Y{self.y - base[1]:.6f}{words}")

    def _arc(self) -> tuple[str, str]:
        chance = self.random
        radius = self.radius * chance.choice((0.7, 1.5, 3.0, 6.0)) * chance.uniform(0.8, 1.2)
        turn, swept = chance.choice((-1, 1)), radians(chance.choice((15, 60, 90, 170, 250, 360)))
        x, y = self.x, self.y
        cx, cy = x - turn * radius * sin(self.heading), y + turn * radius * cos(self.heading)
        begin = self.heading - turn * pi / 2
        if swept < 6.2:
            self.x, self.y = cx + radius * cos(begin + turn * swept), cy + radius * sin(begin + turn * swept)
        self.heading += turn * swept
        code = "G3" if turn > 0 else "G2"
        if swept < 3.0 and chance.random() < (0.02 if self.absolute else 0.4):
            return code, f" R{radius:.6f}"
        from_origin = self.absolute and not self.incremental
        i, j = (cx, cy) if from_origin else (cx - x, cy - y)
        return code, f" I{i:.6f} J{j:.6f}" + " K1." * (chance.random() < 0.02)

    def _styled(self, code: str, words: str) -> str:
        chance = self.random
        lead = chance.choice((f"{code} ", f"G0{code[1]} "))
        lead = "" if code == self.code and chance.random() < 0.7 else lead
        self.code = code
        extra = chance.random()
        words += " F777." if extra < 0.05 else f" Z{chance.uniform(-5, 5):.3f}" if extra < 0.1 else ""
        text = f"N{chance.randrange(99)} {lead}{words}" if extra > 0.95 else lead + words
        style = chance.random()
        if style < 0.1:
            return text.lower()
        return text.replace(" ", "") if style < 0.4 else f"\t{text} " if style < 0.5 else text


def written(seed: int, *, absolute: bool = False, others: tuple[str, ...] = OTHERS, count: int = 40) -> str:
    """A program: its head, a contour under compensation with other lines here and there, its end."""
    random = Random(seed)
    side, outward = random.choice((("G41", -1), ("G42", 1)))
    pen = Pen(random, random.choice((0.6, 1.0, 10.0)), absolute, random.choice((0, outward)))
    plane = random.choice(("G17", "G17", "G17", "G18", "G19"))
    lines = [f"{random.choice(('G20', 'G21'))} {plane} G90 F500.", "T1 M6", "G0 X0. Y-9. Z1."]
    lines += [pen.line()] if random.random() < 0.3 else []
    entry = random.randrange(4)
    lines += [f"{side} D1" if entry else f"{side} D1 G1 X0. Y-4."] if not absolute else [f"G1 {side} X0. Y-4."]
    pen.x, pen.y, pen.code = 0.0, 0.0, ""
    lines += ["G1 X0. Y0."]
    share = random.choice((0.0, 0.02, 0.1))
    for index in range(count):
        if random.random() < share:
            lines.append(random.choice(others))
        elif random.random() < share / 2:
            pen.incremental = not pen.incremental
            lines.append("G91" if pen.incremental else "G90")
        else:
            lines.append(pen.line())
        if index == count // 2 and random.random() < 0.3:
            lines += ["G40", "G1 X-9. Y-9. G90", side + " D1" * (not absolute), "G1 X-2. Y-2."]
            pen.incremental, pen.x, pen.y = False, -2.0, -2.0
    text = "\n".join((*lines, "G40", "G0 Y-20.", "M2", ""))
    return text if plane == "G17" else turned(text, plane)


def turned(text: str, plane: str) -> str:
    """The same contour in another plane."""
    capitals, others = ("XYZIJ", "ZXYKI") if plane == "G18" else ("XYZIJ", "YZXJK")
    return text.translate(str.maketrans(capitals + capitals.lower(), others + others.lower()))
