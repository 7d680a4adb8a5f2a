"""How well the coordinate of a place is known: what the noise of the readings leaves of it.

A coordinate is predicted at the inputs that fit best, which are known as well as all readings of their load step tell:
of inputs x with covariance S before them, readings with derivative J and covariance C leave
S - S J^T (C + J S J^T)^-1 J S. Where a place is moved by no more than that, a function of its coordinate is a function
of noise, and readings tell nothing of a law there; a law that is soft enough may take up noise then, as in every fit
with noise on both sides without a signal (W. A. Fuller, Measurement Error Models, Wiley 1987, section 1.1).

Inputs have to be found as far as they are known. A residual is linear about its inputs, and a fit settles these to a
tenth of their sigmas; what a stiff place bears changes with that by many sigmas of a reading, in proportion to the
noise of the input: a function of that load would explain noise.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.fit import Fit
from pipeline.inference.objective import Objective
from pipeline.inference.prediction import predict
from pipeline.inference.residual import residual, whitening
from pipeline.inference.settings import INPUTS
from vjm.equilibrium import Equilibrium
from vjm.sensitivity import by_targets
from vjm.work import over

Array = NDArray[np.float64]
TARGETS = 6
STEP = 1e-3
"""Standard deviations that inputs are moved by, for differences."""


def at_known_inputs(found: Fit) -> Fit:
    """A fit predicted at its inputs, as far as all readings of each load step tell them: to a tenth of what
    these leave unknown, or as near as a fit's own steps of the inputs come."""
    cases, model = found.residual.load_cases, found.model
    objective = Objective(model, cases)
    for _ in range(INPUTS.rounds):
        known = np.linalg.norm(input_roots(found), axis=-1)
        off = np.abs(found.residual.shift - found.prediction.shift)
        if np.all((off <= INPUTS.near * known)[~found.prediction.lost]) or over():
            break
        here = predict(model, cases, start=found.prediction, shift=found.residual.shift)
        if np.any(here.lost & ~found.prediction.lost):
            break
        here = objective.about(here)
        found = replace(found, prediction=here, residual=residual(cases, here))
    return found


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
