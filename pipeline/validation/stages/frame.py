"""The parallelogram as a frame of beams whose rigidities are those identified from the solid bar."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi, radians, sqrt

import numpy as np

from fem.frame.bench import NAMES, Readings, Trial, run
from fem.frame.errors import Errors
from fem.frame.linkages import ELEMENTS
from fem.frame.rig import Rig
from fem.frame.section import Plane, Section, section_of
from meshes.solid import Floats
from pipeline.validation.stages.linkage import LENGTH_TO_BOW
from pipeline.validation.stages.subject import Sized, SolidBar


def section_of_bar(s: SolidBar, stiffness: Floats) -> Section:
    """The beam of a bar: its K_b (6, 6), and the shear stiffness of its section between the lugs."""
    body = s.segments[len(s.segments) // 2]
    return identified_section(stiffness, s.bar.length, body.GAy, body.GAz)


def identified_section(stiffness: Floats, length: float, GAy: float, GAz: float) -> Section:
    """The beam that has this K_b (6, 6) at its tip and these shear stiffnesses, N: EA, GJ, both EI and its stiff ends.

    K_b alone cannot tell shear from stiff ends: both change the spread of the flexibility, in opposite senses. With
    GA from the section the flexible length f follows from the spread, f²/12 times the amount plus L / GA. Raises
    ValueError for a K_b that is stiffer than shear lets it be.
    """
    plain = section_of(stiffness, length)
    k = stiffness
    about_y = stiff_ended(k[2, 2], k[2, 4], k[4, 4], length, GAz)
    return Section(plain.EA, plain.GJ, about_y, stiff_ended(k[1, 1], -k[1, 5], k[5, 5], length, GAy))


def stiff_ended(push: float, mixed: float, turn: float, length: float, GA: float) -> Plane:
    """Bending in one plane from its three entries of K_b and its shear stiffness."""
    from_tip = mixed / push
    amount, spread = 1.0 / (turn - mixed**2 / push), 1.0 / push
    if not spread > length / GA:
        raise ValueError(f"K_b is stiffer than the shear of a section of GA = {GA:g} N lets it be")
    flexible = sqrt(12.0 * (spread - length / GA) / amount)
    base, tip = length - from_tip - flexible / 2.0, from_tip - flexible / 2.0
    return Plane(float(flexible / amount), GA, float(base / length), float(tip / length))


@dataclass(frozen=True, eq=False)
class FrameLinkage:
    """The frame of a case with bars of this section, whose K_b (6, 6) is `stiffness`, at an angle, held in a way; its
    bars are bowed in this `plane`."""

    case: Sized
    section: Section
    stiffness: Floats
    q_deg: float
    held: Sequence[str]
    plane: str

    def path(self, x: Sequence[float] | Floats, elements: int = ELEMENTS) -> tuple[Floats, Floats, str]:
        """x mm and Fx N at the platform displacements that were reached, and why not all of them were, or ""."""
        readings = self.followed(x, elements)
        good = readings.converged
        failure = next((r for r in readings.reason if r), "")
        return readings.displacement[good, 0], readings.wrench[good, 0], failure

    def followed(self, x: Sequence[float] | Floats, elements: int) -> Readings:
        """The history in x, from no load on."""
        size = self.case.linkage
        rig = Rig("parallelogram", size.length_mm, self.section, size.width_mm)
        control = tuple("displacement" if n in ("x", *self.held) else "force" for n in NAMES)
        values = np.zeros((len(x), 6))
        values[:, 0] = x
        trial = Trial(radians(self.q_deg), control, values)
        return run(rig, Errors.of(self.imperfection), [trial], elements=elements)[0]

    @property
    def imperfection(self) -> dict[str, float]:
        """What sways the frame as the solid's bow e in the shape of its lowest mode does, to first order.

        In the linkage's plane the bars are pinned, and that shape is the frame's half sine. Out of it, platform
        fully held, the half sine's part in the mode (1 - cos 2πx/L)/2 is 8/(3π) of its size. Else a force at the
        platform: at the critical load a bow e acts as the force that moves the unloaded tips by e.
        """
        bow = self.case.linkage.length_mm / LENGTH_TO_BOW
        if self.plane == "xz":
            return {"bar_initial_bow.bow_z_mm": bow}
        if "y" in self.held:
            return {"bar_initial_bow.bow_y_mm": 3 * pi / 8 * bow}
        k = self.stiffness
        sideways = k[1, 1] if "rz" in self.held else k[1, 1] - k[1, 5] ** 2 / k[5, 5]
        return {"self_weight.fy_N": 2.0 * float(sideways) * bow}
