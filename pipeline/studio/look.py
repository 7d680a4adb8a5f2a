"""How the widgets of the studio look, and what their buttons call."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

Actions = Mapping[str, Callable[..., Any]]
STYLE = """
html { overflow-y: auto; } .v-application { font-size: 14px; color: #1c2733; }
.v-application, .v-btn, .v-field, .v-label, .v-list, .v-tab {
  font-family: system-ui, -apple-system, "Segoe UI", Roboto, sans-serif !important; }
.v-btn { text-transform: none !important; letter-spacing: 0 !important; }
.v-btn--disabled { opacity: 1 !important; color: #5b6772 !important; border-color: #c6ced5 !important; }
.v-btn--disabled.v-btn--variant-flat { background: #e3e7eb !important; }
.v-btn--disabled .v-btn__overlay { opacity: 0; }
.v-tab { min-width: 0 !important; font-size: 13.5px !important; }
.v-label.v-field-label, .v-label { opacity: 1 !important; color: #4a5661 !important; }
.v-field__input, .v-select__selection-text { opacity: 1 !important; }
.lead { border-left: 5px solid #0072B2; padding-left: 10px; font-weight: 600; font-size: 16px; line-height: 1.3; }
.num { font-variant-numeric: tabular-nums; white-space: nowrap; }
:focus-visible { outline: 3px solid #E69F00 !important; outline-offset: 1px; }
.small, .v-slider .v-label, .v-field__input, .v-label.v-field-label { font-size: 13px !important; }
.small { color: #3d4852; line-height: 1.4; } code { font-size: 11.5px; color: #4a5661; margin-left: 4px; }
h2 { font-size: 14.5px; line-height: 1.3; margin: 14px 0 4px; } h3 { font-size: 14px; margin: 0 0 4px; }
p { margin: 0 0 6px; } ul { padding-left: 18px; margin: 0 0 6px; }
.code { font-family: monospace; overflow-wrap: anywhere; margin: 2px 0; }
.away { height: 0; overflow: hidden; visibility: hidden; }
.work { display: grid; grid-template-columns: 390px minmax(0, 1fr); height: calc(100vh - 53px); }
.left { overflow-y: auto; padding: 10px 14px; border-right: 1px solid #d9dee3; }
.right { min-width: 0; padding: 4px 12px; overflow-y: auto; }
.data { display: grid; gap: 6px 12px; grid-template-columns: minmax(0, 1.6fr) minmax(0, 1fr);
  grid-template-rows: minmax(330px, 1.2fr) minmax(300px, 1fr); height: calc(100vh - 100px); }
.map { grid-column: 1 / -1; } .map, .curve, .scene { display: flex; flex-direction: column; min-height: 0; }
.fill { flex: 1 1 auto; min-height: 0; position: relative; }
.view { flex: 1 1 auto; min-height: 120px; border: 1px solid #d9dee3; }
.row { display: flex; gap: 8px; align-items: center; }
.shade { height: 10px; width: 150px; border: 1px solid #8a949e; }
.grid { border-collapse: collapse; font-size: 13px; width: 100%; }
.grid td, .grid th { padding: 3px 12px 3px 0; text-align: left; vertical-align: top; border-bottom: 1px solid #e3e7eb; }
.grid th { border-bottom: 1.5px solid #1c2733; vertical-align: bottom; background: #fff; }
.grid .n { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
.grid select, .grid input, .plain { border: 1px solid #5b6772; border-radius: 4px; padding: 3px 6px; background: #fff;
  font: inherit; color: #1c2733; min-width: 0; } .grid input { width: 9em; }
select.plain { appearance: auto; } .grid select { appearance: auto; }
#rig, #tolerances { width: auto; } .weak { font-weight: 700; } .weak::after { content: " !"; }
.start { max-width: 1240px; margin: 0 auto; padding: 6vh 20px 20px; overflow-y: auto; height: calc(100vh - 53px); }
.cards { display: grid; gap: 22px; grid-template-columns: repeat(auto-fit, minmax(300px, 1fr)); align-items: stretch; }
.card { border: 1px solid #c6ced5; border-radius: 8px; padding: 16px 18px; gap: 8px; }
.card { display: flex; flex-direction: column; }
.card h2 { font-size: 17px; margin: 0; } .card .push { flex: 1; }
.rivals { display: grid; gap: 12px; grid-template-columns: repeat(auto-fit, minmax(230px, 1fr)); }
.law { display: grid; gap: 12px; grid-template-columns: repeat(auto-fit, minmax(400px, 1fr)); margin-bottom: 12px; }
.rival { border: 1px solid #c6ced5; border-radius: 8px; padding: 10px 12px; } .rival.seen { border: 2px solid #0072B2; }
.warn { border-left: 5px solid #a34700; padding: 4px 10px; background: #fff6ee; margin-bottom: 6px; }
details summary { cursor: pointer; font-weight: 600; color: #005f94; margin: 8px 0 4px; font-size: 13.5px; }
@media (min-width: 1600px) {
  .work { grid-template-columns: 500px minmax(0, 1fr); } .v-application { font-size: 15px; } .lead { font-size: 18px; }
  .small { font-size: 14px !important; } .grid { font-size: 14px; } h2 { font-size: 16px; } }
"""
BUTTON: dict[str, Any] = {
    "density": "compact",
    "variant": "outlined",
    "size": "small",
    "classes": "mr-1 mb-1",
}
MAIN: dict[str, Any] = {**BUTTON, "variant": "flat", "color": "#005f94", "size": "default"}
"""What is most likely to be wanted next."""
FIELD: dict[str, Any] = {"density": "compact", "hide_details": True, "variant": "outlined"}
WIDE: dict[str, Any] = {"display_mode_bar": False, "responsive": True}
"""Of plots."""
