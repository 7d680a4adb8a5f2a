"""Answers about a fit, kept as long as the fit is: the same one is asked about in many places."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from functools import wraps
from typing import Concatenate, ParamSpec, TypeVar
from weakref import WeakKeyDictionary

First = TypeVar("First")
Rest = ParamSpec("Rest")
Answer = TypeVar("Answer")


def kept(
    function: Callable[Concatenate[First, Rest], Answer],
) -> Callable[Concatenate[First, Rest], Answer]:
    """A pure function that remembers its answers, by its first argument and by all others, which are hashable.

    By how they are given: `f(x, a)`, `f(x, a=a)` and, where that is the default, `f(x)` are three answers.
    """
    answers: WeakKeyDictionary[First, dict[Hashable, Answer]] = WeakKeyDictionary()

    @wraps(function)
    def known(first: First, *rest: Rest.args, **named: Rest.kwargs) -> Answer:
        own = answers.setdefault(first, {})
        key = (rest, tuple(sorted(named.items())))
        if key not in own:
            own[key] = function(first, *rest, **named)
        return own[key]

    return known
