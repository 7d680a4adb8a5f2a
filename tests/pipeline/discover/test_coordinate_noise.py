"""How well coordinates of sites are known, and that no law is looked for where noise alone moves one."""

from dataclasses import replace

import numpy as np

from pipeline.discover.coordinate_noise import at_known_inputs, input_roots
from pipeline.discover.elements import elements
from pipeline.inference.prediction import predict
from pipeline.inference.residual import residual
from tests.pipeline.discover.fits import fit_of, map_of

DRAWS = 6
SETTLED = 0.09
"""Sigmas of its inputs by which a fit may leave them where they fit best."""


def test_of_one_input_that_one_reading_tells_of() -> None:
    """1/s² = 1/s_x² + J²/s_y² summed over the readings, in every direction that is looked along."""
    found = fit_of()
    cases, there = found.residual.load_cases, found.prediction
    root = input_roots(found)[0]
    seen = np.flatnonzero(cases.input_sigma[0] > 0.0)
    slopes = np.where(cases.predicted[0, :, None], there.by_inputs[0], 0.0)[:, seen]
    weight = np.where(cases.predicted[0], 1.0 / cases.spread[0] ** 2, 0.0)
    told = np.diag(1.0 / cases.input_sigma[0, seen] ** 2) + slopes.T @ (weight[:, None] * slopes)
    known = (root @ root.T)[np.ix_(seen, seen)]
    unit = np.sqrt(np.outer(np.diag(known), np.diag(known)))
    np.testing.assert_allclose(known / unit, np.linalg.inv(told) / unit, atol=1e-6)


def test_coordinates_scatter_as_the_inputs_that_the_readings_allow() -> None:
    found = fit_of()
    cases, here = found.residual.load_cases, found.prediction
    roots, generator = input_roots(found), np.random.default_rng(3)
    every = elements(found)
    off = np.zeros((DRAWS, len(every), cases.test.size))
    for k in range(DRAWS):
        z = generator.standard_normal(roots.shape[:2])
        shift = here.shift + np.einsum("rij,rj->ri", roots, z)
        there = predict(found.model, cases, start=here, shift=shift)
        moved = elements(replace(found, prediction=there, residual=residual(cases, there)))
        off[k] = [b.coordinate - a.coordinate for a, b in zip(every, moved, strict=True)]
    for number, each in enumerate(every):
        told, drawn = np.sqrt(np.mean(each.unsure**2)), np.sqrt(np.mean(off[:, number] ** 2))
        assert abs(drawn - told) < 0.12 * told + 1e-12, each.kind


def test_no_law_is_looked_for_where_noise_alone_moves_a_place() -> None:
    seen = map_of()
    names = {it.site.name for it in seen.sites}
    ratio = {
        each.kind: np.linalg.norm(each.coordinate) / np.linalg.norm(each.unsure)
        for each in elements(seen.found)
        if each.kind.startswith("base")
    }
    assert 0.5 < ratio["base_ry"] < 1.6, "the plan does not load the base about y"
    assert "base_ry" not in names
    assert {"base_x", "base_z", "hinge_torque", "along"} <= names


def test_inputs_are_found_as_far_as_all_readings_tell_them() -> None:
    """What a stiff place bears is known far better than the input that moves it by its own sigma."""
    found = fit_of()
    cases, here = found.residual.load_cases, found.prediction
    there = predict(found.model, cases, start=here, shift=here.shift + SETTLED * cases.input_sigma)
    rough = replace(found, prediction=there, residual=residual(cases, there))
    every = [{each.kind: each for each in elements(it)} for it in (found, rough, at_known_inputs(rough))]
    best, off, mended = (it["base_ry"].coordinate for it in every)
    unsure = np.linalg.norm(every[0]["base_ry"].unsure)
    assert np.linalg.norm(off - best) > 2.0 * unsure
    assert np.linalg.norm(mended - best) < 0.2 * unsure
