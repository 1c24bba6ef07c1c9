"""Layouts of all chains with F = 1 up to ten links, and of some with 40, beside the general layouts of networkx."""

import random
import time
import warnings
from collections.abc import Callable, Iterable
from itertools import combinations, pairwise

import networkx as nx
import numpy as np

from gruebler import Chain, chains
from gruebler.pictures.canvas import gallery_html
from gruebler.pictures.canvas.gallery import Item, Section
from gruebler.pictures.structure import draw_structure
from gruebler.pictures.structure.bodies import LayoutBodies
from gruebler.pictures.structure.layout import Layout, lay_out

Drawing = tuple[np.ndarray, list[tuple[int, ...]]]


def bodies(chain: Chain) -> LayoutBodies:
    held = [[k for k, joint in enumerate(chain.joints) if link in joint.links] for link in chain.links]
    return LayoutBodies.of([0] * len(chain.joints), held)


def ours(chain: Chain) -> Drawing:
    layout: Layout = lay_out(bodies(chain))
    return layout.points, list(layout.outlines)


def theirs(method: Callable[..., dict[tuple[bool, int], np.ndarray]]) -> Callable[[Chain], Drawing]:
    """The joints where the method puts them in the graph of links and joints; links as hulls of their joints."""

    def drawn(chain: Chain) -> Drawing:
        graph = nx.Graph()
        for k, joint in enumerate(chain.joints):
            graph.add_edges_from(((True, k), (False, chain.index(link))) for link in joint.links)
        if method is nx.planar_layout and not nx.check_planarity(graph)[0]:
            return np.zeros((0, 2)), []
        place = method(graph)
        points = np.array([place[True, k] for k in range(len(chain.joints))])
        return points, [hull(points, body) for body in bodies(chain).bodies]

    return drawn


def hull(points: np.ndarray, body: tuple[int, ...]) -> tuple[int, ...]:
    """The points of a body around their middle, which is their order on the hull where they are convex."""
    around = points[list(body)] - points[list(body)].mean(axis=0)
    return tuple(body[k] for k in np.argsort(np.arctan2(around[:, 1], around[:, 0])))


def edges(outline: tuple[int, ...]) -> Iterable[tuple[int, int]]:
    return pairwise((*outline, outline[0]) if len(outline) > 2 else outline)


def crossings(points: np.ndarray, outlines: list[tuple[int, ...]]) -> int:
    """Pairs of links that cross."""

    def side(a: int, b: int, c: int) -> bool:
        (ux, uy), (wx, wy) = points[b] - points[a], points[c] - points[a]
        return bool(ux * wy > uy * wx)

    def cross(e: tuple[int, int], f: tuple[int, int]) -> bool:
        if set(e) & set(f):
            return False
        return side(*e, f[0]) != side(*e, f[1]) and side(*f, e[0]) != side(*f, e[1])

    return sum(any(cross(e, f) for e in edges(one) for f in edges(two)) for one, two in combinations(outlines, 2))


def covered(points: np.ndarray, outlines: list[tuple[int, ...]]) -> int:
    """Joints within a link that does not carry them."""
    number = 0
    for outline in outlines:
        for p in set(range(len(points))) - set(outline) if len(outline) > 2 else ():
            z = (points[list(outline)] - points[p]) @ [1, 1j]
            number += abs(np.angle(np.roll(z, -1) / z).sum()) > 1
    return number


def clearance(points: np.ndarray, outlines: list[tuple[int, ...]]) -> float:
    """The smallest distance of a joint from an edge it does not end, relative to the longer side."""
    best = np.inf
    for outline in outlines:
        for a, b in edges(outline):
            others = np.delete(points, [a, b], axis=0)
            along = points[b] - points[a]
            t = np.clip((others - points[a]) @ along / max(along @ along, 1e-300), 0, 1)
            best = min(best, np.linalg.norm(others - points[a] - t[:, None] * along, axis=1).min())
    return float(best / np.ptp(points, axis=0).max())


def large(links: int, seed: int, reach: int) -> Chain:
    """A four-bar chain and dyads, each between two of so many links that came last: few of them keep it planar."""
    choice = random.Random(seed)
    edges, n = [(0, 1), (1, 2), (2, 3), (3, 0)], 4
    while n < links:
        a, b = choice.sample(range(max(0, n - reach), n), 2)
        edges += [(a, n), (n, n + 1), (n + 1, b)]
        n += 2
    return Chain.parse(" ".join(f"R({a}-{b})" for a, b in edges))


METHODS = {
    "ours": ours,
    "networkx spring": theirs(lambda graph: nx.spring_layout(graph, seed=1)),
    "networkx kamada_kawai": theirs(nx.kamada_kawai_layout),
    "networkx planar": theirs(nx.planar_layout),
}


def compare(found: list[Chain]) -> None:
    """A row for each method."""
    header = f"{'layout':22}{'chains':>7}{'crossings':>10}{'covered':>8}{'smallest':>9}{'median':>8}{'a second':>9}"
    print(f"{header}   (of processor time)")
    for name, method in METHODS.items():
        start = time.process_time()
        drawings = [drawing for drawing in map(method, found) if len(drawing[0])]
        seconds = time.process_time() - start
        if not drawings:
            print(f"{name:22}{0:>7}")
            continue
        gaps = [clearance(*drawing) for drawing in drawings]
        print(
            f"{name:22}{len(drawings):>7}{sum(crossings(*d) for d in drawings):>10}"
            f"{sum(covered(*d) for d in drawings):>8}{min(gaps):>9.3f}{np.median(gaps):>8.3f}"
            f"{len(found) / seconds:>9.3g}"
        )


def main() -> None:
    warnings.simplefilter("ignore")
    found = [chain for links in (4, 6, 8, 10) for chain in chains(links)]
    ours(found[0])  # kernels compiled and loaded
    ours(large(40, 0, 40))
    compare(found)
    start = time.process_time()
    page = gallery_html("", [Section("", tuple(Item(draw_structure(chain), "") for chain in found))])
    print(f"{len(found)} pictures on a page of {len(page) / 1e6:.2f} MB: {time.process_time() - start:.1f} s")
    for words, reach in (("planar", 3), ("not planar", 40)):
        many = [large(40, seed, reach) for seed in range(1, 20)]
        alike = [chain for chain in many if nx.check_planarity(chain.link_graph())[0] == (words == "planar")]
        print(f"\n40 links, {words}")
        compare(alike[:5])


if __name__ == "__main__":
    main()
