"""What the verdict of a diagnosis rests on, as records: its sentences are made from these numbers.

Sigmas and chi-square are of the whitened residuals of the fitted tests; 1 sigma is noise.
"""

from __future__ import annotations

from pipeline.record import Record


class Explained(Record):
    """An effect of the first set: what it is, and how the readings show it."""

    effect: str
    """Its name."""
    title: str
    """What it is, in words."""
    equation: str
    """Its equation."""
    signature: str
    """What it does to readings, in words."""
    size: float | None = None
    """Sigmas by which all readings together show it, free of what other parameters take up."""
    chosen_again: float | None = None
    """Share of the searches with one test left out in which it is chosen again."""
    held_out_only: bool = False
    """Whether the tests that were held out need it and those that were fitted do not show it."""
    only_angle_deg: float | None = None
    """Angle of the bars, degrees, where alone tests show it; None where several do."""
    only_tests: tuple[str, ...] = ()
    """The tests there that show it, the plainest first."""


class RivalSet(Record):
    """A set of effects that may as well be true."""

    effects: tuple[str, ...]
    """Its effects."""
    above_best: float
    """Chi-square above that of the best set."""
    would_exclude: float
    """Chi-square above the best that would exclude it alone."""


class SensorInstead(Record):
    """A fault of a sensor that explains as much as an effect of the best set."""

    effect: str
    """That effect; empty where the sensor may not have been zeroed."""
    words: str
    """The fault."""
    explains: float
    """Chi-square that the fault takes off with one parameter."""
    of: float
    """Chi-square that the effect takes off with its own."""
    beside: tuple[str, ...]
    """Effects beside which the fault does so."""


class LookAlike(Record):
    """An effect that could be taken for one of the first set."""

    effect: str
    """Effect of the first set."""
    rival: str
    """The one that looks like it."""
    correlation: float
    """Correlation of what the two do to these readings."""
    size: float
    """Sigmas by which the effect shows."""
    needed: float
    """Sigmas by which it would have to show to be told from the other one."""


class FailedCheck(Record):
    """A check that speaks against noise."""

    name: str
    """Its name."""
    p_value: float
    """Probability that noise looks like this."""
    words: str
    """What is seen."""


class NearMiss(Record):
    """A set of effects that comes close and does not explain the readings."""

    effects: tuple[str, ...]
    """Its effects."""
    rms: float
    """Sigmas that it leaves, whitened root mean square over the degrees of freedom."""
    against: str
    """What speaks most against it, if not the size of what is left alone."""


class RestOfChannel(Record):
    """What nothing known explains of one channel, as a Gaussian process of what was prescribed: no physics."""

    channel: str
    """Its column without the unit."""
    inputs: tuple[str, ...]
    """What was prescribed and the rest varies with, that which says most first."""
    rms: float
    """Sigmas that are left."""
    elsewhere: float
    """Sigmas of each test that are left when the process knows all other tests."""


class Evidence(Record):
    """What the verdict rests on."""

    sets: tuple[tuple[str, ...], ...]
    """Sets of effects to add that may be true, the simplest first; one where the verdict is certain."""
    untested: str = ""
    """Why nothing can be tested."""
    because: str = ""
    """Why the best set explains the misfit and is not named all the same."""
    unlooked: str = ""
    """Why sets of several effects were not looked for."""
    zero: str = ""
    """The question whether a sensor was zeroed."""
    law: str = ""
    """A law beyond the catalogue that explains as much as the sets."""
    explained: tuple[Explained, ...] = ()
    """The effects of the first set."""
    rivals: tuple[RivalSet, ...] = ()
    """All sets, where there are several."""
    sensors: tuple[SensorInstead, ...] = ()
    """Faults of sensors that explain as much as an effect."""
    look_alikes: tuple[LookAlike, ...] = ()
    """What could be taken for the effects of the first set."""
    failed_checks: tuple[FailedCheck, ...] = ()
    """What speaks against noise."""
    larger_scatter: str = ""
    """How much larger the scatter is than the sigmas say, where by its order the rest is noise."""
    ended_after: int | None = None
    """Fits after which a search that took long was ended."""
    near: tuple[NearMiss, ...] = ()
    """Where nothing explains: the sets that come closest."""
    rest: tuple[RestOfChannel, ...] = ()
    """Where nothing explains: what is left of the channels that fit worst."""
    as_declared_of_one: bool = False
    """Whether the verdict with all readings as declared is that of the best single effect."""
    beside_correlated: tuple[str, ...] = ()
    """Effects beside which noise that is correlated from row to row explains all."""
    law_words: tuple[str, ...] = ()
    """Laws beyond the catalogue, in sentences."""
    units: tuple[str, ...] = ()
    """What is known, in units, of channels without a sigma, in sentences."""
    remarks: tuple[str, ...] = ()
    """What was noticed of the campaign as it was read, in sentences."""
    no_sensor: bool = False
    """Whether no test that could be proposed reads a sensor that exists."""
