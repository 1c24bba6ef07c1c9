"""The small atlas that comes with the library, made anew: `python -m tests.structure.atlas.making_small DIR`.

It has the chains with simple joints to 10 links of every mobility, fractionated ones included, and their mechanisms;
the driven mechanisms with the drive at the frame for F = 1. One file for each table keeps it small.
"""

from __future__ import annotations

import json
import sys
from hashlib import sha256
from pathlib import Path

from gruebler.base.atomic_files import atomic_file, temporary_directory
from gruebler.structure.atlas.building import MANIFEST, build
from gruebler.structure.atlas.parts import AtlasTask, read_part, write_parquet
from gruebler.structure.atlas.schema import arrow_library


def make_small_atlas(directory: Path, most: int = 10) -> None:
    """Write the small atlas, with chains of so many links at most, into a directory; files there are replaced."""
    directory.mkdir(parents=True, exist_ok=True)
    tasks = (
        AtlasTask(links=f"4-{most}", mobility=f"0-{most - 3}", fractionated="all", inversions=True),
        AtlasTask(links=f"4-{most}", mobility="1", inversions=True, drives="frame"),
    )
    with temporary_directory() as folder:
        every = build(tasks[0], folder / "all")
        driven = build(tasks[1], folder / "driven")
        manifest = {**every, "command": "; ".join(task.command() for task in tasks), "tables": {}}
        for table, source in (("chains", every), ("mechanisms", every), ("driven", driven)):
            where = folder / ("driven" if source is driven else "all")
            files = [read_part(where / file["path"])[0] for file in source["tables"][table]["files"]]
            path = directory / f"{table}.parquet"
            write_parquet(arrow_library().concat_tables(files), path, {"part": path.name})
            content = path.read_bytes()
            rows = source["tables"][table]["rows"]
            file = {"path": path.name, "rows": rows, "bytes": len(content), "sha256": sha256(content).hexdigest()}
            manifest["tables"][table] = {**source["tables"][table], "files": [file]}
    with atomic_file(directory / MANIFEST) as written:
        written.write(json.dumps(manifest, indent=1).encode() + b"\n")


if __name__ == "__main__":
    make_small_atlas(Path(sys.argv[1]))
