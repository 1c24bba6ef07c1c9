"""A search that several calls of the command line ask for, made once."""

from typing import Any

import pytest

from gruebler.cli import synthesise
from gruebler.design.synthesis import SynthesisResult


def made_once(monkeypatch: pytest.MonkeyPatch, name: str) -> dict[str, SynthesisResult]:
    """Let the command line search by a function of this name once for each task with its demands and options.

    Returns what was found, by what was asked for; how a count of progress is shown does not tell searches apart.
    """
    search, results = getattr(synthesise, name), dict[str, SynthesisResult]()

    def once(*asked: Any, **options: Any) -> SynthesisResult:
        shown = {option: value for option, value in options.items() if option != "progress"}
        key = repr((asked, shown))
        if key not in results:
            results[key] = search(*asked, **options)
        return results[key]

    monkeypatch.setattr(synthesise, name, once)
    return results
