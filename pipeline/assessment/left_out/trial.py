"""One bench with an effect that the catalogue does not have, looked at for laws and judged."""

from __future__ import annotations

from time import process_time

import numpy as np

from pipeline.assessment.challenge.laws.outcome import discovered, reference
from pipeline.assessment.left_out.benches import LeftOut, measured
from pipeline.assessment.study import Tried
from pipeline.campaign import Campaign
from pipeline.discover.search import Discovery, Law
from pipeline.inference.fit import unfitted
from pipeline.inference.load_cases import load_cases
from pipeline.selection.adequacy.judgement import judge
from vjm.effects import catalogue


class Trial(Tried):
    """A bench. name: of what is hidden. mu: sigmas by which it shows. told: sigmas beside all that tolerances explain.
    sites: the group of each place that was found, the best first; effects: what entered the model. right: whether a
    place is that of what is hidden, or, where there is none, that none was told without doubt. doubted: whether more
    than noise is left beside the places, which is told then. held_out: whitened RMS, together, of the tests held out
    that see it, by the model with what was found; None where there is none. error: why there is no answer. seconds: of
    the search."""

    number: int
    name: str
    mu: float = 0.0
    told: float = 0.0
    sites: tuple[tuple[str, ...], ...] = ()
    forms: tuple[str, ...] = ()
    effects: tuple[str, ...] = ()
    right: bool = False
    doubted: bool = False
    held_out: float | None = None
    error: str = ""
    seconds: float = 0.0


def trial(number: int, name: str, commit: str, code: str) -> Trial:
    """The bench of that number."""
    common = {"number": number, "name": name, "commit": commit, "code": code}
    try:
        it, campaign = measured(number)
        began = process_time()
        found = discovered(campaign, it.entry.effect)
        seconds = round(process_time() - began, 2)
    except (RuntimeError, ArithmeticError, ValueError) as error:
        return Trial(**common, error=f"{type(error).__name__}: {error}")
    doubted = bool(found.laws) and not judge(unfitted(found.end.model, load_cases(campaign))).noise
    groups = tuple(tuple(each.site.name for each in law.group) for law in found.laws)
    return Trial(
        **common,
        mu=it.mu,
        told=_told(it, campaign),
        sites=groups,
        forms=tuple(law.ways[0].formed.form.name if law.ways else "" for law in found.laws),
        effects=tuple(n for n in found.end.model.names if n in catalogue()),
        right=is_right(it, found.laws, doubted),
        doubted=doubted,
        held_out=_held_out(it, campaign, found),
        seconds=seconds,
    )


def is_right(it: LeftOut, laws: tuple[Law, ...], doubted: bool) -> bool:
    """Of a law: whether a place of its own is in the group of the first. Of what is none: whether no place of the
    linkage is told, or with the doubt whether it is one."""
    groups = [[each.site for each in law.group] for law in laws]
    if not it.entry.a_law:
        return doubted or not any(not law.site.kind.startswith("column") for law in laws)
    return bool(groups) and any(
        site.kind in it.entry.kinds or site.name in it.entry.kinds for site in groups[0]
    )


def _told(it: LeftOut, campaign: Campaign) -> float:
    """Sigmas by which it shows beside all that the tolerances of the bench explain, for its price in them."""
    rest = reference(campaign)
    return float(np.linalg.norm(rest.weakened(rest.seen(it.shown))))


def _held_out(it: LeftOut, campaign: Campaign, found: Discovery) -> float | None:
    if not it.seen:
        return None
    whole = load_cases(campaign)
    left = unfitted(found.end.model, whole).residual.left
    tests = [k for k, test in enumerate(campaign.tests) if test.id in it.seen]
    rows = np.isin(whole.test, tests)
    return float(np.sqrt(np.mean(left[rows][whole.predicted[rows]] ** 2)))
