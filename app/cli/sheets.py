"""A program's setup sheet for a file; imported when one is written, because it needs the numeric library."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path

from core.pipeline.derive import derive
from core.pipeline.setup_sheet import sheet_page, sheet_text
from core.program.model import Program


def sheet_for(program: Program, path: Path, *, name: str = "") -> str:
    """The sheet as its file's ending asks: .html a page, anything else text; everything is derived anew."""
    write = sheet_page if path.suffix.lower() in (".html", ".htm") else sheet_text
    day = datetime.now().astimezone().strftime("%Y-%m-%d")
    return write(derive(program), name=name or path.stem, day=day)
