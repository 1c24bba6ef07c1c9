"""Formulas: MathML without any script, also from the indented formulas of the theory pages."""

from __future__ import annotations

from typing import Any

from docutils import nodes
from docutils.utils.math import latex2mathml


def mathml(latex: str, *, block: bool) -> str:
    """A formula in MathML."""
    return str(latex2mathml.tex2mathml(latex, as_block=block))


def _inline(translator: Any, node: nodes.math) -> None:
    translator.body.append(mathml(node.astext(), block=False))
    raise nodes.SkipNode


def _block(translator: Any, node: nodes.math_block) -> None:
    translator.body.append(mathml(node.astext(), block=True))
    raise nodes.SkipNode


def setup(app: Any) -> None:
    """The renderer `mathml`."""
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))
