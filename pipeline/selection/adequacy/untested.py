"""Whether anything is left to test a model by: readings less unknown zeros less fitted numbers."""

from __future__ import annotations

import numpy as np

from pipeline.campaign.names import DISPLACEMENTS, WRENCHES, gauge_column
from pipeline.inference.driving import column_name, unit_of
from pipeline.inference.estimated_sigmas import to_write
from pipeline.inference.fit import Fit
from reports.quantities import proportion

HEAD = "nothing_tested"
NOT_YET = "not measured yet"


def untested(found: Fit, fitted: int = 0) -> str | None:
    """Why no verdict on a model is possible, a sentence that begins with the verdict; None where one is.

    fitted: numbers that were fitted to these readings before, beside those that are free now.
    """
    readings, zeros, numbers = found.whitened.size, found.zeros, len(found.model.free) + fitted
    if found.degrees > fitted:
        return None
    spent = [
        f"{count} {what}" + ("" if count == 1 else "s")
        for count, what in ((zeros, "unknown zero"), (numbers, "fitted number"))
        if count
    ]
    if readings:
        taken = f"{_counted(readings)}, {' and '.join(spent)}: none is left to test a model by"
    else:
        taken = "no fitted test has a reading with a known sigma that a model predicts"
        if not found.residual.load_cases.unweighted.any():
            taken = f"{NOT_YET}: {taken}"
    return f"{HEAD}: {taken}."


def _counted(readings: int) -> str:
    return "1 reading" if readings == 1 else f"{readings} readings"


def in_units(found: Fit) -> tuple[str, ...]:
    """Of every channel whose sigma is not known, how far it is from the model, and the line that gives a sigma."""
    whole = found.residual.load_cases
    rows = whole.fitted & ~found.prediction.lost
    columns = [*DISPLACEMENTS, *WRENCHES, *(gauge_column(g.name) for g in whole.campaign.gauges)]
    out = []
    for channel in np.flatnonzero(whole.unweighted[rows].any(axis=0)):
        own = rows & whole.unweighted[:, channel]
        measured, predicted = whole.measured[own, channel], found.prediction.values[own, channel]
        off, most = float(np.mean(measured - predicted)), float(np.max(np.abs(measured - predicted)))
        unit = unit_of(int(channel)).replace("Nmm", "N·mm")
        mean = f" on average, at most {most:.3g} {unit}" if own.sum() > 1 else ""
        out.append(
            f"{column_name(int(channel), whole.campaign.gauges)} is {off:+.3g} {unit} off{mean}"
            f"{_share(measured, predicted)}; it has no sigma, so nothing can be said in sigmas: "
            f"{to_write(columns[channel])}."
        )
    return tuple(out)


def _share(measured: np.ndarray, predicted: np.ndarray) -> str:
    """By how much in proportion, where the model says anything but nothing."""
    square = float(predicted @ predicted)
    if square == 0.0 or not np.isfinite(square):
        return ""
    return f" ({proportion(float(measured @ predicted) / square - 1.0)})"
