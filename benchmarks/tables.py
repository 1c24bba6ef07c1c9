"""The tables of docs/tables, made anew: `python -m benchmarks.tables [NAME ...]`.

Every table is a CSV file; `records.json` keeps for each the command, version, seconds and checksum.
"""

import csv
import io
import json
import sys
from collections.abc import Callable, Iterator
from hashlib import sha256
from pathlib import Path
from time import perf_counter

import gruebler as gr
from gruebler.assur import count_assur_groups
from gruebler.enumeration import Request, count_simple_chains
from gruebler.enumeration.worker_pool import ProcessPools
from gruebler.type_synthesis import count_sliding_variants

FOLDER = Path(__file__).parents[1] / "docs" / "tables"
Rows = Iterator[tuple[object, ...]]

# Most links for each mobility: what a core counts within some minutes.
_MOST = {0: 17, 1: 18, 2: 17, 3: 16, 4: 17, 5: 18, 6: 19, 7: 20}


def chains(most: int | None = None) -> Rows:
    """Chains that are not fractionated, their mechanisms and driven mechanisms."""
    yield "mobility", "links", "chains", "inversions", "drives", "joint_orbits"
    for mobility, largest in _MOST.items():
        for links in range(mobility + 3, min(largest, most or largest) + 1, 2):
            count = count_simple_chains(links, mobility, orbits=True)
            yield mobility, links, count.chains, count.inversions, count.drives, count.joint_orbits


def assur_groups(most: int | None = None) -> Rows:
    """Assur groups of simple turning joints."""
    yield "links", "groups"
    for links in range(2, min(16, most or 16) + 1, 2):
        yield links, count_assur_groups(links)


def sliding(most: int | None = None) -> Rows:
    """Typed chains by the number of sliding joints, all other joints turning, all joints moving."""
    yield "mobility", "links", "sliding", "chains"
    for mobility, largest in ((1, 12), (2, 9), (3, 8)):
        for links in range(mobility + 3, min(largest, most or largest) + 1, 2):
            numbers = count_sliding_variants(Request(links, mobility, "all"), executor=ProcessPools(2))
            yield from ((mobility, links, k, number) for k, number in enumerate(numbers))


def driven_by_class(most: int | None = None) -> Rows:
    """Driven mechanisms with F = 1 and the drive at the frame, by the highest class of their Assur groups."""
    yield "links", "highest_class", "driven_mechanisms"
    table = gr.atlas.open().query(
        "select links, highest_class, count(*) from driven where mobility = 1 group by all order by all"
    )
    for row in table.to_pylist():
        if most is None or row["links"] <= most:
            yield tuple(row.values())


TABLES: dict[str, Callable[[int | None], Rows]] = {
    table.__name__: table for table in (chains, assur_groups, sliding, driven_by_class)
}


def text_of(rows: Rows) -> str:
    """The rows as CSV."""
    text = io.StringIO(newline="")
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()


def main(names: list[str]) -> None:
    """Make tables; without names all."""
    path = FOLDER / "records.json"
    records = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
    for name in names or TABLES:
        begun = perf_counter()
        text = text_of(TABLES[name](None))
        (FOLDER / f"{name}.csv").write_text(text, encoding="utf-8")
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
