"""A model and an additive correction of each channel, learned from what the model leaves of a campaign.

M. C. Kennedy, A. O'Hagan, J. R. Statist. Soc. B 63 (2001), 425-464: reality = model + discrepancy(inputs).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pipeline.discrepancy.regressors import Samples, regressors, samples
from pipeline.inference.load_cases import LoadCases
from pipeline.inference.predicted import Prediction
from pipeline.inference.residual import whitening

Array = NDArray[np.float64]
Learned = Callable[[Array], Array]
"""(n,) of inputs (n, m), scaled as those of the samples."""
Learner = Callable[[Samples], Learned]


def corrected(
    learner: Learner, cases: LoadCases, base: Prediction, asked: LoadCases, there: Prediction
) -> Prediction:
    """The base model's prediction `there` of what is asked, with what was learned from its residual on the campaign."""
    table, _ = regressors(asked)
    learned = np.zeros_like(there.values)
    for channel, (own, scale) in samples(cases, base).items():
        rows = asked.predicted[:, channel]
        if rows.any():
            learned[rows, channel] = learner(own)(scale(table[rows]))
    # Back from sigmas to units by the base model's own tangent, as on the way there.
    units = np.linalg.solve(whitening(asked, there).factors, learned[..., None])[..., 0]
    return replace(there, values=there.values + units)
