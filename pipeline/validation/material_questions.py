"""Numbers of a material that may be right and are seldom so: asked about, never refused.

The limits are those of a question and of no result: round values about what handbooks commonly give. Young's modulus in
GPa: PTFE 0.4 to 0.55, about the softest of the plastics that carry loads; metals from some 12 (lead) to some 410
(tungsten), so that such a number in GPa lies below the limit; diamond 1050 to 1220. Poisson's ratio: concrete 0.1 to
0.2, soft plastics 0.46.
"""

from __future__ import annotations

from collections.abc import Iterator

from pipeline.validation.case_tables import Material

SOFT, HARD = 450.0, 1.22e6
"""MPa: as soft as the softest plastics that carry loads, as hard as diamond."""
USUAL_NU = (0.1, 0.47)


def material_questions(it: Material) -> Iterator[str]:
    """What to ask about a material, behind the name of its key."""
    modulus, nu = it.E_MPa, it.nu
    if modulus < SOFT:
        yield (
            f"E_MPa: {modulus:g} MPa is at most that of a soft plastic (PTFE has 400 to 550 MPa): "
            f"is it in GPa? Then write {1000.0 * modulus:.10g}; steel has 210000"
        )
    if modulus > HARD:
        yield f"E_MPa: {modulus:g} MPa is more than diamond has ({HARD:g} MPa): is it in kPa or Pa?"
    if not USUAL_NU[0] <= nu <= USUAL_NU[1]:
        low, high = USUAL_NU
        yield f"nu: {nu:g} is outside {low:g} to {high:g}, where structural materials are: is it right?"
