"""Where the paper's print errs, each with numbers computed here; `vjm.paper` holds what is printed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product
from types import MappingProxyType

import numpy as np

from vjm import paper
from vjm.chain import Chain, Joint, Role
from vjm.closed_forms import euler_loads, in_plane_critical, middle_hinge_only
from vjm.equilibrium import equilibrium
from vjm.frames import Array
from vjm.lumped import STATION, SpringAt
from vjm.mechanism import ElasticChain
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.stiffness import closed_form, eliminate, in_bar_frame, loaded_stiffness, rank, unloaded_stiffness


@dataclass(frozen=True)
class Erratum:
    """One correction. evidence: names with their unit at the end, and numbers computed live."""

    number: int
    place: str
    printed: str
    correct: str
    evidence: Mapping[str, float]


def errata() -> tuple[Erratum, ...]:
    """All errata of the paper that the models of this package show."""
    return (
        last_factor(),
        missing_inverse(),
        wrong_reference(),
        not_straight(),
        table_1(),
        no_uniform_bar(),
        spring_place(),
    )


def example(q: float = 0.0, spring_at: SpringAt = "tip") -> Parallelogram:
    """The paper's linkage: Eq. 12, 310 mm, 80 mm."""
    return Parallelogram(paper.LENGTH, paper.WIDTH, paper.BAR_STIFFNESS, q, spring_at=spring_at)


def moving_last_factor(linkage: Parallelogram) -> Array:
    """Unloaded K (6, 6), bar frame, of Eq. 1 with its last factor R_y(-q_i2) as printed.

    The factor is appended as a passive joint of its own and tied to q_i2 by the chain rule.
    """
    total = np.zeros((6, 6))
    for elastic in linkage.chains:
        last = Joint("rotation", (0.0, 1.0, 0.0), Role.PASSIVE)
        chain = Chain((*elastic.chain.elements, last), elastic.chain.reference)
        jacobian = chain.jacobian(np.append(elastic.rest, 0.0))
        q = jacobian[:, elastic.passive]
        q[:, -1] -= jacobian[:, -1]
        total += eliminate(jacobian[:, elastic.virtual], q, elastic.stiffness)
    return in_bar_frame(total, linkage.q)


def eq_6_step(chain: ElasticChain, pose: Array, coordinates: Array, inverted: bool) -> tuple[Array, Array]:
    """One step of Eq. 6, literally, its block matrix inverted or as printed: lambda' (6,), coordinates' (n,), of a
    pose (6,) and coordinates (n,)."""
    kinematics = chain.chain.kinematics(coordinates)
    j_theta, j_q = kinematics.jacobian[:, chain.virtual], kinematics.jacobian[:, chain.passive]
    compliance = np.linalg.inv(chain.stiffness)
    block = np.block([[j_theta @ compliance @ j_theta.T, j_q], [j_q.T, np.zeros((j_q.shape[1],) * 2)]])
    right = pose - kinematics.pose + kinematics.jacobian @ coordinates
    right = np.append(right, np.zeros(j_q.shape[1]))
    solution = np.linalg.solve(block, right) if inverted else block @ right
    following = coordinates.copy()
    following[chain.passive] = solution[6:]
    following[chain.virtual] = compliance @ j_theta.T @ solution[:6]
    return solution[:6], following


def last_factor() -> Erratum:
    """Erratum 1."""
    linkage = example()
    moving = moving_last_factor(linkage)
    constant = unloaded_stiffness(linkage, linkage.q)
    reference = closed_form(paper.BAR_STIFFNESS, paper.WIDTH, linkage.q)
    return _erratum(
        1,
        "Eq. 1, last factor",
        "R_y(-q_i2), moving with the passive coordinate",
        "the constant nominal rotation R_y(q)",
        {
            "rank as printed": float(rank(moving, paper.LENGTH)),
            "rank corrected": float(rank(constant, paper.LENGTH)),
            "K11 as printed, N/mm": float(moving[0, 0]),
            "K11 corrected, N/mm": float(constant[0, 0]),
            "largest difference corrected to Eq. 11, relative": float(
                np.max(np.abs(constant - reference)) / np.max(np.abs(reference))
            ),
        },
    )


def missing_inverse() -> Erratum:
    """Erratum 2, with a platform pushed in by 0.1 mm."""
    linkage = example()
    pose = linkage.unloaded_pose - 0.1 * np.eye(6)[0]
    force = equilibrium(linkage, pose).load[0]
    evidence: dict[str, float] = {"Fx of Newton's method, N": float(force)}
    for name, inverted in (("as printed", False), ("corrected", True)):
        steps = [_eq_6(chain, pose, inverted) for chain in linkage.chains]
        evidence[f"Fx after 5 steps {name}, N"] = float(sum(multiplier[0] for multiplier, _ in steps))
        evidence[f"loop gap after 5 steps {name}, mm"] = float(max(gap for _, gap in steps))
    evidence["Eq. 10 against central differences, relative"] = _tangent_error(linkage, pose)
    return _erratum(
        2,
        "Eqs. 6, 7 and 9",
        "block matrix not inverted; J without transposes, H_q_theta in row 1 of Eq. 9",
        "block matrix inverted; J^T delta lambda; H_theta_q in row 1",
        evidence,
    )


def wrong_reference() -> Erratum:
    """Erratum 3."""
    q = np.radians(30.0)
    error = _distance(closed_form(paper.BAR_STIFFNESS, paper.WIDTH, float(q)))
    return _erratum(
        3,
        "text before Eq. 13",
        "expression (12) yields the following stiffness matrix",
        "expression (11); Eq. 12 is the stiffness of one bar",
        {"Eq. 13 against Eq. 11, largest relative difference": error},
    )


def not_straight() -> Erratum:
    """Erratum 4."""
    evidence: dict[str, float] = {}
    for degrees in (0.0, 30.0):
        half = 0.5 * closed_form(paper.BAR_STIFFNESS, paper.WIDTH, float(np.radians(degrees)))
        for i, j in ((4, 4), (4, 6), (5, 5), (6, 6)):
            evidence[f"K_p/2 entry {i}{j} of Eq. 11 at {degrees:.0f} deg, N·mm/rad"] = float(
                half[i - 1, j - 1]
            )
        evidence[f"Eq. 13 against Eq. 11 at {degrees:.0f} deg, largest relative difference"] = _distance(
            2 * half
        )
    return _erratum(
        4,
        "Eq. 13",
        "corresponding to the straight configuration (q = 0)",
        "Eq. 13 is Eq. 11 at q = 30 deg with d = 80 mm, which the paper never states",
        evidence,
    )


def table_1() -> Erratum:
    """Erratum 5: the four differences between VJM and FEA that are called a perfect match."""
    evidence: dict[str, float] = {}
    for model in ("solid axis", "flexible axis"):
        pairs = zip(
            ("K_tran", "K_rot"), paper.TABLE_1[model, "vjm"], paper.TABLE_1[model, "fea"], strict=True
        )
        evidence |= {f"{name} {model}, VJM against FEA, percent": 100 * (v / f - 1) for name, v, f in pairs}
    bars, solid = paper.TABLE_1["2x-bar", "vjm"], paper.TABLE_1["solid axis", "vjm"]
    evidence["K_tran, parallelogram over two bars, ratio"] = solid[0] / bars[0]
    evidence["K_rot, parallelogram over two bars, ratio"] = solid[1] / bars[1]
    return _erratum(
        5,
        "Table 1 and the text after it",
        "units mm/N and rad/N; a gain in translational stiffness; values match perfectly",
        "units N/mm and N·mm/rad; translation loses, rotation gains; foot, actuator, axis, posture and "
        "section are not given, so the table cannot be recomputed",
        evidence,
    )


def no_uniform_bar() -> Erratum:
    """Erratum 6: a uniform bar has lever arms L/2 and K22 K66 / K26² = (4 + phi)/3, shear number phi >= 0."""
    k = paper.BAR_STIFFNESS
    length = paper.LENGTH
    ratios = [a * b / c**2 for a, b, c in product((18.05, 18.15), (584.5e3, 585.5e3), (2835.0, 2845.0))]
    ea, ei_y, ei_z = k[0, 0] * length, k[2, 2] * length**3 / 12, k[1, 1] * length**3 / 12
    return _erratum(
        6,
        "Eq. 12",
        "the stiffness of a bar of 310 mm",
        "no uniform bar of that length: lever arms off L/2, ratio below 4/3; an I-like bar, stiffer ends",
        {
            "-K26/K22, mm": float(-k[1, 5] / k[1, 1]),
            "K35/K33, mm": float(k[2, 4] / k[2, 2]),
            "half length, mm": length / 2,
            "K22 K66 / K26²": float(k[1, 1] * k[5, 5] / k[1, 5] ** 2),
            "K22 K66 / K26², lowest within print rounding": min(ratios),
            "K22 K66 / K26², highest within print rounding": max(ratios),
            "least ratio of a uniform bar": 4.0 / 3.0,
            "EA from K11, N": float(ea),
            "GJ from K44, N·mm²": float(k[3, 3] * length),
            "EI_z from K22, N·mm²": float(ei_z),
            "EI_z from K26, N·mm²": float(-k[1, 5] * length**2 / 6),
            "EI_y from K33, N·mm²": float(ei_y),
            "EI_y from K55, N·mm²": float(k[4, 4] * length / 4),
            "radius of gyration about z, mm": float(np.sqrt(ei_z / ea)),
            "radius of gyration about y, mm": float(np.sqrt(ei_y / ea)),
        },
    )


def spring_place() -> Erratum:
    """Erratum 7."""
    evidence: dict[str, float] = {}
    reference = closed_form(paper.BAR_STIFFNESS, paper.WIDTH, 0.0)
    for place in STATION:
        linkage = example(0.0, place)
        difference = np.max(np.abs(unloaded_stiffness(linkage) - reference)) / np.max(reference)
        evidence[f"K_p, springs at the {place}, difference to Eq. 11, relative"] = float(difference)
        loads = in_plane_critical(linkage)
        for sign, load in (("compression", loads.compression), ("tension", loads.tension)):
            if load is not None:
                evidence[f"in-plane critical load in {sign}, springs at the {place}, N"] = load
    k, length = paper.BAR_STIFFNESS, paper.LENGTH
    exact = euler_loads(float(k[2, 2] * length**3 / 12), float(k[1, 1] * length**3 / 12), length)
    evidence["springs at the middle, transverse one rigid, N"] = middle_hinge_only(k, length)
    evidence["uniform bars with EI of K33 and K22, exact in plane, N"] = exact.in_plane
    evidence["uniform bars with EI of K33 and K22, exact sideways guided, N"] = exact.guided
    evidence["uniform bars with EI of K33 and K22, exact sideways clamped, N"] = exact.clamped
    evidence["uniform bars with EI of K33 and K22, exact sideways cantilever, N"] = exact.cantilever
    return _erratum(
        7,
        "section 5, geometrical buckling of the VJM in compression",
        "the VJM detects a geometrical buckling under compression",
        "with z held, Eq. 1 (springs at the tip) is stable in compression and unstable in tension; the "
        "critical load depends on where along the bar the springs sit, the stiffness K_p does not",
        evidence,
    )


def _erratum(number: int, place: str, printed: str, correct: str, evidence: dict[str, float]) -> Erratum:
    return Erratum(number, place, printed, correct, MappingProxyType(evidence))


def _eq_6(chain: ElasticChain, pose: Array, inverted: bool) -> tuple[Array, float]:
    coordinates, multiplier = chain.rest, np.zeros(6)
    for _ in range(5):
        multiplier, coordinates = eq_6_step(chain, pose, coordinates, inverted)
    return multiplier, float(np.linalg.norm(chain.chain.pose(coordinates)[:3] - pose[:3]))


def _tangent_error(linkage: Parallelogram, pose: Array) -> float:
    """Eq. 10 at a pose against central differences of the load, relative to the largest entry."""
    steps = np.diag(np.repeat([1e-3, 1e-5], 3))
    loads = equilibrium(linkage, np.stack([pose + steps, pose - steps])).load
    numerical = ((loads[0] - loads[1]) / (2 * np.sum(steps, axis=1))[:, None]).T
    tangent = loaded_stiffness(equilibrium(linkage, pose))
    return float(np.max(np.abs(numerical - tangent)) / np.max(np.abs(tangent)))


def _distance(stiffness: Array) -> float:
    """Largest relative difference of the printed Eq. 13 to a K_p, over the entries printed as non-zero."""
    printed = 2.0 * paper.HALF_PARALLELOGRAM_STIFFNESS
    rows = np.nonzero(printed)
    return float(np.max(np.abs(printed - stiffness)[rows] / np.abs(printed[rows])))
