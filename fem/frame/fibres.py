"""Yielding of a bar's section: a grid of fibres that carries the section's EA, EIy and EIz, and yields one by one.

The grid is the product of one row of fibres across y and one across z, each from -c to +c (c: outermost fibre) with
Gauss-Lobatto weights of a rectangle, moved partly to the edges (flanges) or to the middle until Σ w c² is EI / EA.
The elastic part of the element is untouched; what yields is subtracted: at three Lobatto stations of each element
    ΔN = Σ EA w ε_p, ΔM_y = Σ EA w z ε_p, ΔM_z = -Σ EA w y ε_p.
An element with a rigid end yields over its flexible stretch, the shorter one of its two planes.
Source of the layered section: E. A. de Souza Neto, D. Peric, D. R. J. Owen, Computational Methods for Plasticity,
Wiley 2008; the law of a fibre is `plastic_strain`.
"""

from dataclasses import dataclass

import numpy as np

from fem.frame.local import Reference, add_planes
from meshes.solid import Floats

HARDENING = 0.01
"""Tangent modulus past yield over the elastic one: of the order of structural aluminium and steel at small strain."""
_H = HARDENING / (1.0 - HARDENING)
# Gauss-Lobatto rules on (-1, 1), weights of sum one.
_STATIONS, _STATION_WEIGHTS = np.array([-1.0, 0.0, 1.0]), np.array([1.0, 4.0, 1.0]) / 6.0
_A, _B = np.sqrt((15.0 - 2.0 * np.sqrt(15.0)) / 33.0), np.sqrt((15.0 + 2.0 * np.sqrt(15.0)) / 33.0)
_ROW = np.array([-1.0, -_B, -_A, 0.0, _A, _B, 1.0])
_WA, _WB = (124.0 + 7.0 * np.sqrt(15.0)) / 700.0, (124.0 - 7.0 * np.sqrt(15.0)) / 700.0
_ROW_WEIGHTS = np.array([1 / 42, _WB, _WA, 128 / 525, _WA, _WB, 1 / 42])


@dataclass(frozen=True, eq=False)
class Fibres:
    """Fibres of each test: y, z (B, f) mm; weight (B, f) of sum one; limit (B,) yield strain, inf: elastic."""

    y: Floats
    z: Floats
    weight: Floats
    limit: Floats


def row(edge: float, radius: float) -> tuple[Floats, Floats]:
    """Places (7,) mm and weights (7,) of sum one with Σ w c² = radius², from -edge to edge.

    Raises ValueError unless 0 < radius < edge.
    """
    if not 0.0 < radius < edge:
        raise ValueError(
            f"the outermost fibre is at {edge:g} mm, allowed is more than the radius {radius:.3g} mm"
        )
    share = 3.0 * (radius / edge) ** 2
    lump = np.zeros(7)
    if share > 1.0:
        part = (share - 1.0) / 2.0
        lump[[0, 6]] = 0.5
    else:
        part = 1.0 - share
        lump[3] = 1.0
    return edge * _ROW, (1.0 - part) * _ROW_WEIGHTS + part * lump


def grid(edge_y: float, edge_z: float, EA: float, EIy: float, EIz: float) -> tuple[Floats, Floats, Floats]:
    """y, z mm and weights (49,) of a section's fibres. Raises ValueError where an edge is within the radius."""
    y, wy = row(edge_y, float(np.sqrt(EIz / EA)))
    z, wz = row(edge_z, float(np.sqrt(EIy / EA)))
    yy, zz = np.meshgrid(y, z, indexing="ij")
    return yy.ravel(), zz.ravel(), np.outer(wy, wz).ravel()


def curvatures(ref: Reference) -> Floats:
    """(..., 3, 2, 6) rates of the curvatures about y and z at three stations for the strains (l, β, φ)."""
    b = ref.bend
    # Rigidity EI of the flexible stretch: its amount is extent / EI, and det(bend) = 1 / (amount spread).
    amount = b[..., 1, 1] / (b[..., 0, 0] * b[..., 1, 1] - b[..., 0, 1] ** 2)
    rate = np.zeros((*ref.h.shape, 3, 2, 6))
    for s, station in enumerate(_STATIONS):
        arm = -0.5 * station * amount
        for plane in (0, 1):
            a = arm[..., plane]
            turn, slope = b[..., plane, 1, 0], b[..., plane, 1, 1] * ref.h
            rate[..., s, plane, 4 + plane] = 1.0 / ref.extent[..., plane] + a * turn
            rate[..., s, plane, 1 + plane] = a * slope
    return rate


def plastic_strain(strain: Floats, before: Floats, limit: Floats) -> tuple[Floats, Floats]:
    """A fibre that yields, linear elastic up to a strain, then linear kinematic hardening: new plastic strain and its
    derivative for the strain, from the plastic strain before; yield strain `limit`; all (...).

    Stress over E: s = ε - ε_p; yielding where |s - H ε_p| exceeds the yield strain, with H = r / (1 - r) and r the
    tangent over the elastic modulus. Closed-form return mapping.
    Source: J. C. Simo, T. J. R. Hughes, Computational Inelasticity, Springer 1998, section 1.4 (box 1.5).
    """
    trial = strain - before * (1.0 + _H)
    over = np.maximum(np.abs(trial) - limit, 0.0)
    new = before + np.sign(trial) * over / (1.0 + _H)
    return new, np.where(over > 0.0, 1.0 / (1.0 + _H), 0.0)


def yielded(
    fibres: Fibres, ref: Reference, before: Floats, strain: Floats, eps: Floats, rate: Floats
) -> tuple[Floats, Floats, Floats]:
    """What yielding takes from the elastic gradient (..., 6) and Hessian (..., 6, 6), and the new plastic strains.

    before (B, K, n, 3, f): plastic strains at the last equilibrium. strain, eps, rate: as `local.membrane` gives them.
    """
    kappa = curvatures(ref)
    slope = np.zeros_like(strain)
    slope[..., 1:3] = strain[..., 1:3] - ref.slope
    slope[..., 4:] = strain[..., 4:] - ref.turn[..., 1:]
    bent = (kappa @ slope[..., None, :, None])[..., 0]
    y, z = (a[:, None, None, None, :] for a in (fibres.y, fibres.z))
    total = eps[..., None, None] + z * bent[..., :1] - y * bent[..., 1:]
    new, tangent = plastic_strain(total, before, fibres.limit[:, None, None, None, None])
    # No more than what every strain has elastically: else the tangent would not stay positive.
    stretch = np.minimum(ref.h, ref.extent.min(-1))
    size = (ref.EA * stretch)[..., None, None] * _STATION_WEIGHTS[:, None]
    size = size * fibres.weight[:, None, None, None, :]
    arms = np.stack(np.broadcast_arrays(np.ones_like(y), z, -y), axis=-1)
    # Rates of the station's membrane strain and curvatures, (..., 3 stations, 3, 6).
    all_rates = np.concatenate((np.repeat(rate[..., None, None, :], 3, axis=-3), kappa), axis=-2)
    lost = ((size * new)[..., None, :] @ arms)[..., 0, :]
    gradient = (lost[..., None, :] @ all_rates)[..., 0, :].sum(-2)
    softer = np.swapaxes(arms, -1, -2) @ ((size * tangent)[..., None] * arms)
    hessian = (np.swapaxes(all_rates, -1, -2) @ softer @ all_rates).sum(-3)
    # The membrane strain's own curvature under the lost force.
    force = lost[..., 0].sum(-1)
    add_planes(hessian, force[..., None, None, None] * ref.string, ref.h)
    return gradient, hessian, new
