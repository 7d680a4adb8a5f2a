"""Where a campaign shows an effect: if at one angle alone, the others do not say whether it is there too."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.fit import Fit
from pipeline.inference.rounding import EQUAL, TINY
from pipeline.selection.criteria import Criteria

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Place:
    """The one angle, degrees, and the names of the tests there that show the effect, the plainest first."""

    q_deg: float
    tests: tuple[str, ...]


def only_place(found: Fit, name: str, criteria: Criteria) -> Place | None:
    """Of an effect of the fitted model; None where several angles show it, or it shows at none, or there is one angle.

    What the effect does to the readings, to first order in its numbers, free of what the other numbers and unknown
    zeros take up in the fitted tests; held-out tests confirm an effect as well.
    """
    whole = found.residual.load_cases
    angles = np.array([round(float(np.degrees(test.q)), 6) for test in whole.campaign.tests])
    shown = _by_test(found, name)
    sizes = {float(q): float(np.linalg.norm(shown[angles == q])) for q in np.unique(angles)}
    if len(sizes) < 2:
        return None
    q, *others = sorted(sizes, key=lambda each: -sizes[each])
    if (
        sizes[q] < criteria.shown
        or float(np.linalg.norm([sizes[other] for other in others])) > criteria.not_shown
    ):
        return None
    mine = [k for k in np.argsort(-shown) if angles[k] == q and shown[k] > criteria.not_shown]
    return Place(q, tuple(whole.campaign.tests[k].id for k in mine))


def _by_test(found: Fit, name: str) -> Array:
    """(tests,) sigmas by which each test shows it."""
    whole, it = found.residual.load_cases, found.residual
    mine = np.array([each.effect == name for each in found.model.free], dtype=bool)
    null = np.array([each.parameter.null for each in found.model.free])
    used = whole.predicted
    alone = it.slopes[used][:, mine] @ (found.model.values - null)[mine]
    nominal = it.nominal[used]
    others = np.hstack([it.slopes[used][:, ~mine], it.offsets[used], nominal])
    fitted = np.broadcast_to(whole.fitted[:, None], used.shape)[used]
    sizes = np.maximum(np.linalg.norm(others, axis=0), TINY)
    # What was written is known to one standard deviation: a reading more of each.
    known = np.eye(others.shape[1])[others.shape[1] - nominal.shape[1] :]
    right = np.concatenate([alone[fitted], np.zeros(len(known))])
    taken = np.linalg.lstsq(np.vstack([others[fitted], known]) / sizes, right, rcond=EQUAL)[0]
    left = alone - (others / sizes) @ taken
    tests = np.broadcast_to(whole.test[:, None], used.shape)[used]
    squares = np.bincount(tests, left**2, minlength=len(whole.campaign.tests))
    return np.asarray(np.sqrt(squares))
