"""Compiled energy, force and tangent of bent bar segments; the formulas are those of `vjm.laws.BeamColumn`."""

from __future__ import annotations

import numpy as np

from vjm.compiled import compiled
from vjm.frames import Array

TWIST, TURNS, SHIFTS = 3, (4, 5), (1, 2)
"""Numbers of phi_x, of phi_y and phi_z and of s_y and s_z among the coordinates of a segment."""


@compiled
def bend(
    stiffness: Array,
    curvature: Array,
    softening: Array,
    coupling: Array,
    shape: Array,
    theta: Array,
    energy: Array,
    force: Array,
    columns: np.ndarray,
    matrix: Array,
) -> None:
    """Of n segments at strains theta (B, 6 n): energy (B,), force (B, 6 n), and their tangent added to the matrix
    (B, ., .) at the rows and columns (6 n,), unless it is empty.

    stiffness (n, 6, 6), curvature, softening, shape (n, 6), coupling (n, 2): as of `BeamColumn`.
    """
    bow, give, slope, change, block = np.empty(6), np.empty(6), np.empty(6), np.empty(6), np.empty((6, 6))
    for b in range(theta.shape[0]):
        energy[b] = 0.0
        for s in range(stiffness.shape[0]):
            k, axial, start = stiffness[s, 0], stiffness[s, 0, 0], 6 * s
            own, felt = theta[b, start : start + 6], force[b, start : start + 6]
            h = g = linear = 0.0
            for i in range(6):
                whole = own[i] + shape[s, i]
                bow[i], give[i] = curvature[s, i] * whole, softening[s, i] * whole
                h += 0.5 * own[i] * (bow[i] + curvature[s, i] * shape[s, i])
                g += 0.5 * whole * give[i]
                linear += k[i] * own[i]
            ease = 1.0 + axial * g
            tension = (linear + axial * h) / ease
            energy[b] += h * linear + 0.5 * axial * h * h - 0.5 * ease * g * tension**2
            for i in range(6):
                slope[i], change[i] = k[i] + axial * bow[i], give[i] * (tension / ease)
                felt[i] = h * k[i] + tension * ease * bow[i] - tension * g * slope[i]
                felt[i] -= 0.5 * tension**2 * give[i]
            energy[b] += _twist(stiffness[s], coupling[s], own, felt)
            if matrix.size:
                _tangent(k, g / ease, axial * ease, bow, slope, change, block)
                for i in range(6):
                    block[i, i] += tension * curvature[s, i] - 0.5 * tension**2 * softening[s, i]
                _twisted(stiffness[s], coupling[s], own, block)
                for i in range(6):
                    row = matrix[b, columns[start + i]]
                    for j in range(6):
                        row[columns[start + j]] += block[i, j]


@compiled
def _tangent(
    k: Array, eased: float, stiff: float, bow: Array, slope: Array, change: Array, block: Array
) -> None:
    """The part of the tension in the second derivative (6, 6) of a segment's energy."""
    for i in range(6):
        for j in range(6):
            # K11 b b^T + k b^T + b k^T, of which slope slope^T / K11 is the square.
            entry = k[i] * bow[j] + bow[i] * k[j] + k[0] * bow[i] * bow[j] - eased * slope[i] * slope[j]
            entry -= slope[i] * change[j] + change[i] * slope[j]
            block[i, j] = entry + stiff * change[i] * change[j]


@compiled
def _twist(stiffness: Array, coupling: Array, theta: Array, force: Array) -> float:
    """Energy of b phi_x phi s completed to a square, in both planes; its force is added."""
    energy = 0.0
    for plane in range(2):
        b, turn, shift = coupling[plane], theta[TURNS[plane]], theta[SHIFTS[plane]]
        fourth, product = b * b / stiffness[SHIFTS[plane], SHIFTS[plane]], theta[TWIST] * turn
        force[TWIST] += b * turn * shift + fourth * product * turn
        force[TURNS[plane]] += b * theta[TWIST] * shift + fourth * product * theta[TWIST]
        force[SHIFTS[plane]] += b * product
        energy += b * product * shift + 0.5 * fourth * product**2
    return energy


@compiled
def _twisted(stiffness: Array, coupling: Array, theta: Array, block: Array) -> None:
    """Add the second derivative (6, 6) of that energy."""
    for plane in range(2):
        b, i, j = coupling[plane], TURNS[plane], SHIFTS[plane]
        twist, turn, fourth = theta[TWIST], theta[i], b * b / stiffness[j, j]
        both = b * theta[j] + 2.0 * fourth * twist * turn
        block[TWIST, i] += both
        block[i, TWIST] += both
        block[TWIST, j] += b * turn
        block[j, TWIST] += b * turn
        block[i, j] += b * twist
        block[j, i] += b * twist
        block[TWIST, TWIST] += fourth * turn**2
        block[i, i] += fourth * twist**2
