"""Nonlinear load path of a linkage of solid bars, driven by one platform coordinate."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import scipy.sparse as sp

from fem.factor import Factor, SolveError
from fem.large_strain import deformed_forces, force_and_tangent
from fem.linear import LinearModel, submatrix
from fem.linkage import PLATFORM, Linkage, Member
from fem.reduction import Placement, Reduction
from fem.rigid_face import PlatformPose
from fem.rotation import rotation_vector
from fem.space import Space
from meshes.solid import Floats, Ints

# Near a bifurcation the tangent is almost singular: a looser limit would take the straight path for the bent one.
RELATIVE_RESIDUAL = 1e-10
ITERATIONS = 12
EASY = 5
# Steps with the tangent of the point before, and what each has to take off the residual; a residual alone costs a
# tenth of a tangent with its factor.
STALE, CONTRACTION = 8, 0.2
SMALLEST_STEP = 1.0 / 256
UNSTABLE = "the equilibrium found is unstable, a stable branch leaves the path before it"
# Of one Newton step, mm or rad: beyond it the iteration has left for good.
LONGEST_STEP = 100.0


@dataclass(frozen=True)
class State:
    """Inner displacements (n,) mm, and where the rigid faces are."""

    inner: Floats
    at: Placement

    def moved(self, step: Floats) -> "State":
        """The state after a Newton step in all unknowns."""
        count = len(self.inner)
        pose = self.at.pose.moved(step[count : count + 6])
        return State(self.inner + step[:count], Placement(pose, self.at.angles + step[count + 6 :]))


@dataclass(frozen=True)
class Equilibrium:
    """Platform displacement (6,) mm and rad (rotation vector), wrench (6,) on the platform, Newton iterations, and the
    number of unstable modes (by the inertia of the tangent)."""

    displacement: Floats
    wrench: Floats
    iterations: int
    unstable: int


@dataclass(frozen=True)
class Path:
    """Converged points in order; `failure` is empty, or says where and why the path ended early."""

    points: tuple[Equilibrium, ...]
    failure: str

    def column(self, quantity: str, coordinate: str) -> Floats:
        """One coordinate of "displacement" or "wrench" along the path."""
        return np.array([getattr(p, quantity)[PLATFORM.index(coordinate)] for p in self.points])


def follow(
    model: LinearModel,
    held: Sequence[str],
    values: Sequence[float],
    driven: str = "x",
    on_point: Callable[[Equilibrium], None] | None = None,
    unstable_past: float = np.inf,
) -> Path:
    """Drive one platform coordinate through `values` (displacements from the unloaded pose, mm).

    The `held` coordinates stay at zero, the others are free of load. A step that does not converge, or that lands
    on an unstable branch, is cut in halves: bowed bars are followed onto their buckled branch, the path of perfect
    ones ends at its bifurcation. Where the driven coordinate is larger than `unstable_past`, unstable points count
    too: the branch reached by then is followed past further bifurcations. Raises ValueError when only some of the
    three rotations are held, `driven` is no translation, or a value equals the one before it (the first: zero).
    """
    require_sensible(held, values, driven)
    r = model.reduction
    state = State(np.zeros(r.starts[-1]), r.rest)
    stiffness = float(abs(model.reduced[r.platform([driven])[0], r.platform([driven])[0]]))
    points: list[Equilibrium] = []
    factor: Factor | None = None
    here, before, last = 0.0, None, 0.0
    for target in values:
        whole = step = target - here
        while here != target:
            goal = target if abs(target - here) <= abs(step) * (1.0 + 1e-9) else here + step
            ratio = 1.0 if before is None else (goal - here) / (here - last)
            finest = abs(step) / 2.0 < SMALLEST_STEP * abs(whole)
            try:
                start = state if before is None else extrapolated(before, state, ratio)
                # Past the easy ones it may end on the mirrored branch of a bifurcation: a shorter step is tried.
                most = ITERATIONS if finest else EASY + 1
                found, point, factor = settle(model, held, driven, start, goal, stiffness, factor, most)
                if point.unstable and abs(goal) <= unstable_past:
                    raise SolveError(UNSTABLE)
                if not finest and turns_back(before, state, found, ratio):
                    raise SolveError("the step was too long")
            except SolveError as error:
                if finest:
                    return Path(tuple(points), f"no equilibrium past {driven} = {here:.4g} mm: {error}")
                step, factor = step / 2.0, None
                continue
            before, state, last, here = state, found, here, goal
            step *= 2.0 if point.iterations <= EASY // 2 else 1.0
        points.append(point)
        if on_point is not None:
            on_point(point)
    return Path(tuple(points), "")


def require_sensible(held: Sequence[str], values: Sequence[float], driven: str) -> None:
    """Raise ValueError for a path that cannot be asked for."""
    if driven not in ("x", "y", "z"):
        raise ValueError(f"driven coordinate is {driven!r}, allowed are x, y, z")
    if any(a == b for a, b in pairwise([0.0, *values])):
        raise ValueError("two neighbouring values are equal, allowed are values that each move the platform")
    rotations = [name for name in ("rx", "ry", "rz") if name in held]
    if len(rotations) not in (0, 3):
        raise ValueError(f"held rotations are {', '.join(rotations)}, allowed are all three or none")


def turns_back(before: State | None, now: State, found: State, ratio: float) -> bool:
    """Whether a step leads against the one before it, where the driven coordinate does not (`ratio` above zero)."""
    if before is None:
        return False
    return ratio * float((found.inner - now.inner) @ (now.inner - before.inner)) < 0.0


def extrapolated(before: State, now: State, ratio: float) -> State:
    """The straight continuation of the last step."""
    inner = now.inner + ratio * (now.inner - before.inner)
    spin = rotation_vector(now.at.pose.orientation @ before.at.pose.orientation.T)
    shift = now.at.pose.position - before.at.pose.position
    pose = now.at.pose.moved(ratio * np.concatenate((shift, spin)))
    return State(inner, Placement(pose, now.at.angles + ratio * (now.at.angles - before.at.angles)))


def settle(
    model: LinearModel,
    held: Sequence[str],
    driven: str,
    start: State,
    value: float,
    scale: float,
    factor: Factor | None = None,
    most: int = ITERATIONS,
) -> tuple[State, Equilibrium, Factor]:
    """Newton's method at one value of the driven coordinate.

    It begins with the `factor` of an earlier tangent, if there is one, as long as that converges fast, and goes on
    with its own, `most` of them. Returns the factor of the tangent at the equilibrium too. Raises SolveError if it
    does not converge.

    `scale` N/mm times the size of the driven displacement is the load that the residual is measured against.
    """
    r = model.reduction
    free = r.others([driven, *held])
    limit = RELATIVE_RESIDUAL * scale * max(abs(value), 1e-3)
    state = pinned_down(r, start, driven, value)
    for iteration in range(most):
        if factor is not None:
            state = approached(model, free, state, factor, limit)
        residual, tangent = residual_and_tangent(model, state)
        error = float(np.abs(residual[free]).max())
        if error >= limit and iteration + 1 == most:
            break
        matrix = submatrix(tangent, free)
        factor = model.solver(matrix) if factor is None else factor.renewed(matrix)
        if error < limit:
            point = equilibrium(r, state, residual, iteration, factor.negative_eigenvalues)
            return state, point, factor
        step = np.zeros(r.size)
        step[free] = factor(-residual[free])
        if not np.all(np.isfinite(step)) or np.abs(step).max() > LONGEST_STEP:
            break
        state = state.moved(step)
    raise SolveError(f"Newton's method stopped at a residual of {error:.2g}, allowed is {limit:.2g}")


def approached(model: LinearModel, free: Ints, state: State, factor: Factor, limit: float) -> State:
    """The state after steps of the unknowns `free` (m,) with an earlier tangent, those of them that take most of the
    residual off."""
    r = model.reduction
    best, least = state, np.inf
    for _ in range(STALE):
        residual = residual_at(model, state)[free]
        error = float(np.abs(residual).max())
        if not error < least:
            break
        enough = error < CONTRACTION * least
        best, least = state, error
        if error < limit or not enough:
            break
        step = np.zeros(r.size)
        step[free] = factor(-residual)
        if not np.abs(step).max() < LONGEST_STEP:
            break
        state = state.moved(step)
    return best


def equilibrium(r: Reduction, state: State, residual: Floats, iterations: int, unstable: int) -> Equilibrium:
    """The point of the path at a state with its generalised forces (size,)."""
    shift = state.at.pose.position - r.linkage.point
    displacement = np.concatenate((shift, rotation_vector(state.at.pose.orientation)))
    return Equilibrium(displacement, residual[r.platform(PLATFORM)], iterations, unstable)


def pinned_down(r: Reduction, state: State, driven: str, value: float) -> State:
    """The state with the driven coordinate at its value."""
    position = state.at.pose.position.copy()
    axis = PLATFORM.index(driven)
    position[axis] = r.linkage.point[axis] + value
    return State(state.inner, Placement(PlatformPose(position, state.at.pose.orientation), state.at.angles))


def residual_at(model: LinearModel, state: State) -> Floats:
    """Generalised forces (size,) at a state."""
    r = model.reduction
    fields = r.displacements(state.inner, state.at)
    members = zip(r.linkage.members, fields, strict=True)
    return r.loads([deformed_forces(m.space, model.isotropic, u) for m, u in members], state.at)


def residual_and_tangent(model: LinearModel, state: State) -> tuple[Floats, sp.csr_matrix]:
    """Generalised forces (size,) and their symmetric tangent at a state."""
    r = model.reduction
    fields = r.displacements(state.inner, state.at)
    evaluated = [
        force_and_tangent(m.space, model.isotropic, u) for m, u in zip(r.linkage.members, fields, strict=True)
    ]
    forces = [f for f, _ in evaluated]
    tangent = r.reduce([k for _, k in evaluated], state.at, r.curvature(forces, state.at))
    return r.loads(forces, state.at), tangent


def with_imperfection(linkage: Linkage, displacements: Sequence[Floats], amplitude: float) -> Linkage:
    """The linkage with every bar bent, free of stress, into one mode shape.

    `displacements` are the node displacements (dofs,) of each member, as a buckling mode gives them; the shape of
    the member that moves most is given to all, `amplitude` mm at its largest. Every bar gets the same shape,
    so that equal bars stay equal even where their separate modes have the same load.
    """
    shapes = [np.asarray(d).reshape(-1, 3) for d in displacements]
    sizes = [float(np.linalg.norm(s, axis=1).max()) for s in shapes]
    largest = int(np.argmax(sizes))
    shape = shapes[largest] * (amplitude / sizes[largest])
    space = linkage.members[largest].space
    bent = Space.of(space.mesh.moved(shape))
    shift = shape[space.mesh.face_nodes("tip")].mean(axis=0)
    members = tuple(
        Member(bent, m.origin, m.turn, m.tip_middle + shift, m.base_axis, m.tip_axis) for m in linkage.members
    )
    first = linkage.members[largest]
    return Linkage(members, linkage.point + first.turn @ shift)
