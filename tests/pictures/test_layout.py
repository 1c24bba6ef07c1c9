"""Layouts: no crossing where there need be none, nothing covered, clearance, symmetry, sameness."""

from itertools import combinations

import networkx as nx
import numpy as np
import pytest
from hypothesis import given, settings

from gruebler import Chain, chains, symmetry
from gruebler.pictures.structure.bodies import LayoutBodies
from gruebler.pictures.structure.layout import lay_out
from tests import strategies


def bodies(chain):
    held = [[k for k, joint in enumerate(chain.joints) if link in joint.links] for link in chain.links]
    return LayoutBodies.of([0] * len(chain.joints), held)


def is_planar(chain):
    return nx.check_planarity(nx.Graph(joint.links for joint in chain.joints))[0]


def edges(outline):
    return list(zip(outline, [*outline[1:], outline[0]] if len(outline) > 2 else outline[1:], strict=False))


def cross(points, one, other):
    """Whether two segments without a common end cross: each separates the ends of the other."""

    def side(a, b, c):
        return np.cross([*(points[b] - points[a]), 0], [*(points[c] - points[a]), 0])[2] > 0

    (a, b), (c, d) = one, other
    return side(a, b, c) != side(a, b, d) and side(c, d, a) != side(c, d, b)


def crossing_pairs(layout):
    return {
        (i, j)
        for (i, one), (j, other) in combinations(enumerate(layout.outlines), 2)
        for e in edges(one)
        for f in edges(other)
        if not set(e) & set(f) and cross(layout.points, e, f)
    }


def distance(p, a, b):
    t = np.clip((p - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
    return float(np.linalg.norm(p - a - t * (b - a)))


def smallest_distance(layout):
    """Between a point and an edge that does not end there, relative to the longer side."""
    x = layout.points
    gaps = [
        distance(x[p], x[a], x[b])
        for o in layout.outlines
        for a, b in edges(o)
        for p in range(len(x))
        if p not in (a, b)
    ]
    return min(gaps) / max(np.ptp(x, axis=0))


def covers(layout):
    """Points inside a foreign polygon: the angles under which they see its edges add up to a full turn."""
    found = 0
    for outline in layout.outlines:
        for p in set(range(len(layout.points))) - set(outline) if len(outline) > 2 else ():
            z = (layout.points[list(outline)] - layout.points[p]) @ [1, 1j]
            found += abs(np.angle(np.roll(z, -1) / z).sum()) > 1
    return found


@pytest.mark.parametrize("links", [4, 6, 8])
def test_small_chains_are_drawn_well(links):
    for chain in chains(links):
        layout = lay_out(bodies(chain))
        assert crossing_pairs(layout) == set() == set(layout.crossings)
        assert covers(layout) == layout.covered == 0
        # The library's figure also counts how far corners stand out, so that it may be smaller.
        assert 0.1 < layout.clearance <= smallest_distance(layout) + 1e-9


@pytest.mark.slow
def test_all_chains_of_ten_links():
    """230 chains (Woo 1967), 11 of them not planar; each of these can be drawn with one crossing."""
    crossings, clearances = [], []
    for chain in chains(10):
        layout = lay_out(bodies(chain))
        assert crossing_pairs(layout) == set(layout.crossings)
        assert covers(layout) == 0
        assert bool(layout.crossings) is not is_planar(chain)
        crossings.append(len(layout.crossings))
        clearances.append(layout.clearance)
    assert sum(crossings) == max(crossings) * 11 == 11
    assert min(clearances) > 0.1
    assert np.median(clearances) > 0.15


def test_symmetries_shown_are_symmetries():
    shown = 0
    for chain in [*chains(6), *chains(8)]:
        layout = lay_out(bodies(chain))
        for image, turn in zip(layout.images, layout.turns, strict=True):
            np.testing.assert_allclose(layout.points[list(image)], layout.points @ turn.T, atol=1e-6)
        assert symmetry(chain).order % len(layout.images) == 0
        shown += len(layout.images) > 1
    assert shown >= 13


def test_the_square_of_the_four_bar():
    layout = lay_out(bodies(next(chains(4))))
    assert len(layout.images) == 8
    sides = [np.linalg.norm(layout.points[a] - layout.points[b]) for o in layout.outlines for a, b in edges(o)]
    np.testing.assert_allclose(sides, sides[0], rtol=1e-9)


@given(strategies.chains(pairs=("revolute",), most_links=6))
@settings(max_examples=25)
def test_every_chain_has_a_layout(chain):
    layout = lay_out(bodies(chain))
    assert np.isfinite(layout.points).all()
    assert max(np.ptp(layout.points, axis=0)) == pytest.approx(1)
    for body, outline in zip(bodies(chain).bodies, layout.outlines, strict=True):
        assert set(body) <= set(outline)


def test_bodies_that_would_lie_on_each_other():
    chain = Chain.parse("R(0-1) R(0-1) R(1-2) R(2-0) R(2-0)")
    layout = lay_out(bodies(chain))
    assert crossing_pairs(layout) == set()
    assert layout.clearance > 0.03


@pytest.mark.slow
def test_a_chain_of_forty_links():
    ladder = [(k, k + 2) for k in range(38)] + [(k, k + 1) for k in range(0, 40, 3)]
    chain = Chain.from_edges(ladder)
    layout = lay_out(bodies(chain))
    assert is_planar(chain)
    assert crossing_pairs(layout) == set()
    assert covers(layout) == 0
