"""What a bench may be wrong about besides the physics: the table, what was written about the rig, the readings."""

from __future__ import annotations

from collections.abc import Iterator

from reports.blocks import Block, Bullets, Cell, Column, Table, Text, table
from reports.campaign.names import channel_label
from reports.formats import DASH, number
from reports.load import Json

PULLED = 3.0
"""Standard deviations by which a value is far from what was written."""


def known(page: Json) -> bool:
    """Whether there is anything to show."""
    return any(page.get(key) for key in ("doctor", "nominals", "set_aside", "noise"))


def blocks(page: Json) -> Iterator[Block]:
    """Mistakes of the table first, then what moved, then the readings."""
    if page.get("doctor"):
        yield Text("The table seems to have a mistake; nothing else is named before that is settled:")
        yield Bullets(mistakes(page))
    if page.get("nominals"):
        yield nominals(page)
    if page.get("set_aside"):
        yield set_aside(page)
    if page.get("noise"):
        yield noise(page)


def mistakes(page: Json) -> list[str]:
    """What the table seems to have wrong, and what mends it."""
    return [f"{it['hypothesis']}. Then {it['mend']}." for it in page["doctor"]]


def nominals(page: Json) -> Table:
    """Every number that was known to a tolerance, and where it ends."""
    columns = [
        Column("what", numeric=False),
        Column("as written"),
        Column("tolerance, 1 sigma"),
        Column("found"),
        Column("standard error"),
        Column("pull", "sigma"),
        Column("unit", numeric=False),
    ]
    rows = [
        [
            Cell(
                it["meaning"],
                "not seen" if not it["seen"] else "far" if abs(it["pull"]) > PULLED else "",
                it["name"],
            ),
            Cell(number(it["nominal"], 4)),
            Cell(number(it["tolerance"], 3)),
            Cell(number(it["value"], 4) if it["seen"] else DASH),
            Cell(number(it["std"], 2) if it["seen"] else DASH),
            Cell(f"{it['pull']:+.1f}".replace("-", "−") if it["seen"] else DASH),
            Cell("" if it["unit"] == "1" else it["unit"]),
        ]
        for it in page["nominals"]
    ]
    return table(
        "Numbers that were written down, known to a tolerance",
        columns,
        rows,
        "Fitted beside everything else. Not seen: these tests say no more of it than was written.",
    )


def set_aside(page: Json) -> Table:
    """Single bad readings."""
    columns = [
        Column("test", numeric=False),
        Column("step"),
        Column("column", numeric=False),
        Column("off by", "sigma"),
    ]
    rows = [[it["test"], str(it["step"]), it["column"], number(it["sigma"], 3)] for it in page["set_aside"]]
    return table(
        "Readings that were set aside", columns, rows, "Each is far off alone, its neighbours are not."
    )


def noise(page: Json) -> Table:
    """Sensors whose noise is not as it was declared."""
    columns = [
        Column("column", numeric=False),
        Column("declared"),
        Column("found"),
        Column("law", numeric=False),
    ]
    rows = [
        [
            channel_label(it["column"].rpartition("_")[0]),
            number(it["declared"], 3),
            number(it["found"], 3),
            _law(it),
        ]
        for it in page["noise"]
    ]
    return table("Noise that is not as declared, one sigma", columns, rows)


def _law(noise: Json) -> str:
    if noise["tails"] is not None:
        return f"Student's t, {number(noise['tails'], 2)} degrees"
    if noise["correlation"] is not None:
        return f"normal, neighbouring rows correlated by {number(noise['correlation'], 2)}"
    return "normal"
