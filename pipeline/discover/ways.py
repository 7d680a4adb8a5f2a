"""The forms of a law at one place that explain as much through the mechanism."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pipeline.callbacks import OnProgress
from pipeline.discover.coordinate_noise import at_known_inputs
from pipeline.discover.elements import elements
from pipeline.discover.evidence import Rest
from pipeline.discover.forming import Formed, columns_of, formed
from pipeline.discover.locating import Map
from pipeline.discover.through import Through, through
from pipeline.inference.load_cases import LoadCases
from pipeline.selection.criteria import CRITERIA

FASTER = {"bounded": 0, "linear": 0, "power": 1, "exponential": 2}
"""Times that a form is to be better by what is preferred, by how it grows beyond the loads."""


def unexplained(seen: Map) -> float:
    """Chi-square from which a law leaves as much as the model without it: none is there."""
    return seen.found.chi_square - CRITERIA.law_proposed


def ways_of(
    seen: Map, first: list[Formed], cases: LoadCases, name: str, on_progress: OnProgress
) -> tuple[Through, ...]:
    """Forms through the mechanism: the best that explains anything there of those where influences are known, then all
    near ones about where that stands."""
    base, before = seen.found.model, unexplained(seen)
    done: dict[str, Through] = {}
    for each in first[: CRITERIA.law_forms]:
        on_progress(f"{each.form.title} through the mechanism")
        done[each.form.name] = through(each, base, cases, name)
        if done[each.form.name].cost < before:
            break
    else:
        return ()
    about = list(done.values())[-1]
    for other in _about(about, seen.rest)[: CRITERIA.law_forms]:
        if other.form.name not in done:
            on_progress(f"{other.form.title} through the mechanism")
            done[other.form.name] = through(other, base, cases, name)
    ordered = sorted((way for way in done.values() if way.cost < before), key=lambda way: way.cost)
    if not ordered:
        return ()
    tied = [way for way in ordered if way.cost <= ordered[0].cost + CRITERIA.law_alike]
    # Of those that are as good, what stays finite or grows linearly beyond the loads comes before a power, and that
    # before an exponential.
    return tuple(
        sorted(tied, key=lambda way: way.cost + CRITERIA.law_preferred * FASTER[way.formed.form.grows])
    )


def _about(way: Through, noise: Rest) -> list[Formed]:
    """Forms near the best, fitted anew about the fit with one of them, whose loads and coordinates are nearer to those
    that are there."""
    here = at_known_inputs(way.fit)
    old, rest = way.formed.site, Rest.of(here.residual)
    rest = rest if noise.correlated is None else rest.with_noise(noise.correlated)
    places = {(each.kind, each.place) for each in old.elements}
    some = tuple(each for each in elements(here) if (each.kind, each.place) in places)
    site, form = replace(old, elements=some), way.there
    done = columns_of(form.form, site, rest, form.shapes) @ form.amplitudes
    largest = max(float(np.max(np.abs(each.coordinate))) for each in some)
    return _near(formed(site, replace(rest, residuals=rest.residuals + done), largest))


def _near(every: list[Formed]) -> list[Formed]:
    return [it for it in every if it.cost <= every[0].cost + CRITERIA.law_forms_near]
