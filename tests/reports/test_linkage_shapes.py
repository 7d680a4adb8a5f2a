"""The bent linkage in the validation report: drawn where its shapes are stored, the same bytes, broken files named."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest
import pyvista

from reports import linkage_shapes
from reports.validation import ReportError, draw
from tests.reports import example


def laid(folder: Path) -> Path:
    """The example with a shape for each critical load: two boxes, bent."""
    example.write(folder)
    for q, held, _ in linkage_shapes.lowest(example.result()):
        boxes = [
            pyvista.ImageData(dimensions=(12, 3, 3), spacing=(28.0, 6.0, 7.0), origin=(0.0, -6.0, z))
            for z in (-47, 33)
        ]
        solid = pyvista.merge([box.cast_to_unstructured_grid() for box in boxes])
        x = np.asarray(solid.points)[:, 0]
        size = 3.1 * np.sin(np.pi * x / example.LENGTH)
        solid.point_data["displacement"] = np.stack([0 * x, size, 0 * x], axis=1)
        solid.point_data["stress"] = 10.0 + 20.0 * np.abs(size)
        path = folder / "modes" / f"linkage_q{q:g}_{'-'.join(held)}.vtu"
        path.parent.mkdir(exist_ok=True)
        solid.save(path)
    return folder


@pytest.mark.long
def test_every_stored_shape_is_in_the_page_with_its_load(tmp_path: Path) -> None:
    folder = laid(tmp_path)
    draw(folder)
    text = (folder / "index.html").read_text(encoding="utf-8")
    shapes = linkage_shapes.read(folder, example.result())
    assert len(shapes) == len(linkage_shapes.lowest(example.result())) > 2
    # Some 9 % of the bars' length, rounded: 0.09 310 / 3.1 = 9.
    assert shapes[0].scale == 9.0 and shapes[0].stress.max() == pytest.approx(72.0, rel=0.01)
    for shape in shapes:
        assert json.dumps(shape.title, ensure_ascii=False)[1:-1] in text
    assert "von Mises stress, MPa" in text and 'id="plot-stress"' in text
    markdown = (folder / "report.md").read_text(encoding="utf-8")
    assert re.search(r"!\[stress\]\(pictures/stress\.png\)", markdown)
    again = linkage_shapes.read(folder, example.result())
    assert linkage_shapes.picture(again) == (folder / "pictures" / "stress.png").read_bytes()
    assert linkage_shapes.figure(again) == linkage_shapes.figure(shapes)


def test_without_shapes_there_is_no_such_figure(tmp_path: Path) -> None:
    folder = example.write(tmp_path)
    draw(folder)
    assert "plot-stress" not in (folder / "index.html").read_text(encoding="utf-8")


@pytest.mark.filterwarnings("ignore:The VTK reader")
def test_a_broken_shape_is_named(tmp_path: Path) -> None:
    folder = laid(tmp_path)
    path = sorted((folder / "modes").iterdir())[0]
    path.write_text("<VTKFile")
    with pytest.raises(ReportError, match=re.escape(path.name)):
        draw(folder)


def test_the_lowest_load_of_each_way_of_holding_counts() -> None:
    result = example.result()
    extra = {**result["critical"][0], "load_N": 0.5 * result["critical"][0]["load_N"]}
    found = linkage_shapes.lowest({"critical": [extra, *result["critical"], extra | {"load_N": 9e9}]})
    assert found[0][2] == abs(extra["load_N"])
