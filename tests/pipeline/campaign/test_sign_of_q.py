"""At q > 0 the bars point towards -z: what the words say is what the mechanism does."""

from pathlib import Path

import numpy as np
import pytest

from pipeline.campaign import ParallelogramRig
from pipeline.campaign.rigs import KINDS
from pipeline.campaign.tables import TestTable
from pipeline.init.command import init
from vjm import paper
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.stiffness import unloaded_stiffness

GLOSSARY = Path(__file__).parents[3] / "docs" / "glossary.md"


@pytest.mark.parametrize("q", [0.5, -0.5])
def test_the_stiff_direction_of_the_linkage_is_that_of_its_bars(q: float) -> None:
    """Along its bars a parallelogram is stiff, across them it swings: the direction follows from K alone."""
    k = unloaded_stiffness(Parallelogram(310.0, 80.0, paper.BAR_STIFFNESS, q))[np.ix_([0, 2], [0, 2])]
    values, vectors = np.linalg.eigh(k)
    stiff = vectors[:, 1] * np.sign(vectors[0, 1])
    assert values[1] > 1e3 * abs(values[0])
    assert np.sign(stiff[1]) == -np.sign(q)
    rig = ParallelogramRig(length=310.0, width=80.0, bar_stiffness=paper.BAR_STIFFNESS)
    np.testing.assert_allclose(stiff, rig.nominal_pose(np.array(q))[[0, 2]] / 310.0, atol=1e-6)


def test_words_say_so(tmp_path: Path) -> None:
    assert "the unloaded platform is at z = -L sin q" in " ".join(GLOSSARY.read_text().split())
    assert "positive where they point towards -z" in KINDS["parallelogram"].posture_template
    init(tmp_path, None, "parallelogram")
    assert "positive where they point towards -z" in (tmp_path / "campaign.toml").read_text()
    assert "q_deg" in TestTable.model_fields
