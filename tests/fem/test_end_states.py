"""K_g of a bar under any loads of its ends is a combination of six; supports and linkages of one bar share it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fem.buckling import buckling
from fem.elasticity import internal_forces, nodal_geometric_stiffness, stress
from fem.end_states import EndStates
from fem.linear import LinearModel
from fem.linkage import parallelogram, single_bar
from fem.material import Isotropic
from fem.part_space import part_space
from fem.prestress import stressed
from fem.space import Space
from meshes.solid import Floats
from tests.meshes.brought import parts

ALUMINIUM = Isotropic(70e3, 0.33)
LENGTH = 60.0
SUPPORTS = ((), ("rx", "ry", "rz"), ("y", "z", "rx", "ry", "rz"))


def space(bowed: bool) -> Space:
    """Of a bar of 60 x 6 x 10 mm; bowed: along y and z, so that a pull bends it."""
    raw = parts.block("hexahedron", (6, 1, 2))
    x = raw.points[:, 0] / LENGTH
    bow = np.column_stack((0 * x, 3.0 * x * (1 - x), 2.0 * x * (1 - x) ** 2)) * bowed
    return part_space(parts.part(replace(raw, points=raw.points + bow)))


def clamped(bowed: bool, pinned: bool = False) -> LinearModel:
    return LinearModel(single_bar(space(bowed), LENGTH, pinned), ALUMINIUM)


def condensed(model: LinearModel, wrench: Floats) -> Floats:
    """(6, 6) K_g at the tip under a wrench there."""
    motions = model.unit_motions
    state = stressed(model, motions @ np.linalg.solve(model.stiffness, wrench))
    return np.asarray(motions.T @ (state.geometric @ motions))


def states(model: LinearModel) -> list[int]:
    """How many states of each body were put together and kept."""
    return [len(known) for _, known in model.states._known.values()]


def test_six_wrenches_give_that_of_every_other() -> None:
    """And five do not: each of the six adds a K_g of its own."""
    model = clamped(bowed=True)
    # A moment of 60 N mm stresses the bar about as a force of 1 N does.
    units = np.diag([1.0, 1.0, 1.0, LENGTH, LENGTH, LENGTH])
    six = np.array([condensed(model, wrench) for wrench in units])
    assert states(model) == [6]
    arc = np.repeat([1.0, 1.0 / LENGTH], 3)
    flat = (six * np.outer(arc, arc)).reshape(6, -1)
    assert np.linalg.matrix_rank(flat / np.linalg.norm(flat, axis=1)[:, None], tol=1e-3) == 6
    generator = np.random.default_rng(3)
    for shares in generator.standard_normal((4, 6)):
        found = condensed(model, units @ shares)
        np.testing.assert_allclose(found, np.einsum("k,kij->ij", shares, six), atol=1e-9 * np.abs(six).max())
    assert states(model) == [6]


def test_a_combined_state_is_that_of_its_own_stress() -> None:
    model = clamped(bowed=True)
    (member,) = model.linkage.members
    for wrench in np.diag([1.0, 1.0, 1.0, LENGTH, LENGTH, LENGTH]):
        condensed(model, wrench)
    motion = model.unit_motions @ np.linalg.solve(model.stiffness, [3.0, -1.0, 0.5, 20.0, -90.0, 40.0])
    (u,) = model.reduction.fields(motion, model.reduction.rest)
    found = model.states.of(member.space, ALUMINIUM, u)
    sigma = stress(member.space, ALUMINIUM, u)
    assert states(model) == [6]
    exact = nodal_geometric_stiffness(member.space, sigma)
    np.testing.assert_allclose(
        found.geometric.toarray(), exact.toarray(), atol=1e-9 * np.abs(exact.data).max()
    )
    forces = internal_forces(member.space, sigma)
    np.testing.assert_allclose(found.forces, forces, atol=1e-9 * np.abs(forces).max())


@pytest.mark.parametrize("bowed", [False, True])
def test_supports_share_their_states_and_have_the_loads_of_their_own(bowed: bool) -> None:
    """A bar with two planes of symmetry is in one state under all of them, pinned ends too; a bowed one in several."""
    rigid = clamped(bowed)
    (member,) = rigid.linkage.members
    pinned = LinearModel(single_bar(member.space, LENGTH, pinned=True), ALUMINIUM, states=rigid.states)
    tried = [(rigid, held) for held in SUPPORTS] + [(pinned, SUPPORTS[-1])]
    for model, held in tried:
        own = buckling(replace(model, states=EndStates()), held, 3)
        loads = [mode.load for mode in buckling(model, held, 3)]
        np.testing.assert_allclose(loads, [mode.load for mode in own], rtol=1e-9)
    (count,) = states(rigid)
    assert count == 1 if not bowed else 1 < count <= 4


def test_the_bars_of_a_linkage_share_them() -> None:
    """Pushed at two angles and held in two ways, both bars are in few states of one mesh."""
    shared = EndStates()
    body = space(bowed=False)
    for q in (0.0, 0.5):
        model = LinearModel(parallelogram(body, LENGTH, 30.0, q), ALUMINIUM)
        for held in (("y", "z", "rx", "ry", "rz"), ("z", "rx", "ry", "rz")):
            loads = [mode.load for mode in buckling(replace(model, states=shared), held, 3)]
            own = [mode.load for mode in buckling(replace(model, states=EndStates()), held, 3)]
            np.testing.assert_allclose(loads, own, rtol=1e-9)
    ((_, known),) = shared._known.values()
    assert 1 <= len(known) <= 6
