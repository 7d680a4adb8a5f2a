"""Every way in which a bench may differ from its drawing: one record per effect, null by default.

Units N, mm, rad, K; angles of a rotation vector in the base frame. At their null values the frame is unchanged exactly.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from math import inf, isfinite


@dataclass(frozen=True)
class ModulusError:
    """The stiffness of all bars times `scale`."""

    scale: float = 1.0


@dataclass(frozen=True)
class BarSectionError:
    """The section of all bars: axial stiffness, bending about y and about z, torsion, each times its own factor; what
    shears goes with the bending of its plane."""

    ea: float = 1.0
    eiy: float = 1.0
    eiz: float = 1.0
    gj: float = 1.0


@dataclass(frozen=True)
class BarStiffnessAsymmetry:
    """The stiffness of bar 2 times `ratio`; parallelogram only."""

    ratio: float = 1.0


@dataclass(frozen=True)
class BarLengthMismatch:
    """Bar 1 longer by this, its pins as far from those of bar 2 as drawn; parallelogram only."""

    mismatch_mm: float = 0.0


@dataclass(frozen=True)
class DimensionError:
    """All bars longer, the widths at base and platform wider than the drawing."""

    length_mm: float = 0.0
    width_mm: float = 0.0


@dataclass(frozen=True)
class BarInitialBow:
    """Half sine of all bars along +y and +z of the bar frame; the hinge axes stay straight."""

    bow_y_mm: float = 0.0
    bow_z_mm: float = 0.0


@dataclass(frozen=True)
class AxisFlexibility:
    """Each hinge gives across its axis (along both directions) and in tilt (about both)."""

    radial_mm_per_N: float = 0.0
    tilt_rad_per_Nmm: float = 0.0


@dataclass(frozen=True)
class JointClearance:
    """± play along the bar in each base hinge, with a soft centring spring (`joints.play`)."""

    play_mm: float = 0.0


@dataclass(frozen=True)
class JointFriction:
    """Coulomb torque in each hinge with an elastic start (`joints.friction`), relaxed in the unloaded linkage."""

    torque_Nmm: float = 0.0
    presliding_rad: float = 1e-3


@dataclass(frozen=True)
class JointTorsionalStiffness:
    """Return spring in each hinge, relaxed in the unloaded linkage."""

    stiffness_Nmm_per_rad: float = 0.0


@dataclass(frozen=True)
class ContactStiffening:
    """Hertz-like contact along the bar in each base hinge (`joints.contact`)."""

    c_mm_per_N23: float = 0.0


@dataclass(frozen=True)
class BaseCompliance:
    """Compliances of the fixture at the base origin, along and about the axes of the base frame."""

    x_mm_per_N: float = 0.0
    y_mm_per_N: float = 0.0
    z_mm_per_N: float = 0.0
    rx_rad_per_Nmm: float = 0.0
    ry_rad_per_Nmm: float = 0.0
    rz_rad_per_Nmm: float = 0.0


@dataclass(frozen=True)
class MountingTilt:
    """Rotation vector by which the whole linkage is turned about the base origin."""

    rx_rad: float = 0.0
    ry_rad: float = 0.0
    rz_rad: float = 0.0


@dataclass(frozen=True)
class LoadMisalignment:
    """Rotation vector of the load cell: reading = Rᵀ f and Rᵀ m, after the offset."""

    rx_rad: float = 0.0
    ry_rad: float = 0.0
    rz_rad: float = 0.0


@dataclass(frozen=True)
class LoadOffset:
    """Place r of the cell's point from the platform point, base frame: moment m - r x f, before the turn."""

    x_mm: float = 0.0
    y_mm: float = 0.0
    z_mm: float = 0.0


@dataclass(frozen=True)
class ThermalExpansion:
    """Strain of all bars per kelvin above the reference temperature."""

    alpha_per_K: float = 0.0


@dataclass(frozen=True)
class SelfWeight:
    """Dead loads that nobody entered: a force on the platform at its point and a line load on the bars, base frame."""

    fx_N: float = 0.0
    fy_N: float = 0.0
    fz_N: float = 0.0
    line_x_N_per_mm: float = 0.0
    line_y_N_per_mm: float = 0.0
    line_z_N_per_mm: float = 0.0


@dataclass(frozen=True)
class MaterialYield:
    """Strain at which a fibre yields (`fibres`)."""

    strain: float = inf


@dataclass(frozen=True)
class ActuatorCompliance:
    """Every drive gives so much more along or about its axis; machines only."""

    mm_per_N: float = 0.0
    rad_per_Nmm: float = 0.0


@dataclass(frozen=True)
class LinkCompliance:
    """The stiffness of every elastic link beside the bars of parallelograms times `scale`; machines only."""

    scale: float = 1.0


@dataclass(frozen=True)
class Errors:
    """All effects of a bench, by their canonical names; the geometric nonlinearity of bars is always there."""

    modulus_error: ModulusError = field(default_factory=ModulusError)
    bar_section_error: BarSectionError = field(default_factory=BarSectionError)
    bar_stiffness_asymmetry: BarStiffnessAsymmetry = field(default_factory=BarStiffnessAsymmetry)
    bar_length_mismatch: BarLengthMismatch = field(default_factory=BarLengthMismatch)
    dimension_error: DimensionError = field(default_factory=DimensionError)
    bar_initial_bow: BarInitialBow = field(default_factory=BarInitialBow)
    axis_flexibility: AxisFlexibility = field(default_factory=AxisFlexibility)
    joint_clearance: JointClearance = field(default_factory=JointClearance)
    joint_friction: JointFriction = field(default_factory=JointFriction)
    joint_torsional_stiffness: JointTorsionalStiffness = field(default_factory=JointTorsionalStiffness)
    contact_stiffening: ContactStiffening = field(default_factory=ContactStiffening)
    base_compliance: BaseCompliance = field(default_factory=BaseCompliance)
    mounting_tilt: MountingTilt = field(default_factory=MountingTilt)
    load_misalignment: LoadMisalignment = field(default_factory=LoadMisalignment)
    load_offset: LoadOffset = field(default_factory=LoadOffset)
    thermal_expansion: ThermalExpansion = field(default_factory=ThermalExpansion)
    self_weight: SelfWeight = field(default_factory=SelfWeight)
    material_yield: MaterialYield = field(default_factory=MaterialYield)
    actuator_compliance: ActuatorCompliance = field(default_factory=ActuatorCompliance)
    link_compliance: LinkCompliance = field(default_factory=LinkCompliance)

    def __post_init__(self) -> None:
        for path, value in self.values().items():
            lowest = _LOWEST.get(path)
            if not (isfinite(value) or path == "material_yield.strain"):
                raise ValueError(f"{path} is {value}, allowed are finite numbers")
            if lowest is not None and (value < lowest or (path in _OPEN and value == lowest)):
                raise ValueError(
                    f"{path} is {value:g}, allowed is {'more than' if path in _OPEN else 'at least'} 0"
                )

    def values(self) -> dict[str, float]:
        """All parameters by "effect.parameter"."""
        effects = {f.name: getattr(self, f.name) for f in fields(self)}
        return {f"{name}.{p.name}": getattr(e, p.name) for name, e in effects.items() for p in fields(e)}

    @staticmethod
    def of(values: Mapping[str, float]) -> "Errors":
        """Errors from values by "effect.parameter"; others null. Raises ValueError for an unknown name."""
        null = Errors()
        known = null.values()
        unknown = [path for path in values if path not in known]
        if unknown:
            raise ValueError(f"unknown parameter {unknown[0]!r}, allowed are {', '.join(known)}")
        given: dict[str, dict[str, float]] = {}
        for path, value in values.items():
            effect, _, parameter = path.rpartition(".")
            given.setdefault(effect, {})[parameter] = float(value)
        return replace(null, **{name: replace(getattr(null, name), **some) for name, some in given.items()})


_OPEN = {
    "modulus_error.scale",
    *(f"bar_section_error.{p.name}" for p in fields(BarSectionError)),
    "bar_stiffness_asymmetry.ratio",
    "joint_friction.presliding_rad",
    "material_yield.strain",
    "link_compliance.scale",
}
_LOWEST = dict.fromkeys(
    [
        *_OPEN,
        "axis_flexibility.radial_mm_per_N",
        "axis_flexibility.tilt_rad_per_Nmm",
        "joint_clearance.play_mm",
        "joint_friction.torque_Nmm",
        "joint_torsional_stiffness.stiffness_Nmm_per_rad",
        "contact_stiffening.c_mm_per_N23",
        *(f"base_compliance.{p.name}" for p in fields(BaseCompliance)),
        *(f"actuator_compliance.{p.name}" for p in fields(ActuatorCompliance)),
    ],
    0.0,
)
