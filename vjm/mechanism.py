"""What the solvers need to know of a mechanism: elastic chains that meet at one platform, and its sensors.

A chain may have closed loops inside: further paths between bodies on it, with coordinates of their own.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Protocol

import numpy as np

from vjm.chain import Chain, Joint, Role
from vjm.frames import Array
from vjm.gauges import Gauge
from vjm.kernels import NO_COLUMN
from vjm.laws import Adding, Response, Spring
from vjm.loads import DeadLoads
from vjm.sensors import Sensor

NONE = np.zeros((0, 0, 0))
"""No matrix: a tangent is not asked for."""


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
class Path:
    """A chain and the numbers (n,) of its coordinates among those of the leg that it belongs to."""

    chain: Chain
    numbers: np.ndarray

    def __post_init__(self) -> None:
        if self.numbers.size != self.chain.size:
            raise ValueError(f"a chain has {self.chain.size} coordinates, got {self.numbers.size} numbers")


@dataclass(frozen=True, eq=False)
class Loop:
    """A closed loop: two paths from one body of a leg to another one, T_1 = T_2 of the paper."""

    first: Path
    second: Path

    @property
    def sides(self) -> tuple[tuple[Path, float], tuple[Path, float]]:
        """Both paths with their sign in the closure g_2 - g_1 = 0."""
        return (self.second, 1.0), (self.first, -1.0)


@dataclass(frozen=True, eq=False)
class Varying:
    """A linear spring that follows an input: stiffness(value (...)) is the (..., k, k) of the k coordinates."""

    coordinates: np.ndarray
    drive: str
    stiffness: Callable[[Array], Array]


@dataclass(frozen=True, eq=False)
class Closed:
    """A path in a closure of its leg, with its sign there.

    dual: where the closure's multipliers begin among those of the leg. columns: (n,) numbers of the path's coordinates
    among the moving ones of the leg, `NO_COLUMN` of others. whole: whether its coordinates are all those of the leg, in
    their order.
    """

    path: Path
    sign: float
    dual: int
    columns: np.ndarray
    whole: bool


def joints_of(chain: Chain, loops: tuple[Loop, ...]) -> tuple[Joint, ...]:
    """The joint of every coordinate of a chain and the second paths of its loops."""
    every = dict(enumerate(chain.joints))
    for loop in loops:
        every |= dict(zip(loop.second.numbers.tolist(), loop.second.chain.joints, strict=True))
    return tuple(every[k] for k in range(len(every)))


@dataclass(frozen=True, eq=False)
class ElasticChain:
    """A chain with its springs, from the base to the platform: the leg of a mechanism.

    stiffness: (v, v) of the v virtual coordinates together, N, mm, rad; may couple them.
    rest: (n,) coordinates of the unloaded leg, where the springs carry nothing.
    springs: further laws on groups of coordinates, added to the linear part.
    loads: dead loads along the chain. drives: inputs that move the rest values.
    loops: closed loops inside, whose second paths have the coordinates that follow those of the chain.
    varying: linear springs that follow an input, beside `stiffness`. name: for messages.
    """

    chain: Chain
    stiffness: Array
    rest: Array
    springs: tuple[Spring, ...] = ()
    loads: tuple[DeadLoads, ...] = ()
    drives: tuple[Drive, ...] = ()
    loops: tuple[Loop, ...] = ()
    varying: tuple[Varying, ...] = ()
    name: str = ""

    def __post_init__(self) -> None:
        v, n = self.virtual.size, self.size
        if self.stiffness.shape != (v, v):
            raise ValueError(f"{v} virtual coordinates need a {v}x{v} stiffness, got {self.stiffness.shape}")
        if self.rest.shape != (n,):
            raise ValueError(f"{n} coordinates need as many rest values, got shape {self.rest.shape}")
        for spring in self.springs:
            if not set(spring.coordinates) <= set(self.moving.tolist()):
                raise ValueError(f"a spring acts on moving coordinates only, got {spring.coordinates}")

    @cached_property
    def joints(self) -> tuple[Joint, ...]:
        """The joint of every coordinate, which stands for its kind and role."""
        return joints_of(self.chain, self.loops) if self.loops else self.chain.joints

    @property
    def size(self) -> int:
        """Number of coordinates n, those of the loops included."""
        return len(self.joints)

    @property
    def closures(self) -> int:
        """Number of scalar closure equations: six at the platform and six of each loop."""
        return 6 + 6 * len(self.loops)

    @cached_property
    def virtual(self) -> np.ndarray:
        """Numbers of the virtual coordinates theta."""
        return self._numbers(Role.VIRTUAL)

    @cached_property
    def passive(self) -> np.ndarray:
        """Numbers of the passive coordinates q."""
        return self._numbers(Role.PASSIVE)

    @cached_property
    def moving(self) -> np.ndarray:
        """Numbers of the coordinates that equilibrium decides: passive and virtual, in chain order."""
        return self._numbers(Role.PASSIVE, Role.VIRTUAL)

    def _numbers(self, *roles: Role) -> np.ndarray:
        return np.array([k for k, joint in enumerate(self.joints) if joint.role in roles], dtype=int)

    @cached_property
    def closed(self) -> tuple[Closed, ...]:
        """The paths of its closures, that of the platform first: t - g, then g_2 - g_1 of each loop."""
        sides = [((self.main, -1.0),), *(loop.sides for loop in self.loops)]
        every = np.arange(self.size)
        return tuple(
            Closed(path, sign, 6 * k, self._columns(path.numbers), np.array_equal(path.numbers, every))
            for k, both in enumerate(sides)
            for path, sign in both
        )

    @cached_property
    def load_columns(self) -> tuple[np.ndarray, ...]:
        """Of each load: (k,) numbers of its path's coordinates among the moving ones, `NO_COLUMN` of others."""
        return tuple(self._columns(load.coordinates) for load in self.loads)

    def _columns(self, numbers: np.ndarray) -> np.ndarray:
        place = {int(number): k for k, number in enumerate(self.moving)}
        return np.array([place.get(int(number), NO_COLUMN) for number in numbers], dtype=np.int64)

    @cached_property
    def main(self) -> Path:
        """The chain with the numbers of its coordinates, which come first."""
        return Path(self.chain, np.arange(self.chain.size))

    def at_inputs(self, values: Mapping[str, float]) -> ElasticChain:
        """The same leg with other defaults of these inputs: it is at rest there."""
        moved = [drive for drive in self.drives if drive.name in values]
        rest = sum(((values[d.name] - d.default) * d.slope for d in moved), start=self.rest)
        drives = [replace(d, default=float(values.get(d.name, d.default))) for d in self.drives]
        return replace(self, rest=rest, drives=tuple(drives))

    @cached_property
    def rigid(self) -> bool:
        """Whether no motion of its joints and springs reaches some closure of it, at rest: a direction of its end in
        which it is rigid."""
        length = max(float(np.max(np.abs(self.rest), initial=0.0)), self._reach, 1e-300)
        jacobian = (
            self.close(self.rest)[1] / np.tile(np.repeat([length, 1.0], 3), self.closures // 6)[:, None]
        )
        size = np.array([length if joint.kind == "translation" else 1.0 for joint in self.joints])
        return rank((jacobian * size)[:, self.moving]) < self.closures

    @property
    def _reach(self) -> float:
        """How far from the base it gets on its way, mm."""
        return float(np.linalg.norm(self.chain.pose(self.rest[: self.chain.size])[:3]))

    def close(self, coordinates: Array) -> tuple[Array, Array]:
        """(..., c) pose of the end of the chain, then g_2 - g_1 of each loop, and their Jacobian (..., c, n) at all
        coordinates (..., n)."""
        if not self.loops:
            here = self.chain.kinematics(coordinates)
            return here.pose, here.jacobian
        ends = np.zeros((*coordinates.shape[:-1], self.closures))
        out = np.zeros((*ends.shape, self.size))
        for number, sides in enumerate([((self.main, 1.0),), *(loop.sides for loop in self.loops)]):
            rows = slice(6 * number, 6 * number + 6)
            for path, sign in sides:
                here = path.chain.kinematics(coordinates[..., path.numbers])
                ends[..., rows] += sign * here.pose
                out[..., rows, path.numbers] += sign * here.jacobian
        return ends, out

    @cached_property
    def full_stiffness(self) -> Array:
        """(m, m) linear stiffness of the moving coordinates, zero for the passive ones."""
        full = np.zeros((self.size, self.size))
        full[np.ix_(self.virtual, self.virtual)] = self.stiffness
        return full[np.ix_(self.moving, self.moving)]

    @cached_property
    def initial_memory(self) -> Array:
        """(M,) memory of all laws before any load."""
        return np.concatenate([np.zeros(0), *[s.law.initial_memory for s in self.springs]])

    def linear(self, inputs: Mapping[str, Array]) -> Array:
        """(m, m) or (..., m, m) linear stiffness of the moving coordinates at the inputs (...)."""
        if not self.varying:
            return self.full_stiffness
        batch = np.broadcast_shapes(*(np.shape(inputs[v.drive]) for v in self.varying))
        full = np.broadcast_to(self.full_stiffness, (*batch, *self.full_stiffness.shape)).copy()
        for each in self.varying:
            at = np.searchsorted(self.moving, each.coordinates)
            full[..., at[:, None], at] += each.stiffness(np.asarray(inputs[each.drive]))
        return full

    def respond(self, strain: Array, memory: Array, linear: Array | None = None) -> Response:
        """Linear part and laws together at the strain (..., m) of the moving coordinates.

        linear: of `linear`, default the stiffness that does not follow an input.
        """
        stiffness = self.full_stiffness if linear is None else linear
        force = _along(stiffness, strain)
        energy = 0.5 * np.sum(strain * force, axis=-1)
        if not self.springs:
            return Response(energy, force, stiffness, memory)
        tangent = np.broadcast_to(stiffness, (*strain.shape, self.moving.size)).copy()
        remembered = []
        for spring, numbers, part in zip(self.springs, self._groups, self._memories, strict=True):
            answer = spring.law.respond(strain[..., numbers], memory[..., part])
            force[..., numbers] += answer.force
            both = (numbers, numbers) if isinstance(numbers, slice) else np.ix_(numbers, numbers)
            tangent[..., *both] += answer.tangent
            energy = energy + answer.energy
            remembered.append(answer.memory)
        return Response(energy, force, tangent, np.concatenate(remembered, axis=-1))

    def force(self, strain: Array, memory: Array, linear: Array | None = None, matrix: Array = NONE) -> Array:
        """(..., m) as in `respond`. matrix: (..., M, M), contiguous, that begins with the coordinates and to which the
        tangent of the laws is added; without it laws that can do so leave theirs out."""
        force = _along(self.full_stiffness if linear is None else linear, strain)
        every = np.arange(self.moving.size)
        for spring, numbers, part in zip(self.springs, self._groups, self._memories, strict=True):
            own, past, law = strain[..., numbers], memory[..., part], spring.law
            if isinstance(law, Adding):
                alone = law.add(own, past, every[numbers], matrix)
            else:
                answer = law.respond(own, past)
                alone = answer.force
                if matrix.size:
                    both = (numbers, numbers) if isinstance(numbers, slice) else np.ix_(numbers, numbers)
                    matrix[..., *both] += answer.tangent
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


RANK = 1e-9
"""Singular value, over the largest, below which a direction counts as missing."""


def rank(matrix: Array) -> int:
    """Number of singular values of a dimensionless matrix (m, n) that are not zero to rounding."""
    if not matrix.size:
        return 0
    values = np.linalg.svd(matrix, compute_uv=False)
    return int(np.sum(values > RANK * values[0]))


def _along(stiffness: Array, strain: Array) -> Array:
    """Forces (..., m) of a symmetric stiffness (m, m) or (..., m, m)."""
    if stiffness.ndim == 2:
        return np.asarray(strain @ stiffness)
    return np.asarray((stiffness @ strain[..., None])[..., 0])


def _followed(numbers: np.ndarray) -> np.ndarray | slice:
    """The numbers as a slice if each is the last one's successor."""
    first = int(numbers[0])
    return slice(first, first + numbers.size) if np.all(np.diff(numbers) == 1) else numbers


def initial_memory(mechanism: Mechanism) -> Array:
    """(M,) memory of all chains before any load, chain after chain."""
    return np.concatenate([chain.initial_memory for chain in mechanism.chains])
