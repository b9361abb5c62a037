"""A SAFE Z that does not clear the part: posting sets it aside, and says so here.  Needs no numpy."""

from __future__ import annotations

from collections.abc import Iterator

from core.finding import Finding, Severity
from core.program.fields import Form, check, default, field
from core.program.model import Entry, Program, Typed
from core.program.solve.solved import SolvedBlock
from core.tolerance import JOINED
from core.units import to_mm


def safe_height_findings(solved: SolvedBlock, program: Program) -> Iterator[Finding]:
    """A warning where the typed SAFE Z is lower than the clearance over Z START; of the usual one information."""
    typed = program.setup.safe_z
    safe = _length(typed, Form.SETUP, "safe_z", program)
    clearance = _length(program.parameters.retract_clearance, Form.PARAMETERS, "retract_clearance", program)
    if safe is None or clearance is None or solved.z_start is None:
        return
    clear = solved.z_start + clearance
    if safe >= clear - JOINED:
        return
    text = "SAFE Z {value} is below Z {0}, RETRACT CLEARANCE {1} over Z START {2}: the tool moves at Z {0} instead. "
    severity = Severity.INFO if typed is None else Severity.WARNING
    lengths = (clear, clearance, solved.z_start)
    yield Finding("SAFE_Z", severity, f"{text}Enter SAFE Z on PART SETUP.", field="safe_z", value=safe, lengths=lengths)


def _length(typed: Typed, form: Form, name: str, program: Program) -> float | None:
    """A length or its default in millimeters; None for one that is refused."""
    if typed is None:
        usual = default(name, program.unit)
        return None if usual is None else to_mm(usual, program.unit)
    if not isinstance(typed, Entry) or check(field(form, name), typed.value, program.unit):
        return None
    return to_mm(typed.value, program.unit)
