"""Places of laws that are in the model: what their form does not say is no law elsewhere."""

from pipeline.discover.locating import mapped
from pipeline.selection.criteria import CRITERIA
from tests.pipeline.bench import bench
from tests.pipeline.discover.fits import effects_for, fit_of, map_of

FRICTION = ("joint_friction.torque_Nmm", 600.0)


def test_what_the_free_function_of_a_place_explains_is_no_law_elsewhere() -> None:
    plain, effects = map_of(*FRICTION), effects_for(bench(*FRICTION))
    first = plain.sites[0]
    assert first.site.kind == "hinge_torque"
    elsewhere = [it.value for it in plain.sites if it.site.kind != first.site.kind]
    assert max(elsewhere) > CRITERIA.law_proposed
    assert mapped(fit_of(*FRICTION), effects, known=[first]).best < CRITERIA.law_proposed


def test_a_law_at_another_place_than_the_known_one_is_still_seen() -> None:
    plain, effects = map_of(*FRICTION), effects_for(bench(*FRICTION))
    other = next(it for it in plain.sites if it.site.kind == "base_y")
    again = mapped(fit_of(*FRICTION), effects, known=[other])
    assert again.sites[0].site.kind == "hinge_torque"
    assert again.best > 0.5 * plain.best
