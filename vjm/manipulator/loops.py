"""A leg with every bar as a chain of its own: coordinates, springs, the path to the platform, and its closed loops.

The second bar of a parallelogram starts and ends on the same two bodies as the first one, so a loop closes by the
paper's T_1 = T_2, written between these bodies: both sides are short chains of the leg's own coordinates.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import lru_cache, partial

import numpy as np

from vjm.bars import BarModel
from vjm.chain import Chain, Element, Fixed, Role, tied_apart
from vjm.frames import Array
from vjm.laws import Spring
from vjm.link import Link
from vjm.loads import DeadLoads
from vjm.manipulator.parts import MOVING, ElasticLink, Leg, Parallelogram, Part
from vjm.manipulator.rest import elastic_elements, pseudo_rigid_springs
from vjm.mechanism import Drive, ElasticChain, Loop, Path, Varying, joints_of
from vjm.mechanisms.assembly import Assembly
from vjm.refined import Refined


@dataclass(frozen=True, eq=False)
class _Place:
    """A parallelogram, its number in the posture, its first coordinate, and the elements before it."""

    part: Parallelogram
    number: int
    first: int
    before: tuple[Element, ...]


@dataclass
class _Builder:
    """Collects a leg part by part."""

    elements: list[Element] = field(default_factory=list)
    size: int = 0
    springs: list[Spring] = field(default_factory=list)
    blocks: list[tuple[np.ndarray, Array]] = field(default_factory=list)
    rest: dict[int, float] = field(default_factory=dict)
    posture: list[dict[int, float]] = field(default_factory=list)
    pending: list[_Place] = field(default_factory=list)
    loads: list[DeadLoads] = field(default_factory=list)
    inputs: list[tuple[str, int, Array]] = field(default_factory=list)
    equivalents: list[tuple[Parallelogram, int, np.ndarray]] = field(default_factory=list)

    def add(self, part: Part, tie: str) -> None:
        first = self.size
        if isinstance(part, MOVING):
            self.posture.append({first: 1.0})
        if isinstance(part, Parallelogram) and part.bars == "pair":
            place = _Place(part, len(self.posture) - 1, first, tuple(self.elements))
            self.pending.append(place)
            last = self._bar(place, 0, self.elements, first)
            self.posture[-1][last] = -1.0
        elif isinstance(part, ElasticLink) and part.segments:
            self._limb(Refined(part.segments), Link(part.length, part.stiffness), self.elements, first)
        else:
            added, block = elastic_elements(part, tie)
            self.elements += added
            roles = Chain(added)
            virtual = first + roles.indices(Role.VIRTUAL)
            self.size = first + roles.size
            if isinstance(part, Parallelogram):
                self.equivalents.append((part, len(self.posture) - 1, virtual))
            elif virtual.size:
                self.blocks.append((virtual, block))

    def _limb(self, model: BarModel, link: Link, elements: list[Element], first: int) -> None:
        limb = model.limb(link)
        # Two bars of a leg name their ties alike.
        elements += tied_apart(limb.elements, str(first))
        self.blocks.append((first + np.arange(limb.rest.size), limb.stiffness))
        self.springs += limb.numbered_from(first)
        self.rest |= {first + k: float(v) for k, v in enumerate(limb.rest) if v}
        self.size = first + limb.rest.size

    def _bar(self, place: _Place, number: int, elements: list[Element], first: int) -> int:
        """Bar 1 or 2 (number 0, 1) between its hinges, coordinates numbered from `first`; number of the tip hinge."""
        built = place.part.as_built
        offset = np.array([0.0, 0.0, (number - 0.5) * (place.part.width + built.wider)])
        bar = Assembly(
            built.links[number],
            built.model,
            start=(Fixed(offset),),
            end=(Fixed(-offset),),
            hinges=built.hinges,
            line_load=built.line_load,
        ).chain()
        elements += tied_apart(bar.chain.elements, str(first))
        self.blocks.append((first + bar.virtual, bar.stiffness))
        self.springs += [replace(s, coordinates=tuple(first + c for c in s.coordinates)) for s in bar.springs]
        self.rest |= {first + k: float(v) for k, v in enumerate(bar.rest) if v}
        self.inputs += [(d.name, first, d.slope) for d in bar.drives if not d.posture]
        for load in bar.loads:
            path = Chain((*place.before, *tied_apart(load.path.elements, str(first))))
            numbers = np.concatenate([np.arange(place.first), first + load.coordinates])
            marks = tuple(replace(m, elements=len(place.before) + m.elements) for m in load.marks)
            self.loads.append(DeadLoads(path, numbers, marks, load.forces))
        self.size = first + bar.chain.size
        return self.size - 1

    def close(self) -> tuple[Loop, ...]:
        """Second bars, numbered after all else, and the loops that they close."""
        loops = []
        for place in self.pending:
            own = self.size
            first: list[Element] = []
            scratch = _Builder()
            scratch._bar(place, 0, first, 0)
            second: list[Element] = []
            last = self._bar(place, 1, second, own)
            self.posture[place.number] |= {own: 1.0, last: -1.0}
            chains = (Chain(tuple(first)), Chain(tuple(second)))
            starts = (place.first, own)
            paths = [Path(c, start + np.arange(c.size)) for c, start in zip(chains, starts, strict=True)]
            loops.append(Loop(paths[0], paths[1]))
        return tuple(loops)

    def hinges(self) -> tuple[int, ...]:
        """Numbers of the hinges of all pairs of bars."""
        return tuple(k for place in self.pending for k in self.posture[place.number])


@lru_cache(maxsize=256)
def leg_chain(leg: Leg, name: str, turning: bool = False) -> ElasticChain:
    """A leg with its bars one by one. Its posture are inputs, see `posture_inputs`.

    name: of the leg, before those of its inputs. turning: whether where its hinges are relaxed is an input too.
    """
    build = _Builder()
    for number, part in enumerate(leg.parts):
        build.add(part, f"q{number}")
    main = Chain(tuple(build.elements))
    loops = build.close()
    size, home = build.size, leg.home
    rest, linear = np.zeros(size), np.zeros((size, size))
    for k, value in build.rest.items():
        rest[k] = value
    drives = []
    for number, shares in enumerate(build.posture):
        slope = np.zeros(size)
        slope[list(shares)] = list(shares.values())
        drives.append(Drive(posture_input(name, number), float(home[number]), slope, posture=True))
        rest += home[number] * slope
    if turning:
        drives += [Drive(turn_input(name, k), 0.0, np.eye(size)[k], posture=True) for k in build.hinges()]
    drives += [Drive(of, 0.0, slope) for of, slope in _slopes(build.inputs, size)]
    for numbers, block in build.blocks:
        linear[numbers[:, None], numbers] = block
    joints = enumerate(joints_of(main, loops))
    virtual = np.array([k for k, joint in joints if joint.role is Role.VIRTUAL], dtype=int)
    varying = tuple(
        Varying(numbers, posture_input(name, number), partial(pseudo_rigid_springs, part))
        for part, number, numbers in build.equivalents
    )
    return ElasticChain(
        main,
        linear[np.ix_(virtual, virtual)],
        rest,
        tuple(build.springs),
        tuple(build.loads),
        tuple(drives),
        loops,
        varying,
        leg.name,
    )


def posture_input(leg: str, number: int) -> str:
    """Name of the input that is the coordinate `number` of the posture of a leg."""
    return f"{leg}.q{number}"


def turn_input(leg: str, coordinate: int) -> str:
    """Name of the input that is the turn of a hinge from where it is drawn to where it stands unloaded."""
    return f"{leg}.turn{coordinate}"


def _slopes(inputs: list[tuple[str, int, Array]], size: int) -> tuple[tuple[str, Array], ...]:
    """Change (size,) of the coordinates by each input, all bars together."""
    out: dict[str, Array] = {}
    for name, first, slope in inputs:
        whole = out.setdefault(name, np.zeros(size))
        whole[first : first + slope.size] += slope
    return tuple(out.items())
