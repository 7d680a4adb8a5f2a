"""The mistakes of a table in a sentence."""

from __future__ import annotations

from pipeline.answer import DoctorFinding
from reports.quantities import short


def doctor_sentence(found: tuple[DoctorFinding, ...]) -> str:
    """What the table seems to have, and how much of the misfit that is."""
    words = " or ".join(it.hypothesis for it in found)
    first = found[0]
    tell = "these readings cannot tell which; " if len(found) > 1 else ""
    before, after = short(first.chi_square_before), short(first.chi_square_after)
    return (
        f"it looks as if {words}: {tell}chi-square with the best single effect falls from {before} to {after} "
        "in a part of the rows."
    )
