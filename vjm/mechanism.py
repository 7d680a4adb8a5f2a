"""What the solvers need to know of a mechanism: elastic chains that meet at one platform, and its sensors."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Protocol

import numpy as np

from vjm.chain import Chain, Role
from vjm.frames import Array
from vjm.gauges import Gauge
from vjm.laws import Direct, Response, Spring
from vjm.loads import DeadLoads
from vjm.sensors import Sensor


@dataclass(frozen=True, eq=False)
class Drive:
    """An input that sets rest values: rest + slope x (value - default).

    A nominal angle, an actuator's position (actuated coordinates stand at their rest values), a temperature.
    name: the same in all chains that follow it. slope: (n,) rest values per unit of the input.
    posture: whether gauges and sensors are zeroed with it in place, as with a nominal angle.
    curve: change (..., n) of the rest values beyond the slope, at departures (...) from the default; none if straight.
    """

    name: str
    default: float
    slope: Array
    posture: bool = False
    curve: Callable[[Array], Array] | None = None


@dataclass(frozen=True, eq=False)
class ElasticChain:
    """A chain with its springs.

    stiffness: (v, v) of the v virtual coordinates together, N, mm, rad; may couple them.
    rest: (n,) coordinates of the unloaded chain, where the springs carry nothing.
    springs: further laws on groups of coordinates, added to the linear part.
    loads: dead loads along the chain. drives: inputs that move the rest values.
    """

    chain: Chain
    stiffness: Array
    rest: Array
    springs: tuple[Spring, ...] = ()
    loads: tuple[DeadLoads, ...] = ()
    drives: tuple[Drive, ...] = ()

    def __post_init__(self) -> None:
        v, n = self.virtual.size, self.chain.size
        if self.stiffness.shape != (v, v):
            raise ValueError(f"{v} virtual coordinates need a {v}x{v} stiffness, got {self.stiffness.shape}")
        if self.rest.shape != (n,):
            raise ValueError(f"{n} coordinates need as many rest values, got shape {self.rest.shape}")
        for spring in self.springs:
            if not set(spring.coordinates) <= set(self.moving.tolist()):
                raise ValueError(f"a spring acts on moving coordinates only, got {spring.coordinates}")

    @cached_property
    def virtual(self) -> np.ndarray:
        """Numbers of the virtual coordinates theta."""
        return self.chain.indices(Role.VIRTUAL)

    @cached_property
    def passive(self) -> np.ndarray:
        """Numbers of the passive coordinates q."""
        return self.chain.indices(Role.PASSIVE)

    @cached_property
    def moving(self) -> np.ndarray:
        """Numbers of the coordinates that equilibrium decides: passive and virtual, in chain order."""
        return self.chain.indices(Role.PASSIVE, Role.VIRTUAL)

    @cached_property
    def elimination_order(self) -> np.ndarray:
        """Numbers of virtual coordinates, multiplier and passive ones among moving coordinates and multiplier."""
        m = self.moving.size
        place = {int(number): k for k, number in enumerate(self.moving)}
        virtual, passive = ([place[int(k)] for k in numbers] for numbers in (self.virtual, self.passive))
        return np.array([*virtual, *range(m, m + 6), *passive], dtype=int)

    @cached_property
    def full_stiffness(self) -> Array:
        """(m, m) linear stiffness of the moving coordinates, zero for the passive ones."""
        full = np.zeros((self.chain.size, self.chain.size))
        full[np.ix_(self.virtual, self.virtual)] = self.stiffness
        return full[np.ix_(self.moving, self.moving)]

    @cached_property
    def initial_memory(self) -> Array:
        """(M,) memory of all laws before any load."""
        return np.concatenate([np.zeros(0), *[s.law.initial_memory for s in self.springs]])

    def respond(self, strain: Array, memory: Array) -> Response:
        """Linear part and laws together at the strain (..., m) of the moving coordinates."""
        force = strain @ self.full_stiffness
        energy = 0.5 * np.sum(strain * force, axis=-1)
        if not self.springs:
            return Response(energy, force, self.full_stiffness, memory)
        tangent = np.broadcast_to(self.full_stiffness, (*strain.shape, self.moving.size)).copy()
        remembered = []
        for spring, numbers, part in zip(self.springs, self._groups, self._memories, strict=True):
            answer = spring.law.respond(strain[..., numbers], memory[..., part])
            force[..., numbers] += answer.force
            both = (numbers, numbers) if isinstance(numbers, slice) else np.ix_(numbers, numbers)
            tangent[..., *both] += answer.tangent
            energy = energy + answer.energy
            remembered.append(answer.memory)
        return Response(energy, force, tangent, np.concatenate(remembered, axis=-1))

    def force(self, strain: Array, memory: Array) -> Array:
        """(..., m) as in `respond`; laws that can do so leave out their tangent."""
        force = strain @ self.full_stiffness
        for spring, numbers, part in zip(self.springs, self._groups, self._memories, strict=True):
            own, past = strain[..., numbers], memory[..., part]
            law = spring.law
            alone = law.force(own, past) if isinstance(law, Direct) else law.respond(own, past).force
            force[..., numbers] += alone
        return np.asarray(force)

    def remember(self, strain: Array, memory: Array) -> Array:
        """Memory (..., M) of the laws after a step that ends at the strain (..., m)."""
        parts = zip(self.springs, self._groups, self._memories, strict=True)
        kept = [
            spring.law.respond(strain[..., numbers], memory[..., part]).memory
            for spring, numbers, part in parts
            if part.stop > part.start
        ]
        return np.concatenate([np.zeros((*strain.shape[:-1], 0)), *kept], axis=-1)

    @cached_property
    def _groups(self) -> tuple[np.ndarray | slice, ...]:
        """Numbers of each spring's coordinates among the moving ones; a slice, which is faster, where they follow."""
        return tuple(_followed(np.searchsorted(self.moving, spring.coordinates)) for spring in self.springs)

    @cached_property
    def _memories(self) -> tuple[slice, ...]:
        edges = np.cumsum([0, *[spring.law.initial_memory.size for spring in self.springs]])
        return tuple(slice(int(a), int(b)) for a, b in pairwise(edges))


class Mechanism(Protocol):
    """Elastic chains in parallel from the base to one platform.

    chains: each ends at the platform point; the same tuple each time, for what follows from it is kept.
    unloaded_pose: (6,) nominal pose of the unloaded platform, base frame.
    length: a characteristic length, mm; makes residuals and eigenvalues dimensionless.
    sensors: from the true pose and load to what is read, in the order they apply; none: read as they are.
    gauges: further readings along the chains.
    """

    def __hash__(self) -> int: ...

    @property
    def chains(self) -> tuple[ElasticChain, ...]: ...

    @property
    def unloaded_pose(self) -> Array: ...

    @property
    def length(self) -> float: ...

    @property
    def sensors(self) -> tuple[Sensor, ...]: ...

    @property
    def gauges(self) -> tuple[Gauge, ...]: ...


def _followed(numbers: np.ndarray) -> np.ndarray | slice:
    """The numbers as a slice if each is the last one's successor."""
    first = int(numbers[0])
    return slice(first, first + numbers.size) if np.all(np.diff(numbers) == 1) else numbers


def initial_memory(mechanism: Mechanism) -> Array:
    """(M,) memory of all chains before any load, chain after chain."""
    return np.concatenate([chain.initial_memory for chain in mechanism.chains])
