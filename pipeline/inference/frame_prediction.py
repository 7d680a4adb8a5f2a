"""FEA: what finite elements of the rig as drawn predict, driven with the measured inputs."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fem.frame import bench
from fem.frame.errors import Errors
from fem.frame.history import AFTER_FAILURE
from fem.frame.newton import REASONS, SINGULAR
from fem.frame.rig import Gauge as FrameGauge
from pipeline.campaign.names import DISPLACEMENT, SUPPORT
from pipeline.inference.manipulator_linear import by_frame, predict_constant
from pipeline.inference.prediction import Prediction, moved_along, no_slides, no_stops, zeroed
from pipeline.inference.program import INPUTS, Program
from pipeline.virtual.bench import frame_rig
from vjm.reasons import Reason

_SAID = {AFTER_FAILURE: Reason.ENDED, REASONS[SINGULAR]: Reason.NOT_HELD}
"""What the frame says, in the words of all models; the rest is its solver's affair."""


Array = NDArray[np.float64]


def predict_frame(program: Program, tangent: Prediction, shift: Array | None = None) -> Prediction:
    """Readings of geometrically exact frame elements without any error of the bench.

    tangent: of another model of the same rig, in whose place the frame has none of its own. shift: (R, 7) added to
    the measured inputs. ValueError for a rig that the frame refuses. `states` is
    empty. Of a whole manipulator the frame is linear, at rest.
    """
    campaign = program.campaign
    moved = np.zeros((len(program.test), INPUTS)) if shift is None else shift
    if campaign.rig.manipulator is not None:
        return moved_along(predict_constant(program, by_frame), moved)
    trials = [
        bench.Trial(
            test.q,
            tuple(DISPLACEMENT if by == SUPPORT else by for by in test.control),
            test.inputs(campaign.gauges) + moved[program.test == number, :6],
            None,
            None if test.rig is campaign.rig else frame_rig(test.rig),
        )
        for number, test in enumerate(campaign.tests)
    ]
    sights = [FrameGauge(g.name, g.bar, g.station, g.vector, g.offset) for g in campaign.gauges]
    found = bench.run(frame_rig(campaign.rig), Errors(), trials, sights)
    values = np.concatenate([np.hstack([r.displacement, r.wrench, r.gauges]) for r in found])
    converged = np.concatenate([r.converged for r in found])
    buckled = np.concatenate([r.negative for r in found]) > 0
    said = [reason for r in found for reason in r.reason]
    lost = ~converged | buckled
    reasons: dict[int, str] = {
        int(k): Reason.UNSTABLE if converged[k] else _SAID.get(said[k], Reason.NOT_CONVERGED)
        for k in np.flatnonzero(lost)
    }
    plain = Prediction(
        np.where(lost[:, None], 0.0, values),
        tangent.by_inputs,
        np.zeros((*values.shape, 0)),
        moved,
        no_stops(len(values)),
        no_slides(len(values)),
        lost,
        reasons,
        (),
    )
    return zeroed(plain, program)
