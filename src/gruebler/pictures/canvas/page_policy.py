"""What an HTML file may do: its content security policy allows its own scripts and styles, nothing from outside."""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Iterable


def script_element(script: str, kind: str = "") -> str:
    """A script as it stands in a page; ``kind`` is ``module`` or nothing."""
    typed = f' type="{kind}"' if kind else ""
    return f"<script{typed}>{_closed(script)}</script>"


def style_rule(sheets: Iterable[str]) -> str:
    """The rule that allows these style sheets and no others.

    >>> style_rule(["p{margin:0}"])[:18]
    "style-src 'sha256-"
    """
    return "style-src " + (" ".join(map(_named, sheets)) or "'none'")


def policy_element(
    *scripts: str,
    sheets: Iterable[str] | None = None,
    webassembly: bool = False,
    beside: bool = False,
    asks: bool = False,
    workers: bool = False,
) -> str:
    r"""The element of a page's head that lets it run these scripts, by their digests, and load nothing at all.

    Args:
        scripts: as given to `script_element`.
        sheets: its style sheets; any, and styles of elements, if None.
        beside: whether it loads scripts from its own folder.
        asks: whether its scripts ask its own server.
        workers: whether its scripts start workers from texts that they hold.
        webassembly: whether its scripts compile WebAssembly that they hold; texts as code stay forbidden.

    >>> policy_element()[:77]
    '<meta http-equiv="Content-Security-Policy" content="default-src \'none\'; style'
    """
    allowed = [_named(_closed(script)) for script in scripts]
    if webassembly:
        allowed.append("'wasm-unsafe-eval'")
    if beside:
        allowed.append("'self'")
    rules = [
        "default-src 'none'",
        *([f"script-src {' '.join(allowed)}"] if allowed else []),
        "style-src 'unsafe-inline'" if sheets is None else style_rule(sheets),
        *(["connect-src 'self'"] if asks else []),
        *(["worker-src blob:"] if workers else []),
        "img-src data: blob:",
        "base-uri 'none'",
        "form-action 'none'",
    ]
    return f'<meta http-equiv="Content-Security-Policy" content="{"; ".join(rules)}">'


def _closed(script: str) -> str:
    """A script that cannot end its element."""
    return script.replace("</script", r"<\/script")


def _named(text: str) -> str:
    """A text as a rule names it: by its digest."""
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode('utf-8')).digest()).decode('ascii')}'"
