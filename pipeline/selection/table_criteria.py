"""Thresholds by which something is wrong with a table: single bad readings, and mistakes of all of it."""

from __future__ import annotations

from dataclasses import dataclass

from pipeline.selection.criterion import CHI2, COUNT, FACTOR, SHARE, SIGMA, criterion


@dataclass(frozen=True)
class TableCriteria:
    """A part of the record of all criteria."""

    bad_neighbours: float = criterion(
        3.5,
        SIGMA,
        "bad readings",
        "a single bad reading has neighbours in its channel that are off by less",
    )
    bad_rest: float = criterion(
        0.2,
        SHARE,
        "bad readings",
        "of a single bad reading, below which all others of its row have to be once it is explained",
    )
    bad_share: float = criterion(
        0.02, SHARE, "bad readings", "of all readings, at most, that are set aside as single bad ones"
    )
    bad_seen: float = criterion(
        0.1,
        SHARE,
        "bad readings",
        "of what an error of a reading does, that a fit does not follow: of less nothing is said, it is wherever the "
        "reading is",
    )
    reading_rounds: int = criterion(
        4, COUNT, "bad readings", "searches after which what is found of the readings stays as it is"
    )
    doctor_plain: float = criterion(
        20.0,
        SIGMA,
        "doctor",
        "from which a reading is plainly no noise: so far from zero a column begins whose zero is asked about, and "
        "so large are those beside which a decimal point slipped",
    )
    doctor_apart: float = criterion(
        2.5,
        FACTOR,
        "doctor",
        "the largest of the other readings of its test, from which one stands out as if its decimal point had "
        "slipped: the last of a ramp of four steps is 1.3 times the one before",
    )
    doctor_factor: float = criterion(
        2.5,
        FACTOR,
        "doctor",
        "by which what the best single effect leaves falls where a mistake of the table is mended: forces in kgf take "
        "3.7 to 5.4, benches without a mistake 1.3",
    )
    doctor_readings: int = criterion(
        4, COUNT, "doctor", "degrees of freedom from which mistakes of a table are looked for"
    )
    doctor_explains: float = criterion(
        25.0, CHI2, "doctor", "of a reading in a column that is mended, at least: less may be silence"
    )
    doctor_tie: float = criterion(
        25.0,
        CHI2,
        "doctor",
        "within which two mistakes are told together, of noise; of what is left where it is more",
    )
    doctor_look: float = criterion(
        1.8, FACTOR, "doctor", "by which what is left has to fall to first order for a mistake to be fitted"
    )
    doctor_sure: float = criterion(
        25.0, FACTOR, "doctor", "the same to first order, from which the table as it is need not be fitted"
    )
    doctor_follows: float = criterion(
        25.0,
        FACTOR,
        "doctor",
        "by which more is left with zeros in the columns that a mistake prescribes, for one that makes them smaller "
        "not to silence them",
    )
    doctor_fitted: int = criterion(4, COUNT, "doctor", "mistakes that are fitted, those that promise most")
    doctor_steps: int = criterion(100, COUNT, "doctor", "load steps in which mistakes are looked for")
    doctor_far: float = criterion(
        4.0, FACTOR, "doctor", "what a mistake leaves, beyond which another one is no tie of it"
    )
    doctor_effects: int = criterion(2, COUNT, "doctor", "single effects that are fitted on either side")
