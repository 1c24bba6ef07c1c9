"""Linkages that the tests of this room move."""

from math import atan2

import numpy as np

from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism

SIX_BAR = Linkage.from_drawing(
    Mechanism.parse("R(0-1) R(1-2) R(2-h) R(0-3) R(3-h) R(0-4) R(4-h); frame=0; drive=R(0-1)"),
    {
        "R(0-1)": (0, 0),
        "R(1-2)": (0.5, 0.3),
        "R(2-h)": (2, 2),
        "R(0-3)": (5, 0),
        "R(3-h)": (4, 2.2),
        "R(0-4)": (2, 5.5),
        "R(4-h)": (3, 3.5),
    },
    points={"K": ("h", 1.0, 4.0)},
)
CYLINDER = Linkage.from_drawing(
    Mechanism.parse("R(0-1) R(0-4) R(4-2) P(1-2); frame=0; drive=P(1-2)"),
    {"R(0-1)": (0, 0), "R(4-2)": (3, 2), "P(1-2)": (0, 0, atan2(2, 3)), "R(0-4)": (4, 0)},
    points={"K": ("4", 2.0, 3.0)},
)

# linkage, drive values, a moving link, another moving link
MOVING = {
    "four-bar": (
        FourBar(25, 70, 40, 70).linkage({"K": (45, 40)}),
        np.radians(np.arange(30, 85, 0.2)),
        "coupler",
        "crank",
    ),
    "slider-crank": (
        SliderCrank(25, 70, 10).linkage({"K": (30, 20)}),
        np.radians(np.arange(5, 55, 0.2)),
        "coupler",
        "slider",
    ),
    "inverted": (
        InvertedSliderCrank(25, 60, 5).linkage({"K": (30, 20)}),
        np.radians(np.arange(5, 55, 0.2)),
        "coupler",
        "crank",
    ),
    "six-bar": (SIX_BAR, np.arange(1.3, 1.6, 0.001), "h", "2"),
    "cylinder": (CYLINDER, np.arange(3.0, 3.6, 0.005), "2", "4"),
}


def moved(name, order=3, acceleration=1.5, jerk=-0.7):
    linkage, rows, one, other = MOVING[name]
    motion = move(linkage, rows, speed=1.3, acceleration=acceleration, jerk=jerk, order=order)
    assert motion.complete, motion.message()
    return motion, one, other
