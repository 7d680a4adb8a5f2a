"""What an effect has to show before it is believed, and before it is told apart from another.

Sigmas are known, so chi-square is the yardstick everywhere.
"""

from __future__ import annotations

from functools import cache

from scipy.stats import chi2

from vjm.effects.base import Effect

FALSE_ALARM = 0.005
"""Chance that noise alone gets any of the candidates named."""
APART = 5.0
"""Chi-square by which a rival of as many numbers has to be worse to be excluded. Of two
effects of signature correlation rho and size mu the wrong one is then named with probability
Phi(-(mu² (1 - rho²) + 5) / (2 mu sqrt(1 - rho²))): at most 1.3 %, where the data are least decisive."""
TAKEN_UP = 0.001
"""Chance that the numbers that an explanation has more than its rival fit so much noise that the rival is excluded."""
RAW = 2.0
"""Chi-square by which it has to be worse in any case: a rival of many numbers that fits as well is none to exclude."""


PLAUSIBLE = 20.0
"""Typical sizes of a number that count as one sigma before anything was measured: a tilt by 15 degrees explains a
heavy ruler as well as its weight does, and is not what is meant by a tilt."""


def numbers(effect: Effect) -> int:
    """Degrees of freedom that an effect takes: one for an effect that is there or not."""
    return max(1, len(effect.parameters))


def apart(more: int) -> float:
    """Chi-square by which a rival has to be worse to be excluded by an explanation that has so many numbers more; of
    one that has fewer, one less for each number that it saves."""
    return max(APART, float(chi2.isf(TAKEN_UP, more))) if more > 0 else APART + more


@cache
def _threshold(degrees: int, looks: int) -> float:
    return float(chi2.isf(FALSE_ALARM / looks, degrees))


def entry(effect: Effect, candidates: int) -> float:
    """Fall of chi-square below which an effect is not let in, when so many candidates were tried.

    Bonferroni's bound. An effect with kinks had several looks, one at each probe.
    """
    return _threshold(numbers(effect), max(candidates, 1) * max(1, len(effect.probes)))
