"""A campaign with everything in it, as text that tests change."""

from pathlib import Path

from pipeline.campaign import BadCampaign, read

TOML = """schema = 1
name = "bench-07"

[rig]
kind = "parallelogram"
length_mm = 310.0
width_mm = 80.0
bar = { EA_N = 6.82e6, EIy_Nmm2 = 1.98e8, EIz_Nmm2 = 4.51e7, GJ_Nmm2 = 1.08e7 }
gravity = [0, 0, -2]
line_weight_N_per_mm = 0.003
platform_weight_N = 4.5
reference_temperature_C = 20.0

[noise]
x_mm = 0.001
y_mm = 0.001
z_mm = 0.001
rz_rad = 2e-5
fx_N = 1.0
fy_N = 0.5
mid_mm = 0.002
temperature_C = 0.1

[[gauges]]
name = "mid"
bar = 1
station = 0.5
direction = "-y"

[[tests]]
id = "axial_q+30"
q_deg = 30.0
role = "fit"
control = { x = "displacement", y = "force", z = "displacement", rx = "force", ry = "force", rz = "force" }

[[tests]]
id = "lateral"
q_deg = 0.0
role = "holdout"
control = { x = "force", y = "mid", z = "displacement", rx = "force", ry = "force", rz = "force" }
zero = "first_row"
rig = { length_mm = 250.0 }

[tolerance]
all = "exact"
"""

CSV = """test,step,x_mm,y_mm,z_mm,rz_rad,fx_N,fy_N,mid_mm,temperature_C
axial_q+30,1,0.0,0.0,0.0,0.0,0.0,,0.0,20.5
axial_q+30,2,0.01,0.0003,0.0,-1e-05,430.25,,0.001,20.6
axial_q+30,5,0.02,0.0001,0.0,0.0,861.125,,0.001,
lateral,1,0.0,0.0,0.0,0.0,,0.0,0.0,20.5
lateral,2,-0.001,0.5,0.0,0.001,,9.5,0.25,20.5
"""

BAR = """schema = 1
name = "ruler"
[rig]
kind = "bar"
length_mm = 400.0
bar_stiffness = [
    [4000.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 12.0, 0.0, 0.0, 0.0, -2400.0],
    [0.0, 0.0, 14.0, 0.0, 2800.0, 0.0],
    [0.0, 0.0, 0.0, 900.0, 0.0, 0.0],
    [0.0, 0.0, 2800.0, 0.0, 7.5e5, 0.0],
    [0.0, -2400.0, 0.0, 0.0, 0.0, 6.4e5],
]
base = "pinned"
tip = "guided"
[[tests]]
id = "push"
role = "fit"
control = { x = "force", y = "displacement", z = "force" }
[tolerance]
all = "exact"
"""
BAR_CSV = "test,step,x_mm,y_mm,fx_N,fy_N\npush,0,,0,0,0\npush,1,,1.5,-10,18.5\n"


def laid(folder: Path, toml: str = TOML, csv: str | bytes = CSV) -> Path:
    """The folder with both files."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "campaign.toml").write_text(toml, encoding="utf-8", newline="")
    content = csv if isinstance(csv, bytes) else csv.encode()
    (folder / "measurements.csv").write_bytes(content)
    return folder


def complaint(folder: Path, toml: str, csv: str) -> str:
    """What is said of a campaign; empty if it is accepted."""
    try:
        read(laid(folder, toml, csv))
    except BadCampaign as error:
        return str(error)
    return ""
