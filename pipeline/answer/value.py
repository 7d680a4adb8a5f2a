"""A parameter as it was found: value, standard error, interval."""

from __future__ import annotations

from typing import Literal

from pipeline.record import Record


class Value(Record):
    """A parameter of an effect, in its unit; an end of its interval is None where the data set none."""

    value: float
    """Best-fitting value."""
    std: float | None
    """Standard error."""
    low95: float | None
    """Lower end of the 95 % interval."""
    high95: float | None
    """Upper end of the 95 % interval."""
    interval: Literal["wald", "profile", "undetermined", "fixed"]
    """How the interval was found: wald (from the curvature), profile (from the profile of the likelihood),
    undetermined (the data set no end), or fixed for what the fit left alone."""
    unit: str
    """Unit of the value."""
    meaning: str
    """What the parameter is."""
    at_bound: bool = False
    """Whether it ends at a bound of what it may be, other than the absence of the effect."""
