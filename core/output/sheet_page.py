"""A setup sheet as one HTML page with its drawings: no script, nothing fetched, fit for paper."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape
from typing import Final

from core.output.sheet import Section, Sheet
from core.output.sheet_text import NOT_READY, READY, plain

STYLE: Final = """\
body { font: 14px/1.4 sans-serif; color: #1b1f23; max-width: 60em; margin: 2em auto; padding: 0 1em }
h1 { font-size: 1.5em } h2 { font-size: 1.15em; border-bottom: 1px solid; margin-top: 2em }
table { border-collapse: collapse; margin: .6em 0 }
th, td { text-align: left; padding: .1em 1em .1em 0; vertical-align: top }
.passes th, .passes td { text-align: right }
.bad { border: 3px solid #c4001a; padding: .5em 1em; font-weight: bold }
.good { border: 1px solid #00856a; padding: .5em 1em }
.marked { list-style: none; padding-left: 0 }
figure { margin: 1em 0 } svg { max-width: 100%; max-height: 18em; height: auto }
@media print { section { break-inside: avoid } body { margin: 0 } }
"""


def as_page(sheet: Sheet, drawings: Sequence[str]) -> str:
    """The page; `drawings` are SVG texts of `core.output.svg`, one a block."""
    title = f"Setup sheet: {_safe(sheet.title)}"
    lines = (
        "<!DOCTYPE html>",
        f'<html lang="en"><head><meta charset="utf-8"><title>{title}</title>',
        f"<style>\n{STYLE}</style></head><body>",
        f"<h1>{title}</h1>",
        *_pairs(sheet.head),
        *_verdict(sheet),
        *_section(sheet.tools, ""),
        *(line for block, drawing in zip(sheet.blocks, drawings, strict=True) for line in _section(block, drawing)),
        "</body></html>",
    )
    return "\n".join(lines) + "\n"


def _safe(text: str) -> str:
    return escape(plain(text))


def _verdict(sheet: Sheet) -> Iterator[str]:
    if not sheet.against:
        yield f'<p class="good">{_safe(READY)}</p>'
        return
    yield f'<div class="bad">{_safe(NOT_READY)}<ul>'
    yield from (f"<li>{_safe(text)}</li>" for text in sheet.against)
    yield "</ul></div>"


def _section(section: Section, drawing: str) -> Iterator[str]:
    yield f"<section><h2>{_safe(section.title)}</h2>"
    if drawing:
        yield f"<figure>{drawing}</figure>"
    yield from _pairs(section.pairs)
    if section.findings:
        yield '<h3>FINDINGS</h3><ul class="marked">'
        yield from (f"<li>{_safe(text)}</li>" for text in section.findings)
        yield "</ul>"
    yield "</section>"
    if section.table:
        yield f'<table class="{"passes" if section.pairs else "tools"}">'
        for number, row in enumerate(section.table):
            cell = "td" if number else "th"
            yield f"<tr>{''.join(f'<{cell}>{_safe(text)}</{cell}>' for text in row)}</tr>"
        yield "</table>"


def _pairs(pairs: Sequence[tuple[str, str]]) -> Iterator[str]:
    if pairs:
        yield "<table>"
        yield from (f"<tr><th>{_safe(label)}</th><td>{_safe(text)}</td></tr>" for label, text in pairs)
        yield "</table>"
