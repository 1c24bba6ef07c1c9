"""Building an atlas: its files, part by part, and at last its manifest."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from pathlib import Path
from typing import Any

from gruebler.base.atomic_files import PARTIAL, atomic_file, remove_abandoned_files
from gruebler.base.errors import RunError
from gruebler.base.text import reason_of
from gruebler.structure.atlas.parts import AtlasTask, Part, PartFile, PartWriter, identity_of, parts
from gruebler.structure.atlas.schema import SCHEMA, TABLES, arrow_library, columns_of
from gruebler.structure.enumeration.worker_pool import Progress, ProgressCounter, run_work

MANIFEST = "manifest.json"
_ATLAS = "gruebler atlas"


def build(
    task: AtlasTask,
    directory: Path,
    *,
    executor: Executor | Callable[[], Executor] | None = None,
    progress: Callable[[Progress], None] | None = None,
    expected: int | None = None,
) -> dict[str, Any]:
    """Build an atlas in a directory, or go on with one that was interrupted; returns its manifest.

    Args:
        task: what it contains.
        directory: created if it does not exist; workers on other machines need it under the same name.
        executor: see `enumeration.worker_pool.run_work`.
        progress: called after every part.
        expected: the number of chains, if it is known or estimated, for the progress.

    Every file appears complete or not at all, finished parts are not made again, and the files are the same byte for
    byte however often the work was interrupted. Cost on one core: some 30 us for a chain of 14 links; mechanisms and
    driven mechanisms some milliseconds each.

    Raises:
        RunError: the directory belongs to another task or version or contains other files, or cannot be written.
        GrueblerError: pyarrow is missing, or chains that are too large.
    """
    from gruebler import __version__

    arrow_library()
    identity = identity_of(task, __version__)
    begun = {"kind": _ATLAS, **json.loads(identity), "complete": False}
    _prepare(directory, begun, task)
    writer = PartWriter(directory.resolve(), task, identity)
    watch = ProgressCounter(progress, expected)
    under_way: dict[int, Part] = {}

    def numbered() -> Iterator[Part]:
        for number, part in enumerate(parts(task)):
            under_way[number] = part
            yield part

    def known(number: int) -> list[PartFile] | None:
        files = writer.existing(under_way.pop(number))
        if files is not None:
            watch.add(files[0].rows, fresh=False)
        return files

    def finished(_: int, files: list[PartFile]) -> None:
        watch.add(files[0].rows, fresh=True)

    files = [file for group in run_work(writer, numbered(), executor, known=known, finished=finished) for file in group]
    manifest = {**begun, "complete": True, "tables": {name: _summary(name, files) for name in task.tables}}
    _write_manifest(directory, manifest)
    return manifest


def _summary(table: str, files: Sequence[PartFile]) -> dict[str, Any]:
    """Rows and sums by mobility and links, and the files of a table with their checksums."""
    own = [file for file in files if file.table == table]
    partitions: dict[tuple[int, int], dict[str, int]] = {}
    for file in own:
        row = partitions.setdefault(
            (file.mobility, file.links), {"mobility": file.mobility, "links": file.links, "rows": 0}
        )
        row["rows"] += file.rows
        for name, number in file.sums.items():
            row[name] = row.get(name, 0) + number
    return {
        "rows": sum(file.rows for file in own),
        "columns": [column.name for column in columns_of(table)],
        "partitions": list(partitions.values()),
        "files": [{"path": f.path, "rows": f.rows, "bytes": f.bytes, "sha256": f.sha256} for f in own],
    }


def _prepare(directory: Path, begun: dict[str, Any], task: AtlasTask) -> None:
    """Make the directory ready; `RunError` if it contains anything but this atlas."""
    path = directory / MANIFEST
    try:
        directory.mkdir(parents=True, exist_ok=True)
        remove_abandoned_files(directory)
        if path.exists():
            _compare(directory, manifest_of(directory), begun)
        else:
            foreign = next((e.name for e in sorted(directory.iterdir()) if not e.name.endswith(PARTIAL)), None)
            if foreign is not None:
                raise RunError(
                    "{directory} holds other files, such as {name}: give the atlas a directory of its own",
                    directory=directory,
                    name=foreign,
                )
            _write_manifest(directory, begun)
        for table in task.tables:
            for folder in sorted((directory / table).glob("mobility=*/links=*")):
                remove_abandoned_files(folder)
    except OSError as error:
        raise RunError(
            "{directory} cannot hold an atlas: {reason}", directory=directory, reason=reason_of(error)
        ) from None


def _compare(directory: Path, manifest: dict[str, Any], begun: dict[str, Any]) -> None:
    for key in ("command", "version", "pyarrow"):
        if manifest.get(key) != begun[key]:
            raise RunError(
                "{directory} holds another atlas ({key}: {found}, not {expected}); give another directory or remove "
                "this one",
                directory=directory,
                key=key,
                found=manifest.get(key),
                expected=begun[key],
            )


def _write_manifest(directory: Path, manifest: dict[str, Any]) -> None:
    with atomic_file(directory / MANIFEST) as file:
        file.write(json.dumps(manifest, indent=1).encode() + b"\n")


def manifest_of(directory: Path) -> dict[str, Any]:
    """The manifest of an atlas.

    Raises:
        RunError: there is none, it cannot be read, it is that of something else, or its schema is newer.
    """
    path = directory / MANIFEST
    try:
        manifest = json.loads(path.read_bytes())
    except FileNotFoundError:
        raise RunError("{directory} is not an atlas: it has no {name}", directory=directory, name=MANIFEST) from None
    except OSError as error:
        raise RunError("{path} cannot be read: {reason}", path=path, reason=reason_of(error)) from None
    except (ValueError, RecursionError):
        manifest = None
    if not isinstance(manifest, dict) or manifest.get("kind") != _ATLAS or not isinstance(manifest.get("schema"), int):
        raise RunError("{path} is not the manifest of an atlas", path=path)
    if manifest["schema"] > SCHEMA:
        raise RunError(
            "{directory} was made by a newer version of gruebler: its schema is {found}, this version reads up to "
            "{known}",
            directory=directory,
            found=manifest["schema"],
            known=SCHEMA,
        )
    tables = manifest.get("tables", {})
    if not isinstance(tables, dict) or not set(tables) <= set(TABLES):
        raise RunError("{path} is not the manifest of an atlas", path=path)
    return manifest
