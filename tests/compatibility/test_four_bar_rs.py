"""The 35 plane four-bars that come with four-bar-rs, read from its form and moved, against circles of our own.

The lengths are published ones that the program gives in test-fb and test-mfb (KmolYuan/four-bar-rs), as facts; the
files are written here. The crank goes through nearly its whole range, and its coupler point is compared at every row.
"""

import json
from cmath import phase, rect
from math import acos, pi
from pathlib import Path

import numpy as np
import pytest

import gruebler as gr

KEYS = ("p1x", "p1y", "a", "l1", "l2", "l3", "l4", "l5", "g")
ROWS = json.loads(Path(__file__).with_name("four_bar_rs.json").read_text())


def coupler_point(sizes, side, crank):
    """From two circles: the rocker's pin lies left (1) or right (-1) of the way from the crank pin to its pivot."""
    pivot = complex(sizes["p1x"], sizes["p1y"])
    other = pivot + rect(sizes["l1"], sizes["a"])
    pin = pivot + rect(sizes["l2"], crank)
    gap = abs(other - pin)
    along = (gap**2 + sizes["l3"] ** 2 - sizes["l4"] ** 2) / (2 * gap)
    joint = pin + (other - pin) / gap * complex(along, side * max(sizes["l3"] ** 2 - along**2, 0.0) ** 0.5)
    return pin + rect(sizes["l5"], phase(joint - pin) + sizes["g"])


def crank_range(sizes):
    """The least and the largest angle between crank and frame, in 0 to pi, at which coupler and rocker meet."""

    def angle(reach):
        return acos(
            max(-1.0, min(1.0, (sizes["l1"] ** 2 + sizes["l2"] ** 2 - reach**2) / (2 * sizes["l1"] * sizes["l2"])))
        )

    return angle(abs(sizes["l3"] - sizes["l4"])), angle(sizes["l3"] + sizes["l4"])


def path_of(sizes, second):
    """Crank angles from one end of a range to the other, a little inside."""
    low, high = crank_range(sizes)
    if low > 0 and high < pi:  # two ranges, mirrored about the frame: the first is that of negative angles
        begin, end = (low, high) if second else (-high, -low)
    elif high < pi:
        begin, end = -high, high
    elif low > 0:
        begin, end = low, 2 * pi - low
    else:
        return sizes["a"] + np.linspace(0, 2 * pi, 361)
    inside = 1e-4 * (end - begin)
    return sizes["a"] + np.linspace(begin + inside, end - inside, 361)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row[0])
def test_the_coupler_point_follows_its_curve(row, tmp_path):
    *numbers, state = row[1:]
    sizes = dict(zip(KEYS, numbers, strict=True))
    path = tmp_path / "machine.ron"
    path.write_text(f"({', '.join(f'{key}: {value!r}' for key, value in sizes.items())}, stat: {state})")
    drives = path_of(sizes, state.endswith("b2"))
    motion = gr.move(gr.read(path, left_out=[]), drives)
    assert motion.complete, motion.message()
    side = 1 if state.startswith("c1") else -1
    found = motion.point("P5") @ [1, 1j]
    off = [np.abs(found - [coupler_point(sizes, each, crank) for crank in drives]) for each in (side, -side)]
    bound = 1e-9 * max(sizes[key] for key in ("l1", "l2", "l3", "l4", "l5"))
    half = len(drives) // 2
    if row[0] in AT_A_CHANGE_POINT:  # all joints on one line at 180 degrees: from there on either side is a motion
        assert off[0][: half - 1].max() < bound
        assert min(each[half + 2 :].max() for each in off) < bound
    else:
        assert off[0].max() < bound


AT_A_CHANGE_POINT = ("fb bow.open", "fb waterdrop.open")
"""l1 + l2 = l3 + l4: 10 + 15 = 3 + 22."""


def test_these_two_have_a_change_point():
    for row in ROWS:
        l1, l2, l3, l4 = row[4:8]
        assert (l1 + l2 == l3 + l4) == (row[0] in AT_A_CHANGE_POINT)
