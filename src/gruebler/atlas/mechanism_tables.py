"""The rows of the tables of mechanisms and of driven mechanisms."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from gruebler.assur import decompose
from gruebler.atlas.schema import arrow, arrow_schema
from gruebler.chain import Chain
from gruebler.isomorphism import decode, symmetry
from gruebler.mechanism.inversion import driven_mechanisms, family
from gruebler.mechanism.model import Mechanism

if TYPE_CHECKING:
    import pyarrow as pa

__all__ = ["driven_table", "mechanism_table"]


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
    return arrow().Table.from_pylist(rows, schema=arrow_schema(name))
