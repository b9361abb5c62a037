"""Programs with parameters, expressions and O-words, seeded ones among them, for the interpreter itself to judge."""

from __future__ import annotations

from random import Random

SAME: dict[str, str] = {
    "settings count from the next line": "#1=2\n#3=15 G1 X#3 Y#1\nX#3",
    "ranks": "G1 X[2**3**2] Y[-2**2] Z[1+2*3]\nX[7 MOD 3] Y[-7 MOD 3] Z[1 EQ 1 AND 0]\nX[1GT0] Y[2--2] Z[4/2/2]",
    "ranks of comparing": "G1 X[2*3**2]Y[8/2*4]Z[1-2-3]\nX[1 AND 1 EQ 2]Y[3 GT 2 GT 0]\nX[1 LT 2 + 3]",
    "equality": "G1 X[1.00005 EQ 1] Y[1 GE 1.00005] Z[1 GT 1.00005]\nX[3 XOR 0] Y[0 OR 2] Z[2 AND 0]\nX[1 NE 1.00005]",
    "signs": "#1=2\nG1 X-#1 Y-[3] Z-sin[30]\nX++2\nX--[2] Y+-2\nX[2 - -3] Y[2*-3] Z[-[3]]",
    "functions": "G1 Xround[2.5]Yround[-2.5]Zfup[1.2]\nXexp[1]Yln[2]Ztan[45]\nXacos[0]Yasin[.5]Zcos[60]\nXfix[-2.5]",
    "more functions": "G1 Xsqrt[4]Yatan[-1]/[-1]Zabs[-2]\nX[exists[#<a>]]\n#<a>=1\nY[exists[#<a>]+1]",
    "a zero below zero": "#1=-0\n#2=[0*-1]\nG1 X[atan[#1]/[-1]] Y[atan[#2]/[-1]]",
    "numbers that are worked out": "#1=5\n#[1+1]=6\n##2=7\nG1 X#1 Y#2 Z#6\nX##2",
    "two settings in a line": "#1=3 #1=4 #<a>=[#1+1]\nG1 X#1 Y#<a>\n#<a>=1 #<a>=2\nX#<A>Y#<a >",
    "names": "#<a>=3\n#<_bb>=4\no1 sub\n#<a>=7\nG1 X#<_bb> Y#<a>\no1 endsub\no1 call\nX#<a>",
    "what the machine knows": "T1 M6 G1 X#5400 Y#5410 Z#5220\nX#<_metric> Y#<_plane> Z#<_absolute>\nG18\nX#<_plane> Y2",
    "positions": "G1 X3 Y4 Z5\nG52 X1\nX[#5420+2] Y[#5421*2] Z[#<_z>-1]\nG91 X#<_x> Y1",
    "comments between words": "G1 (a) X[ 1 + 2 ] (b) Y 3 ; c\n(#1=9) X#1",
    "a code that is worked out": "#1=1\nG#1 X1\nG[#1-1] X3",
    "a subprogram behind the end": "o100 call [1] [2]\nM2\no100 sub\nG1 X#1 Y#2 Z#3\no100 endsub",
    "a value returned": "o1 sub\no2 return [5]\no1 endsub\no1 call\nG1 X#<_value> Y#<_value_returned>",
    "a value returned at the end": "o1 sub\no1 endsub [#1*2]\no1 call [4]\nG1 X#<_value> Y[#<_call_level>+1]",
    "recursion": "o1 sub\no2 if [#1 LT 9]\no1 call [#1+1]\no2 endif\nG1 X#1\no1 endsub\no1 call [1]",
    "locals come back": "o1 sub\n#31=5 #1=8\no1 endsub\n#1=3\no1 call [4]\nG1 X#1 Y#31",
    "labels with names": "o<abc> sub\nG1 X#1\no<ABC> endsub\no<Abc> call [3]",
    "a label that is worked out": "#1=7\no7 sub\nG1 X#1\no7 endsub\no[#1] call [4]",
    "a return in the middle": "o1 sub\nG1 X1\no2 return\nX2\no1 endsub\no1 call\nX3",
    "while and continue": "o1 while [#1 LT 3]\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\nG1 X#1\no1 endwhile",
    "while and break": "o1 while [1]\nG1 X#1\n#1=[#1+1]\no2 if [#1 GT 2]\no1 break\no2 endif\no1 endwhile\nX9",
    "do and continue": "o1 do\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\nG1 X#1\no1 while [#1 LT 4]\nX9",
    "do and break": "o1 do\nG1 X#1\n#1=[#1+1]\no2 if [#1 GT 2]\no1 break\no2 endif\no1 while [1]\nX9",
    "repeat": "o1 repeat [1.6]\nG91 G1 X1\no1 endrepeat\no2 repeat [-1]\nX1\no2 endrepeat\nY1",
    "repeat once": "o1 repeat [1]\nG91 G1 X1\no1 endrepeat\nY1",
    "repeats inside each other": "o1 repeat [2]\nG91 G1 X1\no2 repeat [2]\nY1\no2 endrepeat\no1 endrepeat",
    "branches": "G1\no1 if [0]\nX1\no1 elseif [0]\nX2\no1 elseif [1]\nX3\no1 else\nX4\no1 endif\nX5",
    "the other branch": "G1\no1 if [0]\nX1\no1 else\nX4\no1 endif\no2 if [1]\nX6\no2 else\nX7\no2 endif",
    "what is skipped is not read": "o1 while [0]\nfoo bar\no1 endwhile\nG1 X1",
    "m98 inside": "o1 sub\nM98 P2\no1 endsub\no1 call [4]\nM2\nO2\nG1 X#1\nM99",
    "m98 shares its caller's numbers": "#3=2\nM98 P1\nG1 Y#3\nM2\nO1\nG1 X#3\n#3=4\nM99",
    "the end inside": "o1 sub\nG1 X#1\nM2\no1 endsub\no1 call [4]\nX5",
    "block numbers": "N10 #1=3\nN20 o1 sub\nN30 G1 X#1\nN40 o1 endsub\nN50 o1 call [8]\nN60 G1 Y#1",
    "positions by name under compensation": "G41 D1\nG1 X9 Y2\nX12\nY9\nX[#<_x>+3] Y[#<_y>]\nG40\nX[#<_x>+1] Y#5421",
    "positions by name on an arc": "G18 G41 D1\nG1 X9 Z2\nX12\nG3 X14 Z4 R2\nG1 X[#<_x>+2] Z#<_z>\nG40\nX0",
    "a slot": "#<r>=.25 #<n>=3\nG41.1 D[#<r>*2]\nG1 X2\no1 repeat [#<n>]\nG91 X[4/#<n>]\no1 endrepeat\nG90 Y5\nG40\nX0",
}
"""Programs the interpreter runs, in inches with a feed in force and without their end."""

REFUSED: dict[str, tuple[str, int, int]] = {
    "nothing by zero": ("G1 X[1/0]", 2, 7),
    "no number": ("G1 X[0 MOD 0]", 2, 8),
    "not closed": ("G1 X[1+2", 2, 5),
    "closed too often": ("G1 X[1]]", 2, 8),
    "no operator": ("G1 X1 + 2", 2, 7),
    "nothing in brackets": ("G1 X[]", 2, 6),
    "read only": ("#5420=3", 2, 1),
    "read only by name": ("#<_x>=3", 2, 1),
    "out of range": ("#7000=3", 2, 1),
    "parameter 0": ("G1 X##1", 2, 5),
    "half a number": ("#1.5=3", 2, 1),
    "a name without value": ("G1 X#<a>", 2, 5),
    "a name without value in a condition": ("o1 if [#<q> GT 1]\no1 endif", 2, 8),
    "a name of the caller": ("#<a>=3\no1 sub\nG1 Z#<a>\no1 endsub\no1 call", 4, 5),
    "nothing set": ("#<a>", 2, 1),
    "set inside a word": ("G1 X#1=3", 2, 7),
    "a comment in brackets": ("G1 X[1 + (c) 2]", 2, 10),
    "two points": ("G1 X[1].5", 2, 8),
    "a root": ("G1 XSQRT[-1]", 2, 5),
    "an angle": ("G1 Xacos[2]", 2, 5),
    "a logarithm": ("G1 Xln[0]", 2, 5),
    "half an angle": ("G1 Xatan[1]", 2, 5),
    "an exponent": ("G1 X1E2", 2, 6),
    "a block number worked out": ("N#3 G1 X1", 2, 1),
    "the position under compensation": ("G41 D1\nG1 X9\nX12\nX[#5420+3]", 5, 3),
    "too many inside each other": ("o1 sub\no1 call\no1 endsub\no1 call", 3, 4),
    "m99 in an o subprogram": ("o1 sub\nG1 X1\nM99\no1 endsub\no1 call", 4, 1),
    "return outside": ("o1 return", 2, 4),
    "endsub outside": ("o1 endsub", 2, 4),
    "endwhile alone": ("o1 endwhile", 2, 4),
    "break alone": ("o1 break", 2, 4),
    "break of a repeat": ("o1 repeat [3]\no1 break\no1 endrepeat", 3, 4),
    "elseif alone": ("o1 elseif [1]", 2, 4),
    "no such subprogram": ("o1 call", 2, 4),
    "a subprogram twice": ("o1 sub\no1 endsub\no1 sub\no1 endsub", 4, 4),
    "a subprogram in another": ("o1 sub\no2 sub\nG1 X1\no2 endsub\no1 endsub\no1 call", 3, 4),
    "a label twice": ("o1 if [1]\no1 endif\no1 if [1]\no1 endif", 4, 4),
    "words behind a condition": ("o1 if [1] G1 X3\no1 endif", 2, 11),
    "two values returned": ("o1 sub\no1 return [1] [2]\no1 endsub\no1 call", 3, 15),
    "a call beside words": ("G1 o1 call", 2, 7),
    "no endif": ("o1 if [0]\nG1 X1", 2, 4),
}
"""Programs the interpreter refuses, and the line and column to be named."""


def whole(body: str) -> str:
    """A program of one of these bodies."""
    return f"G20 G17 F9\n{body}\nM2\n"


def generated(seed: int) -> str:
    """A contour under compensation, by parameters and loops; every seed another one."""
    random = Random(seed)
    side, count = random.choice(("G41", "G42")), random.randint(3, 9)
    size = random.choice((3, 6, 12))
    step = random.choice((360, -360, 180, -180, 540))
    body = [
        f"#<d>=[{random.choice((1, 2, 4))}/{random.choice((3, 5, 7))}] #<_side>={random.randint(0, 1)}",
        f"o<corner> sub\n#<a>=[#1*{step}/{count}]",
        f"G1 X[#2*cos[#<a>]] Y[#2*sin[#<a>]{random.choice(('', '*2', '+#1/4'))}]\no<corner> endsub [#<a>]",
        "G0 X-20 Y-20",
        f"{side}.1 D#<d>",
        f"G1 X[{size}+#<d>] Y{random.choice(('0', '[-#<d>*4]', '2'))}",
        f"#5=0\no10 while [#5 LT {count}]",
        f"o<corner> call [#5] [{size}-#5*{random.choice((0, 0, 0.1, 0.3))}]\n#5=[#5+1]",
        f"o11 if [#5 MOD {random.randint(2, 4)} EQ 0]\nG91 {random.choice(('Z.25', 'X1', 'G1 Y-1'))}\nG90\no11 endif",
        "o10 endwhile",
        f"G{random.choice((2, 3))} X[#5420+0] Y1 R9" if random.random() < 0.05 else "G40",
        "G1 X-9 Y[#<_value>/100]\nM2",
    ]
    return "G20 G17 F9\n" + "\n".join(body) + "\n"
