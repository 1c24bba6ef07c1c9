"""What the synthesis of a static site stands on: a script for a worker, stored solutions, the model of a four-bar.

`explorer/src/points` follows the solutions and moves what they give; docs/theory/explorer.md.
"""

from __future__ import annotations

import base64
from collections.abc import Iterator
from typing import Any

import numpy as np

from gruebler.base.text import LANGUAGES, Message, message
from gruebler.design.synthesis.alt_burmester import PROBLEMS, stored_solutions
from gruebler.design.synthesis.dyad_linkages import linkage_of_dyads
from gruebler.design.synthesis.dyads import CRANK, GuidingDyad
from gruebler.design.synthesis.finite_points import ON_CIRCLE, ON_LINE, UNRESOLVED
from gruebler.design.synthesis.tasks import EQUAL_POINTS
from gruebler.mechanics.fourbar import FourBar
from gruebler.page.design_words import BALANCED, BEST, EXACT, NONE
from gruebler.page.designs import capitalised
from gruebler.page.model import link_names, model_of
from gruebler.page.page import module_text

NINE_POINTS = PROBLEMS[0]


def point_packs() -> Iterator[tuple[str, Any]]:
    """The pack of the worker, and that of the stored solutions for nine points.

    >>> packs = dict(point_packs())
    >>> packs["points"]["template"]["points"][0]["name"], len(packs["nine_points"]["task"])
    ('P', 64)
    """
    double_crank = FourBar(2, 2, 2, 1).linkage()
    first, other = GuidingDyad(CRANK, 1 + 2j, 0j), GuidingDyad(CRANK, 5 + 3j, 4 + 0j)
    texts: dict[str, Message] = {
        "form": message("four-bar"),
        "balanced": BALANCED,
        "best": BEST.filled(count="{count}"),
        "none": NONE,
        "exact": EXACT,
        "progress": message("{done} of {total} solutions followed", done="{done}", total="{total}"),
        "complete": message(
            "Of the {classes} solutions of nine points {real} are real, each of them three cognates.",
            classes=NINE_POINTS.classes,
            real="{real}",
        ),
        "missing": UNRESOLVED.filled(count="{count}"),
        "equal": EQUAL_POINTS.filled(first="{first}", second="{second}"),
        "line": ON_LINE.filled(count="{count}", most="{most}"),
        "circle": ON_CIRCLE.filled(count="{count}", most="{most}"),
    }
    yield (
        "points",
        {
            "script": module_text("points"),
            "template": model_of(linkage_of_dyads(first, other, 3 + 4j, "mm"))
            | {"doubleCrank": {lang: list(link_names(double_crank, "", lang).values()) for lang in LANGUAGES}},
            "texts": {
                lang: {key: capitalised(text.in_language(lang)) for key, text in texts.items()} for lang in LANGUAGES
            },
        },
    )
    task, solutions = stored_solutions(NINE_POINTS)
    numbers = np.ascontiguousarray(solutions, np.complex64).view(np.float32).astype("<f4")
    yield (
        "nine_points",
        {
            "task": task.view(np.float64).ravel().tolist(),
            "solutions": base64.b64encode(numbers.tobytes()).decode("ascii"),
        },
    )
