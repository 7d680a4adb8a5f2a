"""The mistakes of a table in sentences."""

from __future__ import annotations

from pipeline.answer.record import DoctorFinding
from reports.quantities import short


def doctor_sentence(found: tuple[DoctorFinding, ...]) -> str:
    """What the table seems to have, and how much of the misfit that is."""
    words = " or ".join(it.hypothesis for it in found)
    tell = "these readings cannot tell which; " if len(found) > 1 else ""
    before, after = short(found[0].chi_square_before), short(found[0].chi_square_after)
    return (
        f"it looks as if {words}: {tell}chi-square with the best single effect falls from {before} to {after} "
        "in a part of the rows."
    )


def mends(found: tuple[DoctorFinding, ...]) -> tuple[str, ...]:
    """What mends each."""
    return tuple(f"If {it.hypothesis}: {it.mend}." for it in found)
