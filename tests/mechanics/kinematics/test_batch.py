"""Many designs at once against the same designs one by one."""

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.kinematics import from_degrees, move
from gruebler.mechanics.kinematics.batch import (
    Designs,
    designs,
    four_bars,
    inverted_slider_cranks,
    move_many,
    slider_cranks,
)
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism

RANDOM = np.random.default_rng(5)
PATH = from_degrees(10, 400, 3)
CLASS_III = Mechanism.parse("R(0-1) R(1-2) R(2-h) R(0-3) R(3-h) R(0-4) R(4-h); frame=0; drive=R(0-1)")
SLIDER = SliderCrank(10, 40).linkage()
CYLINDER = Mechanism.parse("R(0-1) R(0-4) R(4-2) P(1-2); frame=0; drive=P(1-2)")


def uniform(*ranges: tuple[float, float]) -> list[np.ndarray]:
    return [RANDOM.uniform(low, high, 12) for low, high in ranges]


BATCHES = {
    "four-bars": four_bars(*uniform((10, 40), (40, 80), (30, 60), (40, 80))),
    "slider-cranks": slider_cranks(*uniform((10, 40), (30, 80), (-20, 20))),
    "inverted": inverted_slider_cranks(*uniform((10, 60), (20, 60), (-9, 9))),
}


def check(many: Designs, order: int = 2, branch: str | None = None, path: np.ndarray = PATH) -> int:
    """How many followed the whole path."""
    motions = move_many(many, path, order=order, branch=branch, threads=2)
    for n in range(len(many)):
        one = motions.designs.linkage(n)
        alone = move(one, path, order=order, branch=branch)
        end = motions.reached[n]
        assert end == len(alone)
        assert np.isnan(motions.turns[n, end:]).all()
        for k, link in enumerate(motions.links):
            column = one.mechanism.chain.links.index(link)
            assert np.abs(motions.turns[n, :end, k] - alone.turns[:, column]).max(initial=0) < 1e-13
            for m in range(order + 1):
                gap = motions.places[m, n, :end, k] - alone.places[m, :, column]
                assert np.abs(gap).max(initial=0) < 1e-9 * (1 + np.abs(alone.places[m]).max(initial=0))
            if end == len(path):
                assert np.allclose(motions.angle(link)[n], alone.angle(link), rtol=0, atol=1e-12)
    return int(motions.complete.sum())


@pytest.mark.parametrize("name", BATCHES)
@pytest.mark.parametrize("branch", [None, "-"])
def test_many_designs_move_as_each_alone(name: str, branch: str | None) -> None:
    assert check(BATCHES[name], branch=branch) > 0


def test_designs_with_a_larger_group_and_with_a_cylinder() -> None:
    places = [(0, 0), (0.5, 0.3), (2, 2), (5, 0), (4, 2.2), (2, 5.5), (3, 3.5)]
    drawings = [dict(enumerate((x + RANDOM.uniform(-0.1, 0.1), y) for x, y in places)) for _ in range(3)]
    check(designs([Linkage.from_drawing(CLASS_III, drawing) for drawing in drawings]), path=from_degrees(31, 80, 1))
    lift = [
        Linkage.from_drawing(
            CYLINDER, {"R(0-1)": (0, 0), "R(4-2)": (3, y), "P(1-2)": (0, 0, np.arctan2(y, 3)), "R(0-4)": (4, 0)}
        )
        for y in (1.8, 2.0, 2.2)
    ]
    check(designs(lift), path=np.linspace(3.5, 4.2, 60))


def test_joints_and_rates_of_the_kept_links() -> None:
    many = four_bars(25, [60, 70], 40, 70)
    motions = move_many(many, PATH, speed=4, links=["coupler"])
    alone = move(FourBar(25, 70, 40, 70).linkage(), PATH, speed=4)
    for order in range(3):
        assert np.allclose(
            motions.complex_point("R(coupler-rocker)", order=order)[1],
            alone.complex_point("R(coupler-rocker)", order=order),
        )
    shown = motions.point("R(coupler-rocker)")
    assert np.allclose(shown[1], alone.point("R(coupler-rocker)"))
    assert np.allclose(motions.angular("coupler")[1], alone.angular("coupler"))
    assert motions.motion(1).complete
    with pytest.raises(LinkageError, match="'rocker' was not kept"):
        motions.angle("rocker")
    with pytest.raises(LinkageError, match="order from 0 to 2"):
        motions.complex_point("R(crank-coupler)", order=3)
    with pytest.raises(LinkageError, match="not a joint of the links kept"):
        motions.complex_point("R(frame-crank)")


def test_a_design_that_cannot_be_assembled_reaches_no_row() -> None:
    motions = move_many(four_bars([25, 500], 70, 40, 70), PATH)
    assert motions.reached.tolist() == [len(PATH), 0]
    assert np.isnan(motions.turns[1]).all()


@pytest.mark.parametrize(
    ("made", "message"),
    [
        (lambda: four_bars(25, [70, -1], 40, 70), "b: expected positive numbers, but found -1"),
        (lambda: four_bars(25, [70, np.nan], 40, 70), "b: expected positive numbers, but found nan"),
        (lambda: slider_cranks(25, 70, np.inf), "e: expected finite numbers"),
        (lambda: four_bars([1, 2], [1, 2, 3], 4, 5), "arrays of one length"),
        (lambda: four_bars("long", 1, 1, 1), "a: expected numbers, but found 'long'"),
        (lambda: four_bars([], 1, 1, 1), "not empty"),
        (lambda: designs([]), "at least one design"),
        (lambda: designs([FourBar(1, 1, 1, 1).linkage(), SLIDER]), "another mechanism"),
        (lambda: move_many(four_bars(25, 70, 40, 70), PATH, links=["rod"]), "no link 'rod'"),
        (lambda: move_many(four_bars(25, 70, 40, 70), PATH, order=4), "0, 1, 2 or 3"),
        (lambda: move_many(four_bars(25, 70, 40, 70), [[1, 2]]), "1 drive"),
    ],
)  # fmt: skip
def test_wrong_calls_get_one_sentence(made: object, message: str) -> None:
    with pytest.raises(LinkageError, match=message):
        made()  # type: ignore[operator]
