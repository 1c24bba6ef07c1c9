"""The columns of the atlas: one table says name, type, unit, meaning and origin of each.

Definitions and theorems: docs/theory/atlas.md. The same texts stand in the metadata of every file.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, message

if TYPE_CHECKING:
    import pyarrow as pa

SCHEMA = 2
"""The version of the columns; a change of a column or of its meaning raises it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SchemaColumn:
    """A column of a table."""

    table: str
    name: str
    type: str
    """``int16``, ``int32``, ``int64``, ``bool``, ``string``, ``list<...>``; with ``?`` if it may be empty."""
    unit: str
    definition: Message
    origin: str


_DESCRIBED = "_core.describe_chains"

_CHAINS = (
    ("links", "int16", "links", message("number of links n"), "request"),
    ("mobility", "int16", "freedoms", message("F = 3(n - 1) - 2 g1, all joints turning or sliding"), "request"),
    ("loops", "int16", "loops", message("independent loops, (n - 1 - F)/2"), "enumeration.assortment"),
    ("joints", "int16", "joints", message("number of joints, a multiple joint counted once"), "the chain"),
    ("multiple_joints", "int16", "joints", message("joints of three links or more"), "the chain"),
    ("prismatic", "int16", "joints", message("sliding joints; all others turn"), "type_synthesis.joint_types"),
    (
        "fractionated",
        "string",
        "",
        message("none, link or joint: where the chain falls apart"),
        "enumeration.fractionation",
    ),
    ("assortment", "string", "links", message("numbers of links with 2, 3, ... joints, such as 4,4"), "the chain"),
    ("graph6", "string?", "", message("the chain as graph6, links in canonical order; simple joints"), _DESCRIBED),
    ("code", "string", "", message("canonical code, equal exactly for chains of one structure"), "isomorphism"),
    (
        "contracted_graph",
        "int32?",
        "",
        message(
            "number of the contracted graph among those of as many loops, from 0; if not fractionated, with simple "
            "joints, of two loops or more"
        ),
        "enumeration.contracted_graphs",
    ),
    (
        "contracted_code",
        "string?",
        "",
        message("its bundles: node-node, and x and the number of strings if there are several"),
        "enumeration.ContractedGraph",
    ),
    ("group_order", "int64", "", message("number of automorphisms"), "isomorphism.labelling"),
    ("inversions", "int32", "", message("orbits of links: mechanisms by choice of the frame"), _DESCRIBED),
    ("joint_orbits", "int32", "", message("orbits of joints"), _DESCRIBED),
    ("drives", "int32", "", message("orbits of (frame, joint at it, link that the joint drives)"), _DESCRIBED),
    ("planar", "bool", "", message("whether the graph of links can be drawn without crossings"), "networkx"),
    (
        "crossings",
        "int16?",
        "crossings",
        message("fewest crossings of joints in a drawing of the graph, 0 or 1; empty for more"),
        "atlas.crossings",
    ),
    ("smallest_circuit", "int16", "links", message("links of the shortest closed circuit"), _DESCRIBED),
    ("largest_circuit", "int16", "links", message("links of the longest one that repeats no link"), _DESCRIBED),
    ("diameter", "int16", "joints", message("most joints on a shortest path between two links"), _DESCRIBED),
    ("dyadic", "bool", "", message("whether it grows from a single loop by dyads"), _DESCRIBED),
    (
        "certificate",
        "string?",
        "",
        message(
            "a digit 0, 1, 2 for each joint of the code in turn; without the joints of any one digit the others make a "
            "forest, which proves that no part is overconstrained; simple turning joints"
        ),
        _DESCRIBED,
    ),
)
_MECHANISMS = (
    ("links", "int16", "links", message("number of links"), "the chain"),
    ("mobility", "int16", "freedoms", message("F of the chain"), "the chain"),
    ("chain", "string", "", message("code of the chain"), "table chains"),
    ("frame", "int16", "", message("the frame: a link of that code, the least of its orbit"), "isomorphism"),
    ("frame_joints", "int16", "joints", message("number of joints at the frame"), "the chain"),
    ("orbit", "int16", "links", message("links of the chain that give this mechanism"), "isomorphism"),
    ("family", "string?", "", message("name of the family, such as Watt I"), "mechanism.family"),
)
_DRIVEN = (
    ("links", "int16", "links", message("number of links"), "the chain"),
    ("mobility", "int16", "freedoms", message("F of the chain, as many drives"), "the chain"),
    ("chain", "string", "", message("code of the chain"), "table chains"),
    ("frame", "int16", "", message("the frame: number of a link in that code"), "isomorphism"),
    (
        "drives",
        "string",
        "",
        message("each driven joint by the two links that it moves against each other, such as 0-3"),
        "mechanism.driven_mechanisms",
    ),
    ("at_frame", "bool", "", message("whether every drive acts on the frame"), "mechanism.driven_mechanisms"),
    ("groups", "list<string>", "", message("forms of the Assur groups in solving order"), "assur.decompose"),
    ("classes", "list<int16>", "", message("their classes"), "assur.decompose"),
    ("orders", "list<int16>", "", message("their orders: numbers of outer joints"), "assur.decompose"),
    ("highest_class", "int16", "", message("the highest of the classes"), "assur.decompose"),
    ("dyads_only", "bool", "", message("whether all groups are dyads"), "assur.decompose"),
    (
        "assembly_modes",
        "int64?",
        "",
        message(
            "assembly modes at almost all dimensions, complex ones included: product over the groups; turning joints"
        ),
        "assur.count_modes",
    ),
    ("family", "string?", "", message("name of the family"), "mechanism.family"),
)

COLUMNS: tuple[SchemaColumn, ...] = tuple(
    SchemaColumn(table=table, name=name, type=kind, unit=unit, definition=definition, origin=origin)
    for table, rows in (("chains", _CHAINS), ("mechanisms", _MECHANISMS), ("driven", _DRIVEN))
    for name, kind, unit, definition, origin in rows
)

TABLES: tuple[str, ...] = tuple(dict.fromkeys(column.table for column in COLUMNS))


def columns_of(table: str) -> tuple[SchemaColumn, ...]:
    """The columns of a table, in their order.

    >>> [column.name for column in columns_of("mechanisms")][:4]
    ['links', 'mobility', 'chain', 'frame']
    """
    return tuple(column for column in COLUMNS if column.table == table)


def arrow_library() -> Any:
    """The library of Arrow tables; `GrueblerError` if it is not installed."""
    try:
        import pyarrow
        import pyarrow.compute
        import pyarrow.parquet
    except ImportError:
        raise GrueblerError("the atlas needs pyarrow: pip install 'gruebler[atlas]'") from None
    return pyarrow


def arrow_schema(table: str, **metadata: str) -> pa.Schema:
    """The columns of a table for Arrow; unit, definition and origin are metadata of each field."""
    pa = arrow_library()

    def kind(name: str) -> Any:
        if name.startswith("list<"):
            return pa.list_(pa.field("element", kind(name[5:-1]), nullable=False))
        return {"string": pa.string(), "bool": pa.bool_()}.get(name) or getattr(pa, name)()

    return pa.schema(
        [
            pa.field(
                column.name,
                kind(column.type.rstrip("?")),
                nullable=column.type.endswith("?"),
                metadata={"unit": column.unit, "definition": str(column.definition), "origin": column.origin},
            )
            for column in columns_of(table)
        ],
        metadata=metadata,
    )
