"""Planes of links: the search against all assignments, the collisions against plain geometry, known mechanisms."""

from itertools import combinations, product
from math import inf
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gruebler.base.convex_hull import convex_hull
from gruebler.base.errors import GrueblerError
from gruebler.files import values as files
from gruebler.mechanics.analysis.link_planes import Collisions, collisions_of, gaps_to_hull, link_planes, search_planes
from gruebler.mechanics.analysis.plates import plates_of, whole_motion
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.teaching.catalog import entry

FOLDER = Path(__file__).parents[2] / "files" / "samples"


@st.composite
def some_collisions(draw):
    """Up to four links with pins and collisions as they come."""
    links = tuple("abcd"[: draw(st.integers(1, 4))])
    pairs = list(combinations(links, 2))
    pegs = draw(st.lists(st.sampled_from([*pairs, *combinations(links, 3)]), max_size=6)) if pairs else []
    plates = draw(st.sets(st.sampled_from(pairs), max_size=8)) if pairs else set()
    plates |= {pair for peg in pegs for pair in combinations(peg, 2)}
    free = [(k, link) for k, peg in enumerate(pegs) for link in links if link not in peg]
    hits = draw(st.sets(st.sampled_from(free))) if free else set()
    touching = [pair for pair in combinations(range(len(pegs)), 2) if not set(pegs[pair[0]]) & set(pegs[pair[1]])]
    near = draw(st.sets(st.sampled_from(touching))) if touching else set()
    return Collisions(
        links=links,
        pegs=tuple(pegs),
        plates=frozenset(map(frozenset, plates)),
        hits=frozenset(hits),
        touching=frozenset(map(frozenset, near)),
    )


def allowed(collisions, planes):
    """The rules plane by plane: what a plane holds, plates and pins that pass through it."""
    spans = [[planes[link] for link in peg] for peg in collisions.pegs]
    for plane in range(1, max(planes.values()) + 1):
        plates = {link for link in planes if planes[link] == plane}
        passing = {k for k, span in enumerate(spans) if min(span) < plane < max(span)}
        if any(pair <= plates for pair in collisions.plates) or any(pair <= passing for pair in collisions.touching):
            return False
        if any(k in passing and link in plates for k, link in collisions.hits):
            return False
    return True


@given(some_collisions())
def test_the_search_finds_what_all_assignments_have(collisions):
    """Every assignment of as many planes as links, looked at plane by plane."""
    best = (inf, inf)
    for levels in product(range(1, len(collisions.links) + 1), repeat=len(collisions.links)):
        planes = dict(zip(collisions.links, levels, strict=True))
        verdict = allowed(collisions, planes)
        assert collisions.allow(planes) == verdict
        if verdict:
            length = sum(max(span) - min(span) for span in ([planes[link] for link in peg] for peg in collisions.pegs))
            best = min(best, (max(levels), length))
    planes, certain = search_planes(collisions)
    assert certain
    if planes is None:
        assert best == (inf, inf)
    else:
        assert allowed(collisions, planes)
        assert (max(planes.values()), collisions.length(planes)) == best


@given(st.lists(st.tuples(st.floats(-5, 5), st.floats(-5, 5)), min_size=1, max_size=7))
def test_the_distance_of_a_hull_is_the_largest_over_all_directions(places):
    """The distance of 0 from a convex set is the largest over all directions of its least extent, or 0.

    The best direction is that of a place or at right angles to an edge.
    """
    z = np.array([complex(*place) for place in places])
    directions = np.concatenate([z, (1j * (z[:, None] - z)).ravel()])
    directions = directions[abs(directions) > 1e-9]
    directions = np.concatenate([directions, -directions, [1]])
    least = (z[:, None] * (directions / abs(directions)).conj()).real.min(axis=0).max()
    assert gaps_to_hull(z[None])[0] == pytest.approx(max(0.0, least), abs=1e-8)


def inside(place, corners, margin):
    """Whether a disc about a place meets a convex plate: by many places of the plate."""
    grid = np.array([a + (b - a) * t for a in corners for b in corners for t in np.linspace(0, 1, 40)])
    grid = (grid[:, None] + (corners.mean() - grid)[:, None] * np.linspace(0, 1, 12)).ravel()
    return np.abs(grid - place).min() < margin


@pytest.mark.parametrize(
    "name", ["crankrocker", "slidercrank", "wiper", "scottrussell", "pumpjack_link", "garage_norail"]
)
def test_the_planes_of_catalog_machines_are_free_of_collisions(name):
    """Looked at pose by pose: places all over one plate against those of another plate, and against pins."""
    linkage = entry(name).linkage()
    plates = plates_of(whole_motion(linkage))
    found = link_planes(linkage)
    collisions = found.collisions
    rows = range(0, len(plates.motion), 9)
    areas = {
        link: np.stack([plates.track(link, z) for z in convex_hull(plate.places)], axis=1)
        for link, plate in plates.plates.items()
    }
    for k, peg in enumerate(plates.pegs):
        track = plates.track(peg.carrier, peg.place)
        for link in set(plates.plates) - set(peg.links):
            seen = any(inside(track[row], areas[link][row], 0.98 * (found.margin + found.hole / 2)) for row in rows)
            assert not seen or (k, link) in collisions.hits
            clear = all(not inside(track[row], areas[link][row], 1.3 * (found.margin + found.hole / 2)) for row in rows)
            assert not clear or (k, link) not in collisions.hits
    for peg in plates.pegs:
        assert all(frozenset(pair) in collisions.plates for pair in combinations(peg.links, 2))
    if found.planes is not None:
        assert allowed(collisions, found.planes)


def test_links_that_are_never_near_share_a_plane():
    assert link_planes(FourBar(25, 70, 40, 70).linkage()).planes == {"frame": 1, "crank": 2, "coupler": 3, "rocker": 2}


def test_crank_and_rocker_that_meet_have_planes_of_their_own():
    """A double crank: both turn fully about pivots that are nearer to each other than they are long."""
    found = link_planes(FourBar(60, 70, 65, 20).linkage())
    assert found.planes is None or found.planes["crank"] != found.planes["rocker"]
    assert frozenset(("crank", "rocker")) in found.collisions.plates


def test_an_elliptic_trammel_has_no_planes():
    """Its slider passes the pivot of the crank: conrod, crank and frame need each other's place."""
    found = link_planes(entry("scottrussell").linkage())
    assert (found.planes, found.least) == (None, True)
    assert found.stuck == ("frame", "crank", "conrod")
    assert found.explain() == (
        "The links cannot lie in planes so that nothing collides: frame, crank, conrod are in each other's way. "
        "frame runs into the pin crank-conrod. crank runs into the pin frame-conrod. "
        "conrod runs into the pin frame-crank."
    )


def test_no_link_of_those_in_the_way_can_be_left_out():
    found = link_planes(entry("garage_rail").linkage())
    for link in found.stuck:
        others = [other for other in found.stuck if other != link]
        assert search_planes(found.collisions.among(others))[0] is not None


@pytest.mark.parametrize("name", ["jansen.linkage2", "klann.linkage2"])
def test_legs_have_planes(name):
    found = link_planes(files.read(FOLDER / name, left_out=[]))
    assert found.least
    assert allowed(found.collisions, found.planes)


@pytest.mark.parametrize(
    ("linkage", "options", "words"),
    [
        (FourBar(25, 70, 40, 70), {"hole": 5, "margin": 2}, "needs a margin of more than its radius"),
        (FourBar(25, 70, 40, 70), {"hole": float("nan")}, "needs a margin"),
        (entry("belt"), {}, "plates turn or slide"),
        (entry("pent"), {}, "one drive"),
    ],
)
def test_what_has_no_planes_is_one_sentence(linkage, options, words):
    with pytest.raises(GrueblerError, match=words):
        link_planes(linkage.linkage(), **options)


def test_plates_have_a_hole_or_a_slot_for_every_pin():
    """In every pose a pin lies in the hole of its links, or on the slot, which is as long as its way."""
    plates = plates_of(whole_motion(SliderCrank(25, 70, 5).linkage({"K": (30, 10)})))
    ((start, end),) = plates.plates["frame"].slots
    way = plates.motion.displacement("P(frame-slider)")
    assert abs(end - start) == pytest.approx(way.max() - way.min(), rel=1e-12)
    assert complex(30, 10) in plates.plates["coupler"].places
    for peg in plates.pegs:
        track = plates.track(peg.carrier, peg.place)
        for link in peg.links:
            holes = [plates.track(link, hole) for hole in plates.plates[link].holes]
            slots = [(plates.track(link, a), plates.track(link, b)) for a, b in plates.plates[link].slots]
            gaps = [np.abs(track - hole).max() for hole in holes]
            gaps += [(np.abs(track - a) + np.abs(track - b) - np.abs(a - b)).max() for a, b in slots]
            assert min(gaps) < 1e-9


def test_collisions_need_the_plates_of_a_linkage():
    plates = plates_of(whole_motion(FourBar(25, 70, 40, 70)))
    thin, wide = collisions_of(plates, 0.1, 0.1), collisions_of(plates, 5.0, 40.0)
    assert thin.hits <= wide.hits
    assert thin.plates <= wide.plates
    assert frozenset(("crank", "rocker")) in wide.plates - thin.plates


def test_a_scissor_lift_that_never_folds_has_planes():
    """Folded, its arms lie on each other and on every pin; where it works they do not."""
    record = entry("scissor2")
    linkage = record.linkage()
    assert link_planes(linkage).planes is None
    low, high = np.radians(record.dimensions.range)
    found = link_planes(linkage, between=(low + 0.2, high - 0.2))
    assert found.planes is not None
    assert allowed(found.collisions, found.planes)
