"""Tables of the parallelogram: stiffness, critical loads and where the linear model holds."""

from collections.abc import Sequence
from itertools import zip_longest
from typing import Any

from reports.blocks import Cell, Column, Table, table
from reports.formats import DASH, count, entry_of, entry_unit, fixed, held_label, number, percent, symbol
from reports.load import Json
from reports.style import model_label
from reports.tables_yield import marked, note

# Entries below this share of the diagonals they couple are rounding.
ROUNDING = 1e-6
MODELS = (
    "solid FE",
    "VJM, distributed",
    "beam formula",
    "VJM, spring at tip",
    "VJM, spring at middle",
    "VJM, spring at base",
)


def used_entries(item: Json) -> list[str]:
    """Upper-triangle entries that are not negligible in at least one of the models."""
    matrices = [item[key] for key in ("closed_form", "vjm", "fea", "doubled_bar")]
    return [
        f"K{i + 1}{j + 1}"
        for i in range(6)
        for j in range(i, 6)
        if any(abs(m[i][j]) > ROUNDING * diagonal_scale(item, i, j) for m in matrices)
    ]


def diagonal_scale(item: Json, i: int, j: int) -> float:
    """Geometric mean of the two diagonal entries that entry (i, j) couples, each the largest of all models.

    The unit of a coupling is between those of its diagonals, and the linkage's own diagonal has a zero.
    """
    matrices = [item[key] for key in ("closed_form", "doubled_bar")]
    return float((max(m[i][i] for m in matrices) * max(m[j][j] for m in matrices)) ** 0.5)


def stiffness(item: Json) -> Table:
    """Half of K_p at one angle by every model."""
    printed = item["paper"]
    rows = []
    for entry in used_entries(item):
        closed, fea = entry_of(item["closed_form"], entry), entry_of(item["fea"], entry)
        paper = "" if printed is None else number(entry_of(printed, entry) / 2)
        row = [
            symbol(entry),
            entry_unit(entry),
            number(closed / 2),
            small(entry_of(item["vjm"], entry) / 2, item, entry),
            small(fea / 2, item, entry),
            band_cell(item, entry),
            percent(fea / closed - 1.0) if closed else DASH,
            paper,
            small(entry_of(item["doubled_bar"], entry) / 2, item, entry),
        ]
        rows.append([cell for cell, keep in zip(row, kept(printed), strict=True) if keep])
    columns = [
        Column("entry", numeric=False),
        Column("unit", numeric=False),
        Column("Eq. 11"),
        Column("VJM, Eq. 10"),
        Column("solid FE"),
        Column("its mesh error", "±%"),
        Column("FE / Eq. 11 − 1", "%"),
        Column("paper, Eq. 13"),
        Column("K_b, reference"),
    ]
    columns = [column for column, keep in zip(columns, kept(printed), strict=True) if keep]
    caption = f"K_p / 2 at q = {item['q_deg']:g}°, {item['frame']} frame"
    note = "Eq. 11 has the K_b of the same mesh, so its difference to the solid holds no mesh error; the paper's does."
    return table(caption, columns, rows, f"{DASH}: Eq. 11 has a zero there.", note)


def band_cell(item: Json, entry: str) -> str:
    """Mesh error of an entry of the solid, where the run has it and the entry is not zero."""
    if not item.get("band") or not entry_of(item["closed_form"], entry):
        return DASH
    return percent(entry_of(item["band"], entry)).removeprefix("+")


def kept(printed: Any) -> list[bool]:
    """The paper's column is dropped where the paper prints nothing."""
    return [True] * 7 + [printed is not None, True]


def small(value: float, item: Json, entry: str) -> str:
    """A number that is rounding beside the bar's own entry is printed as 0."""
    scale = diagonal_scale(item, int(entry[1]) - 1, int(entry[2]) - 1)
    return "0" if abs(value) < ROUNDING * scale else number(value)


def ranks(items: Sequence[Json]) -> Table:
    """Rank of K_p and the singular values of the FE matrix."""
    rows = [
        [
            f"{item['q_deg']:g}",
            str(item["rank"]),
            percent(item["worst_fea_deviation"]).removeprefix("+"),
            *(number(value, 4) for value in item["singular_values_fea"]),
        ]
        for item in items
    ]
    columns = [Column("q", "°"), Column("rank"), Column("FE off Eq. 11", "%")]
    columns += [Column(f"σ{i}", "") for i in range(1, 1 + max(len(i["singular_values_fea"]) for i in items))]
    return table(
        "Rank, and singular values of the solid-FE K_p",
        columns,
        rows,
        "Rank of Eq. 11; the zero direction is z of the bar frame. Singular values mix N/mm, N and N·mm.",
        "FE off Eq. 11: the worst entry, against Eq. 11 with the K_b that the solid model has.",
    )


def groups(items: Sequence[Json]) -> dict[tuple[float, tuple[str, ...]], dict[str, list[Json]]]:
    """Items by (q, held), then by the model's label, in the order of the result."""
    found: dict[tuple[float, tuple[str, ...]], dict[str, list[Json]]] = {}
    for item in items:
        key = (item["q_deg"], tuple(item["held"]))
        found.setdefault(key, {}).setdefault(model_label(item), []).append(item)
    return found


def load_cell(item: Json | None) -> Cell:
    """A critical load in kN, marked with tension or its mesh error; a search without a find says how far it went."""
    if item is None:
        return Cell("")
    if item["load_N"] is None:
        searched = item.get("searched_N")
        return Cell(DASH, "none found" if searched is None else f"none up to {number(searched / 1e3, 3)} kN")
    band = item.get("band")
    mark = "tension" if item["load_N"] < 0 else "" if band is None else f"±{fixed(100 * band, 2)} %"
    return marked(Cell(number(item["load_N"] / 1e3, 4), mark), item)


def critical(result: Json) -> Table:
    """Critical loads of the parallelogram, one line for each angle and held set."""
    items = result["critical"]
    models = [m for m in MODELS if any(model_label(item) == m for item in items)]
    models += list(dict.fromkeys(label for item in items if (label := model_label(item)) not in models))
    rows = []
    for (q, held), by_model in groups(items).items():
        lines = zip_longest(*(by_model.get(model, []) for model in models))
        for first, line in enumerate(lines):
            row = [Cell("" if first else fixed(q, 0)), Cell("" if first else held_label(held))]
            for model, item in zip(models, line, strict=True):
                row.append(load_cell(item))
                if model != "solid FE":
                    row.append(Cell(number(None if item is None else item.get("ratio_to_solid"), 3)))
            rows.append(row)
    columns = [Column("q", "°"), Column("held", numeric=False)]
    for model in models:
        columns.append(Column(model.replace(", spring at", ""), "kN"))
        if model != "solid FE":
            columns.append(Column("ratio"))
    return table(
        "By angle and by what is held",
        columns,
        rows,
        "Compression positive, tension negative; both bars together, platform driven along x.",
        "Ratio: to solid FE. ±: mesh error, that of one bar's load in the same supports and plane. VJM and formulas "
        "have the K_b of the same mesh, so a ratio holds less of it than the load.",
        "VJM tip, middle, base: where the bar's lumped spring sits; VJM distributed: with geometric stiffness.",
        *note(result),
    )


def closed_forms(result: Json) -> Table | None:
    """Numerical critical loads against their own closed forms."""
    rows = [
        [
            f"{item['q_deg']:g}",
            held_label(item["held"]),
            model_label(item),
            number(item["load_N"]),
            number(item["closed_form_N"]),
            number(item["load_N"] / item["closed_form_N"] - 1.0, 2),
        ]
        for item in result["critical"]
        if item.get("closed_form_N") and item["load_N"]
    ]
    columns = [
        Column("q", "°"),
        Column("held", numeric=False),
        Column("model", numeric=False),
        Column("found", "N"),
        Column("closed form", "N"),
        Column("relative difference"),
    ]
    return table("Critical loads against their closed forms", columns, rows) if rows else None


def reasons(result: Json) -> list[str]:
    """Why each model gives its critical load: every distinct explanation once, with what it explains."""
    found: dict[tuple[str, str, str], list[float]] = {}
    for item in result["critical"]:
        found.setdefault((model_label(item), item["what"], item["why"]), []).append(item["q_deg"])
    sentences = []
    for (model, what, why), angles in found.items():
        at = ", ".join(f"{q:g}°" for q in dict.fromkeys(angles))
        sentences.append(f"{model}, {what} (q = {at}): {why}")
    return sentences


MODEL_NAMES = {"frame": "Frame"}


def validity(result: Json) -> Table:
    """Load up to which LIN is good enough, one column for each deviation."""
    items = result["validity"]
    deviations = sorted({item["deviation"] for item in items})
    found: dict[tuple[str, float, str], dict[float, Cell]] = {}
    for item in items:
        key = (model_label(item), item["q_deg"], held_label(item["held"]))
        found.setdefault(key, {})[item["deviation"]] = marked(Cell(kilo(item["load_N"])), item)
    rows: list[list[str | Cell]] = [
        [model, fixed(q, 0), held, *(loads.get(deviation, Cell(DASH)) for deviation in deviations)]
        for (model, q, held), loads in found.items()
    ]
    columns = [Column("LIN against", numeric=False), Column("q", "°"), Column("held", numeric=False)]
    columns += [Column(f"within {100 * deviation:g} %, up to", "kN") for deviation in deviations]
    notes = ["Compression positive."]
    bands = [c["band"] for c in result["curves"] if c["model"] == "fea" and c.get("band") is not None]
    if bands:
        notes.append(
            f"Solid FE: loads of the path's mesh, whose critical loads are known to {fixed(100 * min(bands), 1)} to "
            f"{fixed(100 * max(bands), 1)} %."
        )
    if any(item["load_N"] is None for item in items):
        notes.append(f"{DASH}: the curve ends before it deviates so much.")
    notes += note(result)
    return table("Load up to which the linear model holds", columns, rows, *notes)


def refinement(result: Json) -> Table:
    """One number of each load path, coarse to fine."""
    rows = []
    for item in result["refinement"]:
        sizes, values = item["sizes"], [number(v, 6) for v in item["values"]]
        rows.append(
            [
                MODEL_NAMES.get(item["model"], item["model"]),
                f"{item['quantity']}, q = {item['q_deg']:g}°, held {held_label(item['held'])}",
                f"{item['refined']}: {', '.join(count(n) for n in sizes)}",
                *[""] * (4 - len(values)),
                *values,
                number(item["limit"], 6),
                f"{count(item['used'])}",
                number(100 * item["band"], 2),
            ]
        )
    columns = [
        Column("model", numeric=False),
        Column("quantity", numeric=False),
        Column("refined", numeric=False),
        *(Column(title, "N") for title in ("coarsest", "", "", "finest", "limit")),
        Column("the run's"),
        Column("band", "%"),
    ]
    return table(
        "Load paths refined",
        columns,
        rows,
        "Limit: extrapolated; of steps, the finest. Band: error of the value that the run uses; of steps, what all "
        "differ by: equilibria of an elastic linkage do not depend on the steps that lead to them.",
    )


def kilo(load: float | None) -> str:
    """A load in kN."""
    return number(None if load is None else load / 1e3, 4)
