"""Settings of the numerical methods of a fit and of what is judged by one: steps, rounds, tolerances.

Thresholds by which explanations are chosen are criteria and stand there (`pipeline.selection.criteria`), those of the
two solvers with them (`pipeline.inference.solvers`, `pipeline.inference.levenberg_marquardt`). Where no derivation,
measurement or source is told, a value is the founders' own.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Bifurcation:
    """Where a linkage bends to one of several sides (`pipeline.inference.bifurcation`)."""

    nothing: float = 1e-7
    """mm, rad, N or N·mm: no sensor tells so little from nothing."""
    same: float = 1e-6
    """Relative difference from which readings, or energies, tell two sides apart."""
    flat: float = 0.2
    """Of the lowest eigenvalue without load: a path that ends with less has come to its greatest load. The last
    equilibrium is found within 1/128 of the way, and the eigenvalue goes with the root of what is left."""


@dataclass(frozen=True)
class Crossings:
    """Rows that are tried on other sides of stops (`pipeline.inference.contact_branches`)."""

    most: int = 4
    """Stops that a row crosses, at most, to where it fits better."""
    badly: float = 0.05
    """Chance that noise makes a row so bad that other sides are tried: sides tried for all rows would take up noise."""
    rows: float = 0.5
    """Part of the rows: a model that fits fewer has other faults than their sides."""
    within: float = 4.0
    """Sigmas of the inputs within which a stop may have been touched."""
    worth: float = 1e-3
    """Of chi-square: a row that a stop charges with less stays."""


@dataclass(frozen=True)
class Stops:
    """Rows kept on their sides of stops (`pipeline.inference.stops`)."""

    sure: float = 2.0
    """Standard deviations from which a row is sure of its stop."""
    touch: float = 0.01
    """Standard deviations from a stop at which a row that belongs to one of its sides is linearised."""
    no_room: float = 1e-9
    """Of one, in the problem of least distance: less is left where bounds exclude each other."""
    side: float = 0.36
    """Of chi-square, that a row without play takes up on average by choosing its side of one as large as the noise, of
    the better of two displacements and with the sign of a force that is all noise; less of other plays."""
    spread: float = 2.5
    """Twice the standard deviation of the same, of a row."""


@dataclass(frozen=True)
class History:
    """Steps that remember (`pipeline.inference.history`)."""

    rounds: int = 8
    """Times that all steps are solved at once; what does not fit together then goes step by step."""
    patience: int = 16
    """Iterations for a step after the one before; what yields is found in few or by less of a step."""
    same: float = 1e-10
    """Of its largest value: by so much a memory may differ from the one that the step before leaves."""


@dataclass(frozen=True)
class Inputs:
    """True inputs of each row (`pipeline.inference.objective`, `pipeline.inference.residual`)."""

    near: float = 0.1
    """Of their sigmas: inputs are settled when a step moves them by no more."""
    same: float = 1e-3
    """Of chi-square, of which noise makes one for every reading, or of its mean square where that is more: inputs are
    settled too when a step changes the sum of squares by no more."""
    rounds: int = 6
    """Steps of the inputs, at most. Far above noise they may not settle: no verdict hangs on how much is left there."""
    farthest: float = 5.0
    """Sigmas from where it was read that an input is looked for."""
    rounded: float = 1e5
    """Noise of an input in sigmas of a reading from which the covariance is not formed: its ones would be lost."""


@dataclass(frozen=True)
class Written:
    """What was written about the rig (`pipeline.inference.nuisances`, `pipeline.inference.nuisance_line`)."""

    farthest: float = 5.0
    """Standard deviations from its nominal value at which a number is linearised, at most."""
    order: int = 1
    """Of differences: a thousandth of a derivative, of numbers known to a few hundredths, is nothing."""
    step: float = 0.5
    """Standard deviations over which what is no number of a mechanism is differenced."""
    same: float = 0.1
    """Of chi-square, or of its mean square where that is more: numbers that change it by no more are where they fit
    best."""
    rounds: int = 4
    """Steps of these numbers, at most: far above noise they need not settle."""
    chords: int = 1
    """Of them along a line that may be another model's."""


@dataclass(frozen=True)
class Differences:
    """Derivatives of predictions (`pipeline.inference.prediction`, `pipeline.inference.sensor_faults`)."""

    slight: float = 1e-3
    """Bow, in lengths of a bar, from which straight bars find the branch on which they bend."""
    inside: float = 3e-3
    """Of its typical size, by which a parameter stays inside its bounds at least: there it has a derivative to both
    sides, and an effect whose null is a bound is there, while what it does is far below any noise."""
    near_kinks: float = 1e-3
    """Of its typical size, over which a number with kinks is differentiated."""
    fault_step: float = 1e-4
    """Of a typical size, over which an error of a sensor is differenced: it is a smooth formula."""
    fault_motion: float = 3.0
    """Of what the noise of the inputs does to a reading, within which it has not moved."""
    fault_still: float = 3.0
    """The same, up to which the readings of a test may scatter without order: its sigma may be declared too small."""
    order: float = 1.0
    """Mean square of successive differences over the variance: two for noise, less where readings have an order."""
    fault_turns: int = 6
    """Of the iteration for what was really done: each takes an error's share of what is left."""


@dataclass(frozen=True)
class Ladder:
    """Sizes of an effect from which fits begin (`pipeline.inference.multistart`)."""

    sizes: tuple[float, ...] = tuple(10.0 ** np.linspace(-1.0, 1.0, 5))
    """In typical sizes of the effect, a factor of three apart."""
    largest: float = 1e3
    """Typical sizes beyond which no rung is added."""
    hopeless: float = 4.0
    """A ladder ends where chi-square is so many times that of its best rung, and grows."""
    worth: float = 1.0
    """Fall of chi-square that is worth another fit, in the mean square of what the first one leaves."""
    between: int = 4
    """Looks between the last rung at which an effect does not show and the first at which there is too much of it."""
    below: int = 3
    """Rungs below the first one, at most."""
    minima: int = 2
    """Valleys of the ladder that are fitted."""
    foot: float = 1.5
    """Times the best rung, from which the foot of the ladder is no valley: it is the model without the effect."""
    room: float = 1e-9
    """Typical sizes by which bounds of its one linear step are apart, where a number stands at one."""


@dataclass(frozen=True)
class Look:
    """Fewer rows, where a look is enough (`pipeline.inference.thinning`)."""

    moves: float = 20.0
    """Sigmas of its noise: an input that moves more is driven, and not held."""
    rows: int = 100
    """Fitted rows that a look takes; a campaign of fewer is taken as it is."""


@dataclass(frozen=True)
class Profile:
    """Errors and ends of intervals (`pipeline.inference.fit`, `profile_likelihood` and `intervals` beside it)."""

    confidence: float = 0.95
    """Of intervals: 1.96 standard errors to either side, a rise of chi-square by 3.841."""
    nearly: float = 0.15
    """A rise within this part of 3.841 at 1.96 standard errors puts the Wald end at most 8 % of the half width beside
    the profile's."""
    close: float = 0.03
    """Ends of a profile are found to this part of their distance."""
    steps: int = 14
    """Of a search for an end, and of the others that are fitted anew at each of them, at most."""
    enough: float = 10.0
    """Times a rise that is asked about: of one that is larger only that is wanted."""
    flat: float = 0.03
    """Of a standard error: the step whose gain a fit no longer takes."""
    blind: float = 1e-6
    """A direction in which the whitened derivative falls below this part of the number's own is not seen: its error
    bar would be a million times that of the number alone, beyond the rounding of the derivatives."""
    told: float = 0.9
    """Correlation of two numbers from which it is told."""
    shared: float = 1e-3
    """Share of a number in directions that the data do not see, from which they do not determine it."""
    work: float = 2.0
    """Of the work of one fit, that all intervals may take: of 590 benches the dearest, five numbers of which two are of
    a friction, takes a little more than one, the 60 benches whose work was counted a fifth at most."""
    farther: float = 3.0
    """Times the distance at which a profile is looked at next, at most, where it has not risen enough."""
    no_less_far: float = 1.2
    """The same at least, where a parabola would have it nearer than it was looked at."""
    least_rise: float = 1e-9
    """Of chi-square, that a profile is taken to rise by: one that did not is looked at as far away as may be."""
    first: float = 1e-9
    """Of the room to a bound, at least, where an end is looked for first: never at the value itself."""
    off_ends: float = 0.1
    """Of a bracket, by which the next look is kept off either end: it also halves a jump."""


@dataclass(frozen=True)
class ChosenSteps:
    """When a load was chosen and not measured (`pipeline.inference.estimated_sigmas`)."""

    even: float = 0.02
    """Of a step, by which multiples of the smallest may miss it."""
    cells: float = 10.0
    """Smallest steps within the range, for each reading, at most."""
    turns: float = 1.0 / 3.0
    """Of the steps, at which the load turns back, at most; noise does so at two of three."""


@dataclass(frozen=True)
class Claims:
    """When the scatter counts in the place of a declared sigma (`pipeline.inference.declared_sigmas`)."""

    times: float = 10.0
    """By which the scatter has to be smaller than the claim."""
    sure: float = 3.0
    """Standard errors of the scatter by which it has to be."""
    computed: float = 1e-6
    """Of the largest reading, or of what the sigmas say: a scatter below that is none of a sensor, the readings were
    computed, or stand still."""
    chance: float = 1e-4
    """Chance that noise leaves so little, where the series are too short for a scatter."""


@dataclass(frozen=True)
class Roughness:
    """Scatter about smooth curves (`pipeline.inference.sensor_noise`)."""

    window: int = 4
    """Steps in a difference: a quadratic in the load passes it without a trace, at any spacing of the loads."""
    fewest: int = 6
    """Differences below which a median says nothing."""
    about_lines: int = 3
    """Degrees of freedom about straight lines below which their scatter says nothing."""
    about_parabolas: int = 4
    """Degrees of freedom about parabolas below which their scatter refutes no declared sigma: of four, noise is twenty
    times smaller than its sigma once in a hundred thousand."""


@dataclass(frozen=True)
class Draws:
    """Draws of noise for the bias of a scatter (`pipeline.inference.sensor_noise`)."""

    most: int = 1000
    """The bias is known to the spread of one estimate over the root of this, 3 % of its standard error."""
    fewest: int = 100
    """Where the differences are so many that the bias is lost anyway."""
    at_once: int = 20
    """Draws in one array."""
    kept: int = 256
    """Sets of loads whose bias is kept: all sensors of a table ask for those of its tests."""
    effort: int = 10**7
    """Draws times differences, from which there are fewer draws."""


@dataclass(frozen=True)
class Imhof:
    """The integral of Imhof over the logarithm of its variable (`pipeline.inference.noise`)."""

    low: float = -30.0
    """The integrand goes with its variable there, e**-30 of one."""
    high: float = 40.0
    """Of two weights of like size it falls with its variable, to e**-40."""
    pieces: int = 500
    """Of scipy's adaptive quadrature, at most."""
    error: float = 1e-10
    """Absolute, of the integral: a hundredth of what the probability is told to."""


@dataclass(frozen=True)
class Scattering:
    """Factors of declared sigmas, by Fisher's scoring (`pipeline.selection.adequacy.scatter`)."""

    far_out: float = 1e-4
    """Chance that noise puts a row so far out; beyond, it counts as if it were there."""
    wide: float = 1.0
    """Standard deviation of the logarithm of a factor before anything is seen: what no row shows stays as declared."""
    rounds: int = 50
    """Steps of scoring, at most, each of one in the logarithm of a variance at most."""
    settled: float = 1e-4
    """Of the logarithm of a variance: a step that is smaller is the last."""


@dataclass(frozen=True)
class Correlation:
    """Correlations of largest likelihood (`pipeline.selection.adequacy.correlated`)."""

    largest: float = 0.98
    """Correlation of neighbours at most: beyond, noise is a zero that wanders, which is a fault of a sensor."""
    step: float = 1e-3
    """Of a correlation, over which the derivative of the likelihood is differenced."""
    first: float = 0.3
    """Where the search for one that is not known begins."""


@dataclass(frozen=True)
class StudentsLaw:
    """The law of long tails of largest likelihood (`pipeline.selection.adequacy.tails`)."""

    degrees: tuple[float, float] = (1.0, 100.0)
    """Of Student's law: below, it has no mean; above, it is normal."""
    farthest: float = 8.0
    """Normal scores beyond which a probability is one in double precision."""
    first: float = 4.0
    """Degrees at which the search begins."""
    bad: float = -4.0
    """Logarithm of the odds of a bad reading, at which the search for its rival begins: two in a hundred are bad."""
    cut: float = 4.0
    """Sigmas, by the median magnitude of a channel, to which its readings are cut where its own size is asked."""


@dataclass(frozen=True)
class Patterns:
    """What errors of sensors look like in a residual (`pipeline.selection.adequacy.patterns`)."""

    left: float = 1e-3
    """Part of a column that is left at least when what the fit can move is taken out of it: less may be what is wrong
    with derivatives by differences."""
    lag: float = 0.7
    """Of a reading, that is still there a step later in a sensor that follows slowly."""
    travel: float = 0.01
    """Of the largest reading, from which a step has a direction of travel."""


@dataclass(frozen=True)
class GreatestLoads:
    """Which residuals are off at the greatest loads (`pipeline.selection.adequacy.greatest_loads`)."""

    near: float = 0.95
    """Of the greatest load of its direction, from which a row counts as there."""
    far: float = 3.0
    """Sigmas, or times the median of its channel by which noise would have it, from which a residual is far out."""


GOOD_SENSOR = {"mm": 1e-3, "rad": 2e-5, "N": 1.0, "Nmm": 50.0}
"""What one tells apart on the bench of the paper, by unit: makes travels of different units comparable."""
BIFURCATION = Bifurcation()
CROSSINGS = Crossings()
STOPS = Stops()
HISTORY = History()
INPUTS = Inputs()
WRITTEN = Written()
DIFFERENCES = Differences()
LADDER = Ladder()
LOOK = Look()
PROFILE = Profile()
CHOSEN_STEPS = ChosenSteps()
CLAIMS = Claims()
ROUGHNESS = Roughness()
DRAWS = Draws()
IMHOF = Imhof()
SCATTERING = Scattering()
CORRELATION = Correlation()
STUDENTS_LAW = StudentsLaw()
PATTERNS = Patterns()
GREATEST_LOADS = GreatestLoads()
