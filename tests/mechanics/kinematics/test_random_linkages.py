"""Laws of motion on random linkages of all classes, two drives among them, to eight links or more.

Each is drawn in one position and moved away from it along a straight line of its drives, as far as it goes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gruebler.mechanics.kinematics import Motion, move
from gruebler.mechanics.kinematics.reference_pose import pose_at_reference
from gruebler.mechanics.kinematics.solve import cached_plan
from gruebler.mechanics.linkages import Linkage
from tests.strategies import built_mechanisms

ROWS = 60
WELL = 1e-3  # rates larger than 1 / WELL belong to a place next to a limit or a change point, where digits are lost


@dataclass(frozen=True)
class Drawing:
    """A linkage, where its joints lie, and the rows of its drives."""

    linkage: Linkage
    places: dict[int, tuple[object, ...]]
    path: np.ndarray


@st.composite
def drawings(draw: st.DrawFn) -> Drawing:
    mechanism = draw(built_mechanisms(most_groups=2)).mechanism
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    places: dict[int, tuple[object, ...]] = {}
    for k, joint in enumerate(mechanism.chain.joints):
        x, y, angle = (*rng.uniform(0, 4, 2), rng.uniform(-3, 3))
        if joint.pair.name == "revolute":
            places[k] = (x, y)
        elif joint.pair.name == "prismatic":
            places[k] = (x, y, angle)
        else:
            places[k] = (x, y, angle, joint.links[0])
    linkage = Linkage.from_drawing(mechanism, places, points={"K": (mechanism.chain.links[-1], 1.0, 2.0)})
    return Drawing(linkage, places, _away(linkage, rng))


def _away(linkage: Linkage, rng: np.random.Generator) -> np.ndarray:
    plan = cached_plan(linkage)
    home = pose_at_reference(plan, np.zeros(len(linkage.mechanism.drives))).drives
    way = rng.uniform(0.3, 1.2, len(home)) * rng.choice([-1, 1], len(home))
    return np.asarray(home) + np.linspace(0, 1, ROWS)[:, None] * way


def followed(drawing: Drawing) -> Motion:
    """The motion on the rows that are well away from limits and change points."""
    motion = move(drawing.linkage, drawing.path, speed=1.0)
    farthest = np.abs(motion.places).max() / drawing.linkage.size  # between two slides that become parallel, 1e13
    assert motion.closure_error < 1e-12 * max(1.0, farthest)
    wild = np.flatnonzero(~(np.abs(motion.rates[0]).max(axis=1) < 1 / WELL))
    rows = (int(wild[0]) if len(wild) else len(motion)) - 1
    assume(rows > 5)
    tame = move(drawing.linkage, drawing.path[:rows], speed=1.0)
    assert tame.complete
    return tame


def near(one: np.ndarray, other: np.ndarray, within: float = 1e-8) -> bool:
    return bool(np.abs(one - other).max() <= within * max(1.0, np.abs(one).max()))


@settings(max_examples=60, deadline=None)
@given(drawings())
def test_the_way_back_is_the_way_there(drawing: Drawing) -> None:
    motion = followed(drawing)
    back = move(drawing.linkage, np.concatenate([motion.drives, motion.drives[-2::-1]]), speed=1.0)
    assert back.complete, back.message()
    assert near(back.turns, back.turns[::-1])
    assert near(back.places[0], back.places[0][::-1])
    assert near(back.rates[0][: len(motion)], motion.rates[0])


@settings(max_examples=60, deadline=None)
@given(drawings(), st.floats(0.01, 100), st.floats(-3, 3), st.booleans())
def test_scaled_turned_and_mirrored_drawings_move_as_such(
    drawing: Drawing, scale: float, angle: float, mirrored: bool
) -> None:
    """As similar drawings do: turning drives keep their values (mirrored: their opposites), ways are scaled."""
    motion = followed(drawing)
    turn = scale * np.exp(1j * angle)

    def moved(z: complex) -> complex:
        return turn * (z.conjugate() if mirrored else z) + (3 - 2j)

    places: dict[str | int, object] = {}
    for k, (x, y, *rest) in drawing.places.items():
        z = moved(complex(x, y))  # type: ignore[arg-type]
        if rest:
            rest[0] = angle + (-rest[0] if mirrored else rest[0])  # type: ignore[operator]
        places[k] = (z.real, z.imag, *rest)
    k = moved(1 + 2j)
    linkage = drawing.linkage
    links = linkage.mechanism.chain.links
    other = Linkage.from_drawing(linkage.mechanism, places, points={"K": (links[-1], k.real, k.imag)})
    start = np.asarray(pose_at_reference(cached_plan(other), np.zeros(motion.drives.shape[1])).drives)
    way = motion.drives - motion.drives[0]
    found = move(other, start + (-way if mirrored else way), speed=-1.0 if mirrored else 1.0)
    assert found.complete, found.message()
    assert near(found.complex_point("K") / scale, np.array([moved(z) for z in motion.complex_point("K")]) / scale, 1e-7)
    assert near(found.rates[0], -motion.rates[0] if mirrored else motion.rates[0], 1e-6)


@settings(max_examples=60, deadline=None)
@given(drawings(), st.integers(0, ROWS))
def test_a_pose_that_is_fed_back_closes_and_goes_on_alike(drawing: Drawing, row: int) -> None:
    motion = followed(drawing)
    row %= len(motion)
    again = drawing.linkage.with_reference_pose(motion.pose(row))
    onward = move(again, motion.drives[row:], speed=1.0)
    assert onward.complete, onward.message()
    assert onward.closure_error < 1e-12
    assert near(onward.turns, motion.turns[row:])
    assert near(onward.rates[0], motion.rates[0, row:], 1e-6)


@settings(max_examples=60, deadline=None)
@given(drawings())
def test_rates_are_those_of_the_poses(drawing: Drawing) -> None:
    """Velocities and accelerations against central differences of order 6, on a line of the drives."""
    motion = followed(drawing)
    middle, step = len(motion) // 2, 1e-4
    line = drawing.path[-1] - drawing.path[0]
    rows = motion.drives[middle] + step * np.arange(-3, 4)[:, None] * line
    exact = move(drawing.linkage, np.concatenate([motion.drives[: middle + 1], rows]), speed=line)
    assume(exact.complete)
    y = exact.complex_point("K")[middle + 1 :]
    first = np.array([-1, 9, -45, 0, 45, -9, 1]) / (60 * step)
    second = np.array([2, -27, 270, -490, 270, -27, 2]) / (180 * step**2)
    size = max(1.0, np.abs(exact.complex_point("K", order=2)[middle + 4]))
    assert abs(exact.complex_point("K", order=1)[middle + 4] - first @ y) < 1e-6 * size
    assert abs(exact.complex_point("K", order=2)[middle + 4] - second @ y) < 1e-3 * size
