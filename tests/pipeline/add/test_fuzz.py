"""Damaged campaigns: adding an effect gives an answer or a sentence, and touches nothing but the model's file."""

import tempfile
from collections import Counter
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pipeline.add.command import add_effects
from pipeline.errors import InputError
from pipeline.inference.model_reading import read_model_file
from tests.pipeline.campaign.example import CSV, TOML, laid
from tests.pipeline.campaign.mutations import Mutation, mutations

damage = st.lists(st.tuples(st.booleans(), mutations), min_size=1, max_size=2)


def verdict(changes: list[tuple[bool, Mutation]]) -> str:
    """What add says of the damaged files; anything but an answer, a refusal or a failure with a reason gets out."""
    toml, csv = TOML.encode(), CSV.encode()
    for first, mutation in changes:
        toml, csv = (mutation(toml), csv) if first else (toml, mutation(csv))
    with tempfile.TemporaryDirectory() as name:
        folder = laid(Path(name), csv=csv)
        (folder / "campaign.toml").write_bytes(toml)
        try:
            add_effects(folder, ["modulus_error"], quiet=True)
            said = "added"
        except InputError as error:
            assert str(error).strip()
            said = "refused"
        except RuntimeError as error:
            assert "cannot be solved anywhere: " in str(error)
            said = "failed"
        assert (folder / "campaign.toml").read_bytes() == toml
        assert (folder / "measurements.csv").read_bytes() == csv
        written = sorted(p.name for p in folder.iterdir())
        assert written == ["campaign.toml", "measurements.csv", *(["model.toml"] if said == "added" else [])]
        if said == "added":
            assert read_model_file(folder / "model.toml").model.names == ("modulus_error",)
    return said


@pytest.mark.long
def test_damage_is_fitted_or_refused() -> None:
    seen: Counter[str] = Counter()

    @settings(max_examples=20, derandomize=True, deadline=None, database=None)
    @given(damage)
    def count(changes: list[tuple[bool, Mutation]]) -> None:
        seen[verdict(changes)] += 1

    count()
    assert seen["refused"] >= 5 and seen["added"] >= 1, seen
