"""Bevel differentials of the catalog as trains: speeds and torques by Willis, against the motion of the linkage."""

from fractions import Fraction

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.cli import main
from gruebler.machines.gears import speeds
from gruebler.mechanics.screws.wheels import bevel_train
from gruebler.mechanics.space import move
from gruebler.teaching.catalog import entry


@pytest.mark.parametrize("id", ["diff_bevel", "diff_bevel2p"])
@pytest.mark.parametrize(("carrier", "first"), [(100, 60), (100, 100), (0, 30), (50, 0)])
def test_wheels_turn_as_the_train_says(id, carrier, first):
    """The sum of both axle speeds is twice that of the carrier; the planet turns by the difference."""
    linkage = entry(id).placed()
    found = speeds(bevel_train(linkage), {"carrier": Fraction(carrier), "sun1": Fraction(first)}).values
    assert found["sun2"] == 2 * carrier - first
    names = linkage.mechanism.drive_names()
    rates = np.array([[{"R(frame-carrier)": carrier, "R(frame-sun1)": first}[name] for name in names]], float)
    motion = move(linkage, np.zeros((1, 2)), speed=rates, order=1)
    assert motion.joint("R(frame-sun2)", order=1)[0] == pytest.approx(float(found["sun2"]), abs=1e-9)
    planet = "planet" if id == "diff_bevel" else "planet1"
    joint = f"R(carrier-{planet})"
    assert motion.joint(joint, order=1)[0] == pytest.approx(float(found[planet]), abs=1e-9)
    assert abs(found[planet]) == abs(first - carrier)


def test_a_differential_halves_the_torque(capsys):
    assert main(["gears", "diff_bevel; drive carrier=100; drive sun1=60; load sun2=-50"]) == 0
    rows = [line.split() for line in capsys.readouterr().out.splitlines()]
    torques = {row[0]: row[2] for row in rows if row and row[0] in ("sun1", "sun2", "carrier")}
    assert torques == {"sun1": "-50", "sun2": "-50", "carrier": "100"}


def test_a_machine_without_wheels_is_no_train():
    with pytest.raises(LinkageError, match="has no wheels"):
        bevel_train(entry("universal_joint").placed())
