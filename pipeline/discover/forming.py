"""What law a site follows: every form fitted where influences are known, before any goes through the mechanism.

A form is linear in its amplitudes, so that they are eliminated (G. Golub, V. Pereyra, SIAM Journal on Numerical
Analysis 10 (1973) 413-432) and its shapes alone are looked for, from several starts. Forms compete by chi-square
+ k ln n, k numbers and n residuals (G. Schwarz, The Annals of Statistics 6 (1978) 461-464).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares, nnls

from pipeline.discover.evidence import Rest
from pipeline.discover.sites import Site
from vjm.forms import forms
from vjm.forms.base import Form
from vjm.law_sites import SITE_KINDS, SiteKind

Array = NDArray[np.float64]
BEYOND = 1.5
"""Times the largest load or coordinate up to which a compliance must rise."""
LOADS = 241
"""At which that is looked at."""
LEVEL = 1e-9
"""Of the whole rise, below which a part of it may be by rounding."""
LEAST = 1e-3
"""Of the mean rise, that one is at least where amplitudes are held to rise."""
LOOKS = 40
"""Evaluations of the shapes from each start, at most."""


@dataclass(frozen=True, eq=False)
class Formed:
    """A form at a site. amplitudes, shapes: as they fit best. left: chi-square that it leaves. numbers: how many of its
    own were fitted. count: residuals. largest: of the site's coordinate."""

    site: Site
    form: Form
    amplitudes: Array
    shapes: Array
    left: float
    numbers: int
    count: int
    largest: float

    @property
    def cost(self) -> float:
        """Chi-square and what its numbers cost."""
        return self.left + self.numbers * float(np.log(self.count))

    @property
    def kind(self) -> SiteKind:
        """Of its site."""
        return SITE_KINDS[self.site.kind]

    @property
    def values(self) -> dict[str, float]:
        """All numbers by their names in the form."""
        names = [q.name for q in self.form.quantities]
        return dict(zip(names, [*self.amplitudes.tolist(), *self.shapes.tolist()], strict=True))

    def says(self, x: Array, first: np.ndarray) -> Array:
        """(R,) along coordinates x (R,) of tests that begin at the rows `first`, under axial loads in proportion."""
        axial = self.load * np.abs(x) / self.largest
        return np.asarray(self.form.columns(x, first, self.shapes, axial) @ self.amplitudes)

    @property
    def load(self) -> float:
        """The greatest axial load of a bar at its site, N; zero where there is none."""
        return greatest_load(self.site)


def greatest_load(site: Site) -> float:
    """Of the bars at the ends that a site is at, N; zero where it is at none."""
    loads = (float(np.max(np.abs(each.axial))) for each in site.elements if each.axial is not None)
    return max(loads, default=0.0)


def formed(site: Site, rest: Rest, largest: float) -> list[Formed]:
    """All forms that a site may follow, the least cost first."""
    found = [it for form in forms().values() if (it := fitted_form(form, site, rest, largest)) is not None]
    return sorted(found, key=lambda it: it.cost)


def fitted_form(form: Form, site: Site, rest: Rest, largest: float) -> Formed | None:
    """A form at its best shapes; None where none is a law, or the site may not follow it."""
    place = "series" if SITE_KINDS[site.kind].series else "parallel"
    if place not in form.places or (form.loaded and not greatest_load(site) > 0.0):
        return None
    best: Formed | None = None
    load = greatest_load(site)
    for start in form.starts(largest):
        for it in _from(form, site, rest, largest, form.under(np.asarray(start, dtype=float), load)):
            if (best is None or it.left < best.left) and _is_law(it):
                best = it
    return best


def _from(form: Form, site: Site, rest: Rest, largest: float, start: Array) -> Iterator[Formed]:
    """From one start: as it is there, and at the best shapes that are found from it."""
    whitened = rest.weakened(rest.residuals)
    free = np.array([q.name not in form.fixed for q in form.shapes], dtype=bool)

    def at(shapes: Array) -> tuple[Array, Array]:
        columns = rest.weakened(columns_of(form, site, rest, shapes))
        amplitudes = _amplitudes(form, columns, whitened)
        slopes = _slopes(form, site, shapes, largest)
        if slopes is not None and np.any(slopes @ amplitudes < 0.0):
            # Not flat either: that is rigid, and no law of a mechanism.
            amplitudes = rising(columns, whitened, slopes - LEAST * slopes.mean(axis=0))
        return amplitudes, whitened - columns @ amplitudes

    def done(shapes: Array) -> Formed:
        amplitudes, off = at(shapes)
        numbers = amplitudes.size + int(free.sum())
        return Formed(site, form, amplitudes, shapes, float(off @ off), numbers, off.size, largest)

    yield done(start)
    if free.any():
        low, high = (np.log(each[free]) for each in form.bounds(largest))

        def off(logs: Array) -> Array:
            shapes = start.copy()
            shapes[free] = np.exp(logs)
            return at(shapes)[1]

        begin = np.clip(np.log(start[free]), low + 1e-6, high - 1e-6)
        found = least_squares(off, begin, bounds=(low, high), diff_step=1e-4, max_nfev=LOOKS)
        shapes = start.copy()
        shapes[free] = np.exp(found.x)
        yield done(shapes)


def columns_of(form: Form, site: Site, rest: Rest, shapes: Array) -> Array:
    """(N, n) of unit amplitudes through all elements of the site."""
    unloaded = form.columns(np.zeros(1), np.array([0, 1]), shapes)[0]
    total = np.zeros((rest.rows.size, len(form.amplitudes)))
    for each in site.elements:
        sign = site.sign(each)
        there = form.columns(sign * each.coordinate, rest.first, shapes, each.axial)
        total = total + sign * each.moved(there, unloaded, rest.rows)
    return rest.seen(total)


def _amplitudes(form: Form, columns: Array, residuals: Array) -> Array:
    """(n,) that leave least; those that have a meaning above zero alone are not below it."""
    scale = np.sqrt(np.sum(columns**2, axis=0))
    scale[scale == 0.0] = 1.0
    unit = columns / scale
    found = np.linalg.lstsq(unit, residuals, rcond=1e-10)[0]
    above = np.array([q.positive for q in form.amplitudes])
    if np.any(found[above] < 0.0):
        # Numbers of either sign are the difference of two that are not below zero.
        both = np.hstack([unit, -unit[:, ~above]])
        signed = nnls(both, residuals)[0]
        found = signed[: above.size]
        found[~above] -= signed[above.size :]
    return np.asarray(found / scale)


def _slopes(form: Form, site: Site, shapes: Array, largest: float) -> Array | None:
    """(n, A) rises of a compliance between loads up to which it must rise, by its amplitudes; None where no curve
    has to."""
    if not SITE_KINDS[site.kind].series or form.memory:
        return None
    loads = np.linspace(-BEYOND, BEYOND, LOADS) * largest
    return np.diff(form.columns(loads, np.array([0, loads.size]), shapes), axis=0)


def rising(columns: Array, residuals: Array, slopes: Array) -> Array:
    """(A,) amplitudes that leave least of residuals (N,) through columns (N, A), with no rise `slopes` (n, A) below
    zero: least squares with inequalities as a least distance problem (C. L. Lawson, R. J. Hanson, Solving Least
    Squares Problems, SIAM 1995, chapter 23)."""
    scale = np.linalg.norm(columns, axis=0)
    scale[scale == 0.0] = 1.0
    q, r = np.linalg.qr(columns / scale)
    inverse = np.linalg.pinv(r, rcond=1e-10)
    aim, rises = q.T @ residuals, (slopes / scale) @ inverse
    rises = rises / np.maximum(np.linalg.norm(rises, axis=1, keepdims=True), 1e-300)
    # z = r a - aim of least length with rises z >= -rises aim.
    system = np.vstack([rises.T, -(rises @ aim)])
    dual, _ = nnls(system, np.eye(aim.size + 1)[-1])
    left = system @ dual - np.eye(aim.size + 1)[-1]
    if not abs(left[-1]) > 0.0:
        return np.zeros(aim.size)
    return np.asarray(inverse @ (aim - left[:-1] / left[-1]) / scale)


def _is_law(it: Formed) -> bool:
    """Whether there is one: something acts, and in series the displacement rises with the load as far as is asked."""
    if not np.any(it.amplitudes):
        return False
    slopes = _slopes(it.form, it.site, it.shapes, it.largest)
    if slopes is None:
        return True
    rises = slopes @ it.amplitudes
    return bool(rises.sum() > 0.0 and np.all(rises >= -LEVEL * rises.sum()))
