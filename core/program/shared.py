"""What every block of a program shares: the fields of PROGRAM PARAMETERS and PART SETUP that cannot be used."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Final

from core.finding import Finding
from core.program.fields import Form
from core.program.model import Program
from core.program.solve.reading import read

NOWHERE: Final = 0
"""Segment number handed to `read`; these fields belong to no segment."""


def shared_findings(program: Program) -> Iterator[Finding]:
    """An error for every text that cannot be read and every number out of its range, under the name of its screen."""
    for form, part in ((Form.PARAMETERS, program.parameters), (Form.SETUP, program.setup)):
        for one in read(form, part, program.unit, NOWHERE).findings:
            yield replace(one, segment=None, text=f"{form.value}: {one.text}")
