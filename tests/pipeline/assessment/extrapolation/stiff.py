"""A small bench that several tests look at, measured once."""

from functools import cache

from pipeline.assessment.challenge.benches import Bench
from pipeline.assessment.challenge.cases import Case
from pipeline.assessment.extrapolation.bench import Measured, measured_case
from pipeline.assessment.virtual.plan import SENSORS, bench_plan
from pipeline.simulate import bench_rig

IDS = ("axial_held_q+0", "lateral_q+30", "swing_q+30")
STEPS = 8
HIDDEN = {"modulus_error.scale": 1.03}


@cache
def stiff() -> Measured:
    """Three tests of bars that are 3 % too stiff."""
    plan = tuple(test for test in bench_plan(STEPS) if test.id in IDS)
    return measured_case(Case(0, "single", Bench(bench_rig(), SENSORS, plan, "few"), HIDDEN, None, 4))
