"""The beam identified from K_b and the shear of its section: a frame of it has that K_b."""

import numpy as np
import pytest

from fem.beam import Segment, stepped_stiffness
from fem.frame.bench import Trial, run
from fem.frame.errors import Errors
from fem.frame.rig import Rig
from fem.frame.section import Section
from pipeline.validation.stages.frame import identified_section

LENGTH, GAY, GAZ = 310.0, 1.7e6, 1.0e6
BODY = Segment(LENGTH, 6.8e6, 2.0e8, 4.4e7, 1.0e7, GAY, GAZ)
# Stiff ends, and soft ones, of 6 mm, a factor from the body.
ENDS = {"stiff": 5.0, "soft": 0.6}


def ended(factor: float) -> np.ndarray:
    b = BODY
    lug = Segment(6.0, b.EA, factor * b.EIy, factor * b.EIz, b.GJ, b.GAy, b.GAz)
    body = Segment(LENGTH - 12.0, b.EA, b.EIy, b.EIz, b.GJ, b.GAy, b.GAz)
    return stepped_stiffness([lug, body, lug])


def at_rest(section: Section) -> np.ndarray:
    """(6, 6) of a clamped bar by central differences of the frame."""
    size = np.array([1e-3] * 3 + [1e-5] * 3)
    values = np.concatenate((np.diag(size), -np.diag(size)))
    rig = Rig("bar", LENGTH, section)
    trials = [Trial(0.0, ("displacement",) * 6, v[None]) for v in values]
    wrench = np.array([r.wrench[0] for r in run(rig, Errors(), trials)])
    return (wrench[:6] - wrench[6:]).T / (2 * size)


@pytest.mark.parametrize("ends", ENDS)
def test_the_frame_has_the_bars_stiffness(ends: str) -> None:
    k = ended(ENDS[ends])
    section = identified_section(k, LENGTH, GAY, GAZ)
    root = np.sqrt(np.diag(k))
    # Central differences over 1e-3 mm and 1e-5 rad: 1e-9.
    np.testing.assert_allclose(at_rest(section) / np.outer(root, root), k / np.outer(root, root), atol=1e-6)
    assert (section.about_z.base > 0.0) == (ends == "stiff")
    assert section.about_z.GA == GAY and section.about_y.GA == GAZ


def test_a_uniform_bar_has_no_stiff_ends() -> None:
    section = identified_section(stepped_stiffness([BODY]), LENGTH, GAY, GAZ)
    for plane, EI in ((section.about_y, BODY.EIy), (section.about_z, BODY.EIz)):
        assert pytest.approx(EI, rel=1e-9) == plane.EI
        assert plane.base == pytest.approx(0.0, abs=1e-9) and plane.tip == pytest.approx(0.0, abs=1e-9)
