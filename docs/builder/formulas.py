"""Formulas: MathML without any script, also from the indented formulas of the theory pages."""

from __future__ import annotations

import re
import unicodedata
from typing import Any

from docutils import nodes
from docutils.utils.math import MathError, latex2mathml
from sphinx.util import logging

_LOG = logging.getLogger(__name__)
_NAMES = {r"\dots": r"\ldots", r"\operatorname": r"\mathrm", r"\lVert": r"\|", r"\rVert": r"\|"}
_FUNCTIONS = {"sin", "cos", "tan", "cot", "exp", "log", "min", "max", "arg", "det", "gcd", "lim", "ker", "dim"}
_UPRIGHT = {"Re", "Im", "mod", "rank", "conj", "sign", "atan2", "arcsin", "arccos", "arctan"}
_GREEK = {"alpha", "beta", "gamma", "delta", "kappa", "lambda", "phi", "psi", "rho", "sigma", "theta"}
_SMALL = {"at", "by", "if", "in", "is", "of", "on", "or", "to"}
_TOKEN = re.compile(
    r"(?P<gap> {2,})|(?P<space> )|(?P<raised>[⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁽⁾ᵏⁿⁱʲᵐ]+)|(?P<lowered>[₀₁₂₃₄₅₆₇₈₉₊₋ᵢⱼₖₙ]+)"
    r"|(?P<number>\d+(?:\.\d+)?)"
    r"|(?P<word>atan2|[A-Za-zäöüß]{2,}(?:-[A-Za-z]+)*)|(?P<script>[\^_](?:\{[^{}]*\}|\([^()]*\)|-?[A-Za-z0-9α-ω]+|[-+*]))"
    r"|(?P<sign>.)"
)
_ESCAPED = {
    "{": r"\{",
    "}": r"\}",
    "%": r"\%",
    "&": r"\&",
    "#": r"\#",
    "*": r"\ast ",
    "~": r"\sim ",
    "\\": r"\backslash ",
}
_SIGNS = {
    "√": r"\surd ",
    "‾": r"{}^{-}",
    "∎": "",
    "°": r"{}^{\circ}",
    "–": "-",
    "…": r"\ldots ",
    "·": r"\cdot ",
    "∩": r"\cap ",
    "∂": r"\partial ",
    "±": r"\pm ",
}
_SIGNS |= {"∓": r"\mp ", "∪": r"\cup ", "⊂": r"\subset ", "∈": r"\in ", "×": r"\times ", "Σ": r"\sum ", "∞": r"\infty "}
_SIGNS |= {"ᵀ": "^{T}", "≤": r"\le ", "≥": r"\ge ", "≠": r"\ne ", "→": r"\to ", "≡": r"\equiv ", "-": "-", "−": "-"}
_SCRIPT = re.compile(
    r"(?<=[\w)\]|'])\^(?:\{(?P<braced>[^{}]*)\}|(?P<bare>-?\w\b|\([^()]*\)))"
    r"|(?<=\b[A-Za-zΑ-ω])_(?:\{(?P<below>[^{}]*)\}|(?P<letters>[A-Za-z0-9]{1,3})\b)"
)
_NO_FORMULA = re.compile(r'"|gruebler|--|\$|://|\[\w+\]|->| # ')
_IS_CODE = re.compile(r'["\[\]{}]|--|_[A-Za-z]{3,}|[A-Za-z]{2}_')
_IS_FORMULA = re.compile(r"^[a-z]'?$|[=^_√\u0391-\u03c9\u00b2\u00b3\u2080-\u2089]")
_HAS_RELATION = re.compile(r"[=≤≥<>≡∈⊂→]")


def latex_of(line: str) -> str | None:
    """A formula of plain signs as LaTeX; None for what is text.

    >>> latex_of("a e^{iφ} + x₁² = 0")
    'a e^{iφ} + x_{1}^{2} = 0'
    """
    if _NO_FORMULA.search(line):
        return None
    out, words, signs = [], 0, 0
    tokens = [(found.lastgroup, found[0]) for found in _TOKEN.finditer(line.strip())]
    for (_, before), (kind, text), (_, after) in zip(
        [("", ""), *tokens], tokens, [*tokens[1:], ("", "")], strict=False
    ):
        if kind == "gap":
            out.append(r" \qquad ")
        elif kind == "space":
            out.append(r"\ " if _is_text(before) or _is_text(after) else " ")
        elif kind == "word":
            words += _is_text(text)
            out.append(_word(text))
        elif kind in {"raised", "lowered"}:
            plain = unicodedata.normalize("NFKC", text).replace("−", "-")
            out.append(("^" if kind == "raised" else "_") + f"{{{plain}}}")
        elif kind == "script":
            inside = latex_of(text[2:-1] if text[1] in "{(" else text[1:]) or ""
            out.append(f"{text[0]}{{{inside if text[1] != '(' else f'({inside})'}}}")
            signs += 1
        elif kind == "sign":
            out.append(_ESCAPED.get(text, _SIGNS.get(text, text)))
            signs += 1
        else:
            out.append(text)
    return "".join(out) if words <= max(1, signs / 4) else None


def _word(text: str) -> str:
    """A word among formulas: a function, a Greek letter, a product of two letters, or text."""
    if text in _FUNCTIONS | _GREEK:
        return rf"\{text} "
    if text in _UPRIGHT:
        return rf"\mathrm{{{text}}}"
    return rf"\text{{{text}}}" if _is_text(text) else text


def _is_text(word: str) -> bool:
    """Whether a word belongs to the text around formulas."""
    known = word in _FUNCTIONS | _UPRIGHT | _GREEK
    return (
        bool(re.fullmatch(r"[A-Za-zäöüß]{2,}(?:-[A-Za-z]+)*", word)) and not known and (len(word) > 2 or word in _SMALL)
    )


def is_formula(code: str) -> bool:
    """Whether what stands between backticks is a formula, and no name, file or option.

    >>> [is_formula(text) for text in ("P_jk", "ω = θ'", "t = e^{iθ}", "q")]
    [True, True, True, True]
    >>> [is_formula(text) for text in ("R", "left_out", "flat = true", "{ at, teeth = z }", 'belt = "open"', "-o")]
    [False, False, False, False, False, False]
    """
    bare = re.sub(r"[_^]\{[^{}]*\}", "", code)
    if _IS_CODE.search(bare):
        return False
    words = set(re.findall(r"[A-Za-z]{3,}", re.sub(r"[_^]\w+", "", bare)))
    return words <= _FUNCTIONS | _UPRIGHT | _GREEK and bool(_IS_FORMULA.search(code))


def _typeset(app: Any, tree: nodes.document, page: str) -> None:
    """Replace the formulas of theory pages, in running text and as indented blocks."""
    del app
    if not page.startswith("theory/"):
        return
    _set_scripts(tree)
    for code in list(tree.findall(nodes.literal)):
        formula = latex_of(code.astext()) if is_formula(code.astext()) else None
        if formula and _parses(formula) and not isinstance(code.parent, nodes.title):
            code.replace_self(nodes.math(formula, formula))
    for block in list(tree.findall(nodes.literal_block)):
        if block.get("language", "none") not in {"none", "default", "text"}:
            continue
        lines = [line for line in block.astext().splitlines() if line.strip()]
        made = [latex_of(line) for line in lines]
        if not _HAS_RELATION.search(block.astext()) or any(each is None or not _parses(each) for each in made):
            continue
        whole = nodes.container(classes=["formulas"])
        whole += [nodes.math_block(each, each, nowrap=False, number=None) for each in made if each]
        block.replace_self(whole)


def _set_scripts(tree: nodes.document) -> None:
    """Raise exponents and lower indices in running text: `e^{iφ}`, `l_min`."""
    for text in list(tree.findall(nodes.Text)):
        if isinstance(text.parent, nodes.literal | nodes.literal_block | nodes.math | nodes.math_block | nodes.title):
            continue
        made, end, whole = [], 0, text.astext()
        for found in _SCRIPT.finditer(whole):
            made.append(nodes.Text(whole[end : found.start()]))
            inside = next(part for part in found.groups() if part is not None)
            kind = nodes.superscript if found[0].startswith("^") else nodes.subscript
            made.append(kind("", inside))
            end = found.end()
        if made:
            text.parent.replace(text, [*made, nodes.Text(whole[end:])])


def _parses(latex: str) -> bool:
    try:
        mathml(latex, block=True)
    except MathError:
        return False
    return True


def mathml(latex: str, *, block: bool) -> str:
    """A formula in MathML; raises `MathError` for commands of LaTeX that docutils does not know."""
    for name, known in _NAMES.items():
        latex = re.sub(rf"{re.escape(name)}(?![A-Za-z])", lambda _, known=known: known, latex)  # type: ignore[misc]
    return str(latex2mathml.tex2mathml(latex, as_block=block))


def _write(translator: Any, node: nodes.Element, *, block: bool) -> None:
    try:
        translator.body.append(mathml(node.astext(), block=block))
    except MathError as problem:
        _LOG.warning("the formula %r: %s", node.astext(), problem, location=node)
    raise nodes.SkipNode


def _inline(translator: Any, node: nodes.Element) -> None:
    _write(translator, node, block=False)


def _block(translator: Any, node: nodes.Element) -> None:
    _write(translator, node, block=True)


def setup(app: Any) -> None:
    """The renderer `mathml`."""
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))
    app.connect("doctree-resolved", _typeset)
