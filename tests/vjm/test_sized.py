"""Sizes of effects follow the rig by their units, and are the catalogue's on the bench that it is for."""

from __future__ import annotations

import numpy as np
import pytest

from vjm import paper
from vjm.effects import catalogue
from vjm.effects.base import Effect, Parameter, Rig, Values
from vjm.effects.sized import LENGTH, Scale, scale_of, scale_of_bar, sized


def test_on_the_bench_of_the_paper_nothing_changes() -> None:
    assert scale_of(LENGTH, paper.BAR_STIFFNESS) == Scale()
    for effect in catalogue().values():
        assert sized(effect, Scale()) is effect


@pytest.mark.parametrize(("force", "length"), [(1000.0, 1.0), (1.0, 10.0), (4.448, 25.4)])
def test_a_size_scales_as_its_unit_does(force: float, length: float) -> None:
    """N by `force`, mm by `length`: a unit N^a mm^b by force^a length^b."""
    moment = force * length
    size, load = np.array([length] * 3 + [1.0] * 3), np.array([force] * 3 + [moment] * 3)
    scale = scale_of(length * LENGTH, paper.BAR_STIFFNESS * load[:, None] / size)
    powers = {
        "mm": (0.0, 1.0),
        "mm/N": (-1.0, 1.0),
        "mm/N^(2/3)": (-2.0 / 3.0, 1.0),
        "N": (1.0, 0.0),
        "N/mm": (1.0, -1.0),
        "N·mm": (1.0, 1.0),
        "N·mm/rad": (1.0, 1.0),
        "rad/(N·mm)": (-1.0, -1.0),
        "rad": (0.0, 0.0),
        "1": (0.0, 0.0),
        "1/K": (0.0, 0.0),
        "of the column": (0.0, 0.0),
    }
    for effect in catalogue().values():
        for old, new in zip(effect.parameters, sized(effect, scale).parameters, strict=True):
            a, b = powers[old.unit]
            factor = force**a * length**b
            for name in ("typical", "low", "high"):
                assert getattr(new, name) == pytest.approx(factor * getattr(old, name), rel=1e-12)
        # From the catalogue's own sizes, however often it is done.
        assert sized(sized(effect, scale), scale).parameters == sized(effect, scale).parameters


def test_a_base_counts_by_what_a_single_bar_gives_in_the_same_direction() -> None:
    """In units of the bar's own compliance it is as typical as on the linkage, and on a bar of other units too."""
    for factor in (1.0, 0.01):
        stiffness = factor * np.diag(np.diag(paper.BAR_STIFFNESS))
        base = sized(catalogue()["base_compliance"], scale_of_bar(LENGTH, stiffness))
        shares = np.array([p.typical for p in base.parameters]) * np.diag(stiffness)
        linkage = 2.0 * paper.BAR_STIFFNESS[0, 0]
        np.testing.assert_allclose(shares[:3], 2e-6 * linkage)
        np.testing.assert_allclose(shares[3:], 1e-9 * linkage * (paper.WIDTH / 2.0) ** 2)
        assert shares.min() > 0.05 and shares.max() < 0.1
        friction = sized(catalogue()["joint_friction"], scale_of_bar(LENGTH, stiffness)).parameters
        assert friction[0].typical == pytest.approx(
            factor * catalogue()["joint_friction"].parameters[0].typical
        )


class Own(Effect):
    name, title, equation, signature, limits, source = ("own",) * 6
    parameters = (Parameter("k", "N·mm/rad", 0.0, 5.0, 0.0, 9.0, "a spring"),)

    def change(self, rig: Rig, values: Values) -> Rig:
        return rig


def test_a_users_own_effect_stays_as_it_is_written() -> None:
    own = Own()
    assert sized(own, Scale(2.0, 3.0, 4.0)) is own
