"""Circuits in space: against the limits of closed forms, both their branches, and the ends of the followed range."""

from math import pi

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.mechanics.space import RSSR, SphericalFourBar, spatial_circuit
from gruebler.mechanics.space.drive_range import spatial_range
from tests.mechanics.screws import machines
from tests.mechanics.space.test_overconstrained_loops import trihedral

FORMS = {
    "rssr": (RSSR(a=60, b=90, c=50, d=70, crank_offset=10, rocker_offset=15, twist=0.9), 3.0),
    "spherical": (SphericalFourBar(0.9, 0.8, 0.7, 1.0), 0.5),
}


@pytest.mark.parametrize(("form", "start"), FORMS.values(), ids=FORMS)
def test_a_circuit_goes_through_the_limits_of_the_crank(form, start):
    circuit = spatial_circuit(form.linkage(start))
    assert circuit.closed
    assert circuit.drives[-1] == pytest.approx(0, abs=1e-12)
    (arc,) = form.limits
    found = np.exp(1j * (start + np.array(circuit.limits)))
    assert abs(found - np.exp(1j * np.array([arc.end, arc.start]))).max() < 1e-9


def test_a_circuit_has_both_branches_of_an_rssr():
    form, start = FORMS["rssr"]
    circuit = spatial_circuit(form.linkage(start))
    output = circuit.unknowns[3, "Rz"] + form.motion(start).output.value
    branches = [form.motion(start + circuit.drives, branch=branch).output.value for branch in "+-"]
    apart = abs(np.exp(1j * np.array(branches)) - np.exp(1j * output))
    inside = np.isfinite(apart).all(axis=0)
    assert inside.mean() > 0.9
    # Near a limit the output goes with the root of what is left of the drive.
    assert apart[:, inside].min(axis=0).max() < 1e-6
    assert {0, 1} == {*np.argmin(apart[:, inside], axis=0).tolist()}


@pytest.mark.parametrize(
    ("linkage", "drive"),
    [(machines.bricard("line"), 1), (machines.bricard("plane"), 1), (trihedral(), 0)],
    ids=["line", "plane", "trihedral"],
)
def test_bricards_loops_turn_back_where_their_range_ends(linkage, drive):
    linkage = linkage.with_drives([drive])
    circuit, reach = spatial_circuit(linkage), spatial_range(linkage)
    assert circuit.closed
    assert circuit.limits == pytest.approx([reach.high, reach.low], abs=1e-6)  # the range ends at its smallest step
    assert "turns back at" in circuit.explain()


@pytest.mark.parametrize("make", [lambda: machines.bennett()[0], machines.sarrus, lambda: machines.goldberg(5)])
def test_a_drive_that_turns_fully_comes_back_after_a_turn(make):
    circuit = spatial_circuit(make().with_drives([0]))
    assert circuit.closed
    assert circuit.drives[-1] == pytest.approx(2 * pi, abs=1e-12)
    assert circuit.limits == ()
    assert np.diff(circuit.arcs).max() < 0.1
    assert "turns back" not in circuit.explain()


def test_what_is_no_circuit_is_refused():
    with pytest.raises(LinkageError, match="a circuit needs one drive, but the mechanism has 2"):
        spatial_circuit(machines.loop(8).with_drives([0, 1]))
    with pytest.raises(LinkageError, match="does not come back within 5000 steps"):
        spatial_circuit(machines.winch().with_drives([2]))
