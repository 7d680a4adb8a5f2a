"""Steps in another order than they were done: backwards, or sorted by the load, so that both ways of a loop mix."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign import Campaign, Data, Test
from pipeline.inference.driving import driving
from pipeline.selection.criteria import Criteria
from pipeline.selection.mistakes.base import Array, Mistake

Order = Callable[[Array], NDArray[np.int64]]
FEWEST = 4


def mistakes(campaign: Campaign, criteria: Criteria) -> Iterator[Mistake]:
    """The other orders in which the steps may have been done."""
    if max(test.data.steps.size for test in campaign.tests) < FEWEST:
        return
    yield _mistake("the steps of every test stand backwards", _backwards)
    if all(_sorted(campaign, test) for test in campaign.tests if test.data.steps.size >= FEWEST):
        said = "the steps of every test are sorted by the load"
        yield _mistake(f"{said}; they were done up and down", _up_and_down)
        yield _mistake(f"{said}; they were done down and up", _down_and_up)


def _mistake(words: str, order: Order) -> Mistake:
    return Mistake(
        "order", ("step",), words, "number the steps as they were done", partial(_done, order=order)
    )


def _driven(campaign: Campaign, test: Test) -> Array:
    return np.nan_to_num(driving(test, campaign.gauges)[1])


def _sorted(campaign: Campaign, test: Test) -> bool:
    ways = np.diff(_driven(campaign, test))
    return bool(np.all(ways >= 0.0) or np.all(ways <= 0.0))


def _done(campaign: Campaign, order: Order) -> Campaign:
    tests = []
    for test in campaign.tests:
        tests.append(replace(test, data=_in_order(test.data, order(_driven(campaign, test)))))
    return replace(campaign, tests=tuple(tests))


def _in_order(data: Data, order: NDArray[np.int64]) -> Data:
    return replace(
        data,
        displacement=data.displacement[order],
        wrench=data.wrench[order],
        gauges=data.gauges[order],
        temperature=None if data.temperature is None else data.temperature[order],
        lines=data.lines[order],
    )


def _backwards(load: Array) -> NDArray[np.int64]:
    return np.arange(load.size)[::-1]


def _up_and_down(load: Array) -> NDArray[np.int64]:
    places = np.arange(load.size)
    return np.concatenate([places[::2], places[1::2][::-1]])


def _down_and_up(load: Array) -> NDArray[np.int64]:
    return _up_and_down(load)[::-1]
