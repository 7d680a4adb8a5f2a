"""Files of parts made for the tests by gmsh's own CAD kernel, and bars of them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import gmsh
import numpy as np

from fem.anisotropic import Regional, in_frame
from fem.material import Isotropic
from fem.part_bar import PartBar
from meshes.brought.child import in_child
from meshes.brought.formats import module_of
from meshes.brought.found import Brought
from meshes.brought.frame import BarFrame, bar_frame
from meshes.gmsh_session import session
from meshes.solid import Floats

ALUMINIUM = Isotropic(70e3, 0.33)


def plane(*at: float, normal: tuple[float, float, float] = (1.0, 0.0, 0.0)) -> dict[str, Any]:
    return {"plane": list(at), "normal": list(normal)}


def bore(*at: float, radius: float, axis: tuple[float, float, float] = (0.0, 1.0, 0.0)) -> dict[str, Any]:
    return {"cylinder": list(at), "axis": list(axis), "radius": radius}


def box() -> None:
    """60 x 6 x 10 mm along x."""
    gmsh.model.occ.addBox(0, -3, -5, 60, 6, 10)


def half_scale_box() -> None:
    """The same, 0.06 x 0.006 x 0.01: in metres."""
    gmsh.model.occ.addBox(0, -0.003, -0.005, 0.06, 0.006, 0.01)


def fork() -> None:
    """An eye of bore 6 mm at x = 0 and a fork with two coaxial bores of 5 mm at x = 60, both about y."""
    occ = gmsh.model.occ
    body = [(3, occ.addBox(0, -4, -6, 60, 8, 12)), (3, occ.addCylinder(0, -4, 0, 0, 8, 0, 6))]
    body += [(3, occ.addCylinder(60, -4, 0, 0, 8, 0, 6))]
    whole, _ = occ.fuse(body[:1], body[1:])
    cuts = [(3, occ.addCylinder(0, -9, 0, 0, 18, 0, 3)), (3, occ.addCylinder(60, -9, 0, 0, 18, 0, 2.5))]
    cuts += [(3, occ.addBox(48, -1.5, -9, 30, 3, 18))]
    occ.cut(whole, cuts)


def two_boxes() -> None:
    """Two solids that touch at x = 30: two materials."""
    gmsh.model.occ.addBox(0, -3, -5, 30, 6, 10)
    gmsh.model.occ.addBox(30, -3, -5, 30, 6, 10)


def apart() -> None:
    """Two solids with a gap."""
    gmsh.model.occ.addBox(0, -3, -5, 30, 6, 10)
    gmsh.model.occ.addBox(31, -3, -5, 29, 6, 10)


def overlapping() -> None:
    """Two solids one of which is partly inside the other."""
    gmsh.model.occ.addBox(0, -3, -5, 30, 6, 10)
    gmsh.model.occ.addBox(29, -3, -5, 31, 6, 10)


def sheet() -> None:
    """A surface and no solid."""
    gmsh.model.occ.addRectangle(0, 0, 0, 60, 10)


def half_fork() -> None:
    """The fork cut along its length: its bores go half round."""
    fork()
    solids = gmsh.model.occ.getEntities(3)
    gmsh.model.occ.cut(solids, [(3, gmsh.model.occ.addBox(-20, -20, 0, 100, 40, 20))])


def tapered() -> None:
    """A cone frustum along x, radii 5 and 3 mm, 60 mm long."""
    gmsh.model.occ.addCone(0, 0, 0, 60, 0, 0, 5, 3)


def hollow() -> None:
    """A tube 60 mm long, radii 5 and 3 mm."""
    occ = gmsh.model.occ
    occ.cut([(3, occ.addCylinder(0, 0, 0, 60, 0, 0, 5))], [(3, occ.addCylinder(0, 0, 0, 60, 0, 0, 3))])


def cad(path: Path, make: Callable[[], None]) -> Path:
    """The part as a CAD file, mm as gmsh writes them."""
    with session("made"):
        gmsh.option.setNumber("General.Verbosity", 0)
        make()
        gmsh.model.occ.synchronize()
        gmsh.write(str(path))
    return path


def brought(
    path: Path,
    base: Any,
    tip: Any,
    unit: str | None = None,
    size: float | None = None,
    seconds: float = 120.0,
    tetrahedra: bool = False,
) -> Brought:
    asked = {
        "path": str(path),
        "unit": unit,
        "size": size,
        "base": base,
        "tip": tip,
        "tetrahedra": tetrahedra,
    }
    return Brought(*in_child(module_of(path), asked, seconds))


def framed(it: Brought) -> BarFrame:
    return bar_frame(it.base.at, it.tip.at, (it.base.axis, it.tip.axis), None)


def bars(it: Brought, material: Isotropic | Regional = ALUMINIUM) -> list[PartBar]:
    """On every mesh, in the bar's frame."""
    frame, bores = framed(it), (it.base.axis is not None, it.tip.axis is not None)
    law = material
    if isinstance(material, Regional):
        law = Regional(tuple(in_frame(m, frame.turn) for m in material.materials), material.of_cell)
    return [PartBar(m.placed(frame.to_bar(m.points)), frame.length, law, bores) for m in it.meshes]


def scaled(k: Floats) -> Floats:
    """(6, 6) by the roots of its diagonal."""
    root = np.sqrt(np.diag(k))
    return np.asarray(k / np.outer(root, root))


def difference(a: Floats, b: Floats) -> float:
    """Largest difference of two 6x6 in shares of the roots of the diagonal."""
    root = np.sqrt(np.diag(b))
    return float(np.abs((a - b) / np.outer(root, root)).max())
