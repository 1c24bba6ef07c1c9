"""The page of a linkage in space as one HTML file: bodies that move, seen from all sides, without a server."""

from __future__ import annotations

from typing import Any

import numpy as np

from gruebler.base.text import message
from gruebler.files.gltf import link_colour, moving_solids, united
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.page.page import data_page, module_text
from gruebler.pictures.canvas.page_policy import policy_element, script_element
from gruebler.structure.chain.spaces import Space

_WORDS = {
    "play": message("Play"),
    "stop": message("Stop"),
    "drive": message("Drive"),
    "help": message(
        "Drag beside the bodies to go round them, drag a body to pull it along; its point then draws its path. "
        "Wheel: nearer and farther."
    ),
    "none": message("No drive moves this linkage."),
}


def space_model(
    linkage: SpatialLinkage, *, name: str = "", lang: str = "en", between: tuple[float, float] | None = None
) -> dict[str, Any]:
    """What the page shows: bodies, the poses of all links over the range of each drive, named points."""
    moving = moving_solids(linkage, between=between)
    chain = linkage.mechanism.chain
    bodies = []
    for number, link in enumerate(chain.links):
        solids = moving.solids[link]
        whole = united(solids) if solids else None
        bodies.append(
            {
                "name": link,
                "colour": link_colour(number),
                "vertices": [] if whole is None else _numbers(whole.vertices),
                "triangles": [] if whole is None else whole.triangles.ravel().tolist(),
            }
        )
    drives = dict(zip(linkage.mechanism.drive_names(), linkage.mechanism.drives, strict=True))
    spherical = chain.space is Space.SPHERICAL
    return {
        "title": name or str(chain),
        "words": {key: text.in_language(lang) for key, text in _WORDS.items()},
        "middle": [0.0, 0.0, 0.0] if spherical else linkage.centre.tolist(),
        "size": 1.0 if spherical else linkage.size,
        "bodies": bodies,
        "points": [{"name": key, "link": chain.index(link), "at": at} for key, (link, at) in linkage.points.items()],
        "motions": [
            {
                "name": drive,
                "round": full,
                "unit": "°" if drives[drive].turning else f" {linkage.unit}",
                "values": _numbers(
                    np.degrees(motion.drives[:, k]) if drives[drive].turning else motion.drives[:, k],
                ),
                "poses": [[_numbers(pose[:3]) for pose in row] for row in motion.poses[0]],
            }
            for drive, k, motion, full in moving.named()
        ],
    }


def _numbers(values: Any) -> list[float]:
    """With six digits."""
    return [float(f"{value:.6g}") for value in np.asarray(values).ravel().tolist()]


def space_file(model: dict[str, Any], lang: str = "en") -> str:
    """One HTML file that loads nothing: its policy allows its own script only."""
    script = module_text("space")
    policy = policy_element(script, styles=False)
    return data_page(str(model["title"]), lang, model, script_element(script, "module"), policy)
