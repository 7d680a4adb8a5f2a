"""What is written of the bars: width and height of the section exchanged, a modulus in GPa where MPa is asked for."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign import Campaign
from pipeline.selection.criteria import Criteria
from pipeline.selection.mistakes.base import Mistake
from pipeline.selection.mistakes.unit import THOUSAND

Array = NDArray[np.float64]
TURNED = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""A quarter of a turn about the axis of the bar."""


def mistakes(campaign: Campaign, criteria: Criteria) -> Iterator[Mistake]:
    """Of bars whose stiffness somebody wrote."""
    if campaign.rig.with_bars(_quarter_turned) is None:
        return
    yield Mistake(
        "section",
        ("EIy", "EIz"),
        "width and height of the bars' section are exchanged",
        "exchange width_mm and height_mm of the section under [rig], or EIy_Nmm2 and EIz_Nmm2",
        partial(_with_bars, change=_quarter_turned),
    )
    yield Mistake(
        "modulus",
        ("E",),
        "the modulus of the bars is in GPa",
        "multiply E_MPa under [rig] by 1000 (MPa in GPa), or what was computed with it",
        partial(_with_bars, change=partial(np.multiply, THOUSAND)),
    )


def _quarter_turned(stiffness: Array) -> Array:
    """The 6x6 of a bar whose section stands turned."""
    both = np.kron(np.eye(2), TURNED)
    return np.asarray(both @ stiffness @ both.T)


def _with_bars(campaign: Campaign, change: Callable[[Array], Array]) -> Campaign:
    """The campaign with another 6x6 of the bars, in the rig of each test too."""
    every = {id(rig): rig for rig in (campaign.rig, *(test.rig for test in campaign.tests))}
    # Tests of one rig stay tests of one rig.
    new = {key: rig.with_bars(change) or rig for key, rig in every.items()}
    tests = tuple(replace(test, rig=new[id(test.rig)]) for test in campaign.tests)
    return replace(campaign, rig=new[id(campaign.rig)], tests=tests)
