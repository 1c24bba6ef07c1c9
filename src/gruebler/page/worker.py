"""A process that answers requests of the page, one after the other: a line of JSON in, lines of JSON out.

With an argument it loads what views first ask for while nobody asks: that takes a second, for which who turns to the
catalog would wait.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from importlib import import_module
from threading import Event, Lock, Thread
from typing import Any

import msgspec

from gruebler.base.errors import GrueblerError
from gruebler.base.text import LANGUAGES, translate
from gruebler.page.requests import answer, error_on_page

_FIRST: tuple[tuple[str, dict[str, Any]], ...] = (
    ("catalog", {}),
    ("picture", {"id": "bennett"}),
    ("picture", {"id": "cam_roller"}),
    ("structure", {"text": "R(0-1) R(1-2) R(2-3) R(3-0)"}),
    # their laws are told once: among the first of the catalog they took half of the time
    ("picture", {"id": "cam_rocker"}),
    ("picture", {"id": "cam_rocker_flat"}),
    ("catalog", {"words": "crank"}),  # in which words are sought
)


_SCREEN = 24
"""Cards of the catalog: more than a window shows."""

_ALONE = Lock()
"""Two threads that import a package at once can find it half made."""


_IDLE = Event()
"""Set while nobody asks: a lock alone is not given to who has waited longest."""
_IDLE.set()


def answered(method: str, params: dict[str, Any], lang: str, progress: Callable[[str], None]) -> Any:
    """`answer` while no other thread does."""
    with _ALONE:
        return answer(method, params, lang, progress)


def load() -> None:
    """Load the modules that the catalog, its pictures, structures, designs and forces need. Cost: 1 s.

    Then draw the pictures with which the catalog begins: 0.6 s for each language.
    """
    for method, params in _FIRST:
        _ahead(method, params)
    with _ALONE:
        import_module("gruebler.page.designs")  # 0.3 s
    _IDLE.wait()
    with _ALONE:
        import_module("gruebler.page.forces")  # 0.3 s
    for lang in LANGUAGES:
        machines = _ahead("catalog", {}, lang) or ()
        for machine in sorted(machines, key=lambda each: str(each["name"]).casefold())[:_SCREEN]:
            _ahead("picture", {"id": machine["id"]}, lang)


def _ahead(method: str, params: dict[str, Any], lang: str = "en") -> Any:
    """Answer what nobody asks yet; a request that waits goes first."""
    _IDLE.wait()
    return answered(method, params, lang, lambda _: None)


def main() -> None:
    """Answer until standard input ends; what anything prints goes to standard error."""
    stream = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())

    if len(sys.argv) > 1:
        Thread(target=load, daemon=True).start()

    def say(kind: str, content: Any) -> None:
        stream.write(msgspec.json.encode([kind, content]) + b"\n")
        stream.flush()

    for line in sys.stdin.buffer:
        method, params, lang = msgspec.json.decode(line)
        say("begun", None)
        _IDLE.clear()
        try:
            result = answered(method, params, lang, lambda text: say("progress", text))
        except GrueblerError as error:
            say("error", error_on_page(error, lang))
        except RecursionError:
            say("error", translate("the request is nested too deeply", lang))
        else:
            say("result", result)
        finally:
            _IDLE.set()


if __name__ == "__main__":
    main()
