"""How well the coordinate of a place is known: what the noise of the readings leaves of it.

A coordinate is predicted at the inputs that fit best, which are known as well as all readings of their load step tell:
of inputs x with covariance S before them, readings with derivative J and covariance C leave
S - S J^T (C + J S J^T)^-1 J S. Where a place is moved by no more than that, a function of its coordinate is a function
of noise, and readings tell nothing of a law there; a law that is soft enough may take up noise then, as in every fit
with noise on both sides without a signal (W. A. Fuller, Measurement Error Models, Wiley 1987, section 1.1).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.fit import Fit
from pipeline.inference.residual import whitening
from vjm.equilibrium import Equilibrium
from vjm.sensitivity import by_targets

Array = NDArray[np.float64]
TARGETS = 6
STEP = 1e-3
"""Standard deviations that inputs are moved by, for differences."""


def input_roots(found: Fit) -> Array:
    """(R, 7, 7) roots L of the covariances L L^T of the true inputs, given all readings of their load steps."""
    cases, there = found.residual.load_cases, found.prediction
    sigma = cases.input_sigma
    kept = np.where(there.lost[:, None, None], 0.0, there.by_inputs)
    told = whitening(cases, there).apply(kept * sigma[:, None, :])
    left = np.eye(sigma.shape[-1]) - np.swapaxes(told, -1, -2) @ told
    values, vectors = np.linalg.eigh(left)
    roots = vectors * np.sqrt(np.clip(values, 0.0, None))[:, None, :]
    return np.asarray(sigma[..., None] * roots)


def unsure(state: Equilibrium, roots: Array, at: Callable[[Equilibrium], Array]) -> Array:
    """Standard deviations (T, S, K) of coordinates that `at` gives of a state, by noise of the six targets alone.

    roots: (T, S, 7, 7) of its inputs, see `input_roots`.
    """
    here, slopes = at(state), by_targets(state).unknowns
    total = np.zeros(here.shape)
    for k in range(roots.shape[-1]):
        step = np.einsum("tsnj,tsj->tsn", slopes, roots[..., :TARGETS, k])
        moved = replace(state, unknowns=state.unknowns + STEP * step)
        total += ((at(moved) - here) / STEP) ** 2
    return np.asarray(np.sqrt(total))
