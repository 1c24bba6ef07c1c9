"""How shapes look: colours by role, for light and dark ground, and one row for each style.

Links are told apart by outline and hatching, never by colour alone; the accent (drives, loops) and the colour of motion
(curves, velocities) are the vermilion and the blue of the palette of Okabe and Ito (2008), which all kinds of colour
vision tell from grey and from each other.
"""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["BAR", "COLOURS", "LINE", "ROD", "SLOT", "STYLES", "Style"]

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
}


class Style(NamedTuple):
    """Fill and stroke by role (none where empty), width of the stroke, size of text."""

    fill: str = ""
    stroke: str = ""
    width: float = 0.0
    size: float = 0.0


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
    "joint": Style(fill="paper", stroke="ink", width=1.6),
    "ring": Style(stroke="ink", width=1.6),
    "rail": Style(stroke="ink", width=2.6),
    "block": Style(fill="body", stroke="ink", width=1.6),
    "block-frame": Style(fill="frame", stroke="ink", width=1.6),
    "dot": Style(fill="ink"),
    "drive": Style(stroke="accent", width=2.2),
    "head": Style(fill="accent"),
    "edge": Style(stroke="ink", width=1.8),
    "area": Style(fill="body", stroke="ink", width=1.8),
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
}
