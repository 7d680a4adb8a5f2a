"""The data doctor alone: what the table of a campaign has wrong, before anything is looked for in the rig."""

from __future__ import annotations

from dataclasses import dataclass

from pipeline.answer import DoctorFinding, FoundNoise
from pipeline.campaign import Campaign
from pipeline.diagnose.diagnosis import fit_cache
from pipeline.diagnose.doctor import Table, suspicions
from pipeline.diagnose.doctor_words import doctor_finding
from pipeline.diagnose.readings import AS_DECLARED, Readings
from pipeline.diagnose.record import found_noise
from pipeline.diagnose.signatures import Say
from pipeline.diagnose.zeros import Zero, zeros
from pipeline.inference.model import Model
from pipeline.selection.criteria import CRITERIA
from vjm.effects import catalogue


@dataclass(frozen=True)
class Examination:
    """What a table has wrong. mistakes: one of them, where there are any. zero: of a sensor, as it seems. readings:
    what they are about the best single effect; judged: whether that leaves nothing but noise in its order, so that
    they could be looked at. noise: of sensors whose noise is not as it was declared."""

    mistakes: tuple[DoctorFinding, ...]
    zero: Zero | None = None
    readings: Readings = AS_DECLARED
    judged: bool = False
    noise: tuple[FoundNoise, ...] = ()


def mistakes_of(campaign: Campaign, model: Model, say: Say) -> tuple[DoctorFinding, ...]:
    """Mistakes that the table seems to have beside a model."""
    found = suspicions(fit_cache(campaign, model, catalogue(), say))
    return tuple(doctor_finding(each) for each in found)


def examined(campaign: Campaign, say: Say) -> Examination:
    """A campaign's table beside plain virtual springs with the best single effect. InputError as of `diagnose`."""
    shelf = fit_cache(campaign, Model(), catalogue(), say)
    found = suspicions(shelf)
    if found:
        return Examination(tuple(doctor_finding(each) for each in found))
    table = Table.of(shelf)
    if table.fit.degrees < CRITERIA.few_readings:
        return Examination(())
    best = shelf.fit(table.left[1])
    known = zeros(best, CRITERIA)
    zero = known[0] if known and known[0].gain > CRITERIA.doctor_explains and known[0].unloaded else None
    readings = AS_DECLARED.again(best, shelf.whole, CRITERIA)
    noise = tuple(found_noise(readings, shelf.whole.campaign, shelf.whole.predicted))
    return Examination((), zero, readings, AS_DECLARED.may_be_asked(best, CRITERIA), noise)
