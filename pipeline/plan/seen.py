"""What every candidate does to the readings of some tests, whitened and free of what the model can move."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign import Campaign
from pipeline.diagnose.signatures import Say, look, probes, signatures
from pipeline.inference.fit import Fit
from pipeline.inference.model import Model
from pipeline.inference.prediction import predict
from pipeline.inference.program import program
from pipeline.inference.residual import residual
from vjm.effects.base import Effect

Array = NDArray[np.float64]
RANK = 1e-8


@dataclass(frozen=True, eq=False)
class Seen:
    """columns: by effect one (N, p), of typical sizes; of one with kinks one (N, 1) for each size in `probes`.

    base: (N, P) of the model's own numbers. tests: (N,) numbers. share: of the readings, that are looked at.
    """

    columns: Mapping[str, tuple[Array, ...]]
    probes: Mapping[str, tuple[float, ...]]
    base: Array
    tests: NDArray[np.int_]
    share: float

    def of(self, tests: Array) -> Seen:
        """Of some tests alone."""
        kept = np.isin(self.tests, tests)
        some = {name: tuple(c[kept] for c in every) for name, every in self.columns.items()}
        return replace(self, columns=some, base=self.base[kept], tests=self.tests[kept])

    def and_(self, other: Seen) -> Seen:
        """With the tests of another look at the same candidates."""
        weight = np.sqrt(self.share / other.share)
        both = {
            name: tuple(np.vstack([a, b * weight]) for a, b in zip(every, other.columns[name], strict=True))
            for name, every in self.columns.items()
            if name in other.columns and len(other.columns[name]) == len(every)
        }
        base = np.vstack([self.base, other.base * weight])
        return replace(self, columns=both, base=base, tests=np.concatenate([self.tests, other.tests]))

    def free(self) -> Mapping[str, tuple[Array, ...]]:
        """The columns of all readings, without what the base can explain."""
        scale = 1.0 / np.sqrt(self.share)
        basis = np.zeros((self.base.shape[0], 0))
        if self.base.shape[1]:
            sizes = np.maximum(np.linalg.norm(self.base, axis=0), 1e-300)
            left, values, _ = np.linalg.svd(self.base / sizes, full_matrices=False)
            basis = left[:, values > RANK]
        return {
            name: tuple(scale * (c - basis @ (basis.T @ c)) for c in every)
            for name, every in self.columns.items()
        }


def seen(campaign: Campaign, model: Model, candidates: Mapping[str, Effect], say: Say) -> Seen:
    """By derivatives and probes about the model's prediction."""
    cases = program(campaign)
    there = predict(model, cases)
    left = residual(cases, there)
    found = Fit(model, there, replace(left, values=np.zeros_like(left.values)), 1)
    at = look(cases)
    every = [effect for name, effect in candidates.items() if name not in model.names]
    kinked = probes(model, list(candidates.values()), cases, say)
    signs = signatures(found, every, kinked, at, say)
    used = cases.predicted & cases.fitted[:, None]
    mask = used[at.rows]
    base = np.hstack([left.slopes[at.rows][mask], left.offsets[at.rows][mask]])
    tests = np.broadcast_to(cases.test[at.rows][:, None], mask.shape)[mask]
    return Seen(
        {s.effect.name: s.columns for s in signs},
        {s.effect.name: s.probes for s in signs if s.probes},
        base,
        tests,
        float(mask.sum() / used.sum()),
    )
