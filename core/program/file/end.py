"""How a program file knows its own end, and what is said of one that is cut off.

A file of which the rest was lost can be a whole, other program: `y_end = 3.5` becomes `y_end = 3`.  The first line of
a file that this program writes therefore says what its last one is.  Both are comments: a file without the first, such
as one written by hand, needs no last one, and one with text added behind the last one is whole.
"""

from __future__ import annotations

import re
from typing import Final

END: Final = "# end of program"
"""The last line of a program file."""

PROMISE: Final = f'# its last line is "{END}"'
"""What the first line says."""

_PROMISED: Final = re.compile(rf"^[ \t]*format[ \t]*=[^\n]*{re.escape(PROMISE)}", re.MULTILINE)
_ENDED: Final = re.compile(rf"^[ \t]*{END}[ \t]*\r?$", re.MULTILINE)
_KEY: Final = re.compile(r"\s*([A-Za-z_]+)\s*=")
_FAULT: Final = re.compile(r"(.*) \(at (?:(line (\d+), column \d+)|end of document)\)", re.DOTALL)


def cut_off(text: str) -> str | None:
    """The line and the sentence on a text that promises an end and lacks it, None for every other one."""
    if _PROMISED.search(text) is None or _ENDED.search(text) is not None:
        return None
    lines = text.rstrip().splitlines()
    return (
        f'line {len(lines)}: cut off behind "{_shown(lines[-1])}": the last line, "{END}", is missing. '
        "Open a saved copy or an earlier version; if nothing is missing, add that line."
    )


def _shown(line: str) -> str:
    plain = "".join(sign if sign.isprintable() else "?" for sign in " ".join(line.split()))
    return plain if len(plain) <= LONGEST else f"{plain[:LONGEST]}..."


LONGEST: Final = 40
"""Characters of a line that a sentence repeats."""


def syntax_fault(fault: str, text: str) -> str:
    """What a reader of TOML says of a text, with its line in front and what to do behind it.

    What stops in the middle of its last line may be cut off there; the key of that line is named.
    """
    found = _FAULT.fullmatch(fault)
    if found is None:
        return "somewhere in it: a number has too many digits. Correct it there, or open a saved copy."
    lines = text.splitlines() or [""]
    stops = found[3] is None or (int(found[3]) >= len(lines) and not text.endswith("\n"))
    if not stops:
        twice = _KEY.match(lines[int(found[3]) - 1]) if found[1] == "Cannot overwrite a value" else None
        if twice is not None:
            return f"{found[2].partition(',')[0]}: {twice[1]} stands twice: remove one."
        return f"{found[2]}: {found[1]}. Correct it there, or open a saved copy."
    key = _KEY.match(lines[-1])
    where = f"line {len(lines)}{f', {key[1]}' if key else ''}"
    text = "The file may be cut off there: open a saved copy or an earlier version, or mend the line."
    return f"{where}: {found[1]}. {text}"
