"""Why a load case has no answer: each reason is one sentence, the same in all models and commands."""

from __future__ import annotations

from enum import StrEnum


class Reason(StrEnum):
    """Why there is no prediction.

    NOT_CONVERGED says something of the solver alone. UNSTABLE and NO_EQUILIBRIUM are statements about the linkage: it
    would move away from every equilibrium that was found, or the load is more than any state carries.
    """

    NOT_CONVERGED = "the solver did not converge"
    UNSTABLE = "the model has no stable equilibrium under these controls"
    NO_EQUILIBRIUM = "no equilibrium exists: the load is more than the model carries under these controls"
    NOT_HELD = "nothing holds the linkage under these controls, so it has no answer to a load"
    ENDED = "an earlier step of the test has no equilibrium, so what the laws remember is not known"

    @classmethod
    def of(cls, said: str) -> Reason:
        """The reason with which a longer sentence begins; what begins with none is the solver's affair."""
        return next((each for each in cls if said.startswith(each)), cls.NOT_CONVERGED)
