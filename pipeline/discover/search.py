"""One law after another: where the rest sits, what form it has, that law in the mechanism, and then what is left.

All is linearised anew about each fit: a second site in the linearisation of the first would be false. What is no law by
nature (`pipeline.discover.bodies`) and explains as much enters the model as what it is.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pipeline.callbacks import OnProgress
from pipeline.campaign import Campaign
from pipeline.discover.bases import KNOTS
from pipeline.discover.bodies import Body, started
from pipeline.discover.evidence import Evidence, Rest
from pipeline.discover.forming import fitted_form, formed
from pipeline.discover.locating import Located, Map, mapped
from pipeline.discover.settling import beside
from pipeline.discover.sites import Site
from pipeline.discover.through import Through, through
from pipeline.discover.ways import unexplained, ways_of
from pipeline.inference.fit import Fit, fit, unfitted
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.model import Model
from pipeline.inference.orthonormal_basis import basis
from pipeline.selection.adequacy.bad_readings import BadReading
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.reading_noise import AS_DECLARED, Readings
from vjm.effects.base import Effect

Array = NDArray[np.float64]
GEOMETRY = "bar_geometric_nonlinearity"


@dataclass(frozen=True, eq=False)
class Law:
    """A law that was found. map: what was seen before it. group: sites that are not told apart, the best first.
    left_out: (parts,) gains of `Rest.gains`. ways: forms fitted through the mechanism, the chosen one first, then those
    tied with it; empty for a sensor's column, of which there is no law in the mechanism, and where no form is one.
    apart: names of places with as much evidence at which that form explains less through the mechanism."""

    map: Map
    group: tuple[Located, ...]
    left_out: Array
    ways: tuple[Through, ...]
    apart: frozenset[str] = frozenset()

    @property
    def site(self) -> Site:
        """The best."""
        return self.group[0].site

    @property
    def evidence(self) -> float:
        """E of the site."""
        return self.group[0].value

    @property
    def margin(self) -> float:
        """Evidence above the best site outside the group; infinite where there is none."""
        names = {it.site.name for it in self.group} | self.apart
        others = [it.value for it in self.map.sites if it.site.name not in names]
        others += [it.value for it in self.map.bodies]
        return self.evidence - max(others) if others else np.inf


@dataclass(frozen=True, eq=False)
class Added:
    """A body that entered the model, and the map that it was seen in."""

    map: Map
    body: Body

    @property
    def sites(self) -> tuple[Located, ...]:
        """Those at which a law explains as much."""
        return tuple(it for it in self.map.sites if it.value >= self.body.value - CRITERIA.law_alike)


@dataclass(frozen=True, eq=False)
class Discovery:
    """given: the fit of the model as it is. begin: without any law, with the geometric nonlinearity of the bars where
    that leaves less. steps: laws and bodies in the order in which they were found. end: the fit with
    all of them. last: what was seen about it. whole: whether nothing
    more is found there. settled: what the readings were found to be on the way, one after another."""

    given: Fit
    begin: Fit
    steps: tuple[Law | Added, ...]
    end: Fit
    last: Map
    whole: bool
    settled: tuple[Readings, ...] = ()

    @property
    def bad(self) -> tuple[BadReading, ...]:
        """Single bad readings that were set aside."""
        return tuple(bad for each in self.settled for bad in each.bad)

    def as_read(self, campaign: Campaign) -> Campaign:
        """A campaign without these, and with sigmas as sensors scatter."""
        for each in self.settled:
            campaign = replace(each, normal=None).applied(campaign)
        return campaign

    @property
    def bent(self) -> bool:
        """Whether the geometric nonlinearity of the bars entered the model before all else."""
        return self.begin.model.names != self.given.model.names

    @property
    def laws(self) -> tuple[Law, ...]:
        """Without the bodies."""
        return tuple(step for step in self.steps if isinstance(step, Law))


def fitted_to(model: Model, cases: LoadCases) -> Fit:
    """A model fitted to the readings of load cases; as it is where it has no numbers."""
    return fit(model, cases) if model.free else unfitted(model, cases)


def discover(
    cases: LoadCases, model: Model, effects: Mapping[str, Effect], on_progress: OnProgress = lambda _: None
) -> Discovery:
    """Of load cases that may all be fitted. effects: those that the rig can have.

    ValueError for a rig without sites.
    """
    on_progress("the model as it is")
    given, begin = _begin(cases, model, effects)
    here, steps, settled, begun = begin, list[Law | Added](), list[Readings](), cases
    while True:
        on_progress("where the rest sits")
        seen = mapped(here, effects, known=[step.group[0] for step in steps if isinstance(step, Law)])
        new = beside(seen) if len(settled) < CRITERIA.law_rounds else AS_DECLARED
        if not new.plain:
            on_progress("with the readings as they are")
            settled.append(new)
            cases = load_cases(new.applied(cases.campaign))
            given, begin = (fitted_to(each.model, cases) for each in (given, begin))
            here = begin if not steps else fitted_to(here.model, cases)
            continue
        last = steps[-1] if steps and begun is cases else None
        if isinstance(last, Law) and seen.best >= CRITERIA.law_proposed:
            better = _elsewhere(last, here, cases, on_progress)
            if better is not None:
                steps[-1], here = better, better.ways[0].fit
                continue
        step = _step(seen, cases, len(steps) + 1, on_progress)
        if isinstance(step, Law) and step.ways:
            known = [it.group[0] for it in steps if isinstance(it, Law)]
            for name in [n for n in in_its_place(step) if n in begin.model.names]:
                without = fitted_to(step.map.found.model.without(name), cases)
                fewer = mapped(without, effects, known=known)
                step = _instead(step, _step(fewer, cases, len(steps) + 1, on_progress))
        if step is None or len(steps) >= CRITERIA.laws_at_most:
            return Discovery(given, begin, tuple(steps), here, seen, step is None, tuple(settled))
        steps.append(step)
        begun = cases
        if isinstance(step, Added):
            here = fit(started(here.model, step.body), cases)
        elif step.ways:
            here = step.ways[0].fit
        else:
            return Discovery(given, begin, tuple(steps), here, seen, False, tuple(settled))


def _begin(cases: LoadCases, model: Model, effects: Mapping[str, Effect]) -> tuple[Fit, Fit]:
    """The model, and that or the one with the geometric nonlinearity of its bars where that leaves less."""
    plain = fitted_to(model, cases)
    if GEOMETRY not in effects:
        return plain, plain
    other = model.with_effects([effects[GEOMETRY]])
    bent = fitted_to(other, cases)
    return plain, min(plain, bent, key=lambda it: it.order)


def _step(seen: Map, cases: LoadCases, number: int, on_progress: OnProgress) -> Law | Added | None:
    """What is proposed next; None where nothing is."""
    body = seen.body
    if body is not None and body.value >= seen.best - CRITERIA.law_alike:
        if body.value < CRITERIA.law_proposed:
            return None
        root = body.scale * np.eye(body.columns.shape[1])
        explained = body.columns @ body.weights
        return Added(seen, body) if _gained(seen.rest, body.columns, root, explained)[1] else None
    if seen.best < CRITERIA.law_proposed:
        return None
    group, gains = _proposed(seen)
    if not group:
        return None
    if _is_column(group[0]):
        return Law(seen, group, gains, ())
    on_progress(f"the law at {group[0].site.name}")
    for it in group:
        if _is_column(it):
            break
        first = formed(it.site, seen.rest, it.largest)
        if any(form.left < unexplained(seen) for form in first):
            others = tuple(other for other in group if other is not it)
            return Law(seen, (it, *others), gains, ways_of(seen, first, cases, f"law{number}", on_progress))
    # A free function may fall with the load that a place bears, as no compliance does: that is no law.
    return None


def _elsewhere(law: Law, here: Fit, cases: LoadCases, on_progress: OnProgress) -> Law | None:
    """A law that left a pattern, at the place of its kind and group where it leaves least through the mechanism, of
    those with more evidence; None where no other is better. Influences that are known to some parts in a hundred do not
    tell places apart that the mechanism does. here: the fit with it, of the readings by which it was found."""
    chosen, rest, base = law.ways[0], law.map.rest, law.map.found.model
    tried = {law.site.name: replace(chosen, fit=here)}
    for it in law.group[1:]:
        likelier = it.site.kind == law.site.kind and it.value > law.evidence
        form = fitted_form(chosen.formed.form, it.site, rest, it.largest) if likelier else None
        if form is not None:
            on_progress(f"the law at {it.site.name} instead")
            tried[it.site.name] = through(form, base, cases, chosen.law.name)
    told = min(way.cost for way in tried.values()) + CRITERIA.law_alike
    apart = frozenset(name for name, way in tried.items() if way.cost > told)
    if law.site.name not in apart:
        return None
    # The coarsest of those that are as good.
    it = max(
        (each for each in law.group if each.site.name in {*tried} - apart), key=lambda each: each.site.parts
    )
    group = (it, *(each for each in law.group if each is not it and each.site.name not in apart))
    ways = ways_of(law.map, formed(it.site, rest, it.largest), cases, chosen.law.name, on_progress)
    if not ways or ways[0].cost > told:
        return None
    left_out = _gained_at(law.map, it.evidence)[0]
    return replace(law, group=group, left_out=left_out, ways=ways, apart=law.apart | apart)


def in_its_place(law: Law, constant: bool = True) -> Iterator[str]:
    """Effects of the model of which most, what their largest number does, a function at the place of a law does as
    well: where that law holds they may be a part of it. constant: also those of which a constant there does most, as
    of a length that is another one without load."""
    found, rest = law.map.found, law.map.rest
    values = rest.weakened(law.group[0].evidence.site.values)
    # The knots of a curve add up to one everywhere.
    units, alone = basis(values), basis(values[:, :KNOTS].sum(axis=1, keepdims=True))
    own = rest.weakened(rest.seen(found.residual.without_zeros(found.residual.slopes)))
    free = found.model.free
    moved = own * [v - f.parameter.null for f, v in zip(free, found.model.values, strict=True)]
    sizes = np.sum(moved**2, axis=0)
    for term in found.model.terms:
        mine = [k for k, each in enumerate(free) if each.effect == term.effect.name]
        if mine:
            most = moved[:, max(mine, key=lambda k: float(sizes[k]))]
            least = CRITERIA.law_alike_share * (most @ most)
            if _left(units, most) < least and (constant or _left(alone, most) >= least):
                yield term.effect.name


def _left(units: Array, column: Array) -> float:
    """Of the square of a column (N,), beside orthonormal ones (N, n)."""
    off = column - units @ (units.T @ column)
    return float(off @ off)


def _instead(law: Law, other: Law | Added | None) -> Law:
    """Of a law beside an effect in its place, and one without that, the second where it explains as much."""
    if not isinstance(other, Law) or not other.ways:
        return law
    return other if other.ways[0].cost <= law.ways[0].cost + CRITERIA.law_alike else law


def _proposed(seen: Map) -> tuple[tuple[Located, ...], Array]:
    """The sites that are not told apart from the best, those first at which a function stands without the test that
    speaks for it most, and the gains of the first; none where there is no such site."""
    group = seen.group(max(CRITERIA.law_alike, CRITERIA.law_alike_share * seen.best))
    told = {it.site.name: _gained_at(seen, it.evidence) for it in group}
    enough = _coarsest_first(tuple(it for it in group if told[it.site.name][1]))
    if not enough:
        return (), np.zeros(0)
    others = _coarsest_first(tuple(it for it in group if not told[it.site.name][1]))
    return (*enough, *others), told[enough[0].site.name][0]


def _gained_at(seen: Map, it: Evidence) -> tuple[Array, bool]:
    return _gained(seen.rest, it.site.values, it.size * it.prior.root, it.explained)


def _gained(rest: Rest, columns: Array, root: Array, explained: Array) -> tuple[Array, bool]:
    """Gains of parts that were left out, and whether they are enough without the best of them."""
    few = rest.seen_in(explained) < CRITERIA.law_few_tests
    gains = rest.gains(columns, root, rest.parts(CRITERIA.law_blocks if few else 1))
    return gains, bool(gains.sum() - gains.max(initial=0.0) >= CRITERIA.law_left_out)


def _coarsest_first(group: tuple[Located, ...]) -> tuple[Located, ...]:
    """The sites of a group, those of more parts of the best one's kind before those of fewer; columns of the table come
    after places of the linkage, at which there are laws to go on with."""
    if not group:
        return ()
    first = next((it for it in group if not _is_column(it)), group[0])
    kind = first.site.kind
    return tuple(
        sorted(group, key=lambda it: (_is_column(it), it.site.kind != kind, -it.site.parts, -it.value))
    )


def _is_column(it: Located) -> bool:
    return it.site.kind.startswith("column")
