"""Discrete mistakes that a table of measurements may have: a unit, a sign, two columns exchanged, a zero, an order.

Every module beside `base` that defines `mistakes` belongs to them; it yields those that a campaign might have.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Iterator

import numpy as np

from pipeline.campaign import Campaign
from pipeline.selection.criteria import Criteria
from pipeline.selection.mistakes.base import Mistake


def possible(campaign: Campaign, criteria: Criteria) -> Iterator[Mistake]:
    """All that a campaign might have, kind by kind in alphabetical order of their modules."""
    for info in sorted(pkgutil.iter_modules(__path__), key=lambda it: it.name):
        module = importlib.import_module(f"{__name__}.{info.name}")
        if hasattr(module, "mistakes"):
            yield from (it for it in module.mistakes(campaign, criteria) if _complete(it.mended(campaign)))


def _complete(campaign: Campaign) -> bool:
    """Whether all that is prescribed was read, as in every campaign that can be."""
    return all(np.isfinite(test.inputs(campaign.gauges)).all() for test in campaign.tests)
