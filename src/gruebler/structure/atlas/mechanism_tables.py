"""The rows of the tables of mechanisms and of driven mechanisms."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gruebler import _core
from gruebler.structure.assur import AssurGroup, decompose
from gruebler.structure.assur.modes import modes_of_groups, modes_of_trusses, sets_of_ends
from gruebler.structure.atlas.schema import arrow_library, arrow_schema
from gruebler.structure.chain import Chain
from gruebler.structure.isomorphism import decode, symmetry
from gruebler.structure.mechanism.inversion import driven_mechanisms, family
from gruebler.structure.mechanism.model import Mechanism

if TYPE_CHECKING:
    import pyarrow as pa

_BULK_LINKS = 7  # from here on: smaller chains have names of families, and their rows are few
_NAMED = 4  # Assur groups of more links have no names
_GROUP_HEAD = 4  # columns of a kind of group before its joints
_JOINTS = 3  # the column with their number


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
        "assembly_modes": modes_of_groups(group.shape for group in groups),
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
    """
    pa = arrow_library()
    if not chains.num_rows or chains["links"][0].as_py() < _BULK_LINKS:
        return None
    n, joints = chains["links"][0].as_py(), chains["joints"][0].as_py()
    codes = chains["code"].combine_chunks()
    codes = codes.chunk(0) if isinstance(codes, pa.ChunkedArray) else codes
    lengths = pa.compute.binary_length(codes).to_numpy()
    text = np.frombuffer("".join(codes.to_pylist()).encode("ascii"), np.uint8)
    ends = np.cumsum(lengths).astype(np.int64)
    frames, drives, groups = _core.list_mechanisms(n, joints, text, ends, driven)

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
        "mechanisms": common(frames[:, 0])
        | {"frame": frames[:, 1], "frame_joints": frames[:, 2], "orbit": frames[:, 3]}
    }
    if driven:
        tables["driven"] = common(drives[:, 0]) | _driven_columns(drives, groups)
    return {
        name: pa.Table.from_arrays(
            [column(values[field.name], field.name, name) for field in arrow_schema(name)], schema=arrow_schema(name)
        )
        for name, values in tables.items()
    }


def _driven_columns(drives: NDArray[np.int32], kinds: NDArray[np.int16]) -> dict[str, Any]:
    """The columns of driven mechanisms, from rows of chain, frame, driven link, number of groups and groups."""
    pa = arrow_library()
    frame, driven, count, numbers = drives[:, 1], drives[:, 2], drives[:, 3], drives[:, 4:]
    present = np.arange(numbers.shape[1]) < count[:, None]
    flat = numbers[present]
    offsets = pa.array(np.concatenate([[0], np.cumsum(count)]).astype(np.int32))
    links, classes, orders = kinds[:, 0], kinds[:, 1], kinds[:, 2]
    texts = pa.array([_form(row.tolist()) for row in kinds], pa.string())

    def lists(values: Any, name: str) -> Any:
        return pa.ListArray.from_arrays(offsets, values).cast(arrow_schema("driven").field(name).type)

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
        "orders": lists(pa.array(orders[flat]), "orders"),
        "highest_class": highest,
        "dyads_only": (np.where(present, links[numbers], 2) == 2).all(axis=1),
        "assembly_modes": np.where(present, _modes(kinds)[numbers], 1).prod(axis=1),
    }


def _modes(kinds: NDArray[np.int16]) -> NDArray[np.int64]:
    """The assembly modes of each kind of group."""
    modes = np.ones(len(kinds), np.int64)
    for links in np.unique(kinds[:, 0]).tolist():
        alike = kinds[:, 0] == links
        joints = kinds[alike][0, _JOINTS]
        ends = kinds[alike][:, _GROUP_HEAD : _GROUP_HEAD + 2 * joints].astype(np.int64)
        degrees = (ends[:, :, None] == np.arange(ends.max() + 1)).sum(axis=1)
        # A place outside has one joint; they are link 0 of the truss.
        number = np.where(degrees > 1, np.cumsum(degrees > 1, axis=1), 0)
        own = np.take_along_axis(number, ends, axis=1).reshape(len(ends), joints, 2)
        modes[alike] = modes_of_trusses(links + 1, sets_of_ends(own.astype(np.uint8)))
    return modes


def _form(row: list[int]) -> str:
    """The form of a kind of group, a row of links, class, order, number of joints, joints: its name, else its code."""
    links, joints = row[0], row[_JOINTS]
    pairs = row[_GROUP_HEAD : _GROUP_HEAD + 2 * joints]
    code = "gr1:" + "".join(f"R({a}-{b})" for a, b in zip(pairs[::2], pairs[1::2], strict=True))
    return AssurGroup.known(decode(code).chain).form if links <= _NAMED else code
