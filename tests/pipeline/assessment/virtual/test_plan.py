"""The bench plan as an experimentalist would check it."""

import numpy as np

from pipeline.assessment.virtual.plan import AXIAL_N, GAUGES, STEPS, bench_plan
from pipeline.campaign.names import COORDINATES

PLAN = bench_plan()
FITTED = [test for test in PLAN if not test.holdout]


def test_three_angles_and_two_others_held_out() -> None:
    assert {t.q_deg for t in FITTED} == {0.0, 30.0, -30.0}
    held = [t for t in PLAN if t.holdout]
    assert len(held) == 2 and {t.q_deg for t in held}.isdisjoint({t.q_deg for t in FITTED})
    assert all(len(t.values) == STEPS == 24 for t in PLAN)
    assert sum(len(t.values) for t in PLAN) == 456
    assert len({t.id for t in PLAN}) == len(PLAN) and all(f"q{t.q_deg:+.0f}" in t.id for t in PLAN)


def test_every_history_has_both_signs_and_turns_back() -> None:
    for test in PLAN:
        moving = test.values[:, np.ptp(test.values, axis=0) > 0]
        drive = moving[:, np.argmin(np.abs(moving.min(axis=0) / moving.max(axis=0).clip(1e-9) + 1.0))]
        assert drive.min() < 0 < drive.max() and drive[0] == drive[-1] == 0.0, test.id
        assert (np.diff(drive) > 0).sum() >= 5 and (np.diff(drive) < 0).sum() >= 5, test.id


def test_every_coordinate_is_driven_and_each_is_left_free_somewhere() -> None:
    driven, free = set[str](), set[str]()
    for test in FITTED:
        for k, name in enumerate(COORDINATES):
            if np.ptp(test.values[:, k]) > 0:
                driven.add(name)
            elif test.control[k] == "force":
                free.add(name)
    assert driven == set(COORDINATES)
    # z without a load is a mechanism, so it is always held or moved.
    assert free == set(COORDINATES) - {"z"}


def test_tension_and_compression_sideways_and_along() -> None:
    pushes = {np.sign(t.values[-1, 0]) for t in FITTED if t.id.startswith("lateral")}
    assert pushes == {-1.0, 0.0, 1.0}
    along = next(t for t in FITTED if t.id == "axial_held_q+0").values[:, 0]
    assert along.max() > 0.85 * AXIAL_N and along.min() < -0.85 * AXIAL_N
    assert GAUGES[0].name == "mid" and GAUGES[0].station == 0.5 and GAUGES[0].vector == (0.0, 1.0, 0.0)


def test_the_temperature_follows_nothing() -> None:
    """Correlations over all fitted steps. Of independent series as smooth as these, of about 17 x 3 free values,
    0.14 is one standard deviation."""
    heat = np.concatenate([t.temperature for t in FITTED])
    assert heat.min() > 15.0 and heat.max() < 26.0 and np.ptp(heat) > 4.0
    steps = np.concatenate([np.arange(STEPS) for _ in FITTED])
    q = np.concatenate([np.full(STEPS, t.q_deg) for t in FITTED])
    load = np.concatenate(
        [(t.values / (np.abs(t.values).max(axis=0).clip(1e-9))).sum(axis=1) for t in FITTED]
    )
    for other in (steps, q, np.abs(q), load):
        assert abs(np.corrcoef(heat, other)[0, 1]) < 0.28
    # The waves of all tests together cancel, so no step of a test is warmer than another.
    waves = np.array([t.temperature - t.temperature.mean() for t in FITTED])
    assert np.abs(waves).max() > 0.5 and np.abs(waves.mean(axis=0)).max() < 0.1
