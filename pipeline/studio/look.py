"""How the widgets of the studio look, and what their buttons call."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

Actions = Mapping[str, Callable[..., Any]]
STYLE = """
html { overflow-y: auto; } .v-application { font-size: 14px; }
.v-application, .v-btn, .v-field, .v-label, .v-list, .v-tab {
  font-family: system-ui, -apple-system, "Segoe UI", Roboto, sans-serif !important; }
.v-btn { text-transform: none !important; letter-spacing: 0 !important; }
.v-tab { min-width: 0 !important; }
.lead { border-left: 4px solid #0072B2; padding-left: 8px; font-weight: 600; line-height: 1.3; }
.cand td, .cand th { padding: 2px 6px 2px 0; text-align: left; vertical-align: top; font-size: 12.5px; }
.cand td:first-child { width: 100%; }
.num { font-variant-numeric: tabular-nums; white-space: nowrap; }
:focus-visible { outline: 3px solid #E69F00 !important; outline-offset: 1px; }
.shade { height: 9px; width: 150px; background: linear-gradient(90deg, #fee838, #a69d75, #575d6d, #00224e); }
.small, .v-slider .v-label, .v-field__input, .v-label.v-field-label { font-size: 12.5px !important; }
.small { font-size: 12.5px; color: #3d4852; }
h2 { font-size: 14px; line-height: 1.3; margin: 12px 0 4px; }
p { margin: 0 0 4px; }
.value { font-size: 12.5px; }
.sizes td, .sizes th { padding: 1px 14px 1px 0; text-align: left; font-size: 12.5px; vertical-align: bottom; }
.sizes th { position: sticky; top: 0; background: #fff; border-bottom: 1.5px solid #1c2733; }
.sizes .n { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
.weak { font-weight: 700; }
.weak::after { content: " !"; }
.away { height: 0; overflow: hidden; visibility: hidden; }
"""
BUTTON: dict[str, Any] = {
    "density": "compact",
    "variant": "outlined",
    "size": "small",
    "classes": "mr-1 mb-1",
}
FIELD: dict[str, Any] = {"density": "compact", "hide_details": True, "variant": "outlined"}
