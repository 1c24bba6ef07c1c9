"""The rows of the tables of mechanisms and of driven mechanisms."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gruebler.base.errors import GrueblerError
from gruebler.structure.assur import AssurGroup, decompose
from gruebler.structure.atlas.schema import arrow_library, arrow_schema
from gruebler.structure.chain import Chain
from gruebler.structure.isomorphism import decode, symmetry
from gruebler.structure.mechanism.inversion import driven_mechanisms, family
from gruebler.structure.mechanism.model import Mechanism

if TYPE_CHECKING:
    import pyarrow as pa

    from gruebler.structure.atlas.mechanism_kernels import MechanismMemory

_BULK_LINKS = 7  # from here on: smaller chains have names of families, and their rows are few
_NAMED = 4  # Assur groups of more links have no names
_GROUPS = 1 << 19  # the most kinds of groups in a part of the work
_INTERPRETED = 1e-4  # seconds for each link of a driven mechanism, if the kernel is interpreted


def mechanism_table(codes: Iterable[str], mobility: int) -> pa.Table:
    """A row for each mechanism of the chains with these codes: an orbit of links as frame."""
    rows = []
    for code in codes:
        chain = decode(code).chain
        for orbit in symmetry(chain).link_orbits:
            rows.append(
                {
                    "links": chain.n,
                    "mobility": mobility,
                    "chain": code,
                    "frame": int(orbit[0]),
                    "frame_joints": chain.degrees[orbit[0]],
                    "orbit": len(orbit),
                    "family": _family(Mechanism(chain, orbit[0])),
                }
            )
    return _table("mechanisms", rows)


def driven_table(codes: Iterable[str], mobility: int, *, at_frame: bool) -> pa.Table:
    """A row for each driven mechanism of the chains with these codes, as many drives as freedoms, all motion fixed.

    Args:
        codes: codes of chains.
        mobility: F of all of them.
        at_frame: whether every drive acts on the frame; otherwise drives between moving links are listed too.

    Cost: some milliseconds for each row.
    """
    rows = []
    for code in codes if mobility else ():
        chain = decode(code).chain
        for driven in driven_mechanisms(chain, drives=mobility, at_frame=at_frame, fixed_only=True):
            rows.append(_driven_row(code, chain, mobility, driven.mechanism))
    return _table("driven", rows)


def _driven_row(code: str, chain: Chain, mobility: int, mechanism: Mechanism) -> dict[str, Any]:
    groups = decompose(mechanism).groups
    drives = [sorted(drive.between, key=int) for drive in mechanism.drives]
    classes = [group.class_number for group in groups]
    return {
        "links": chain.n,
        "mobility": mobility,
        "chain": code,
        "frame": int(mechanism.frame),
        "drives": " ".join("-".join(pair) for pair in drives),
        "at_frame": all(mechanism.frame in pair for pair in drives),
        "groups": [group.form() for group in groups],
        "classes": classes,
        "orders": [group.order for group in groups],
        "highest_class": max(classes, default=0),
        "dyads_only": all(len(group.bodies) == 2 for group in groups),
        "family": _family(mechanism),
    }


def _family(mechanism: Mechanism) -> str | None:
    """The name of the family; those with a name have six links at most."""
    return family(mechanism) if mechanism.chain.n <= 6 else None


def _table(name: str, rows: list[dict[str, Any]]) -> pa.Table:
    return arrow_library().Table.from_pylist(rows, schema=arrow_schema(name))


# --- many chains at once -----------------------------------------------------------------------------


def bulk_tables(chains: pa.Table, *, driven: bool) -> dict[str, pa.Table] | None:
    """The rows of `mechanism_table` and, with drives at the frame, `driven_table`, without an object for each.

    Args:
        chains: rows of the table of chains, of one number of links and F = 1, with simple turning joints.
        driven: whether driven mechanisms are listed as well.

    Returns:
        The tables ``mechanisms`` and ``driven``; None for chains of few links, whose families have names.

    Cost: some 10 us for each driven mechanism.

    Raises:
        GrueblerError: more kinds of Assur groups than there is room for.
    """
    pa = arrow_library()
    from gruebler._numeric.compiling import for_work
    from gruebler.structure.atlas import mechanism_kernels as kernels

    if not chains.num_rows or chains["links"][0].as_py() < _BULK_LINKS:
        return None
    n, joints = chains["links"][0].as_py(), chains["joints"][0].as_py()
    codes = chains["code"].combine_chunks()
    codes = codes.chunk(0) if isinstance(codes, pa.ChunkedArray) else codes
    lengths = pa.compute.binary_length(codes).to_numpy()
    text = np.frombuffer("".join(codes.to_pylist()).encode("ascii"), np.uint8)
    memory = kernels.make_mechanism_memory(n, joints, min(_GROUPS, 64 + 8 * int(chains["drives"].to_numpy().sum())))
    frames = np.zeros((int(chains["inversions"].to_numpy().sum()), 4), np.int32)
    rows = int(chains["drives"].to_numpy().sum()) if driven else 0
    drives = np.zeros((rows, kernels.GROUPS + 1 + (n - 2) // 2), np.int32)
    counts = np.zeros(2, np.int64)
    find = for_work(kernels.list_mechanisms, _INTERPRETED * n * (rows + len(codes)))
    if not find(n, joints, text, np.cumsum(lengths).astype(np.int64), memory, frames, drives, counts):
        raise GrueblerError("a part of the atlas has too many kinds of Assur groups; take smaller pieces of work")

    def column(values: Any, name: str, table: str) -> Any:
        kind = arrow_schema(table).field(name).type
        array = values if isinstance(values, pa.Array) else pa.array(values)
        return array if array.type == kind else array.cast(kind)

    def common(chain: NDArray[np.int32]) -> dict[str, Any]:
        size = len(chain)
        return {
            "links": np.full(size, n),
            "mobility": np.ones(size, np.int64),
            "chain": codes.take(pa.array(chain)),
            "family": pa.nulls(size, pa.string()),
        }

    tables = {
        "mechanisms": common(frames[:, kernels.CHAIN])
        | {
            "frame": frames[:, kernels.FRAME],
            "frame_joints": frames[:, kernels.FRAME_JOINTS],
            "orbit": frames[:, kernels.ORBIT],
        }
    }
    if driven:
        tables["driven"] = common(drives[:, kernels.CHAIN]) | _driven_columns(drives, memory)
    return {
        name: pa.Table.from_arrays(
            [column(values[field.name], field.name, name) for field in arrow_schema(name)], schema=arrow_schema(name)
        )
        for name, values in tables.items()
    }


def _driven_columns(drives: NDArray[np.int32], memory: MechanismMemory) -> dict[str, Any]:
    from gruebler.structure.atlas import mechanism_kernels as kernels

    pa = arrow_library()
    count = drives[:, kernels.GROUPS]
    present = np.arange(drives.shape[1] - kernels.GROUPS - 1) < count[:, None]
    numbers = drives[:, kernels.GROUPS + 1 :]
    flat = numbers[present]
    offsets = pa.array(np.concatenate([[0], np.cumsum(count)]).astype(np.int32))
    kinds = memory.groups[: int(memory.state[0])]
    classes = kinds[:, kernels.CLASS]
    texts = pa.array([_form(row.tolist()) for row in kinds], pa.string())

    def lists(values: Any, name: str) -> Any:
        return pa.ListArray.from_arrays(offsets, values).cast(arrow_schema("driven").field(name).type)

    frame, driven = drives[:, kernels.FRAME], drives[:, kernels.DRIVEN]
    least, greatest = np.minimum(frame, driven), np.maximum(frame, driven)
    pairs, place = np.unique(least * 256 + greatest, return_inverse=True)
    names = pa.array([f"{pair // 256}-{pair % 256}" for pair in pairs.tolist()], pa.string())
    highest = np.where(present, classes[numbers], 0).max(axis=1)
    return {
        "frame": frame,
        "drives": names.take(pa.array(place.reshape(-1))),
        "at_frame": np.ones(len(drives), np.bool_),
        "groups": lists(texts.take(pa.array(flat)), "groups"),
        "classes": lists(pa.array(classes[flat]), "classes"),
        "orders": lists(pa.array(kinds[flat, kernels.ORDER]), "orders"),
        "highest_class": highest,
        "dyads_only": (np.where(present, kinds[numbers, kernels.LINKS], 2) == 2).all(axis=1),
    }


def _form(row: list[int]) -> str:
    """The form of a group of the table of groups: its name if it has one, else its code."""
    from gruebler.structure.atlas import mechanism_kernels as kernels

    pairs = row[kernels.HEAD : kernels.HEAD + 2 * row[kernels.JOINTS]]
    code = "gr1:" + "".join(f"R({a}-{b})" for a, b in zip(pairs[::2], pairs[1::2], strict=True))
    return AssurGroup.known(decode(code).chain).form if row[kernels.LINKS] <= _NAMED else code
