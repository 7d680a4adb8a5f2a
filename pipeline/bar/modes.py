"""Critical loads of a brought bar under the supports of shipped ones, on nested meshes, and its mode shapes."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from fem.buckling import Mode, buckling
from fem.mesh_limit import FASTEST, POWER, SLOWEST
from fem.part_bar import PartBar
from meshes.files import replacing
from meshes.part import CORNERS, PartMesh, boundary
from pipeline.progress import Stage
from pipeline.validation.result import Buckling
from pipeline.validation.stages.buckling import HELD

MODES = 3


def buckled(bars: tuple[PartBar, ...], folder: Path, stage: Stage) -> list[Buckling]:
    """The lowest modes of every support, shapes of the coarsest mesh to a file each; loads of the finest, with limits.

    RuntimeError if fewer modes are found than asked for.
    """
    records = []
    for supports in HELD:
        stage.say(f"{supports} tip")
        modes = [_modes(bar, supports) for bar in bars]
        _write(bars[0].mesh, modes[0], folder / f"{supports}.vtu")
        records += [_record(supports, k + 1, [m[k] for m in modes]) for k in range(MODES)]
    return records


def _modes(bar: PartBar, supports: str) -> tuple[Mode, ...]:
    model = bar.model("pinned" if supports == "pinned" else "rigid")
    return buckling(model, HELD[supports], MODES)


def _record(supports: str, number: int, modes: list[Mode]) -> Buckling:
    last = modes[-1]
    plain = Buckling(
        body="bar", model="solid", supports=supports, plane=last.plane, mode=number, load_N=last.load
    )
    if len(modes) == 1 or modes[-2].plane != last.plane:
        return plain
    step = last.load - modes[-2].load
    ends = [last.load + step / (2.0**power - 1.0) for power in (SLOWEST, FASTEST)]
    limit = last.load + step / (2.0**POWER - 1.0)
    band = max(abs(end - limit) for end in (*ends, last.load)) / limit
    return plain.model_copy(update={"limit_N": limit, "band": band})


def _write(mesh: PartMesh, modes: tuple[Mode, ...], path: Path) -> None:
    """The surface by the corners of its facets, mode shapes as point data mode_1 .., largest displacement 1 mm."""
    import meshio

    outside = boundary(mesh.blocks)
    cells = [("triangle" if CORNERS[k] == 3 else "quad", own[:, : CORNERS[k]]) for k, own in outside.items()]
    used = np.unique(np.concatenate([own.ravel() for _, own in cells]))
    number = np.zeros(len(mesh.points), dtype=np.int64)
    number[used] = np.arange(len(used))
    fields = {
        f"mode_{n}": mode.displacements[0].reshape(-1, 3)[used].astype(np.float32)
        for n, mode in enumerate(modes, 1)
    }
    body = meshio.Mesh(mesh.points[used], [(k, number[own]) for k, own in cells], point_data=fields)
    with replacing(path) as part:
        meshio.write(part, body, file_format="vtu")
