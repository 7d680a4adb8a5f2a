"""The contract of an effect, over all that the catalogue finds and one of a user's own."""

from __future__ import annotations

import inspect
from dataclasses import replace
from itertools import combinations, pairwise
from pathlib import Path

import numpy as np
import pytest

from tests.vjm.effects.bench import BAR, CASES, EFFECTS, EVERY, NOISE, PARALLELOGRAM, RIGS, run, with_values
from vjm.effects import catalogue, defined_in, from_file
from vjm.effects.base import Rig, kind_of
from vjm.frames import Array
from vjm.sensitivity import Direction

UNITS = {
    "1",
    "mm",
    "rad",
    "N",
    "N·mm",
    "mm/N",
    "rad/(N·mm)",
    "N·mm/rad",
    "N·mm/rad³",
    "N/mm",
    "mm/N^(2/3)",
    "1/K",
    "of the column",
}
CANONICAL = {
    "bar_geometric_nonlinearity": (),
    "modulus_error": ("scale",),
    "bar_section_error": ("ea", "eiy", "eiz", "gj"),
    "bar_stiffness_asymmetry": ("ratio",),
    "bar_length_mismatch": ("mismatch_mm",),
    "dimension_error": ("length_mm", "width_mm"),
    "bar_initial_bow": ("bow_y_mm", "bow_z_mm"),
    "axis_flexibility": ("radial_mm_per_N", "tilt_rad_per_Nmm"),
    "joint_clearance": ("play_mm",),
    "joint_friction": ("torque_Nmm", "presliding_rad"),
    "joint_torsional_stiffness": ("stiffness_Nmm_per_rad",),
    "contact_stiffening": ("c_mm_per_N23",),
    "thermal_expansion": ("alpha_per_K",),
    "material_yield": ("strain",),
    "actuator_compliance": ("mm_per_N", "rad_per_Nmm"),
    "link_compliance": ("scale",),
    "sensor_gain": ("share",),
    "sensor_drift": ("size",),
    "sensor_settling": ("size", "steps"),
    "sensor_cross_talk": ("share",),
    "sensor_lag": ("keeps",),
}
"""Names that campaigns and results use; others follow from these or have three axes."""

UNSEEN_ON_A_BAR = {("base_compliance", "ry_rad_per_Nmm"), ("dimension_error", "width_mm")}
"""A bar that is hinged about y at the base origin exerts no moment about y there; one bar has no width."""

PARAMETERS = [(name, p.name) for name, effect in EFFECTS.items() for p in effect.parameters]


@pytest.mark.parametrize("name", EVERY)
def test_an_effect_explains_itself(name: str) -> None:
    effect = EVERY[name]
    texts = (effect.title, effect.equation, effect.signature, effect.limits, effect.source)
    assert all(text.strip() for text in texts)
    path = Path(inspect.getfile(type(effect)))
    assert path.stem == effect.name == name
    assert len(path.read_text(encoding="utf-8").splitlines()) < 120
    assert effect.kinds and set(effect.kinds) <= {"parallelogram", "bar", "manipulator"}
    for p in effect.parameters:
        assert p.meaning.strip() and p.unit in UNITS, p.name
        assert p.typical != 0.0 and p.low < p.high, p.name
        assert p.low <= p.null <= p.high and p.low <= p.null + p.typical <= p.high, p.name


def test_the_catalogue_has_the_names_of_the_contract() -> None:
    found = catalogue()
    assert len(found) == 27
    for name, parameters in CANONICAL.items():
        assert set(parameters) <= {p.name for p in found[name].parameters}


@pytest.mark.parametrize(("name", "rig"), CASES)
def test_null_values_change_nothing(name: str, rig: str) -> None:
    effect = EFFECTS[name]
    if not effect.parameters:
        assert RIGS[rig].bar is None or effect.apply(RIGS[rig], {}).bar is not None
        return
    null = effect.apply(RIGS[rig], effect.nulls)
    assert null is RIGS[rig]


@pytest.mark.parametrize(("name", "parameter"), PARAMETERS)
def test_one_parameter_at_null_beside_the_others(name: str, parameter: str) -> None:
    """As many parameters as there are have to be null before the effect is gone: each has a null of its own."""
    effect = EFFECTS[name]
    p = next(p for p in effect.parameters if p.name == parameter)
    alone = effect.apply(PARALLELOGRAM, {**effect.nulls, parameter: p.null + p.typical})
    if len(effect.parameters) == 1:
        assert alone is not PARALLELOGRAM
    tiny = effect.apply(PARALLELOGRAM, {**effect.nulls, parameter: p.null + 1e-9 * p.typical})
    # A typical effect is a few hundred times the noise at most; friction and yielding end where they begin.
    change = np.max(np.abs(run(tiny, steps=1).readings - run(PARALLELOGRAM, steps=1).readings) / NOISE)
    smooth_to_null = name not in ("joint_clearance", "material_yield")
    assert change < 1e-5 or not smooth_to_null


@pytest.mark.parametrize(("name", "rig"), CASES)
def test_every_parameter_moves_something(name: str, rig: str) -> None:
    base = run(with_values(name, RIGS[rig], {})).readings
    assert base.shape == (3, 2, 13) and np.all(np.isfinite(base))
    for p in EFFECTS[name].parameters:
        moved = with_values(name, RIGS[rig], {p.name: p.null + 1.05 * p.typical})
        change = np.max(np.abs(run(moved).readings - base) / NOISE)
        # A twentieth of a typical size; some parameters meet hardly any load here. Solving leaves 1e-9 of the noise.
        assert (change > 1e-6) != (rig.endswith("bar") and (name, p.name) in UNSEEN_ON_A_BAR), p.name


# Of yielding, closed forms are in test_yield_closed_forms.py.
@pytest.mark.parametrize(
    ("name", "rig"),
    [
        pytest.param(
            *it.values, marks=[*it.marks, *([pytest.mark.long] * (it.values[0] == "material_yield"))]
        )
        for it in CASES
    ],
)
def test_derivatives_agree_with_solving_again(name: str, rig: str) -> None:
    """Through the whole history, with the memory's own derivative handed on."""
    effect = EFFECTS[name]
    directions, expected = [], []
    for p in effect.parameters:
        value = p.null + p.typical
        # A difference must not reach over a kink, as where another of a thousand fibres begins to yield.
        size = abs(p.typical) * (1.0 if effect.smooth else 1e-4)

        def build(value: float, parameter: str = p.name) -> Rig:
            return with_values(name, RIGS[rig], {parameter: value})

        def solved(value: float, build=build) -> Array:  # type: ignore[no-untyped-def]
            return run(build(value)).readings

        directions.append(Direction(build, value, size))
        far, near = (solved(value + s * size) - solved(value - s * size) for s in (0.04, 0.02))
        expected.append((8 * near - far) / (0.24 * size))
    if not directions:
        assert not effect.parameters
        return
    found = run(with_values(name, RIGS[rig], {}), directions).slopes
    for k, (p, slope) in enumerate(zip(effect.parameters, expected, strict=True)):
        error = np.abs(found[..., k] - slope) * abs(p.typical) / NOISE
        largest = np.max(np.abs(slope) * abs(p.typical) / NOISE)
        # Fourth order in the step; rounding of 1e-10 of a reading, some 1e5 noises, over a fiftieth of the size.
        rounding = 1e-3 if effect.smooth else 1.0
        assert np.max(error) < 1e-4 * largest + rounding, p.name


def commute(one: str, two: str) -> None:
    """In both orders: equal to 1e-9 of the reading, rounding of 1e-6 noises."""
    ahead = run(with_values(two, with_values(one, PARALLELOGRAM, {}), {}), steps=1).readings
    back = run(with_values(one, with_values(two, PARALLELOGRAM, {}), {}), steps=1).readings
    np.testing.assert_array_less(
        np.abs(ahead - back), 1e-9 * np.abs(ahead) + 1e-6 * NOISE, err_msg=f"{one}, {two}"
    )


@pytest.mark.parametrize(("one", "two"), list(pairwise([*EFFECTS, next(iter(EFFECTS))])))
def test_effects_that_are_neighbours_commute(one: str, two: str) -> None:
    """Each of them with two others; in `test_parts.py` the parts that they are made of."""
    commute(one, two)


@pytest.mark.long
@pytest.mark.parametrize("first", EFFECTS)
def test_effects_commute(first: str) -> None:
    """All pairs with one that comes later."""
    for one, two in combinations(EFFECTS, 2):
        if one == first:
            commute(one, two)
    assert first in EFFECTS


@pytest.mark.parametrize("name", EFFECTS)
def test_a_rig_that_cannot_have_it_is_refused(name: str) -> None:
    effect = EFFECTS[name]
    clamped = replace(BAR, base="clamped")
    if "bar" not in effect.kinds:
        with pytest.raises(ValueError, match=f"{name} needs a rig of kind parallelogram, not bar"):
            effect.apply(BAR, effect.typicals)
    elif effect.hinge:
        with pytest.raises(ValueError, match=f"{name} needs a bar with a hinge at"):
            effect.apply(clamped, effect.typicals)
    else:
        assert kind_of(effect.apply(clamped, effect.typicals)) == "bar"


def test_yielding_needs_fibres_outside_the_radius_of_gyration() -> None:
    effect = EFFECTS["material_yield"]
    with pytest.raises(ValueError, match="material_yield needs the rig's outermost fibres"):
        effect.apply(replace(PARALLELOGRAM, fibre_z=None), effect.typicals)
    narrow = replace(PARALLELOGRAM, fibre_y=2.0)
    assert effect.refusal(PARALLELOGRAM) == ""
    assert "fibre_y must be more than the radius of gyration" in effect.refusal(narrow)
    # A fit may scale a section's stiffnesses beyond its edges: no number of it may end the fit.
    scaled = EFFECTS["bar_section_error"].apply(PARALLELOGRAM, {"ea": 0.3, "eiy": 3.0, "eiz": 3.0, "gj": 1.0})
    for it in (narrow, scaled):
        yielding = effect.apply(it, {"strain": 1e-3})
        assert all(np.all(np.isfinite(link.stiffness)) for link in yielding.links) and yielding.chains


def test_a_file_without_an_effect_is_refused(tmp_path: Path) -> None:
    for text, complaint in (
        ("x = 1\n", "found no class"),
        ("import nothing_of_that_name\n", "ModuleNotFound"),
    ):
        path = tmp_path / "mine.py"
        path.write_text(text, encoding="utf-8")
        with pytest.raises(ValueError, match=complaint):
            from_file(path)
    import vjm.effects.base as base

    assert defined_in(base) == []
