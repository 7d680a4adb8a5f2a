"""Where no test of these sensors tells the sets apart, answer and page say what else may: a further sensor."""

from __future__ import annotations

from pathlib import Path

from pipeline.answer.evidence import Evidence
from pipeline.answer.record import Answer
from pipeline.answer.wording.diagnosis import no_next_test
from pipeline.campaign import read
from pipeline.page.words import following
from tests.pipeline.campaign.example import laid

SAID = "No further test with these sensors tells them apart: add a sensor at another place, or measure the part itself."
SETS = (("base_compliance",), ("modulus_error",))


def answer(no_sensor: bool, sets: tuple[tuple[str, ...], ...] = SETS) -> Answer:
    """Sets that fit alike, without a test that tells them apart."""
    evidence = Evidence(sets=sets, no_sensor=no_sensor)
    return Answer.model_construct(
        verdict="ambiguous",
        effects=SETS[0],
        alternatives=SETS[1:],
        next_test=None,
        doctor=(),
        evidence=evidence,
    )


def test_another_sensor_is_said_where_no_test_of_these_helps(tmp_path: Path) -> None:
    campaign = read(laid(tmp_path))
    assert [it.words for it in following(campaign, answer(False), True)] == [SAID]
    assert no_next_test(answer(False).evidence) == SAID
    (none,) = following(campaign, answer(True), True)
    assert none.words == "No planned test reads a sensor that exists: none can be proposed."
    assert not list(following(campaign, answer(False, SETS[:1]), True))
