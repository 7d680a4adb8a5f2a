"""Laws at sites of a frame: where each one acts, with what memory, and the forces of all of them.

The memory of a test is one row of numbers: for each law and each place where it acts its coordinate and force in the
accepted state, then what the law itself remembers.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fem.frame.batch import Bools
from fem.frame.chain import NUMBERED, SERIES
from fem.frame.laws.form import Elastic, Law, Response
from fem.frame.sites import BASE, ENDS, HINGE, Site, site_of
from meshes.solid import Floats

AHEAD = 2
"""Numbers that stand before a law's own memory: coordinate and force."""
CHAIN_ORDER = np.array([1.0, -1.0])
"""Sign of a joint's coordinate, which is the bar seen from its body, at base and tip: at the tip the body is further
from the base."""


@dataclass(frozen=True)
class Placed:
    """A law at a site (`sites.site_of`): F = force · f(q / length), f the law, in N and mm or N mm and rad.

    Laws at one hinge act side by side; laws of one series site follow one another, so that their coordinates add.
    """

    site: str
    law: Law
    force: float = 1.0
    length: float = 1.0

    def __post_init__(self) -> None:
        site_of(self.site)
        if not (0.0 < self.force < np.inf and 0.0 < self.length < np.inf):
            raise ValueError(
                f"{self.site}: a law is scaled by {self.force:g} and {self.length:g}, allowed are positive numbers"
            )

    def advanced(self, q: Floats, step: Floats) -> Floats:
        """Where Newton's method goes on from q (...), told a step (...) along the tangent."""
        if not isinstance(self.law, Elastic):
            return q + step
        return self.length * self.law.advanced(q / self.length, step / self.length)

    def respond(self, q: Floats, memory: Floats) -> Response:
        """Force, stiffness and new memory at q (...), as of `Law`."""
        force, slope, left = self.law.respond(q / self.length, memory)
        return self.force * force, self.force / self.length * slope, left


@dataclass(frozen=True, eq=False)
class Anchored:
    """A placed law in the arrays of a frame. site: its own. slot: its place among the joint coordinates, or for a base
    site that among the six of the base body. at (B, K, 2): ends where it acts, none for a base site. memory: where its
    numbers start and end."""

    placed: Placed
    site: Site
    slot: int
    at: Bools
    memory: tuple[int, int]

    @property
    def of_base(self) -> bool:
        """Whether it acts on the base body."""
        return self.site.kind in BASE

    @property
    def of_hinge(self) -> bool:
        """Whether it is a torque of hinges."""
        return self.site.kind == HINGE

    def own(self, memory: Floats) -> Floats:
        """(B, ends, AHEAD + width) its part of the memories (B, M)."""
        start, end = self.memory
        return memory[:, start:end].reshape(len(memory), -1, AHEAD + self.placed.law.width)


def memory_size(anchored: Sequence[Anchored]) -> int:
    """Numbers in a row of memories."""
    return max((it.memory[1] for it in anchored), default=0)


def joint_laws(
    anchored: Sequence[Anchored], q: Floats, relaxed: Floats, axial: Floats, memory: Floats
) -> Response:
    """Forces and stiffnesses (B, K, 2, S) of all joint laws, and the memories (B, M) with those that they leave.

    q (B, K, 2, S); relaxed (B, K, 2): turn of the hinges at rest; axial (B, K, 2): load along each bar at its ends, N.
    """
    force, stiffness, left = np.zeros_like(q), np.zeros_like(q), memory.copy()
    for it in anchored:
        if it.of_base:
            continue
        here = q[..., it.slot] - relaxed if it.of_hinge else q[..., it.slot]
        mine, slope = _answer(it, CHAIN_ORDER * here, axial, memory, left)
        force[..., it.slot] += np.where(it.at, CHAIN_ORDER * mine, 0.0)
        stiffness[..., it.slot] += np.where(it.at, slope, 0.0)
    return force, stiffness, left


def base_laws(anchored: Sequence[Anchored], coordinates: Floats, memory: Floats) -> Response:
    """Forces and stiffnesses (B, 6) of the laws on the base body, and the memories (B, M) that they leave."""
    force, stiffness, left = np.zeros_like(coordinates), np.zeros_like(coordinates), memory.copy()
    for it in anchored:
        if it.of_base:
            own = coordinates[:, it.slot, None]
            mine, slope = _answer(it, own, np.zeros_like(own), memory, left)
            force[:, it.slot] += mine[:, 0]
            stiffness[:, it.slot] += slope[:, 0]
    return force, stiffness, left


def advanced_joints(anchored: Sequence[Anchored], q: Floats, step: Floats) -> Floats:
    """Joint coordinates (B, K, 2, S) after a step along the tangent, those of series laws as their laws go on."""
    out = q + step
    for it in anchored:
        if not it.of_base and not it.of_hinge:
            here, way = CHAIN_ORDER * q[..., it.slot], CHAIN_ORDER * step[..., it.slot]
            out[..., it.slot] = np.where(
                it.at, CHAIN_ORDER * it.placed.advanced(here, way), out[..., it.slot]
            )
    return out


def advanced_base(anchored: Sequence[Anchored], before: Floats, after: Floats) -> Floats:
    """Base coordinates (B, 6) after a step along the tangent from `before` to `after`, as their laws go on."""
    out = after.copy()
    for it in anchored:
        if it.of_base:
            here = before[:, it.slot]
            out[:, it.slot] = it.placed.advanced(here, after[:, it.slot] - here)
    return out


def _answer(it: Anchored, q: Floats, axial: Floats, memory: Floats, left: Floats) -> tuple[Floats, Floats]:
    """Force and stiffness of one law at its coordinates q (B, ...); writes what it remembers into `left`."""
    before = it.own(memory).reshape(*q.shape, -1)
    force, slope, own = it.placed.respond(q, before[..., AHEAD:])
    if it.placed.law.loaded:
        own = np.concatenate((np.abs(axial)[..., None], own[..., 1:]), axis=-1)
    start, end = it.memory
    left[:, start:end] = np.concatenate((q[..., None], force[..., None], own), axis=-1).reshape(len(q), -1)
    return force, slope


def held_back(anchored: Sequence[Anchored], now: Floats, begun: Floats) -> Floats:
    """Memories (B, M) within a load step: those that wait for its end as they were when it began."""
    out = now.copy()
    for it in anchored:
        if it.placed.law.by_load_step:
            it.own(out)[..., AHEAD:] = it.own(begun)[..., AHEAD:]
    return out


def anchored(
    placed: Sequence[Placed], slots: tuple[str, ...], hinged: Bools, bars: int
) -> tuple[tuple[Anchored, ...], tuple[str, ...]]:
    """The laws in the arrays of a frame with these joint coordinates, and its joint coordinates with theirs.

    hinged (B, 2): whether the bars have hinges at base and tip. ValueError for a site that a rig does not have.
    """
    sites = [site_of(it.site) for it in placed]
    # Turns first: shifts then follow the axes of the bar.
    order = sorted(range(len(placed)), key=lambda k: SERIES.get(sites[k].kind, ("", 0))[0] != "turn")
    own = tuple(f"{sites[k].kind}{NUMBERED}{k}" for k in order if sites[k].kind in SERIES)
    every = (*slots, *own)
    out, start = [], 0
    for k, (it, site) in enumerate(zip(placed, sites, strict=True)):
        at = _ends(it.site, site, hinged, bars)
        if site.kind in BASE:
            slot, places = BASE.index(site.kind), 1
        else:
            slot = every.index("hinge" if site.kind == HINGE else f"{site.kind}{NUMBERED}{k}")
            places = 2 * bars
        end = start + places * (AHEAD + it.law.width)
        out.append(Anchored(it, site, slot, at, (start, end)))
        start = end
    return tuple(out), every


def _ends(name: str, site: Site, hinged: Bools, bars: int) -> Bools:
    """(B, K, 2) ends where a law acts."""
    if site.bar is not None and site.bar >= bars:
        raise ValueError(f"{name}: the rig has no bar {site.bar + 1}")
    at = np.zeros((len(hinged), bars, 2), bool)
    if site.kind in BASE:
        return at
    for bar in range(bars):
        for end in range(2):
            at[:, bar, end] = site.here(bar, end)
    if site.kind == HINGE:
        at &= hinged[:, None, :]
        if not at.any((1, 2)).all():
            where = "" if site.end is None else f" at its {ENDS[site.end]}"
            raise ValueError(f"{name}: a rig has no hinge{where}")
    return at
