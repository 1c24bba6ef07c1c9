"""The 22 examples of Pyslvs, read from its form and moved: at every row all pins are closed and all slots straight.

The places and links of pyslvs/example.py (KmolYuan/pyslvs) are facts; the texts are written here. What is checked uses
the drawn places only: where a joint lies on each of its links, and the directions of slots.
"""

import json
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

import gruebler as gr
from gruebler.mechanics.linkages import LinkPoint

EXAMPLES = {each["name"]: each for each in json.loads(Path(__file__).with_name("pyslvs_examples.json").read_text())}
TO_A_LIMIT = {"Arm": 1, "Ten Fold's levers": -1}
"""These two cannot turn fully (the second is drawn at one end of its range), with the sense in which they turn; the
other drives do, as a Newton solver on MuJoCo's constraints found, too."""


def text_of(example):
    joints = []
    for kind, x, y, angle, links in example["joints"]:
        slope = [] if angle is None else [f"A[{angle}]"]
        joints.append(f"J[{', '.join([kind, *slope, f'P[{x}, {y}]', 'L[' + ', '.join(links) + ']'])}]")
    return f"M[{', '.join(joints)}]"


@pytest.fixture(params=EXAMPLES)
def example(request, tmp_path):
    path = tmp_path / "example.pyslvs"
    path.write_text(text_of(EXAMPLES[request.param]))
    return EXAMPLES[request.param], gr.read(path, left_out=[])


def drawn(linkage, number):
    """The value of a drive in the drawn position, to begin there."""
    drive = linkage.mechanism.drives[number]
    first, second = (linkage.reference_pose[link].angle for link in drive.between)
    return second - first


def test_pins_close_and_slots_are_straight(example):
    example, linkage = example
    begin = np.array([drawn(linkage, k) for k in range(len(linkage.mechanism.drives))])
    turned = np.linspace(0, 2 * np.pi, 241)
    path = np.repeat(begin[None], len(turned), axis=0)
    path[:, 0] += turned * TO_A_LIMIT.get(example["name"], 1)
    motion = gr.move(linkage, path)
    assert motion.complete == (example["name"] not in TO_A_LIMIT), motion.message()
    assert len(motion) > 5
    pose = {link: linkage.reference_pose[link] for link in linkage.mechanism.chain.links}

    def on(link, place):
        """A drawn place, carried along by a link; (rows,) complex."""
        along, across = pose[link].to_local(*place)
        return motion.point(LinkPoint(link, along, across)) @ [1, 1j]

    size = np.ptp([joint[1:3] for joint in example["joints"]], axis=0).max()
    frame = linkage.mechanism.frame
    known = {"ground": frame} | {link: link for link in pose}
    checked = 0
    for kind, x, y, angle, names in example["joints"]:
        links = [known[name] for name in names]
        if kind == "R":
            for one, other in pairwise(links):
                assert np.abs(on(one, (x, y)) - on(other, (x, y))).max() < 1e-11 * size
                checked += 1
            continue
        slot, *riders = links
        ahead = (x + np.cos(np.radians(angle)), y + np.sin(np.radians(angle)))
        direction = on(slot, ahead) - on(slot, (x, y))
        for rider in riders:
            gap = on(rider, (x, y)) - on(slot, (x, y))
            assert np.abs((gap * direction.conjugate()).imag).max() < 1e-11 * size
            checked += 1
            if kind == "P":
                assert np.abs(on(rider, ahead) - on(rider, (x, y)) - direction).max() < 1e-11
    assert checked >= 3


def test_steps_are_no_jumps(example):
    """Twice as many rows give the same poses: no step of the first path went to another assembly mode."""
    example, linkage = example
    sense = TO_A_LIMIT.get(example["name"], 1)
    begin = np.array([drawn(linkage, k) for k in range(len(linkage.mechanism.drives))])
    coarse, fine = ([*begin] + sense * np.linspace(0, 1.5, n)[:, None] * np.eye(len(begin))[0] for n in (31, 61))
    one, other = gr.move(linkage, coarse), gr.move(linkage, fine)
    rows = min(len(one), (len(other) + 1) // 2)
    assert rows > 5
    assert one.turns[:rows] == pytest.approx(other.turns[: 2 * rows : 2], abs=1e-9)
