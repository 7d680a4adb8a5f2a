"""The Lagrange function of a manipulator whose legs have closed loops: gradient and bordered Hessian.

Unknowns u: for each leg its moving coordinates and the multipliers (6) of its loops, then the platform pose t (6),
then the multiplier lambda (6) of each leg. L is the sum over the legs of E + lambda^T (t - g) + mu^T (g_2 - g_1), g
the pose at the leg's end, g_1 and g_2 those at the two ends of a loop. As in `vjm.lagrangian`, loads are conjugate
to (p, rotation vector).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from vjm.frames import Array
from vjm.manipulator.loops import LoopedLeg, Path, looped
from vjm.manipulator.parts import Manipulator
from vjm.manipulator.posture import Postures
from vjm.manipulator.rest import pseudo_rigid_springs
from vjm.work import note


@dataclass(frozen=True, eq=False)
class System:
    """A manipulator at B postures: everything that does not change under load.

    rest: per leg (B, N) unloaded coordinates; stiffness: per leg (B, m, m) linear part. memory: per leg (B, M) of
    its laws before the load. Where bars are not as drawn, the coordinates of a leg at rest need not close its loops.
    """

    manipulator: Manipulator
    pose: Array
    rest: tuple[Array, ...]
    stiffness: tuple[Array, ...]
    memory: tuple[Array, ...]

    @cached_property
    def legs(self) -> tuple[LoopedLeg, ...]:
        """The legs with their loops."""
        return tuple(looped(leg) for leg in self.manipulator.legs)

    @cached_property
    def coordinates(self) -> tuple[slice, ...]:
        """Of the moving coordinates of each leg in u; its loops' multipliers follow."""
        slices, at = [], 0
        for leg in self.legs:
            slices.append(slice(at, at + leg.moving.size))
            at += leg.moving.size + leg.closures
        return tuple(slices)

    @property
    def platform(self) -> slice:
        """Of the platform pose in u."""
        start = self.coordinates[-1].stop + self.legs[-1].closures
        return slice(start, start + 6)

    def multiplier(self, leg: int) -> slice:
        """Of a leg's load on the platform in u."""
        start = self.platform.stop + 6 * leg
        return slice(start, start + 6)

    @property
    def size(self) -> int:
        """Length of u."""
        return self.platform.stop + 6 * len(self.legs)

    @property
    def closures(self) -> int:
        """Number of scalar closure equations, inner ones and those at the platform."""
        return sum(leg.closures + 6 for leg in self.legs)

    @cached_property
    def multipliers(self) -> np.ndarray:
        """(size,) mask of all multipliers."""
        mask = np.zeros(self.size, dtype=bool)
        for leg, x in zip(self.legs, self.coordinates, strict=True):
            mask[x.stop : x.stop + leg.closures] = True
        mask[self.platform.stop :] = True
        return mask

    @cached_property
    def energy(self) -> float:
        """Largest translational spring x length², N·mm: the size of L."""
        parts = zip(self.legs, self.stiffness, strict=True)
        springs = [np.diagonal(k, axis1=1, axis2=2)[:, leg.translations] for leg, k in parts]
        return max(float(np.max(k, initial=1.0)) for k in springs) * self.manipulator.length**2

    @cached_property
    def scale(self) -> Array:
        """(size,) of each unknown: length, 1 rad, energy over them."""
        length = self.manipulator.length
        pose = np.repeat([length, 1.0], 3)
        parts: list[Array] = []
        for leg in self.legs:
            parts += [np.where(leg.translations, length, 1.0), np.tile(self.energy / pose, len(leg.loops))]
        return np.concatenate([*parts, pose, np.tile(self.energy / pose, len(self.legs))])

    def at_rest(self) -> Array:
        """(B, size) unknowns without load."""
        u = np.zeros((len(self.pose), self.size))
        for leg, x, rest in zip(self.legs, self.coordinates, self.rest, strict=True):
            u[:, x] = rest[:, leg.moving]
        u[:, self.platform] = self.pose
        return u

    def take(self, members: np.ndarray) -> System:
        """The same manipulator at some of the postures."""
        parts = (tuple(x[members] for x in each) for each in (self.rest, self.stiffness, self.memory))
        return System(self.manipulator, self.pose[members], *parts)

    def full(self, leg: int, u: Array) -> Array:
        """(B, N) all coordinates of a leg at u (B, size)."""
        full = self.rest[leg].copy()
        full[:, self.legs[leg].moving] = u[:, self.coordinates[leg]]
        return full

    def after(self, u: Array) -> System:
        """The same postures with what the laws remember of a load step that ended at u (B, size)."""
        memory = []
        for k, leg in enumerate(self.legs):
            strain = self.full(k, u) - self.rest[k]
            kept = self.memory[k].copy()
            for spring, place in zip(leg.springs, leg.memories, strict=True):
                if place.stop > place.start:
                    numbers = np.array(spring.coordinates)
                    kept[:, place] = spring.law.respond(strain[:, numbers], self.memory[k][:, place]).memory
            memory.append(kept)
        return replace(self, memory=tuple(memory))


Inputs = Mapping[str, ArrayLike]
"""Inputs that move rest values, such as a rise of temperature, by name; each one number or (B,)."""


def system(manipulator: Manipulator, at: Postures, inputs: Inputs | None = None) -> System:
    """The manipulator at postures (B,) that are all reached. ValueError for one that is not.

    Inputs that no part of the manipulator follows change nothing.
    """
    if not np.all(at.reached):
        raise ValueError(str(at.reason[~at.reached][0]))
    pose = at.pose.reshape(-1, 6)
    given = {k: np.broadcast_to(np.asarray(v, dtype=float), len(pose)) for k, v in (inputs or {}).items()}
    rest, stiffness, memory = [], [], []
    for leg, x in zip(map(looped, manipulator.legs), at.coordinates, strict=True):
        posture = x.reshape(len(pose), -1)
        moved = [given[name][:, None] * slope for name, slope in leg.inputs if name in given]
        rest.append(leg.at(posture) + sum(moved))
        linear = np.broadcast_to(leg.linear, (len(pose), *leg.linear.shape)).copy()
        for part, place, numbers in leg.equivalents:
            linear[:, numbers[:, None], numbers] = pseudo_rigid_springs(part, posture[:, place])
        stiffness.append(linear[:, leg.moving[:, None], leg.moving])
        memory.append(np.broadcast_to(leg.initial_memory, (len(pose), leg.initial_memory.size)))
    return System(manipulator, pose, tuple(rest), tuple(stiffness), tuple(memory))


def gradient_and_hessian(of: System, u: Array) -> tuple[Array, Array]:
    """Gradient (B, size) and Hessian (B, size, size) of L at u (B, size), without external load."""
    note(len(u), of.size)
    gradient, hessian = np.zeros_like(u), np.zeros((*u.shape, u.shape[-1]))
    pose = of.platform
    for k, (leg, x) in enumerate(zip(of.legs, of.coordinates, strict=True)):
        full = of.full(k, u)
        dual = of.multiplier(k)
        block = _Block(leg, gradient, hessian, x)
        block.springs(full - of.rest[k], of.stiffness[k], of.memory[k])
        block.dead_loads(full)
        block.close(leg.main, full, u, dual, -1.0)
        for number, (first, second) in enumerate(leg.loops):
            inner = slice(x.stop + 6 * number, x.stop + 6 * number + 6)
            block.close(second, full, u, inner, 1.0)
            block.close(first, full, u, inner, -1.0)
        gradient[:, dual] += u[:, pose]
        gradient[:, pose] += u[:, dual]
        hessian[:, dual, pose] = hessian[:, pose, dual] = np.eye(6)
    return gradient, hessian


@dataclass(frozen=True, eq=False)
class _Block:
    """Where one leg adds to gradient and Hessian."""

    leg: LoopedLeg
    gradient: Array
    hessian: Array
    x: slice

    def springs(self, strain: Array, stiffness: Array, memory: Array) -> None:
        moving = self.leg.moving
        self.gradient[:, self.x] += np.einsum("bij,bj->bi", stiffness, strain[:, moving])
        self.hessian[:, self.x, self.x] += stiffness
        for spring, past in zip(self.leg.springs, self.leg.memories, strict=True):
            numbers = np.array(spring.coordinates)
            place = self.x.start + np.searchsorted(moving, numbers)
            answer = spring.law.respond(strain[:, numbers], memory[:, past])
            self.gradient[:, place] += answer.force
            self.hessian[:, place[:, None], place] += answer.tangent

    def dead_loads(self, full: Array) -> None:
        moving = self.leg.moving
        for load in self.leg.loads:
            force, slope = load.pull(full, True)
            self.gradient[:, self.x] -= force[:, moving]
            self.hessian[:, self.x, self.x] -= slope[:, moving[:, None], moving]

    def close(self, path: Path, full: Array, u: Array, dual: slice, sign: float) -> None:
        """Adds sign x multiplier^T pose of the path."""
        here = path.chain.kinematics(full[:, path.numbers])
        kept = np.isin(path.numbers, self.leg.moving)
        place = self.x.start + np.searchsorted(self.leg.moving, path.numbers[kept])
        jacobian = here.jacobian[..., kept]
        load = u[:, dual]
        self.gradient[:, dual] += sign * here.pose
        self.gradient[:, place] += sign * np.einsum("bij,bi->bj", jacobian, load)
        curved = here.hessian(load)[:, kept][:, :, kept]
        self.hessian[:, place[:, None], place] += sign * curved
        rows = np.arange(dual.start, dual.stop)
        self.hessian[:, rows[:, None], place] += sign * jacobian
        self.hessian[:, place[:, None], rows] += sign * np.swapaxes(jacobian, -1, -2)
