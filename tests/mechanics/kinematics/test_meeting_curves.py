"""Change points in which more than two curves of positions meet: several parallelograms in a row."""

import numpy as np
import pytest

from gruebler.mechanics.analysis import measures
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics import circuit
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism


def parallelograms(count, shrink=0.8, angle=1.0):
    """Cranks and rods in a row; all are stretched at once, so that 2^count curves meet at 0 and at 180 degrees."""
    places, text = {"R(0-w0)": (0.0, 0.0)}, ["R(0-w0)"]
    for k in range(count):
        arm = 20 * shrink**k * np.exp(1j * angle)
        for joint, at in {
            f"R(w{k}-r{k})": 50 * k + arm,
            f"R(r{k}-w{k + 1})": 50 * (k + 1) + arm,
            f"R(0-w{k + 1})": 50 * (k + 1) + 0j,
        }.items():
            text.append(joint)
            places[joint] = (at.real, at.imag)
    return Linkage.from_drawing(Mechanism.parse(" ".join(text) + "; frame=0; drive=R(0-w0)"), places)


@pytest.mark.parametrize("count", [1, 2, 3, 4])
@pytest.mark.parametrize("angle", [0.4, 1.0, 2.2])
def test_the_circuit_goes_straight_on_and_names_them(count, angle):
    made = circuit(parallelograms(count, angle=angle))
    assert made.closed
    assert made.message() == ""
    found = sorted(np.degrees(point.drive) % 360 for point in made.change_points)
    away = [(value + 90) % 180 - 90 for value in found]
    assert len(found) == 2
    assert away == pytest.approx([0, 0], abs=1e-8)
    assert [point.several for point in made.change_points] == [count > 1] * 2
    turned = [made.poses_at_change_points.angle(f"w{k}") for k in range(count + 1)]
    assert np.shape(turned) == (count + 1, 2)  # every crank stands like the first one, on the drawn curve
    assert np.abs(np.exp(1j * np.diff(2 * np.array(turned), axis=0)) - 1).max() < 1e-8


def test_a_near_miss_is_none():
    linkage = parallelograms(2)
    wrong = {link: dict(mine) for link, mine in linkage._by_link().items()}
    pin = wrong["w2"][5]
    wrong["w2"][5] = (pin.x * (1 + 1e-4), pin.y * (1 + 1e-4))  # the second parallelogram misses its change points
    made = circuit(Linkage(linkage.mechanism, wrong), at=1.0)
    assert made.closed
    assert len(made.change_points) >= 2  # those of the first one
    assert not any(point.several for point in made.change_points)
    assert circuit(FourBar(20, 70, 40, 70).linkage()).change_points == ()


def test_the_measures_say_it_in_both_languages():
    found = measures(parallelograms(2))
    assert [point.several for point in found.change_points] == [True] * 4
    assert "More than two curves of positions meet there." in found.explain()
    assert "Dort treffen sich mehr als zwei Lagenkurven." in found.explain("de")
    places = {round(point.drive, 6) for point in found.change_points}
    assert found.explain().count("More than two curves") == len(places) < len(found.change_points)
    assert not any(point.several for point in measures(parallelograms(1)).change_points)
    assert all(point["several"] for point in found.to_json()["change_points"])
