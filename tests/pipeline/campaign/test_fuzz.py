"""Damaged campaigns: each gives a Campaign or sentences that name the file, and never anything else."""

import re
import tempfile
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pipeline.campaign import BadCampaign, Campaign, read
from pipeline.toml.complaints import SHOWN
from pipeline.toml.stiffness import not_a_stiffness
from tests.pipeline.campaign.example import BAR, BAR_CSV, CSV, TOML, laid
from tests.pipeline.campaign.mutations import Mutation, mutations

damage = st.lists(st.tuples(st.booleans(), mutations), min_size=1, max_size=4)
pairs = st.sampled_from([(TOML, CSV), (BAR, BAR_CSV)])


def outcome(folder: Path) -> str:
    """Whether it was read or refused, after a look at what came of it."""
    try:
        campaign = read(folder)
    except BadCampaign as error:
        assert str(error).count("\n") <= SHOWN
        for sentence in error.complaints:
            assert str(folder) in sentence and sentence.isprintable() and len(sentence) < 700
            # What was said beyond the place: more than a word.
            assert re.search(r": .*\w+ .*\w+", sentence), sentence
        return "refused"
    sound(campaign)
    return "read"


def sound(campaign: Campaign) -> None:
    """What every user of a campaign relies on."""
    assert any(test.role == "fit" for test in campaign.tests)
    for test in campaign.tests:
        assert np.isfinite(test.inputs(campaign.gauges)).all() and test.data.steps.size
        assert (np.diff(test.data.steps) >= 0).all() and np.isfinite(test.rig.stiffness).all()
        assert not not_a_stiffness(test.rig.stiffness.tolist()) and np.cos(test.q) > 0.08
    for sigmas in (campaign.noise.displacement, campaign.noise.wrench, campaign.noise.gauges):
        assert not (sigmas <= 0).any()


def damaged(texts: tuple[str, str], changes: list[tuple[bool, Mutation]]) -> str:
    """Outcome of reading the damaged files; the folder is as it was afterwards."""
    toml, csv = (text.encode() for text in texts)
    for first, mutation in changes:
        toml, csv = (mutation(toml), csv) if first else (toml, mutation(csv))
    with tempfile.TemporaryDirectory() as name:
        folder = laid(Path(name), csv=csv)
        (folder / "campaign.toml").write_bytes(toml)
        said = outcome(folder)
        assert sorted(p.name for p in folder.iterdir()) == ["campaign.toml", "measurements.csv"]
        assert (folder / "campaign.toml").read_bytes() == toml
        assert (folder / "measurements.csv").read_bytes() == csv
    return said


@settings(max_examples=100, derandomize=True, deadline=None, database=None)
@given(pairs, damage)
def test_damage_is_read_or_refused(texts: tuple[str, str], changes: list[tuple[bool, Mutation]]) -> None:
    assert damaged(texts, changes) in ("read", "refused")


@pytest.mark.long
@settings(max_examples=2000, derandomize=True, deadline=None, database=None)
@given(pairs, damage)
def test_much_damage_is_read_or_refused(texts: tuple[str, str], changes: list[tuple[bool, Mutation]]) -> None:
    assert damaged(texts, changes) in ("read", "refused")


def test_the_damage_is_of_both_kinds() -> None:
    """If nothing survived, or nothing were refused, the mutations would test one half only."""
    seen: Counter[str] = Counter()

    @settings(max_examples=200, derandomize=True, deadline=None, database=None)
    @given(pairs, damage)
    def count(texts: tuple[str, str], changes: list[tuple[bool, Mutation]]) -> None:
        seen[damaged(texts, changes)] += 1

    count()
    # About one in ten is read; the bounds are far below what any stream of examples gives.
    assert seen["read"] >= 5 and seen["refused"] >= 100, seen
