"""A small made-up result, valid by the schema, with shapes to match: it tests drawing, not physics."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pyvista

LENGTH, WIDTH = 310.0, 80.0
SUPPORTS = ("free", "guided")
PLANES = ("xy", "xz", "torsion")
BAR = {"K11": 2.2e4, "K22": 18.1, "K26": -2840.0, "K33": 78.6, "K35": 1.25e4, "K44": 3.48e4, "K55": 2.66e6}
BAR |= {"K66": 5.85e5}


AXIAL = {"K11": 3.2e-3, "K22": 3.9e-3, "K26": -0.1, "K33": 3.9e-3, "K35": 0.1, "K44": 0.12, "K55": 41.0}
AXIAL |= {"K66": 41.3}


def matrix(entries: dict[str, float], scale: float = 1.0) -> list[list[float]]:
    """A symmetric 6x6 from its named entries."""
    full = np.zeros((6, 6))
    for name, value in entries.items():
        i, j = int(name[1]) - 1, int(name[2]) - 1
        full[i, j] = full[j, i] = scale * value
    return full.tolist()


def entries(scale: float) -> list[dict[str, Any]]:
    return [
        {"entry": name, "value": scale * value, "reference": value, "deviation": scale - 1.0}
        for name, value in BAR.items()
    ]


def bar() -> dict[str, Any]:
    dofs = [2_000, 20_000, 200_000]
    found = {name: [v * (1 + (30 + 9 * k) / n) for n in dofs] for k, (name, v) in enumerate(BAR.items())}
    size = {"flange_width_mm": 12.0, "flange_thickness_mm": 2.2, "height_mm": 15.5, "web_mm": 4.0}
    return {
        "section": {"kind": "i_section", **size},
        "length_mm": LENGTH,
        "lug": {"length_mm": 20.0, "width_mm": 12.0, "height_mm": 16.0},
        "material": {"name": "aluminium", "E_MPa": 70e3, "nu": 0.33, "source": "EN 1999"},
        "constants": {"area": 97.2, "Iy": 2812.1, "Iz": 692.8, "J": 357.4, "Iw": 24105.0},
        "stiffness": matrix(BAR, 1.02),
        "paper": matrix(BAR),
        "worst_entry_error": 0.02,
        "entries": entries(1.02),
        "oracle": matrix(BAR, 1.01),
        "oracle_entries": entries(1.02 / 1.01),
        "second_route": {
            "stiffness": matrix(BAR, 0.99),
            "entries": entries(1.02 / 0.99),
            "leftover": {"Fx": 1e-3, "Mx": 0.2},
            "explanation": "The loads leave the face free to warp.",
        },
        "fit": {"start": size, "found": size, "entries": entries(1.02), "rms": 0.013, "solves": 42},
        "dofs": 20_000,
        "cells": 1_480,
        "cell_kind": "hexahedron20",
        "quality": {"volume": 1e-9, "moment_y": 2e-9, "worst_cell": 0.91},
        "laws": {"asymmetry": 1e-12, "rigid_force": 1e-9},
        "convergence": {
            "dofs": dofs,
            "sizes_mm": [8.0, 4.0, 2.0],
            "entries": found,
            "K22": found["K22"],
            "observed_order": 3.0,
            "orders": dict.fromkeys(BAR, 3.0),
            "extrapolated": matrix(BAR),
            "band": dict.fromkeys(BAR, 0.002),
        },
        "axial": {
            "solid": matrix(AXIAL),
            "formula": matrix(AXIAL, 1.01),
            "vjm": matrix(AXIAL, 0.97),
            "band": dict.fromkeys(BAR, 0.004),
            "explanation": ["The springs know <b>nothing</b> of warping."],
        },
        "solve": {
            "solver": "direct",
            "unknowns": 19_800,
            "nonzeros": 2_400_000,
            "setup_seconds": 0.61,
            "solve_seconds": 0.05,
            "right_hand_sides": 6,
            "iterations": 0,
            "residual": 3e-10,
        },
    }


def buckling() -> list[dict[str, Any]]:
    return [
        {
            "body": "bar",
            "model": "solid",
            "supports": supports,
            "plane": PLANES[k],
            "mode": k + 1,
            "load_N": 1250.0 * (k + 1) ** 2 * (1 + s),
            "formula_N": 1244.0 * (k + 1) ** 2 * (1 + s) if k < 2 else None,
            "formula": "π² EI_z / (4 L²)" if k < 2 else None,
            "deviation": 0.0048 if k < 2 else None,
            "picture": None,
        }
        for s, supports in enumerate(SUPPORTS)
        for k in range(3)
    ]


def parallelogram(q_deg: float) -> dict[str, Any]:
    entries = {
        "K11": 4.4e4,
        "K22": 36.2,
        "K26": -5680.0,
        "K44": 1.13e5,
        "K46": 2.5e4,
        "K55": 5.28e7,
        "K66": 1.18e6,
    }
    return {
        "q_deg": q_deg,
        "closed_form": matrix(entries),
        "vjm": matrix(entries),
        "fea": matrix(entries, 1.003),
        "paper": matrix(entries) if q_deg else None,
        "doubled_bar": matrix(BAR, 2.0),
        "rank": 5,
        "singular_values_fea": [5e7, 1e6, 1e5, 4e4, 4.0, 1e-6],
        "frame": "bar",
        "worst_fea_deviation": 0.003,
    }


HELD = (["y", "z", "rx", "ry", "rz"], ["z", "rx", "ry", "rz"], ["z"])
LOADS = (39_400.0, 9_940.0, 2_490.0)
VJM = {"tip": -12_300.0, "middle": 17_400.0, "base": 5_670.0}


def critical() -> list[dict[str, Any]]:
    rows: list[dict[str, Any]] = []
    for q in (0.0, 30.0):
        for held, load in zip(HELD, LOADS, strict=True):
            common = {"q_deg": q, "held": held, "searched_N": None, "closed_form_N": None}
            rows.append(common | critical_row("solid", None, load, load))
            rows.append(common | critical_row("beam formula", None, 1.01 * load, load))
            rows += [common | critical_row("vjm", spring, value, load) for spring, value in VJM.items()]
    rows[-1] |= {"load_N": None, "searched_N": 50_000.0, "ratio_to_solid": None}
    rows[2] |= {"closed_form_N": -12_300.1}
    return rows


def critical_row(model: str, spring: str | None, load: float, solid: float) -> dict[str, Any]:
    why = {"solid": "The bars bend.", "beam formula": "Euler.", "vjm": f"The spring sits at the {spring}."}
    return {
        "model": model,
        "spring_at": spring,
        "what": "out of plane" if model != "vjm" else "in plane",
        "load_N": load,
        "ratio_to_solid": load / solid,
        "why": why[model],
        "band": 0.007 if model == "solid" else None,
    }


def curves() -> list[dict[str, Any]]:
    rows: list[dict[str, Any]] = []
    for q, slope in ((0.0, 43_900.0), (30.0, 32_900.0)):
        for held, load in zip(HELD, LOADS, strict=True):
            turn = load / slope
            straight, after = np.linspace(0.0, turn, 9), np.linspace(turn, 2 * turn + 0.3, 9)
            common = {"q_deg": q, "held": held, "note": ""}
            shapes = [
                ("lin", "tip", "straight", np.linspace(-turn, 2 * turn, 5), slope, []),
                ("fea", "distributed", "straight", straight, slope, [-load]),
                ("frame", "distributed", "straight", straight, 1.001 * slope, []),
                ("vjm", "distributed", "straight", straight, 0.999 * slope, []),
                ("vjm", "tip", "straight", np.linspace(-turn, 2 * turn, 9), 0.999 * slope, [12_300.0]),
                ("vjm", "base", "straight", straight, 0.998 * slope, [-5_670.0]),
            ]
            for model, spring, branch, x, k, loads in shapes:
                row = {"model": model, "spring_at": spring, "branch": branch, "critical_N": loads}
                rows.append(common | row | {"x_mm": (-x).tolist(), "fx_N": (-k * x).tolist()})
            bent = {"model": "fea", "spring_at": "distributed", "branch": "buckled", "critical_N": [-load]}
            forces = -(load + 16.0 * (after - turn))
            bent["band"] = 0.012
            rows.append(common | bent | {"x_mm": (-after).tolist(), "fx_N": forces.tolist()})
    return rows


def result() -> dict[str, Any]:
    """The whole result as plain data."""
    return {
        "schema_version": 1,
        "case": "example",
        "title": "Example of a report <b>not bold</b> & co.",
        "detail": "coarse",
        "length_mm": LENGTH,
        "width_mm": WIDTH,
        "bar": bar(),
        "buckling": buckling(),
        "parallelogram": [parallelogram(0.0), parallelogram(30.0)],
        "critical": critical(),
        "curves": curves(),
        "validity": [
            {"model": m, "q_deg": 0.0, "held": h, "deviation": d, "load_N": 9_800.0 if m == "fea" else None}
            for m in ("fea", "vjm")
            for h in HELD
            for d in (0.01, 0.05)
        ],
        "refinement": [
            {
                "model": "frame",
                "quantity": "Fx at the end",
                "q_deg": 0.0,
                "held": HELD[0],
                "refined": "elements a bar",
                "sizes": [8, 16, 32],
                "values": [-39_500.0, -39_400.0, -39_375.0],
                "limit": -39_366.7,
                "band": 1.06e-3,
                "used": 16,
            }
        ],
        "agreement": ["z held: LIN & co. leave the solid."],
        "orthoglide": [],
        "errata": [
            {
                "number": 1,
                "place": "Eq. 1",
                "printed": "R_y(-q_i2) | moving",
                "correct": "constant",
                "evidence": "rank 5",
                "numbers": {"rank": 5.0},
            }
        ],
        "story": [
            "The lumped spring has no geometric stiffness.",
            "<script>alert('story')</script> is only text.",
        ],
        "seconds": {"mesh": 0.4, "stiffness": 1.3, "curves": 12.0},
        "versions": {"numpy": "2.0"},
        "commit": "0" * 40,
        "command": "python -m pipeline run",
        "seed": 7,
        "solver": "direct",
        "sources": ["Pashkevich et al., 2010"],
    }


def write_shapes(folder: Path) -> None:
    """A rectangular bar of quadratic hexahedra with half-sine modes, in modes/<supports>.vtu."""
    grid = pyvista.ImageData(dimensions=(32, 3, 3), spacing=(10.0, 6.0, 8.0), origin=(0.0, -6.0, -8.0))
    solid = quadratic(grid.cast_to_unstructured_grid())
    x, y, z = np.asarray(solid.points).T
    for k, plane in enumerate(PLANES, start=1):
        size = np.sin(np.pi * k * x / LENGTH)
        parts = {"xy": (0, size, 0), "xz": (0, 0, size), "torsion": (0, -size * z / 8.0, size * y / 8.0)}[
            plane
        ]
        shape = np.stack(np.broadcast_arrays(*parts, 0 * x)[:3], axis=1)
        solid.point_data[f"mode_{k}"] = shape / np.linalg.norm(shape, axis=1).max()
    (folder / "modes").mkdir(parents=True, exist_ok=True)
    for supports in SUPPORTS:
        solid.save(folder / "modes" / f"{supports}.vtu")


def quadratic(linear: Any) -> Any:
    """The 8-node cells as 20-node cells, nodes shared."""
    # A voxel numbers its corners row by row, a hexahedron around its faces.
    around = [0, 1, 3, 2, 4, 5, 7, 6]
    edges = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))
    corners = np.asarray(linear.points)[linear.cells_dict[pyvista.CellType.VOXEL][:, around]]
    middles = np.stack([(corners[:, a] + corners[:, b]) / 2 for a, b in edges], axis=1)
    points = np.concatenate([corners, middles], axis=1).reshape(-1, 3)
    unique, inverse = np.unique(points, axis=0, return_inverse=True)
    cells = inverse.reshape(len(corners), 20)
    return pyvista.UnstructuredGrid({pyvista.CellType.QUADRATIC_HEXAHEDRON: cells}, unique)


def write(folder: Path, data: dict[str, Any] | None = None, shapes: bool = False) -> Path:
    """The result, and on request its shapes, in `folder`; returns the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "result.json").write_text(json.dumps(data or result()), encoding="utf-8")
    if shapes:
        write_shapes(folder)
    return folder
