"""A cantilever's table in any layout: the campaign that is read from it, and what it is compared with."""

from __future__ import annotations

import csv
import io
from pathlib import Path

import numpy as np
import pytest

from pipeline.campaign import BadCampaign, Campaign, read

HEAD = """schema = 1
name = "bar"

[rig]
kind = "bar"
length_mm = 300.0
reference_temperature_C = 20.0
bar = { EA_N = 1.3e7, EIy_Nmm2 = 1.04215e+08, EIz_Nmm2 = 1.04215e+09, GJ_Nmm2 = 1.56322e+08 }

[noise]
z_mm = 0.0127
fz_N = 0.05
"""
TEST = """
[[tests]]
id = "{id}"
role = "fit"
control = {{ x = "force", y = "force", z = "force", rx = "force", ry = "force", rz = "force" }}
"""
ONE, TWO = TEST.format(id="load"), TEST.format(id="load") + TEST.format(id="again")
Z = np.array([0.0, -0.508, -1.016, -1.524, -2.0828])
FZ = np.array([0.0, -5.0, -10.0, -15.0, -20.0])


def campaign(
    folder: Path, tables: str, content: str | bytes = "", name: str = "measurements.csv", tests: str = ONE
) -> Campaign:
    (folder / "campaign.toml").write_text(HEAD + tables + tests, encoding="utf-8")
    if content:
        (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
    return read(folder)


def table(header: list[str], *columns: np.ndarray | list[str], mark: str = ",") -> str:
    out = io.StringIO()
    writer = csv.writer(out, delimiter=mark, lineterminator="\n")
    writer.writerow(header)
    writer.writerows(zip(*columns, strict=True))
    return out.getvalue()


def assert_agrees(found: Campaign, z: np.ndarray = Z, fz: np.ndarray = FZ, test: int = 0) -> None:
    data = found.tests[test].data
    np.testing.assert_allclose(data.displacement[:, 2], z, rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(data.wrench[:, 2], fz, rtol=1e-12, atol=1e-15)
    others = [k for k in range(6) if k != 2]
    assert np.isnan(data.displacement[:, others]).all() and np.isnan(data.wrench[:, others]).all()
    assert data.steps.tolist() == list(range(len(z)))


def assert_refused(
    folder: Path,
    tables: str,
    content: str | bytes,
    *said: str,
    tests: str = ONE,
    name: str = "measurements.csv",
) -> None:
    with pytest.raises(BadCampaign) as caught:
        campaign(folder, tables, content, name, tests)
    for each in said:
        assert each in str(caught.value)


SIMPLE = """[columns]
"Travel" = {{ is = "z", unit = "{z}" }}
"Load" = {{ is = "fz", unit = "{fz}" }}
"""
