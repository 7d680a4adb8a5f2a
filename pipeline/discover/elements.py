"""Where a law could sit, element by element: its own coordinate at every load step, and what it does to the readings.

All influences are derivatives at the states of one prediction, from one factorisation a load step with many right
sides: of a torque by forces on the hinge's coordinate, of a displacement in series by rigid axes that are put in at the
site (`vjm.site_joint`), of a sensor by its own column.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.names import channel_columns
from pipeline.discover.coordinate_noise import input_roots, unsure
from pipeline.inference.fit import Fit
from pipeline.inference.load_cases import Group, LoadCases
from pipeline.inference.residual import whitening
from vjm.effects.base import Rig
from vjm.equilibrium import Equilibrium
from vjm.lagrangian import layout, rest
from vjm.law_sites import SITE_KINDS, SiteKind
from vjm.link import Link
from vjm.mechanisms.bar import Bar
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.mechanisms.sites import Place
from vjm.sensitivity import DriveDirection, Force, by_parameters
from vjm.site_joint import SiteJoint
from vjm.site_loads import carried

Array = NDArray[np.float64]
SHIFT, TURN = 0.1, 1e-3
"""mm and rad: typical sizes of displacements put in, for differences; their thousandth part is taken."""
ORDER = 2
AXIAL = "along"
"""Kind of the places whose load is the axial one of the bar."""


class NoSites(ValueError):
    """A rig that has no places where a law could sit."""


@dataclass(frozen=True, eq=False)
class Element:
    """One place where a law could sit.

    kind: of the site, or a column of the table. place: of the hinge or end of a bar, None for the whole.
    coordinate: (R,) what a law there is a function of: turn or shift, load, or predicted reading. unsure: (R,) its
    standard deviation by the noise of the readings.
    influence: (N,) whitened change of the residuals' readings by one unit of what the law says, of the tests that may
    be fitted. reference: (N,) the same of the readings at which sensors were zeroed, which are taken off; zeroed: (R,)
    row of these readings, -1 for the unloaded state, in which gauges are zeroed. axial: (R,) axial load of the bar at
    its end there, N, None where there is no such end.
    """

    kind: str
    place: Place | None
    coordinate: Array
    unsure: Array
    influence: Array
    reference: Array
    zeroed: np.ndarray
    axial: Array | None = None

    def moved(self, says: Array, unloaded: Array, rows: np.ndarray) -> Array:
        """(N, n) whitened change of readings where laws there say (R, n), and (n,) in the unloaded state.

        rows: (N,) row of each residual.
        """
        before = np.where(self.zeroed[:, None] < 0, unloaded, says[self.zeroed])
        return np.asarray(self.influence[:, None] * says[rows] - self.reference[:, None] * before[rows])

    @property
    def tags(self) -> tuple[str, ...]:
        """Of its place."""
        return () if self.place is None else self.place.tags


def elements(found: Fit) -> tuple[Element, ...]:
    """All places of the rig of a fit's campaign and all its columns, at the states and inputs of the fit.

    NoSites for a rig that has no such places.
    """
    cases = found.residual.load_cases
    weights = whitening(cases, found.prediction)
    lost = found.prediction.lost

    def flat(readings: Array) -> Array:
        values = weights.apply(readings)
        values[lost] = 0.0
        return found.residual.flat(values)

    roots = input_roots(found)
    return (*_of_mechanism(found, flat, roots), *_of_columns(found, flat, roots))


def _of_mechanism(found: Fit, flat: Callable[[Array], Array], roots: Array) -> Iterator[Element]:
    """Hinges, ends of bars, base. roots: (R, 7, 7) of `input_roots`."""
    cases, there = found.residual.load_cases, found.prediction
    mechanisms = [_bench(found, group) for group in cases.groups]
    places = [(kind, place) for kind in SITE_KINDS.values() for place in _places(mechanisms[0], kind)]
    coordinates, doubts = np.zeros((2, len(cases.test), len(places)))
    influences, unloaded = np.zeros((2, *cases.measured.shape, len(places)))
    for group, mechanism, state in zip(cases.groups, mechanisms, there.states, strict=True):
        rows, real = cases.rows_of(group), group.real
        own = np.zeros((*real.shape, *roots.shape[1:]))
        own[real] = roots[rows]
        at, doubt, change, before = (x[real] for x in _group(mechanism, places, state, own))
        coordinates[rows], doubts[rows], influences[rows], unloaded[rows] = at, doubt, change, before
    zeroed = _zeroed(cases)
    columns, references = flat(influences), flat(_reference(influences, unloaded, cases, zeroed))
    axial = {place: coordinates[:, k] for k, (kind, place) in enumerate(places) if kind.name == AXIAL}
    for k, (kind, place) in enumerate(places):
        here = coordinates[:, k], doubts[:, k]
        yield Element(kind.name, place, *here, columns[:, k], references[:, k], zeroed, axial.get(place))


def _bench(found: Fit, group: Group) -> Rig:
    """The mechanism of a fit on the rig of some tests. NoSites where that is no bar and no parallelogram."""
    mechanism = found.model.mechanism(group, found.residual.load_cases.campaign.gauges)
    if not isinstance(mechanism, Bar | Parallelogram):
        raise NoSites(f"sites of laws are those of a bar or a parallelogram, not of a {group.rig.kind}")
    return mechanism


Where = tuple[SiteKind, Place | None]


def _group(
    plain: Rig, places: Sequence[Where], state: Equilibrium, roots: Array
) -> tuple[Array, Array, Array, Array]:
    """Of tests on one rig: the coordinate (T, S, K) of every place and its standard deviation, what it does to the
    readings (T, S, C, K), and to those of gauges in the unloaded state, in which they are zeroed."""
    series = [each for each in places if each[0].series]
    free = [each for each in places if not each[0].series]
    there = _on(_opened(plain, series), state)
    sizes = [TURN if kind.turns else SHIFT for kind, _ in series]
    asked = [DriveDirection(_name(*each), size) for each, size in zip(series, sizes, strict=True)]
    by_series = by_parameters(there, asked, order=ORDER).readings
    change = dict(zip(free, np.moveaxis(_by_torques(there), -1, 0), strict=True))
    change |= dict(zip(series, np.moveaxis(by_series, -1, 0), strict=True))
    before = _unloaded_gauges(there, series)

    def at(state: Equilibrium) -> Array:
        turns = dict(zip(free, np.moveaxis(_turns(state), -1, 0), strict=True))
        own = {**turns, **_through(state, series)}
        return np.stack([own[p] for p in places], -1)

    # A torque moves the linkage to another unloaded state, which is not where the model zeroes its gauges.
    none = np.zeros(state.readings.shape)
    return (
        at(there),
        unsure(there, roots, at),
        np.stack([change[p] for p in places], -1),
        np.stack([before.get(p, none) for p in places], -1),
    )


def _places(rig: Rig, kind: SiteKind) -> tuple[Place | None, ...]:
    return (None,) if kind.parts == "base" else rig.places("hinges")


def _name(kind: SiteKind, place: Place | None) -> str:
    """Of the input that puts in a displacement there."""
    return ".".join(("site", kind.name, *(() if place is None else place.tags)))


def _opened(rig: Rig, series: Sequence[Where]) -> Rig:
    """The rig with a rigid axis at each of these places."""

    def joints(bar: int, end: int) -> tuple[SiteJoint, ...]:
        mine = [each for each in series if each[1] is not None and (each[1].bar, each[1].end) == (bar, end)]
        return tuple(SiteJoint(kind.axis, None, _name(kind, place)) for kind, place in mine)

    def with_joints(number: int, link: Link) -> Link:
        base, tip = joints(number, 0), joints(number, 1)
        return replace(link, base_joints=(*link.base_joints, *base), tip_joints=(*tip, *link.tip_joints))

    base = tuple(SiteJoint(kind.axis, None, _name(kind, None)) for kind, place in series if place is None)
    return replace(rig.altered(with_joints), base_joints=(*base, *rig.base_joints))


def _on(mechanism: Rig, state: Equilibrium) -> Equilibrium:
    """A state of a mechanism in the same one with further inputs, all at their defaults."""
    drives = np.zeros((*state.converged.shape, len(layout(mechanism).drives)))
    for k, name in enumerate(layout(state.mechanism).drives):
        drives[..., layout(mechanism).drives.index(name)] = state.drives[..., k]
    return replace(state, mechanism=mechanism, drives=drives)


def _numbers(state: Equilibrium) -> Iterator[tuple[int, int, int]]:
    """Of all hinges: chain, coordinate in it, and unknown."""
    place = layout(state.mechanism)
    for c, chain in enumerate(state.mechanism.chains):
        for k in chain.passive:
            yield c, k, place.coordinates[c].start + int(np.searchsorted(chain.moving, k))


def _turns(state: Equilibrium) -> Array:
    """Turns (T, S, K) of all hinges from where they stand without load."""
    starts = rest(state.mechanism, state.drives)
    found = [state.unknowns[..., unknown] - starts[c][..., k] for c, k, unknown in _numbers(state)]
    return np.stack(found, -1) if found else np.zeros((*state.converged.shape, 0))


def _by_torques(state: Equilibrium) -> Array:
    """Change of the readings (T, S, C, K) by torques that hold against all hinges."""
    return by_parameters(state, [Force(unknown) for _, _, unknown in _numbers(state)]).readings


def _through(state: Equilibrium, series: Sequence[Where]) -> dict[Where, Array]:
    """Load (T, S) through each of these places."""
    out = {each: np.zeros(state.converged.shape) for each in series}
    for number, chain in enumerate(state.mechanism.chains):
        loads, own = carried(state, number), {drive.name: drive for drive in chain.drives}
        for each in series:
            if (drive := own.get(_name(*each))) is not None:
                out[each] += loads @ drive.slope
    return out


def _unloaded_gauges(state: Equilibrium, series: Sequence[Where]) -> dict[Where, Array]:
    """Change (T, S, C) of the readings in the unloaded state by a displacement at each of these places."""
    out = {each: np.zeros(state.readings.shape) for each in series}
    mechanism, unloaded = state.mechanism, state.unloaded_coordinates
    for channel, gauge in enumerate(mechanism.gauges, start=state.readings.shape[-1] - len(mechanism.gauges)):
        drives = {drive.name: drive for drive in mechanism.chains[gauge.chain].drives}
        slope = gauge.slope(unloaded[gauge.chain])
        for each in series:
            if (drive := drives.get(_name(*each))) is not None:
                out[each][..., channel] = slope @ drive.slope
    return out


def _zeroed(cases: LoadCases) -> np.ndarray:
    """(R,) row at which the sensors of a row were zeroed, -1 for the unloaded state."""
    out = np.full(len(cases.test), -1)
    for k, test in enumerate(cases.campaign.tests):
        if test.zero == "first_row":
            out[int(cases.first[k]) : int(cases.first[k + 1])] = cases.first[k]
    return out


def _reference(readings: Array, unloaded: Array, cases: LoadCases, zeroed: np.ndarray) -> Array:
    """Influences (R, C, K) on the readings at which sensors were zeroed: of all that were not prescribed in a first
    row, else those in the unloaded state."""
    out = unloaded.copy()
    for row in np.unique(zeroed[zeroed >= 0]).tolist():
        free = np.ones(readings.shape[1], dtype=bool)
        free[cases.channels[row]] = False
        out[zeroed == row] = np.where(free[:, None], readings[row], 0.0)
    return out


def _of_columns(found: Fit, flat: Callable[[Array], Array], roots: Array) -> Iterator[Element]:
    """Errors of readings over what is predicted of them. roots: (R, 7, 7) of `input_roots`."""
    cases, there = found.residual.load_cases, found.prediction
    names, zeroed = channel_columns(cases.campaign.gauges), _zeroed(cases)
    for channel, name in enumerate(names):
        readings = np.zeros(cases.measured.shape)
        readings[:, channel] = np.where(cases.predicted[:, channel], 1.0, 0.0)
        coordinate = there.values[:, channel].copy()
        doubt = np.linalg.norm(np.einsum("rk,rkj->rj", there.by_inputs[:, channel], roots), axis=-1)
        ruled = cases.channels == channel
        for which in range(ruled.shape[1]):
            mine = ruled[:, which] & (cases.input_sigma[:, which] > 0.0)
            readings[mine] = -there.by_inputs[mine][..., which]
            coordinate[mine] = cases.measured[mine, channel] + there.shift[mine, which]
            doubt[mine] = np.linalg.norm(roots[mine, which], axis=-1)
        if not np.any(readings):
            continue
        # What is wrong with a reading without load is its zero: nothing is taken off.
        before = _reference(readings[..., None], np.zeros((*readings.shape, 1)), cases, zeroed)
        own, reference = flat(readings[..., None])[:, 0], flat(before)[:, 0]
        yield Element(f"column {name}", None, coordinate, doubt, own, reference, zeroed)
