"""The validation dossier: comparison error against its uncertainties, what limits each parameter, which data."""

from __future__ import annotations

from collections.abc import Iterator

from reports.blocks import Block, Cell, Column, Details, Table, Text, table
from reports.formats import DASH, number, percent
from reports.load import Json
from reports.tables_record import pairs

FAR = 2.0
"""Coverage factor of about 95 %: beyond it the comparison error is larger than its uncertainty."""

NOTE = (
    "ASME V&V 20-2009: E = S \u2212 D, predicted less measured; u_val\u00b2 = u_num\u00b2 + u_input\u00b2 + u_D\u00b2. "
    "Standard uncertainties of one reading, root mean squares, in the unit of the column. u_num: of the computation of "
    "K_b by mesh and by tie of its ends, as far as the fit leaves it; u_input: of parameters and of all else that is "
    "written about the rig; u_D: of the readings and of what was prescribed."
)
READ = (
    "rms E / u_val: about 1 where the error is what its uncertainty says; a smaller error of the model does not "
    "show. Area metric: between the law of the readings in their predicted laws and the uniform one, 0 to 0.5; "
    "of n independent readings chance alone makes 0.31/\u221an on average, more than 0.58/\u221an in one case of 20."
)


def blocks(it: Json) -> Iterator[Block]:
    """How well the model predicts, then why it is not known better, then what it was made from."""
    yield Text(" ".join(said(it)))
    yield comparison(it)
    if it["budget"]:
        yield budget(it)
    yield Details("Files it was made from", [pairs("Data", "file", "sha256", it["data"])])


def said(it: Json) -> Iterator[str]:
    """What was compared, and where the bar is from."""
    if it["held_out"]:
        yield "Predicted and measured readings of the tests that were held out of the fit."
    else:
        yield (
            "No test was held out: predicted and measured readings of the fitted tests themselves, which a fit brings "
            'near each other. Declare role = "holdout" for a test to have an independent comparison.'
        )
    if it["readings"]:
        share = 100.0 * it["inside"] / it["readings"]
        yield f"95 % intervals hold {share:.1f} % of {it['readings']} readings."
    if it["noise_factor"] > 1.0:
        yield f"Noise and parameters are widened by {number(it['noise_factor'], 3)}, as more than noise is left."
    if it["computed"]:
        yield f"{it['computed']}."
    else:
        yield "K_b is written and not computed: u_num is that of the equilibria, which are solved to rounding."


def comparison(it: Json) -> Table:
    """Each column with E and its uncertainties."""
    columns = [
        Column("column", numeric=False),
        Column("readings"),
        Column("E, mean"),
        Column("E, rms"),
        Column("u_num"),
        Column("u_input"),
        Column("u_D"),
        Column("u_val"),
        Column("rms E / u_val"),
        Column("area metric"),
    ]
    rows = []
    for each in it["comparison"]:
        ratio = each["error_rms"] / each["u_val"] if each["u_val"] else None
        shown = [each[key] for key in ("error", "error_rms", "u_num", "u_input", "u_data", "u_val")]
        rows.append(
            [
                each["column"],
                str(each["readings"]),
                *(number(value, 3) for value in shown),
                Cell(number(ratio, 3), "beyond its uncertainty")
                if ratio and ratio > FAR
                else number(ratio, 3),
                DASH if each["area"] is None else number(each["area"], 2),
            ]
        )
    return table("Comparison error and validation uncertainty", columns, rows, NOTE, READ)


def budget(it: Json) -> Table:
    """Which sensor or tolerance limits which parameter."""
    rows = []
    for each in it["budget"]:
        head = [each["parameter"], number(each["std"], 3), each["unit"] or DASH]
        for source in each["sources"]:
            kind = "noise of the sensor" if source["kind"] == "sensor" else "tolerance"
            rows.append([*head, source["name"], kind, percent(source["share"], 1).removeprefix("+")])
            head = ["", "", ""]
    columns = [
        Column("parameter", numeric=False),
        Column("standard error"),
        Column("unit", numeric=False),
        Column("limited by", numeric=False),
        Column("which is", numeric=False),
        Column("share of variance", "%"),
    ]
    return table("Uncertainty budget: what limits each parameter", columns, rows, "Sources of 1 % and more.")
