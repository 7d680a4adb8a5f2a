"""What is left of a misfit, as a Gaussian process: it names what a fault goes with, and finds nothing in noise."""

from __future__ import annotations

from pipeline.campaign import Campaign
from pipeline.discrepancy.description import Description, descriptions
from pipeline.inference.driving import column_name
from pipeline.inference.fit import fit
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from tests.pipeline.selection.bench import bench, cross_talk, with_fault
from vjm.effects import catalogue


def described(campaign: Campaign) -> list[Description]:
    return descriptions(
        fit(Model().with_effects([catalogue()["bar_geometric_nonlinearity"]]), load_cases(campaign))
    )


def test_cross_talk_goes_with_the_axial_force() -> None:
    """Eight newtons of fy at the largest fx, in all tests alike: each test is foretold by the others."""
    (worst, *_) = described(with_fault(bench(), cross_talk))
    assert column_name(worst.channel, bench().gauges) == "fy"
    assert worst.inputs[0] == "the prescribed fx"
    assert worst.rms > 3.0
    assert worst.elsewhere < 0.5 * worst.rms


def test_nothing_is_found_in_noise() -> None:
    """The worst of ten channels stays near one, and no test foretells another by more than chance."""
    for each in described(bench()):
        assert each.rms < 1.6
        assert each.elsewhere > 0.8 * each.rms
