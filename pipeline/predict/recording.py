"""Predicted readings as the record that everything is written from."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np
from numpy.typing import NDArray

from pipeline.attempt import Attempts
from pipeline.campaign import Test
from pipeline.campaign.names import SUPPORT, TEMPERATURE, channel_columns
from pipeline.inference.model import at_bound
from pipeline.predict.budget import budget
from pipeline.predict.comparison import comparison
from pipeline.predict.predicting import Predicted
from pipeline.predict.ranges import Ranges
from pipeline.predict.record import ColumnBand, Counted, PredictedRow, Predictions, Reading
from pipeline.provenance import made_with

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


def recorded(it: Predicted, seconds: float = 0.0, seed: int = 0) -> Predictions:
    """The record, without sentences."""
    attempts = Attempts()
    model, held = it.fitted.fit.model, it.judged & ~_fitted(it)[:, None]
    sampled = int(it.bands.sampled.sum())
    return Predictions(
        campaign=it.fitted.whole.name,
        effects=model.names,
        sampled=sampled,
        noise_factor=it.fitted.factor,
        rows=tuple(_rows(it)),
        columns=tuple(_columns(it)),
        fitted=_counted(it, it.judged & _fitted(it)[:, None]),
        held_out=_counted(it, held),
        at_bound=at_bound(model),
        combined=it.tangent.posterior.loose,
        comparison=attempts.get("the comparison of predicted and measured", lambda: comparison(it, held), ()),
        budget=attempts.get(
            "what limits each parameter", lambda: budget(it.fitted, it.tangent.posterior), ()
        ),
        not_done=tuple(attempts.failed),
        seconds=round(seconds, 3),
        seed=seed,
        **made_with(),
        data=dict(it.fitted.whole.digests) | it.asked.digests,
    )


def _fitted(it: Predicted) -> Mask:
    """(R,) rows of the tests that were fitted."""
    roles = [it.asked.own and test.role == "fit" for test in it.asked.tests]
    return np.array(roles, dtype=bool)[it.cases.test]


def _counted(it: Predicted, some: Mask) -> Counted:
    return Counted(inside=int((it.inside & some).sum()), of=int(some.sum()))


def _columns(it: Predicted) -> Iterator[ColumnBand]:
    kept, fitted = it.wanted & ~it.bands.lost[:, None], _fitted(it)[:, None]
    for k, name in enumerate(channel_columns(it.cases.campaign.gauges)):
        own = np.zeros_like(kept)
        own[:, k] = kept[:, k]
        if own.any():
            half = 0.5 * (it.bands.high - it.bands.low)[own]
            yield ColumnBand(
                column=name,
                readings=int(own.sum()),
                half_width=float(np.median(half)),
                parameters=_rms(it.bands.parameters[own]),
                tolerances=_rms(it.bands.tolerances[own]),
                noise=_rms(it.bands.noise[own]),
                fitted=_counted(it, it.judged & own & fitted),
                held_out=_counted(it, it.judged & own & ~fitted),
            )


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _rows(it: Predicted) -> Iterator[PredictedRow]:
    ranges = Ranges.of(it.fitted.whole)
    names, row = channel_columns(it.cases.campaign.gauges), 0
    for test in it.asked.tests:
        posture = tuple(ranges.of_test(test))
        for number, step in enumerate(test.data.steps.tolist()):
            inputs = dict(_inputs(it, test, number, row, names))
            lost = bool(it.bands.lost[row])
            readings = () if lost else tuple(_readings(it, row, names))
            known = inputs | {each.column: each.value for each in readings}
            fitted = it.asked.own and test.role == "fit"
            yield PredictedRow(
                test=test.id,
                step=step,
                role=test.role if it.asked.own else "asked",
                q_deg=test.q_deg,
                at_mm=test.rig.point,
                values=it.asked.values.get(test.id, {}),
                inputs=inputs,
                beyond=() if fitted else (*posture, *ranges.of_readings(known)),
                lost=str(it.bands.reasons.get(row, "no stable state")) if lost else "",
                sampled=bool(it.bands.sampled[row]),
                readings=readings,
            )
            row += 1


def _inputs(
    it: Predicted, test: Test, number: int, row: int, names: list[str]
) -> Iterator[tuple[str, float]]:
    values = test.inputs(it.cases.campaign.gauges)[number]
    for by, channel, value in zip(test.control, it.cases.channels[row], values, strict=True):
        if by != SUPPORT:
            yield names[int(channel)], float(value)
    if test.data.temperature is not None and np.isfinite(test.data.temperature[number]):
        yield TEMPERATURE, float(test.data.temperature[number])


def _readings(it: Predicted, row: int, names: list[str]) -> Iterable[Reading]:
    bands, judged, inside = it.bands, it.judged, it.inside
    for k in np.flatnonzero(it.wanted[row]).tolist():
        there = bool(judged[row, k])
        yield Reading(
            column=names[k],
            value=float(bands.value[row, k]),
            low95=float(bands.low[row, k]),
            high95=float(bands.high[row, k]),
            parameters=float(bands.parameters[row, k]),
            tolerances=float(bands.tolerances[row, k]),
            noise=float(bands.noise[row, k]),
            measured=float(it.measured[row, k]) if there else None,
            inside=bool(inside[row, k]) if there else None,
        )
