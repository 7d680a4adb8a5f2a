"""How large and how confusable a hidden effect is, after what was written about the rig and the sensors is known to its
tolerances only."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from fem.frame.bench import Readings
from pipeline.assessment.challenge.cases import ALWAYS
from pipeline.assessment.challenge.dirty.cases import DirtyCase
from pipeline.assessment.challenge.dirty.dirt import true_rig
from pipeline.assessment.challenge.outcome import difference, each_alone
from pipeline.assessment.virtual.bench import read_out
from pipeline.assessment.virtual.plan import GAUGES
from pipeline.campaign import Campaign
from pipeline.campaign.order import by_name
from pipeline.inference.eliminated import Marginal
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.nuisances import lined, nominals
from pipeline.inference.prediction import predict
from pipeline.inference.residual import whitening
from pipeline.selection.confusability import multiple_correlation
from pipeline.selection.fit_cache import FitCache
from vjm.effects import catalogue

Array = NDArray[np.float64]


def sizes_after_tolerances(
    it: DirtyCase, found: list[Readings], without: list[Readings], cache: FitCache
) -> tuple[dict[str, float], dict[str, float]]:
    """mu and gamma of each hidden effect after what was written about the rig is known to its tolerances."""
    whole, model = cache.whole.campaign, Model().with_effects([catalogue()[ALWAYS]])
    clean = load_cases(_exact(whole, it, without))
    reference = predict(model, clean, slopes=False)
    white = whitening(clean, reference)
    used = clean.predicted & clean.fitted[:, None]
    line = lined(model, clean, None).by_nominal if nominals(whole) else None
    given = (
        np.zeros((int(used.sum()), 0))
        if line is None
        else white.apply(np.where(used[..., None], line, 0.0))[used]
    )
    alone = each_alone(it, found, true_rig(it.bench.rig, it.dirt.bar))
    signatures = {
        name: after(given, difference(clean, load_cases(_exact(whole, it, only)), reference, white))
        for name, only in alone.items()
    }
    sizes = {name: float(np.linalg.norm(mine)) for name, mine in signatures.items()}
    gamma = {name: _confusable(cache, name, it.effects, signatures[name], given, used) for name in it.effects}
    # Beside a mistake of the table, or of what does nothing, it is not known.
    return sizes, {name: value for name, value in gamma.items() if np.isfinite(value)}


def _exact(whole: Campaign, it: DirtyCase, found: list[Readings]) -> Campaign:
    """The campaign with readings as they would be without any noise, its sigmas and tolerances as they were told."""
    exact = read_out(whole.name, it.bench.rig, it.bench.plan, whole.noise, None, found, GAUGES)
    return by_name(replace(exact, tolerance=whole.tolerance))


def after(given: Array, values: Array) -> Array:
    """(N, ...) of what the tolerances do not explain."""
    return Marginal.of(given).weakened(values) if given.shape[1] else values


def _confusable(
    cache: FitCache, name: str, hidden: Sequence[str], mine: Array, given: Array, used: NDArray[np.bool_]
) -> float:
    """1 / sqrt(1 - rho) of the candidate that looks most like it."""
    root = frozenset({ALWAYS}) if ALWAYS in cache.candidates else frozenset[str]()
    about, at = cache.first_order(root), cache.at
    place = np.full(used.shape, -1)
    place[used] = np.arange(used.sum())
    rows = place[at.rows]
    rows = rows[rows >= 0]
    columns = [
        c for s in about.signatures.values() if s.effect.name not in (name, *hidden) for c in s.columns
    ]
    if not np.any(mine) or any(len(c) != len(rows) for c in columns):
        return float("nan")
    alike = [multiple_correlation(mine[rows], after(given[rows], c)) for c in columns]
    return float(1.0 / np.sqrt(max(1.0 - max(alike, default=0.0), 1e-6)))
