"""A process of its own for the benchmark: read a mesh, make K_b, print seconds, peak memory and the matrix as JSON.

The clock runs from the mesh file to K_b, loading MKL included; Python's start and imports are told apart.
"""

import json
import resource
import sys
import time

import numpy as np

from fem.linear import LinearModel
from fem.linkage import single_bar
from fem.solvers import automatic, direct, multigrid
from fem.space import Space
from meshes.solid import SolidMesh
from tests.fem import bar_p

SOLVERS = {"automatic": automatic, "direct": direct, "multigrid": multigrid}


def main(path: str, solver: str) -> None:
    """Solve one mesh and print one line."""
    start = time.perf_counter()
    data = np.load(path)
    mesh = SolidMesh(
        data["points"], data["cells"], "hexahedron20", {n: data[n] for n in ("base", "tip", "side")}
    )
    model = LinearModel(single_bar(Space.of(mesh), bar_p.LENGTH), bar_p.MATERIAL, SOLVERS[solver])
    stiffness = model.stiffness
    seconds = time.perf_counter() - start
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    print(json.dumps({"seconds": seconds, "peak_bytes": peak, "stiffness": stiffness.tolist()}))


if __name__ == "__main__":
    main(*sys.argv[1:])
