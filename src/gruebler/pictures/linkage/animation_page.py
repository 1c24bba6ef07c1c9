"""A self-contained page with a moving linkage, with play, pause and a slider for the drive.

The picture is the animated SVG; the script pauses it and sets its clock.
"""

from __future__ import annotations

import math
from typing import Unpack

import numpy as np

from gruebler.mechanics.linkages import Linkage
from gruebler.pictures.canvas.moving_page import PageSettings, moving_page_html
from gruebler.pictures.linkage.animation import AnimationOptions, Scene, scene, svg_of


def animated_page(linkage: Linkage, **options: Unpack[AnimationOptions]) -> str:
    """An HTML page with the moving linkage, a button and a slider; options and errors are those of `animated_svg`.

    It is paused initially for readers who prefer reduced motion.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> page = animated_page(FourBar(25, 70, 40, 70).linkage(), lang="de")
    >>> page.count("<svg"), page.count("<script"), "://" in page.replace("http://www.w3.org/2000/svg", "")
    (1, 1, False)
    """
    shown = scene(linkage, **options)
    return moving_page_html(svg_of(shown), shown.page, _settings(shown), options.get("lang", "en"))


def _settings(shown: Scene) -> PageSettings:
    """The page settings of a scene."""
    posed = shown.posed
    ends = posed.path.drives[[0, -1]]
    rising = np.flatnonzero(ends[1] > ends[0])
    if not len(rising):  # no drive increases along the path: the slider shows the part of the path
        return PageSettings(low=0.0, high=100.0, seconds=shown.seconds, round=False, places=0, unit=" %")
    turning = posed.linkage.mechanism.drives[rising[0]].turning
    low, high = (math.degrees(q) if turning else float(q) for q in ends[:, rising[0]])
    return PageSettings(
        low=round(low, 6),
        high=round(high, 6),
        seconds=shown.seconds,
        round=posed.repeats,
        places=1 if turning else max(0, 2 - math.floor(math.log10(high - low))),
        unit="°" if turning else f" {posed.linkage.unit}".rstrip(),
    )
