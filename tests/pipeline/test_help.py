"""Help of every command: a word in brackets would be taken for markup and left out."""

from __future__ import annotations

import pytest

from pipeline.cli import app

TEXTS = {it.callback.__name__: it.callback.__doc__ or "" for it in app.registered_commands if it.callback}


@pytest.mark.parametrize("command", TEXTS)
def test_no_word_is_taken_for_markup(command: str) -> None:
    assert TEXTS[command] and "[" not in TEXTS[command]
