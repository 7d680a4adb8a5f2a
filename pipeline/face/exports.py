"""Stiffness for other programs."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from pipeline.export.command import written
from pipeline.export.source import Sources


def export(
    source: str | Path,
    to: str,
    out: str | Path,
    q_deg: float | None = None,
    model: str | Path | None = None,
    effects: Iterable[str | Path] = (),
) -> tuple[Path, ...]:
    """Write K_b of a bar, or K_p of a parallelogram at an angle, for another program; returns the files.

    source: folder of a campaign, with the model that is kept there, or the result.json of a run. to: json, npz, mat,
    inp (CalculiX, Abaqus), dmig (Nastran), mjcf (MuJoCo), exudyn, urdf; units stand at the head of each file. out:
    file to write. q_deg: angle of the parallelogram; default its bar. model: another model.toml. effects: files of
    effects of one's own. InputError for a source, a format or a place that cannot be used.
    """
    asked = Sources(Path(source), q_deg, None if model is None else Path(model), [Path(it) for it in effects])
    return tuple(written(asked, to, Path(out))[0])
