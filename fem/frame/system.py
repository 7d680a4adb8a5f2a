"""Forces and tangent of a whole frame, its bars condensed to their ends and those to bodies and joint coordinates.

Unknowns, in this order: for base and platform a shift and a spatial spin (6 each), then the joint coordinates of bar 1
base, bar 1 tip, bar 2 base, ...
"""

from dataclasses import dataclass

import numpy as np

from fem.frame import chain
from fem.frame.base import base_coordinates, base_forces
from fem.frame.batch import Bools
from fem.frame.condensation import Condensed, condense
from fem.frame.element import force_and_tangent, turned_over
from fem.frame.fibres import yielded
from fem.frame.joints import joint_forces
from fem.frame.loads import line_load, point_on_axis
from fem.frame.model import BASE, PLATFORM, Model, State, Unloaded
from fem.frame.placed import base_laws, joint_laws
from fem.frame.so3 import apply, dot, transpose
from meshes.solid import Floats

BODIES = 12
PLATFORM_ROWS = slice(6 * PLATFORM, 6 * PLATFORM + 6)


@dataclass(frozen=True, eq=False)
class Nodes:
    """All nodes of the bars, x (B, K, n + 1, 3) and R (B, K, n + 1, 3, 3), rates (B, K, 2, 6, 6 + S) of ends."""

    x: Floats
    R: Floats
    rates: Floats


@dataclass(frozen=True, eq=False)
class System:
    """A linearised frame in its m unknowns.

    tangent (B, m, m), load (B, m): condensed stiffness and out-of-balance force, without the platform wrench;
    raw (B, m): the same force before condensation; inner (B, K, n - 1, 6): out-of-balance at inner nodes.
    gauge (B, G): coordinates of the gauged points, mm; gauge_rates (B, G, m); gauge_shift (B, G): what the inner
    out-of-balance adds to them in the next step. slider, plastic, memory: memories that this state would leave.
    turned (B,): whether an element has turned over, so that the frame is none.
    """

    tangent: Floats
    load: Floats
    raw: Floats
    inner: Floats
    gauge: Floats
    gauge_rates: Floats
    gauge_shift: Floats
    condensed: Condensed
    rates: Floats
    slider: Floats
    plastic: Floats
    memory: Floats
    turned: Bools


def active(model: Model) -> Bools:
    """(B, m) unknowns that a test has."""
    joints = model.joints.active.reshape(len(model.nominal), -1)
    return np.concatenate((model.base_active, np.ones_like(model.base_active), joints), axis=1)


def columns(model: Model, bar: int, end: int) -> list[int]:
    """Places of the unknowns of one end of a bar: its body, then its joint coordinates."""
    slots = len(model.joints.slots)
    start = BODIES + (2 * bar + end) * slots
    body = model.joints.bodies[bar][end]
    return [*range(6 * body, 6 * body + 6), *range(start, start + slots)]


def nodes_of(model: Model, unloaded: Unloaded, state: State) -> Nodes:
    """Nodes of all bars, their ends placed by bodies and joints."""
    joints = model.joints
    body = np.array(joints.bodies)
    ends = chain.end_of(state.X[:, body], state.R[:, body], joints.place, joints.frame, state.q, joints.slots)
    R = ends.R @ unloaded.triads
    return Nodes(
        np.concatenate((ends.x[:, :, :1], state.x, ends.x[:, :, 1:]), axis=2),
        np.concatenate((R[:, :, :1], state.r, R[:, :, 1:]), axis=2),
        ends.rates,
    )


def evaluate(model: Model, unloaded: Unloaded, state: State, dead: Floats) -> System:
    """Linearise the frame at a state under the share `dead` (B,) of its dead loads."""
    nodes = nodes_of(model, unloaded, state)
    force, tangent, plastic = _elements(model, unloaded, state, nodes, dead)
    inner = force[:, :, :-1, 6:] + force[:, :, 1:, :6]
    gauge, side = _gauges(model, unloaded, nodes)
    condensed = condense(tangent, np.concatenate((force[..., None], side), axis=-1))
    ends = np.stack((force[:, :, 0, :6], force[:, :, -1, 6:]), axis=2)
    added = chain.geometric(nodes.rates, ends)
    joint_force, joint_stiffness, slider = joint_forces(model.joints, state.q, state.slider)
    count, size = len(gauge), BODIES + state.q[0].size
    K, sides = np.zeros((count, size, size)), np.zeros((count, size, 1 + side.shape[-1]))
    raw = np.zeros((count, size))
    for bar in range(state.q.shape[1]):
        first, last = columns(model, bar, 0), columns(model, bar, 1)
        both = np.array(first + last)
        J = np.zeros((count, 12, len(both)))
        J[:, :6, : len(first)], J[:, 6:, len(first) :] = nodes.rates[:, bar, 0], nodes.rates[:, bar, 1]
        K[:, both[:, None], both] += transpose(J) @ condensed.stiffness[:, bar] @ J
        sides[:, both] += transpose(J) @ condensed.sides[:, bar]
        for end, place in enumerate((first, last)):
            at = np.array(place)
            K[:, at[:, None], at] += added[:, bar, end]
            raw[:, at] += chain.work_rate(nodes.rates[:, bar, end], ends[:, bar, end])
    memory = state.memory
    if model.joints.placed:
        more, stiffer, memory = _placed(model, state, nodes, ends)
        joint_force, joint_stiffness = joint_force + more, joint_stiffness + stiffer
    rest, springs, memory = _concentrated(model, state, (joint_force, joint_stiffness, memory), dead)
    K += springs
    shift = -condensed.products[..., 1:].sum(1)
    rates = transpose(sides[..., 1:])
    _on_platform(model, state, gauge, rates)
    return System(
        K,
        sides[..., 0] + rest,
        raw + rest,
        inner,
        gauge,
        rates,
        shift,
        condensed,
        nodes.rates,
        slider,
        plastic,
        memory,
        np.any(turned_over(nodes.x, nodes.R), axis=(1, 2)),
    )


def _elements(
    model: Model, unloaded: Unloaded, state: State, nodes: Nodes, dead: Floats
) -> tuple[Floats, Floats, Floats]:
    """Forces and tangents of all elements with their line load, and the plastic strains they would leave."""
    ref, left = unloaded.elements, [state.plastic]

    def correct(strain: Floats, eps: Floats, rate: Floats) -> tuple[Floats, Floats]:
        assert model.fibres is not None
        gradient, hessian, new = yielded(model.fibres, ref, state.plastic, strain, eps, rate)
        left[0] = new
        return gradient, hessian

    force, tangent = force_and_tangent(nodes.x, nodes.R, ref, correct if model.fibres else None)
    if model.line_load.any():
        along = (dead[:, None] * model.line_load)[:, None, None, :]
        gradient, hessian = line_load(ref.h, nodes.R, along)
        force, tangent = force + gradient, tangent + hessian
    return force, tangent, left[0]


def _placed(model: Model, state: State, nodes: Nodes, ends: Floats) -> tuple[Floats, Floats, Floats]:
    """Forces and stiffnesses (B, K, 2, S) of placed joint laws and their memories; ends (B, K, 2, 6): bars' loads."""
    axes = nodes.R[:, :, [0, -1]][..., 0]
    axial = dot(axes, ends[..., :3])
    return joint_laws(model.joints.placed, state.q, model.joints.relaxed, axial, state.memory)


def _concentrated(
    model: Model, state: State, joints: tuple[Floats, Floats, Floats], dead: Floats
) -> tuple[Floats, Floats, Floats]:
    """Forces (B, m) and stiffness (B, m, m) of joint laws, what holds the base, and the platform's dead load; memories.

    joints: forces and stiffnesses (B, K, 2, S) and the memories (B, M) that they leave.
    """
    joint_force, joint_stiffness, memory = joints
    count = len(dead)
    size = BODIES + joint_force[0].size
    force, stiffness = np.zeros((count, size)), np.zeros((count, size, size))
    force[:, BODIES:] = joint_force.reshape(count, -1)
    place = np.arange(BODIES, size)
    stiffness[:, place, place] = joint_stiffness.reshape(count, -1)
    if model.base_active.any():
        at = base_coordinates(state.X[:, BASE], state.R[:, BASE])
        more, stiffer, memory = base_laws(model.joints.placed, at, memory)
        own = model.base_stiffness * at + more
        force[:, :6], stiffness[:, :6, :6] = base_forces(at, own, model.base_stiffness + stiffer)
    force[:, 6 * PLATFORM : 6 * PLATFORM + 3] -= dead[:, None] * model.platform_force
    return force, stiffness, memory


def _gauges(model: Model, unloaded: Unloaded, nodes: Nodes) -> tuple[Floats, Floats]:
    """Coordinates (B, G) of the gauged points and their rates as right sides (B, K, n, 12, G)."""
    h, grid, gauges = unloaded.elements.h, model.bars.grid, model.gauges
    tests = np.arange(len(h))
    value = np.zeros((len(h), len(gauges.bar)))
    side = np.zeros((*h.shape, 12, len(gauges.bar)))
    for g, bar in enumerate(gauges.bar):
        if bar is None:
            continue
        station = gauges.station[:, g]
        element = np.clip((grid[:, bar] <= station[:, None]).sum(1) - 1, 0, h.shape[-1] - 1)
        low, high = grid[tests, bar, element], grid[tests, bar, element + 1]
        pair = np.stack((element, element + 1), axis=-1)
        value[:, g], side[tests, bar, element, :, g] = point_on_axis(
            h[tests, bar, element],
            (station - low) / (high - low),
            nodes.x[tests[:, None], bar, pair],
            nodes.R[tests[:, None], bar, pair],
            gauges.direction[:, g],
        )
    return value, side


def _on_platform(model: Model, state: State, gauge: Floats, rates: Floats) -> None:
    """Writes coordinates (B, G) and rates (B, G, m) of the gauges on the platform, which turns with its own spin."""
    for g, bar in enumerate(model.gauges.bar):
        if bar is None:
            along, arm = model.gauges.direction[:, g], apply(state.R[:, PLATFORM], model.gauges.offset[:, g])
            gauge[:, g] = np.sum(along * (state.X[:, PLATFORM] + arm), axis=-1)
            rates[:, g, PLATFORM_ROWS] = np.concatenate((along, np.cross(arm, along)), axis=-1)
