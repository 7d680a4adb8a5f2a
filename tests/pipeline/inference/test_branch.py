"""A straight bar that a gauge drives sideways: from rest no load moves the gauge, past the critical load one does."""

from __future__ import annotations

import numpy as np
import pytest

from pipeline.campaign import BarRig, Campaign, Data, Gauge, Noise, Test, UniformBar
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.prediction import predict
from vjm.effects import catalogue

LENGTH, EI = 300.0, 1e6
EULER = np.pi**2 * EI / LENGTH**2
LARGE = Model().with_effects([catalogue()["bar_geometric_nonlinearity"]])


def driven(middle: list[float]) -> Campaign:
    """A pinned bar, soft about y, pushed until its middle stands so far along z, mm."""
    rig = BarRig(
        length=LENGTH,
        bar=UniformBar(EA=5e6, EIy=EI, EIz=60.0 * EI, GJ=EI),
        base="pinned",
        tip="pinned",
    )
    count = len(middle)
    data = Data(
        np.arange(count),
        np.full((count, 6), np.nan),
        np.where(np.arange(6) == 0, 0.0, np.full((count, 6), np.nan)),
        np.array(middle)[:, None],
        None,
        np.zeros(count, dtype=np.int64),
    )
    noise = Noise(np.full(6, 1e-3), np.ones(6), np.array([1e-3]))
    control = ("mid", *["held"] * 5)
    test = Test("push", 0.0, "fit", control, "nominal", rig, data)
    return Campaign("strut", rig, noise, (Gauge("mid", 0.5, "z"),), (test,))


def test_the_load_is_eulers_and_grows_with_the_square_of_the_deflection() -> None:
    """P = P_E (1 + pi²/8 (w/L)²) for small w: Timoshenko and Gere, Theory of Elastic Stability, section 2.7."""
    middle = [1.0, 10.0, 20.0, -10.0]
    found = predict(LARGE, load_cases(driven(middle)))
    assert not found.lost.any()
    load = -found.values[:, 6]
    np.testing.assert_allclose(load, EULER, rtol=0.02)
    assert load[3] == pytest.approx(load[1], rel=1e-9)
    growth = load[1:3] / load[0] - 1.0
    expected = np.pi**2 / 8.0 * (np.array(middle[1:3]) ** 2 - middle[0] ** 2) / LENGTH**2
    np.testing.assert_allclose(growth, expected, rtol=0.05)


def test_its_derivatives_are_those_of_solving_again() -> None:
    model = LARGE.with_effects([catalogue()["modulus_error"]])
    cases = load_cases(driven([10.0]))
    found = predict(model, cases, order=4)
    sides = [predict(model.at(model.values + step), cases).values[0, 6] for step in (1e-3, -1e-3)]
    assert found.by_free[0, 6, 0] == pytest.approx((sides[0] - sides[1]) / 2e-3, rel=1e-5)
