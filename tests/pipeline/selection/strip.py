"""A strip 4 x 20 mm, clamped over 250 mm, pushed at its tip along y, as a campaign of a dial and a load cell."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign import Campaign, read

Floats = NDArray[np.float64]
GIVE = 250.0**3 / (3.0 * 20.0 * 4.0**3 / 12.0)
"""mm·MPa/N at the tip: the closed form of a cantilever."""
Y, FY = 0.005, 0.01
"""mm and N, one sigma."""
TOML = f"""schema = 1
name = "strip"
[rig]
kind = "bar"
length_mm = 250.0
section = {{{{ kind = "rectangle", width_mm = 4.0, height_mm = 20.0 }}}}
material = {{{{ E_MPa = {{modulus}}, nu = 0.3 }}}}
base = "clamped"
tip = "free"
[noise]
y_mm = {Y}
fy_N = {FY}
[[tests]]
id = "t"
role = "fit"
control = {{{{ x = "force", y = "force", z = "force", rx = "force", ry = "force", rz = "force" }}}}
"""


def strip(folder: Path, modulus: float, force: Floats, y: Floats) -> Campaign:
    """Readings (N,) of force and displacement, with the modulus that is written, MPa."""
    rows = [f"t,{k},{fy},{value:.5f}" for k, (fy, value) in enumerate(zip(force, y, strict=True))]
    (folder / "measurements.csv").write_text("\n".join(["test,step,fy_N,y_mm", *rows]) + "\n")
    (folder / "campaign.toml").write_text(TOML.format(modulus=modulus))
    return read(folder)
