"""Designs sorted as the caller asks, and the two transmission angles of a design."""

import numpy as np
import pytest

from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis import DeadCentreTask, PositionTask, synthesise
from gruebler.design.synthesis.results import ORDERS, Design, DesignVerdict, in_order_of
from gruebler.mechanics.analysis.transmission import transmission_angle
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics import move

ROWS = [(0, 0, 0), (2.1, 0.9, 0.35), (3.2, 1.0, 0.8), (4.0, 0.2, 1.5)]


@pytest.fixture(scope="module")
def result():
    return synthesise(PositionTask(ROWS), number=6)


VALUES = {
    "error": lambda design: max(design.verdict.error, 1e-9),
    "transmission": lambda design: -design.verdict.transmission,
    "range-transmission": lambda design: -design.transmission_over_range,
    "size": lambda design: design.linkage.size,
    "size-ratio": lambda design: design.verdict.size_ratio,
    "links": lambda design: len(design.linkage.mechanism.chain.links),
    "full-turn": lambda design: not design.verdict.turns_fully,
    "sensitivity": lambda design: design.relative_sensitivity,
}


def test_every_order_has_its_value():
    """Preferred pivots need a demand: test_sought_measures."""
    assert {*VALUES, "near-pivots"} == set(ORDERS)


@pytest.mark.parametrize("order", VALUES)
def test_designs_are_sorted_by_values(result, order):
    again = result.sorted_by(order)
    values = np.array([VALUES[order](design) for design in again.designs], float)
    values = values[np.isfinite(values)]
    assert len(again.designs) > 3
    assert (np.diff(values) >= -1e-8 * np.abs(values).max()).all()
    assert set(map(id, again.designs)) == set(map(id, result.designs))
    assert set(map(id, again.rejected)) == set(map(id, result.rejected))


def test_the_default_is_a_full_turn_then_the_transmission_angle(result):
    again = result.sorted_by("full-turn", "transmission", "size-ratio")
    assert [id(design) for design in again.designs] == [id(design) for design in result.designs]


def test_the_second_order_decides_among_equal_ones(result):
    by_form = synthesise(PositionTask(ROWS), number=6, sort=["full-turn", "size"]).designs
    turning = [design for design in by_form if design.verdict.turns_fully]
    assert 0 < len(turning) < len(by_form)
    assert by_form[: len(turning)] == tuple(turning)
    for part in (by_form[: len(turning)], by_form[len(turning) :]):
        sizes = [design.linkage.size for design in part]
        assert sizes == sorted(sizes)


def test_rounding_orders_nothing():
    """Two designs of the same size but for the last digits stay as they are; so do exact ones."""
    bars = [FourBar(1 + k * 1e-14, 3, 2.5, 3.5).linkage() for k in (1, 0)]
    designs = [
        Design(linkage=bar, verdict=DesignVerdict(error=e), form=str(k))
        for k, (bar, e) in enumerate(zip(bars, (3e-13, 1e-15), strict=True))
    ]
    for order in ("size", "error", "links", "transmission"):
        assert [design.form for design in in_order_of(designs, [order])] == ["0", "1"]


def test_an_order_that_there_is_not():
    with pytest.raises(SynthesisError, match=r"designs are sorted by error, transmission, .*, not by 'beauty'"):
        synthesise(DeadCentreTask(stroke=1, time_ratio=1.2), sort="beauty")


def test_the_transmission_angle_of_the_range_is_the_least_of_a_dense_motion(result):
    """Through the targets it is at least that of the whole range: here both against `move`."""
    checked = 0
    for design in result.designs:
        if not design.verdict.turns_fully:
            continue
        whole = move(design.linkage, np.linspace(0, 2 * np.pi, 20001) + design.drives[0], order=2)
        angles = transmission_angle(whole)
        assert design.transmission_over_range == pytest.approx(angles.min(), abs=1e-4)
        way = move(
            design.linkage, design.drives[0] + np.linspace(0, design.drives[-1] - design.drives[0], 1001), order=2
        )
        assert design.verdict.transmission == pytest.approx(transmission_angle(way).min(), abs=2e-2)
        assert design.transmission_over_range <= design.verdict.transmission + 1e-12
        checked += 1
    assert checked >= 2
