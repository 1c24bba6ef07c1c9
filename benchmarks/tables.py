"""The tables of docs/tables, made anew: `python -m benchmarks.tables [NAME ...]`; `--check [SECONDS]` only compares.

Every table is a CSV file; `records.json` keeps for each the command, version, seconds and checksum. The environment
variable TABLES_CHECKPOINT names a directory for finished pieces of the count of 20 links, which takes 25 minutes.
"""

import csv
import io
import json
import os
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from hashlib import sha256
from pathlib import Path
from time import perf_counter

import gruebler as gr
from benchmarks.evidence import check_chains
from benchmarks.real_modes import real_modes_of, stored_rows
from gruebler.structure.assur import count_assur_groups
from gruebler.structure.assur.modes import modes_of_trusses, sets_of_ends
from gruebler.structure.enumeration import Request, edge_blocks
from gruebler.structure.enumeration.counting import ChainCount
from gruebler.structure.enumeration.epicyclic import count_epicyclic_trains
from gruebler.structure.enumeration.run_request import run_count
from gruebler.structure.enumeration.worker_pool import ProcessPools
from gruebler.structure.type_synthesis import count_sliding_variants

FOLDER = Path(__file__).parents[1] / "docs" / "tables"
Rows = Iterator[tuple[object, ...]]

# Most links for each mobility: what a core counts within some minutes.
_MOST = {0: 17, 1: 20, 2: 19, 3: 18, 4: 19, 5: 20, 6: 21, 7: 22}


def _counted(links: int, mobility: int = 1) -> ChainCount:
    folder = os.environ.get("TABLES_CHECKPOINT") if (links, mobility) == (20, 1) else None
    return run_count(Request(links, mobility=mobility), orbits=True, checkpoint=Path(folder) if folder else None)


def chains(most: int | None = None) -> Rows:
    """Chains that are not fractionated, their mechanisms and driven mechanisms."""
    yield "mobility", "links", "chains", "inversions", "drives", "joint_orbits"
    for mobility, largest in _MOST.items():
        for links in range(mobility + 3, min(largest, most or largest) + 1, 2):
            count = _counted(links, mobility)
            yield mobility, links, count.chains, count.inversions, count.drives, count.joint_orbits


def fractionated(most: int | None = None) -> Rows:
    """All chains of simple turning joints by where they fall apart: nowhere, at a link, at a joint."""
    yield "mobility", "links", "not_fractionated", "at_a_link", "at_a_joint"
    for mobility, largest in ((2, 15), (3, 14), (4, 13), (5, 14), (6, 13), (7, 14)):
        for links in range(mobility + 3, min(largest, most or largest) + 1, 2):
            count = gr.count_chains(links, mobility, fractionated="all").by_fractionation
            yield mobility, links, *(count[kind] for kind in ("none", "link", "joint"))


def multiple_joints(most: int | None = None) -> Rows:
    """Chains of turning joints by the number of multiple joints, fractionated ones included."""
    yield "mobility", "links", "multiple_joints", "chains"
    for mobility, largest in ((0, 11), (1, 12), (2, 11), (3, 12)):
        for links in range(mobility + 3, min(largest, most or largest) + 1, 2):
            if mobility < 2:  # counted without being built
                rest, number = gr.count_chains(links, mobility, multiple_joints="any").chains, 0
                while rest:
                    count = gr.count_chains(links, mobility, multiple_joints=number).chains
                    yield mobility, links, number, count
                    rest, number = rest - count, number + 1
            else:
                all_chains = gr.chains(links, mobility, fractionated="all", multiple_joints="any")
                numbers = Counter(len(chain.multiple_joints) for chain in all_chains)
                yield from ((mobility, links, number, numbers[number]) for number in range(max(numbers) + 1))


def epicyclic_trains(most: int | None = None) -> Rows:
    """Epicyclic trains by displacement graphs and by rotation graphs."""
    yield "mobility", "links", "displacement_graphs", "rotation_graphs"
    for mobility in (1, 2, 3):
        for links in range(mobility + 2, min(9, most or 9) + 1):
            yield mobility, links, *count_epicyclic_trains(links, mobility)


def second_method(most: int | None = None) -> Rows:
    """Chains with F = 1 by assortment, and how many of them a second method counted: `evidence.check_chains`."""
    yield "links", "assortment", "chains", "contracted_graphs", "graphs_counted_twice", "chains_counted_twice"
    for links in range(6, min(20, most or 20) + 1, 2):
        count = _counted(links).by_assortment
        for row in check_chains(links, 10**9 if links <= 14 else 10**5):
            assortment = ",".join(map(str, row.assortment))
            yield links, assortment, count.get(row.assortment, 0), row.graphs, row.checked, row.chains


_SAMPLES = dict.fromkeys((6, 8, 10, 12), 200_000) | {
    14: 2 * 10**6,
    16: 2 * 10**6,
    18: 10**7,
    20: 6 * 10**7,
    22: 8 * 10**7,
    24: 3 * 10**7,
}


def sampled_chains(most: int | None = None) -> Rows:
    """Chains with F = 1, estimated from random pairings by a pebble game, beyond the lists too."""
    from tests.structure.enumeration.sampling_oracle import sampled_chains as sampled

    yield "links", "estimate", "standard_deviation", "samples"
    for links, samples in _SAMPLES.items():
        if links <= (most or links):
            found = sampled(links, samples)
            yield links, round(found.chains), round(found.deviation, 2 if links < 12 else None), found.samples


_MOST_LOOPS = {2: 8, 3: 7, 4: 7, 5: 7, 6: 7, 7: 7}  # of the table chains, by F
_LOOP_SAMPLES = dict.fromkeys((2, 3, 4), 200_000) | dict.fromkeys((5, 6), 2 * 10**6) | {7: 10**7, 8: 10**7}


def sampled_by_mobility(most: int | None = None) -> Rows:
    """Chains with F = 2 to 7 that are not fractionated, estimated from random pairings by a pebble game."""
    from tests.structure.enumeration.sampling_oracle import sampled_chains as sampled

    yield "mobility", "links", "estimate", "standard_deviation", "samples"
    for mobility, last in _MOST_LOOPS.items():
        for loops in range(2, last + 1):
            links = 2 * loops + 1 + mobility
            if links <= (most or links):
                found = sampled(links, _LOOP_SAMPLES[loops], mobility=mobility)
                yield mobility, links, round(found.chains), round(found.deviation, 2), found.samples


def assur_groups(most: int | None = None) -> Rows:
    """Assur groups of simple turning joints."""
    yield "links", "groups"
    for links in range(2, min(16, most or 16) + 1, 2):
        yield links, count_assur_groups(links)


def assembly_modes(most: int | None = None) -> Rows:
    """Complex assembly modes of the Baranov trusses: least, most and sum in the plane and on the sphere."""
    yield "links", "trusses", "least", "most", "sum", "spherical_least", "spherical_most", "spherical_sum"
    for links in range(3, min(13, most or 13) + 1, 2):
        _, planar, spherical = zip(*_truss_modes(links), strict=True)
        kinds = (planar, spherical)
        yield links, len(planar), *(value for modes in kinds for value in (min(modes), max(modes), sum(modes)))


def truss_modes(most: int | None = None) -> Rows:
    """Every Baranov truss to 11 links with its assembly modes; joints as pairs of links."""
    yield "links", "joints", "modes", "spherical_modes"
    for links in range(3, min(11, most or 11) + 1, 2):
        yield from ((links, *row) for row in _truss_modes(links))


def _truss_modes(links: int) -> Iterator[tuple[str, int, int]]:
    for block in edge_blocks(links, 0):
        sets = sets_of_ends(block)
        modes = (modes_of_trusses(links, sets, spherical=spherical).tolist() for spherical in (False, True))
        for ends, planar, spherical in zip(block.tolist(), *modes, strict=True):
            yield " ".join(f"{a}-{b}" for a, b in ends), planar, spherical


def real_modes(most: int | None = None) -> Rows:
    """The Baranov trusses to 9 links with the dimensions of `benchmarks.real_modes`, solved again from other starts."""
    yield "links", "joints", "modes", "real_modes", "points"
    for links, joints, modes, _, points in stored_rows():
        if int(links) <= (most or int(links)):
            yield links, joints, modes, real_modes_of(joints, points, int(modes)), points


def sliding(most: int | None = None) -> Rows:
    """Typed chains by the number of sliding joints, all other joints turning, all joints moving."""
    yield "mobility", "links", "sliding", "chains"
    for mobility, largest in ((1, 12), (2, 9), (3, 8)):
        for links in range(mobility + 3, min(largest, most or largest) + 1, 2):
            numbers = count_sliding_variants(
                Request(links, mobility=mobility, fractionated="all"), executor=ProcessPools(2)
            )
            yield from ((mobility, links, k, number) for k, number in enumerate(numbers))


def driven_by_class(most: int | None = None) -> Rows:
    """Driven mechanisms with F = 1 and the drive at the frame, by the highest class of their Assur groups."""
    yield "links", "highest_class", "driven_mechanisms"
    table = gr.structure.atlas.open().query(
        "select links, highest_class, count(*) from driven where mobility = 1 group by all order by all"
    )
    for row in table.to_pylist():
        if most is None or row["links"] <= most:
            yield tuple(row.values())


TABLES: dict[str, Callable[[int | None], Rows]] = {
    table.__name__: table
    for table in (
        chains,
        fractionated,
        multiple_joints,
        sliding,
        assur_groups,
        assembly_modes,
        truss_modes,
        real_modes,
        driven_by_class,
        epicyclic_trains,
        second_method,
        sampled_chains,
        sampled_by_mobility,
    )
}


def text_of(rows: Rows) -> str:
    """The rows as CSV."""
    text = io.StringIO(newline="")
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()


def compared(most: float) -> Iterator[tuple[str, str]]:
    """Names of tables, and whether the same bytes come again; what takes longer is only named, with its command."""
    for name, record in json.loads((FOLDER / "records.json").read_text(encoding="utf-8")).items():
        if record["seconds"] > most:
            yield name, f"not made, {record['seconds']:.0f} s: {record['command']}"
        else:
            same = sha256(text_of(TABLES[name](None)).encode()).hexdigest() == record["sha256"]
            yield name, "the same" if same else "OTHER THAN the file"


def main(names: list[str]) -> None:
    """Make tables, without names all; or compare them."""
    if names[:1] == ["--check"]:
        verdicts = []
        for name, verdict in compared(float(names[1]) if names[1:] else 300):
            verdicts.append(verdict)
            print(f"{name:20}{verdict}", flush=True)
        sys.exit(any(verdict.startswith("OTHER") for verdict in verdicts))
    path = FOLDER / "records.json"
    for name in names or TABLES:
        begun = perf_counter()
        text = text_of(TABLES[name](None))
        (FOLDER / f"{name}.csv").write_text(text, encoding="utf-8")
        records = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
        records[name] = {
            "command": f"python -m benchmarks.tables {name}",
            "version": gr.__version__,
            "seconds": round(perf_counter() - begun, 1),
            "sha256": sha256(text.encode()).hexdigest(),
        }
        path.write_text(json.dumps(dict(sorted(records.items())), indent=1) + "\n", encoding="utf-8")
        print(name, records[name]["seconds"])


if __name__ == "__main__":
    main(sys.argv[1:])
