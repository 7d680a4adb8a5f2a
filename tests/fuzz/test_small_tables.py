"""Small tables of every kind: each command gives a result or says what it cannot use, and nothing else comes out."""

import pytest
from hypothesis import HealthCheck, Phase, given, seed, settings

from tests.fuzz.commands import looked
from tests.fuzz.tables import Files, files

# A manipulator takes seconds where a bar takes tenths.
KINDS = (*("bar", "parallelogram") * 12, "manipulator")
# The quick ones are of one test and two rows: a search over a dozen rows takes a minute and more.
QUICK, PARTS, PER_PART = 12, 40, 50
health = [HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.large_base_example]


@settings(
    max_examples=QUICK,
    derandomize=True,
    deadline=None,
    database=None,
    suppress_health_check=health,
    phases=[Phase.generate],
)
@given(files(most=2, tests_most=1))
def test_a_small_table_gives_a_result_or_a_complaint(it: Files) -> None:
    assert not looked(it).faults, it


@pytest.mark.long
@pytest.mark.parametrize("part", range(PARTS))
def test_many_small_tables(part: int) -> None:
    @seed(part)
    @settings(
        max_examples=PER_PART,
        deadline=None,
        database=None,
        suppress_health_check=health,
        phases=[Phase.generate],
    )
    @given(files(KINDS))
    def each(it: Files) -> None:
        assert not looked(it).faults, it

    each()
