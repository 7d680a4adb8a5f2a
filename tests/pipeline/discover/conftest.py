"""A bench with friction in its hinges, diagnosed without that effect, and the laws that are found there."""

import pytest

from pipeline.discover import looking
from pipeline.selection.diagnosis import Diagnosis
from tests.pipeline.discover.fits import diagnosed, friction_found


@pytest.fixture(scope="module")
def unknown() -> Diagnosis:
    return diagnosed(600.0, "joint_torsional_stiffness", "base_compliance")


@pytest.fixture
def known_laws(monkeypatch: pytest.MonkeyPatch) -> None:
    """The laws of that bench are looked for once for all tests."""
    monkeypatch.setattr(looking, "discover", lambda *_: friction_found())
