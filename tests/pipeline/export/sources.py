"""Campaigns and results to export: a bar whose 6x6 couples all directions, a linkage of such bars that differ."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from pipeline.bar.record import BarRecord, MeshRecord
from pipeline.export.content import Export
from pipeline.export.formats import module_of
from pipeline.export.source import Sources, exported
from tests.conftest import ROOT
from vjm import paper

KEPT = ROOT / "reports" / "validation" / "result.json"
LENGTH, WIDTH = 310.0, 80.0
ANGLES = (0.0, 30.0)
# A linkage of bars of different lengths and stiffnesses, with two effects that no stiffness at no load has.
UNEQUAL = {
    "bar_length_mismatch": {"mismatch_mm": 3.0},
    "bar_stiffness_asymmetry": {"ratio": 1.2},
    "load_offset": {"x_mm": 1.0, "y_mm": 0.0, "z_mm": 0.0},
}
# What gives between bar and hinges, a bow, a linkage that is longer and wider than the drawing.
SOFT = {
    "axis_flexibility": {"radial_mm_per_N": 2e-5, "tilt_rad_per_Nmm": 2e-7},
    "bar_initial_bow": {"bow_y_mm": 2.0, "bow_z_mm": -1.0},
    "dimension_error": {"length_mm": 1.0, "width_mm": 2.0},
}


def coupled() -> np.ndarray:
    """(6, 6) about the paper's K_b, symmetric positive definite, no entry zero."""
    random = np.random.default_rng(40)
    noise = random.uniform(0.003, 0.01, (6, 6)) * random.choice([-1.0, 1.0], (6, 6))
    root = np.sqrt(np.diag(paper.BAR_STIFFNESS))
    return np.asarray(paper.BAR_STIFFNESS + np.outer(root, root) * (noise + noise.T))


def campaign(
    folder: Path, kind: str = "parallelogram", effects: dict[str, dict[str, float]] | None = None
) -> Path:
    """A folder with a campaign of one row a test, and a model with these effects where there are any."""
    folder.mkdir(parents=True)
    wide = f"width_mm = {WIDTH}" if kind == "parallelogram" else ""
    angles = ANGLES if kind == "parallelogram" else (0.0,)
    lines = [
        'schema = 1\nname = "exported"',
        f'[rig]\nkind = "{kind}"\nlength_mm = {LENGTH}\n{wide}\nbar_stiffness = {coupled().tolist()}',
        "[noise]\nx_mm = 0.001\nfx_N = 1.0",
    ]
    control = ", ".join(f'{name} = "displacement"' for name in ("x", "y", "z", "rx", "ry", "rz"))
    lines += [
        f'[[tests]]\nid = "at{q:.0f}"\nq_deg = {q}\nrole = "fit"\ncontrol = {{ {control} }}' for q in angles
    ]
    (folder / "campaign.toml").write_text("\n\n".join(lines) + "\n")
    head = "test,step,x_mm,y_mm,z_mm,rx_rad,ry_rad,rz_rad,fx_N"
    rows = [f"at{q:.0f},0,0.01,0,0,0,0,0,440.0" for q in angles]
    (folder / "measurements.csv").write_text("\n".join([head, *rows]) + "\n")
    if effects:
        (folder / "model.toml").write_text(model_text(effects))
    return folder


def brought(folder: Path, wide: bool = True) -> Path:
    """The record of a bar that came as a file, with a 6x6 that couples all directions; wide: of a linkage."""
    folder.mkdir(parents=True)
    k_b = coupled()
    record = BarRecord(
        name="brought",
        title="Brought",
        length_mm=LENGTH,
        width_mm=WIDTH if wide else None,
        ends={"base": "a bore", "tip": "a bore"},
        tie="rigid",
        material={"E_MPa": 7e4, "nu": 0.33},
        stiffness=k_b.tolist(),
        extrapolated=k_b.tolist(),
        numerical_band={"K11": 0.001},
        modelling_band={"K11": 0.01},
        modelling={},
        geometric=np.zeros((6, 6)).tolist(),
        geometric_numerical_band={},
        buckling=[],
        mesh=MeshRecord(kind="tetra10", cells=1, dofs=30, study_dofs=[30], quality={}),
        said=[],
        seconds={},
        versions={},
        commit="",
        command="",
    )
    record.write(folder / "bar.json")
    return folder / "bar.json"


def model_text(effects: dict[str, dict[str, float]]) -> str:
    """model.toml with these effects."""
    tables = []
    for name, values in effects.items():
        own = "\n".join(f"{key} = {value}" for key, value in values.items())
        tables.append(f'[[effects]]\nname = "{name}"\n[effects.values]\n{own}')
    return "\n\n".join(['schema = 1\nbase = "vjm"', *tables]) + "\n"


def written(source: Path, to: str, out: Path, q: float | None = None) -> tuple[Export, list[Path]]:
    """What is exported, and the files of a format with it in them."""
    it = exported(Sources(source, q))
    files = module_of(to).files(it, out)
    for path, content in files.items():
        path.write_bytes(content)
    return it, list(files)


def relative_error(found: np.ndarray, wanted: np.ndarray) -> float:
    """Largest difference of two compliances (n, n), each entry against the diagonal ones of its row and column."""
    root = np.sqrt(np.diag(wanted))
    return float(np.abs((found - wanted) / np.outer(root, root)).max())
