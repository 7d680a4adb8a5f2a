"""The mistakes of a table in sentences."""

from __future__ import annotations

from collections.abc import Iterable

from pipeline.answer.record import DoctorFinding
from reports.quantities import short

RIGHT = (
    "If the table was looked up and is right: write table_checked = true above [rig] in campaign.toml, and what is "
    "left is looked for in the model."
)


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
    """What mends each, and what says that there is nothing to mend."""
    every = (f"If {it.hypothesis}: {it.mend}." for it in found)
    return (*every, RIGHT) if found else ()


def lines_aside(cells: Iterable[tuple[str, int, str]]) -> str:
    """The lines of campaign.toml that leave readings out; each a test, a step and a column."""
    by_test: dict[str, dict[str, list[int]]] = {}
    for test, step, column in cells:
        by_test.setdefault(test, {}).setdefault(column, []).append(step)
    return " and ".join(
        f"set_aside = {{ {', '.join(f'{column} = {steps}' for column, steps in columns.items())} }} in test {test}"
        for test, columns in by_test.items()
    )
