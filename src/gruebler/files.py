"""`read` and `write`: any value in a file, by the ending of its name and by what the file holds."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gruebler.atomic_files import atomic_file
from gruebler.documents import load_document
from gruebler.errors import GrueblerError

if TYPE_CHECKING:
    from typing import TypeAlias

    from gruebler.chain import Chain
    from gruebler.gears import TrainReading
    from gruebler.linkages import Linkage
    from gruebler.screws import SpatialLinkage
    from gruebler.synthesis import Task

    Value: TypeAlias = Chain | list[Chain] | Linkage | SpatialLinkage | TrainReading | Task

__all__ = ["read", "write"]

_TASKS = frozenset({"positions", "points", "inputs", "swing", "stroke"}) - {"joints"}
_ENDINGS = ".toml, .json, .csv, .g6 or .txt"


def read(path: str | PathLike[str]) -> Value:
    """The value in a file.

    ``.toml`` and ``.json`` hold a linkage with its dimensions, a linkage by joint screws, a task of synthesis, a gear
    train (``train``, TOML only) or chains (JSON only); ``.csv`` a task; ``.g6`` and ``.txt`` chains, one a line.

    Raises `GrueblerError` that names the file and what does not fit.
    """
    path = Path(path)
    match path.suffix.lower():
        case ".csv":
            from gruebler.synthesis import read_task

            return read_task(path)
        case ".g6" | ".txt":
            return _chains(path)
        case ".toml" | ".json":
            return _document(path)
        case suffix:
            raise GrueblerError(
                "{path}: expected {endings}, not {suffix!r}", path=path, endings=_ENDINGS, suffix=suffix
            )


def _chains(path: Path) -> list[Chain]:
    from gruebler.chain import Chain
    from gruebler.formats.structures import read_structures

    return [structure.value for structure in read_structures(path) if isinstance(structure.value, Chain)]


def _document(path: Path) -> Value:
    data = load_document(path, lambda text: GrueblerError("{path}: {problem}", path=path, problem=text))
    if isinstance(data, list):
        return [_chain(path, item) for item in data]
    if not isinstance(data, Mapping):
        raise GrueblerError("{path}: expected a table of keys", path=path)
    if not _TASKS.isdisjoint(data):
        from gruebler.synthesis import read_task

        return read_task(path)
    if "train" in data:
        from gruebler.gears import read_toml

        return read_toml(path.read_text(encoding="utf-8-sig"), str(path))
    if "pair" in str(data.get("joints", ""))[:200] and not isinstance(data.get("joints"), str):
        return _chain(path, data)
    from gruebler.formats.screws import read_any_linkage

    return read_any_linkage(path)


def _chain(path: Path, document: Any) -> Chain:
    from gruebler.chain import Chain

    try:
        return Chain.from_json(document)
    except GrueblerError as error:
        raise GrueblerError("{path}: {error}", path=path, error=error) from None


def write(value: object, path: str | PathLike[str]) -> Path:
    """Write a value into a file that `read` takes back; returns the path.

    A linkage or task goes to ``.toml`` or ``.json``, a task also to ``.csv``, a chain or a list of chains to ``.json``,
    ``.txt`` or ``.g6``. The file appears complete or not at all.

    Raises `GrueblerError` for a value or an ending that do not go together, and if the two are exchanged.
    """
    if isinstance(value, str | PathLike) and not isinstance(path, str | PathLike):
        raise GrueblerError("write(value, path): the value comes first, then {path!r}", path=fspath(value))
    if not isinstance(path, str | PathLike):
        raise GrueblerError("write(value, path): expected the path of a file, but found {path!r}", path=path)
    from gruebler.chain import Chain
    from gruebler.linkages import Linkage
    from gruebler.linkages.conversion import makes_linkage
    from gruebler.synthesis import Task

    path = Path(path)
    if isinstance(value, Linkage) or makes_linkage(value):
        from gruebler.formats import write_linkage

        write_linkage(path, value if isinstance(value, Linkage) else value.linkage())
    elif isinstance(value, Task):
        from gruebler.synthesis import write_task

        write_task(path, value)
    elif isinstance(value, Chain):
        _write_chains(path, [value], alone=True)
    elif isinstance(value, Sequence) and value and all(isinstance(item, Chain) for item in value):
        _write_chains(path, list(value), alone=False)
    else:
        raise GrueblerError(
            "a {kind} cannot be written; linkages, tasks, chains and lists of chains can", kind=type(value).__name__
        )
    return path


def _write_chains(path: Path, chains: list[Chain], *, alone: bool) -> None:
    match path.suffix.lower():
        case ".json":
            documents = [chain.to_json() for chain in chains]
            text = json.dumps(documents[0] if alone else documents, ensure_ascii=False, indent=1) + "\n"
        case ".txt":
            text = "".join(f"{chain.text()}\n" for chain in chains)
        case ".g6":
            text = "".join(f"{_graph6(chain)}\n" for chain in chains)
        case suffix:
            raise GrueblerError("{path}: chains go to .json, .txt or .g6, not {suffix!r}", path=path, suffix=suffix)
    with atomic_file(path, durable=False) as file:
        file.write(text.encode("utf-8"))


def _graph6(chain: Chain) -> str:
    """The chain as a graph; `GrueblerError` if it has other joints than simple revolute ones."""
    import networkx

    if any(joint.count != 1 or joint.pair.name != "revolute" for joint in chain.joints):
        raise GrueblerError("graph6 holds chains with simple revolute joints only, not {chain}", chain=chain.text())
    graph = networkx.Graph()
    graph.add_nodes_from(range(chain.n))
    graph.add_edges_from(tuple(map(chain.index, joint.links)) for joint in chain.joints)
    return str(networkx.to_graph6_bytes(graph, header=False).decode("ascii").strip())
