"""What every candidate does to the readings of some tests, whitened and free of what the model can move."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag

from pipeline.callbacks import OnProgress
from pipeline.campaign import Campaign
from pipeline.inference.fit import Fit
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.orthonormal_basis import basis
from pipeline.inference.prediction import predict
from pipeline.inference.residual import residual
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.signatures import look, probes, signatures
from vjm.effects.base import Effect

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Seen:
    """columns: by effect one (N, p), of typical sizes; of one with kinks one (N, 1) for each size in `probes`.

    base: (N, P) of the model's own numbers. zeros: (N, Z) of unknown zeros, each of its own test. tests: (N,) numbers.
    share: of the readings, that are looked at.
    """

    columns: Mapping[str, tuple[Array, ...]]
    probes: Mapping[str, tuple[float, ...]]
    base: Array
    zeros: Array
    tests: NDArray[np.int_]
    share: float

    def of(self, tests: Array) -> Seen:
        """Of some tests alone."""
        kept = np.isin(self.tests, tests)
        some = {name: tuple(c[kept] for c in every) for name, every in self.columns.items()}
        parts: dict[str, Any] = {
            "base": self.base[kept],
            "zeros": self.zeros[kept],
            "tests": self.tests[kept],
        }
        return replace(self, columns=some, **parts)

    def and_(self, other: Seen) -> Seen:
        """With the tests of another look at the same candidates."""
        weight = np.sqrt(self.share / other.share)
        both = {
            name: tuple(np.vstack([a, b * weight]) for a, b in zip(every, other.columns[name], strict=True))
            for name, every in self.columns.items()
            if name in other.columns and len(other.columns[name]) == len(every)
        }
        base = np.vstack([self.base, other.base * weight])
        zeros = block_diag(self.zeros, other.zeros * weight)
        tests = np.concatenate([self.tests, other.tests])
        return replace(self, columns=both, base=base, zeros=zeros, tests=tests)

    def free(self) -> Mapping[str, tuple[Array, ...]]:
        """The columns of all readings, without what the base can explain."""
        scale = 1.0 / np.sqrt(self.share)
        taken = basis(np.hstack([self.base, self.zeros]))
        return {
            name: tuple(scale * (c - taken @ (taken.T @ c)) for c in every)
            for name, every in self.columns.items()
        }


def seen(campaign: Campaign, model: Model, candidates: Mapping[str, Effect], on_progress: OnProgress) -> Seen:
    """By derivatives and probes about the model's prediction."""
    cases = load_cases(campaign)
    # A saved number may stand at its bound, where an effect is absent and has no derivative.
    if model.free:
        model = model.at(np.clip(model.values, *np.array([each.bounds for each in model.free]).T))
    there = predict(model, cases)
    left = residual(cases, there)
    found = Fit(model, there, replace(left, values=np.zeros_like(left.values)), 1)
    at = look(cases, CRITERIA.screened_steps)
    every = [effect for name, effect in candidates.items() if name not in model.names]
    kinked = probes(model, list(candidates.values()), cases, CRITERIA.plain_probe, on_progress)
    signs = signatures(found, every, kinked, at, on_progress)
    used = cases.predicted & cases.fitted[:, None]
    mask = used[at.rows]
    tests = np.broadcast_to(cases.test[at.rows][:, None], mask.shape)[mask]
    return Seen(
        {s.effect.name: s.columns for s in signs},
        {s.effect.name: s.probes for s in signs if s.probes},
        left.slopes[at.rows][mask],
        left.offsets[at.rows][mask],
        tests,
        float(mask.sum() / max(used.sum(), 1)) or 1.0,
    )
