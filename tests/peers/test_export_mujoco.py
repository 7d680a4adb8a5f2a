"""Exported models under six unit loads in MuJoCo: a bar by its tendons, a linkage closed by its weld."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.peers.export import CASES, LIMIT, loaded, source, wanted
from tests.pipeline.export.sources import relative_error

mujoco = pytest.importorskip("mujoco", reason="MuJoCo (mujoco) is not installed")

# N and N·m. Each bends a bar by some 1e-5 rad, so that what is not linear is below 1e-10 of the mean of both signs, and
# moves it by more than 1e-9 m, so that rounding (1e-16 of a third of a metre) is below 1e-7.
LOADS = np.array([1.0, 0.01, 0.1, 1e-3, 1e-3, 1e-3])


class Model:
    """A model with a load at a site, and the acceleration of its joints from any position at rest."""

    def __init__(self, path: Path, site: str) -> None:
        self.model = mujoco.MjModel.from_xml_path(str(path))
        self.data = mujoco.MjData(self.model)
        self.site = self.model.site(site).id
        still, step = np.zeros(6), 1e-8
        columns = [
            self.acceleration(step * e, still) - self.acceleration(-step * e, still) for e in self.motions
        ]
        self.slope = np.stack(columns, axis=1) / (2.0 * step)
        self.start = self.place(np.zeros(self.model.nq))

    @property
    def motions(self) -> np.ndarray:
        """Unit motions of all joints."""
        return np.eye(self.model.nv)

    def jacobian(self) -> np.ndarray:
        """(6, joints) of the site."""
        parts = np.zeros((2, 3, self.model.nv))
        mujoco.mj_jacSite(self.model, self.data, parts[0], parts[1], self.site)
        return parts.reshape(6, -1)

    def acceleration(self, joints: np.ndarray, wrench: np.ndarray) -> np.ndarray:
        """By MuJoCo, tendons and the weld's forces among the others."""
        self.data.qpos[:], self.data.qvel[:] = joints, 0.0
        mujoco.mj_fwdPosition(self.model, self.data)
        self.data.qfrc_applied[:] = self.jacobian().T @ wrench
        mujoco.mj_forward(self.model, self.data)
        return self.data.qacc.copy()

    def place(self, joints: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        self.data.qpos[:] = joints
        mujoco.mj_fwdPosition(self.model, self.data)
        return self.data.site_xpos[self.site].copy(), self.data.site_xmat[self.site].reshape(3, 3).copy()

    def moved(self, wrench: np.ndarray, held: np.ndarray) -> np.ndarray:
        """(6,) mm and rad of the site where the model rests under a load, N and N·m, with directions held."""
        still, supports = np.zeros(self.model.nv), np.eye(6)[held]
        # What a unit support accelerates, and how the joints move what is held.
        push = np.array([self.acceleration(still, s) for s in supports]).reshape(-1, self.model.nv).T
        hold = self.jacobian()[held]
        whole = np.block([[self.slope, push], [hold, np.zeros((len(supports), len(supports)))]])
        joints, support = still, np.zeros(len(supports))
        for _ in range(5):
            rest = self.acceleration(joints, wrench + support @ supports)
            change = np.linalg.solve(whole, -np.concatenate([rest, self.offset(joints)[held]]))
            joints, support = joints + change[: self.model.nv], support + change[self.model.nv :]
        assert np.abs(change[: self.model.nv]).max() < 1e-12
        return self.offset(joints) * np.repeat([1e3, 1.0], 3)

    def offset(self, joints: np.ndarray) -> np.ndarray:
        """(6,) m and rad of the site."""
        place, turn = self.place(joints)
        small = turn @ self.start[1].T
        vector = 0.5 * np.array(
            [small[2, 1] - small[1, 2], small[0, 2] - small[2, 0], small[1, 0] - small[0, 1]]
        )
        return np.concatenate([place - self.start[0], vector])


@pytest.mark.parametrize("case", CASES)
def test_six_unit_loads(case: str, tmp_path: Path) -> None:
    it, path = source(case, "mjcf", tmp_path)
    model, free = Model(path, "tip_1_point" if it.linkage is None else "platform_point"), loaded(it)
    assert model.model.neq == (it.linkage is not None)
    held = ~np.isin(np.arange(6), free)
    columns = []
    for direction in free:
        load = LOADS[direction] * np.eye(6)[direction]
        turned = 0.5 * (model.moved(load, held) - model.moved(-load, held))
        # N·m are a thousand N·mm.
        columns.append(turned / (LOADS[direction] * (1.0, 1e3)[direction // 3]))
    assert relative_error(np.stack(columns, axis=1)[free], wanted(it)) < LIMIT


def test_a_step_of_the_file_is_stable(tmp_path: Path) -> None:
    """The linkage, let go with one tip 1e-7 m aside, does not gain energy in a thousand steps of its file."""
    _, path = source("linkage at 30", "mjcf", tmp_path)
    model = mujoco.MjModel.from_xml_path(str(path))
    model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY
    data = mujoco.MjData(model)
    data.joint("tip_1_y").qpos = data.joint("tip_2_y").qpos = 1e-7
    mujoco.mj_forward(model, data)
    first = data.energy.sum()
    assert first > 0.0
    energies = []
    for _ in range(1000):
        mujoco.mj_step(model, data)
        energies.append(data.energy.sum())
    assert max(energies) < 1.05 * first
