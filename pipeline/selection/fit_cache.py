"""Models of a campaign at their best fit, each kept once it is fitted."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, cached_property, partial

import numpy as np

from pipeline.callbacks import OnProgress
from pipeline.inference.fit import Fit, at_null, fit, unfitted, unmoved, with_own_line
from pipeline.inference.load_cases import LoadCases
from pipeline.inference.model import Model, Term
from pipeline.inference.multistart import best_fit, height
from pipeline.inference.nuisances import beside
from pipeline.inference.parallel_fits import fits_at_once
from pipeline.inference.predicted import Prediction
from pipeline.inference.prediction import predict
from pipeline.inference.residual import residual
from pipeline.inference.sensor_faults import moves
from pipeline.inference.solvers import WORK, Effort, allowance, far
from pipeline.inference.stops import sided
from pipeline.inference.subsets import at_rows, carried, rows_in
from pipeline.parameter_names import parted, path_of
from pipeline.selection.criteria import CRITERIA, Criteria, refits
from pipeline.selection.first_order import FirstOrder, Rescue, first_order, unlooked
from pipeline.selection.signatures import (
    Look,
    Probe,
    hidden,
    look,
    probed,
    probes,
    signatures,
    smooth_signatures,
)
from vjm.effects.base import Effect
from vjm.work import TooMuch, spent

Names = frozenset[str]


@dataclass(eq=False)
class FitCache:
    """Fits of the base model with sets of added effects, and the pictures about them.

    candidates: by name, in the order in which they enter a model. tried: sets that were fitted from where a larger one
    stands, and that one. looks: what `left_without` found. ends: work (`vjm.work`) after which nothing new is
    begun, but `TooMuch` raised. known: fits of the same campaign, model and candidates that need not be made again.
    before: fits of the same sets to other readings of the same tests, from which these begin. since: work that was done
    when the first of them was made. rival: chi-square that something else leaves; a fit that stays far above it ends.
    """

    whole: LoadCases
    base: Model
    candidates: Mapping[str, Effect]
    on_progress: OnProgress
    criteria: Criteria = CRITERIA
    fits: dict[Names, Fit] = field(default_factory=dict)
    first_orders: dict[Names, FirstOrder] = field(default_factory=dict)
    tried: set[tuple[Names, Names]] = field(default_factory=set)
    looks: dict[tuple[Names, str], float] = field(default_factory=dict)
    ends: float = np.inf
    known: FitCache | None = None
    before: FitCache | None = None
    since: float = field(default_factory=spent)
    rival: float = np.inf
    at: Look = field(init=False)

    def __post_init__(self) -> None:
        self.since = self.since if self.before is None else self.before.since
        self.at = look(self.whole, self.criteria.screened_steps)

    @property
    def evaluations(self) -> int:
        """Solutions of the campaign that all fits took."""
        return sum(each.evaluations for each in self.fits.values()) + len(self.looks)

    @property
    def room(self) -> int:
        """Numbers that a set may have: readings less unknown zeros and the numbers of the base model."""
        return self.fit(frozenset()).degrees

    @property
    def work(self) -> float:
        """That a search of these load cases may take, and the look for mistakes of their table."""
        return self.criteria.search_work * allowance(self.whole)

    @property
    def worn_out(self) -> bool:
        """Whether as much was done about this campaign, whatever its readings: then no further search is begun."""
        return spent() - self.since > self.work

    @property
    def effort(self) -> Effort:
        """What a further fit may take: one that stays far above the best that is known decides nothing."""
        return Effort(known=min([self.rival, *(it.chi_square for it in self.fits.values() if not it.lost)]))

    def affords(self, names: Names) -> bool:
        """Whether a set has no more free numbers than there are readings to fit them to."""
        fixed = self.unseen
        return sum(_free_numbers(self.candidates[name], fixed) for name in names) <= self.room

    @cached_property
    def unseen(self) -> frozenset[str]:
        """Names effect.parameter that stay at null: where readings are few, those that they do not see beside the
        others of their effect, at any plausible size. Where readings are many a fit finds them by itself."""
        if self.known is not None:
            return self.known.unseen
        if self.room > self.criteria.few_readings or self.fit(frozenset()).prediction.lost.any():
            return frozenset()
        shown = self.first_order(frozenset()).signatures
        return frozenset(
            name
            for it in shown.values()
            if not it.probes
            for name in hidden(it, self.base.fixed, self.criteria)
        )

    def order(self, names: Names) -> tuple[str, ...]:
        """Names in the order of the candidates."""
        return tuple(name for name in self.candidates if name in names)

    def fit(self, names: Names, begin: Mapping[str, float] | None = None) -> Fit:
        """The base model with these effects at its best fit. begin: where those with kinks begin."""
        if names not in self._all_known([names]):
            self._begun(self._title(names))
            self.fits[names] = self._no_worse(names, self._fitted(names, begin or {}))
        return self.fits[names]

    def with_own_line(self, names: Names) -> Fit:
        """The fit along its own line of what was written about the rig: for error bars, and for what could be added."""
        self.fits[names] = with_own_line(self.fit(names), self.whole, self.criteria.plausible)
        return self.fits[names]

    def fit_all(self, wanted: Mapping[Names, Mapping[str, float]]) -> None:
        """Fit several sets of which none holds another, each as `fit` does it alone."""
        there = self._all_known(wanted)
        self._fit_all({names: begin for names, begin in wanted.items() if names not in there})

    def fit_anew(self, wanted: Sequence[Names]) -> None:
        """Fit sets as if they had not been, and keep the better fit of each."""
        there = self._all_known(wanted) if self.known else {}
        self._fit_all({names: {} for names in wanted if names not in there})

    def with_candidates(self, candidates: Mapping[str, Effect]) -> FitCache:
        """Nothing looked at yet, with others of the same order; sets of these that were fitted are."""
        fits = {names: found for names, found in self.fits.items() if names <= candidates.keys()}
        return replace(
            self,
            candidates=candidates,
            fits=fits,
            first_orders={},
            looks={},
            tried=set(),
            ends=np.inf,
            known=None,
        )

    def under(self, criteria: Criteria) -> FitCache:
        """As if nothing had been looked at, under other criteria; sets that were fitted have the fits that they have
        here, unless what is changed changes them."""
        if refits(self.criteria, criteria):
            return FitCache(self.whole, self.base, self.candidates, self.on_progress, criteria)
        return replace(
            self,
            criteria=criteria,
            fits={},
            first_orders={},
            looks=dict(self.looks),
            tried=set(self.tried),
            ends=np.inf,
            known=self,
        )

    def _all_known(self, wanted: Iterable[Names]) -> Mapping[Names, Fit]:
        """All fits, with those of the wanted sets that were made under other criteria."""
        if self.known is not None:
            own = self.known.fits
            self.fits |= {names: own[names] for names in wanted if names in own and names not in self.fits}
        return self.fits

    def _fit_all(self, new: Mapping[Names, Mapping[str, float]]) -> None:
        # What takes longest is begun first: rows that choose their side, then other kinks.
        every = sorted(new, key=self.quickness)
        while every:
            self._begun(self._title(every[0]) + (f" and {len(every) - 1} more" if len(every) > 1 else ""))
            # No more at once than there is work left for: where one ends the search, none runs beside it in vain.
            count = max(1.0, min(len(every), (self.ends - spent()) / (WORK * allowance(self.whole))))
            order, every = every[: int(count)], every[int(count) :]
            calls = [(self._model(names), partial(self._fitted, names, new[names])) for names in order]
            made = dict(zip(order, fits_at_once(calls, self.whole), strict=True))
            for names in new:
                if names in made:
                    self._keep(names, self._no_worse(names, made[names]))

    def fit_again(self, wanted: Sequence[Names], larger: Names) -> None:
        """Fit sets from where a set that holds them stands, and keep the better fit of each that has one."""
        there = self.fit(larger)
        new = {n: self._model(n) for n in wanted if (n, larger) not in self.tried}
        models = {names: _valued(model, there.model) for names, model in new.items() if model.free}
        if not models:
            return
        self._begun(f"{self._title(larger)} with one less")
        self.tried |= {(names, larger) for names in models}
        calls = [
            (m, partial(fit, m, self.whole, there.prediction, None, self.criteria.plausible, self.effort))
            for m in models.values()
        ]
        for names, found in zip(models, fits_at_once(calls, self.whole), strict=True):
            self._keep(names, found)

    def _no_worse(self, names: Names, found: Fit) -> Fit:
        """The fit, or a better one from where a set that it contains stands: a larger set never leaves more.

        Of sets that differ by effects with numbers; what is there or not may make things worse. Where no step from
        there is better either, the further effects are at their null: there the two are one.
        """
        inside = [n for n in self.fits if n < names and all(self.candidates[e].parameters for e in names - n)]
        if not inside:
            return found
        best = min(inside, key=lambda n: self.fits[n].order)
        smaller = self.fits[best]
        if found.order <= smaller.order:
            return found
        model = _valued(self._model(names), smaller.model)
        # One that ran out of its work would do so again, and one that no size helps is absent.
        again = (
            found
            if found.ended or not any(each.effect in names - best for each in found.model.free)
            else fit(model, self.whole, smaller.prediction, None, self.criteria.plausible, self.effort)
        )
        count = found.evaluations + (0 if again is found else again.evaluations)
        if again.order <= smaller.order:
            return replace(again, evaluations=count)
        return replace(at_null(model, smaller), evaluations=count, ended=again.ended)

    def _keep(self, names: Names, found: Fit) -> None:
        old = self.fits.get(names)
        if old is None:
            self.fits[names] = found
            return
        best = min(old, found, key=lambda each: each.order)
        self.fits[names] = replace(best, evaluations=old.evaluations + found.evaluations)
        if best is found:
            self.first_orders.pop(names, None)

    def left_without(self, names: Names, name: str) -> float:
        """Chi-square that a fit leaves without one of its effects, after a linear step of what is smooth, in
        `least`s of the fit."""
        if (names, name) not in self.looks:
            self._begun(f"{self._title(names)} without {name}")
            found = self.fit(names)
            rows, own = self.whole.by_role[0]
            start = at_rows(found.prediction, self.whole, own, rows)
            left = height(*beside(found.model.without(name), own, start), start)
            self.looks[names, name] = left / self.least(names)
        return self.looks[names, name]

    def least(self, names: Names) -> float:
        """Chi-square of a fit, or what noise leaves in the mean where that is more."""
        found = self.fit(names)
        return max(found.chi_square, float(found.degrees), 1.0)

    def first_order(self, names: Names) -> FirstOrder:
        """What could be added to a fit."""
        if self.known is not None and self.known.fits.get(names) is self.fit(names):
            return self.first_orders.setdefault(names, self.known.first_order(names))
        if names not in self.first_orders:
            self._begun(f"what could be added to {self._title(names)}")
            found = self.fit(names)
            # No verdict hangs on the slopes of a model that is far off.
            found = found if far(found.chi_square, found.whitened.size) else self.with_own_line(names)
            every = signatures(found, list(self.candidates.values()), self._probes, self.at, self.on_progress)
            plausible = self.criteria.plausible
            self.first_orders[names] = first_order(found, every, self.at, plausible, self._rescue(found))
        return self.first_orders[names]

    def first_order_about(self, found: Fit, names: Names) -> FirstOrder:
        """What could be added to a fit of a set to the same tests with other readings."""
        cases, every, at = (
            found.residual.load_cases,
            list(self.first_order(names).signatures.values()),
            self.at,
        )
        if not np.array_equal(cases.predicted, self.whole.predicted):
            # Columns or rows that are exchanged are read in other rows: what is known of each reading is not of these.
            smooth = [it.effect for it in every if it.effect.smooth]
            at = look(cases, self.criteria.screened_steps)
            every = smooth_signatures(found, smooth, at) if smooth else []
        return first_order(found, every, at, self.criteria.plausible)

    def _rescue(self, found: Fit) -> Rescue:
        """What a further effect at its typical size makes of lost rows, where the fit has any."""
        if not found.prediction.lost[self.whole.fitted].any():
            return unlooked
        at = found.prediction

        @cache
        def with_typical(name: str) -> float | None:
            effect = self.candidates[name]
            if not effect.parameters or name in found.model.names or not moves(effect, self.whole):
                return None
            self.on_progress(f"{name} at its typical size")
            model = replace(found.model, terms=(*found.model.terms, Term(effect, effect.typicals)))
            there = predict(model, self.whole, slopes=False, start=at)
            there = replace(there, nominal=at.nominal, by_nominal=at.by_nominal)
            return Fit(model, there, residual(self.whole, there), 1).chi_square

        return with_typical

    @cached_property
    def _probes(self) -> list[Probe]:
        if self.known is not None:
            return self.known._probes
        if all(effect.smooth for effect in self.candidates.values()):
            # The rows before need none made for these.
            return []
        there, new = [], list(self.candidates.values())
        rows = None if self.before is None else rows_in(self.whole, self.before.whole)
        if self.before is not None and rows is not None:
            # What an effect does hangs on the tests, not on what was read.
            there = [
                replace(it, change=it.change[rows])
                for it in self.before._probes
                if it.effect.name in self.candidates
            ]
            new = [it for it in new if it.name not in self.before.candidates]
        return [*there, *probes(self.base, new, self.whole, self.criteria.plain_probe, self.on_progress)]

    def _fitted(self, names: Names, begin: Mapping[str, float]) -> Fit:
        old = None if self.before is None else self.before.fits.get(names)
        if old is not None and (same := unmoved(old, self.whole)) is not None:
            return same
        effects = [self.candidates[name] for name in self.order(names)]
        model, start, known = self._begin(names)
        if not model.free:
            return unfitted(model, self.whole, start)
        effects = [e for e in effects if e.name not in known]
        kinked = [e for e in effects if not e.smooth]
        new = [e.name for e in effects]
        # A probe says nothing of sizes below it, and rows that chose their side from there may stay on the wrong one.
        if not kinked or any(sided(e) or e.name not in begin for e in kinked):
            return best_fit(model, self.whole, new, start, None, self.criteria.plausible, self.effort)
        for effect in kinked:
            model = probed(model, effect, begin[effect.name])
        return fit(model, self.whole, start, None, self.criteria.plausible, self.effort)

    def _begun(self, what: str) -> None:
        if spent() > self.ends:
            raise TooMuch(f"nothing new is begun at {what}")
        self.on_progress(what)

    def _title(self, names: Names) -> str:
        return " + ".join(self.order(names)) or "the model as it is"

    def quickness(self, names: Names) -> tuple[bool, bool]:
        """Larger for sets that take less time to fit: rows that choose their side take most."""
        effects = [self.candidates[name] for name in names]
        return not any(map(sided, effects)), all(effect.smooth for effect in effects)

    def _model(self, names: Names) -> Model:
        base = self.base
        if names and any(self.candidates[name].parameters for name in names):
            own = {name for name in self.unseen if parted(name)[0] in names}
            base = replace(base, fixed=base.fixed | own)
        return base.with_effects([self.candidates[name] for name in self.order(names)])

    def _begin(self, names: Names) -> tuple[Model, Prediction | None, Names]:
        """The model with values of the best of the largest sets that were fitted already, where that one stood, and
        the set."""
        model = self._model(names)
        if self.before is not None and names in self.before.fits:
            old = self.before.fits[names]
            start = carried(old.prediction, self.whole, self.before.whole)
            if start is not None:
                return _valued(model, old.model), start, names
        inside = [each for each in self.fits if each < names]
        if not inside:
            return model, None, frozenset()
        largest = max(inside, key=lambda each: (len(each), -self.fits[each].chi_square))
        known = self.fits[largest]
        start = known.prediction
        if known.rms > self.criteria.far and start.nominal.size:
            # As a model that is far off wants what was written, it is not.
            start = replace(start, nominal=np.zeros(0), by_nominal=start.by_nominal[..., :0])
        return _valued(model, known.model), start, largest


def _free_numbers(effect: Effect, fixed: frozenset[str]) -> int:
    return sum(path_of(effect.name, p.name) not in fixed for p in effect.parameters)


def _valued(model: Model, other: Model) -> Model:
    """A model with the values that another one has of the numbers of both."""
    old = {f.name: v for f, v in zip(other.free, other.values, strict=True)}
    values = [old.get(f.name, v) for f, v in zip(model.free, model.values, strict=True)]
    return model.at(np.array(values))
