"""Small virtual benches that several tests look at, each measured once."""

from functools import cache

from pipeline.assessment.virtual.bench import measure
from pipeline.assessment.virtual.plan import GAUGES, SENSORS, bench_plan
from pipeline.campaign import Campaign
from pipeline.simulate import bench_rig

IDS = ("axial_held_q+0", "lateral_q+0", "swing_q+0", "axial_held_q+30", "swing_q+30", "axial_held_q+15")


@cache
def bench(effect: str = "", value: float = 0.0, steps: int = 12, gauges: bool = True) -> Campaign:
    """Six tests of the bench plan, one of them held out, with one hidden parameter "effect.parameter"."""
    plan = [test for test in bench_plan(steps) if test.id in IDS]
    return measure(
        "small", bench_rig(), plan, SENSORS, {effect: value} if effect else {}, 11, GAUGES if gauges else ()
    )
