"""K_b of a bar of one's own, identified on its solid mesh."""

from fem.material import Isotropic
from fem.stiffness import bar_stiffness
from meshes.bar import Bar, Lug
from meshes.resolution import Resolution
from meshes.section import ISection
from meshes.store import mesh_bar

section = ISection(flange_width=12.0, flange_thickness=2.2, height=15.5, web=4.0)
bar = Bar(section, 310.0, Lug(8.0, 12.0, 15.5))
mesh = mesh_bar(bar, Resolution(size=6.0, level=1))
K_b = bar_stiffness(mesh, 310.0, Isotropic(E=70e3, nu=0.33))
print(K_b.round(1))  # 6x6 at the tip: x y z rx ry rz to Fx Fy Fz Mx My Mz
