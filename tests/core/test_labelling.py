"""Many graphs in one call, and Ctrl-C; what is found is tested in tests/structure/isomorphism/test_labelling.py."""

import signal

import networkx as nx
import numpy as np
import pytest

from tests.structure.isomorphism.test_labelling import Graph


def test_graphs_of_different_lengths_in_one_call(core):
    edges = np.array([[0, 1], [1, 2], [0, 1], [0, 2], [1, 2], [1, 2]], np.int32)
    places = core.canonical_bulk(3, edges, np.array([0, 2, 2, 5, 6]))
    assert places.shape == (4, 3)
    assert sorted(map(sorted, places.tolist())) == [[0, 1, 2]] * 4


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="Windows has no interval timer")
def test_a_signal_ends_a_long_call(core):
    edges = Graph.of(nx.line_graph(nx.complete_bipartite_graph(10, 10))).edges.astype(np.int32)
    many, bounds = np.tile(edges, (3000, 1)), np.arange(3001) * len(edges)

    def stop(*_):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, 0.2)
    try:
        with pytest.raises(KeyboardInterrupt):
            core.canonical_bulk(100, many, bounds)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
