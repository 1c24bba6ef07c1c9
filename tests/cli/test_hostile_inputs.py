"""Small inputs that ask for much: each ends with a value that a formula gives, or is refused with its size at once.

Each runs in a process of its own that may take 3 GB and some minutes of CPU: what would need more fails.
"""

import json
import subprocess
import sys

import pytest

from gruebler.structure.enumeration import count_chains

resource = pytest.importorskip("resource", reason="limits of time and memory are those of POSIX systems")
LIMITS = {resource.RLIMIT_CPU: 300} | ({resource.RLIMIT_AS: 3 * 10**9} if sys.platform == "linux" else {})


def run(*words):
    """Exit status, standard output and standard error of the command under the limits."""

    def limit():
        for kind, most in LIMITS.items():
            resource.setrlimit(kind, (most, most))

    done = subprocess.run(  # the words are those below
        [sys.executable, "-m", "gruebler", *words], capture_output=True, text=True, preexec_fn=limit, check=False
    )
    return done.returncode, done.stdout, done.stderr


def ring(n):
    return " ".join(f"R({k}-{(k + 1) % n})" for k in range(n))


def one_joint(n):
    return f"R({'-'.join(map(str, range(n)))})"


def paths(n):
    return " ".join(f"R(a-{k}) R({k}-b)" for k in range(n))


def complete(n):
    return " ".join(f"R({i}-{j})" for i in range(n) for j in range(i))


def triangles(n):
    """Triangles in a row, each joined to the next by one joint."""
    return " ".join(f"R(a{k}-b{k}) R(b{k}-c{k}) R(c{k}-a{k}) R(c{k}-a{k + 1})" for k in range(n - 1)) + (
        f" R(a{n - 1}-b{n - 1}) R(b{n - 1}-c{n - 1}) R(c{n - 1}-a{n - 1})"
    )


CHAINS = {
    # n - 3 freedoms, nothing redundant, no two links rigid.
    "ring 30,000": (ring(30_000), 29_997, 0, 0, 0, 0),
    # Each further link turns for itself.
    "one joint of 100,000": (one_joint(100_000), 99_999, 0, 0, 0, 0),
    # 3 (n + 1) unknowns, 4 n constraints, all held.
    "5,000 paths": (paths(5_000), 0, 5_000 * 4 - 3 * 5_001, 1, 1, 10_000),
    # 3 (n - 1) unknowns, 2 constraints for each of n (n - 1) / 2 joints.
    "K30": (complete(30), 0, 30 * 29 - 3 * 29, 1, 1, 435),
    "K60": (complete(60), 0, 60 * 59 - 3 * 59, 1, 1, 1770),
    # n rigid triangles that turn against their neighbours at n - 1 joints.
    "1,000 triangles": (triangles(1_000), 999, 0, 0, 1_000, 3_000),
}


@pytest.mark.parametrize("name", CHAINS)
def test_chains(tmp_path, name):
    text, generic, redundant, parts, clusters, immobile = CHAINS[name]
    path = tmp_path / "chain.txt"
    path.write_text(text)
    status, out, err = run("check", str(path), "--json")
    assert (status, err) == (0, "")
    (report,) = json.loads(out)
    assert (report["generic"], report["exact"]) == (generic, True)
    assert report["counted"] == generic - redundant
    assert [part["redundancy"] for part in report["overconstrained"]] == ([redundant] if parts else [])
    assert (len(report["rigid_clusters"]), len(report["immobile_joints"])) == (clusters, immobile)
    assert report["idle_freedoms"] == []


@pytest.mark.slow
def test_chains_whose_loops_cross_everywhere_are_refused_with_their_size(tmp_path):
    """A random cubic graph of 25,000 links leaves a dense core of some thousands."""
    import networkx as nx

    path = tmp_path / "chain.txt"
    path.write_text(" ".join(f"R({a}-{b})" for a, b in nx.random_regular_graph(3, 25_000, seed=1).edges))
    status, out, err = run("check", str(path))
    assert (status, out) == (2, "")
    assert "equations to be solved at once" in err
    assert "--yes" in err


def partitions(n):
    """p(n) by the parts, one size after the other."""
    ways = [1] + [0] * n
    for part in range(1, n + 1):
        for total in range(part, n + 1):
            ways[total] += ways[total - part]
    return ways


@pytest.mark.parametrize("links", [60, 100, 1000])
def test_assortments_are_counted(links):
    p = partitions(links - 4)
    status, out, _ = run("enumerate", "--assortments", "--links", str(links), "--count")
    assert status == 0
    assert int(out) == p[-1] - sum(p[: (links - 4) // 2])


def test_assortments_are_listed_as_they_come():
    status, out, _ = run("enumerate", "--assortments", "--links", "40", "--all")
    p = partitions(36)
    rows = out.splitlines()[1:]
    assert status == 0
    assert len(rows) == p[36] - sum(p[:18])
    for row in rows:
        numbers = list(map(int, row.split()))
        assert sum(numbers) == 40
        assert sum(i * k for i, k in enumerate(numbers, 2)) == 3 * 39 - 1


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("enumerate", "--assortments", "--links", "100"), "117,343,357 assortments"),
        (("enumerate", "--assortments", "--links", "100000"), "more than 10^45 assortments"),
        (("enumerate", "--assortments", "--links", "1000000", "--multiple-joints"), "more than 10^65 assortments"),
        (
            ("enumerate", "--assortments", "--links", "300", "--multiple-joints"),
            "109,437,677,344,010,375,993,271 assortments",
        ),
        (("enumerate", "--assortments", "--links", "10000000", "--count"), "more than a minute"),
        (("catalog", "search", "--enumerate", "--links", "14"), "this takes about"),
    ],
)
def test_long_lists_are_refused_with_their_size(words, said):
    status, out, err = run(*words)
    assert (status, out) == (2, "")
    assert said in err
    assert "--yes" in err


@pytest.mark.slow
def test_the_groups_of_ten_links_are_listed_without_consent():
    """As many as ways to choose the frame of an eleven-link truss, which enumeration counts without making groups."""
    status, out, err = run("assur", "--list", "10", "--count")
    assert (status, out, err) == (0, f"{count_chains(11, 0, orbits=True).inversions}\n", "")


def test_a_limit_ends_a_long_search_and_needs_no_consent():
    status, out, _ = run("catalog", "search", "--enumerate", "--links", "10", "--limit", "2")
    assert status == 0
    assert out.splitlines()[1].startswith("2  R(0-")


def test_a_row_of_a_thousand_wheels():
    teeth = [17 + k % 40 for k in range(1000)]
    train = " ".join(f"w{k}:{z}" for k, z in enumerate(teeth)) + "; drive w0=1"
    status, out, _ = run("gears", train, "--json")
    assert status == 0
    last = json.loads(out)["links"][-1]
    assert last["link"] == "w999"
    assert last["speed"]["value"] == pytest.approx(-17 / teeth[999], rel=1e-15)
