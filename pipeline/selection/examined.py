"""The data doctor alone: what the table of a campaign has wrong, before anything is looked for in the rig."""

from __future__ import annotations

from dataclasses import dataclass

from pipeline.answer.of_diagnosis import doctor_finding, found_noise
from pipeline.answer.record import DoctorFinding, FoundNoise
from pipeline.callbacks import OnProgress
from pipeline.campaign import Campaign
from pipeline.inference.model import Model
from pipeline.selection.beginnings import Beginning, beginnings
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.diagnosis import cached_fits
from pipeline.selection.doctor import Table, suspicions
from pipeline.selection.reading_noise import AS_DECLARED, Readings
from pipeline.selection.unknown_zeros import Zero, zeros
from vjm.effects import catalogue


@dataclass(frozen=True)
class Examination:
    """What a table has wrong. mistakes: one of them, where there are any. zero: of a sensor, as it seems. readings:
    what they are about the best single effect; judged: whether that leaves nothing but noise in its order, so that
    they could be looked at. noise: of sensors whose noise is not as it was declared. begins: channels that do so far
    from nothing where the plain model expects nothing."""

    mistakes: tuple[DoctorFinding, ...]
    zero: Zero | None = None
    readings: Readings = AS_DECLARED
    judged: bool = False
    noise: tuple[FoundNoise, ...] = ()
    begins: tuple[Beginning, ...] = ()


def mistakes_of(campaign: Campaign, model: Model, on_progress: OnProgress) -> tuple[DoctorFinding, ...]:
    """Mistakes that the table seems to have beside a model."""
    found = suspicions(cached_fits(campaign, model, catalogue(), on_progress))
    return tuple(doctor_finding(each) for each in found)


def examined(campaign: Campaign, on_progress: OnProgress) -> Examination:
    """A campaign's table beside plain virtual springs with the best single effect. InputError as of `diagnose`."""
    cache = cached_fits(campaign, Model(), catalogue(), on_progress)
    found = suspicions(cache)
    if found:
        return Examination(tuple(doctor_finding(each) for each in found))
    begins, table = beginnings(cache.fit(frozenset()), CRITERIA), Table.of(cache)
    if table.fit.degrees < CRITERIA.few_readings:
        return Examination((), begins=begins)
    best = cache.fit(table.left[1])
    known = zeros(best, CRITERIA)
    zero = known[0] if known and known[0].gain > CRITERIA.doctor_explains and known[0].unloaded else None
    readings = AS_DECLARED.again(best, cache.whole, CRITERIA)
    noise = tuple(found_noise(readings, cache.whole.campaign, cache.whole.predicted))
    return Examination((), zero, readings, AS_DECLARED.may_be_asked(best, CRITERIA), noise, begins)
