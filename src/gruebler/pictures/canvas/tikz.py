"""Figures as pictures of TikZ, for documents in LaTeX: text is set in the font of the document.

A pixel is 1/96 inch, 0.75 bp.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.shapes import ArcShape, CircleShape, Point, Polylines, Shape, TextShape, split_subscripts
from gruebler.pictures.canvas.styles import COLOURS, STYLES

_SPECIAL = {
    **{sign: f"\\{sign}" for sign in "&%$#_{}"},
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
}
_GREEK = (
    "alpha beta gamma delta varepsilon zeta eta theta iota kappa lambda mu nu xi o pi rho varsigma sigma tau upsilon \
varphi chi psi omega"
)
_MATHS = {
    **{chr(0x3B1 + k): rf"$\{name}$" if name != "o" else "$o$" for k, name in enumerate(_GREEK.split())},
    **{sign: f"$^{k}$" for k, sign in enumerate("⁰¹²³⁴⁵⁶⁷⁸⁹")},
    **{chr(0x2080 + k): f"$_{k}$" for k in range(10)},
    **{
        "⁻": "$^-$",
        "ᵢ": "$_i$",
        "ẋ": r"$\dot x$",
        "ẏ": r"$\dot y$",
        "µ": r"$\mu$",
        "√": r"$\surd$",
        "°": r"$^\circ$",
        "−": "$-$",
        "≤": r"$\leq$",
        "≥": r"$\geq$",
        "≈": r"$\approx$",
        "≠": r"$\neq$",
        "·": r"$\cdot$",
        "×": r"$\times$",
        "±": r"$\pm$",
        "∓": r"$\mp$",
        "∩": r"$\cap$",
        "→": r"$\to$",
        "′": "$'$",
        "″": "$''$",
        "∞": r"$\infty$",
        "Γ": r"$\Gamma$",
        "Σ": r"$\Sigma$",
        "Δ": r"$\Delta$",
        "Φ": r"$\Phi$",
        "Ψ": r"$\Psi$",
        "Ω": r"$\Omega$",
        "…": r"\dots{}",
        "\u00a0": "~",
    },
}
_SIGNS = str.maketrans({**_SPECIAL, **_MATHS})


def latex_text(text: str) -> str:
    r"""Text for LaTeX, with subscripts and signs of mathematics.

    >>> latex_text("μ_min = 3° & more")
    '$\\mu$\\textsubscript{min} = 3$^\\circ$ \\& more'
    """
    return "".join(
        rf"\textsubscript{{{piece.translate(_SIGNS)}}}" if low else piece.translate(_SIGNS)
        for piece, low in split_subscripts(text)
    )


def colour_definitions(roles: Iterable[str] = COLOURS) -> list[str]:
    """The colours of pictures, a line each, for the preamble or before a picture."""
    return [rf"\definecolor{{gr{role}}}{{HTML}}{{{COLOURS[role][0][1:].upper()}}}" for role in roles]


def tikz_file(figure: Figure) -> str:
    r"""The picture with its colours, to be read by ``\input`` in a document that loads the package tikz.

    >>> from gruebler.pictures.canvas.figure import figure_of
    >>> print(tikz_file(figure_of([CircleShape(Point(0, 0), 8, "joint")], "a joint", "")))
    % a joint
    \definecolor{grink}{HTML}{22262B}
    \definecolor{grpaper}{HTML}{FFFFFF}
    \begin{tikzpicture}[x=0.750bp,y=-0.750bp,line cap=round,line join=round]
    \useasboundingbox (0,0) rectangle (36.0,36.0);
    \path[draw=grink,line width=1.20bp,fill=grpaper] (18.0,18.0) circle [radius=6.00bp];
    \end{tikzpicture}
    <BLANKLINE>
    """
    styles = {STYLES[shape.style] for shape in figure.shapes}
    roles = sorted({role for style in styles for role in (style.fill, style.stroke) if role})
    return "\n".join([f"% {' '.join(figure.title.split())}", *colour_definitions(roles), tikz(figure), ""])


def tikz(figure: Figure, scale: float = 1.0) -> str:
    """The picture in TikZ; the colours of `colour_definitions` are to be known there."""
    unit = 0.75 * scale
    commands = "\n".join(part for shape in figure.shapes for part in _tikz_shape(shape, unit))
    return (
        f"\\begin{{tikzpicture}}[x={unit:.3f}bp,y=-{unit:.3f}bp,line cap=round,line join=round]\n"
        f"\\useasboundingbox (0,0) rectangle ({figure.width:.1f},{figure.height:.1f});\n"
        f"{commands}\n\\end{{tikzpicture}}"
    )


def _tikz_shape(shape: Shape, unit: float) -> Iterator[str]:
    style = STYLES[shape.style]
    if isinstance(shape, TextShape):
        anchor = {"start": "west", "middle": "center", "end": "east"}[shape.anchor]
        size = style.size * unit
        text = latex_text(shape.text)
        yield (
            f"\\node[anchor={anchor},inner sep=0,text=gr{style.fill},font=\\fontsize{{{size:.1f}}}{{{size * 1.2:.1f}}}"
            f"\\selectfont] at {_place(shape.at)} {{{text}}};"
        )
        return
    options = []
    if style.stroke:
        options.append(f"draw=gr{style.stroke},line width={style.width * unit:.2f}bp")
    if style.fill:
        options.append(f"fill=gr{style.fill}")
    if style.opacity < 1:
        options.append(f"fill opacity={style.opacity:g}")
    if style.dash:
        pairs = zip(style.dash[::2], style.dash[1::2], strict=True)
        options.append("dash pattern=" + " ".join(f"on {on * unit:.1f}bp off {off * unit:.1f}bp" for on, off in pairs))
    path = f"\\path[{','.join(options)}]"
    match shape:
        case Polylines(parts, _, closed):
            for part in parts:
                yield f"{path} {' -- '.join(map(_place, part))}{' -- cycle' if closed else ''};"
        case CircleShape(at, radius):
            yield f"{path} {_place(at)} circle [radius={radius * unit:.2f}bp];"
        case ArcShape():
            steps = max(2, math.ceil(abs(shape.extent) / 0.05))
            yield f"{path} {' -- '.join(_place(shape.place(k / steps)) for k in range(steps + 1))};"


def _place(at: Point) -> str:
    return f"({at.x:.1f},{at.y:.1f})"
