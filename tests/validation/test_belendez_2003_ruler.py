"""A steel ruler as a heavy cantilever: measured deflections that need two effects at once.

T. Beléndez, C. Neipp, A. Beléndez, "Numerical and experimental analysis of a cantilever beam: a laboratory project to
introduce geometric nonlinearity in mechanics of materials", International Journal of Engineering Education 19(6)
(2003) 885-892: L = 400 mm, 25 x 0.4 mm, E = 194.3 GPa, self weight 0.758 N/m, tip force down against tip deflection.
"""

from __future__ import annotations

import numpy as np
import pytest

from pipeline.campaign import BarRig, Campaign, Data, Noise, Test, UniformBar
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model, Term
from pipeline.inference.multistart import best_fit
from pipeline.inference.prediction import predict
from pipeline.selection.diagnosis import diagnose
from vjm.effects import catalogue

FORCE = np.array([0.0, 0.098, 0.196, 0.294, 0.392, 0.490, 0.588])
DEFLECTION = 1e3 * np.array([0.089, 0.149, 0.195, 0.227, 0.251, 0.268, 0.281])
YOUNG, WIDTH, THICKNESS, LENGTH = 194.3e3, 25.0, 0.4, 400.0
WEIGHT = 0.758e-3
# The reading of a ruler held beside the tip.
SIGMA = 2.0
EFFECTS = catalogue()
LARGE, HEAVY = "bar_geometric_nonlinearity", "self_weight"


def campaign() -> Campaign:
    flat, upright = WIDTH * THICKNESS**3 / 12, THICKNESS * WIDTH**3 / 12
    shear = YOUNG / 2.6
    bar = UniformBar(
        EA=YOUNG * WIDTH * THICKNESS,
        EIy=YOUNG * flat,
        EIz=YOUNG * upright,
        GJ=shear * WIDTH * THICKNESS**3 / 3,
    )
    rig = BarRig(length=LENGTH, bar=bar, base="clamped", tip="free")
    displacement, wrench = np.full((7, 6), np.nan), np.zeros((7, 6))
    displacement[:, 2], wrench[:, 2] = -DEFLECTION, -FORCE
    noise = Noise(np.where(np.arange(6) == 2, SIGMA, 1.0), np.full(6, 1e-6), np.zeros(0))
    data = Data(np.arange(7), displacement, wrench, np.zeros((7, 0)), None, np.zeros(7, dtype=np.int64))
    return Campaign("ruler", rig, noise, (), (Test("tip", 0.0, "fit", ("force",) * 6, "nominal", rig, data),))


CASES = load_cases(campaign())


def model(*names: str) -> Model:
    """The effects with the published weight of the ruler."""
    terms = []
    for name in names:
        values = EFFECTS[name].nulls | ({"line_N_per_mm": WEIGHT} if name == HEAVY else {})
        terms.append(Term(EFFECTS[name], values))
    return Model(tuple(terms))


@pytest.mark.parametrize(("names", "rms"), [((), 106.0), ((LARGE,), 53.0), ((LARGE, HEAVY), 1.8)])
def test_each_model_misses_by_what_is_known(names: tuple[str, ...], rms: float) -> None:
    """Published data against linear, large-deflection and both: mm of root mean square."""
    found = predict(model(*names), CASES, slopes=False)
    assert not found.lost.any()
    error = found.values[:, 2] + DEFLECTION
    assert np.sqrt(np.mean(error**2)) == pytest.approx(rms, rel=0.02, abs=0.1)


def test_weight_alone_makes_it_worse() -> None:
    """162 mm by linear theory; more with the springs at the tip, whose far end turns by a radian with the weight."""
    rigidity = YOUNG * WIDTH * THICKNESS**3 / 12
    linear = FORCE * LENGTH**3 / (3 * rigidity) + WEIGHT * LENGTH**4 / (8 * rigidity)
    assert np.sqrt(np.mean((linear - DEFLECTION) ** 2)) == pytest.approx(162.0, rel=0.02)
    found = predict(model(HEAVY), CASES, slopes=False)
    assert np.sqrt(np.mean((found.values[:, 2] + DEFLECTION) ** 2)) > 162.0


def test_one_effect_at_a_time_is_misled_and_both_together_explain_it() -> None:
    """Weight, fitted alone, is driven to nothing."""
    fixed = frozenset(f"{HEAVY}.platform_{axis}_N" for axis in "xyz")
    alone = best_fit(Model(fixed=fixed).with_effects([EFFECTS[HEAVY]]), CASES, (HEAVY,))
    both = best_fit(Model(fixed=fixed).with_effects([EFFECTS[LARGE], EFFECTS[HEAVY]]), CASES, (HEAVY,))
    assert alone.model.values[0] < 0.02 * WEIGHT
    assert both.model.values[0] == pytest.approx(WEIGHT, rel=0.05)
    error = both.prediction.values[:, 2] + DEFLECTION
    assert np.sqrt(np.mean(error**2)) < 2.5


@pytest.mark.long
def test_a_number_that_hardly_shows_holds_no_other_back() -> None:
    """Weight across the bending shows in second order alone: with it free the fit is no worse than without."""
    both = [EFFECTS[LARGE], EFFECTS[HEAVY]]
    every = best_fit(Model().with_effects(both), CASES, (HEAVY,))
    fewer = best_fit(Model(fixed=frozenset({f"{HEAVY}.platform_y_N"})).with_effects(both), CASES, (HEAVY,))
    assert len(every.model.free) == len(fewer.model.free) + 1 == 4
    assert every.chi_square < fewer.chi_square + 0.01 < 0.1


@pytest.mark.long
def test_without_a_hint_both_are_named() -> None:
    """One at a time is misled; from the plain model with the whole catalogue both are found, and nothing else."""
    found = diagnose(campaign(), Model(), EFFECTS)
    assert found.verdict == "identified"
    assert set(found.sets[0]) == {LARGE, HEAVY}
    assert found.fit.rms < 1.0
