"""Nodes, cells and sets as a text file gives them one by one, put together at the end."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from meshes.brought.raw import Raw
from meshes.solid import Ints

OTHERS = "the rest"


@dataclass
class Collected:
    """By the file's own numbers. cells: kind, number and nodes, with the line."""

    nodes: dict[int, Sequence[float]] = field(default_factory=dict)
    cells: dict[str, list[tuple[int, Sequence[int], int]]] = field(default_factory=dict)
    node_sets: dict[str, list[int]] = field(default_factory=dict)
    cell_sets: dict[str, list[int]] = field(default_factory=dict)

    def node(self, number: int, at: Sequence[float], line: int) -> None:
        """A node; ValueError for a number that is there already at another place."""
        if number in self.nodes and list(self.nodes[number]) != list(at):
            raise ValueError(f"line {line}: node {number} is there twice, at two places")
        self.nodes[number] = at

    def cell(self, kind: str, number: int, nodes: Sequence[int], line: int) -> None:
        """A cell by the numbers of its nodes, meshio's order."""
        self.cells.setdefault(kind, []).append((number, nodes, line))

    def node_set(self, name: str, numbers: Iterable[int]) -> None:
        """Nodes of a named set, beside those it has already."""
        self.node_sets.setdefault(name, []).extend(numbers)

    def cell_set(self, name: str, numbers: Iterable[int]) -> None:
        """Cells of a named set, beside those it has already."""
        self.cell_sets.setdefault(name, []).extend(numbers)

    def raw(self, regions: Mapping[str, Sequence[int]], remarks: Sequence[str]) -> Raw:
        """All of it; ValueError for cells of nodes that are not there, or none. regions: cell numbers by name."""
        if not self.cells:
            raise ValueError("holds no solid elements, allowed are tetrahedra, hexahedra and wedges")
        numbers = np.array(sorted(self.nodes), dtype=np.int64)
        points = np.array([self.nodes[n] for n in numbers.tolist()], dtype=float).reshape(-1, 3)
        blocks, ids = [], []
        for kind, cells in self.cells.items():
            blocks.append((kind, self._places(cells, numbers)))
            ids += [number for number, _, _ in cells]
        region_of = np.full(len(ids), -1, dtype=np.int64)
        place = {number: k for k, number in enumerate(ids)}
        if len(place) < len(ids):
            raise ValueError(f"has {len(ids) - len(place)} element numbers twice")
        for k, members in enumerate(regions.values()):
            region_of[[place[m] for m in members if m in place]] = k
        names = [*regions]
        if (region_of < 0).any():
            region_of[region_of < 0] = len(names)
            names.append(OTHERS)
        sets = {
            name: found
            for name, members in self.node_sets.items()
            if (found := _present(np.array(members, dtype=np.int64), numbers)).size
        }
        return Raw(points, tuple(blocks), region_of, tuple(names), sets, tuple(remarks))

    def _places(self, cells: list[tuple[int, Sequence[int], int]], numbers: Ints) -> Ints:
        wanted = np.array([nodes for _, nodes, _ in cells], dtype=np.int64)
        places = np.searchsorted(numbers, wanted)
        there = places < len(numbers)
        there[there] = numbers[places[there]] == wanted[there]
        if not there.all():
            row, column = np.argwhere(~there)[0]
            raise ValueError(
                f"line {cells[row][2]}: node {wanted[row, column]} of an element is not in the file"
            )
        return np.asarray(places)


def _present(members: Ints, numbers: Ints) -> Ints:
    places = np.searchsorted(numbers, members)
    inside = places < len(numbers)
    inside[inside] = numbers[places[inside]] == members[inside]
    return np.unique(places[inside])
