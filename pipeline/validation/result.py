"""The result of a validation run: one JSON file, written whole or not at all.

Units N, mm, rad, MPa. 6x6 matrices map x y z rx ry rz to Fx Fy Fz Mx My Mz. In `curves` and `critical_N`
compression is negative; in `buckling` and `critical` a compression load is positive and a tension load negative.
"""

import json
from pathlib import Path

from pydantic import Field

from meshes.files import replacing
from pipeline.manipulator.table_record import Table1
from pipeline.record import Record

Matrix = list[list[float]]


class Entry(Record):
    """One entry of a 6x6 (K11 .. K66): solid FE, its reference and the deviation (value / reference - 1)."""

    entry: str
    value: float
    reference: float
    deviation: float


class Convergence(Record):
    """K_b over nested meshes. `K22` and `observed_order` are those of `entries["K22"]`."""

    dofs: list[int]
    sizes_mm: list[float]
    entries: dict[str, list[float]]
    K22: list[float]
    observed_order: float
    orders: dict[str, float]
    """0 where the values do not approach a limit from one side."""
    extrapolated: Matrix
    band: dict[str, float]
    """Relative discretisation error of the working mesh, entry by entry."""


class Axial(Record):
    """Derivative of the bar's 6x6 by its axial force at no load, tension positive: entries per N of those of K_b."""

    solid: Matrix
    """Identified: K_g of the prestressed solid, condensed to the tip."""
    formula: Matrix
    """Of a uniform beam with the section between the lugs and both ends plane."""
    vjm: Matrix
    """Of the virtual-joint model's refined bar with the same K_b, by central differences of its loaded stiffness."""
    band: dict[str, float]
    """Relative discretisation error of the solid, entry by entry."""
    explanation: list[str]


class Solve(Record):
    """How K_b's six right-hand sides were solved on the working mesh; `residual` is relative to the largest load."""

    solver: str
    unknowns: int
    nonzeros: int
    setup_seconds: float
    solve_seconds: float
    right_hand_sides: int
    iterations: int
    residual: float


class SecondRoute(Record):
    """K_b by virtual experiments: loads on the tip, displacement field fitted to a rigid motion."""

    stiffness: Matrix
    entries: list[Entry]
    leftover: dict[str, float]
    """Under each unit wrench (Fx .. Mz), the part of the tip face's displacement that is no rigid motion (RMS)."""
    explanation: str


class Fit(Record):
    """How the reference bar was found."""

    start: dict[str, float]
    found: dict[str, float]
    entries: list[Entry]
    rms: float
    solves: int


class Bar(Record):
    """The bar: geometry, material, identified K_b and every check of it."""

    section: dict[str, float | str]
    length_mm: float
    lug: dict[str, float] | None
    material: dict[str, float | str]
    constants: dict[str, float]
    """area, Iy, Iz, J, Iw, shear areas of the section between the lugs; mm to the due power."""
    stiffness: Matrix
    paper: Matrix | None
    worst_entry_error: float | None
    entries: list[Entry]
    oracle: Matrix
    """Closed form: stepped Timoshenko beam with restrained warping."""
    oracle_entries: list[Entry]
    second_route: SecondRoute
    fit: Fit | None
    dofs: int
    cells: int
    cell_kind: str
    quality: dict[str, float]
    laws: dict[str, float]
    """Relative asymmetry of K_b, largest force under a rigid motion, smallest eigenvalue ratio."""
    convergence: Convergence
    axial: Axial | None = None
    solve: Solve | None = None


class Buckling(Record):
    """One critical load of a body. `load_N` is a compression load, positive."""

    body: str
    model: str
    supports: str
    plane: str
    mode: int
    load_N: float
    formula_N: float | None = None
    formula: str | None = None
    deviation: float | None = None
    picture: str | None = None
    limit_N: float | None = None
    """Extrapolated to a mesh without error."""
    band: float | None = None
    """Relative discretisation error of `load_N`."""
    mac: float | None = None
    """How alike the shapes of the solid and of its formula are, 0 to 1; of a mode that has no formula, of `nearest`."""
    nearest: str | None = None
    """The formula whose shape is nearest, where none is near enough to be that of the mode."""
    nearest_N: float | None = None
    mesh_mac: float | None = None
    """How alike the shapes on two meshes are, 0 to 1; where they are not, there is no `band`."""
    missing: bool = False
    """Of a formula: the solid has no mode of its shape, though it has higher ones."""
    stress_MPa: float | None = None
    """Of the straight bar under this load, where the material has a yield stress."""
    beyond_yield: bool = False


class Parallelogram(Record):
    """K_p at one angle by every model, in `frame`."""

    q_deg: float
    closed_form: Matrix
    vjm: Matrix
    fea: Matrix
    paper: Matrix | None
    doubled_bar: Matrix
    rank: int
    singular_values_fea: list[float]
    frame: str
    worst_fea_deviation: float
    band: Matrix | None = None
    """Relative discretisation error of `fea`, entry by entry, 0 where the entry is."""


class Critical(Record):
    """One critical load of the parallelogram. `load_N` is positive in compression, negative in tension.

    `load_N` None: none was found up to `searched_N`.
    """

    q_deg: float
    held: list[str]
    model: str
    """solid | beam formula | vjm"""
    spring_at: str | None
    what: str
    load_N: float | None
    searched_N: float | None = None
    closed_form_N: float | None = None
    ratio_to_solid: float | None = None
    why: str
    band: float | None = None
    """Relative discretisation error of a solid's `load_N`."""
    stress_MPa: float | None = None
    """Of the straight bars under this load, where the material has a yield stress."""
    beyond_yield: bool = False


class Curve(Record):
    """A force-deflection curve; compression negative."""

    model: str
    """vjm | fea (solid bars) | frame (beams) | lin"""
    q_deg: float
    held: list[str]
    spring_at: str
    branch: str
    """"straight" or "buckled"."""
    x_mm: list[float]
    fx_N: list[float]
    critical_N: list[float]
    note: str
    band: float | None = None
    """Relative discretisation error of `fx_N` past the critical load, of a finite-element curve."""
    yield_x_mm: float | None = None
    """Where the first fibre reaches the yield stress; None where the curve does not come so far."""
    yield_fx_N: float | None = None
    largest_stress_MPa: float | None = None
    """On this curve, where the material has a yield stress."""


class Validity(Record):
    """Load (N, compression positive) at which `model` has left LIN by the relative `deviation`."""

    model: str
    q_deg: float
    held: list[str]
    deviation: float
    load_N: float | None
    stress_MPa: float | None = None
    """Of the fibre under the largest stress, where the material has a yield stress."""
    beyond_yield: bool = False


class Refinement(Record):
    """One number of a load path at several refinements, coarse to fine."""

    model: str
    quantity: str
    q_deg: float
    held: list[str]
    refined: str
    """What is made finer: unknowns, steps, elements a bar, segments a bar."""
    sizes: list[int]
    values: list[float]
    limit: float
    band: float
    """Relative error of the value that the run uses."""
    used: int
    """The size that the run uses."""


class Erratum(Record):
    """A slip of the paper with the number that shows it."""

    number: int
    place: str
    printed: str
    correct: str
    evidence: str
    numbers: dict[str, float]


class Result(Record):
    """Everything a validation run has found."""

    schema_version: int
    case: str
    title: str
    detail: str
    """coarse | default | fine"""
    length_mm: float
    width_mm: float
    bar: Bar
    buckling: list[Buckling]
    parallelogram: list[Parallelogram]
    critical: list[Critical]
    curves: list[Curve]
    validity: list[Validity]
    refinement: list[Refinement] = Field(default_factory=list)
    agreement: list[str] = Field(default_factory=list)
    """Why the curves of solid, frame, refined springs and LIN differ, a sentence each."""
    orthoglide: list[Table1]
    """The paper's Table 1; empty for a case that is not the paper's."""
    errata: list[Erratum]
    warnings: list[str] = Field(default_factory=list)
    """Where two models, meshes or routes of this run are farther apart than their stated band, a sentence each."""
    yield_MPa: float | None = None
    story: list[str]
    """The findings in plain sentences, every number from this run."""
    seconds: dict[str, float]
    versions: dict[str, str]
    commit: str
    command: str
    """What was typed to make it."""
    seed: int
    solver: str
    sources: list[str]


def read_result(path: Path) -> Result:
    """A saved result. InputError where it cannot be read or is none."""
    return Result.read(path, "saved result")


def write_text(path: Path, text: str) -> None:
    """Write a file whole or not at all."""
    with replacing(path) as part:
        part.write_text(text, encoding="utf-8")


def write_result(result: Result, folder: Path) -> Path:
    """Write `result.json` into the folder; returns its path."""
    path = folder / "result.json"
    write_text(path, json.dumps(result.model_dump(), indent=1, allow_nan=False) + "\n")
    return path
