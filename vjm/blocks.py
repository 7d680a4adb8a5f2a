"""Newton's step and the inertia of a mechanism, leg by leg.

Chains meet at the platform only, so the step needs no larger system than that of one chain with its loops: each is
one bordered block, eliminated onto the six equations of the platform (Eq. 10), and unstable directions add up over
the blocks. A chain that is rigid in some direction has a singular block in a regular whole: it stays beside the
platform.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from vjm.frames import Array
from vjm.lagrangian import ChainRows, Layout, layout
from vjm.mechanism import Mechanism
from vjm.newton import negatives, solve_each, solve_symmetric

NOBODY = np.zeros(0, dtype=int)
"""Of no member unstable directions are counted."""


@dataclass(frozen=True, eq=False)
class Control:
    """Six equations of the platform, one for each of its coordinates, linearised and dimensionless.

    by_pose, by_load: (B, 6, 6) by the pose and by the sum of the multipliers. by_coordinates: (B, 6, m) by a
    chain's coordinates, None where no gauge on it is controlled. held: (B, 6) equations that hold a motion.
    plain: whether each equation is about the coordinate itself, its pose or its load.
    """

    by_pose: Array
    by_load: Array
    by_coordinates: tuple[Array | None, ...]
    held: np.ndarray
    plain: bool


@dataclass(frozen=True, eq=False)
class Solution:
    """step: (B, N, r) dimensionless. regular: (B,). stiffness: (B, 6, 6) dimensionless, the sum of Eq. 10 over the
    chains that are eliminated; eliminated: (B,) whether these can be. counted: (m,) numbers of members; beyond: (m,)
    what the matrices of these chains have of negative eigenvalues beyond the six of each of their closures.

    control: (B, 6, K) the platform's equations by its motion and the unknowns of chains that are not eliminated, all
    else following.
    """

    step: Array
    regular: np.ndarray
    stiffness: Array
    eliminated: np.ndarray
    control: Array
    counted: np.ndarray
    beyond: np.ndarray


def newton_step(
    mechanism: Mechanism,
    rows: tuple[ChainRows, ...],
    right: Array,
    control: Control,
    counted: np.ndarray = NOBODY,
) -> Solution:
    """Dimensionless solutions of H step = right, chain by chain; the platform's rows are those of the control.
    counted: numbers (m,) of the members of which `unstable_directions` are counted.

    right: (B, N, r) dimensionless. Each chain is solved for its own right side and for six unit motions of the
    platform, which leaves 6x6 equations with the sum of the chains' stiffness (Eq. 10). A chain that is rigid in some
    direction has no stiffness by itself: its unknowns stay beside those of the platform.
    """
    place, count = layout(mechanism), right.shape[-1]
    step = np.empty_like(right)
    stiffness = np.zeros((len(right), 6, 6))
    platform, matrix = right[:, place.platform], control.by_pose
    carried = np.zeros((len(right), 6, count))
    regular, answers = np.ones(len(right), dtype=bool), {}
    beyond = np.zeros(counted.size, dtype=int)
    for k, (chain, by) in enumerate(zip(mechanism.chains, control.by_coordinates, strict=True)):
        if chain.rigid:
            continue
        m = place.coordinates[k].stop - place.coordinates[k].start
        answer, solvable, below = _answers(place, rows[k], k, right, counted)
        beyond += below - chain.closures
        load, own = np.split(answer[:, m : m + 6], [count], axis=-1)
        carried += load
        if by is not None:
            platform, matrix = platform - by @ answer[:, :m, :count], matrix + by @ answer[:, :m, count:]
        stiffness += own
        regular &= solvable
        answers[k] = answer
    platform = platform - control.by_load @ carried
    matrix = matrix + control.by_load @ stiffness
    whole = _Whole.of(mechanism)
    if whole.numbers:
        matrix = whole.bordered(rows, control, matrix)
        platform = np.concatenate([platform, right[:, whole.places]], axis=1)
    motion, solvable = solve_each(matrix, platform)
    step[:, place.platform], step[:, whole.places] = motion[:, :6], motion[:, 6:]
    for k, answer in answers.items():
        x = place.coordinates[k]
        both = answer[..., :count] + answer[..., count:] @ motion[:, :6]
        step[:, x], step[:, place.closing[k]] = both[:, : x.stop - x.start], both[:, x.stop - x.start :]
    return Solution(step, regular & solvable, stiffness, regular, matrix[:, :6], counted, beyond)


def _answers(
    place: Layout, row: ChainRows, number: int, right: Array, counted: np.ndarray
) -> tuple[Array, np.ndarray, np.ndarray]:
    """Solutions (B, m + c, r + 6) of a chain's block for its own right side and for six unit motions of the platform,
    whether it is regular (B,), and the negative eigenvalues of the counted members."""
    x, dual = place.coordinates[number], place.closing[number]
    m, count = x.stop - x.start, right.shape[-1]
    sides = np.zeros((len(right), m + dual.stop - dual.start, count + 6))
    sides[:, :m, :count], sides[:, m:, :count] = right[:, x], right[:, dual]
    sides[:, m : m + 6, count:] = -np.eye(6)
    return solve_symmetric(_dimensionless(place, row, x, dual), sides, counted)


def chain_stiffnesses(mechanism: Mechanism, rows: tuple[ChainRows, ...]) -> Array:
    """(B, chains, 6, 6) load of each chain by the motion of the platform, all else following; N, mm, rad.

    numpy.linalg.LinAlgError where a chain is rigid in some direction, or critical while the platform is held.
    """
    place = layout(mechanism)
    none = np.zeros((len(rows[0].gap), place.size, 0))
    out = []
    for k, row in enumerate(rows):
        m = place.coordinates[k].stop - place.coordinates[k].start
        answer, regular, _ = _answers(place, row, k, none, NOBODY)
        if mechanism.chains[k].rigid or not regular.all():
            raise np.linalg.LinAlgError("a chain has no stiffness of its own there")
        own = answer[:, m : m + 6] * place.load_scale[:, None] / place.pose_scale
        out.append(0.5 * (own + np.swapaxes(own, -1, -2)))
    return np.stack(out, axis=1)


@dataclass(frozen=True, eq=False)
class _Whole:
    """The chains that are rigid in some direction: their numbers, and the places (W,) of their unknowns."""

    mechanism: Mechanism
    numbers: tuple[int, ...]
    places: np.ndarray

    @classmethod
    def of(cls, mechanism: Mechanism) -> _Whole:
        place = layout(mechanism)
        numbers = tuple(k for k, chain in enumerate(mechanism.chains) if chain.rigid)
        own = [np.r_[place.coordinates[k], place.closing[k]] for k in numbers]
        return cls(mechanism, numbers, np.concatenate([np.zeros(0, dtype=int), *own]))

    def blocks(self, rows: tuple[ChainRows, ...]) -> Array:
        """(B, 6 + W, 6 + W) symmetric, of the platform and these chains: their matrices, and what ties them to it."""
        place = layout(self.mechanism)
        size = 6 + self.places.size
        out, at = np.zeros((len(rows[0].matrix), size, size)), 6
        for k in self.numbers:
            x, dual = place.coordinates[k], place.closing[k]
            matrix = _dimensionless(place, rows[k], x, dual)
            own, load = (
                slice(at, at + matrix.shape[-1]),
                slice(at + x.stop - x.start, at + x.stop - x.start + 6),
            )
            out[:, own, own] = matrix
            out[:, load, :6] = out[:, :6, load] = np.eye(6)
            at = own.stop
        return out

    def bordered(self, rows: tuple[ChainRows, ...], control: Control, matrix: Array) -> Array:
        """`blocks` with the platform's rows those of the control, matrix (B, 6, 6) by its motion."""
        place, out = layout(self.mechanism), self.blocks(rows)
        out[:, :6, :6], at = matrix, 6
        for k in self.numbers:
            m = place.coordinates[k].stop - place.coordinates[k].start
            by = control.by_coordinates[k]
            if by is not None:
                out[:, :6, at : at + m] = by
            out[:, :6, at + m : at + m + 6] = control.by_load
            at += m + place.closing[k].stop - place.closing[k].start
        return out


def unstable_directions(
    mechanism: Mechanism, rows: tuple[ChainRows, ...], found: Solution, control: Control
) -> np.ndarray:
    """Number (m,) of unstable directions of the counted members, chain by chain; -1 where it is not known.

    Inertia adds up over the elimination (E. V. Haynsworth, "Determination of the inertia of a partitioned
    Hermitian matrix", Linear Algebra and its Applications 1, 1968): what each chain's matrix has beyond the six
    negative eigenvalues of each of its closures, and what is left on the motions of the platform that the control
    allows.
    """
    members, count = found.counted, found.beyond
    if members.size == 0:
        return count
    stiffness, held = found.stiffness[members], control.held[members]
    whole = _Whole.of(mechanism)
    if whole.numbers:
        taken = tuple(ChainRows(r.balance, r.gap, r.matrix[members]) for r in rows)
        return _beside(whole, taken, stiffness, found.control[members], control, held, count)
    if not control.plain:
        return count + _on_allowed(stiffness, found.control[members], held)
    both = ~held[:, :, None] & ~held[:, None, :]
    return count + negatives(np.where(both, stiffness, np.eye(6)))


def _beside(
    whole: _Whole,
    rows: tuple[ChainRows, ...],
    stiffness: Array,
    by_all: Array,
    control: Control,
    held: np.ndarray,
    count: np.ndarray,
) -> np.ndarray:
    """The count (B,) with what chains that are not eliminated and the platform add; -1 where a held reading follows
    the load, which such chains do not have by their motion."""
    matrix = whole.blocks(rows)
    matrix[:, :6, :6] = 0.5 * (stiffness + np.swapaxes(stiffness, -1, -2))
    closures = sum(whole.mechanism.chains[k].closures for k in whole.numbers)
    out = count + _on_allowed(matrix, by_all, held) - closures
    by_load = np.broadcast_to(control.by_load, (*control.held.shape, 6))
    follows = np.any(np.where(control.held[..., None], by_load, 0.0) != 0.0)
    return np.full_like(out, -1) if follows else out


def _on_allowed(stiffness: Array, control: Array, held: np.ndarray) -> np.ndarray:
    """Negative eigenvalues (B,) of the stiffness (B, K, K) on motions that leave the held equations (B, 6, K) alone.

    Bordered with k such equations, the stiffness has k negative eigenvalues more.
    """
    n = stiffness.shape[-1]
    bordered = np.zeros((len(stiffness), n + 6, n + 6))
    bordered[:, :n, :n] = 0.5 * (stiffness + np.swapaxes(stiffness, -1, -2))
    rows = np.where(held[..., None], control, 0.0)
    size = np.linalg.norm(rows, axis=-1, keepdims=True)
    rows = rows / np.where(size > 0, size, 1.0)
    bordered[:, n:, :n], bordered[:, :n, n:] = rows, np.swapaxes(rows, -1, -2)
    bordered[:, range(n, n + 6), range(n, n + 6)] = ~held
    return negatives(bordered) - np.sum(held, axis=-1)


def _dimensionless(place: Layout, row: ChainRows, x: slice, dual: slice) -> Array:
    scale = np.concatenate([place.scale[x], place.scale[dual]])
    return row.matrix * np.outer(scale, scale / place.energy)
