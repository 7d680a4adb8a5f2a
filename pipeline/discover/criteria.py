"""Thresholds by which a law is proposed, and where each is from."""

from __future__ import annotations

PROPOSED = 12.0
"""Evidence from which a site is proposed: of 16 000 white residuals without a law 99 % stay below 5.6, none is above
9.8."""
LEFT_OUT = 12.0
"""Chi-square that tests which were left out gain at least, without the best of them."""
ALIKE = 10.0
"""Evidence, or cost of a form, within which two are not told apart: a factor of 150 and more in their probability."""
ALIKE_SHARE = 0.01
"""Of the evidence, within which two sites are not told apart either: it goes with the square of what is explained, so
that influences which are a tenth off, as where a law changes the load that passes, take so much off it."""
FEW_TESTS = 3
"""Tests that see a site, below which blocks of the histories are left out instead."""
BLOCKS = 4
"""Into which a history is parted then."""
PREFERRED = 3.0
"""Cost by which a form that grows as a power is to be better than one that does not, and one that grows as an
exponential than a power: less is not worth more than a
bare mention (R. E. Kass, A. E. Raftery, Journal of the American Statistical Association 90 (1995) 773-795)."""
SETTLED = 3
"""Times that single bad readings are looked for, at most."""
LAWS = 3
"""That are looked for one after another, at most."""
FORMS = 5
"""That are fitted through the mechanism, at most."""
NEAR_FORMS = 25.0
"""Cost above the best form's, up to which another one is fitted through the mechanism: where influences are known
costs are off by some units, as coordinates are those of the model before."""
BEYOND = 1.5
"""Times the largest coordinate at which forms that are tied are compared."""
UNKNOWN_BEYOND = 0.3
"""Sigmas by which they may differ there before it is said."""
SEVERAL = 2
"""Effects with numbers from which a set competes with laws: one alone mimics no law."""
LEFT_BY_SET = 4.0
"""Evidence of a function beside a set of effects, from which a law may be better than the set by what tells them apart:
twice that of chi-square, and some more for what a form needs no prior of."""
LAW_GAINS, LAW_MORE = 1.2, 40.0
"""By which twice the evidence of a free function, and by what more, may fall short of what a law at its site gains of
chi-square: a form pays no prior for its amplitude, and influences are those of the model without it."""
