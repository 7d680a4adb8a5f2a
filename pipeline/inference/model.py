"""A model of a rig: what it starts from, and the effects in it with their values."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping
from dataclasses import dataclass, field, fields, replace
from functools import lru_cache
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign import Gauge
from pipeline.campaign.rig import Solvable
from pipeline.inference.rounding import AT_BOUND
from pipeline.inference.settings import DIFFERENCES
from pipeline.parameter_names import path_of
from vjm.effects import shipped
from vjm.effects.base import Effect, Parameter
from vjm.tolerances.angle import POSTURE

Array = NDArray[np.float64]


class Built(Protocol):
    """What is built of a rig, or of the rigs of several tests."""

    @property
    def alike(self) -> Hashable:
        """Equal where the mechanisms are."""

    def mechanism(self, gauges: tuple[Gauge, ...]) -> Solvable:
        """Plain, for effects to change."""


@dataclass(frozen=True)
class Free:
    """A number of the model that a fit may move."""

    effect: str
    parameter: Parameter

    @property
    def name(self) -> str:
        """Name in results: effect.parameter."""
        return path_of(self.effect, self.parameter.name)

    @property
    def bounds(self) -> tuple[float, float]:
        """Least and greatest value that a fit may try."""
        margin = DIFFERENCES.inside * abs(self.parameter.typical)
        return self.parameter.low + margin, self.parameter.high - margin


@dataclass(frozen=True)
class Term:
    """An effect in a model, with the value of each of its parameters."""

    effect: Effect
    values: Mapping[str, float]

    def __post_init__(self) -> None:
        names = {p.name for p in self.effect.parameters}
        if set(self.values) != names:
            raise ValueError(
                f"{self.effect.name} has the parameters {sorted(names)}, got {sorted(self.values)}"
            )


@dataclass(frozen=True)
class Model:
    """The plain virtual-joint model of a rig with these effects, applied in turn.

    fixed: names effect.parameter that a fit leaves alone. nominals: what was written down about the rig, at the values
    at which it is predicted (`pipeline.inference.nuisances`); none where all of it is exact.
    """

    terms: tuple[Term, ...] = ()
    fixed: frozenset[str] = field(default_factory=frozenset)
    nominals: tuple[Term, ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the effects, in order."""
        return tuple(term.effect.name for term in self.terms)

    @property
    def turn(self) -> float:
        """rad by which the unloaded bars stand beside the angle that a test names."""
        return 1e-3 * sum(term.values.get(POSTURE, 0.0) for term in self.nominals)

    @property
    def free(self) -> tuple[Free, ...]:
        """The numbers that a fit may move, in order."""
        every = (Free(term.effect.name, p) for term in self.terms for p in term.effect.parameters)
        return tuple(each for each in every if each.name not in self.fixed)

    @property
    def values(self) -> Array:
        """(P,) present values of the free numbers."""
        by_name = {term.effect.name: term.values for term in self.terms}
        return np.array([by_name[each.effect][each.parameter.name] for each in self.free], dtype=float)

    @property
    def bounded(self) -> Array:
        """(P,) the same, none beyond its bounds."""
        lows, highs = ([each.bounds[k] for each in self.free] for k in (0, 1))
        return np.clip(self.values, lows, highs)

    def at(self, values: Array) -> Model:
        """The model with other values (P,) of its free numbers."""
        new = {each.name: float(value) for each, value in zip(self.free, values, strict=True)}
        terms = []
        for term in self.terms:
            own = {name: new.get(path_of(term.effect.name, name), old) for name, old in term.values.items()}
            terms.append(replace(term, values=own))
        return replace(self, terms=tuple(terms))

    def with_effects(self, effects: Iterable[Effect]) -> Model:
        """The model with further effects at values beside null, where they are there and do next to nothing.

        Numbers that are fixed are null. ValueError for an effect that is in the model already.
        """
        terms = list(self.terms)
        for effect in effects:
            if effect.name in {term.effect.name for term in terms}:
                raise ValueError(f"{effect.name} is in the model already")
            numbers = [Free(effect.name, p) for p in effect.parameters]
            start = {
                each.parameter.name: each.parameter.null if each.name in self.fixed else _beside_null(each)
                for each in numbers
            }
            terms.append(Term(effect, start))
        return replace(self, terms=tuple(terms))

    def freed(self, began: Model) -> Model:
        """With no other fixed numbers than the one it began with: predictions are wide where readings see none."""
        return replace(self, fixed=began.fixed)

    def without(self, name: str) -> Model:
        """The model without one of its effects."""
        return replace(self, terms=tuple(term for term in self.terms if term.effect.name != name))

    def mechanism(self, rig: Built, gauges: tuple[Gauge, ...]) -> Solvable:
        """The mechanism of a rig, or of tests on rigs alike. ValueError for an effect that this rig cannot have."""
        terms = (*self.nominals, *self.terms)
        if not all(shipped(term.effect) for term in terms):
            # What an effect of somebody else does to the arrays that it is given nobody knows.
            return _applied(terms, rig.mechanism(gauges))
        effects = tuple((term.effect, tuple(term.values.items())) for term in terms)
        return _kept(effects, _Place(rig.alike, rig), gauges)

    def reads_alone(self, free: Free, value: float, rig: Built, gauges: tuple[Gauge, ...]) -> bool:
        """Whether another value of this number changes what sensors read, and nothing else.

        The effects before its own and itself are asked. Those of the catalogue that come after it make no difference by
        what sensors there are; another one may, so that before it the answer is no.
        """
        number = self.names.index(free.effect)
        if not all(shipped(term.effect) for term in self.terms[number + 1 :]):
            return False
        before = replace(self, terms=self.terms[:number]).mechanism(rig, gauges)
        own = self.terms[number]
        other = replace(own, values={**own.values, free.parameter.name: value})
        return _in_sensors_alone(*(_applied((term,), before) for term in (own, other)))


def _applied(terms: Iterable[Term], it: Solvable) -> Solvable:
    for term in terms:
        it = term.effect.apply(it, term.values)
    return it


@dataclass(frozen=True)
class _Place:
    """A rig by what its mechanism follows."""

    alike: Hashable
    rig: Built = field(compare=False)


@lru_cache
def _kept(
    effects: tuple[tuple[Effect, tuple[tuple[str, float], ...]], ...], at: _Place, gauges: tuple[Gauge, ...]
) -> Solvable:
    """A mechanism with effects at values: one prediction after the other asks for the same."""
    return _applied((Term(effect, dict(values)) for effect, values in effects), at.rig.mechanism(gauges))


def at_bound(model: Model) -> tuple[str, ...]:
    """Names of the free numbers that end at a bound of theirs which is no absence of the effect."""
    out = []
    for each, value in zip(model.free, model.values, strict=True):
        low, high = each.bounds
        near = AT_BOUND * (high - low)
        ends = ((low, each.parameter.low), (high, each.parameter.high))
        physical = [end for end, own in ends if own != each.parameter.null]
        if any(abs(value - end) <= near for end in physical):
            out.append(each.name)
    return tuple(out)


def _beside_null(each: Free) -> float:
    """A value that is not null, so that the effect is there, and no farther from it than `DIFFERENCES.inside`."""
    p = each.parameter
    return float(np.clip(p.null + DIFFERENCES.inside * p.typical, *each.bounds))


def _in_sensors_alone(one: object, other: object) -> bool:
    """Whether two mechanisms differ at most in their sensors. What cannot be told to be the same is not."""
    names = [each.name for each in fields(one) if each.name != "sensors"]  # type: ignore[arg-type]
    return type(one) is type(other) and all(_same(getattr(one, n), getattr(other, n)) for n in names)


def _same(one: object, other: object) -> bool:
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        return np.array_equal(one, other)
    # What holds a rig's sensors inside is looked into; the rest is the same object or another.
    return one is other or (hasattr(one, "sensors") and _in_sensors_alone(one, other))
