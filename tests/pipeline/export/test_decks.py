"""Nastran and Abaqus decks read back by readers of their own, written from the manuals and not from the writer."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from pipeline.export.content import Export
from pipeline.export.formats.dmig import field
from tests.pipeline.export.sources import KEPT, UNEQUAL, brought, campaign, coupled, written


def cards(text: str) -> list[list[str]]:
    """Fields of every entry of a bulk data file, eight or (with a star) sixteen columns wide, continued or not."""
    found: list[list[str]] = []
    for line in text.splitlines():
        if line.startswith("$") or not line.strip():
            continue
        assert len(line) <= 72
        name, wide = line[:8].strip(), "*" in line[:8]
        width = 16 if wide else 8
        fields = [line[k : k + width].strip() for k in range(8, 72, width) if line[k : k + width].strip()]
        if name == "*":
            found[-1] += fields
        else:
            found.append([name.rstrip("*"), *fields])
    return found


def by_dmig(text: str) -> dict[str, np.ndarray]:
    """Each matrix (12, 12): rows and columns by grid point, then direction."""
    every = cards(text)
    # A header has the grid point 0 in its second field.
    headers = {card[1]: card[2:] for card in every if card[0] == "DMIG" and card[2] == "0"}
    points = sorted({int(card[1]) for card in every if card[0] == "GRID"})
    out = {}
    for k, name in enumerate(headers):
        _, form, kind, _ = headers[name][:4]
        assert (form, kind) == ("6", "2"), "symmetric, of real double precision"
        own = points[2 * k : 2 * k + 2]
        place = {(point, axis): 6 * n + axis - 1 for n, point in enumerate(own) for axis in range(1, 7)}
        matrix = np.zeros((12, 12))
        for card in every:
            if card[0] != "DMIG" or card[1] != name or card[2] == "0":
                continue
            column = place[int(card[2]), int(card[3])]
            for point, axis, value in zip(card[4::3], card[5::3], card[6::3], strict=True):
                row = place[int(point), int(axis)]
                assert "D" in value and matrix[row, column] == 0.0
                matrix[row, column] = matrix[column, row] = float(value.replace("D", "e"))
        out[name] = matrix
    return out


def by_abaqus(text: str) -> list[np.ndarray]:
    """Each matrix (12, 12) of a linear user element: columns of the upper triangle, four numbers a line."""
    out: list[np.ndarray] = []
    lines = [line for line in text.splitlines() if not line.startswith("**")]
    for k, line in enumerate(lines):
        if not line.startswith("*MATRIX, TYPE=STIFFNESS"):
            continue
        assert (
            lines[k - 2].startswith("*USER ELEMENT")
            and "LINEAR" in lines[k - 2]
            and "NODES=2" in lines[k - 2]
        )
        assert lines[k - 1].split(",") == ["1", " 2", " 3", " 4", " 5", " 6"]
        matrix, at = np.zeros((12, 12)), k + 1
        for column in range(12):
            values: list[float] = []
            while len(values) < column + 1:
                own = [float(value) for value in lines[at].split(",")]
                assert len(own) <= 4
                values, at = values + own, at + 1
            matrix[: column + 1, column] = values
        assert lines[at].startswith("*ELEMENT, TYPE=U")
        out.append(matrix + np.triu(matrix, 1).T)
    return out


def carried(arm: np.ndarray) -> np.ndarray:
    """(12, 6) motions of base and point, `arm` from it, when both are one rigid body: u = u0 + phi x arm."""
    x, y, z = arm
    cross = np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])
    point = np.block([[np.eye(3), cross], [np.zeros((3, 3)), np.eye(3)]])
    return np.vstack([np.eye(6), point])


CASES = [(effects, q) for effects in ({}, UNEQUAL) for q in (None, 0.0, 30.0)]


@pytest.mark.parametrize(("effects", "q"), CASES, ids=str)
@pytest.mark.parametrize("to", ["dmig", "inp"])
def test_read_back(to: str, effects: dict[str, dict[str, float]], q: float | None, tmp_path: Path) -> None:
    """With the base clamped it is the 6x6; a rigid motion of both ends costs nothing; equilibrium follows."""
    read_back(*written(campaign(tmp_path / "bench", effects=effects), to, tmp_path / "out", q), to)


@pytest.mark.parametrize("q", [None, 30.0])
@pytest.mark.parametrize("to", ["dmig", "inp"])
def test_a_brought_bar_is_read_back(to: str, q: float | None, tmp_path: Path) -> None:
    it, files = written(brought(tmp_path / "bar"), to, tmp_path / "out", q)
    if q is None:
        np.testing.assert_array_equal(it.springs[0].matrix, coupled())
    read_back(it, files, to)


def read_back(it: Export, files: list[Path], to: str) -> None:
    """Every matrix of a deck against that of its spring."""
    text = files[-1].read_text()
    found = list(by_dmig(text).values()) if to == "dmig" else by_abaqus(text)
    assert len(found) == len(it.springs) > 0
    for matrix, spring in zip(found, it.springs, strict=True):
        np.testing.assert_allclose(matrix[6:, 6:], spring.matrix, rtol=1e-9, atol=0.0)
        # What remains of a rigid motion is rounding: its forces against those of the same motion of the point alone.
        motion = carried(spring.point)
        forces = np.abs(matrix @ motion)
        assert (forces < 1e-9 * (np.abs(matrix) @ np.abs(motion)).max(axis=0)).all()


def test_fields_hold_what_is_said() -> None:
    """Sixteen columns, an error below 5e-10 at every size and sign; a D, and a digit before it."""
    sizes = np.random.default_rng(7).uniform(1.0, 10.0, 400) * 10.0 ** np.arange(-20.0, 20.0).repeat(10)
    for value in (*sizes, *-sizes, 0.0, 1.0, -9.9999999999999):
        text = field(value)
        assert len(text) == 16 and "D" in text
        assert float(text.replace("D", "e")) == pytest.approx(value, rel=5e-10, abs=0.0)


def test_heads_say_where_from_and_what_not(tmp_path: Path) -> None:
    for to in ("dmig", "inp"):
        _, files = written(KEPT, to, tmp_path / f"out_{to}", q=30.0)
        for path in files:
            head = " ".join(line.lstrip("*$ ") for line in path.read_text().splitlines() if line[:1] in "*$")
            for said in (
                "N, mm, rad",
                "geometric stiffness",
                "rank 5",
                "result.json sha256",
                "q = 30 degrees",
            ):
                assert said in head, (path, said)
