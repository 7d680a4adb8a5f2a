"""The dossier of a fit that is at hand is that of its model fitted anew."""

from __future__ import annotations

import pytest

from pipeline.inference.fit import fit
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.suitable import known_effects
from pipeline.page import dossier as made
from pipeline.page.dossier import dossier
from pipeline.selection.criteria import CRITERIA
from tests.pipeline.bench import bench


def test_a_fit_at_hand_is_not_made_again(monkeypatch: pytest.MonkeyPatch) -> None:
    campaign = bench("modulus_error.scale", 0.95)
    known = known_effects().effects
    model = Model().with_effects([known["bar_geometric_nonlinearity"], known["modulus_error"]])
    found = fit(model, load_cases(campaign), None, None, CRITERIA.plausible)
    anew, nothing = dossier(campaign, found.model)
    monkeypatch.delattr(made, "fitted_to")
    there, failed = dossier(campaign, found.model, found)
    assert anew is not None and there is not None and nothing == failed == ()
    assert (there.inside, there.readings, there.data) == (anew.inside, anew.readings, anew.data)
    assert there.noise_factor == pytest.approx(anew.noise_factor, rel=1e-6)
    for one, other in zip(there.comparison, anew.comparison, strict=True):
        assert one.column == other.column
        assert one.error_rms == pytest.approx(other.error_rms, rel=1e-3)
        assert one.u_val == pytest.approx(other.u_val, rel=1e-3)
    assert [it.std for it in there.budget] == pytest.approx([it.std for it in anew.budget], rel=1e-3)
