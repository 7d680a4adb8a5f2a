"""What a good campaign gives: numbers in their places, overrides merged, remarks where a look is due."""

import re
from dataclasses import fields, is_dataclass
from pathlib import Path
from time import perf_counter

import numpy as np
import pytest

from fem.beam import uniform_stiffness
from pipeline.campaign import BadCampaign, Campaign, read, write
from pipeline.errors import InputError
from tests.pipeline.campaign.example import BAR, BAR_CSV, CSV, TOML, laid

OWN_PLACE = {"folder", "lines", "remarks", "digests"}


def same(a: object, b: object) -> bool:
    """Whether two frozen objects hold the same numbers to the last bit, wherever they come from."""
    if is_dataclass(a) and type(a) is type(b):
        names = [field.name for field in fields(a) if field.name not in OWN_PLACE]
        return all(same(getattr(a, name), getattr(b, name)) for name in names)
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        return a.dtype == b.dtype and np.array_equal(a, b, equal_nan=a.dtype.kind == "f")
    if isinstance(a, tuple) and isinstance(b, tuple):
        return len(a) == len(b) and all(map(same, a, b))
    return bool(a == b) or (a != a and b != b)


def test_numbers_stand_in_their_places(tmp_path: Path) -> None:
    campaign = read(laid(tmp_path))
    axial, lateral = campaign.tests
    assert axial.control == ("displacement", "force", "displacement", "force", "force", "force")
    assert axial.q == np.radians(30.0) and lateral.control[1] == "mid" and lateral.zero == "first_row"
    assert axial.data.steps.tolist() == [1, 2, 5] and axial.data.lines.tolist() == [2, 3, 4]
    assert axial.data.displacement[1, [0, 1, 5]].tolist() == [0.01, 0.0003, -1e-5]
    assert axial.data.wrench[:, 0].tolist() == [0.0, 430.25, 861.125]
    assert np.isnan(axial.data.wrench[:, 1:]).all() and np.isnan(axial.data.displacement[:, 3:5]).all()
    assert axial.data.temperature is not None and np.isnan(axial.data.temperature[2])
    assert lateral.data.gauges.tolist() == [[0.0], [0.25]]
    assert campaign.noise.wrench[0] == 1.0 and np.isnan(campaign.noise.wrench[2])
    assert campaign.gauges[0].vector == (0.0, -1.0, 0.0)
    assert campaign.remarks == ()


def test_inputs_are_what_is_controlled_and_an_empty_force_is_zero(tmp_path: Path) -> None:
    campaign = read(laid(tmp_path))
    axial, lateral = (test.inputs(campaign.gauges) for test in campaign.tests)
    assert axial[:, 0].tolist() == [0.0, 0.01, 0.02] and not axial[:, 1:].any()
    assert lateral[:, 1].tolist() == [0.0, 0.25] and not lateral[:, [0, 2, 3, 4, 5]].any()


def test_a_test_has_its_own_rig(tmp_path: Path) -> None:
    campaign = read(laid(tmp_path))
    axial, lateral = campaign.tests
    assert (axial.rig.length, lateral.rig.length, lateral.rig.width) == (310.0, 250.0, 80.0)
    expected = uniform_stiffness(250.0, 6.82e6, 1.98e8, 4.51e7, 1.08e7)
    np.testing.assert_array_equal(lateral.rig.stiffness, expected)
    assert campaign.rig.down is not None and campaign.rig.down.tolist() == [0.0, 0.0, -1.0]


def test_a_bar_leaves_out_what_its_tip_holds(tmp_path: Path) -> None:
    campaign = read(laid(tmp_path, BAR, BAR_CSV))
    (push,) = campaign.tests
    assert push.control == ("force", "displacement", "force", "held", "held", "held")
    assert push.inputs(())[1].tolist() == [-10.0, 1.5, 0.0, 0.0, 0.0, 0.0]
    assert push.rig.stiffness[1, 5] == -2400.0 and push.data.temperature is None
    assert campaign.remarks == tuple(
        f"campaign.toml, noise.{c}: is missing, so the sigma is estimated" for c in ("y_mm", "fx_N", "fy_N")
    )


@pytest.mark.parametrize("texts", [(TOML, CSV), (BAR, BAR_CSV)])
def test_round_trip_is_exact(texts: tuple[str, str], tmp_path: Path) -> None:
    first = read(laid(tmp_path / "a", *texts))
    write(tmp_path / "b", first)
    second = read(tmp_path / "b")
    assert same(first, second)
    assert sorted(p.name for p in (tmp_path / "b").iterdir()) == ["campaign.toml", "measurements.csv"]


def test_a_test_may_have_a_bar_of_its_own(tmp_path: Path) -> None:
    """A 6x6 for the rigidities of the campaign and the other way round, with a length that goes with it."""
    matrix = [[(1.0 + k) * 1e3 * (k == j) for j in range(6)] for k in range(6)]
    own = TOML.replace("{ length_mm = 250.0 }", f"{{ length_mm = 250.0, bar_stiffness = {matrix} }}")
    first = read(laid(tmp_path / "a", own))
    rig = first.tests[1].rig
    assert rig.bar is None and rig.stiffness.tolist() == matrix and first.tests[0].rig.bar is not None
    uniform = (
        "rig = { bar = { EA_N = 1e6, EIy_Nmm2 = 1e8, EIz_Nmm2 = 1e7, GJ_Nmm2 = 1e7 }, length_mm = 300.0 }"
    )
    second = read(laid(tmp_path / "b", BAR.replace('role = "fit"', f'role = "fit"\n{uniform}'), BAR_CSV))
    assert second.tests[0].rig.bar_stiffness is None and second.tests[0].rig.length == 300.0
    square = BAR[BAR.index("bar_stiffness") : BAR.index("base =")].replace("\n", "")
    both = f'role = "fit"\nrig = {{ length_mm = 401.0, {square.rstrip()} }}'.replace(",]", "]")
    third = read(laid(tmp_path / "c", BAR.replace('role = "fit"', both), BAR_CSV))
    assert third.tests[0].rig.length == 401.0 and third.rig.length == 400.0
    for name, campaign in (("d", first), ("e", second), ("f", third)):
        write(tmp_path / name, campaign)
        assert same(campaign, read(tmp_path / name))


def test_sameness_sees_one_bit(tmp_path: Path) -> None:
    first = read(laid(tmp_path / "a"))
    second = read(laid(tmp_path / "b", csv=CSV.replace("430.25", "430.25000000000006")))
    assert not same(first, second)


def test_random_numbers_come_back_to_the_last_bit(tmp_path: Path) -> None:
    rng = np.random.default_rng(3)
    rows = [f"axial_q+30,{k + 10},{v!r},,0.0,,,,,\n" for k, v in enumerate(rng.normal(size=300).tolist())]
    first = read(laid(tmp_path / "a", csv=CSV + "".join(rows)))
    write(tmp_path / "b", first)
    assert same(first, read(tmp_path / "b"))


def test_a_campaign_is_never_overwritten_unless_told(tmp_path: Path) -> None:
    campaign = read(laid(tmp_path))
    before = (tmp_path / "campaign.toml").read_bytes()
    with pytest.raises(InputError, match=r"campaign\.toml exists"):
        write(tmp_path, campaign)
    assert (tmp_path / "campaign.toml").read_bytes() == before
    write(tmp_path, campaign, overwrite=True)
    assert (tmp_path / "campaign.toml").read_bytes() != before


def test_nothing_is_written_that_could_not_be_read(tmp_path: Path) -> None:
    good = read(laid(tmp_path / "a"))
    holdouts = tuple(test for test in good.tests if test.role == "holdout")
    bad = Campaign(good.name, good.rig, good.noise, good.gauges, holdouts)
    with pytest.raises(ValueError, match='no test has role = "fit"'):
        write(tmp_path / "b", bad)
    assert not (tmp_path / "b").exists()


ACCEPTED = {
    "byte order mark": b"\xef\xbb\xbf" + CSV.encode(),
    "line ends of Windows": CSV.replace("\n", "\r\n").encode(),
    "line ends of old": CSV.replace("\n", "\r").encode(),
    "quotes": CSV.replace("axial_q+30", '"axial_q+30"').replace("430.25", '"430.25"').encode(),
    "blanks": CSV.replace(",", " , ").encode(),
    "blank lines": CSV.replace("\n", "\n\n").encode(),
    "no line end at the end": CSV.rstrip("\n").encode(),
}


@pytest.mark.parametrize("name", ACCEPTED)
def test_habits_of_spreadsheets_change_nothing(name: str, tmp_path: Path) -> None:
    toml = TOML.replace("\n", "\r\n") if "Windows" in name else TOML
    toml = "\ufeff" + toml if "mark" in name else toml
    assert same(read(laid(tmp_path / "a")), read(laid(tmp_path / "b", toml, ACCEPTED[name])))


REMARKS = {
    "sigma missing": ("fx_N = 1.0\n", "", "noise.fx_N: is missing"),
    "sigma of nothing": ("fy_N = 0.5", "fy_N = 0.5\nrx_rad = 1e-5", "noise.rx_rad: is given"),
    "gauge not read": ("[[tests]]", '[[gauges]]\nname="top"\nstation=1\ndirection="x"\n[[tests]]', "'top'"),
}


@pytest.mark.parametrize("name", REMARKS)
def test_what_is_odd_is_accepted_with_a_remark(name: str, tmp_path: Path) -> None:
    old, new, said = REMARKS[name]
    assert old in TOML
    remarks = read(laid(tmp_path, TOML.replace(old, new, 1))).remarks
    assert len(remarks) == 1 and said in remarks[0], remarks


def test_a_test_that_compares_nothing_and_a_large_turn_are_remarked_on(tmp_path: Path) -> None:
    csv = BAR_CSV.replace("-10,18.5", "-10,").replace(",0,0\n", ",0,\n")
    remarks = read(laid(tmp_path / "a", BAR, csv)).remarks
    assert [r for r in remarks if "nothing is compared" in r] == [remarks[-1]]
    csv = "test,step,y_mm,fy_N,rz_rad\npush,0,0,0,0\npush,1,150,18.5,1.2\n"
    free = BAR.replace('"guided"', '"free"').replace('base = "pinned"', "")
    free = free.replace('z = "force"', 'z = "force", rx = "force", ry = "force", rz = "force"')
    remarks = read(laid(tmp_path / "b", free, csv)).remarks
    assert [r for r in remarks if "rz_rad reaches 1.2 rad (69 degrees)" in r] == [remarks[-1]]


def test_a_long_file_is_read_in_seconds(tmp_path: Path) -> None:
    row = "axial_q+30,{},0.012345678,0.0003,0.0,-1e-05,430.25,,0.001,20.6\n"
    csv = CSV + "".join(row.format(k) for k in range(10, 100_010))
    folder = laid(tmp_path, csv=csv)
    start = perf_counter()
    assert any("of 100003 rows" in said for said in read(folder).remarks)
    # About two seconds; a cost that grows with the square of the rows would take hours.
    assert perf_counter() - start < 60.0


def test_a_bar_may_be_given_by_its_section_and_material(tmp_path: Path) -> None:
    """A tube of steel: EA, EI and GJ by hand; its outermost fibres are those of the section."""
    from tests.pipeline.campaign.mapped_tables import HEAD, ONE

    bar = 'section = { kind = "tube", outer_diameter_mm = 16.0, wall_mm = 2.0 }\nmaterial = { E_MPa = 2.1e5, nu = 0.3 }'
    text = re.sub(r"bar = .*", bar, HEAD) + ONE
    (tmp_path / "campaign.toml").write_text(text)
    (tmp_path / "measurements.csv").write_text("test,step,z_mm,fz_N\nload,0,0.0,0.0\nload,1,0.1,2.0\n")
    rig = read(tmp_path).rig
    area, inertia = np.pi * (8.0**2 - 6.0**2), np.pi / 4.0 * (8.0**4 - 6.0**4)
    assert rig.bar is not None
    np.testing.assert_allclose(
        [rig.bar.EA, rig.bar.EIy, rig.bar.EIz], 2.1e5 * np.array([area, inertia, inertia])
    )
    assert pytest.approx(2.1e5 / 2.6 * 2.0 * inertia) == rig.bar.GJ and rig.fibre_y == rig.fibre_z == 8.0
    for old, new, said in (
        ("wall_mm = 2.0", "wall_mm = 9.0", "wall"),
        ("material =", "# material =", "section is given without material"),
        ("length_mm =", "bar_stiffness = [[1.0]]\nlength_mm =", "bar_stiffness"),
    ):
        (tmp_path / "campaign.toml").write_text(text.replace(old, new, 1))
        with pytest.raises(BadCampaign, match=said):
            read(tmp_path)
