"""Where arithmetic ends: what anything is divided by at least, and what is rounding beside what it came from.

All but the first are relative, and powers of ten between the rounding of a double, 1.1e-16, and what a sensor tells.
"""

TINY = 1e-300
"""The least that is divided by, so that nothing over nothing is nothing: far below any quantity, above the smallest
normal double, 2.2e-308."""
ROUNDING = 1e-12
"""What sums of some thousand terms leave of zero, relative to the terms; bounds of a linear problem are apart by it."""
EQUAL = 1e-9
"""Of the largest: values, or singular values, that differ by less are the same."""
RANK = 1e-8
"""Singular value, of the columns at size 1, below which a direction is rounding."""
SQUARED = 1e-12
"""The same of an eigenvalue or a pivot of their normal equations, where slopes are derivatives by differences."""
EXACTLY = 1e-14
"""The same of an eigenvalue where columns go together exactly."""
AT_BOUND = 1e-6
"""Of its range: a number that is so near to a bound stands at it."""
