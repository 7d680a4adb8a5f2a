"""The thresholds by which a law beyond the catalogue is proposed, and competes with a set of effects."""

from __future__ import annotations

from dataclasses import dataclass

from pipeline.selection.criterion import CHI2, COUNT, EVIDENCE, FACTOR, SHARE, SIGMA, criterion

GROUP = "laws"


@dataclass(frozen=True)
class LawCriteria:
    """Those of `pipeline.discover`; a part of the record of all criteria."""

    law_proposed: float = criterion(
        12.0,
        EVIDENCE,
        GROUP,
        "from which a place is proposed: of 16 000 white residuals without a law 99 % stay below 5.6, none is above "
        "9.8",
        "own simulation",
    )
    law_left_out: float = criterion(
        8.0,
        CHI2,
        GROUP,
        "that tests which were left out gain at least, without the best of them, by what the others foresee",
    )
    law_alike: float = criterion(
        10.0,
        EVIDENCE,
        GROUP,
        "evidence of a place, or cost of a form, within which two are not told apart: a factor of 150 and more in "
        "their probability",
    )
    law_alike_share: float = criterion(
        0.01,
        SHARE,
        GROUP,
        "of the evidence, within which two places are not told apart either: it goes with the square of what is "
        "explained, so that influences which are some parts in a hundred off take so much off it",
    )
    law_few_tests: int = criterion(
        3, COUNT, GROUP, "tests that see a place, below which blocks of the histories are left out instead"
    )
    law_blocks: int = criterion(4, COUNT, GROUP, "into which a history is parted then")
    law_preferred: float = criterion(
        3.0,
        CHI2,
        GROUP,
        "cost by which a form that grows as a power is to be better than one that does not, and one that grows as an "
        "exponential than a power: less is not worth more than a bare mention",
        "R. E. Kass, A. E. Raftery, Journal of the American Statistical Association 90 (1995) 773-795",
    )
    law_named: float = criterion(
        6.0,
        CHI2,
        GROUP,
        "cost by which one effect is to be better than a law to keep its name alone: less is no strong evidence",
        "R. E. Kass, A. E. Raftery, Journal of the American Statistical Association 90 (1995) 773-795",
    )
    law_rounds: int = criterion(3, COUNT, GROUP, "times that single bad readings are looked for, at most")
    laws_at_most: int = criterion(3, COUNT, GROUP, "that are looked for one after another")
    law_forms: int = criterion(5, COUNT, GROUP, "that are fitted through the mechanism, at most")
    law_forms_near: float = criterion(
        25.0,
        CHI2,
        GROUP,
        "cost above the best form's, up to which another one is fitted through the mechanism: where influences are "
        "known costs are off by some units, as coordinates are those of the model before",
    )
    law_beyond: float = criterion(
        1.5, FACTOR, GROUP, "the largest coordinate, where forms that are as good are compared"
    )
    law_unknown_beyond: float = criterion(
        0.3, SIGMA, GROUP, "by which they may differ there before it is said"
    )
    law_several: int = criterion(
        2,
        COUNT,
        GROUP,
        "effects with numbers from which a set pays for all of them and is not named against laws that explain as "
        "much: one alone pays for those that it needs and keeps its name where it is better by `law_named`",
    )
    law_left_by_set: float = criterion(
        4.0,
        EVIDENCE,
        GROUP,
        "of a function beside a set of effects, from which a law may be better than the set by what tells them apart: "
        "twice that of chi-square, and some more for what a form needs no prior of",
    )
    law_gains: float = criterion(
        1.2,
        FACTOR,
        GROUP,
        "twice the evidence of a free function: so much less than what a law at its place gains of chi-square it may "
        "be, as influences are those of the model without it",
    )
    law_gains_more: float = criterion(
        40.0, CHI2, GROUP, "beside it, as a form pays no prior for its amplitude"
    )
