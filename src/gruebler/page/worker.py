"""A process that answers requests of the page, one after the other: a line of JSON in, lines of JSON out."""

from __future__ import annotations

import os
import sys
from typing import Any

import msgspec

from gruebler.base.errors import GrueblerError
from gruebler.base.text import translate
from gruebler.page.requests import answer, error_on_page


def main() -> None:
    """Answer until standard input ends; what anything prints goes to standard error."""
    stream = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())

    def say(kind: str, content: Any) -> None:
        stream.write(msgspec.json.encode([kind, content]) + b"\n")
        stream.flush()

    for line in sys.stdin.buffer:
        method, params, lang = msgspec.json.decode(line)
        say("begun", None)
        try:
            result = answer(method, params, lang, lambda text: say("progress", text))
        except GrueblerError as error:
            say("error", error_on_page(error, lang))
        except RecursionError:
            say("error", translate("the request is nested too deeply", lang))
        else:
            say("result", result)


if __name__ == "__main__":
    main()
