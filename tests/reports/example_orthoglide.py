"""A made-up Table 1 with few cells: numbers that no run has, so that the page can only have them from here."""

from __future__ import annotations

from typing import Any


def table() -> dict[str, Any]:
    """One record as it stands in result.json under "orthoglide"."""
    return {
        "unknowns": [
            {
                "name": "drive <along> its axis",
                "value": 4321.0,
                "unit": "N/mm",
                "low": 1e3,
                "high": 1e5,
                "at_bound": False,
                "cell": "solid axis, VJM, K_tran",
            }
        ],
        "cells": [
            cell("solid axis", "vjm", "K_tran", 3230.0, 3230.0, True),
            cell("solid axis", "fea", "K_tran", 3111.0, 3330.0, False),
            cell("2x-bar", "fea", "K_rot", 6.543e4, None, False),
        ],
        "readings": [
            {
                "reading": "2 K_b between universal joints",
                "moves": True,
                "K_tran": 3230.0,
                "K_tran_held": 3230.0,
                "K_rot": 6.822e4,
                "K_tran_over_parallelogram": 1.0 + 3e-12,
                "K_tran_held_over_parallelogram": 1.0234,
                "parallelogram_over_K_rot": 63.46,
            }
        ],
        "agreement": [{"linkage": "solid axis", "postures": 5, "K_tran": 1.2e-13, "K_rot": 3.4e-3}],
        "findings": [{"statement": "Flexible axes lower both.", "holds": True, "found": "K_tran -4.6 %"}],
        "source": "the paper",
    }


def cell(
    linkage: str, model: str, quantity: str, ours: float, paper: float | None, fitted: bool
) -> dict[str, Any]:
    """A cell with its deviation."""
    return {
        "linkage": linkage,
        "model": model,
        "quantity": quantity,
        "ours": ours,
        "paper": paper,
        "deviation": None if paper is None else ours / paper - 1.0,
        "fitted": fitted,
    }
