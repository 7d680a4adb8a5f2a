"""Sparsity of a symmetric matrix over nodes with three unknowns each, and its sums over cells."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from meshes.solid import Floats, Ints


@dataclass(frozen=True, eq=False)
class SymmetricPattern:
    """Where the 3x3 block of every pair of nodes of a cell goes.

    slots    : (m, p) number of the block that a cell's pair of nodes adds to; pairs (i, j), i <= j, in the order
               of `numpy.triu_indices`
    count    : number of different blocks, those on and above the diagonal
    source   : (nnz,) entry of the (count, 9) blocks that stands at each place of the full matrix
    indices, indptr : the full matrix's compressed rows
    """

    slots: Ints
    count: int
    source: Ints
    indices: Ints
    indptr: Ints

    @staticmethod
    def of(connectivity: Ints, nodes: int) -> "SymmetricPattern":
        """Pattern for cells (m, k) over `nodes` nodes; the nodes of every cell in rising order."""
        first, second = np.triu_indices(connectivity.shape[1])
        keys = (connectivity[:, first] * nodes + connectivity[:, second]).ravel()
        order = np.argsort(keys)
        ordered = keys[order]
        new = np.concatenate(([True], ordered[1:] != ordered[:-1]))
        slots = np.empty(len(keys), dtype=np.int64)
        slots[order] = np.cumsum(new) - 1
        rows, columns = np.divmod(ordered[new], nodes)
        full = full_blocks(rows, columns, nodes)
        return SymmetricPattern(
            slots.reshape(len(connectivity), -1), len(rows), full.data, full.indices, full.indptr
        )

    def summed(self, cells: slice, pairs: Floats) -> Floats:
        """(count, c) sums of the values (m, p, c) that `cells` give to their pairs."""
        slots = self.slots[cells].ravel()
        columns = np.arange(len(slots) + 1)
        sums = sp.csc_matrix((np.ones(len(slots)), slots, columns), shape=(self.count, len(slots)))
        return np.asarray(sums @ pairs.reshape(len(slots), -1))

    def matrix(self, blocks: Floats) -> sp.csr_matrix:
        """The full matrix of the blocks (count, 3, 3) on and above the diagonal; exactly symmetric off it."""
        size = len(self.indptr) - 1
        return sp.csr_matrix((blocks.reshape(-1)[self.source], self.indices, self.indptr), shape=(size, size))

    @cached_property
    def of_nodes(self) -> tuple[Ints, Ints, Ints]:
        """Compressed rows over nodes: the block's number at each place, columns, starts of rows."""
        counts = np.diff(self.indptr)
        first = np.repeat(np.arange(len(counts)) % 3 == 0, counts) & (self.indices % 3 == 0)
        starts = np.concatenate(([0], np.cumsum(counts[::3] // 3)))
        return self.source[first] // 9, self.indices[first] // 3, starts

    def nodal(self, values: Floats) -> sp.csr_matrix:
        """The symmetric matrix over nodes of the values (count,) of pairs."""
        number, columns, starts = self.of_nodes
        nodes = len(starts) - 1
        return sp.csr_matrix((values[number], columns, starts), shape=(nodes, nodes))


def full_blocks(rows: Ints, columns: Ints, nodes: int) -> sp.csr_matrix:
    """Of the blocks at (rows, columns), upper and sorted by rows, the number of each entry in the full matrix."""
    numbers = np.arange(9 * len(rows), dtype=np.int32).reshape(-1, 3, 3)
    off = np.flatnonzero(rows != columns)
    keys = np.concatenate((rows * nodes + columns, columns[off] * nodes + rows[off]))
    order = np.argsort(keys)
    blocks = np.concatenate((numbers, numbers[off].transpose(0, 2, 1)))[order]
    full_rows, full_columns = np.divmod(keys[order], nodes)
    indptr = np.searchsorted(full_rows, np.arange(nodes + 1))
    parts = (blocks, full_columns.astype(np.int32), indptr.astype(np.int32))
    return sp.bsr_matrix(parts, shape=(3 * nodes, 3 * nodes)).tocsr()
