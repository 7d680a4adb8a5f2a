"""Every test of a campaign with what was measured and what two models predict, step after step."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign import Campaign, Test
from pipeline.campaign.names import COORDINATES
from pipeline.compare.error import Discrepancy
from pipeline.inference.driving import column_name, driving, unit_of
from pipeline.page.legs import lines_of
from pipeline.page.record import Curve, Numbers, Rig, TestPage

Array = NDArray[np.float64]
DIGITS = 7
"""Significant ones that a page keeps; sensors have five."""


def rig_of(it: Campaign | Test) -> Rig:
    """What is drawn of a rig."""
    rig = it.rig
    if rig.point is None:
        return Rig(kind=rig.kind, length_mm=rig.length, width_mm=rig.spread)
    return Rig(
        kind=rig.kind,
        length_mm=rig.length,
        width_mm=rig.spread,
        place_mm=numbers(rig.point),
        lines=lines_of(rig.legs),
    )


def tests_of(before: Discrepancy, after: Discrepancy) -> tuple[TestPage, ...]:
    """All tests of a campaign; both of the same load cases."""
    return tuple(_test(before, after, k) for k in range(len(before.load_cases.campaign.tests)))


def _test(before: Discrepancy, after: Discrepancy, number: int) -> TestPage:
    cases = before.load_cases
    test, gauges = cases.campaign.tests[number], cases.campaign.gauges
    rows = np.arange(cases.first[number], cases.first[number + 1])
    mask = np.zeros(len(cases.test), dtype=bool)
    mask[rows] = True
    load, loads = driving(test, gauges)
    shown = np.flatnonzero(cases.predicted[rows].any(axis=0))
    return TestPage(
        test=test.id,
        q_deg=test.q_deg,
        role=test.role,
        control=dict(zip(COORDINATES, test.control, strict=True)),
        rig=rig_of(test),
        load=column_name(load, gauges),
        load_unit=unit_of(load),
        loads=numbers(loads),
        steps=tuple(int(step) for step in test.data.steps),
        curves=tuple(_curve(before, after, rows, int(channel)) for channel in shown),
        error_before=before.rms(mask),
        error_after=after.rms(mask),
        misfit_before=_by_step(before, rows),
        misfit_after=_by_step(after, rows),
        lost_before=int(before.prediction.lost[rows].sum()),
        lost_after=int(after.prediction.lost[rows].sum()),
        measured_pose=tuple(numbers(pose) for pose in cases.measured[rows, :6]),
        predicted_pose=_poses(after, rows),
    )


def _curve(before: Discrepancy, after: Discrepancy, rows: NDArray[np.int64], channel: int) -> Curve:
    cases = before.load_cases
    measured = np.where(cases.predicted[rows, channel], cases.measured[rows, channel], np.nan)
    (was, left_was), (now, left_now) = (_predicted(gap, rows, channel) for gap in (before, after))
    return Curve(
        channel=column_name(channel, cases.campaign.gauges),
        unit=unit_of(channel),
        measured=numbers(measured),
        sigma=numbers(after.sigma[rows, channel]),
        before=numbers(was),
        after=numbers(now),
        left_before=numbers(left_was),
        left_after=numbers(left_now),
        rms_before=_rms(left_was),
        rms_after=_rms(left_now),
    )


def _predicted(gap: Discrepancy, rows: NDArray[np.int64], channel: int) -> tuple[Array, Array]:
    """Prediction at the inputs as they were read, unknown zeros added, and what it leaves in its own sigmas."""
    kept = gap.kept[rows, channel]
    units = np.where(kept, gap.units[rows, channel], np.nan)
    return gap.load_cases.measured[rows, channel] - units, units / gap.sigma[rows, channel]


def _by_step(gap: Discrepancy, rows: NDArray[np.int64]) -> Numbers:
    used = gap.load_cases.predicted[rows]
    squares = np.sum(np.where(used, gap.whitened[rows], 0.0) ** 2, axis=1)
    count = used.sum(axis=1)
    return numbers(np.where(count > 0, np.sqrt(squares / np.maximum(count, 1)), np.nan))


def _poses(gap: Discrepancy, rows: NDArray[np.int64]) -> tuple[Numbers, ...]:
    poses = np.where(gap.prediction.lost[rows, None], np.nan, gap.prediction.values[rows, :6])
    return tuple(numbers(pose) for pose in poses)


def _rms(left: Array) -> float | None:
    kept = left[np.isfinite(left)]
    return None if not kept.size else float(f"{np.sqrt(np.mean(kept**2)):.{DIGITS}g}")


def numbers(values: Iterable[float]) -> Numbers:
    """As many digits as a page keeps; None for what is not finite."""
    return tuple(float(f"{value:.{DIGITS}g}") if np.isfinite(value) else None for value in values)
