"""Damaged campaigns that still read: compare gives a comparison or a sentence, and the campaign stays as it was."""

import tempfile
from collections import Counter
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pipeline.compare.command import compare
from pipeline.errors import InputError
from tests.pipeline.campaign.example import BAR, BAR_CSV, CSV, TOML, laid
from tests.pipeline.campaign.mutations import Mutation, mutations

SIGMAS = "\n[noise]\nx_mm = 1e-3\ny_mm = 1e-3\nz_mm = 1e-3\nfx_N = 1.0\nfy_N = 1.0\nfz_N = 1.0\n"
# The bar of the example says no sigma and has too few steps to estimate one.
PAIRS = ((TOML, CSV), (BAR.replace("[[tests]]", SIGMAS + "[[tests]]"), BAR_CSV))
damage = st.lists(st.tuples(st.booleans(), mutations), min_size=1, max_size=3)
pairs = st.sampled_from(PAIRS)


def verdict(texts: tuple[str, str], changes: list[tuple[bool, Mutation]]) -> str:
    """What compare says of the damaged files; anything but a comparison or an InputError is let through."""
    toml, csv = (text.encode() for text in texts)
    for first, mutation in changes:
        toml, csv = (mutation(toml), csv) if first else (toml, mutation(csv))
    with tempfile.TemporaryDirectory() as name:
        folder = laid(Path(name), csv=csv)
        (folder / "campaign.toml").write_bytes(toml)
        try:
            result = compare(folder, quiet=True)
        except InputError as error:
            assert str(error).strip()
            said = "refused"
        else:
            failed = [model.failed for model in result.models if model.failed is not None]
            assert all(len(reason) > 10 for reason in failed)
            said = "failed" if failed else "lost" if any(m.lost for m in result.models) else "compared"
        assert (folder / "campaign.toml").read_bytes() == toml
        assert (folder / "measurements.csv").read_bytes() == csv
        assert sorted(p.name for p in folder.iterdir()) == ["campaign.toml", "measurements.csv"]
    return said


def test_damage_is_compared_or_refused() -> None:
    """Of both kinds, or the mutations would test one half only; about one in seven is compared."""
    seen: Counter[str] = Counter()

    @settings(max_examples=40, derandomize=True, deadline=None, database=None)
    @given(pairs, damage)
    def count(texts: tuple[str, str], changes: list[tuple[bool, Mutation]]) -> None:
        seen[verdict(texts, changes)] += 1

    count()
    assert seen["refused"] >= 10 and sum(seen.values()) - seen["refused"] >= 2, seen


@pytest.mark.long
@settings(max_examples=2000, derandomize=True, deadline=None, database=None)
@given(pairs, damage)
def test_much_damage_is_compared_or_refused(
    texts: tuple[str, str], changes: list[tuple[bool, Mutation]]
) -> None:
    assert verdict(texts, changes) in ("compared", "lost", "failed", "refused")
