"""The styles of shapes: colours by role, for light and dark ground, and one row for each style.

Outline and hatching distinguish links, never colour alone; the accent (drives, loops) and the colour of motion
(curves, velocities) are the vermilion and the blue of the palette of Okabe and Ito (2008), which differ from grey and
from each other for all kinds of colour vision; green and purple are from it too, darker on light ground. Lines of a
plot also differ by their dashes.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

BAR = 9.0
"""Width of a link."""
LINE = 1.4
"""Width of an outline."""
SLOT = 14.8
"""Width of a slot, for a pin."""
ROD = 5.0
"""Width of the rod of a cylinder."""

# role: on light ground, on dark ground
COLOURS = {
    "paper": ("#ffffff", "#16191d"),
    "ink": ("#22262b", "#dfe3e8"),
    "body": ("#ccd6e2", "#46566b"),
    "frame": ("#f3efe4", "#2f2d27"),
    "faint": ("#8a929c", "#868e99"),
    "accent": ("#d55e00", "#ff8c3a"),
    "motion": ("#0072b2", "#56b4e9"),
    "green": ("#00805e", "#2fc79b"),
    "purple": ("#9b4f83", "#dd9cc4"),
    "grid": ("#dde1e6", "#333a43"),
    "warning": ("#f8e6da", "#402b1f"),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Style:
    """Fill and stroke by role (none where empty), width of the stroke, size of text, dashes, opacity of the fill."""

    fill: str = ""
    stroke: str = ""
    width: float = 0.0
    size: float = 0.0
    dash: tuple[float, ...] = ()
    opacity: float = 1.0


_DASHED, _DOTTED, _MIXED = (7.0, 4.5), (0.5, 4.0), (9.0, 4.0, 0.5, 4.0)

STYLES = {
    "ground": Style(fill="paper"),
    "halo": Style(fill="paper", stroke="paper", width=BAR + 6 * LINE),
    "halo-bar": Style(stroke="paper", width=BAR + 6 * LINE),
    "outline": Style(fill="ink", stroke="ink", width=BAR + 2 * LINE),
    "outline-bar": Style(stroke="ink", width=BAR + 2 * LINE),
    "body": Style(fill="body", stroke="body", width=BAR),
    "body-bar": Style(stroke="body", width=BAR),
    "frame": Style(fill="frame", stroke="frame", width=BAR),
    "frame-bar": Style(stroke="frame", width=BAR),
    "hatch": Style(stroke="ink", width=0.9),
    "hatch-bar": Style(stroke="ink", width=0.9),
    "joint": Style(fill="paper", stroke="ink", width=1.6),
    "ring": Style(stroke="ink", width=1.6),
    "rail": Style(stroke="ink", width=2.6),
    "block": Style(fill="body", stroke="ink", width=1.6),
    "block-frame": Style(fill="frame", stroke="ink", width=1.6),
    "wheel": Style(fill="body", stroke="ink", width=1.4, opacity=0.4),
    "solid": Style(fill="body", opacity=0.4),
    "dot": Style(fill="ink"),
    "drive": Style(stroke="accent", width=2.2),
    "head": Style(fill="accent"),
    "edge": Style(stroke="ink", width=1.8),
    "area": Style(fill="body", stroke="ink", width=1.8),
    "plate": Style(fill="body"),
    "node": Style(fill="paper", stroke="ink", width=1.6),
    "name": Style(fill="ink", size=13),
    "letter": Style(fill="ink", size=11),
    "mark": Style(fill="accent", size=13),
    "note": Style(fill="faint", size=12),
    "outline-wide": Style(stroke="ink", width=SLOT + 9 + 2 * LINE),
    "body-wide": Style(stroke="body", width=SLOT + 9),
    "outline-rod": Style(stroke="ink", width=ROD + 2 * LINE),
    "body-rod": Style(stroke="body", width=ROD),
    "slot-rim": Style(stroke="ink", width=SLOT + 2 * LINE),
    "slot": Style(stroke="paper", width=SLOT),
    "ghost": Style(stroke="faint", width=1.3),
    "ghost-pin": Style(fill="paper", stroke="faint", width=1.2),
    "curve": Style(stroke="motion", width=1.8),
    "curve-rest": Style(stroke="faint", width=1.2),
    "velocity": Style(stroke="motion", width=1.8),
    "velocity-head": Style(fill="motion"),
    "measure": Style(stroke="ink", width=1.1),
    "value": Style(fill="ink", size=12),
    "acceleration": Style(stroke="green", width=1.8),
    "acceleration-head": Style(fill="green"),
    "dimension": Style(stroke="ink", width=0.9),
    "dimension-head": Style(fill="ink"),
    "centrode-fixed": Style(stroke="green", width=1.6),
    "centrode-moving": Style(stroke="purple", width=1.6, dash=_DASHED),
    "inflection": Style(stroke="accent", width=1.5, dash=_DASHED),
    "target": Style(stroke="purple", width=2.2),
    "target-head": Style(fill="purple"),
    "warning": Style(fill="warning"),
    "rest": Style(fill="frame"),
    "grid": Style(stroke="grid", width=1.0),
    "axis": Style(stroke="ink", width=1.2),
    "dead": Style(stroke="faint", width=1.2, dash=_DASHED),
    "tick": Style(fill="ink", size=11),
    "pitch": Style(stroke="ink", width=1.0, dash=_MIXED),
    "ring-body": Style(fill="body", stroke="ink", width=1.4),
    "ring-hole": Style(fill="paper", stroke="ink", width=1.0),
    "help": Style(stroke="faint", width=1.0),
    "new": Style(stroke="accent", width=1.5),
    "given": Style(stroke="ink", width=2.4),
    "line-1": Style(stroke="motion", width=1.9),
    "line-2": Style(stroke="accent", width=1.9, dash=_DASHED),
    "line-3": Style(stroke="green", width=1.9, dash=_DOTTED),
    "line-4": Style(stroke="purple", width=1.9, dash=_MIXED),
    "line-5": Style(stroke="ink", width=1.4),
    "line-6": Style(stroke="motion", width=1.9, dash=_DASHED),
    "line-7": Style(stroke="accent", width=1.9, dash=_DOTTED),
    "line-8": Style(stroke="green", width=1.9, dash=_MIXED),
}
LINES = tuple(name for name in STYLES if name.startswith("line-"))
"""Styles of the lines of a plot, in the order of their use."""

USUAL = tuple(STYLES)
"""Styles of all pictures but those of a textbook."""

# In textbooks: black, one thick line a link, widths in millimetres after ISO 128.
MILLIMETRE = 96 / 25.4
"""Pixels."""
THICK, THIN = 0.7 * MILLIMETRE, 0.35 * MILLIMETRE
UNLIKE_TEXTBOOKS = (
    "body-bar",
    "frame-bar",
    "body",
    "frame",
    "outline-wide",
    "body-wide",
    "outline-rod",
    "warning",
    "rest",
)
_LINK = Style(stroke="ink", width=THICK)
_PLATE = Style(fill="paper", stroke="ink", width=THICK)
_TEXTBOOK_OWN = {
    "outline-bar": _LINK,
    "body-rod": _LINK,
    "outline": _PLATE,
    "halo": Style(stroke="paper", width=THICK + 2 * MILLIMETRE),
    "halo-bar": Style(stroke="paper", width=THICK + 2 * MILLIMETRE),
    "area": _PLATE,
    "rail": _LINK,
    "slot-rim": Style(stroke="ink", width=SLOT + 2 * THIN),
    "slot": STYLES["slot"],
    "grid": STYLES["grid"],
    "given": _LINK,
}
"""Styles whose look is not that of the others: fills white, every coloured line thin and black."""


def _black(style: Style) -> Style:
    """Its dashes and its size of text, lines thin and black; white where a body had a colour."""
    fill = style.fill and ("paper" if style.fill in ("paper", "body", "frame", "warning") else "ink")
    return replace(style, fill=fill, stroke=style.stroke and "ink", width=THIN if style.stroke else 0.0)


TEXTBOOK = "textbook-"
"""Begins the name of each style as textbooks have it: one more row for each that they draw."""
STYLES |= {
    TEXTBOOK + name: _TEXTBOOK_OWN.get(name) or _black(style)
    for name, style in [*STYLES.items()]
    if name not in UNLIKE_TEXTBOOKS
}
