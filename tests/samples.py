"""Linkages that several tests look at."""

import math

from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.structure.chain import Chain
from gruebler.structure.mechanism import Mechanism

Place = tuple[float, float, float]

_THREE_LEGS = "R(0-1) R(1-2) R(2-h) R(0-3) R(3-h) R(0-4) R(4-h); frame=0; drive=R(0-1)"


def class_iii(*places: tuple[float, float]) -> Linkage:
    """A three-legged group on a crank, drawn."""
    return Linkage.from_drawing(Mechanism.parse(_THREE_LEGS), dict(enumerate(places)))


def placed_loop(kinds: str, *places: tuple[Place, Place | None], driven: int = 0) -> SpatialLinkage:
    """A loop of joints, the first at the frame, by their points and axes; balls need none."""
    links = ["frame", *"abcdefg"[: len(kinds) - 1], "frame"]
    text = " ".join(f"{kind}({links[k]}-{links[k + 1]})" for k, kind in enumerate(kinds))
    axes = [
        {} if axis is None or kind == "S" else {"x" if kind == "P" else "z": axis}
        for kind, (_, axis) in zip(kinds, places, strict=True)
    ]
    joints: dict[str | int, object] = {k: {"at": at} | axes[k] for k, (at, _) in enumerate(places)}
    return SpatialLinkage(Mechanism(Chain.parse(f"spatial: {text}"), "frame", [driven]), joints)


def parallel_legs(high: float = 3.0, error: float = 0.0) -> Linkage:
    """Three equal parallel cranks carry a plate: a change point wherever they lie along two of the plate's pins.

    With the third pin in line too (`high` 0.8) two ranks are lost there at once.
    """
    return class_iii((0, 0), (0.6, 0.8), (2.6, high), (4 + error, 0), (4.6, 0.8), (7, 0), (7.6, 0.8))


CLASS_III = class_iii((0, 0), (0.5, 0.3), (2, 2), (5, 0), (4, 2.2), (2, 5.5), (3, 3.5))
"""A six-bar that ends inside, at 97.5252475 degrees."""
CYLINDER = Linkage.from_drawing(
    Mechanism.parse("R(0-1) R(0-4) R(4-2) P(1-2); frame=0; drive=P(1-2)"),
    {"R(0-1)": (0, 0), "R(4-2)": (3, 2), "P(1-2)": (0, 0, math.atan2(2, 3)), "R(0-4)": (4, 0)},
)
"""A cylinder drives a crank."""
