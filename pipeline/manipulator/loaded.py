"""Postures under a wrench and with effects: equilibria of the whole manipulator, some postures at a time."""

from dataclasses import replace

import numpy as np

from pipeline.manipulator.question import Array, Question
from vjm.equilibrium import Drives, Equilibrium, equilibrium
from vjm.lagrangian import layout
from vjm.manipulator.assembled import settled
from vjm.manipulator.machine import Machine, known_inputs, machine, posture_inputs
from vjm.manipulator.measures import principal, rotational, translational
from vjm.manipulator.parts import Manipulator
from vjm.manipulator.posture import Postures
from vjm.sensors import TrueMoment
from vjm.stiffness import read_stiffness

SPACE = 2e7
"""Bytes of one set of Hessians; a solution holds some ten of them."""


def with_true_moments(manipulator: Manipulator) -> Manipulator:
    """The manipulator whose readings have true moments, for effects to build on."""
    return replace(manipulator, sensors=(TrueMoment(), *manipulator.sensors))


def loaded_columns(manipulator: Manipulator, question: Question, at: Postures) -> tuple[Array, np.ndarray]:
    """(B, columns) after those at rest and `critical_factor`, and whether (B,) all equilibria are stable.

    at: postures (B,) that are reached and have a stiffness. Zeros where not.
    """
    drawn = with_true_moments(manipulator)
    size = max(layout(machine(it)).size for it in (drawn, question.changed) if it is not None)
    block = max(1, int(SPACE / (8 * size**2)))
    parts = [_block(drawn, question, at.take(slice(k, k + block))) for k in range(0, len(at.pose), block)]
    return np.concatenate([values for values, _ in parts]), np.concatenate([good for _, good in parts])


def _block(drawn: Manipulator, question: Question, at: Postures) -> tuple[Array, np.ndarray]:
    columns: list[Array] = []
    plain = _States(machine(drawn), posture_inputs(at), len(at.pose), question.wrench)
    good = plain.good
    other = None
    if question.changed is not None:
        of = machine(question.changed)
        inputs = posture_inputs(at) | settled(of, at) | known_inputs(of, question.inputs)
        other = _States(of, inputs, len(at.pose), question.wrench)
        good = good & other.good
    if plain.under is not None:
        columns += [*plain.moved(), *plain.stiffness(plain.under)]
    if other is not None:
        before, after = plain.stiffness(plain.rest), other.stiffness(other.rest)
        columns += [after[0] / before[0] - 1.0, after[2] / before[2] - 1.0]
        columns.append(np.linalg.norm(other.rest.readings[:, :3] - at.pose[:, :3], axis=-1))
        if other.under is not None:
            columns.append(other.work() / plain.work() - 1.0)
    out = np.stack(columns, axis=-1)
    return np.where(good[:, None], out, 0.0), good


class _States:
    """Equilibria at rest and, if there is a wrench, under it; ones take the place of stiffness that is lost."""

    def __init__(self, of: Machine, inputs: Drives, count: int, wrench: Array | None) -> None:
        self.wrench = wrench
        self.rest = equilibrium(of, np.zeros((count, 6)), (), drives=inputs)
        self.under = None if wrench is None else equilibrium(of, wrench, (), self.rest, drives=inputs)
        states = [state for state in (self.rest, self.under) if state is not None]
        self.good = np.all([state.converged & (state.unstable <= 0) for state in states], axis=0)

    def stiffness(self, state: Equilibrium) -> list[Array]:
        """K_tran least and largest, K_rot least and largest; (B,) each."""
        k = np.tile(np.eye(6), (len(self.good), 1, 1))
        if self.good.any():
            k[self.good] = read_stiffness(state.member(self.good))
        tran, rot = principal(translational(k)), principal(rotational(k))
        return [tran[:, 0], tran[:, -1], rot[:, 0], rot[:, -1]]

    def _way(self) -> Array:
        """(B, 6) from rest to the state under the wrench, as read."""
        assert self.under is not None
        return np.asarray(self.under.readings[:, :6] - self.rest.readings[:, :6])

    def moved(self) -> list[Array]:
        """How far and by which angle the platform is moved; (B,) each."""
        way = self._way()
        return [np.linalg.norm(way[:, :3], axis=-1), np.linalg.norm(way[:, 3:], axis=-1)]

    def work(self) -> Array:
        """(B,) displacement along the wrench; one where the equilibrium is lost."""
        assert self.wrench is not None
        return np.where(self.good, self._way() @ self.wrench, 1.0)
