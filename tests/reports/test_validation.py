"""The report is complete, self-contained, stable, and complains in one sentence."""

import json
import re
import shutil
import subprocess
from collections.abc import Callable
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest

from pipeline.validation.result import Result
from reports.validation import ReportError, draw
from tests.reports import example

TITLES = (
    "Findings",
    "The linkage (Fig. 1)",
    "The bar and its stiffness (Eq. 12)",
    "Convergence",
    "Buckling of the bar (Fig. 2)",
    "Stiffness of the parallelogram (Eqs. 11 and 13)",
    "Critical loads of the parallelogram",
    "Force and deflection (Fig. 3)",
    "Errata of the paper",
    "How to read this report",
)
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")


class Page(HTMLParser):
    """What a page loads, shows as text, and has as headings."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.loads: list[str] = []
        self.headings: list[str] = []
        self.scripts: list[str] = []
        self.ids: list[str] = []
        self._open: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        found = dict(attrs)
        source = found.get("href") if tag == "link" else found.get("src")
        if source is not None:
            self.loads.append(source)
        if found.get("id"):
            self.ids.append(str(found["id"]))
        if tag in ("h2", "script"):
            self._open.append(tag)
            (self.headings if tag == "h2" else self.scripts).append("")

    def handle_endtag(self, tag: str) -> None:
        if self._open and self._open[-1] == tag:
            self._open.pop()

    def handle_data(self, data: str) -> None:
        if self._open:
            (self.headings if self._open[-1] == "h2" else self.scripts)[-1] += data


@pytest.fixture(scope="module")
def drawn(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[Path]]:
    folder = example.write(tmp_path_factory.mktemp("report"), shapes=True)
    return folder, draw(folder)


@pytest.fixture(scope="module")
def text(drawn: tuple[Path, list[Path]]) -> str:
    return (drawn[0] / "index.html").read_text(encoding="utf-8")


def test_the_example_is_a_valid_result() -> None:
    made = example.result()
    assert Result.model_validate(made).case == made["case"]


def test_all_files_are_drawn(drawn: tuple[Path, list[Path]]) -> None:
    folder, files = drawn
    pictures = [
        "linkage",
        "bar",
        "convergence",
        "force_deflection",
        "agreement",
        *(f"modes_{s}" for s in example.SUPPORTS),
    ]
    expected = {f"pictures/{name}.png" for name in pictures} | {"index.html", "report.md"}
    assert {path.relative_to(folder).as_posix() for path in files} == expected
    on_disk = {p.relative_to(folder).as_posix() for p in folder.rglob("*") if p.is_file()}
    assert on_disk == expected | {"result.json", *(f"modes/{s}.vtu" for s in example.SUPPORTS)}
    assert all(p.read_bytes().startswith(b"\x89PNG") for p in files if p.suffix == ".png")


@pytest.mark.long
def test_the_same_result_gives_the_same_bytes(drawn: tuple[Path, list[Path]]) -> None:
    folder, files = drawn
    first = {path: path.read_bytes() for path in files}
    draw(folder)
    assert [path.name for path, content in first.items() if path.read_bytes() != content] == []


def test_every_section_has_its_heading(drawn: tuple[Path, list[Path]], text: str) -> None:
    assert tuple(Page(text).headings) == TITLES
    markdown = (drawn[0] / "report.md").read_text(encoding="utf-8")
    assert tuple(re.findall(r"^## (.*)$", markdown, re.MULTILINE)) == TITLES


def test_the_page_loads_nothing_from_outside_and_is_small(text: str) -> None:
    page = Page(text)
    assert page.loads and all(source.startswith("data:image/png") for source in page.loads)
    assert "@import" not in text.split("</style>")[0]
    assert len(text.encode()) < 8e6
    assert sum(script.count("plotly.js v") for script in page.scripts) == 1


def test_plots_and_sections_have_fixed_and_single_names(text: str) -> None:
    ids = Page(text).ids
    plots = {"convergence", "critical", "force_deflection", "force_deflection_2", "shapes"}
    assert {f"plot-{name}" for name in plots} <= set(ids)
    assert len(ids) == len(set(ids))


def test_text_of_the_result_is_escaped(drawn: tuple[Path, list[Path]], text: str) -> None:
    assert "&lt;script&gt;alert(&#39;story&#39;)" in text
    assert "<b>not bold</b>" not in text
    assert not any("alert('story')" in script for script in Page(text).scripts)
    markdown = (drawn[0] / "report.md").read_text(encoding="utf-8")
    assert set(re.findall(r"(.)<(?:/?script|/?b)>", markdown)) == {"\\"}
    assert r"R_y(-q_i2) \| moving" in markdown


def test_hostile_labels_do_not_leave_a_plot(tmp_path: Path) -> None:
    data = example.result()
    for item in data["critical"] + data["curves"]:
        item["held"] = ["</script><img src=x onerror=alert(1)>"]
    draw(example.write(tmp_path, data))
    page = Page((tmp_path / "index.html").read_text(encoding="utf-8"))
    assert all(source.startswith("data:") for source in page.loads)


def test_numbers_of_the_result_are_on_the_page(text: str) -> None:
    plain = re.sub(r"<[^>]+>", "", text[text.index("</script>") :])
    for shown in ("\u22122896.8", "+2.00", "2\u202f713\u202f200", "\u221212.30", "none up to 50.0 kN"):
        assert shown in plain


def test_every_number_of_the_solid_has_its_error(text: str) -> None:
    """K_b and its derivative, buckling, critical loads, paths: a column or a note in each table."""
    plain = re.sub(r"<[^>]+>", "", text[text.index("</script>") :])
    assert plain.count("mesh error ±%") == 5 and plain.count("±0.70 %") == 6
    assert "known to 1.2 to 1.2 %" in plain and "−39\u202f375.0" in plain
    assert "K_g, what 1 N of axial force adds" in plain and "elements a bar: 8, 16, 32" in plain


def test_a_result_of_an_earlier_version_is_drawn(tmp_path: Path) -> None:
    """One without axial stiffness, refinement and agreement."""
    data = example.result()
    for key in ("axial", "solve"):
        del data["bar"][key]
    del data["refinement"], data["agreement"]
    draw(example.write(tmp_path, data))
    text = (tmp_path / "report.md").read_text(encoding="utf-8")
    assert "K_g" not in text and "agreement.png" not in text


def test_markdown_pictures_exist_and_tables_are_rectangular(drawn: tuple[Path, list[Path]]) -> None:
    folder, _ = drawn
    markdown = (folder / "report.md").read_text(encoding="utf-8")
    links = re.findall(r"!\[[^\]]*\]\(([^)]+)\)", markdown)
    assert len(links) == 7 and all((folder / link).is_file() for link in links)
    for block in re.findall(r"(?:^\|.*\n)+", markdown, re.MULTILINE):
        widths = {len(re.findall(r"(?<!\\)\|", line)) for line in block.splitlines()}
        assert len(widths) == 1


def test_without_shapes_the_earlier_pictures_stay(tmp_path: Path) -> None:
    folder = example.write(tmp_path)
    kept = folder / "pictures" / "modes_free.png"
    kept.parent.mkdir()
    kept.write_bytes(b"\x89PNG earlier")
    assert kept not in draw(folder)
    assert kept.read_bytes() == b"\x89PNG earlier"
    text = (folder / "index.html").read_text(encoding="utf-8")
    assert "not stored beside this result (modes/free.vtu, modes/guided.vtu)" in text
    assert "plot-shapes" not in text
    assert "pictures/modes_free.png" in (folder / "report.md").read_text(encoding="utf-8")
    assert "pictures/modes_guided.png" not in (folder / "report.md").read_text(encoding="utf-8")


def drop(*path: str | int) -> Callable[[dict[str, Any]], None]:
    """Remove one key of the result."""

    def edit(data: Any) -> None:
        for step in path[:-1]:
            data = data[step]
        del data[path[-1]]

    return edit


@pytest.mark.parametrize(
    ("edit", "complaint"),
    [
        (drop("curves"), "the file lacks the key 'curves'"),
        (drop("bar", "convergence", "band"), "bar.convergence lacks the key 'band'"),
        (drop("critical", 3, "why"), "critical[3] lacks the key 'why'"),
        (lambda data: data.update(bar=[]), "bar is a list, allowed is an object"),
        (lambda data: data.update(errata=None), "errata is null, allowed is a list"),
        (lambda data: data["bar"].update(stiffness=7), "is not laid out as a result"),
    ],
)
def test_a_bad_result_is_one_sentence(tmp_path: Path, edit: Callable[[Any], None], complaint: str) -> None:
    data = example.result()
    edit(data)
    folder = example.write(tmp_path, data)
    with pytest.raises(ReportError) as caught:
        draw(folder)
    message = str(caught.value)
    assert complaint in message and str(folder / "result.json") in message and "\n" not in message
    assert [p.name for p in folder.iterdir()] == ["result.json"]


@pytest.mark.parametrize(("content", "complaint"), [(None, "does not exist"), ("{", "is not JSON")])
def test_a_missing_or_broken_file_is_one_sentence(
    tmp_path: Path, content: str | None, complaint: str
) -> None:
    if content is not None:
        (tmp_path / "result.json").write_text(content)
    with pytest.raises(ReportError, match=complaint) as caught:
        draw(tmp_path)
    assert "result.json" in str(caught.value)


@pytest.mark.filterwarnings("ignore:The VTK reader")
def test_a_broken_shape_file_is_named(tmp_path: Path) -> None:
    folder = example.write(tmp_path)
    (folder / "modes").mkdir()
    (folder / "modes" / "free.vtu").write_text("<VTKFile")
    with pytest.raises(ReportError, match=r"free\.vtu"):
        draw(folder)


def test_a_bar_without_paper_lugs_or_fit_is_drawn(tmp_path: Path) -> None:
    data = example.result()
    data["bar"] |= {"paper": None, "worst_entry_error": None, "lug": None, "fit": None}
    data["bar"]["section"] = {"kind": "tube", "outer_diameter_mm": 20.0, "wall_mm": 2.0}
    Result.model_validate(json.loads(json.dumps(data)))
    draw(example.write(tmp_path, data))
    page = Page((tmp_path / "index.html").read_text(encoding="utf-8"))
    assert page.headings == list(TITLES)


@pytest.mark.skipif(CHROMIUM is None, reason="chromium is not installed")
def test_a_browser_reports_no_error(drawn: tuple[Path, list[Path]], tmp_path: Path) -> None:
    command = [str(CHROMIUM), "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr"]
    command += ["--enable-unsafe-swiftshader", f"--user-data-dir={tmp_path}", "--virtual-time-budget=5000"]
    url = (drawn[0] / "index.html").as_uri()
    run = subprocess.run(
        [*command, "--dump-dom", url], capture_output=True, text=True, timeout=120, check=True
    )
    console = [line for line in run.stderr.splitlines() if "CONSOLE" in line]
    # Remarks on speed come from plotly's own canvas and from a browser without a graphics card.
    remarks = ("GL Driver Message", "Canvas2D: Multiple readback")
    assert [line for line in console if not any(remark in line for remark in remarks)] == []
    assert run.stdout.count("main-svg") >= 5


def test_without_libegl_the_package_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(name: str) -> None:
        raise OSError(name)

    monkeypatch.setattr("reports.shapes.ctypes.CDLL", missing)
    monkeypatch.setattr("reports.shapes.sys.platform", "linux")
    with pytest.raises(ReportError, match="libegl1"):
        draw(example.write(tmp_path, shapes=True))
