"""K_b of bar P by the chain of slices beside CalculiX on the very same mesh of 20-node hexahedra."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from fem.rigid_motions import rigid_motions
from fem.slices.stiffness import chain_stiffness
from meshes.extrusion import stepped_thickness
from meshes.resolution import Resolution
from tests.fem import bar_p
from tests.meshes.solids import section_solid
from tests.peers import calculix

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(calculix.CCX is None, reason="CalculiX (ccx) is not installed"),
]


def test_bar_stiffness(tmp_path: Path) -> None:
    """Nothing but displacement boundary conditions is asked of CalculiX: the tip's nodes moved by unit motions."""
    counts = (4, 4, 8)
    made = section_solid(bar_p.SECTION, Resolution(bar_p.SIZE, 2), stepped_thickness(bar_p.LENGTH, counts))
    tip = made.mesh.face_nodes("tip")
    motions = rigid_motions(made.mesh.points[tip] - np.array([bar_p.LENGTH, 0.0, 0.0]))
    deck = [*calculix.model(made.mesh, bar_p.MATERIAL), *calculix.moved_tip(made.mesh, motions)]
    found = calculix.nodal(calculix.run(deck, tmp_path).read_text(), len(tip))
    assert len(found) == 6
    theirs = np.stack([motions.T @ forces.ravel() for forces in found], axis=1)
    for axes in (None, ()):
        ours = chain_stiffness(made.sweep, bar_p.MATERIAL, axes)
        print(made.mesh.dofs, bar_p.entries(theirs) / bar_p.entries(ours) - 1.0)
        np.testing.assert_allclose(bar_p.entries(theirs), bar_p.entries(ours), rtol=1e-5)
