"""Spring laws as data: force and tangent of a group of coordinates, with memory where the past matters.

A law acts on the strain of its group, the coordinates less their rest values. Arrays carry leading batch axes:
strain (..., k), force (..., k), tangent (..., k, k), memory (..., m). Laws of one chain add up.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np

from vjm.frames import Array


@dataclass(frozen=True, eq=False)
class Response:
    """Answer of a law to a strain.

    energy: (...) stored, N·mm. force: (..., k) its gradient, for a law without memory. tangent: (..., k, k)
    derivative of the force. memory: (..., m) what the law remembers once the step is accepted.
    """

    energy: Array
    force: Array
    tangent: Array
    memory: Array


class Law(Protocol):
    """Force of a group of coordinates as a function of strain and memory.

    initial_memory: (m,) before any load; empty where the past does not matter.
    respond: takes strain (..., k) and the memory (..., m) at the start of the step.
    """

    @property
    def initial_memory(self) -> Array: ...

    def respond(self, strain: Array, memory: Array) -> Response: ...


@runtime_checkable
class Direct(Protocol):
    """A law whose force (..., k) is to be had alone, at less cost than the whole `Response`."""

    def force(self, strain: Array, memory: Array) -> Array: ...


@dataclass(frozen=True, eq=False)
class Spring:
    """A law on the coordinates of a chain with these numbers, passive or virtual."""

    coordinates: tuple[int, ...]
    law: Law


@dataclass(frozen=True, eq=False)
class Linear:
    """force = K strain, K (k, k) symmetric; N, mm, rad."""

    stiffness: Array

    @property
    def initial_memory(self) -> Array:
        return np.zeros(0)

    def respond(self, strain: Array, memory: Array) -> Response:
        force = strain @ self.stiffness
        tangent = np.broadcast_to(self.stiffness, (*strain.shape, strain.shape[-1]))
        return Response(0.5 * np.sum(strain * force, axis=-1), force, tangent, memory)


@dataclass(frozen=True, eq=False)
class Polynomial:
    """Scalar law force = sum of coefficients[i] strain^(i + 1); positive slope at zero not required."""

    coefficients: tuple[float, ...]

    @property
    def initial_memory(self) -> Array:
        return np.zeros(0)

    def respond(self, strain: Array, memory: Array) -> Response:
        force = np.polynomial.Polynomial([0.0, *self.coefficients])
        energy = force.integ()(strain[..., 0])
        return Response(energy, force(strain), force.deriv()(strain)[..., None], memory)


@dataclass(frozen=True, eq=False)
class OnSum:
    """A scalar law of the sum of shares (k,) x strains: each coordinate carries the force by its share."""

    law: Law
    shares: tuple[float, ...]

    @property
    def initial_memory(self) -> Array:
        return self.law.initial_memory

    def respond(self, strain: Array, memory: Array) -> Response:
        shares = np.array(self.shares)
        answer = self.law.respond((strain @ shares)[..., None], memory)
        tangent = answer.tangent * shares[:, None] * shares
        return Response(answer.energy, answer.force * shares, tangent, answer.memory)


@dataclass(frozen=True, eq=False)
class BeamColumn:
    """Geometric nonlinearity of bar segments, on top of their linear springs K.

    stiffness: (n, 6, 6) K of each segment for (extension, two shifts, three rotations). curvature, softening:
    (n, 6) diagonals of G and G'. The group holds the six coordinates of each segment, n times six.
    Bending shortens a segment by h = theta^T G theta / 2, and a bent one yields g = theta^T G' theta / 2 per
    unit of tension. With k = K e_1 the tension is P = (k·theta + K11 h) / (1 + K11 g), and the energy beyond
    theta^T K theta / 2 is h k·theta + K11 h²/2 - (1 + K11 g) g P²/2: that of eps^T K eps / 2, eps = theta with
    the extension theta_1 + h, which the yielding g relieves. It has no part below the third order, so K is
    what a small load sees. G' = 0 is the bar of T. von Kármán, "Festigkeitsprobleme im Maschinenbau", 1910.
    coupling: (n, 2) b of the energy phi_x (b_y phi_y s_y + b_z phi_z s_z), twist against bending. Each term is
    completed to a square with the stiffness of its s, which adds the fourth-order part that keeps the energy
    positive where a flat bar is bent far about its weak axis.
    shape: (n, 6) coordinates of the unloaded bar where it is not straight: h and g are those of shape + theta,
    h less what it is unloaded.
    """

    stiffness: Array
    curvature: Array
    softening: Array
    coupling: Array
    shape: Array

    @property
    def initial_memory(self) -> Array:
        return np.zeros(0)

    def respond(self, strain: Array, memory: Array) -> Response:
        block = np.zeros((*strain.shape[:-1], len(self.stiffness), 6, 6))
        energy, force = self._answer(strain, block)
        return Response(energy, force, block_diagonal(block), memory)

    def force(self, strain: Array, memory: Array) -> Array:
        """(..., k) without what a tangent costs."""
        return self._answer(strain, None)[1]

    def _answer(self, strain: Array, block: Array | None) -> tuple[Array, Array]:
        """Energy (...) and force (..., k); adds second derivatives to the block (..., n, 6, 6) of each segment."""
        theta = strain.reshape(*strain.shape[:-1], -1, 6)
        k, axial = self.stiffness[:, :, 0], self.stiffness[:, 0, 0]
        whole = theta + self.shape
        bow, give = self.curvature * whole, self.softening * whole
        h = 0.5 * np.sum(theta * (bow + self.curvature * self.shape), axis=-1)
        g = 0.5 * np.sum(whole * give, axis=-1)
        linear = np.sum(k * theta, axis=-1)
        ease = 1.0 + axial * g
        tension = (linear + axial * h) / ease
        relief = tension * g
        slope = k + axial[:, None] * bow
        force = h[..., None] * k + (tension * ease)[..., None] * bow
        force -= relief[..., None] * slope + 0.5 * (tension**2)[..., None] * give
        energy = h * linear + 0.5 * axial * h * h - 0.5 * ease * g * tension**2
        if block is not None:
            block += self._tangent(bow, give, slope, ease, tension, g)
        for coupling, triple in zip(self.coupling.T, _TWISTED, strict=True):
            energy += self._twist(coupling, triple, theta, force, block)
        return np.asarray(np.sum(energy, axis=-1)), force.reshape(strain.shape)

    def _twist(
        self, b: Array, triple: tuple[int, int, int], theta: Array, force: Array, block: Array | None
    ) -> Array:
        """Energy (..., n) of b phi_x phi s completed to a square; adds to force and, where there is one, to tangent."""
        x, turn, shift = triple
        fourth = b * b / self.stiffness[:, shift, shift]
        for i, j, k in (triple, (turn, shift, x), (shift, x, turn)):
            force[..., i] += b * theta[..., j] * theta[..., k]
        for i, j in ((x, turn), (turn, x)):
            force[..., i] += fourth * theta[..., i] * theta[..., j] ** 2
        if block is not None:
            for i, j, k in (triple, (turn, shift, x), (shift, x, turn)):
                block[..., j, k] += b * theta[..., i]
                block[..., k, j] += b * theta[..., i]
            for i, j in ((x, turn), (turn, x)):
                block[..., i, i] += fourth * theta[..., j] ** 2
                block[..., i, j] += 2.0 * fourth * theta[..., i] * theta[..., j]
        product = theta[..., x] * theta[..., turn]
        return np.asarray(b * product * theta[..., shift] + 0.5 * fourth * product**2)

    def _tangent(self, bow: Array, give: Array, slope: Array, ease: Array, tension: Array, g: Array) -> Array:
        """Second derivative of the energy, (..., n, 6, 6)."""
        k, axial = self.stiffness[:, :, 0], self.stiffness[:, 0, 0]
        # k b^T + b k^T + K11 b b^T is the difference of two squares, slope slope^T - k k^T over K11.
        change = give * (tension / ease)[..., None]
        block = _square(slope, (1.0 / axial - g / ease)) - _square(k, 1.0 / axial)
        mixed = slope[..., :, None] * change[..., None, :]
        block -= mixed + np.swapaxes(mixed, -1, -2)
        block += _square(change, axial * ease)
        diagonal = np.arange(6)
        block[..., diagonal, diagonal] += tension[..., None] * self.curvature
        block[..., diagonal, diagonal] -= 0.5 * (tension**2)[..., None] * self.softening
        return block


# phi_x, phi_y, s_y and phi_x, phi_z, s_z among the coordinates of a segment.
_TWISTED = ((3, 4, 1), (3, 5, 2))


def _square(v: Array, factor: Array) -> Array:
    return (factor[..., None] * v)[..., :, None] * v[..., None, :]


def block_diagonal(blocks: Array) -> Array:
    """(..., n, k, k) as (..., n k, n k)."""
    n, k = blocks.shape[-3], blocks.shape[-1]
    full = np.zeros((*blocks.shape[:-3], n * k, n * k))
    for i in range(n):
        part = slice(i * k, (i + 1) * k)
        full[..., part, part] = blocks[..., i, :, :]
    return full
