"""A process of its own for the benchmark: draw bar P through layers, make K_b by the chain, print it as JSON.

Arguments: mesh size in mm, level, counts of layers as `meshes.extrusion.stepped_thickness` takes them ("8,8,32"), and
"quarter" or "whole".
"""

import json
import sys

from fem.material import Isotropic
from fem.slices.stiffness import chain_stiffness
from meshes.extrusion import stepped_thickness
from meshes.resolution import Resolution
from meshes.section import ISection
from tests.meshes.solids import section_sweep

# Bar P (tests/fem/bar_p.py, which imports more than a user of the chain does).
SECTION, LENGTH, MATERIAL = ISection(12.0, 2.2, 15.5, 4.0), 310.0, Isotropic(70e3, 0.33)


def main(size: str, level: str, counts: str, part: str) -> None:
    """Solve one mesh and print one line."""
    thickness = stepped_thickness(LENGTH, [int(n) for n in counts.split(",")])
    sweep = section_sweep(SECTION, Resolution(float(size), int(level)), thickness)
    stiffness = chain_stiffness(sweep, MATERIAL, () if part == "whole" else None)
    print(json.dumps({"unknowns": sweep.dofs, "stiffness": stiffness.tolist()}))


if __name__ == "__main__":
    main(*sys.argv[1:])
