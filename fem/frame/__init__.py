"""Geometrically nonlinear frames of beams, rigid bodies and joints: the finite-element truth of a virtual bench.

Co-rotational two-node beams measured in the mean frame of their two ends, with second-order (shallow-arch) strains;
joints as chains of one-dimensional coordinates with laws; many independent histories solved in one batch.
"""
