"""From a discovery to its record."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from pipeline.answer.law import Curve, Grouped, LawFound, Tie
from pipeline.answer.of_diagnosis import found_noise
from pipeline.answer.record import ModelError
from pipeline.answer.summary import error_of, set_aside_records
from pipeline.answer.value import Value
from pipeline.attempt import Attempts
from pipeline.campaign import Campaign
from pipeline.discover.record import Discovered, Entered
from pipeline.discover.search import Added, Discovery, Law
from pipeline.discover.shape import band, described
from pipeline.discover.sites import Site
from pipeline.discover.through import Through
from pipeline.inference.fit import Fit, unfitted
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.model import Model
from pipeline.parameter_names import path_of
from pipeline.provenance import made_with
from pipeline.selection.adequacy.judgement import judge
from pipeline.selection.criteria import CRITERIA
from vjm.law_sites import SITE_KINDS, SiteKind

Array = NDArray[np.float64]
BAND = 1.96
POINTS = 81
SEEN = 0.05
ENDS = {"base": "at the base", "tip": "at the tip", "1": "of bar 1", "2": "of bar 2"}


def recorded(found: Discovery, campaign: Campaign, seconds: float) -> Discovered:
    """campaign: with its held-out tests, as it was given to the search."""
    attempts, whole = Attempts(), load_cases(found.as_read(campaign))
    errors = [_error(found.given, whole)]
    errors += [_error(found.begin, whole)] if found.bent else []
    laws: list[LawFound] = []
    for step in found.steps:
        if isinstance(step, Law):
            error = _error(step.ways[0].fit, whole) if step.ways else None
            laws.append(_law(step, error, attempts))
    if found.steps:
        errors.append(_error(found.end, whole))
    top = found.last.sites[0] if found.last.sites else None
    return Discovered(
        campaign=whole.campaign.name,
        laws=tuple(laws),
        geometry=found.bent,
        entered=tuple(_entered(step, found.end.model) for step in found.steps if isinstance(step, Added)),
        error=tuple(errors),
        whole=found.whole,
        left=tuple(_no_noise(found, whole)) if found.laws else (),
        next_site=None if top is None else top.site.name,
        next_evidence=found.last.best,
        set_aside=set_aside_records(found.bad),
        noise=tuple(said for each in found.settled for said in found_noise(each, campaign, whole.predicted)),
        not_done=tuple(attempts.failed),
        seconds=round(seconds, 3),
        **made_with(),
        data=dict(whole.campaign.digests),
    )


def _no_noise(found: Discovery, whole: LoadCases) -> Iterator[str]:
    """What is left beside all that was found, and is no noise, in words."""
    for check in judge(unfitted(found.end.model, whole)).checks:
        if not check.passed:
            yield check.words


def _error(fitted: Fit, whole: LoadCases) -> ModelError:
    """What a model leaves of the fitted tests and of those that were held out."""
    return error_of(unfitted(fitted.model, whole), whole, fitted.numbers)


def _entered(step: Added, model: Model) -> Entered:
    own = next(term for term in model.terms if term.effect.name == step.body.effect.name)
    return Entered(
        effect=own.effect.name,
        evidence=step.body.value,
        sites=tuple(it.site.name for it in step.sites),
        parameters=dict(own.values),
    )


def _law(step: Law, error: ModelError | None, attempts: Attempts) -> LawFound:
    chosen = step.ways[0] if step.ways else None
    coordinate = np.concatenate([step.site.sign(e) * e.coordinate for e in step.site.elements])
    evidence = step.group[0].evidence
    shape = attempts.get("the shape of the curve in words", lambda: described(evidence, coordinate), "")
    form = None if chosen is None else chosen.formed.form
    return LawFound(
        site=step.site.name,
        where=where(step.site.name),
        group=tuple(
            Grouped(site=it.site.name, evidence=it.value - step.evidence)
            for it in step.group
            if it.site.name != step.site.name
        ),
        form=None if form is None else form.name,
        equation=None if form is None else form.equation,
        parameters={} if chosen is None else _values(chosen),
        evidence=step.evidence,
        margin=step.margin if np.isfinite(step.margin) else None,
        left_out=float(step.left_out.sum() - step.left_out.max(initial=0.0)),
        ties=() if chosen is None else tuple(_tie(way, chosen, step) for way in step.ways[1:]),
        range=(float(coordinate.min()), float(coordinate.max())),
        fit=None if error is None else error.fit,
        holdout=None if error is None else error.holdout,
        shape=shape,
        mirrored=step.site.mirrored,
        effects=() if form is None else form.effects.get(step.site.kind, ()),
        curve=attempts.get("the curve", lambda: _curve(step, chosen, coordinate), None),
    )


def where(site: str) -> str:
    """A site in words."""
    kind, _, tags = site.partition("@")
    title = (
        SITE_KINDS[kind].title if kind in SITE_KINDS else f"the readings of {kind.removeprefix('column ')}"
    )
    return ", ".join([title, *(ENDS.get(tag, tag) for tag in tags.split(".") if tag)])


def _values(way: Through) -> dict[str, Value]:
    model, out = way.fit.model, {}
    std = {each.name: float(s) for each, s in zip(model.free, way.fit.std, strict=True)}
    for p in way.law.parameters:
        name, value = path_of(way.law.name, p.name), way.values[p.name]
        own = std.get(name, np.inf)
        seen = np.isfinite(own)
        out[p.name] = Value(
            value=value,
            std=own if seen else None,
            low95=value - BAND * own if seen else None,
            high95=value + BAND * own if seen else None,
            interval="wald" if seen else "undetermined",
            unit=p.unit,
            meaning=p.meaning,
        )
    return out


def _tie(way: Through, chosen: Through, step: Law) -> Tie:
    return Tie(
        form=way.formed.form.name,
        equation=way.formed.form.equation,
        parameters=way.values,
        cost=way.cost - chosen.cost,
        beyond=beyond(way, chosen, step),
    )


def beyond(way: Through, other: Through, step: Law) -> float:
    """Sigmas by which two forms foretell otherwise at 1.5 times the largest coordinate, on the way there from rest, at
    the load step that shows the site best."""
    ends = np.array([-1.0, 1.0]) * CRITERIA.law_beyond * way.formed.largest
    off = 0.0
    for end in ends:
        along = np.linspace(0.0, end, POINTS)
        first = np.array([0, along.size])
        values = [it.there.says(along, first)[-1] for it in (way, other)]
        off = max(off, abs(float(values[0] - values[1])))
    rest = step.map.rest
    total = np.sum([each.influence for each in step.site.elements], axis=0)
    strength = np.sqrt(np.bincount(rest.rows, total**2))
    return off * float(strength.max())


def _curve(step: Law, chosen: Through | None, coordinate: Array) -> Curve:
    found, rest = step.group[0].evidence, step.map.rest
    at, free, spread = band(found, rest, float(coordinate.min()), float(coordinate.max()))
    kind = _kind(step.site)
    x = y = np.zeros(0)
    if chosen is not None:
        x = np.linspace(coordinate.min(), coordinate.max(), POINTS)
        there = chosen.there
        if there.form.memory:
            x = np.concatenate([x[x >= 0.0], x[::-1], x])
        y = there.says(x, np.array([0, x.size]))
    own_x, own_y = _by_steps(step)
    units = ("", "") if kind is None else (kind.over, kind.gives)

    def points(values: Array) -> tuple[float, ...]:
        return tuple(float(value) for value in values)

    return Curve(
        x_unit=units[0],
        y_unit=units[1],
        x=points(x),
        y=points(y),
        free_x=points(at),
        free=points(free),
        low=points(free - BAND * spread),
        high=points(free + BAND * spread),
        own_x=points(own_x),
        own_y=points(own_y),
    )


def _kind(site: Site) -> SiteKind | None:
    return SITE_KINDS.get(site.kind)


def _by_steps(step: Law) -> tuple[Array, Array]:
    """What each load step says of the law by itself: coordinate and value, of those that see the site by a twentieth of
    the one that sees it best. The other elements take part with the sign of their coordinates, as of an odd law."""
    rest = step.map.plain.rest
    some, count = step.site.elements, int(rest.first[-1])
    signs = np.array([step.site.sign(each) for each in some])
    at = signs[:, None] * np.array([each.coordinate for each in some])
    through = signs[:, None] * np.array([each.influence for each in some])
    gains = np.array([np.bincount(rest.rows, each**2, minlength=count) for each in through])
    leading = at[np.argmax(gains, axis=0), np.arange(count)]
    same = np.where(at * leading < 0.0, -1.0, 1.0)[:, rest.rows]
    total = np.sum(same * through, axis=0)
    gain = np.bincount(rest.rows, total**2, minlength=count)
    said = np.bincount(rest.rows, total * rest.residuals, minlength=count)
    seen = gain > SEEN**2 * gain.max()
    return leading[seen], said[seen] / gain[seen]
