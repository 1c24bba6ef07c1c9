"""The counting kernels of the core against print, level against level."""

import signal
from functools import cache

import numpy as np
import pytest

from gruebler.structure.enumeration.contracted import pack, packed_graphs
from tests.structure.enumeration.test_counts import NUMBERS, ORBITS

# Contracted graphs of 2, 3, ... loops by the numbers of their nodes: loopless two-connected multigraphs, degrees >= 3.
THETA = np.zeros((1, 16), np.int64)
THETA[0, :2] = 3 << 4, 3

# (links, mobility) of recorded calls: 12 to 14 links, F = 0 to 3.
CALLS = [(13, 0), (12, 1), (14, 1), (13, 2), (12, 3), (14, 3)]


def loops_of(links, mobility):
    return (links - 1 - mobility) // 2


@cache
def graphs(loops):
    """The packed graphs of so many loops."""
    return np.concatenate([block.copy() for block in packed_graphs(loops)])


@pytest.mark.parametrize("orbits", [False, True])
@pytest.mark.parametrize(("links", "mobility"), CALLS)
def test_levels_agree(core, links, mobility, orbits):
    loops = loops_of(links, mobility)
    first, *others = (
        core.take_census(graphs(loops), loops, mobility, orbits, level=level) for level in core.level_names()
    )
    assert all((other == first).all() for other in others)
    assert first[:, 1].sum() == NUMBERS[mobility].get(links, first[:, 1].sum())


def test_census_takes_rows_of_the_width_of_the_graphs(core):
    narrow = np.ascontiguousarray(graphs(5)[:, :8])
    assert (core.take_census(narrow, 5, 1, True) == core.take_census(graphs(5), 5, 1, True)).all()


@pytest.mark.parametrize(("mobility", "links"), [(f, n) for f, row in NUMBERS.items() for n in row if n > f + 3])
def test_numbers_in_print(core, mobility, links):
    """Numbers of chains, the row F = 1 being OEIS A233288; all from the core alone."""
    loops, rows = loops_of(links, mobility), THETA
    for more in range(2, loops):
        rows, _ = core.add_loop(rows, more, 0, 1 << 62)
    census = core.take_census(rows, loops, mobility, False)
    assert census[:, 1].sum() == NUMBERS[mobility][links]


@pytest.mark.parametrize("links", [6, 8, 10])
def test_orbits_in_print(core, links):
    loops = loops_of(links, 1)
    _, _, inversions, joint_orbits, drives = core.take_census(graphs(loops), loops, 1, True).sum(axis=0)
    assert (inversions, drives, joint_orbits) == ORBITS[links]


@pytest.mark.slow
def test_sixteen_links(core):
    census = core.take_census(graphs(7), 7, 1, True)
    assert census[:, 1].sum() == 19_819_281


def test_growth_in_parts(core):
    whole, _ = core.add_loop(graphs(5), 5, 0, 1 << 62)
    parts, first = [], 0
    while first < len(graphs(5)):
        part, following = core.add_loop(graphs(5), 5, first, 100)
        assert following > first
        parts.append(part)
        first = following
    assert len(parts) > 3
    assert (np.concatenate(parts) == whole).all()


def test_growth_gives_canonical_graphs_once(core):
    from gruebler.structure.enumeration.contracted import unpacked

    grown, _ = core.add_loop(graphs(4), 4, 0, 1 << 62)
    assert (pack(unpacked(rows) for rows in grown) == grown).all()
    assert len(np.unique(grown, axis=0)) == len(grown)


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="Windows has no interval timer")
@pytest.mark.parametrize("kernel", ["census", "growth"])
def test_a_signal_ends_a_long_call(core, kernel):
    many = np.tile(graphs(6), (200, 1))

    def stop(*_):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, 0.2)
    try:
        with pytest.raises(KeyboardInterrupt):
            core.take_census(many, 6, 1, True) if kernel == "census" else core.add_loop(many, 6, 0, 1 << 62)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
