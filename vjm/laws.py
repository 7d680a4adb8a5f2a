"""Spring laws as data: force and tangent of a group of coordinates, with memory where the past matters.

A law acts on the strain of its group, the coordinates less their rest values. Arrays carry leading batch axes:
strain (..., k), force (..., k), tangent (..., k, k), memory (..., m). Laws of one chain add up.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from vjm.bending import bend
from vjm.frames import Array, flat


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


class Adding(ABC):
    """A law that is quicker without the whole `Response`: it returns its force (..., k) and adds its tangent to a
    matrix of more coordinates, (..., M, M) and contiguous, at its rows and columns (k,), unless that is empty."""

    @abstractmethod
    def add(self, strain: Array, memory: Array, columns: np.ndarray, matrix: Array) -> Array:
        """(..., k) at a strain (..., k) and memory (..., m)."""


@dataclass(frozen=True, eq=False)
class Spring:
    """A law on the coordinates of a chain with these numbers, passive or virtual."""

    coordinates: tuple[int, ...]
    law: Law


class Elastic:
    """A law for which the past does not matter."""

    @property
    def initial_memory(self) -> Array:
        return np.zeros(0)


@dataclass(frozen=True, eq=False)
class Linear(Elastic):
    """force = K strain, K (k, k) symmetric; N, mm, rad."""

    stiffness: Array

    def respond(self, strain: Array, memory: Array) -> Response:
        force = strain @ self.stiffness
        tangent = np.broadcast_to(self.stiffness, (*strain.shape, strain.shape[-1]))
        return Response(0.5 * np.sum(strain * force, axis=-1), force, tangent, memory)


@dataclass(frozen=True, eq=False)
class Polynomial(Elastic):
    """Scalar law force = sum of coefficients[i] strain^(i + 1); positive slope at zero not required."""

    coefficients: tuple[float, ...]

    def respond(self, strain: Array, memory: Array) -> Response:
        force = np.polynomial.Polynomial([0.0, *self.coefficients])
        energy = force.integ()(strain[..., 0])
        return Response(energy, force(strain), force.deriv()(strain)[..., None], memory)


@dataclass(frozen=True, eq=False)
class Around:
    """What acts by a law inside it, and remembers what that does."""

    law: Law

    @property
    def initial_memory(self) -> Array:
        return self.law.initial_memory


@dataclass(frozen=True, eq=False)
class OnSum(Around):
    """A scalar law of the sum of shares (k,) x strains: each coordinate carries the force by its share."""

    shares: tuple[float, ...]

    def respond(self, strain: Array, memory: Array) -> Response:
        shares = np.array(self.shares)
        answer = self.law.respond((strain @ shares)[..., None], memory)
        tangent = answer.tangent * shares[:, None] * shares
        return Response(answer.energy, answer.force * shares, tangent, answer.memory)


@dataclass(frozen=True, eq=False)
class BeamColumn(Elastic, Adding):
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

    def respond(self, strain: Array, memory: Array) -> Response:
        tangent = np.zeros((*strain.shape, strain.shape[-1]))
        energy, force = self._bent(strain, np.arange(strain.shape[-1]), tangent)
        return Response(energy, force, tangent, memory)

    def add(self, strain: Array, memory: Array, columns: np.ndarray, matrix: Array) -> Array:
        """(..., k), and the tangent added to the matrix."""
        return self._bent(strain, columns, matrix)[1]

    @cached_property
    def _numbers(self) -> tuple[Array, Array, Array, Array, Array]:
        stiffness, curvature = np.ascontiguousarray(self.stiffness), np.ascontiguousarray(self.curvature)
        softening, coupling = np.ascontiguousarray(self.softening), np.ascontiguousarray(self.coupling)
        return stiffness, curvature, softening, coupling, np.ascontiguousarray(self.shape)

    def _bent(self, strain: Array, columns: np.ndarray, matrix: Array) -> tuple[Array, Array]:
        """Energy (...) and force (..., k); the tangent is added unless the matrix is empty."""
        theta = flat(strain)
        energy, force = np.empty(len(theta)), np.empty(theta.shape)
        matrices = matrix.reshape(len(theta) if matrix.size else 0, *matrix.shape[-2:])
        bend(*self._numbers, theta, energy, force, columns, matrices)
        return energy.reshape(strain.shape[:-1]), force.reshape(strain.shape)


def block_diagonal(blocks: Array) -> Array:
    """(..., n, k, k) as (..., n k, n k)."""
    n, k = blocks.shape[-3], blocks.shape[-1]
    full = np.zeros((*blocks.shape[:-3], n * k, n * k))
    for i in range(n):
        part = slice(i * k, (i + 1) * k)
        full[..., part, part] = blocks[..., i, :, :]
    return full
