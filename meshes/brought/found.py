"""A brought part on one or several meshes, its ends resolved: packed in the child, unpacked where it was asked for."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from meshes.brought.child import Arrays
from meshes.brought.drawn import Drawn
from meshes.brought.ends import End, Outside, end_of, listing
from meshes.brought.raised import raised
from meshes.brought.raw import Raw
from meshes.part import PartMesh, bodies, boundary
from meshes.solid import Floats, Ints


@dataclass(frozen=True, eq=False)
class EndPoint:
    """Where an end is: `at` (3,) mm, `axis` (3,) of its bore or None, in words."""

    at: Floats
    axis: Floats | None
    said: str


@dataclass(frozen=True, eq=False)
class Brought:
    """A part in the file's frame, mm, from the `told` and `arrays` of the child."""

    told: Mapping[str, Any]
    arrays: Arrays

    @cached_property
    def meshes(self) -> tuple[PartMesh, ...]:
        """Nested, coarse to fine, with the facets "base" and "tip"."""
        return _meshes(self.told, self.arrays) if self.drawn is None else self.drawn.meshes

    @cached_property
    def drawn(self) -> Drawn | None:
        """The prism that the part is; None where it is none, or came as a mesh."""
        return Drawn.unpacked(self.told, self.arrays) if self.told["kinds"] == [] else None

    @property
    def base(self) -> EndPoint:
        return self._end("base")

    @property
    def tip(self) -> EndPoint:
        return self._end("tip")

    def _end(self, which: str) -> EndPoint:
        return EndPoint(self.arrays[f"at {which}"], self.arrays.get(f"axis {which}"), self.told[which])


def packed(raws: Sequence[Raw], asked: Mapping[str, Any]) -> tuple[dict[str, Any], Arrays]:
    """Ends of every mesh, and all of it as plain arrays; ValueError with the list of faces where an end is not said."""
    arrays: Arrays = {}
    ends: dict[str, End] = {}
    kinds: list[list[str]] = []
    whole = [raised(raw) for raw in raws]
    for level, raw in enumerate(whole):
        outside = outside_of(raw)
        missing = [which for which in ("base", "tip") if asked[which] is None]
        if missing:
            raise ValueError(f"{' and '.join(missing)} not said; {listing(outside)}")
        arrays |= {f"{level} points": raw.points, f"{level} region_of": raw.region_of}
        arrays |= {f"{level} cells {kind}": cells for kind, cells in raw.blocks}
        kinds.append([kind for kind, _ in raw.blocks])
        for which in ("base", "tip"):
            ends[which] = end_of(outside, asked[which], which)
            arrays |= {f"{level} {which} {kind}": own for kind, own in ends[which].facets.items()}
        if shared := np.intersect1d(_nodes(ends["base"].facets), _nodes(ends["tip"].facets)).size:
            raise ValueError(f"base and tip have {shared} nodes in common, allowed are two separate ends")
    told, of_ends = _packed_ends(ends)
    told |= {"regions": list(raws[-1].regions), "kinds": kinds, "remarks": list(whole[-1].remarks)}
    return told, arrays | of_ends


def packed_prism(drawn: Drawn, base: End, tip: End) -> tuple[dict[str, Any], Arrays]:
    """A prism by its section, so that a mesh of the whole is made where it is needed, and only there."""
    told, arrays = _packed_ends({"base": base, "tip": tip})
    return told | {"regions": [drawn.region], "kinds": [], "remarks": []}, arrays | drawn.packed()


def _packed_ends(ends: Mapping[str, End]) -> tuple[dict[str, Any], Arrays]:
    arrays: Arrays = {}
    for which, end in ends.items():
        arrays[f"at {which}"] = end.at
        if end.axis is not None:
            arrays[f"axis {which}"] = end.axis
    return {which: end.said for which, end in ends.items()}, arrays


def outside_of(raw: Raw) -> Outside:
    """The boundary with its named sets; ValueError for a part in several pieces."""
    of_body = bodies(raw.blocks, len(raw.points))
    if (count := int(of_body.max()) + 1) > 1:
        first = np.concatenate([cells[:, 0] for _, cells in raw.blocks])
        parts = [
            sorted({raw.regions[r] for r in raw.region_of[of_body[first] == b]}) for b in range(min(count, 4))
        ]
        said = "; ".join(", ".join(names) for names in parts)
        raise ValueError(
            f"is in {count} pieces that share no node ({said}), allowed is one body: join or merge them"
        )
    facets = boundary(raw.blocks)
    named = {}
    for name, nodes in raw.node_sets.items():
        mark = np.zeros(len(raw.points), dtype=bool)
        mark[nodes] = True
        corners = {"triangle6": 3, "quad8": 4, "quad9": 4}
        own = {k: f[mark[f[:, : corners[k]]].all(axis=1)] for k, f in facets.items()}
        if own := {k: f for k, f in own.items() if len(f)}:
            named[name] = own
    return Outside(raw.points, facets, named, tuple(_of_faces(raw.faces, facets)))


def _of_faces(faces: Sequence[Ints], facets: Mapping[str, Ints]) -> Iterator[dict[str, Ints]]:
    """The boundary facets of each face of a CAD file."""
    own = facets.get("triangle6")
    if own is None:
        return
    place = {tuple(key): k for k, key in enumerate(np.sort(own[:, :3], axis=1).tolist())}
    for face in faces:
        there = [place[key] for key in map(tuple, np.sort(face, axis=1).tolist()) if key in place]
        if there:
            yield {"triangle6": own[there]}


def _meshes(told: Mapping[str, Any], arrays: Arrays) -> tuple[PartMesh, ...]:
    meshes = []
    for level, kinds in enumerate(told["kinds"]):
        facets = {
            which: {
                key.split()[2]: value for key, value in arrays.items() if key.startswith(f"{level} {which} ")
            }
            for which in ("base", "tip")
        }
        blocks = tuple((kind, arrays[f"{level} cells {kind}"]) for kind in kinds)
        regions = tuple(told["regions"])
        meshes.append(
            PartMesh.of(arrays[f"{level} points"], blocks, arrays[f"{level} region_of"], regions, facets)
        )
    return tuple(meshes)


def _nodes(facets: Mapping[str, Ints]) -> Ints:
    return np.unique(np.concatenate([own.ravel() for own in facets.values()]))
