"""Small campaigns of every kind as text: what somebody may bring from a bench on the first day.

The readings come from one linear stiffness, written down here and not by the program; where that is far from the rig
(large deflections, loads beyond buckling) the table simply does not fit, as tables do.
"""

from __future__ import annotations

import csv
import io
import json
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from hypothesis import strategies as st
from numpy.typing import NDArray

from vjm.effects import catalogue
from vjm.effects.sized import Scale, scale_of, sized
from vjm.stiffness import closed_form

Array = NDArray[np.float64]
COLUMNS = ("x_mm", "y_mm", "z_mm", "rx_rad", "ry_rad", "rz_rad")
LOADS = ("fx_N", "fy_N", "fz_N", "mx_Nmm", "my_Nmm", "mz_Nmm")
COORDINATES = ("x", "y", "z", "rx", "ry", "rz")
TIPS = {"free": COORDINATES, "pinned": ("x",), "guided": ("x", "y", "z")}
IDS = ("t0", "axial_q+30", "Prüfung 3", "試験-一", "اختبار", "бросок", "😀 lateral", "a" * 100)
FAULTS = ("exact", "noisy", "offset", "tenfold", "flipped")


@dataclass(frozen=True)
class Files:
    """The text of a campaign's files. model: of model.toml, None for none. adding: the effect that `add` adds."""

    toml: str
    csv: str
    model: str | None
    adding: str

    def laid(self, folder: Path) -> Path:
        """The folder with the files in it."""
        folder.mkdir(parents=True, exist_ok=True)
        texts = {"campaign.toml": self.toml, "measurements.csv": self.csv, "model.toml": self.model}
        for name, text in texts.items():
            if text is not None:
                (folder / name).write_text(text, encoding="utf-8", newline="")
        return folder

    def __str__(self) -> str:
        model = f"\n--- model.toml\n{self.model}" if self.model is not None else ""
        return f"--- campaign.toml\n{self.toml}--- measurements.csv\n{self.csv}{model}--- add {self.adding}"


@dataclass(frozen=True, eq=False)
class Rig:
    """kind: of `[rig]`. toml: its table. length: mm, of its bars. tip: how a bar's tip is held."""

    kind: str
    toml: str
    length: float
    width: float
    bar: Array
    tip: str = "free"

    def stiffness(self, q: float) -> Array:
        """(6, 6) at the platform, N, mm, rad; q in rad."""
        if self.kind != "parallelogram":
            return self.bar
        turn = np.array([[np.cos(q), 0.0, np.sin(q)], [0.0, 1.0, 0.0], [-np.sin(q), 0.0, np.cos(q)]])
        both = np.kron(np.eye(2), turn)
        return np.asarray(both @ closed_form(self.bar, self.width, q) @ both.T)


def uniform(length: float, rigidities: Array) -> Array:
    """(6, 6) at the tip of a clamped bar; rigidities: EA, EIy, EIz, GJ."""
    ea, eiy, eiz, gj = rigidities
    k = np.diag([ea / length, 12 * eiz / length**3, 12 * eiy / length**3, gj / length, 0.0, 0.0])
    k[4, 4], k[5, 5] = 4 * eiy / length, 4 * eiz / length
    k[1, 5] = k[5, 1] = -6 * eiz / length**2
    k[2, 4] = k[4, 2] = 6 * eiy / length**2
    return np.asarray(k)


@st.composite
def rigs(draw: st.DrawFn, kinds: tuple[str, ...]) -> Rig:
    """From a paper strip to a steel block; `kinds` as often as they stand there."""
    kind = draw(st.sampled_from(kinds))
    if kind == "manipulator":
        toml = '[rig]\nkind = "manipulator"\nfile = "orthoglide"\n'
        return Rig(kind, toml, 310.0, 80.0, np.diag([3e3, 3e3, 3e3, 4e6, 4e6, 4e6]))
    length = draw(st.sampled_from([20.0, 200.0, 310.0, 1000.0]))
    size = draw(st.sampled_from([0.05, 0.3, 1.0, 3.0, 30.0]))
    rigidities = np.array([6.8e6 * size**2, 2e8 * size**4, 4.5e7 * size**4, 1.1e7 * size**4])
    keys = dict(zip(("EA_N", "EIy_Nmm2", "EIz_Nmm2", "GJ_Nmm2"), rigidities, strict=True))
    bar = ", ".join(f"{key} = {value:.6e}" for key, value in keys.items())
    lines = [f'[rig]\nkind = "{kind}"\nlength_mm = {length}\nbar = {{ {bar} }}']
    width, tip = 0.0, "free"
    if kind == "parallelogram":
        width = draw(st.sampled_from([0.25, 0.1, 1.0])) * length
        lines.append(f"width_mm = {width}")
    else:
        tip = draw(st.sampled_from(["free", "free", "free", "pinned", "guided"]))
        base = draw(st.sampled_from(["clamped", "clamped", "pinned"]))
        lines.append(f'base = "{base}"\ntip = "{tip}"')
    if draw(st.integers(0, 3)) == 0:
        lines.append("gravity = [0, 0, -1]\nplatform_weight_N = 4.0")
    return Rig(kind, "\n".join(lines) + "\n", length, width, uniform(length, rigidities), tip)


@dataclass(frozen=True, eq=False)
class Table:
    """A test. readings: (rows, 12), NaN where nothing is read."""

    head: str
    id: str
    control: tuple[str, ...]
    readings: Array


@st.composite
def tables(draw: st.DrawFn, rig: Rig, id: str, most: int) -> Table:
    """One test that is driven by one coordinate, with some of the twelve columns."""
    coordinates = TIPS[rig.tip]
    q = 0.0
    head = f"[[tests]]\nid = {json.dumps(id, ensure_ascii=False)}\n"
    if rig.kind == "parallelogram":
        q = draw(st.sampled_from([0.0, 0.0, 5.0, 30.0, -30.0, 60.0, 85.0, -85.0]))
        head += f"q_deg = {q}\n"
    elif rig.kind == "manipulator":
        head += f"at_mm = {draw(st.sampled_from([[0.0, 0.0, 0.0], [50.0, -40.0, 60.0]]))}\n"
    head += f'role = "{draw(st.sampled_from(["fit", "fit", "fit", "holdout"]))}"\n'
    zero = draw(st.sampled_from(["nominal", "nominal", "nominal", "first_row", "fitted"]))
    head += "" if zero == "nominal" else f'zero = "{zero}"\n'
    control = tuple(draw(st.sampled_from(["force", "force", "displacement"])) for _ in coordinates)
    if rig.kind == "parallelogram" and draw(st.integers(0, 5)):
        # Without it the platform swings, and nearly all such tables are refused.
        control = tuple(
            "displacement" if c == "z" else by for c, by in zip(coordinates, control, strict=True)
        )
    pairs = ", ".join(f'{c} = "{by}"' for c, by in zip(coordinates, control, strict=True))
    head += f"control = {{ {pairs} }}\n"
    driven = draw(st.sampled_from(coordinates))
    rows = draw(st.integers(1, most))
    share = draw(st.sampled_from([1e-6, 1e-4, 1e-3, 1e-2, 0.3]))
    path = share * np.linspace(0.0 if rows > 1 else 1.0, 1.0, rows)
    if draw(st.booleans()):
        path = np.concatenate([path, -path[1:]])[:most]
    full = tuple(control[coordinates.index(c)] if c in coordinates else "held" for c in COORDINATES)
    readings = _readings(rig, np.radians(q), full, COORDINATES.index(driven), path)
    seen = np.array([draw(st.booleans()) for _ in range(12)])
    for k, by in enumerate(full):
        seen[k] |= by == "displacement"
        seen[k] &= by != "held"
        seen[6 + k] |= by == "force" and COORDINATES[k] == driven
    readings[:, ~seen] = np.nan
    return Table(head, id, full, readings)


def _readings(rig: Rig, q: float, control: tuple[str, ...], driven: int, path: Array) -> Array:
    """(rows, 12) of the linear rig, one coordinate driven by its displacement or its force."""
    k = rig.stiffness(q)
    own = 1.0 if driven > 2 else rig.length
    given = np.array([by != "force" for by in control])
    out = np.zeros((len(path), 12))
    for row, part in zip(out, path, strict=True):
        u, f = np.zeros(6), np.zeros(6)
        if control[driven] == "force":
            f[driven] = part * own * max(abs(k[driven, driven]), 1e-6)
        else:
            u[driven] = part * own
        free = ~given
        if free.any():
            right = f[free] - k[np.ix_(free, given)] @ u[given]
            u[free] = np.linalg.lstsq(k[np.ix_(free, free)], right, rcond=1e-9)[0]
        row[:6], row[6:] = u, k @ u
    return out


@st.composite
def files(
    draw: st.DrawFn, kinds: tuple[str, ...] = ("bar", "parallelogram"), most: int = 12, tests_most: int = 3
) -> Files:
    """A campaign of 1 to `tests_most` tests and 1 to `most` rows a test."""
    rig = draw(rigs(kinds))
    ids = draw(st.lists(st.sampled_from(IDS), min_size=1, max_size=tests_most, unique=True))
    tests = [draw(tables(rig, id, most)) for id in ids]
    size = np.nanmax(np.abs(np.vstack([np.zeros((1, 12)), *(test.readings for test in tests)])), axis=0)
    sigmas = _sigmas(draw, rig, size)
    tests = _faulty(draw, tests, np.where(np.isfinite(sigmas), sigmas, 1e-3 * size), size)
    told = np.isfinite(sigmas) & np.array([_read(tests, k) for k in range(12)])
    noise = "".join(f"{name} = {sigmas[k]:.3e}\n" for k, name in enumerate((*COLUMNS, *LOADS)) if told[k])
    top = 'schema = 1\nname = "small"\n\n'
    toml = top + rig.toml + f"\n[noise]\n{noise}\n" + "\n".join(test.head for test in tests)
    effect = draw(st.sampled_from(sorted(catalogue())))
    return Files(toml, _csv(draw, tests), draw(_models(rig)), effect)


def _read(tests: list[Table], column: int) -> bool:
    return any(np.isfinite(test.readings[:, column]).any() for test in tests)


def _sigmas(draw: st.DrawFn, rig: Rig, size: Array) -> Array:
    """(12,) NaN where none is given; one factor for all, from far too small to far too large."""
    own = np.where(np.arange(12) % 6 > 2, 1e-3, 1e-3 * rig.length) * np.where(np.arange(12) > 5, 1e3, 1.0)
    factor = draw(st.sampled_from([1e-2, 1e-2, 1e-3, 1e-1, 1e-7, 1e5]))
    sigma = factor * np.where(size > 0.0, size, own)
    if draw(st.integers(0, 4)) == 0:
        sigma[[draw(st.booleans()) for _ in range(12)]] = np.nan
    return np.asarray(np.clip(sigma, 1e-12, 1e9))


def _faulty(draw: st.DrawFn, tests: list[Table], sigma: Array, size: Array) -> list[Table]:
    """The tests with what was wrong on that day."""
    fault = draw(st.sampled_from(FAULTS))
    factor = np.where(np.arange(12) < 6, draw(st.sampled_from([1.0, 1.0, 1.18, 9.81])), 1.0)
    noise = np.random.default_rng(draw(st.integers(0, 999)))
    column = draw(st.integers(0, 11))
    out = []
    for test in tests:
        data = test.readings * factor
        if fault != "exact":
            data = data + sigma * noise.normal(size=data.shape)
        if fault == "offset":
            data[:, column] += 10.0 * sigma[column] + 0.3 * size[column]
        elif fault == "tenfold":
            data[draw(st.integers(0, len(data) - 1)), column] *= 10.0
        elif fault == "flipped":
            data[:, 6:] *= -1.0
        holes = noise.random(data.shape) < draw(st.sampled_from([0.0, 0.0, 0.2]))
        # What is prescribed has to be there.
        holes[:, :6] &= np.array(test.control) != "displacement"
        out.append(replace(test, readings=np.where(holes, np.nan, data)))
    return out


def _csv(draw: st.DrawFn, tests: list[Table]) -> str:
    kept = [k for k in range(12) if _read(tests, k)]
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["test", "step", *((*COLUMNS, *LOADS)[k] for k in kept)])
    digits = draw(st.sampled_from([4, 8, 12]))
    for test in tests:
        for step, row in enumerate(test.readings):
            cells = ("" if np.isnan(row[k]) else f"{row[k]:.{digits}g}" for k in kept)
            writer.writerow([test.id, step, *cells])
    return out.getvalue()


@st.composite
def _models(draw: st.DrawFn, rig: Rig) -> str | None:
    """A saved model of one effect that the rig can have, each parameter absent, usual or at a bound; mostly none."""
    if draw(st.integers(0, 3)):
        return None
    kind = "bar" if rig.kind == "bar" else "parallelogram"
    scale = scale_of(rig.length, rig.bar) if rig.kind != "manipulator" else Scale()
    able = [e for e in catalogue().values() if kind in e.kinds and not (kind == "bar" and e.hinge)]
    effect = sized(draw(st.sampled_from(able)), scale)
    lines = ["schema = 1", 'base = "vjm"', "fixed = []", "[[effects]]", f'name = "{effect.name}"']
    if effect.parameters:
        lines.append("[effects.values]")
    for p in effect.parameters:
        value = draw(st.sampled_from([p.null, p.null + p.typical, p.low, p.high]))
        lines.append(f"{p.name} = {value!r}")
    return "\n".join(lines) + "\n"
