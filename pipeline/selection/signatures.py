"""What every candidate would do to the readings, in sigmas, about a fit: from derivatives, or probes without them.

A smooth effect has the derivative at its null. One with kinks (play, friction, yield) has none that says anything:
it is put in at the sizes that it names and the difference of the predictions is taken, on lumped bars, for a look is
all that it serves.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import qr

from pipeline.callbacks import OnProgress
from pipeline.inference.fit import Fit
from pipeline.inference.load_cases import LoadCases
from pipeline.inference.model import Model
from pipeline.inference.predicted import Prediction
from pipeline.inference.prediction import predict
from pipeline.inference.residual import residual, whitening
from pipeline.inference.subsets import at_rows
from pipeline.parameter_names import path_of
from pipeline.processors import at_once
from pipeline.selection.criteria import Criteria
from vjm.effects.base import Effect, Parameter
from vjm.effects.sensor_fault import SensorFault

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Signature:
    """Whitened columns (N, p), one for each number of the effect, in typical sizes; for an effect with kinks one
    column (N, 1) for each of `probes`. low: (p,) least multiple that has a meaning, 0 or -inf.
    """

    effect: Effect
    columns: tuple[Array, ...]
    low: Array
    probes: tuple[float, ...] = ()

    @property
    def sizes(self) -> list[float]:
        """Typical sizes from null that each of all columns stands for."""
        if not self.probes:
            return [1.0] * sum(each.shape[1] for each in self.columns)
        first = self.effect.parameters[0]
        return [(value - first.null) / first.typical for value in self.probes]


def hidden(it: Signature, fixed: Collection[str], criteria: Criteria) -> list[str]:
    """Names effect.parameter that a smooth effect's own others make needless.

    What is seen of it, at plausible sizes, is spanned by the columns that show most (QR with pivots).
    """
    names = [path_of(it.effect.name, p.name) for p in it.effect.parameters]
    free = [name for name in names if name not in fixed]
    (columns,) = it.columns
    triangle, order = qr(columns * criteria.plausible, mode="r", pivoting=True)
    sizes = np.abs(np.diag(triangle))
    kept = {int(order[k]) for k in np.flatnonzero(sizes > criteria.hidden_share * sizes.max(initial=0.0))}
    return [name for k, name in enumerate(free) if k not in kept]


@dataclass(frozen=True, eq=False)
class Look:
    """Rows that are looked at: numbers (r,) in the whole campaign, and those rows as a campaign of their own."""

    rows: np.ndarray
    load_cases: LoadCases


def look(whole: LoadCases, enough: int) -> Look:
    """At most about `enough` rows, equally spaced within each fitted test, with its first and last."""
    share = min(1.0, enough / max(int(whole.fitted.sum()), 1))
    kept = []
    for number, test in enumerate(whole.campaign.tests):
        if test.role == "fit":
            count = test.data.steps.size
            some = np.linspace(0, count - 1, max(3, round(share * count))).round().astype(int)
            kept.append(whole.first[number] + np.unique(some))
    rows = np.concatenate(kept)
    return Look(rows, whole.only(rows))


ROUGHLY = 1
"""Order of differences: a thousandth is near enough for a look."""


PARTS = 2
"""Of the candidates, looked at at once: as many whatever the processors, so that digits do not depend on them."""


def smooth_signatures(found: Fit, effects: Sequence[Effect], at: Look) -> list[Signature]:
    """Derivatives beside the null of each effect, on the rows of a look; all at null together change nothing.

    At the inputs of the fit: the noise of the measured ones would be in the derivatives as it is in the residuals.
    """
    parts = [effects[k::PARTS] for k in range(min(PARTS, len(effects)))]
    columns = at_once([partial(_columns, found, part, at) for part in parts])
    every = {
        e.name: own
        for part, some in zip(parts, columns, strict=True)
        for e, own in zip(part, some, strict=True)
    }
    lows = {e.name: np.array([0.0 if p.one_sided else -np.inf for p in _free(found, e)]) for e in effects}
    return [Signature(effect, (every[effect.name],), lows[effect.name]) for effect in effects]


def _columns(found: Fit, effects: Sequence[Effect], at: Look) -> list[Array]:
    """(N, p) of each effect."""
    model = found.model.with_effects(effects)
    start = at_rows(found.prediction, found.residual.load_cases, at.load_cases, at.rows)
    predicted = predict(model, at.load_cases, start=start, shift=start.shift, order=ROUGHLY)
    slopes = residual(at.load_cases, predicted).slopes
    used = at.load_cases.predicted & at.load_cases.fitted[:, None]
    out = []
    for effect in effects:
        mine = [k for k, each in enumerate(model.free) if each.effect == effect.name]
        typical = np.array([model.free[k].parameter.typical for k in mine])
        out.append((slopes[..., mine] * typical)[used])
    return out


def _free(found: Fit, effect: Effect) -> list[Parameter]:
    """Numbers of an effect that a fit with it may move."""
    return [p for p in effect.parameters if path_of(effect.name, p.name) not in found.model.fixed]


@dataclass(frozen=True, eq=False)
class Probe:
    """Readings (R, C) with an effect of the first number at `value`, less those without; zero in lost rows and in
    those that may not be fitted."""

    effect: Effect
    value: float
    change: Array


def probes(
    base: Model, effects: Sequence[Effect], whole: LoadCases, plain: float, on_progress: OnProgress
) -> list[Probe]:
    """Of every effect with kinks, on the base model without what is there or not: lumped bars are quick.

    An effect that cannot be without another is compared with that one: the difference is its own.
    """
    bare = replace(base, terms=tuple(t for t in base.terms if t.effect.parameters))
    out: list[Probe] = []
    rows, own = whole.by_role[0]
    without: dict[tuple[str, ...], Prediction] = {}
    known = {effect.name: effect for effect in (*effects, *(term.effect for term in base.terms))}
    for effect in effects:
        if effect.smooth or any(name not in known for name in effect.includes):
            continue
        besides = bare.with_effects([known[name] for name in effect.includes if name not in bare.names])
        if effect.includes not in without:
            without[effect.includes] = predict(besides, own, slopes=False)
        for it in _probes_of(effect, besides, without[effect.includes], own, plain, on_progress):
            change = np.zeros(whole.measured.shape)
            change[rows] = it.change
            out.append(replace(it, change=change))
    return out


def _probes_of(
    effect: Effect, besides: Model, without: Prediction, own: LoadCases, plain: float, on_progress: OnProgress
) -> list[Probe]:
    """The weakest first, up to one that is plain; stronger ones cost most and tell no more.

    own: rows to fit. plain: sigmas of all readings together.
    """
    out = []
    weights = whitening(own, without)
    used = own.predicted
    # The fault of a sensor leaves the linkage where it is, or nearly so.
    near = without if isinstance(effect, SensorFault) else None
    for value in effect.probes:
        on_progress(f"{effect.name} at {value:g}")
        model = probed(besides.with_effects([effect]), effect, value)
        there = predict(model, own, slopes=False, start=near, order=0)
        lost = (there.lost | without.lost)[:, None]
        out.append(Probe(effect, value, np.where(lost, 0.0, there.values - without.values)))
        if np.linalg.norm(weights.apply(np.where(used, out[-1].change, 0.0))[used]) > plain:
            break
    return out


def probed_signatures(found: Fit, looks: Sequence[Probe], at: Look) -> list[Signature]:
    """The probes' changes, weighed as the fit's own residual is."""
    whole = found.residual.load_cases
    weights = whitening(whole, found.prediction)
    used = whole.predicted & whole.fitted[:, None]
    out: dict[str, Signature] = {}
    for it in looks:
        column = weights.apply(np.where(used, it.change, 0.0))[at.rows][used[at.rows]][:, None]
        old = out.get(it.effect.name, Signature(it.effect, (), np.zeros(1)))
        out[it.effect.name] = replace(old, columns=(*old.columns, column), probes=(*old.probes, it.value))
    return list(out.values())


def probed(model: Model, effect: Effect, value: float) -> Model:
    """The model with the first number of an effect at a value, within its bounds."""
    values = model.values
    for k, each in enumerate(model.free):
        if each.effect == effect.name and each.parameter is effect.parameters[0]:
            values[k] = float(np.clip(value, *each.bounds))
    return model.at(values)


def signatures(
    found: Fit, candidates: Sequence[Effect], looks: Sequence[Probe], at: Look, on_progress: OnProgress
) -> list[Signature]:
    """Of every candidate that the fit does not have yet and that changes anything at all."""
    on_progress("what every candidate would do")
    smooth = [e for e in candidates if e.smooth and e.parameters and e.name not in found.model.names]
    out = smooth_signatures(found, smooth, at) if smooth else []
    out += [s for s in probed_signatures(found, looks, at) if s.effect.name not in found.model.names]
    shown = [it for it in out if any(np.any(columns) for columns in it.columns)]
    return out if found.prediction.lost.any() else shown
