"""Sizes that are drawn for an effect without a value."""

import numpy as np
import pytest

from pipeline.assessment.virtual.hidden import FACTOR, hidden
from pipeline.errors import InputError
from pipeline.simulate import bench_rig
from vjm.effects import catalogue, for_kind

KNOWN = for_kind("parallelogram")


def drawn(name: str, seed: int) -> dict[str, float]:
    return hidden([name], KNOWN, bench_rig(), np.random.default_rng(seed))[name]


@pytest.mark.parametrize("name", sorted(KNOWN))
def test_sizes_are_within_a_factor_of_typical_and_in_bounds(name: str) -> None:
    parameters = {p.name: p for p in KNOWN[name].parameters}
    for seed in range(20):
        for key, value in drawn(name, seed).items():
            p = parameters[key]
            assert p.low <= value <= p.high
            share = (value - p.null) / p.typical
            if value not in (p.null, p.low, p.high):
                assert 1.0 / FACTOR <= abs(share) <= FACTOR
                assert share > 0 or not p.one_sided


def test_both_signs_occur_where_both_have_a_meaning() -> None:
    signs = {np.sign(drawn("bar_length_mismatch", seed)["mismatch_mm"]) for seed in range(12)}
    assert signs == {-1.0, 1.0}


def test_a_shape_is_not_drawn() -> None:
    values = drawn("joint_friction", 1)
    assert values["presliding_rad"] == KNOWN["joint_friction"].nulls["presliding_rad"]
    assert values["torque_Nmm"] > 0.0


def test_values_of_one_effect_add_up_and_names_alone_come_once() -> None:
    rng = np.random.default_rng(0)
    asked = ["bar_initial_bow=0.2", "bar_initial_bow.bow_z_mm=-0.1"]
    assert hidden(asked, KNOWN, bench_rig(), rng)["bar_initial_bow"] == {"bow_y_mm": 0.2, "bow_z_mm": -0.1}
    with pytest.raises(InputError, match="given twice"):
        hidden(["joint_friction", "joint_friction"], KNOWN, bench_rig(), rng)


@pytest.mark.parametrize("name", ["actuator_compliance", "link_compliance"])
def test_a_bench_has_no_drives_and_no_links(name: str) -> None:
    with pytest.raises(InputError, match=f"the virtual bench cannot have {name}"):
        hidden([name], catalogue(), bench_rig(), np.random.default_rng(1))
