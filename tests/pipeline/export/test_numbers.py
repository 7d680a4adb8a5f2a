"""json, npz and mat read back by the libraries of their formats: every number to the last bit."""

from __future__ import annotations

import json
from hashlib import sha256
from pathlib import Path

import numpy as np
import pytest
from scipy.io import loadmat
from scipy.spatial.transform import Rotation

from pipeline.validation.result import Result
from tests.pipeline.export.sources import (
    ANGLES,
    KEPT,
    LENGTH,
    UNEQUAL,
    WIDTH,
    brought,
    campaign,
    coupled,
    written,
)
from vjm.frames import rotate_stiffness, rotation_y
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.stiffness import closed_form, unloaded_stiffness


def expected(path: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """K_b (6, 6), K_p (angles, 6, 6) in the base frame and the angles of a saved result, which `run` has written."""
    result = Result.model_validate_json(path.read_bytes())
    angles = np.array([each.q_deg for each in result.parallelogram])
    turned = [
        rotate_stiffness(np.array(each.vjm), rotation_y(np.radians(each.q_deg)))
        for each in result.parallelogram
    ]
    return np.array(result.bar.stiffness), np.array(turned), angles


def test_json_of_a_result(tmp_path: Path) -> None:
    it, (path,) = written(KEPT, "json", tmp_path / "out.json")
    read = json.loads(path.read_text())
    bar, linkages, angles = expected(KEPT)
    by_name = [each for each in read["stiffness"] if each["name"] == "K_b"]
    np.testing.assert_allclose(by_name[0]["matrix"], bar, rtol=1e-13, atol=1e-9)
    assert by_name[0]["point_mm"] == [LENGTH, 0.0, 0.0] and "bar frame" in by_name[0]["frame"]
    found = [each for each in read["stiffness"] if each["name"] == "K_p"]
    assert [each["q_deg"] for each in found] == angles.tolist() and {each["rank"] for each in found} == {5}
    for each, wanted, whole in zip(found, linkages, it.linkages, strict=True):
        np.testing.assert_array_equal(each["matrix"], whole.whole.matrix)
        assert np.abs(np.array(each["matrix"]) - wanted).max() < 1e-9 * np.abs(wanted).max()
        q = np.radians(each["q_deg"])
        np.testing.assert_allclose(
            each["point_mm"], [LENGTH * np.cos(q), 0.0, -LENGTH * np.sin(q)], atol=1e-12
        )
    assert read["units"]["length"] == "mm" and read["sha256"] == {
        KEPT.name: sha256(KEPT.read_bytes()).hexdigest()
    }
    assert read["versions"]["numpy"] == np.__version__ and any("rank 5" in said for said in read["remarks"])


def test_k_p_is_eq_11_where_the_bar_has_no_other_couplings(tmp_path: Path) -> None:
    """By the closed form, which shares nothing with the elimination of the springs."""
    it, _ = written(KEPT, "json", tmp_path / "out.json", q=-20.0)
    ideal = it.bars[0].matrix
    wanted = rotate_stiffness(closed_form(ideal, WIDTH, np.radians(-20.0)), rotation_y(np.radians(-20.0)))
    assert it.linkage is not None and len(it.linkages) == 1
    # K_b of a solid has couplings of its mesh, 1e-9 of its diagonal, that Eq. 11 does not read.
    assert np.abs(it.linkage.whole.matrix - wanted).max() < 1e-8 * np.abs(wanted).max()


@pytest.mark.parametrize("kind", ["bar", "parallelogram"])
def test_npz(kind: str, tmp_path: Path) -> None:
    it, (path,) = written(campaign(tmp_path / "bench", kind), "npz", tmp_path / "out.npz")
    with np.load(path, allow_pickle=False) as read:
        np.testing.assert_allclose(read["K_b"], coupled(), rtol=1e-15)
        assert (read["K_b"] == it.bars[0].matrix).all() and float(read["K_b_length_mm"]) == LENGTH
        assert ("K_p" in read) == (kind == "parallelogram")
        assert "N, mm, rad" in str(read["units"][0]) and any("base clamped" in line for line in read["about"])
        if kind == "parallelogram":
            assert read["q_deg"].tolist() == list(ANGLES)
            np.testing.assert_array_equal(read["K_p"], [each.whole.matrix for each in it.linkages])


def test_mat(tmp_path: Path) -> None:
    it, (path,) = written(campaign(tmp_path / "bench", effects=UNEQUAL), "mat", tmp_path / "out.mat")
    read = loadmat(path)
    np.testing.assert_array_equal(read["K_b"], it.bars[0].matrix)
    np.testing.assert_array_equal(read["K_b2"], it.bars[1].matrix)
    for k, linkage in enumerate(it.linkages):
        np.testing.assert_array_equal(read["K_p"][:, :, k], linkage.whole.matrix)
    assert read["q_deg"].ravel().tolist() == list(ANGLES)
    said = [str(line[0]) for line in read["remarks"].ravel()]
    assert any(line.endswith("not in the file: load_offset.") for line in said), said
    assert any(line.endswith("bar_length_mismatch, bar_stiffness_asymmetry.") for line in said), said
    # No time of writing, which scipy puts there: the same again is the same file.
    assert b"parastiff export" in read["__header__"]
    assert path.read_bytes() == written(tmp_path / "bench", "mat", tmp_path / "again.mat")[1][0].read_bytes()


def test_the_model_changes_the_bars(tmp_path: Path) -> None:
    """By the definition of the two effects: bar 1 is longer by the mismatch, bar 2 stiffer by the ratio."""
    it, _ = written(campaign(tmp_path / "bench", effects=UNEQUAL), "json", tmp_path / "out.json")
    first, second = it.bars
    longer = LENGTH / (LENGTH + 3.0)
    powers = np.sqrt(longer ** np.array([1.0, 3.0, 3.0, 1.0, 1.0, 1.0]))
    np.testing.assert_allclose(first.matrix, np.outer(powers, powers) * coupled(), rtol=1e-13)
    np.testing.assert_allclose(second.matrix, 1.2 * coupled(), rtol=1e-13)
    assert (first.length, second.length) == (LENGTH + 3.0, LENGTH)
    for linkage in it.linkages:
        ahead = linkage.tips - linkage.bases
        np.testing.assert_allclose(np.linalg.norm(ahead, axis=1), [LENGTH + 3.0, LENGTH], rtol=1e-12)
        assert abs(np.linalg.norm(linkage.tips[1] - linkage.tips[0]) - WIDTH) < 1e-10


def test_a_tilted_linkage_is_the_same_one_turned(tmp_path: Path) -> None:
    """K_p and its point turn with the mount, whatever rotation vector the platform then has; the hinges stay drawn."""
    tilt = {"rx_rad": 0.2, "ry_rad": -0.1, "rz_rad": 0.3}
    drawn, _ = written(campaign(tmp_path / "a"), "json", tmp_path / "a.json", 30.0)
    it, _ = written(
        campaign(tmp_path / "b", effects={"mounting_tilt": tilt}), "json", tmp_path / "b.json", 30.0
    )
    turn = Rotation.from_rotvec(list(tilt.values())).as_matrix()
    assert it.linkage is not None and drawn.linkage is not None
    plain, turned = drawn.linkage.whole, it.linkage.whole
    wanted = rotate_stiffness(plain.matrix, turn)
    assert np.abs(turned.matrix - wanted).max() < 1e-9 * np.abs(wanted).max()
    np.testing.assert_allclose(turned.point, turn @ plain.point, atol=1e-10)
    np.testing.assert_allclose(it.linkage.tips, drawn.linkage.tips, atol=1e-10)
    assert it.in_bars == frozenset() and it.in_whole == {"mounting_tilt"}


def test_the_bars_stand_where_the_model_has_them(tmp_path: Path) -> None:
    """A zero error of the angle that a fit has found: the linkage is that of the angle and the error together."""
    bench = campaign(tmp_path / "bench")
    (bench / "model.toml").write_text(
        'schema = 1\nbase = "vjm"\n[nominals.angle]\nposture = 20.0\nmount = 0.0\n'
    )
    off, _ = written(bench, "json", tmp_path / "off.json", 30.0)
    (bench / "model.toml").unlink()
    at, _ = written(bench, "json", tmp_path / "at.json", 30.0 + np.degrees(0.02))
    assert off.linkage is not None and at.linkage is not None and off.linkage.q_deg == 30.0
    np.testing.assert_allclose(off.linkage.tips, at.linkage.tips, atol=1e-10)
    wanted = at.linkage.whole.matrix
    assert np.abs(off.linkage.whole.matrix - wanted).max() < 1e-10 * np.abs(wanted).max()


@pytest.mark.parametrize("to", ["json", "npz", "mat", "urdf", "mjcf", "exudyn"])
def test_every_format_takes_a_brought_bar(to: str, tmp_path: Path) -> None:
    """With a width it is a linkage, whose bar and K_p are there; without one it is a bar. A folder does as well."""
    linked, files = written(brought(tmp_path / "linked").parent, to, tmp_path / "a")
    alone, more = written(brought(tmp_path / "alone", wide=False), to, tmp_path / "b")
    assert files and more and all(path.stat().st_size for path in (*files, *more))
    for it in (linked, alone):
        np.testing.assert_array_equal(it.bars[0].matrix, coupled())
    assert [each.q_deg for each in linked.linkages] == [0.0] and not alone.linkages
    mechanism = Parallelogram(LENGTH, WIDTH, coupled())
    k_p = unloaded_stiffness(mechanism)
    np.testing.assert_allclose(linked.linkages[0].whole.matrix, k_p, atol=1e-9 * np.abs(k_p).max())
