"""Tables of the run itself: what was run, the errata, how long it took, with which versions."""

from collections.abc import Mapping

from reports.blocks import Column, Table, table
from reports.formats import CELLS, count, fixed, number, plain
from reports.load import Json


def pairs(caption: str, first: str, second: str, items: Mapping[str, str]) -> Table:
    """A table of two text columns."""
    columns = [Column(first, numeric=False), Column(second, numeric=False)]
    return table(caption, columns, [[key, value] for key, value in items.items()])


def run(result: Json) -> Table:
    """What was run."""
    bar = result["bar"]
    cells = CELLS.get(bar["cell_kind"], bar["cell_kind"])
    return pairs(
        "The run",
        "what",
        "value",
        {
            "case": result["case"],
            "detail": result["detail"],
            "bar length L": f"{result['length_mm']:g} mm",
            "parallelogram width d": f"{result['width_mm']:g} mm",
            "working mesh of the bar": f"{count(bar['dofs'])} dofs, {count(bar['cells'])} {cells}",
            "solver": result["solver"],
            "time": f"{number(total(result), 3)} s",
        },
    )


def total(result: Json) -> float:
    """Seconds of the whole run: the entry "total" where the run has one, else the sum of its stages."""
    seconds = result["seconds"]
    return seconds["total"] if "total" in seconds else sum(seconds.values())


def seconds(result: Json) -> Table:
    """Seconds per stage."""
    stages = {key: value for key, value in result["seconds"].items() if key != "total"}
    rows = [[plain(key), fixed(value, 2)] for key, value in stages.items()]
    rows.append(["whole run", fixed(total(result), 2)])
    return table("Time per stage", [Column("stage", numeric=False), Column("time", "s")], rows)


def versions(result: Json) -> Table:
    """Versions, commit and seed."""
    items = {**result["versions"], "commit": result["commit"], "seed": str(result["seed"])}
    return pairs("Versions", "package", "version", items)


def errata(result: Json) -> Table:
    """Slips of the paper, each with its evidence."""
    keys = ("number", "place", "printed", "correct", "evidence")
    columns = [Column("no." if key == "number" else key, numeric=False) for key in keys]
    rows = [[str(item[key]) for key in keys] for item in result["errata"]]
    return table("", columns, rows)
