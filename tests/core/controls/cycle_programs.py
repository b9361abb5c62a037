"""Random programs of drilling cycles and of feeds by time and by turn, for the interpreter itself to judge."""

from __future__ import annotations

from random import Random

CODES = ("G81", "G82", "G83", "G73", "G85", "G86", "G89", "G84", "G74")


def drilled(seed: int) -> str:
    """Rows of holes in any plane, absolute and incremental, with returns to R and to the height before."""
    random = Random(seed)
    plane, letters = random.choice((("G17", "XYZ"), ("G17", "XYZ"), ("G18", "ZXY"), ("G19", "YZX")))
    lines = [f"{random.choice(('G20', 'G21'))} {plane} F9 S50 {random.choice(('M3', 'M3', 'M4', ''))}"]
    lines.append(f"G0 {letters[2]}{random.choice((1, 2, 5, -3))}")
    for _ in range(random.randint(2, 7)):
        lines.append(_hole(random, letters))
        if random.random() < 0.25:
            lines.append(random.choice(("G80", "G98", "G99", f"G0 {letters[2]}4", "G91", "G90", "G52 X1 Z1", "X1", "")))
    return "\n".join((*lines, "G80 G90", "G0 X0", "M2", ""))


def _hole(random: Random, letters: str) -> str:
    words = []
    if random.random() < 0.5:
        words.append(random.choice(CODES if letters == "XYZ" else CODES[:-2]))
        keep = 0.95
    else:
        keep = 0.3
    for letter, values in (("R", (1, 0.5, 2, -1)), (letters[2], (-1, -2.5, -0.5)), ("Q", (0.4, 1.2)), ("P", (1,))):
        right = letter != "Q" or not words or words[0] in ("G83", "G73")
        right = right and (letter != "P" or (bool(words) and words[0] in ("G82", "G86", "G89")))
        if right and random.random() < keep and (letter not in "QP" or words):
            words.append(f"{letter}{random.choice(values)}")
    words.append(f"{letters[random.randrange(2)]}{random.choice((1, 2.5, -3))}")
    if random.random() < 0.2:
        words.append(f"L{random.choice((1, 2, 3))}")
    if random.random() < 0.2:
        words.insert(0, random.choice(("G90", "G91", "G98", "G99")))
    return " ".join(words)


def timed(seed: int) -> str:
    """Moves whose feed is a time or goes with the spindle, some of them compensated."""
    random = Random(seed)
    lines = [f"G20 G17 F9 {random.choice(('S100 M3', 'S250', ''))}", random.choice(("G93", "G95", "G94", "G93"))]
    on = random.random() < 0.5
    lines += ["G42 D1", "G1 X2 Y-1 F3"] if on else ["G1 X2 Y-1 F3"]
    for index in range(random.randint(2, 6)):
        word = f"F{random.choice((1, 2.5, 4))}" if random.random() < 0.9 else ""
        x, y = 2 + 3 * index + 3, -1 - random.choice((0, 1, 3)) * (index % 2)
        turn = f"G2 X{x} Y{y} R9" if random.random() < 0.3 else f"G1 X{x} Y{y}"
        lines.append(f"{turn} {random.choice(('', '', 'Z.5'))} {word}")
        if random.random() < 0.15:
            lines.append(random.choice(("G94 F8", "G95 F.1", "G93", "S80", "G97 S60")))
    lines += ["G40", "G1 X0 Y9 F2"] if on else ["G0 X0"]
    return "\n".join((*lines, "M2", ""))
