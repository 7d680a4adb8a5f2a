"""A frozen Campaign to a folder of two files, from which the same campaign is read again."""

import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import tomlkit

from meshes.files import replacing
from pipeline.campaign.model import Campaign, Gauge, Rig
from pipeline.campaign.names import (
    COORDINATES,
    DISPLACEMENTS,
    TEMPERATURE,
    WRENCHES,
    channel_columns,
    gauge_column,
)
from pipeline.campaign.order import run_order
from pipeline.campaign.reading import DESCRIPTION, MEASUREMENTS, read
from pipeline.campaign.tolerance import table as tolerance_table
from pipeline.errors import InputError, unread
from pipeline.toml.complaints import BadCampaign

BARS = ("bar", "bar_stiffness", "bar_from")
"""Ways to give the bars of a rig: a test with its own takes the place of that of the campaign."""


def write(folder: Path, campaign: Campaign, overwrite: bool = False) -> None:
    """Write both files, each whole or not at all; `read` then gives the same numbers to the last bit.

    Files that the rig names are copied beside them. InputError if the folder has a campaign already and `overwrite` is
    not set, has another file of such a name, or cannot be written.
    ValueError if the campaign is one that `read` would refuse; nothing is written then.
    """
    there = [name for name in (DESCRIPTION, MEASUREMENTS) if (folder / name).exists()]
    if there and not overwrite:
        raise InputError(f"{folder / there[0]} exists, allowed is a folder without a campaign")
    beside = _named_files(campaign)
    for name, content in beside.items():
        if (folder / name).exists() and (folder / name).read_bytes() != content:
            raise InputError(
                f"{folder / name} is there already and is another file, allowed is a folder without it"
            )
    texts = {DESCRIPTION: description_text(campaign), MEASUREMENTS: measurements_text(campaign)}
    with tempfile.TemporaryDirectory() as trial:
        for name, text in texts.items():
            (Path(trial) / name).write_text(text, encoding="utf-8", newline="")
        for name, content in beside.items():
            (Path(trial) / name).write_bytes(content)
        try:
            read(Path(trial))
        except BadCampaign as error:
            raise ValueError(f"the campaign could not be read again: {error.complaints[0]}") from error
    try:
        for name, content in beside.items():
            with replacing(folder / name) as part:
                part.write_bytes(content)
        # The measurements first: a folder with a description is complete.
        for name in (MEASUREMENTS, DESCRIPTION):
            with replacing(folder / name) as part:
                part.write_text(texts[name], encoding="utf-8", newline="")
    except OSError as error:
        raise InputError(f"{folder} cannot be written: {error.strerror}") from error


def _named_files(campaign: Campaign) -> dict[str, bytes]:
    """What the rigs of a campaign and of its tests name, by the name that it gets beside campaign.toml."""
    found: dict[str, bytes] = {}
    for path in campaign.files:
        try:
            content = path.read_bytes()
        except OSError as error:
            raise InputError(f"{path}: {unread(error)}") from error
        if found.setdefault(path.name, content) != content:
            raise InputError(
                f"{path} and another file of its name are bars of one campaign, allowed is a name for each"
            )
    return found


def description_text(campaign: Campaign) -> str:
    """campaign.toml."""
    checked = {"table_checked": True} if campaign.table_checked else {}
    document: dict[str, Any] = {"schema": 1, "name": campaign.name, **checked, "rig": rig_table(campaign.rig)}
    document["noise"] = noise_table(campaign)
    known = tolerance_table(campaign.tolerance, campaign.rig.written)
    document["tolerance"] = {
        key: inline(value) if isinstance(value, dict) else value for key, value in known.items()
    }
    if campaign.gauges:
        document["gauges"] = [gauge_table(gauge) for gauge in campaign.gauges]
    base = rig_table(campaign.rig)
    document["tests"] = []
    for test in campaign.tests:
        implied = test.rig.supports
        control = {key: by for key, by in zip(COORDINATES, test.control, strict=True) if key not in implied}
        place = {"q_deg": test.q_deg} if test.rig.point is None else {"at_mm": list(test.rig.point)}
        entry = {"id": test.id, **place, "role": test.role, "control": inline(control)}
        if test.zero != "nominal":
            entry["zero"] = test.zero
        # What is set aside is written as it counts: its cells are empty.
        if test.keep:
            names = dict.fromkeys(column for _, column in test.keep)
            entry["keep"] = inline({it: sorted(step for step, c in test.keep if c == it) for it in names})
        if own := _differences(test.id, base, rig_table(test.rig)):
            entry["rig"] = inline(own)
        document["tests"].append(entry)
    return tomlkit.dumps(document)


def measurements_text(campaign: Campaign) -> str:
    """measurements.csv, tests in the order in which they were done: columns that no test measured are left out."""
    gauges = [gauge_column(gauge.name) for gauge in campaign.gauges]
    names = [*DISPLACEMENTS, *WRENCHES, *gauges, TEMPERATURE]
    tables = []
    for test in (campaign.tests[k] for k in run_order(campaign.tests)):
        data = test.data
        heat = np.full(data.steps.size, np.nan) if data.temperature is None else data.temperature
        table = pd.DataFrame(
            np.column_stack([data.displacement, data.wrench, data.gauges, heat]), columns=names
        )
        table.insert(0, "step", data.steps)
        table.insert(0, "test", test.id)
        tables.append(table)
    whole = pd.concat(tables, ignore_index=True)
    measured = [name for name in names if whole[name].notna().any()]
    return str(whole[["test", "step", *measured]].to_csv(index=False, lineterminator="\n"))


def gauge_table(gauge: Gauge) -> dict[str, Any]:
    """A gauge in the keys of the file."""
    place: dict[str, Any] = {"bar": gauge.bar, "station": gauge.station}
    if gauge.offset is not None:
        place = {"on": "platform", "offset_mm": list(gauge.offset)}
    return {"name": gauge.name, **place, "direction": gauge.direction}


def rig_table(rig: Rig) -> dict[str, Any]:
    """A rig in the keys and units of the file; what has its default is left out."""
    table = {"kind": rig.kind, **rig.keys(), **rig.named}
    return {
        key: inline(value) if isinstance(value, dict) else value
        for key, value in table.items()
        if value is not None
    }


def noise_table(campaign: Campaign) -> dict[str, Any]:
    """The noise that is known, by column: a sigma, or a table where it is more than that."""
    noise = campaign.noise
    more = dict(
        zip(channel_columns(campaign.gauges), zip(noise.shares, noise.gains, strict=True), strict=True)
    )
    names = [*DISPLACEMENTS, *WRENCHES, *(gauge_column(g.name) for g in campaign.gauges), TEMPERATURE]
    sigmas = [*noise.displacement, *noise.wrench, *noise.gauges, noise.temperature]
    known = {name: float(sigma) for name, sigma in zip(names, sigmas, strict=True) if np.isfinite(sigma)}
    return {name: _scatter(sigma, *more.get(name, (0.0, 0.0))) for name, sigma in known.items()}


def _scatter(sigma: float, of_reading: float, gain: float) -> Any:
    values = {"sigma": sigma, "of_reading": float(of_reading), "gain": float(gain)}
    return inline({key: value for key, value in values.items() if value}) if of_reading or gain else sigma


def inline(values: dict[str, Any]) -> Any:
    """A table in one line."""
    table = tomlkit.inline_table()
    table.update(values)
    return table


def _differences(test: str, base: dict[str, Any], own: dict[str, Any]) -> dict[str, Any]:
    """What a test's rig has of its own."""
    different = {key: value for key, value in own.items() if base.get(key) != value}
    if "length_mm" in different and "bar_stiffness" in own:
        different["bar_stiffness"] = own["bar_stiffness"]
    lost = [key for key in base if key not in own and key not in BARS]
    for key in lost:
        if key not in ("line_weight_N_per_mm", "platform_weight_N"):
            raise ValueError(
                f"test {test!r} has no {key}, but the rig of its campaign has: no file can say that"
            )
        different[key] = 0.0
    return different
