"""What pictures of a result are drawn from: the curve that the plain model misses most, beside models of it."""

from __future__ import annotations

from collections.abc import Mapping

from pipeline.compare.error import Discrepancy
from pipeline.face.subject import Subject
from pipeline.inference.estimated_sigmas import completed
from pipeline.inference.fit import unfitted
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.page.curves import tests_of
from pipeline.page.record import Curve, TestPage
from reports.first_screen.figures import Line, Measured

MOST = 3
"""Models beside the first one that a picture still tells apart."""


def worst_curve(subject: Subject, models: Mapping[str, Model]) -> Measured | None:
    """The channel of a test that the first of these models misses most in its sigmas, measured and by every model;
    None where nothing is compared. Units are those of the columns: mm, rad, N, N·mm."""
    cases = load_cases(completed(subject.campaign))
    gaps = {name: Discrepancy(cases, unfitted(it, cases).prediction) for name, it in models.items()}
    first, *others = list(gaps)[: MOST + 1]
    pages = {name: tests_of(gaps[first], gaps[name]) for name in others or [first]}
    every = [(test, curve) for test in next(iter(pages.values())) for curve in test.curves]
    if not every:
        return None
    # A held-out test is looked at only where there is no other.
    test, curve = max(every, key=lambda it: (it[0].role == "fit", it[1].rms_before or 0.0))
    lines = [Line(first, curve.before, curve.rms_before)]
    lines += [_after(name, pages[name], test.test, curve.channel) for name in others]
    return Measured(
        title=test.test,
        load=test.load,
        load_unit=test.load_unit,
        channel=curve.channel,
        unit=curve.unit,
        loads=test.loads,
        measured=curve.measured,
        sigma=curve.sigma,
        lines=tuple(lines),
    )


def _after(name: str, tests: tuple[TestPage, ...], test: str, channel: str) -> Line:
    found: Curve = next(
        curve for it in tests if it.test == test for curve in it.curves if curve.channel == channel
    )
    return Line(name, found.after, found.rms_after)
