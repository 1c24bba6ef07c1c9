"""The page as one HTML file that needs no server and asks for nothing, and the page that a server sends."""

from __future__ import annotations

import html
import json
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

from gruebler.base.text import message
from gruebler.pictures.canvas.page_policy import policy_element, script_element, style_rule
from gruebler.pictures.canvas.styles import STYLES, USUAL

LISTED_CHAINS = {"links": {"min": 3, "max": 12}, "mobility": {"min": 0, "max": 6}}
"""The chains of which the page makes lists."""

_DESCRIPTION = message(
    "Mechanisms drawn, moved and designed: mobility, coupler curves, dead centres, transmission angles."
)
_LOADING = message("The page is loading")
_STATIC = Path(__file__).parent / "static"
_TOOLS = ("undo", "redo", "open", "save", "link", "theme", "keys")
WHOLE_WINDOW = "html,body,[data-gruebler]{height:100%;margin:0}"


@cache
def module_text(name: str = "explorer") -> str:
    """The front end: one ES module, built from `explorer/` and shipped with the library; or what a static site adds."""
    return (_STATIC / f"{name}.js").read_text(encoding="utf-8")


@cache
def packed_text(name: str) -> str:
    """What the script needs beside it, packed by build.mjs: ``"motion"``, the kernel of motion, or its ``"texts"``."""
    return (_STATIC / f"{name}.txt").read_text(encoding="ascii")


def packed_element(name: str) -> str:
    """The element in which the script finds it."""
    return f'<script type="text/plain" id="gruebler-{name}">{packed_text(name)}</script>'


def picture_styles() -> str:
    """The rules of the library's pictures with the colours of the page, which the reader may turn dark."""
    rules = [".gr{stroke-linecap:round;stroke-linejoin:round}"]
    for name in USUAL:
        style = STYLES[name]
        parts = [f"fill:var(--{style.fill})" if style.fill else "fill:none"]
        if style.stroke:
            parts += [f"stroke:var(--{style.stroke})", f"stroke-width:{style.width:g}"]
        if style.dash:
            parts.append(f"stroke-dasharray:{' '.join(f'{length:g}' for length in style.dash)}")
        if style.opacity < 1:
            parts.append(f"fill-opacity:{style.opacity:g}")
        if style.size:
            parts.append(f"font-size:{style.size:g}px")
        rules.append(f".gr-{name}{{{';'.join(parts)}}}")
    return "".join(rules)


@cache
def page_styles(*more: str) -> str:
    """The style sheet of the page, which a notebook hands to it and other hosts have in their HTML; ``more`` on top."""
    return (
        "".join((_STATIC / f"{name}.css").read_text(encoding="utf-8") for name in ("explorer", *more))
        + picture_styles()
    )


def style_policy() -> str:
    """The rule that allows the style sheets of a page."""
    return style_rule(_sheets())


def _sheets() -> tuple[str, str]:
    return WHOLE_WINDOW, page_styles()


def single_file(model: Mapping[str, Any], lang: str = "") -> str:
    """One HTML file in which a linkage moves and can be dragged; it loads nothing and sends nothing.

    Args:
        model: what `gruebler.page.model.model_of` returns.
        lang: the language in which it opens, the browser's if empty; the reader may choose another.

    The policy in the file allows its own script, by the script's digest, and the WebAssembly in it, and nothing else.

    >>> from gruebler.page.model import model_of
    >>> from gruebler.mechanics.fourbar import FourBar
    >>> page = single_file(model_of(FourBar(25, 70, 40, 70).linkage()))
    >>> page.count("<script"), "fetch(" in page, " src=" in page
    (4, False, False)
    """
    script = module_text()
    values = {"lang": lang, "machine": model}
    policy = policy_element(script, sheets=_sheets(), webassembly=True)
    return _page(lang, "file", values, script_element(script, "module"), policy)


def static_page(
    model: Mapping[str, Any], limits: Mapping[str, Any], classes: Iterable[tuple[int, int]], lang: str = ""
) -> str:
    """The page of a static site; its policy allows the scripts in it and those beside it.

    Args:
        model: what it opens with.
        limits: the chains of which it has lists.
        classes: links and mobility of those lists.
        lang: the language in which it opens, the browser's if empty.
    """
    scripts = (module_text("site"), module_text())
    named = [f"{links}-{mobility}" for links, mobility in classes]
    values = {"lang": lang, "machine": model, "limits": limits, "chains": named}
    elements = "".join(script_element(script, "module") for script in scripts)
    policy = policy_element(*scripts, sheets=_sheets(), webassembly=True, beside=True, workers=True)
    return _page(lang, "site", values, elements, policy)


def served_page(model: Mapping[str, Any], lang: str = "", asked: str = "") -> str:
    """The page of a server, which loads the module from beside it; its policy is sent as a header.

    Until the module is there the page is in the language for which the browser ``asked``, unless ``lang`` is given.
    """
    values = {"lang": lang, "machine": model, "limits": LISTED_CHAINS}
    return _page(lang or asked, "server", values, '<script type="module" src="explorer.js"></script>')


def _page(lang: str, host: str, values: Mapping[str, Any], script: str, policy: str = "") -> str:
    model = values["machine"]
    name = str(model["names"].get(lang or "en") or model["name"] or model["source"])
    title = f"{name} – gruebler" if name else "gruebler"
    tree = shadow_tree(page_styles(), _outline(name, lang, alone=host == "file"))
    script = packed_element("motion") + packed_element("texts") + script
    return data_page(title, lang, values, script, policy, f'<div data-gruebler="{host}">{tree}</div>')


def shadow_tree(sheet: str, outline: str = "") -> str:
    """The element in which the page stands with its style sheet, and what is seen there until the script comes."""
    return (
        '<div class="gruebler-explorer"><template shadowrootmode="open">'
        f"<style>{sheet}</style>{outline}</template></div>"
    )


def _outline(name: str, lang: str, *, alone: bool) -> str:
    """What is seen until the script is there: header, picture, drive and panels in their places, still empty.

    A page that is ``alone`` has one view and no tabs.
    """
    tabs = "" if alone else f"<nav>{6 * '<i></i>'}</nav>"
    tools = "".join(f'<i class="quiet" data-icon="{icon}"></i>' for icon in _TOOLS)
    return (
        f'<div class="app loading"><header><h1>gruebler <small>{html.escape(name)}</small></h1>'
        f'{tabs}<span class="spring"></span>{tools}<i></i></header>'
        '<div class="views"><div class="view motion shown"><div class="stage">'
        f'<progress aria-label="{html.escape(_LOADING.in_language(lang or "en"))}"></progress></div>'
        '<div class="transport"></div><div class="side"></div></div></div></div>'
    )


def data_page(title: str, lang: str, values: Mapping[str, Any], script: str, policy: str, body: str) -> str:
    """A page with data for its script, as high as the window."""
    data = json.dumps(values, ensure_ascii=False, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
    return (
        f'<!doctype html><html lang="{lang or "en"}"><head><meta charset="utf-8">{policy}<style>{WHOLE_WINDOW}</style>'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f'<meta name="description" content="{html.escape(_DESCRIPTION.in_language(lang or "en"))}">'
        '<meta name="referrer" content="no-referrer"><link rel="icon" href="data:,">'
        f"<title>{html.escape(title)}</title></head>"
        f"<body>{body}"
        f'<script type="application/json" id="gruebler-model">{data}</script>{script}</body></html>\n'
    )
