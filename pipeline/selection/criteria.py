"""Every threshold by which a diagnosis chooses, in one record: what it is, its unit, and where its value is from.

A threshold of "own" source was set by the founders on benches with a known hidden effect; what hangs on each is shown
by the sensitivity study (`pipeline.assessment.sensitivity`), which doubles and halves them one by one. Tolerances of
solvers are no criteria and stand where the solver is.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from functools import cache
from typing import Any

from scipy.stats import chi2

from pipeline.selection.criterion import CHANCE, CHI2, COUNT, FACTOR, SHARE, SIGMA, Criterion, criterion
from pipeline.selection.law_criteria import LawCriteria
from pipeline.selection.table_criteria import TableCriteria


@dataclass(frozen=True)
class Criteria(TableCriteria, LawCriteria):
    """All thresholds of the choice. `of` lists them with their meaning; `dataclasses.replace` changes one."""

    # What noise may do.
    false_alarm: float = criterion(
        0.005,
        CHANCE,
        "evidence",
        "noise alone gets any of the candidates named; each of six checks fails noise with a sixth of it",
        "Bonferroni's bound",
    )
    excess_deviations: float = criterion(
        3.0,
        SIGMA,
        "evidence",
        "standard deviations of chi-square by which noise may exceed its mean before a set leaves more than noise",
        "variance 2 n of chi-square with n degrees of freedom",
    )
    scatter_factor: float = criterion(
        1.15, FACTOR, "evidence", "scatter up to so many sigmas, without any order, is put down to the sigmas"
    )
    negligible: float = criterion(
        0.1, SIGMA, "evidence", "what is left has no order that counts below this: it was computed"
    )
    # When a rival is excluded.
    exclusion: float = criterion(
        5.0,
        CHI2,
        "exclusion",
        "a rival of as many parameters has to be worse by this: the wrong one of two effects is then named in 1.3 % "
        "where the data decide least",
        "Phi(-(mu² (1 - rho²) + 5) / (2 mu sqrt(1 - rho²))) at its largest",
    )
    exclusion_chance: float = criterion(
        0.001,
        CHANCE,
        "exclusion",
        "parameters that an explanation has more than its rival fit so much noise that the rival is excluded",
        "chi-square distribution (S. S. Wilks, Ann. Math. Stat. 9, 1938)",
    )
    exclusion_least: float = criterion(
        2.0, CHI2, "exclusion", "a rival has to be worse by this in any case, however many parameters it has"
    )
    plausible: float = criterion(
        20.0,
        "typical sizes",
        "exclusion",
        "one standard deviation of a parameter before anything was measured: a tilt by 15 degrees explains a heavy "
        "ruler as well as its weight does, and is not what is meant by a tilt",
        fits=True,
    )
    equal_within: float = criterion(
        1e-6, SHARE, "exclusion", "1 - rho, rho the correlation, below which two effects are one"
    )
    confusable_within: float = criterion(
        0.1, SHARE, "plan", "1 - rho below which a candidate is listed as one that looks like a named effect"
    )
    undetermined_rise: float = criterion(
        2.0, CHI2, "exclusion", "a parameter that may be at its null for no more than this is not determined"
    )
    nominal_moved: float = criterion(
        1.0,
        "tolerances",
        "nominals",
        "a number that was written and fits best farther away than this is told",
    )
    nominal_seen: float = criterion(
        0.9,
        SHARE,
        "nominals",
        "of its tolerance, below which the tests say more of a number than was written",
    )
    certain_sigmas: float = criterion(
        10.0,
        SIGMA,
        "certain",
        "times what is left by the best set: an effect is certain where the best set without it is worse by this",
    )
    certain_patterns: int = criterion(
        8,
        COUNT,
        "certain",
        "faults of sensors, at most, that the rest of the best set may need to look like noise",
    )
    certain_more: int = criterion(2, COUNT, "certain", "faults of sensors that a rival may have more")
    certain_new: float = criterion(
        0.1,
        SHARE,
        "certain",
        "of a fault of a sensor, that is left when those that were chosen, or the fault in doubt, are taken out of it",
    )
    certain_rivals: int = criterion(
        2, COUNT, "certain", "sets without an effect, at each of two places, that are looked at instead of it"
    )
    sigma_factor: float = criterion(
        1.5,
        FACTOR,
        "noise",
        "by which the scatter has to differ from a declared sigma to count instead of it",
    )
    sigma_errors: float = criterion(
        5.0, SIGMA, "noise", "standard errors of the scatter by which it has to differ from a declared sigma"
    )
    sigma_errors_unexplained: float = criterion(
        3.0,
        SIGMA,
        "noise",
        "the same where more is left than the declared sigmas allow, so that one of them has to be another",
    )
    sigma_known: float = criterion(
        0.2,
        SHARE,
        "noise",
        "standard error of a scatter, of itself, from which it is too little known to count",
    )
    tails: float = criterion(
        25.0,
        CHI2,
        "noise",
        "by which twice the log likelihood grows from normal noise to Student's before tails are long: 108 to 194 on "
        "long-tailed benches, 0 to 21 on others",
    )
    # How far the search goes.
    far: float = criterion(
        2.0, SIGMA, "search", "root mean square from which a set is far from an explanation"
    )
    slow: float = criterion(
        0.7,
        SHARE,
        "search",
        "growth that leaves more than this part of chi-square far from noise ends the search",
    )
    most_effects: int = criterion(5, COUNT, "search", "effects in a set")
    most_fits: int = criterion(24, COUNT, "search", "fits after which a set grows no further")
    search_work: float = criterion(
        5000.0,
        "work of the solver",
        "search",
        "after which a search of no load step begins no further fit, more where there are more, and a diagnosis no "
        "further search: of the 36 slowest of 600 benches one search is cut, the next takes 0.82 of it",
        fits=True,
    )
    sets_fitted: int = criterion(4, COUNT, "search", "sets of one size that are fitted of those that compete")
    leaders: int = criterion(7, COUNT, "search", "candidates of which pairs are looked at")
    estimate_error: float = criterion(
        0.15, SHARE, "search", "of what an effect explains, by which its first-order estimate may be wrong"
    )
    kinked_estimate_error: float = criterion(
        0.6, SHARE, "search", "the same of an effect with kinks, from a probe"
    )
    competing: float = criterion(
        10.0, CHI2, "search", "beyond the best cost hoped for, up to which a set competes"
    )
    root_gap: float = criterion(
        100.0,
        CHI2,
        "search",
        "beyond the best promise, up to which a set of effects without parameters is a root",
    )
    root_share: float = criterion(0.5, SHARE, "search", "of the best promise, the same")
    hopeless: float = criterion(
        300.0, FACTOR, "search", "the least chi-square of the roots, beyond which a root is left out unseen"
    )
    plain_probe: float = criterion(
        100.0,
        SIGMA,
        "search",
        "of all readings together, from which no stronger probe of an effect is tried",
        fits=True,
    )
    hidden_share: float = criterion(
        1e-3,
        SHARE,
        "search",
        "of the largest column that must be left of another one to be seen beside it",
        fits=True,
    )
    screened_steps: int = criterion(
        200, COUNT, "search", "load steps that a screening of smooth effects needs", fits=True
    )
    few_steps: int = criterion(
        20, COUNT, "search", "load steps up to which sets are grown by everything, side by side"
    )
    few_sets: int = criterion(3, COUNT, "search", "sets that are grown side by side then")
    few_readings: int = criterion(
        24,
        COUNT,
        "search",
        "readings up to which a set has no parameters that they do not see: two of the largest effects take them all",
        fits=True,
    )
    # What a set no longer needs.
    needless: float = criterion(
        4.0,
        FACTOR,
        "pruning",
        "what it has to show: an effect that by its own numbers explains less may be needless",
    )
    kinked_needless: float = criterion(
        100.0, FACTOR, "pruning", "the same of an effect with kinks, whose covariance says less"
    )
    refit_near: float = criterion(
        1.5,
        FACTOR,
        "pruning",
        "the chi-square of a set that one without an effect leaves at most to be fitted twice",
    )
    far_off: float = criterion(
        5.0,
        FACTOR,
        "pruning",
        "the chi-square of a set that it leaves, refitted to first order, without an effect of no parameter: needed",
    )
    elsewhere: float = criterion(
        2.0,
        FACTOR,
        "pruning",
        "what an effect's own numbers say that its loss costs, and the fit ended elsewhere",
    )
    elsewhere_least: float = criterion(2.0, CHI2, "pruning", "more than that, at least")
    # Rivals.
    rival_gap: float = criterion(
        25.0, CHI2, "rivals", "beyond the best cost, up to which an exchange is fitted"
    )
    rivals_fitted: int = criterion(4, COUNT, "rivals", "rivals of one effect that are fitted")
    few_rival_share: float = criterion(
        0.9, SHARE, "rivals", "of what an effect stands for that a rival may miss, where load steps are few"
    )
    held_out_gap: float = criterion(
        25.0,
        CHI2,
        "rivals",
        "beyond the best set, up to which sets are looked at with what only held-out tests show",
    )
    shown: float = criterion(5.0, SIGMA, "rivals", "from which the tests at one angle show an effect")
    not_shown: float = criterion(2.0, SIGMA, "rivals", "below which the tests at all other angles do not")
    # Sensors.
    zero_factor: float = criterion(
        2.5,
        FACTOR,
        "sensors",
        "by which a sensor's zero leaves less than the best set of effects where it comes before all physics: "
        "discrete mistakes take far more off a misfit, an effect that looks a little like one takes less",
    )
    zero_chance: float = criterion(1e-3, CHANCE, "sensors", "noise leaves so much beside a sensor's zero")
    zero_large: float = criterion(20.0, SIGMA, "sensors", "from which a misfit is large")
    zero_left: float = criterion(
        0.01,
        SHARE,
        "sensors",
        "of a large misfit that a zero alone may leave to be settled before anything else",
    )
    zero_sets: int = criterion(12, COUNT, "sensors", "sets of least cost beside which a zero is looked for")
    zero_alone: float = criterion(
        0.01, SHARE, "sensors", "of a constant, below which the model expects nothing of the channel"
    )
    chosen_side: float = criterion(
        5.0, SIGMA, "sensors", "up to which a reading may be what a step chose its side of a play by"
    )
    # What is told about tests that were not done.
    next_test: float = criterion(
        30.0,
        CHI2,
        "plan",
        "between two models in a further test, beyond which more is of no use; half of it tells them",
    )
    fault_share: float = criterion(
        0.5, SHARE, "faults", "of the span that a sensor read, beyond which its zero does not move"
    )
    faults_looked_at: int = criterion(
        3, COUNT, "faults", "faults of sensors that promise most, beside the best set and beside none"
    )
    next_test_sets: int = criterion(3, COUNT, "plan", "rivals for which the next test is sought")
    name_deviations: float = criterion(
        2.33,
        SIGMA,
        "plan",
        "times gamma = 1 / sqrt(1 - rho): size from which the right one of two is named in 95 %",
    )
    detection_power: float = criterion(0.9, CHANCE, "plan", "with which the smallest detected size is let in")
    rival_power: float = criterion(
        0.95, CHANCE, "plan", "with which the smallest distinguished size excludes a rival"
    )

    @property
    def check_level(self) -> float:
        """Probability of each of six checks that noise fails it: truth is refused as seldom as a name is false."""
        return self.false_alarm / 6

    def times(self, name: str, factor: float) -> Criteria:
        """With one threshold so many times as large; a count is at least one."""
        value: Any = getattr(self, name) * factor
        whole = max(1, round(value))
        return replace(self, **{name: whole if isinstance(getattr(self, name), int) else value})

    def of(self) -> Iterator[Criterion]:
        """All of them in their order, those of what is wrong with a table and of laws last."""
        parts = (TableCriteria, LawCriteria)
        for each in sorted(fields(self), key=lambda it: [hasattr(part, it.name) for part in reversed(parts)]):
            yield Criterion(each.name, getattr(self, each.name), **each.metadata["told"])

    def apart(self, more: int) -> float:
        """Chi-square by which a rival has to be worse to be excluded by an explanation that has so many parameters
        more; of one that has fewer, one less for each parameter that it saves."""
        if more <= 0:
            return self.exclusion + more
        return max(self.exclusion, _isf(self.exclusion_chance, more))

    def entry(self, parameters: int, looks: int) -> float:
        """Fall of chi-square below which an effect of so many parameters is not let in, the best of so many looks:
        Bonferroni's bound."""
        return _isf(self.false_alarm / looks, parameters)


def refits(one: Criteria, other: Criteria) -> bool:
    """Whether fits made under one of them have to be made again under the other."""
    fits = [each.name for each in fields(one) if each.metadata["fits"]]
    return any(getattr(one, name) != getattr(other, name) for name in fits)


@cache
def _isf(chance: float, degrees: int) -> float:
    return float(chi2.isf(chance, degrees))


CRITERIA = Criteria()
