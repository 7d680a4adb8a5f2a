"""What rows without play take up by choosing sides, by simulation of the choice alone."""

from __future__ import annotations

import numpy as np
import pytest

from pipeline.inference.settings import STOPS


def taken_up(play: float) -> np.ndarray:
    """Chi-square that rows take up: displacement and force are noise, the play is in units of the first.

    At a stop the force has to press it, inside the displacement is free and the force is nought.
    """
    x, force = np.random.default_rng(11).normal(size=(2, 400_000))
    costs = [
        (x - play) ** 2 + np.where(force < 0.0, force**2, 0.0),
        (x + play) ** 2 + np.where(force > 0.0, force**2, 0.0),
        np.maximum(np.abs(x) - play, 0.0) ** 2 + force**2,
    ]
    return np.asarray(x**2 - np.min(costs, axis=0))


def test_most_is_taken_up_by_a_play_as_large_as_the_noise() -> None:
    means = {play: float(np.mean(taken_up(play))) for play in (0.3, 0.6, 1.0, 1.5, 2.0)}
    assert max(means, key=lambda play: means[play]) == 1.0
    assert means[1.0] == pytest.approx(STOPS.side, abs=0.01)
    assert 2.0 * float(np.std(taken_up(1.0))) == pytest.approx(STOPS.spread, abs=0.05)
