"""Small tables of every kind: each command gives a result or says what it cannot use, and nothing else comes out."""

from pathlib import Path

import pytest
from hypothesis import HealthCheck, Phase, given, seed, settings

from pipeline.inference.model import Model, Term
from pipeline.inference.model_file import ModelFile, model_text
from tests.fuzz.commands import looked
from tests.fuzz.tables import Files, files
from vjm.effects import catalogue

# A manipulator takes seconds where a bar takes tenths.
KINDS = (*("bar", "parallelogram") * 12, "manipulator")
# The quick ones are of one test and two rows: a search over a dozen rows takes a minute and more.
QUICK, PARTS, PER_PART = 3, 40, 50
CANTILEVER = """schema = 1
name = "small"

[rig]
kind = "bar"
length_mm = 200.0
bar = { EA_N = 6.8e+06, EIy_Nmm2 = 2.0e+08, EIz_Nmm2 = 4.5e+07, GJ_Nmm2 = 1.1e+07 }

[noise]
z_mm = 0.01

[[tests]]
id = "t0"
role = "fit"
control = { x = "force", y = "force", z = "force", rx = "force", ry = "force", rz = "force" }
"""
ROWS = "test,step,z_mm,fz_N\nt0,0,0.0,0.0\nt0,1,0.15,10.0\nt0,2,0.29,20.0\n"
EFFECTS = catalogue()
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


@pytest.mark.parametrize(
    ("effect", "said"),
    [("material_yield", "needs the rig's outermost fibres"), ("joint_friction", "needs a bar with a hinge")],
)
def test_a_saved_effect_that_the_rig_cannot_have_is_refused(effect: str, said: str) -> None:
    model = Model((Term(EFFECTS[effect], EFFECTS[effect].typicals),))
    seen = looked(Files(CANTILEVER, ROWS, model_text(ModelFile(model), Path()), "base_compliance"))
    assert seen.done == {
        "read": "read",
        **dict.fromkeys(("compare", "predict", "diagnose", "plan", "add"), "refused"),
    }
    assert all(said in sentence for sentence in seen.refusals) and not seen.faults


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
