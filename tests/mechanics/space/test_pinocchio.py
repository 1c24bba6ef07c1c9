"""Ten machines of the catalog against Pinocchio, which solves for poses, velocities and accelerations by itself.

Its figures are in pinocchio.json, made by ``python -m benchmarks.robotics figures`` from a tree of the joints and
constraints between points that close the loops; no number of ours is in them.
"""

import json
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from gruebler.mechanics.space import move
from gruebler.teaching.catalog import entry

FIGURES = json.loads(Path(__file__).with_name("pinocchio.json").read_text(encoding="utf-8"))
MACHINES = sorted(set(FIGURES) - {"source"})


def test_the_figures_are_those_of_a_version():
    assert FIGURES["source"].startswith("Pinocchio 4.1.0")
    assert len(MACHINES) == 10
    assert sum(len(row["links"]) for name in MACHINES for row in FIGURES[name]["rows"]) >= 80


@pytest.mark.parametrize("name", MACHINES)
def test_poses_and_rates_are_those_of_pinocchio(name):
    linkage, found = entry(name).placed(), FIGURES[name]
    ends = np.array([np.zeros_like(found["speeds"]), *(row["drives"] for row in found["rows"])])
    path = np.concatenate([np.linspace(a, b, 21)[:-1] for a, b in pairwise(ends)] + [ends[-1:]])
    motion = move(linkage, path, speed=found["speeds"], order=2)
    assert motion.complete
    moving = {*linkage.mechanism.chain.links} - {linkage.mechanism.frame, *motion.idle}
    point = tuple(linkage.centre + 0.1 * linkage.size)
    for number, row in enumerate(found["rows"], 1):
        assert set(row["links"]) == moving
        for link, theirs in row["links"].items():
            ours = {
                "turn": motion.pose(link)[:, :3, :3].reshape(-1, 9),
                "place": motion.point((link, *point)),
                "angular velocity": motion.angular(link),
                "velocity": motion.velocity((link, *point)),
                "angular acceleration": motion.angular(link, order=2),
                "acceleration": motion.acceleration((link, *point)),
            }
            for quantity, values in ours.items():
                within = 1e-11 * max(1, *(np.abs(each[quantity]).max() for each in row["links"].values()))
                assert values[20 * number] == pytest.approx(theirs[quantity], abs=within, rel=0), (link, quantity)
