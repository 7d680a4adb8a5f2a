"""How a model fails: tests that are loaded alike, channel by channel, as numbers and as sentences."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign import Gauge, Test
from pipeline.compare.error import Discrepancy
from pipeline.compare.misfit import Series, Signature, explained, flagged, misfit
from pipeline.compare.record import Finding
from pipeline.compare.sentence import Look, sentence
from pipeline.inference.driving import column_name, driving, unit_of

Array = NDArray[np.float64]
_ANGLE = re.compile(r"[\s_.-]*(q[\s_=]*)?[+-]?\d+(\.\d+)?$")
_POSTURE = re.compile(r"[\s_.-]q[\s_=]*[+-]?\d+(\.\d+)?$")
LISTED = 3
"""Tests that are named one by one."""
FEWEST, PLAIN = 8, 2
"""Readings of a channel below which its shape is not looked at, and from which its offset and slope are."""
LINE = ("offset", "slope")
TOLD = 2
"""Sentences about one channel of one group."""
HALF = 0.5
"""Part of what the first sentence leaves beyond noise that a second one has to explain: a shape that no number fits
would else be told as whatever is a little like it."""


@dataclass(frozen=True)
class LoadedAlike:
    """Tests with the same control that the same quantity drives; load: its channel."""

    name: str
    numbers: tuple[int, ...]
    load: int


def findings(discrepancy: Discrepancy) -> tuple[tuple[Finding, ...], int]:
    """The significant numbers of all looks at the fitted tests, those in words first; and how many there were.

    Significant is what noise alone gives in 5 % of all models, whatever the number of looks (Bonferroni). A look is
    told in at most two sentences, the number that explains most and the one that explains most of the rest; the
    numbers themselves each stand alone.
    """
    looks = list(_looks(discrepancy))
    numbers = [_numbers(look.series) for _, _, look in looks]
    real = {id(s) for s in flagged(s for found in numbers for s in found)}
    out: list[Finding] = []
    for (group, channel, look), found in zip(looks, numbers, strict=True):
        told = _told(look, [s for s in found if id(s) in real])
        out += [_finding(group, channel, look, s, told.get(s.name, "")) for s in found if id(s) in real]
    ranked = sorted(out, key=lambda f: (not f.sentence, -f.significance))
    return tuple(ranked), sum(map(len, numbers))


def groups(tests: tuple[Test, ...], gauges: tuple[Gauge, ...], role: str = "fit") -> tuple[LoadedAlike, ...]:
    """The tests of a role whose ids differ by a number at the end only, by control and driving quantity, named: by what
    they have in common where the rest of their ids is an angle q, else one by one."""
    alike: dict[tuple[tuple[str, ...], int, str], list[int]] = {}
    for number, test in enumerate(tests):
        if test.role == role:
            stem = _ANGLE.sub("", test.id)
            alike.setdefault((test.control, driving(test, gauges)[0], stem), []).append(number)
    found, used = [], set[str]()
    for (_, load, stem), numbers in alike.items():
        first = tests[numbers[0]].id
        name = _named([test.id for test in tests], numbers, stem)
        name = name if name not in used else f"{name} ({first})"
        used.add(name)
        found.append(LoadedAlike(name, tuple(numbers), load))
    return tuple(found)


def _named(ids: list[str], numbers: list[int], stem: str) -> str:
    own = [ids[number] for number in numbers]
    if len(own) == 1:
        return own[0]
    if stem and all(_POSTURE.search(each) for each in own):
        return stem
    if len(own) == len(ids):
        return "all tests" if len(own) > LISTED else _listed(own)
    return _listed(own) if len(own) <= LISTED else f"{own[0]} and {len(own) - 1} more"


def _listed(names: list[str]) -> str:
    return f"{', '.join(names[:-1])} and {names[-1]}"


def too_short(discrepancy: Discrepancy) -> tuple[str, ...]:
    """Series of the fitted tests whose shape cannot be judged, a sentence each channel."""
    load_cases, kept = discrepancy.load_cases, discrepancy.kept
    tests, gauges = load_cases.campaign.tests, load_cases.campaign.gauges
    found: dict[str, list[str]] = {}
    for group in groups(tests, gauges):
        own = np.isin(load_cases.test, group.numbers)
        for channel in np.flatnonzero((kept & own[:, None]).any(axis=0)):
            if 0 < (count := int((kept[:, channel] & own).sum())) < FEWEST:
                name = column_name(int(channel), gauges)
                found.setdefault(name, []).append(f"{count} in {group.name}")
    return tuple(
        f"{name}: too short to judge its shape ({', '.join(where)}; {FEWEST} readings are needed)"
        for name, where in found.items()
    )


def _numbers(series: Series) -> tuple[Signature, ...]:
    """What a series says; of a short one its offset and slope alone."""
    every = misfit(series).signatures
    return every if series.residual.size >= FEWEST else tuple(s for s in every if s.name in LINE)


def _looks(discrepancy: Discrepancy) -> Iterator[tuple[LoadedAlike, str, Look]]:
    load_cases, kept = discrepancy.load_cases, discrepancy.kept
    tests, gauges = load_cases.campaign.tests, load_cases.campaign.gauges
    for group in groups(tests, gauges):
        own = np.isin(load_cases.test, group.numbers)
        load, heat = np.full(len(own), np.nan), np.full(len(own), np.nan)
        for number in group.numbers:
            part = slice(int(load_cases.first[number]), int(load_cases.first[number + 1]))
            load[part] = driving(tests[number], gauges)[1]
            measured = tests[number].data.temperature
            heat[part] = np.nan if measured is None else measured
        for channel in range(kept.shape[1]):
            rows = np.flatnonzero(own & kept[:, channel])
            if rows.size < PLAIN:
                continue
            predicted = discrepancy.prediction.values[rows, channel]
            slope = np.linalg.lstsq(np.column_stack([np.ones(rows.size), load[rows]]), predicted, rcond=None)[
                0
            ][1]
            series = _series(discrepancy, rows, channel, group.load, load[rows], heat[rows])
            yield (
                group,
                column_name(channel, gauges),
                Look(series, float(slope), column_name(group.load, gauges)),
            )


def _series(
    discrepancy: Discrepancy, rows: NDArray[np.int64], channel: int, drive: int, load: Array, heat: Array
) -> Series:
    load_cases = discrepancy.load_cases
    q = np.array([test.q for test in load_cases.campaign.tests])
    steps = np.concatenate([test.data.steps for test in load_cases.campaign.tests])
    sigma = discrepancy.sigma[rows, channel]
    return Series(
        discrepancy.units[rows, channel] / sigma,
        load,
        sigma,
        q[load_cases.test[rows]],
        steps[rows].astype(float),
        load_cases.test[rows].astype(np.int64),
        heat if np.isfinite(heat).all() else None,
        unit=_dotted(unit_of(channel)),
        load_unit=_dotted(unit_of(drive)),
    )


def _told(look: Look, real: list[Signature]) -> dict[str, str]:
    """Sentences by number: the flagged one that explains most, then that which explains most of the rest."""
    out: dict[str, str] = {}
    series, names = look.series, {s.name for s in real} - {"scatter"}
    edge = min((s.significance for s in real), default=np.inf)
    while names and len(out) < TOLD:
        left = [s for s in _numbers(series) if s.name in names and s.significance >= edge]
        if not left:
            break
        rests = [series.residual - explained(series, s) for s in left]
        number = int(np.argmin([rest @ rest for rest in rests]))
        before, after = series.residual @ series.residual, rests[number] @ rests[number]
        if out and before - after < HALF * (before - len(series.residual)):
            break
        best, series = left[number], replace(series, residual=rests[number])
        out[best.name] = sentence(best, look)
        names.discard(best.name)
    return out


def _finding(group: LoadedAlike, channel: str, look: Look, number: Signature, told: str) -> Finding:
    return Finding(
        group=group.name,
        channel=channel,
        number=number.name,
        value=number.value,
        std=number.std,
        unit=number.unit,
        significance=number.significance,
        load=look.load,
        sentence=f"{channel} in {group.name}: {told}" if told else "",
    )


def _dotted(unit: str) -> str:
    return "N·mm" if unit == "Nmm" else unit
