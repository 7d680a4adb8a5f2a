"""Which sets the data exclude: one by one, several together, and by the numbers that the data see."""

from __future__ import annotations

from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.selection import exclusion, few_rows, rivals
from pipeline.selection.cost import seen, taken
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.exclusion import possible
from pipeline.selection.few_rows import fit_together
from pipeline.selection.first_order_costs import Estimate
from pipeline.selection.fit_cache import FitCache, Names
from tests.pipeline.selection.bench import AXIAL, MIXED, bench
from vjm.effects import catalogue

BEST = frozenset({"modulus_error"})


def kept(monkeypatch: pytest.MonkeyPatch, gaps: dict[str, float]) -> set[str]:
    """Which of these sets, "a+b" to their gaps, remain beside the best one."""
    of = {frozenset(names.split("+")): value for names, value in gaps.items()}
    monkeypatch.setattr(exclusion, "worse", lambda cache, rival, best: of[rival])
    monkeypatch.setattr(exclusion, "needed", lambda cache, rival, best: CRITERIA.exclusion)
    found = possible(cast(FitCache, SimpleNamespace(criteria=CRITERIA)), [*of, BEST, frozenset[str]()], BEST)
    return {"+".join(sorted(names)) for names in found}


def test_one_rival_is_excluded_by_its_own_gap(monkeypatch: pytest.MonkeyPatch) -> None:
    assert kept(monkeypatch, {"a": 4.9, "b": 5.1}) == {"a"}


def test_rivals_that_are_alike_are_excluded_together_or_not_at_all(monkeypatch: pytest.MonkeyPatch) -> None:
    """Three at 5.1 weigh 2.9 times what one may; two of them named leave one that weighs less than that."""
    assert kept(monkeypatch, {"a": 5.1, "b": 5.2, "c": 5.3}) == {"a", "b"}
    # exp(-1.25) of what one may, each.
    assert kept(monkeypatch, {"a": 7.5, "b": 7.5, "c": 7.5}) == set()
    assert len(kept(monkeypatch, dict.fromkeys("abcdef", 7.5))) == 3


def test_a_set_counts_once_whatever_is_added_to_it(monkeypatch: pytest.MonkeyPatch) -> None:
    assert kept(monkeypatch, {"a": 5.1, "a+b": 5.2, "a+c": 5.3}) == set()
    # Far by itself and near only with another: the pair is what counts.
    assert kept(monkeypatch, {"a": 90.0, "a+b": 5.1, "c": 5.2, "modulus_error+b": 5.0}) == {"a+b"}


@pytest.mark.parametrize(("beyond", "looked_at"), [(0.0, True), (4.0, True), (6.0, False)])
def test_beside_a_set_that_explains_nothing_only_what_may_explain_is_looked_at(
    monkeypatch: pytest.MonkeyPatch, beyond: float, looked_at: bool
) -> None:
    """A rival that promises 20 more than the best set costs, where 25 are allowed, is of no use if the best one leaves
    more than 5 beyond noise: it would leave more than noise as well."""
    best, rival = frozenset("ab"), frozenset("ac")
    costs = {best: 100.0, frozenset("a"): 200.0, frozenset("b"): 200.0, rival: 120.0}
    fitted: list[Names] = []
    effect = SimpleNamespace(parameters=(None,))
    cache = SimpleNamespace(
        candidates=dict.fromkeys("abc", effect), fits=[best], fit_all=fitted.extend, criteria=CRITERIA
    )
    monkeypatch.setattr(rivals, "few", lambda _: False)
    monkeypatch.setattr(rivals, "excess", lambda _, names: beyond)
    monkeypatch.setattr(rivals, "cost", lambda _, names: costs[names])
    monkeypatch.setattr(rivals, "taken", lambda _, names: len(names))
    monkeypatch.setattr(rivals, "possible", lambda *_: [])
    monkeypatch.setattr(rivals, "fit_from", lambda *_: None)
    monkeypatch.setattr(rivals, "raw", lambda _, e: e.cost)
    monkeypatch.setattr(
        rivals,
        "estimates",
        lambda _, start, __: [Estimate(start | {"c"}, costs[rival], {})] * (start < rival),
    )
    assert rivals.with_rivals(cast(FitCache, cache), best).best == best
    # What is exchanged for a rival is left out first.
    assert fitted[:2] in ([frozenset("a"), frozenset("b")], [frozenset("b"), frozenset("a")])
    assert fitted[2:] == [rival] * looked_at


def test_more_numbers_have_to_show_more() -> None:
    """Six of them take up 22.5 of noise one time in a thousand; what has fewer needs one less for each."""
    apart, least = CRITERIA.apart, CRITERIA.exclusion
    assert apart(0) == least and apart(-2) == least - 2.0
    assert apart(6) == pytest.approx(22.5, abs=0.1)
    noise = np.random.default_rng(3).chisquare(3, size=100_000)
    assert np.mean(noise > apart(3)) == pytest.approx(0.001, abs=0.0004)


def test_numbers_that_the_data_do_not_see_take_no_degree() -> None:
    """Six compliances of the base: loads along the bars alone show fewer than tests in several directions do."""
    base: Names = frozenset({"base_compliance"})
    counts = []
    for ids in (AXIAL[:1], MIXED):
        cases = load_cases(bench("base_compliance.x_mm_per_N", 3e-6, ids))
        cache = FitCache(cases, Model(), catalogue(), lambda _: None)
        counts.append(seen(cache, base))
        assert seen(cache, frozenset({"bar_geometric_nonlinearity"})) == 1 and seen(cache, frozenset()) == 0
    assert 1 <= counts[0] < counts[1] <= taken(cache, base) == 6


class Few:
    """A cache of fits that are not made: those that are asked for are written down."""

    candidates = catalogue()

    def __init__(self, *fits: str) -> None:
        self.fits = {frozenset(names.split("+")): None for names in fits}
        self.asked: list[str] = []

    def fit(self, names: Names, _: object) -> None:
        """Written down only."""
        self.asked.append("+".join(sorted(names)))


def test_what_explains_only_together_is_fitted_beside_one_of_many_numbers(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Three numbers of a tilt may hide a bow, two, with another modulus, one; not a bow with six compliances."""
    more = ("modulus_error", "base_compliance", "joint_torsional_stiffness")
    cache = Few("mounting_tilt", "bar_initial_bow", "self_weight")

    def estimates(_: FitCache, start: Names, counts: tuple[int, ...]) -> list[Estimate]:
        assert counts == (1,)
        return [Estimate(start | set(names), 0.0, {}) for names in ([], *([name] for name in more))]

    monkeypatch.setattr(few_rows, "estimates", estimates)
    monkeypatch.setattr(few_rows, "is_noise", lambda _, names: names == {"mounting_tilt"})
    monkeypatch.setattr(few_rows, "leading", lambda _, sets: sorted(sets, key=sorted))
    fit_together(cast(FitCache, cache), frozenset({"mounting_tilt"}))
    assert cache.asked == ["bar_initial_bow+modulus_error", "bar_initial_bow+joint_torsional_stiffness"]
