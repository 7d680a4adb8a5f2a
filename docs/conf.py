"""Sphinx: what the documentation is built with. Nothing of a page comes from outside, so that it works offline."""

from __future__ import annotations

import sys
from importlib import metadata
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

project = "parastiff"
release = metadata.version("parastiff")
author = "parastiff"
project_copyright = "the authors of parastiff"
language = "en"

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.mathjax", "docs.made"]
exclude_patterns = ["made"]
source_suffix = {".md": "markdown"}
myst_enable_extensions = ["deflist", "dollarmath", "amsmath"]
myst_heading_anchors = 3
suppress_warnings = ["config.cache"]

# Docstrings are plain text with `code` in single quotes.
default_role = "code"
smartquotes = False
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_preserve_defaults = True
add_module_names = False
toc_object_entries_show_parents = "hide"

html_theme = "furo"
html_title = f"parastiff {release}"
html_css_files = ["own.css"]
html_show_sourcelink = False
html_copy_source = False
html_show_sphinx = False
# A browser lets no page on disk fetch another one for an excerpt.
html_show_search_summary = False

MATHJAX = "tex-svg.js"


def _mathjax() -> str:
    """MathJax in the package that ships it. FileNotFoundError where it has none."""
    files = metadata.distribution("sphinx-mathjax-offline").files or []
    found = next((file for file in files if file.name == MATHJAX), None)
    if found is None:
        raise FileNotFoundError(f"sphinx-mathjax-offline has no {MATHJAX}")
    return str(found.locate())


# MathJax is copied beside the pages. This one has its fonts inside: a browser may refuse fonts of a page on disk.
html_static_path = ["static", _mathjax()]
mathjax_path = MATHJAX
mathjax3_config = {"svg": {"fontCache": "global"}, "options": {"enableMenu": False}}


def _complete(app: Any, failure: Exception | None) -> None:
    """The pictures of the effects, beside the pages."""
    if failure is not None or app.builder.format != "html":
        return
    from docs.made.effects import FOLDER, draw

    draw(Path(app.outdir) / "_static" / FOLDER, app.config.pictures_of or None)


def _signature(app: Any, what: str, name: str, it: Any, options: Any, signature: str, returns: str) -> Any:
    """Without a default that is no Python: Sphinx would show the whole signature as it is."""
    return (signature and signature.replace("<factory>", "...")), returns


def setup(app: Any) -> None:
    """As Sphinx calls it. pictures_of: the one effect of which a picture is drawn, for a quick look."""
    app.add_config_value("pictures_of", "", "")
    app.connect("autodoc-process-signature", _signature)
    app.connect("build-finished", _complete)
